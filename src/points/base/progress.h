/* Progress of work that consists of pieces which report their own. */
#pragma once

#include <aureole/core.h>

/* What the pieces report from 0 to 1 is from `from` to `to` of the whole; the caller moves both from piece to
 * piece. It outlives the pieces. */
typedef struct aur_progress_span {
    aur_progress whole;
    double from, to;
    uint64_t reported; /* of 10000: the most so far, so that the whole never goes back */
} aur_progress_span;

/* The share that is done of work whose whole is estimated again and again. It never falls, and what is
 * missing of it shrinks in proportion to what is thought to be left, so that its rate of now tells the time
 * left. */
typedef struct aur_progress_share {
    double done, share;
} aur_progress_share;

/* Reports that so much work is done, and so much thought to be left; INFINITY: nobody knows, and the share
 * waits. Returns what the callback, which is not NULL, returns. */
int aur_progress_tell(const aur_progress *progress, const char *what, aur_progress_share *share, double done,
                      double left);

/* For the pieces; without a function where the whole has none. */
aur_progress aur_progress_within(aur_progress_span *span);
