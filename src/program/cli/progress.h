/* How much of a command is done and how long it still takes: arithmetic, whose clock is the caller's. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

/* A part of a command's work, such as the photon map of an image. */
typedef struct cli_phase {
    const char *what; /* the name in the reports of it; NULL: it begins by cli_estimate_begin alone */
    double work;      /* expected; the unit is that of the command's other phases */
} cli_phase;

/* From cli_estimate_of: nothing has been reported. */
typedef struct cli_estimate {
    const cli_phase *phases; /* in their order; those that do not occur are skipped */
    size_t count, next;      /* `next` is the first that has not begun */
    bool begun;
    double start, base;             /* when it began, and the share that was done then */
    double ahead;                   /* work of the phases that have not begun */
    double past_work, past_seconds; /* of the phases that have ended */
    double work, seconds;           /* of this phase: expected; spent in runs from 0 to 1 that have ended */
    double first_time, first, last; /* of this run: when and where it began, and the fraction that is done */
    double marks[2][2]; /* times and fractions of this run: its rate of now is that since the earlier one */
    const char *what;
    double share; /* of the command, from 0 to .99, which its end alone exceeds; it never falls */
    double left;  /* seconds; NaN: unknown */
} cli_estimate;

/* `phases` last as long as the estimate. */
cli_estimate cli_estimate_of(size_t count, const cli_phase *phases);
/* At that time, in seconds, phases[index] begins, of which the reports that follow are. */
void cli_estimate_begin(cli_estimate *estimate, double time, size_t index);
/* Takes a report: at that time, in seconds, the fraction of `what` is done; NaN: nobody knows. */
void cli_estimate_report(cli_estimate *estimate, double time, const char *what, double fraction);
