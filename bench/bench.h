/* aureole-bench: speed as a ratio to a limit of this machine, measured in the same run.
 *
 * To add a bench, add one file and one line. The file is bench/bench_<name>.c and defines `const bench
 * bench_<name>`; the line goes in the table of bench_main.c. A bench states its work as a bench_work (what
 * one run does, and its number of units), chooses an upper limit of its speed (limits.h, or custom work with
 * the same instruction set), and measures the two in pairs:
 *
 *     const bench_work subject = {.run = make_points, .context = &context, .units = 16.0 * count};
 *     return bench_against(options, "halton, 2 dimensions", &subject, &bench_limit_fill_memory);
 *
 * Benches may call internal functions: the program links every module.
 *
 * All times are CPU seconds of the process. Other load on the machine then matters little, and work on two
 * threads can be compared with the same work on one: the ratio of their rates is 1 / (1 + the relative
 * increase of CPU time per unit). */
#pragma once

#include <stdbool.h>
#include <stddef.h>

typedef struct bench_options {
    bool quick;        /* a smoke test: little work, few pairs, meaningless numbers */
    size_t pairs;      /* number of paired measurements of subject and limit */
    double seconds;    /* CPU seconds: lower bound of one measurement */
    size_t threads;    /* for scaling benches: the hardware threads, at least 1 */
    const char *only;  /* of benches with rows of scenes: only names that contain this; NULL: all */
    const char *scene; /* of the bench adaptive: a scene file instead of its rows; NULL: none */
} bench_options;

/* Repeatable work. run() must pass its result to bench_keep, so that the compiler cannot remove the work. */
typedef struct bench_work {
    void (*run)(void *context);
    void *context;
    double units; /* points, pairs, bytes, rays, ... per run */
} bench_work;

typedef struct bench {
    const char *name;
    const char *summary;                       /* description for `list` */
    bool (*run)(const bench_options *options); /* prints the results; false after bench_fail */
} bench;

/* Medians over the pairs. */
typedef struct bench_pair {
    double subject;   /* units per CPU second */
    double limit;     /* units per CPU second */
    double ratio;     /* median of subject / limit of each pair */
    double ratio_low; /* quartiles of that ratio */
    double ratio_high;
} bench_pair;

/* Measures the two alternately (a b, b a, a b, ...) after a warm-up that determines the runs per measurement.
 */
bench_pair bench_compare(const bench_options *options, const bench_work *subject, const bench_work *limit);
/* Measures one work alone: median of units per CPU second. */
double bench_rate(const bench_options *options, const bench_work *work);

/* Rates are printed divided by `scale`, whose name is in `unit`: "Mray" with 1e6 prints as Mray/s. */
void bench_print_pair(const char *subject, const char *limit, const char *unit, double scale,
                      const bench_pair *pair);
void bench_print_rate(const char *subject, const char *unit, double scale, double rate);

/* Measures and prints the median of CPU seconds of one run, over at most three measurements. */
void bench_print_seconds(const bench_options *options, const char *subject, const bench_work *work);

/* CPU seconds of the process, all threads together. */
double bench_cpu_seconds(void);
/* Keeps the compiler from removing the computation of the value. */
void bench_keep(double value);
/* Prints on standard error why a bench cannot run; returns false. */
bool bench_fail(const char *format, ...) __attribute__((format(printf, 1, 2)));
