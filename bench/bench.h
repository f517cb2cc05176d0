/* aureole-bench: speed as a ratio to a limit of this machine that is measured in the same run.
 *
 * Adding a bench is one file and one line. The file is bench/bench_<name>.c and defines `const bench
 * bench_<name>`; the line goes in the table of bench_main.c. A bench states its work as a bench_work (what
 * one run does, and how many units that is), chooses the limit that it could reach at best (limits.h, or work
 * of its own with the same instruction set), and measures the two in pairs:
 *
 *     const bench_work subject = {.run = make_points, .context = &context, .units = 16.0 * count};
 *     return bench_against(options, "halton, 2 dimensions", &subject, &bench_limit_fill_memory);
 *
 * Benches may call internal functions: the program is linked with every room.
 *
 * All times are CPU seconds of the process, so that neighbours on the machine matter little and work on two
 * threads can be compared with the same work on one: the ratio of their rates is then 1 / (1 + the rise of
 * CPU time a unit). */
#pragma once

#include <stdbool.h>
#include <stddef.h>

typedef struct bench_options {
    bool quick;       /* a smoke test: small work, few pairs, figures of no worth */
    size_t pairs;     /* how often subject and limit are measured */
    double seconds;   /* CPU seconds that one measurement takes at least */
    size_t threads;   /* for benches of scaling: what the machine offers, at least 1 */
    const char *only; /* of the benches that have rows of scenes: those with this in their names; NULL: all */
} bench_options;

/* Repeatable work. run() must leave its result where the compiler cannot drop it (bench_keep). */
typedef struct bench_work {
    void (*run)(void *context);
    void *context;
    double units; /* points, pairs, bytes, rays, ... that one run does */
} bench_work;

typedef struct bench {
    const char *name;
    const char *summary;                       /* one line */
    bool (*run)(const bench_options *options); /* prints its figures; false after bench_fail */
} bench;

/* Medians over the pairs. */
typedef struct bench_pair {
    double subject;   /* units a CPU second */
    double limit;     /* units a CPU second */
    double ratio;     /* median of subject / limit of each pair */
    double ratio_low; /* its quartiles: how far to trust it */
    double ratio_high;
} bench_pair;

/* Measures the two in turns (a b, b a, a b, ...) after a warm-up that finds how many runs make one
 * measurement. */
bench_pair bench_compare(const bench_options *options, const bench_work *subject, const bench_work *limit);
/* One work alone: median of units a CPU second. */
double bench_rate(const bench_options *options, const bench_work *work);

/* Rates are printed divided by `scale`, whose name stands in `unit`: "Mray" with 1e6 prints as Mray/s. */
void bench_print_pair(const char *subject, const char *limit, const char *unit, double scale,
                      const bench_pair *pair);
void bench_print_rate(const char *subject, const char *unit, double scale, double rate);

/* Measures and prints the median of CPU seconds that one run takes, over three measurements at most. */
void bench_print_seconds(const bench_options *options, const char *subject, const bench_work *work);

/* CPU seconds that the process, all its threads together, has used. */
double bench_cpu_seconds(void);
/* Makes the compiler believe that the value is needed. */
void bench_keep(double value);
/* Says on standard error why a bench cannot run; returns false. */
bool bench_fail(const char *format, ...) __attribute__((format(printf, 1, 2)));
