/* Progress and remaining time of a command. The caller provides the clock. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

/* A part of a command's work, such as the photon map of an image. */
typedef struct cli_phase {
    const char *what; /* the name in its reports; NULL: starts only by cli_estimate_begin */
    double work;      /* expected, in the same unit for all phases of the command */
} cli_phase;

/* From cli_estimate_of: nothing has been reported. */
typedef struct cli_estimate {
    const cli_phase *phases; /* in order; missing ones are skipped */
    size_t count, next;      /* `next` is the first that has not started */
    bool started;
    double start, base;             /* start time, and the fraction done at that time */
    double ahead;                   /* work of the phases that have not started */
    double past_work, past_seconds; /* of the finished phases */
    double work, seconds;           /* of this phase: expected work; seconds of its finished runs */
    double first_time, first, last; /* of this run: start time and fraction, and the latest fraction */
    double marks[2][2]; /* two earlier times and fractions of this run; the current rate is measured since the
                           first */
    const char *what;
    double share; /* fraction of the command, from 0 to .99 until its end; it never decreases */
    double left;  /* seconds; NaN: unknown */
} cli_estimate;

/* `phases` must outlive the estimate. */
cli_estimate cli_estimate_of(size_t count, const cli_phase *phases);
/* At that time, in seconds, phases[index] starts; the following reports belong to it. */
void cli_estimate_begin(cli_estimate *estimate, double time, size_t index);
/* Adds a report: at that time, in seconds, the fraction of `what` is done; NaN: unknown. */
void cli_estimate_report(cli_estimate *estimate, double time, const char *what, double fraction);
