/* Paired measurements and their output. */
#include "bench.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { PAIRS_CAPACITY = 64 };

double bench_cpu_seconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

void bench_keep(double value) {
    static volatile double sink;
    sink = value;
    (void)sink;
}

bool bench_fail(const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    fputs("aureole-bench: ", stderr);
    vfprintf(stderr, format, arguments);
    fputc('\n', stderr);
    va_end(arguments);
    return false;
}

/* CPU seconds of `runs` runs. */
static double time_runs(const bench_work *work, size_t runs) {
    const double start = bench_cpu_seconds();
    for (size_t i = 0; i < runs; ++i)
        work->run(work->context);
    return bench_cpu_seconds() - start;
}

/* The number of runs that take at least `seconds`. */
static size_t calibrate(const bench_work *work, double seconds) {
    work->run(work->context);
    for (size_t runs = 1;; runs *= 2) {
        const double used = time_runs(work, runs);
        if (used >= seconds)
            return runs;
        if (used >= 0.25 * seconds)
            return (size_t)((double)runs * seconds / used) + 1;
    }
}

static double rate(const bench_work *work, size_t runs) {
    return work->units * (double)runs / time_runs(work, runs);
}

static int ascending(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Sorts the values and interpolates linearly between neighbors. */
static double quantile(size_t count, double *values, double q) {
    qsort(values, count, sizeof *values, ascending);
    const double at = q * (double)(count - 1);
    const size_t below = (size_t)at;
    const size_t above = below + 1 < count ? below + 1 : below;
    return values[below] + (at - (double)below) * (values[above] - values[below]);
}

static size_t pair_count(const bench_options *options) {
    if (options->pairs == 0)
        return 1;
    return options->pairs < PAIRS_CAPACITY ? options->pairs : PAIRS_CAPACITY;
}

bench_pair bench_compare(const bench_options *options, const bench_work *subject, const bench_work *limit) {
    const size_t subject_runs = calibrate(subject, options->seconds);
    const size_t limit_runs = calibrate(limit, options->seconds);
    const size_t pairs = pair_count(options);
    double subjects[PAIRS_CAPACITY], limits[PAIRS_CAPACITY], ratios[PAIRS_CAPACITY];
    for (size_t i = 0; i < pairs; ++i) {
        if (i % 2 == 0)
            subjects[i] = rate(subject, subject_runs);
        limits[i] = rate(limit, limit_runs);
        if (i % 2 != 0)
            subjects[i] = rate(subject, subject_runs);
        ratios[i] = subjects[i] / limits[i];
    }
    return (bench_pair){.subject = quantile(pairs, subjects, 0.5),
                        .limit = quantile(pairs, limits, 0.5),
                        .ratio = quantile(pairs, ratios, 0.5),
                        .ratio_low = quantile(pairs, ratios, 0.25),
                        .ratio_high = quantile(pairs, ratios, 0.75)};
}

double bench_rate(const bench_options *options, const bench_work *work) {
    const size_t runs = calibrate(work, options->seconds);
    const size_t measurements = pair_count(options);
    double rates[PAIRS_CAPACITY];
    for (size_t i = 0; i < measurements; ++i)
        rates[i] = rate(work, runs);
    return quantile(measurements, rates, 0.5);
}

void bench_print_rate(const char *subject, const char *unit, double scale, double value) {
    printf("  %-36s %9.4g %s/s\n", subject, value / scale, unit);
    fflush(stdout);
}

void bench_print_pair(const char *subject, const char *limit, const char *unit, double scale,
                      const bench_pair *pair) {
    printf("  %-36s %9.4g %s/s   %.3f [%.3f, %.3f] of %s %.4g %s/s\n", subject, pair->subject / scale, unit,
           pair->ratio, pair->ratio_low, pair->ratio_high, limit, pair->limit / scale, unit);
    fflush(stdout);
}

void bench_print_seconds(const bench_options *options, const char *subject, const bench_work *work) {
    bench_options few = *options;
    few.pairs = few.pairs < 3 ? few.pairs : 3;
    printf("  %-36s %9.4g CPU s\n", subject, work->units / bench_rate(&few, work));
    fflush(stdout);
}
