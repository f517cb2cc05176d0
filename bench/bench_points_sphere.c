/* Native point sets of the sphere: against a streaming fill of the same bytes, against a naive loop, and on
 * all threads. */
#include <aureole/sphere.h>
#include <math.h>
#include <stdlib.h>

#include "limits.h"
#include "points/base/parallel.h"

enum { SLICES = 16, ROUNDS = 8 };

typedef struct points_context {
    aur_directions *directions;
    size_t count;
    size_t threads;
    double *xyz;
} points_context;

static void make_points(void *data) {
    const points_context *const context = data;
    aur_directions_points(context->directions, 0, context->count, 3 * context->count, context->xyz, NULL,
                          NULL);
    bench_keep(context->xyz[3 * context->count - 1]);
}

/* Marques 2013 eq. 4, implemented directly. */
static void make_points_by_libm(void *data) {
    const points_context *const context = data;
    const double count = (double)context->count;
    for (size_t j = 0; j < context->count; ++j) {
        const double theta = acos(1.0 - (2.0 * (double)j + 1.0) / count);
        const double phi = 2.0 * 3.14159265358979323846 * (double)j * 0.61803398874989484820;
        context->xyz[3 * j] = sin(theta) * cos(phi);
        context->xyz[3 * j + 1] = sin(theta) * sin(phi);
        context->xyz[3 * j + 2] = cos(theta);
    }
    bench_keep(context->xyz[3 * context->count - 1]);
}

static aur_result make_slice(void *data, size_t index) {
    const points_context *const context = data;
    const size_t part = context->count / SLICES;
    aur_result result = AUR_OK;
    for (size_t round = 0; round < ROUNDS && result == AUR_OK; ++round)
        result = aur_directions_points(context->directions, index * part, part, 3 * part,
                                       context->xyz + 3 * index * part, NULL, NULL);
    return result;
}

static void make_points_shared(void *data) {
    const points_context *const context = data;
    const aur_parallel_options options = {.threads = context->threads};
    aur_parallel_for(&options, SLICES, make_slice, data, NULL);
    bench_keep(context->xyz[3 * context->count - 1]);
}

static bool open_points(const char *set, aur_domain domain, points_context *context) {
    aur_directions_options options = {.size = sizeof options, .domain = domain};
    options.count = context->count;
    context->xyz = malloc(3 * context->count * sizeof *context->xyz);
    if (context->xyz == NULL || aur_directions_create(set, &options, &context->directions, NULL) != AUR_OK) {
        free(context->xyz);
        return bench_fail("%s cannot be made ready", set);
    }
    return true;
}

static void close_points(points_context *context) {
    aur_directions_destroy(context->directions);
    free(context->xyz);
}

static bool run_against_fill(const bench_options *options, const char *name, const char *set, size_t count) {
    points_context context = {.count = count};
    if (!open_points(set, AUR_DOMAIN_SPHERE, &context))
        return false;
    const bench_work subject = {make_points, &context, 24.0 * (double)count};
    const bool done = bench_against(options, name, &subject, &bench_limit_fill_memory_stream);
    close_points(&context);
    return done;
}

static bool run_against_cache(const bench_options *options, const char *name, const char *set) {
    points_context context = {.count = 640};
    if (!open_points(set, AUR_DOMAIN_SPHERE, &context))
        return false;
    const bench_work subject = {make_points, &context, 24.0 * (double)context.count};
    const bool done = bench_against(options, name, &subject, &bench_limit_fill_cache);
    close_points(&context);
    return done;
}

static bool run_against_loop(const bench_options *options, const char *name, size_t count) {
    points_context context = {.count = count};
    if (!open_points("spherical-fibonacci", AUR_DOMAIN_SPHERE, &context))
        return false;
    const bench_work fast = {make_points, &context, (double)count};
    const bench_work obvious = {make_points_by_libm, &context, (double)count};
    const bench_pair pair = bench_compare(options, &fast, &obvious);
    bench_print_pair(name, "libm's sin and cos", "Mpoint", 1e6, &pair);
    close_points(&context);
    return true;
}

/* The increase of CPU time per point from one thread to all. The points of a slice stay in the thread's
 * cache, because memory bandwidth is shared. */
static bool run_on_threads(const bench_options *options) {
    points_context alone = {.count = SLICES << 14, .threads = 1};
    if (!open_points("spherical-fibonacci", AUR_DOMAIN_SPHERE, &alone))
        return false;
    points_context shared = alone;
    shared.threads = options->threads;
    const double units = ROUNDS * (double)alone.count;
    const bench_work one = {make_points_shared, &alone, units};
    const bench_work all = {make_points_shared, &shared, units};
    const bench_pair pair = bench_compare(options, &all, &one);
    bench_print_pair("spherical-fibonacci, all threads", "one thread", "Mpoint", 1e6, &pair);
    close_points(&alone);
    return true;
}

typedef struct inverse_context {
    aur_fibonacci_set set;
    size_t count;
    const double *xyz;    /* of the queries */
    const double *points; /* of the set, for brute force */
    uint64_t *indices;
} inverse_context;

static void find_nearest(void *data) {
    const inverse_context *const context = data;
    aur_fibonacci_nearest(&context->set, context->count, context->xyz, context->count, context->indices,
                          NULL);
    bench_keep((double)context->indices[context->count - 1]);
}

static void find_nearest_by_force(void *data) {
    const inverse_context *const context = data;
    for (size_t i = 0; i < context->count; ++i) {
        const double *const q = context->xyz + 3 * i;
        double best = -2.0;
        for (size_t j = 0; j < context->set.size; ++j) {
            const double *const p = context->points + 3 * j;
            const double cosine = p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
            if (cosine > best) {
                best = cosine;
                context->indices[i] = j;
            }
        }
    }
    bench_keep((double)context->indices[context->count - 1]);
}

static bool run_inverse(const bench_options *options) {
    enum { SIZE = 10000, QUERIES = 4096 };
    points_context points = {.count = SIZE};
    points_context queries = {.count = QUERIES};
    if (!open_points("spherical-fibonacci", AUR_DOMAIN_SPHERE, &points))
        return false;
    if (!open_points("random", AUR_DOMAIN_SPHERE, &queries)) {
        close_points(&points);
        return false;
    }
    make_points(&points);
    make_points(&queries);
    uint64_t indices[QUERIES];
    inverse_context context = {{SIZE, AUR_DOMAIN_SPHERE}, QUERIES, queries.xyz, points.xyz, indices};
    inverse_context few = context;
    few.count = 16;
    const bench_work fast = {find_nearest, &context, QUERIES};
    const bench_work force = {find_nearest_by_force, &few, 16.0};
    const bench_pair pair = bench_compare(options, &fast, &force);
    bench_print_pair("nearest of 10,000 points", "brute force", "Mquery", 1e6, &pair);
    context.set.size = 1000000000;
    bench_print_rate("nearest of 1,000,000,000 points", "Mquery", 1e6, bench_rate(options, &fast));
    close_points(&points);
    close_points(&queries);
    return true;
}

static bool run(const bench_options *options) {
    const size_t count = options->quick ? (size_t)1 << 16 : (size_t)1 << 22;
    return run_against_fill(options, "spherical-fibonacci, 4M", "spherical-fibonacci", count) &&
           run_against_fill(options, "esfg, 4M", "esfg:base=1024", count) &&
           run_against_cache(options, "spherical-fibonacci, 640", "spherical-fibonacci") &&
           run_against_loop(options, "spherical-fibonacci, 4M", count) &&
           run_against_loop(options, "spherical-fibonacci, 640", 640) && run_on_threads(options) &&
           run_inverse(options);
}

const bench bench_points_sphere = {"points-sphere", "points of the sphere against fills and obvious loops",
                                   run};
