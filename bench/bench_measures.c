/* Quality measures against the hardware's square root, and the time of exact suprema. */
#include <aureole/quality.h>
#include <aureole/sphere.h>
#include <stdlib.h>

#include "limits.h"
#include "points/base/random.h"
#include "points/base/vector.h"

typedef struct measure_context {
    const char *metric;
    aur_points_view points;
    double *coordinates; /* of the points; the caller frees them */
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
    const size_t many = options->quick ? 20000 : 1000000;
    measure_context fast = {.metric = "energy", .options = {.size = sizeof(aur_measure_options)}};
    fast.options.threads = 1;
    fast.options.fast = true;
    measure_context structured = fast;
    aur_points *fibonacci = NULL;
    aur_directions_options set = {.size = sizeof set};
    aur_directions_options_init(many, AUR_DOMAIN_SPHERE, &set, NULL);
    aur_points_request request = {.size = sizeof request};
    aur_points_request_init(&set, &request, NULL);
    if (!make_points(AUR_DOMAIN_SPHERE, count, &fast.points, &fast.coordinates))
        return false;
    if (aur_points_generate("spherical-fibonacci", &request, &fibonacci, NULL) != AUR_OK) {
        free(fast.coordinates);
        return bench_fail("out of memory");
    }
    structured.points = *aur_points_get_view(fibonacci);
    structured.options.fast = false;
    measure_context exact = fast, shared = fast;
    exact.options.fast = false;
    shared.options.threads = options->threads;
    const double units = pairs_of((double)count);
    const bench_work fast_work = {run_measure, &fast, units};
    const bench_work exact_work = {run_measure, &exact, units};
    const bench_work shared_work = {run_measure, &shared, units};
    const bool good =
        bench_against(options, "pair sum, fast (target 1.6)", &fast_work, &bench_limit_pairs_f64) &&
        bench_against(options, "pair sum, compensated", &exact_work, &bench_limit_pairs_f64);
    const bench_pair scaling = bench_compare(options, &shared_work, &fast_work);
    bench_print_pair("pair sum, all threads (target 0.91)", "one thread", "Gpair", 1e9, &scaling);
    const bench_work lags = {run_measure, &structured, pairs_of((double)many)};
    bench_options few = *options;
    few.pairs = few.pairs < 5 ? few.pairs : 5;
    const bench_pair by_lags = bench_compare(&few, &lags, &fast_work);
    bench_print_pair(options->quick ? "Fibonacci by lags, N = 20000"
                                    : "Fibonacci by lags, N = 1e6 (target 50)",
                     "our pair sum", "Gpair", 1e9, &by_lags);
    free(fast.coordinates);
    aur_points_destroy(fibonacci);
    return good;
}

/* Energies to a given accuracy of unstructured points, next to the direct pair sum; in equivalent pairs. */
static bool bench_accuracy(const bench_options *options) {
    const size_t count = options->quick ? 20000 : 100000;
    measure_context split = {.metric = "energy", .options = {.size = sizeof(aur_measure_options)}},
                    pairs = split;
    split.options.threads = pairs.options.threads = 1;
    split.options.accuracy = 1e-6;
    pairs.options.fast = true;
    if (!make_points(AUR_DOMAIN_SPHERE, count, &split.points, &split.coordinates))
        return false;
    const bool good = make_points(AUR_DOMAIN_SPHERE, 16384, &pairs.points, &pairs.coordinates);
    const bench_work split_work = {run_measure, &split, pairs_of((double)count)};
    const bench_work pairs_work = {run_measure, &pairs, pairs_of(16384.0)};
    bench_options few = *options;
    few.pairs = few.pairs < 5 ? few.pairs : 5;
    if (good) {
        const bench_pair pair = bench_compare(&few, &split_work, &pairs_work);
        bench_print_pair(options->quick ? "energy to 1e-6, N = 20000" : "energy to 1e-6, N = 1e5",
                         "our pair sum", "Gpair", 1e9, &pair);
    }
    free(split.coordinates);
    free(pairs.coordinates);
    return good;
}

/* CPU seconds of one measure of random points. */
static bool bench_seconds(const bench_options *options, const char *name, measure_context *context,
                          aur_domain domain, size_t count) {
    if (!make_points(domain, count, &context->points, &context->coordinates))
        return false;
    context->options.threads = 1;
    const bench_work work = {run_measure, context, 1.0};
    bench_print_seconds(options, name, &work);
    free(context->coordinates);
    return true;
}

static bool run(const bench_options *options) {
    measure_context cap = {.metric = "cap", .options = {.size = sizeof(aur_measure_options)}};
    measure_context star = {.metric = "star", .options = {.size = sizeof(aur_measure_options)}};
    const bool quick = options->quick;
    return bench_sums(options) && bench_accuracy(options) &&
           bench_seconds(options, quick ? "cap, N = 64" : "cap, N = 512 (target 3)", &cap, AUR_DOMAIN_SPHERE,
                         quick ? 64 : 512) &&
           bench_seconds(options, quick ? "star, N = 1024" : "star, N = 16384 (target 0.5)", &star,
                         AUR_DOMAIN_SQUARE, quick ? 1024 : 16384);
}

const bench bench_measures = {"measures", "pair sums against square roots; suprema over caps and boxes", run};
