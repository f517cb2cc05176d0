/* A stretch of work by two clocks. */
#pragma once

#include <time.h>

typedef struct aur_stopwatch {
    double wall, cpu;
} aur_stopwatch;

static inline double aur_clock_seconds(clockid_t clock) {
    struct timespec now;
    clock_gettime(clock, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static inline aur_stopwatch aur_stopwatch_start(void) {
    return (aur_stopwatch){aur_clock_seconds(CLOCK_MONOTONIC), aur_clock_seconds(CLOCK_PROCESS_CPUTIME_ID)};
}

/* Adds the seconds since the start. */
static inline void aur_stopwatch_add(const aur_stopwatch *start, double *wall, double *cpu) {
    *wall += aur_clock_seconds(CLOCK_MONOTONIC) - start->wall;
    *cpu += aur_clock_seconds(CLOCK_PROCESS_CPUTIME_ID) - start->cpu;
}
