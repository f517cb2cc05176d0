#include "lighting/viewfactors/closed_pairs.h"

#include <stdlib.h>
#include <string.h>

#include "points/base/array.h"

/* Up to this number of patches all pairs are tested. */
enum { SMALL_MESH = 1500, BLOCK = 16 };

/* Minimum of expected rays for a pair: no ray hits it with probability exp(-16), one in 9 million. */
static const double EXPECTED_RAYS = 8.0;

typedef struct finding {
    const aur_facets *facets;
    const aur_ray_hits *ray_hits;
    const aur_box_tree *tree;
    aur_closed_pairs *pairs;
    bool all;
} finding;

/* The expected number of rays of both patches that hit the other one, per exchange (area times factor). */
static double expected_rays(const finding *work, size_t i, size_t k, double exchange) {
    const double rays = (double)(work->ray_hits->rays * work->ray_hits->randomizations);
    const double *const areas = work->facets->areas;
    return rays * exchange *
           (1.0 / areas[aur_facet_of(work->facets, i)] + 1.0 / areas[aur_facet_of(work->facets, k)]);
}

/* Twice the upper bound of the exchange of two distant patches: both fully visible along the line between
 * their means. */
static bool is_hopeless(const finding *work, size_t i, size_t k) {
    const aur_facets *const facets = work->facets;
    const size_t facet[2] = {aur_facet_of(facets, i), aur_facet_of(facets, k)};
    double way[3], longest = 0.0;
    for (int d = 0; d < 3; ++d) {
        way[d] = 0.0;
        for (size_t c = 0; c < 3; ++c)
            way[d] += (facets->corners[facet[1]][c][d] - facets->corners[facet[0]][c][d]) / 3.0;
    }
    const double squared = aur_dot3(way, way);
    for (size_t f = 0; f < 2; ++f)
        for (size_t c = 0; c < 3; ++c) {
            double edge[3];
            for (int d = 0; d < 3; ++d)
                edge[d] = facets->corners[facet[f]][(c + 1) % 3][d] - facets->corners[facet[f]][c][d];
            longest = fmax(longest, aur_dot3(edge, edge));
        }
    if (squared < 16.0 * longest)
        return false;
    const double most = 2.0 * facets->areas[facet[0]] * facets->areas[facet[1]] / (AUR_PI * squared);
    return expected_rays(work, i, k, most) < EXPECTED_RAYS;
}

/* The exchange of the pair; negative if it may be occluded. */
static double find_exchange(const finding *work, size_t i, size_t k) {
    const aur_facets *const facets = work->facets;
    const size_t facet[2] = {aur_facet_of(facets, i), aur_facet_of(facets, k)};
    double corners[2][3][3], first[AUR_HULL_CORNERS][3], second[AUR_HULL_CORNERS][3];
    aur_patch_corners(facets, i, corners[0]);
    aur_patch_corners(facets, k, corners[1]);
    const aur_plane planes[2] = {aur_patch_plane(facets, i), aur_patch_plane(facets, k)};
    const size_t counts[2] = {aur_polygon_clip(3, (const double(*)[3])corners[0], &planes[1], first),
                              aur_polygon_clip(3, (const double(*)[3])corners[1], &planes[0], second)};
    if (counts[0] == 0 || counts[1] == 0)
        return -1.0;
    double(*const polygons[2])[3] = {first, second};
    aur_hull hull;
    aur_hull_make(planes, counts, polygons, &hull);
    if (!aur_hull_is_empty(&hull, facets, work->tree, facet))
        return -1.0;
    return aur_contour_exchange(counts[0], (const double(*)[3])first, counts[1], (const double(*)[3])second);
}

static bool append(aur_closed_row *row, size_t *capacity, size_t patch, double exchange) {
    size_t other = *capacity;
    if (!aur_array_reserve(&row->patches, capacity, row->count + 1, sizeof *row->patches) ||
        !aur_array_reserve(&row->exchanges, &other, row->count + 1, sizeof *row->exchanges))
        return false;
    row->patches[row->count] = (uint32_t)patch;
    row->exchanges[row->count++] = exchange;
    return true;
}

static bool try_pair(const finding *work, size_t i, size_t k, size_t *capacity) {
    const aur_facets *const facets = work->facets;
    const size_t other = aur_facet_of(facets, k);
    if (i == k || !aur_pair_stands_with(facets, i, k) || facets->areas[other] == 0.0 ||
        aur_facets_are_sheet(facets, aur_facet_of(facets, i), other) ||
        (!work->all && is_hopeless(work, i, k)))
        return true;
    const double exchange = find_exchange(work, i, k);
    if (exchange < 0.0 || (!work->all && expected_rays(work, i, k, exchange) < EXPECTED_RAYS))
        return true;
    return append(&work->pairs->rows[i], capacity, k, exchange);
}

static bool find_row(const finding *work, size_t i) {
    const aur_ray_hits *const ray_hits = work->ray_hits;
    const size_t facet = aur_facet_of(work->facets, i);
    size_t capacity = 0;
    if (work->facets->areas[facet] == 0.0)
        return true;
    if (work->all) {
        for (size_t k = 0; k < ray_hits->patch_count; ++k)
            if (!try_pair(work, i, k, &capacity))
                return false;
        return true;
    }
    /* Both lists are sorted: patches hit by this patch, and patches whose rays hit this one. */
    const aur_ray_hits_row *const row = &ray_hits->rows[i];
    size_t out_index = 0, in_index = ray_hits->starts[i];
    while (out_index < row->count || in_index < ray_hits->starts[i + 1]) {
        const uint32_t a = out_index < row->count ? row->patches[out_index] : UINT32_MAX;
        const uint32_t b = in_index < ray_hits->starts[i + 1] ? ray_hits->sources[in_index] : UINT32_MAX;
        const uint32_t k = a < b ? a : b;
        out_index += a == k;
        in_index += b == k;
        if (!try_pair(work, i, k, &capacity))
            return false;
    }
    return true;
}

static aur_result find_block(void *context, size_t index) {
    const finding *const work = context;
    const size_t count = work->ray_hits->patch_count;
    for (size_t i = BLOCK * index; i < count && i < BLOCK * (index + 1); ++i)
        if (!find_row(work, i))
            return AUR_ERROR_MEMORY;
    return AUR_OK;
}

aur_result aur_closed_pairs_find(const aur_facets *facets, const aur_ray_hits *ray_hits,
                                 const aur_parallel_options *parallel, aur_closed_pairs *pairs,
                                 aur_error *error) {
    const size_t count = facets->patch_count;
    *pairs = (aur_closed_pairs){.patch_count = count, .rows = calloc(count, sizeof *pairs->rows)};
    if (pairs->rows == NULL)
        return aur_fail_memory(error);
    aur_box_tree tree = {0};
    aur_box *const boxes = malloc((facets->count + 1) * sizeof *boxes);
    aur_result result = boxes != NULL ? AUR_OK : aur_fail_memory(error);
    for (size_t i = 0; result == AUR_OK && i < facets->count; ++i)
        boxes[i] = aur_box_of(3, (const double(*)[3])facets->corners[i]);
    if (result == AUR_OK)
        result = aur_box_tree_create(facets->count, boxes, &tree, error);
    free(boxes);
    finding work = {facets, ray_hits, &tree, pairs, count <= SMALL_MESH};
    aur_parallel_options options = *parallel;
    options.what = "integrating along edges";
    if (result == AUR_OK) {
        result = aur_parallel_for(&options, (count + BLOCK - 1) / BLOCK, find_block, &work, error);
        aur_box_tree_release(&tree);
    }
    if (result != AUR_OK)
        aur_closed_pairs_release(pairs);
    return result;
}

void aur_closed_pairs_release(aur_closed_pairs *pairs) {
    for (size_t i = 0; i < pairs->patch_count && pairs->rows != NULL; ++i) {
        free(pairs->rows[i].patches);
        free(pairs->rows[i].exchanges);
    }
    free(pairs->rows);
    *pairs = (aur_closed_pairs){0};
}
