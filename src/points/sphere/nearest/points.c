/* Nearest neighbours on every domain, by the tree. */
#include <aureole/nearest.h>
#include <math.h>
#include <stdlib.h>

#include "points/base/error.h"
#include "points/base/parallel.h"
#include "points/pointset/points.h"
#include "points/sphere/nearest/inverse.h"

enum { MOST_DIMENSIONS = 8, QUERIES_PER_ITEM = 256 };

struct aur_nearest {
    aur_tree *tree;
    aur_domain domain;
    size_t dimension, count, ends; /* 2 if a point and its opposite are identified */
};

static bool are_unit(aur_domain domain) {
    return domain >= AUR_DOMAIN_HEMISPHERE;
}

/* Copies a point, normalised if it is a direction; false if it cannot be normalised. */
static bool take(const aur_nearest *nearest, const double *from, double *to) {
    double square = 0.0;
    for (size_t d = 0; d < nearest->dimension; ++d)
        square += from[d] * from[d];
    const bool unit = are_unit(nearest->domain);
    const double scale = unit ? 1.0 / sqrt(square) : 1.0;
    for (size_t d = 0; d < nearest->dimension; ++d)
        to[d] = from[d] * scale;
    return isfinite(square) && isfinite(scale);
}

static aur_result make_tree(const aur_points_view *points, aur_nearest *created, aur_error *error) {
    const size_t dimension = points->dimension, count = points->count, size = dimension * count;
    double *const all = calloc(created->ends * size, sizeof *all);
    if (all == NULL)
        return aur_fail_memory(error);
    aur_result result = AUR_OK;
    for (size_t i = 0; i < count && result == AUR_OK; ++i)
        if (!take(created, aur_point_at(points, i), all + dimension * i))
            result = aur_fail(error, AUR_ERROR_ARGUMENT,
                              "point %zu has coordinates that are not finite, or all zero", i + 1);
    for (size_t i = 0; i < size && created->ends == 2; ++i)
        all[size + i] = -all[i];
    if (result == AUR_OK)
        result = aur_tree_create(dimension, created->ends * count, dimension, all, &created->tree, error);
    free(all);
    return result;
}

aur_result aur_nearest_create(const aur_points_view *given, aur_nearest **nearest, aur_error *error) {
    *nearest = NULL;
    aur_points_view points;
    aur_result result = aur_points_view_read(given, &points, error);
    if (result != AUR_OK)
        return result;
    if (points.count == 0 || points.dimension == 0 || points.dimension > MOST_DIMENSIONS)
        return aur_fail(
            error, AUR_ERROR_ARGUMENT,
            "the nearest of points needs at least one point of 1 to %d coordinates, not %zu of %zu",
            MOST_DIMENSIONS, points.count, points.dimension);
    aur_nearest *const created = calloc(1, sizeof *created);
    if (created == NULL)
        return aur_fail_memory(error);
    const bool twofold = points.domain == AUR_DOMAIN_AXES || points.domain == AUR_DOMAIN_ROTATIONS;
    *created = (aur_nearest){NULL, points.domain, points.dimension, points.count, twofold ? 2 : 1};
    result = make_tree(&points, created, error);
    if (result == AUR_OK)
        *nearest = created;
    else
        aur_nearest_destroy(created);
    return result;
}

void aur_nearest_destroy(aur_nearest *nearest) {
    if (nearest == NULL)
        return;
    aur_tree_destroy(nearest->tree);
    free(nearest);
}

typedef struct batch {
    const aur_nearest *nearest;
    size_t neighbours, count;
    const double *queries;
    size_t *indices;
    double *distances;
    size_t *refused; /* one per item: the invalid query, counted from 1; 0: none */
} batch;

static double distance_of(aur_domain domain, double square) {
    const double distance = sqrt(square);
    if (!are_unit(domain))
        return distance;
    return (domain == AUR_DOMAIN_ROTATIONS ? 4.0 : 2.0) * asin(fmin(0.5 * distance, 1.0));
}

/* The nearer end of a point is found first; the other end is skipped. */
static void select_found(const batch *b, size_t query, size_t count, const aur_found *found) {
    const size_t points = b->nearest->count;
    size_t *const indices = b->indices + query * b->neighbours;
    size_t selected = 0;
    for (size_t f = 0; f < count && selected < b->neighbours; ++f) {
        const size_t index = found[f].index % points;
        bool duplicate = false;
        for (size_t k = 0; k < selected && b->nearest->ends == 2; ++k)
            duplicate |= indices[k] == index;
        if (duplicate)
            continue;
        if (b->distances != NULL)
            b->distances[query * b->neighbours + selected] = distance_of(b->nearest->domain, found[f].square);
        indices[selected++] = index;
    }
}

static aur_result find_some(void *context, size_t item) {
    const batch *const b = context;
    const size_t requested = b->neighbours > 1 ? b->nearest->ends * b->neighbours : 1;
    aur_found *const found = malloc(requested * sizeof *found);
    if (found == NULL)
        return AUR_ERROR_MEMORY;
    for (size_t q = item * QUERIES_PER_ITEM; q < (item + 1) * QUERIES_PER_ITEM && q < b->count; ++q) {
        double query[MOST_DIMENSIONS];
        if (!take(b->nearest, b->queries + q * b->nearest->dimension, query)) {
            b->refused[item] = q + 1;
            break;
        }
        select_found(b, q, aur_tree_find(b->nearest->tree, query, requested, found), found);
    }
    free(found);
    return AUR_OK;
}

aur_result aur_nearest_find(const aur_nearest *nearest, const aur_nearest_options *options, size_t count,
                            const double *queries, size_t *indices, double *distances, aur_error *error) {
    aur_nearest_options copy = {.size = sizeof copy};
    aur_nearest_options_init(&copy, NULL);
    aur_result result = aur_options_read(options, sizeof copy, &copy, "aur_nearest_options", error);
    if (result != AUR_OK)
        return result;
    copy.neighbours += copy.neighbours == 0;
    if (copy.neighbours > nearest->count)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "%zu neighbours requested, but there are only %zu points",
                        copy.neighbours, nearest->count);
    const size_t items = (count + QUERIES_PER_ITEM - 1) / QUERIES_PER_ITEM;
    batch b = {
        nearest, copy.neighbours, count, queries, indices, distances, calloc(items + 1, sizeof *b.refused)};
    if (b.refused == NULL)
        return aur_fail_memory(error);
    const aur_parallel_options parallel = {
        .threads = copy.threads, .what = "finding neighbours", .progress = copy.progress};
    result = aur_parallel_for(&parallel, items, find_some, &b, error);
    for (size_t i = 0; i < items && result == AUR_OK; ++i)
        if (b.refused[i] != 0)
            result = aur_fail(error, AUR_ERROR_ARGUMENT,
                              "query %zu has coordinates that are not finite, or all zero", b.refused[i]);
    free(b.refused);
    return result;
}

aur_result aur_nearest_options_init(aur_nearest_options *options, aur_error *error) {
    static const aur_nearest_options defaults = {.size = sizeof defaults};
    return aur_description_write(&defaults, sizeof defaults, options, "aur_nearest_options", error);
}
