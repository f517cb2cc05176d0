/* A table of results: target and measurement of each, and whether the target is met. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

typedef enum bench_relation { BENCH_AT_LEAST, BENCH_AT_MOST, BENCH_NOTED } bench_relation;

typedef struct bench_figure {
    char name[72];
    bench_relation relation;
    double target, measured;
    const char *unit; /* "" for ratios */
} bench_figure;

typedef struct bench_figures {
    size_t count;
    bench_figure rows[128]; /* results beyond the capacity are dropped, which bench_figures_print reports */
} bench_figures;

/* `name` is a printf format. NOTED results have no target. */
void bench_figures_add(bench_figures *figures, bench_relation relation, double target, double measured,
                       const char *unit, const char *name, ...) __attribute__((format(printf, 6, 7)));
void bench_figures_print(const bench_figures *figures);
