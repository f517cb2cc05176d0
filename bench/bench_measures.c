/* Measures against the hardware's square root, and the time of the exact suprema. */
#include <stdio.h>
#include <stdlib.h>

#include "experimental.h"
#include "limits.h"

typedef struct sum_context {
    aur_axes axes;
    aur_measure_options options;
} sum_context;

typedef struct measure_context {
    const char *metric;
    aur_points_view points;
    double *coordinates; /* of the points */
    aur_measure_options options;
} measure_context;

static double unit(uint64_t a, uint64_t b) {
    return aur_unit_double(aur_hash2(a, b));
}

/* Random points: unit vectors by rejection, or of the square. */
static bool make_points(aur_domain domain, size_t count, aur_points_view *points, double **coordinates) {
    const size_t dimension = domain == AUR_DOMAIN_SPHERE ? 3 : 2;
    *coordinates = malloc(count * dimension * sizeof **coordinates);
    *points = aur_points_view_of(domain, count, dimension, *coordinates);
    if (*coordinates == NULL)
        return bench_fail("out of memory");
    for (size_t i = 0; i < count; ++i) {
        double *const x = *coordinates + i * dimension;
        double square = 0.0;
        for (uint64_t try = 0; domain == AUR_DOMAIN_SPHERE && !(square > 0.01 && square <= 1.0); ++try) {
            square = 0.0;
            for (size_t d = 0; d < 3; ++d) {
                x[d] = 2.0 * unit(i, 3 * try + d) - 1.0;
                square += x[d] * x[d];
            }
        }
        for (size_t d = 0; d < dimension; ++d)
            x[d] = domain == AUR_DOMAIN_SPHERE ? x[d] / sqrt(square) : unit(i, d);
    }
    return true;
}

static void run_distance_sum(void *data) {
    sum_context *const context = data;
    aur_twofold sum = {0.0, 0.0};
    aur_distance_sum(&context->axes, &context->options, &sum, NULL);
    bench_keep(sum.high);
}

static void run_fibonacci_sum(void *data) {
    const size_t *const count = data;
    const aur_measure_options options = {.size = sizeof options, .threads = 1};
    aur_twofold sum = {0.0, 0.0};
    aur_fibonacci_distance_sum(*count, AUR_DOMAIN_SPHERE, &options, &sum, NULL);
    bench_keep(sum.high);
}

static void run_measure(void *data) {
    measure_context *const context = data;
    double value = 0.0;
    aur_measure(context->metric, &context->points, &context->options, &value, NULL);
    bench_keep(value);
}

static double pairs_of(double count) {
    return 0.5 * count * (count - 1.0);
}

static bool bench_sums(const bench_options *options) {
    const size_t count = options->quick ? 2048 : 16384;
    aur_points_view points;
    double *coordinates;
    if (!make_points(AUR_DOMAIN_SPHERE, count, &points, &coordinates))
        return false;
    sum_context fast = {.options = {.size = sizeof fast.options, .threads = 1, .fast = true}};
    bool good = aur_axes_create(&points, &fast.axes, NULL) == AUR_OK || bench_fail("out of memory");
    free(coordinates);
    if (!good)
        return false;
    sum_context exact = fast, shared = fast;
    exact.options.fast = false;
    shared.options.threads = options->threads;
    const double units = pairs_of((double)count);
    const bench_work fast_work = {run_distance_sum, &fast, units};
    const bench_work exact_work = {run_distance_sum, &exact, units};
    const bench_work shared_work = {run_distance_sum, &shared, units};
    good = bench_against(options, "pair sum, fast (asked 1.6)", &fast_work, &bench_limit_pairs_f64) &&
           bench_against(options, "pair sum, compensated", &exact_work, &bench_limit_pairs_f64);
    const bench_pair scaling = bench_compare(options, &shared_work, &fast_work);
    bench_print_pair("pair sum, all threads (asked 0.91)", "one thread", "Gpair", 1e9, &scaling);
    size_t many = options->quick ? 20000 : 1000000;
    const bench_work lags = {run_fibonacci_sum, &many, pairs_of((double)many)};
    bench_options few = *options;
    few.pairs = few.pairs < 5 ? few.pairs : 5;
    const bench_pair structured = bench_compare(&few, &lags, &fast_work);
    bench_print_pair(options->quick ? "Fibonacci by lags, N = 20000"
                                    : "Fibonacci by lags, N = 1e6 (asked 50)",
                     "our pair sum", "Gpair", 1e9, &structured);
    aur_axes_release(&fast.axes);
    return good;
}

/* CPU seconds of one measure of random points. */
static bool bench_seconds(const bench_options *options, const char *name, measure_context *context,
                          aur_domain domain, size_t count) {
    if (!make_points(domain, count, &context->points, &context->coordinates))
        return false;
    context->options.threads = 1;
    const bench_work work = {run_measure, context, 1.0};
    bench_options few = *options;
    few.pairs = few.pairs < 3 ? few.pairs : 3;
    printf("  %-36s %9.4g CPU s\n", name, 1.0 / bench_rate(&few, &work));
    fflush(stdout);
    free(context->coordinates);
    return true;
}

static bool run(const bench_options *options) {
    measure_context cap = {.metric = "cap", .options = aur_measure_options_default()};
    measure_context star = {.metric = "star", .options = aur_measure_options_default()};
    const bool quick = options->quick;
    return bench_sums(options) &&
           bench_seconds(options, quick ? "cap, N = 64" : "cap, N = 512 (asked 3)", &cap, AUR_DOMAIN_SPHERE,
                         quick ? 64 : 512) &&
           bench_seconds(options, quick ? "star, N = 1024" : "star, N = 16384 (asked 0.5)", &star,
                         AUR_DOMAIN_SQUARE, quick ? 1024 : 16384);
}

const bench bench_measures = {"measures", "pair sums against square roots; suprema over caps and boxes", run};
