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

/* For the pieces; without a function where the whole has none. */
aur_progress aur_progress_within(aur_progress_span *span);
