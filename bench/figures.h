/* A table of figures: what was asked of each, what was measured, and whether that meets it. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

typedef enum bench_relation { BENCH_AT_LEAST, BENCH_AT_MOST, BENCH_NOTED } bench_relation;

typedef struct bench_figure {
    char name[72];
    bench_relation relation;
    double asked, measured;
    const char *unit; /* "" for ratios */
} bench_figure;

typedef struct bench_figures {
    size_t count;
    bench_figure rows[128]; /* what comes after the last is left out, and said so when printed */
} bench_figures;

/* `name` as by printf. Nothing is asked of a figure that is only NOTED. */
void bench_figures_add(bench_figures *figures, bench_relation relation, double asked, double measured,
                       const char *unit, const char *name, ...) __attribute__((format(printf, 6, 7)));
void bench_figures_print(const bench_figures *figures);
