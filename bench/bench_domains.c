/* Rotations against a streaming fill; nearest-point trees against brute force; Voronoi cells against the
 * neighbor searches that they need; exact weights. */
#include <aureole/exact.h>
#include <aureole/nearest.h>
#include <aureole/quality.h>
#include <aureole/rotations.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "limits.h"

typedef struct rotations_context {
    aur_rotations *rotations;
    size_t count;
    double *wxyz;
} rotations_context;

static void make_rotations(void *data) {
    const rotations_context *const context = data;
    aur_rotations_points(context->rotations, 0, context->count, 4 * context->count, context->wxyz, NULL);
    bench_keep(context->wxyz[4 * context->count - 1]);
}

static bool run_rotations(const bench_options *options, const char *set) {
    rotations_context context = {.count = options->quick ? 1 << 14 : 1000000};
    context.wxyz = calloc(4 * context.count, sizeof *context.wxyz);
    aur_rotations_options rotations = {.size = sizeof rotations};
    aur_rotations_options_init(context.count, &rotations, NULL);
    if (context.wxyz == NULL || aur_rotations_create(set, &rotations, &context.rotations, NULL) != AUR_OK) {
        free(context.wxyz);
        return bench_fail("%s cannot be made ready", set);
    }
    char name[64];
    snprintf(name, sizeof name, "%s, 1M", set);
    const bench_work work = {make_rotations, &context, 32.0 * (double)context.count};
    const bool done = bench_against(options, name, &work, &bench_limit_fill_memory_stream);
    snprintf(name, sizeof name, "%s, 1M (target 0.02)", set);
    const bench_work once = {make_rotations, &context, 1.0};
    bench_print_seconds(options, name, &once);
    aur_rotations_destroy(context.rotations);
    free(context.wxyz);
    return done;
}

typedef struct points_context {
    aur_points *points, *queries;
    aur_points_view point_view, query_view; /* points and queries together */
    aur_nearest *nearest;
    size_t neighbours;
    size_t query_count; /* number of queries that are answered */
    size_t *indices;
} points_context;

static bool make_points(const char *set, aur_domain domain, size_t count, uint64_t seed,
                        aur_points **points) {
    aur_directions_options options = {.size = sizeof options};
    aur_directions_options_init(count, domain, &options, NULL);
    options.seed = seed;
    aur_points_request request = {.size = sizeof request};
    aur_points_request_init(&options, &request, NULL);
    return aur_points_generate(set, &request, points, NULL) == AUR_OK;
}

static void close_points(points_context *context) {
    aur_nearest_destroy(context->nearest);
    aur_points_destroy(context->points);
    aur_points_destroy(context->queries);
    free(context->indices);
}

enum { QUERIES = 4096, CUTTING = 12 };

/* Random points, random queries, and a tree of the points. */
static bool open_points(const bench_options *options, aur_domain domain, points_context *context) {
    const size_t count = options->quick ? 1000 : 10000;
    *context = (points_context){.neighbours = 1, .query_count = QUERIES};
    context->indices = calloc(CUTTING * count, sizeof *context->indices);
    bool good = context->indices != NULL && make_points("random", domain, count, 1, &context->points) &&
                make_points("random", domain, QUERIES, 2, &context->queries);
    if (good) {
        context->point_view = *aur_points_get_view(context->points);
        context->query_view = *aur_points_get_view(context->queries);
        good = aur_nearest_create(&context->point_view, &context->nearest, NULL) == AUR_OK;
    }
    if (!good)
        close_points(context);
    return good || bench_fail("out of memory");
}

static void find_nearest(void *data) {
    const points_context *const context = data;
    aur_nearest_options options = {.size = sizeof options};
    aur_nearest_options_init(&options, NULL);
    options.threads = 1;
    options.neighbours = context->neighbours;
    aur_nearest_find(context->nearest, &options, context->query_count, context->query_view.coordinates,
                     context->indices, NULL, NULL);
    bench_keep((double)context->indices[context->query_count - 1]);
}

/* The largest dot product; of rotations, the largest absolute one. */
static void find_nearest_by_force(void *data) {
    const points_context *const context = data;
    const size_t dimension = context->point_view.dimension;
    const bool twofold = context->point_view.domain == AUR_DOMAIN_ROTATIONS;
    for (size_t i = 0; i < context->query_count; ++i) {
        const double *const q = context->query_view.coordinates + dimension * i;
        double best = -2.0;
        for (size_t j = 0; j < context->point_view.count; ++j) {
            const double *const p = context->point_view.coordinates + dimension * j;
            double product = p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
            if (twofold)
                product = fabs(product + p[3] * q[3]);
            if (product > best) {
                best = product;
                context->indices[i] = j;
            }
        }
    }
    bench_keep((double)context->indices[context->query_count - 1]);
}

static void make_tree(void *data) {
    const points_context *const context = data;
    aur_nearest *nearest;
    if (aur_nearest_create(&context->point_view, &nearest, NULL) == AUR_OK)
        aur_nearest_destroy(nearest);
}

static bool run_nearest(const bench_options *options, aur_domain domain, const char *name,
                        const char *tree_name) {
    points_context context;
    if (!open_points(options, domain, &context))
        return false;
    points_context few = context;
    few.query_count = 16;
    const bench_work fast = {find_nearest, &context, QUERIES}, force = {find_nearest_by_force, &few, 16.0};
    const bench_pair pair = bench_compare(options, &fast, &force);
    bench_print_pair(name, "brute force", "Mquery", 1e6, &pair);
    const bench_work tree = {make_tree, &context, (double)context.point_view.count};
    bench_print_rate(tree_name, "Mpoint", 1e6, bench_rate(options, &tree));
    close_points(&context);
    return true;
}

static void find_cells(void *data) {
    const points_context *const context = data;
    aur_measure_options options = {.size = sizeof options};
    aur_measure_options_init(&options, NULL);
    options.threads = 1;
    double value = 0.0;
    aur_measure("voronoi-max", &context->point_view, &options, &value, NULL);
    bench_keep(value);
}

/* A cell has six sides on average; about twice as many neighbors determine it. */
static bool run_cells(const bench_options *options) {
    points_context context;
    if (!open_points(options, AUR_DOMAIN_SPHERE, &context))
        return false;
    points_context neighbours = context;
    neighbours.neighbours = CUTTING;
    neighbours.query_view = context.point_view;
    neighbours.query_count = context.point_view.count;
    const double units = (double)context.point_view.count;
    const bench_work cells = {find_cells, &context, units}, limit = {find_nearest, &neighbours, units};
    const bench_pair pair = bench_compare(options, &cells, &limit);
    bench_print_pair("Voronoi cells of 10,000 points", "the 12 nearest of each", "Mpoint", 1e6, &pair);
    close_points(&context);
    return true;
}

typedef struct exact_context {
    points_context points;
    aur_exact_options options;
    double *weights;
} exact_context;

static void find_weights(void *data) {
    const exact_context *const context = data;
    const size_t count = context->points.point_view.count;
    aur_weights_exact(count, context->points.point_view.coordinates, &context->options, count,
                      context->weights, NULL, NULL);
    bench_keep(context->weights[0]);
}

static bool run_exact(const bench_options *options, const char *name, size_t count, size_t degree) {
    exact_context context = {.options = {.size = sizeof context.options}};
    aur_exact_options_init(AUR_DOMAIN_SPHERE, &context.options, NULL);
    context.options.degree = degree;
    context.options.threads = 1;
    context.weights = calloc(count, sizeof *context.weights);
    const bool good = context.weights != NULL &&
                      make_points("spherical-fibonacci", AUR_DOMAIN_SPHERE, count, 0, &context.points.points);
    if (good) {
        context.points.point_view = *aur_points_get_view(context.points.points);
        const bench_work work = {find_weights, &context, 1.0};
        bench_print_seconds(options, name, &work);
    }
    close_points(&context.points);
    free(context.weights);
    return good || bench_fail("out of memory");
}

static bool run(const bench_options *options) {
    const bool quick = options->quick;
    return run_rotations(options, "super-fibonacci") && run_rotations(options, "super-fibonacci-grid") &&
           run_rotations(options, "esfg-rotations") && run_rotations(options, "sobol") &&
           run_nearest(options, AUR_DOMAIN_SPHERE, "nearest of 10,000 directions", "tree of directions") &&
           run_nearest(options, AUR_DOMAIN_ROTATIONS, "nearest of 10,000 rotations", "tree of rotations") &&
           run_cells(options) &&
           run_exact(options, "exact weights, largest degree of 1000", quick ? 100 : 1000,
                     AUR_DEGREE_LARGEST) &&
           run_exact(options, "exact weights, 10,000 to degree 80", quick ? 2500 : 10000, quick ? 20 : 80);
}

const bench bench_domains = {"domains", "rotations, nearest points, Voronoi cells and exact weights", run};
