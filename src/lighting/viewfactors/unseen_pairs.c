#include "lighting/viewfactors/closed_pairs.h"

#include <stdlib.h>
#include <string.h>

#include "points/base/array.h"

/* Rounding error of closed forms, relative to a patch's light. */
static const double SMALLEST_REST = 1e-11;

typedef struct filling {
    const aur_facets *facets;
    aur_ray_hits *ray_hits;
    aur_closed_pairs *pairs;
    double *exchanges; /* per patch: the sum of its closed forms; then upper bounds for the candidates of one
                        * patch */
    double *possible;
    bool open; /* light may leave the mesh */
} filling;

static int compare_patches(const void *left, const void *right) {
    const uint32_t a = *(const uint32_t *)left, b = *(const uint32_t *)right;
    return (a > b) - (a < b);
}

static bool is_closed(const filling *work, size_t i, size_t k) {
    const bool first = aur_pair_stands_with(work->facets, i, k);
    const aur_closed_row *const row = &work->pairs->rows[first ? i : k];
    const uint32_t other = (uint32_t)(first ? k : i);
    return row->count > 0 &&
           bsearch(&other, row->patches, row->count, sizeof *row->patches, compare_patches) != NULL;
}

/* The number of the patch's rays with targets that have no closed form, the sky and backs included. */
static double count_sampled(const filling *work, size_t i) {
    const aur_ray_hits *const ray_hits = work->ray_hits;
    const aur_ray_hits_row *const row = &ray_hits->rows[i];
    const size_t width = ray_hits->randomizations;
    double sum = 0.0;
    for (size_t r = 0; r < width; ++r)
        sum += ray_hits->sky[width * i + r] + ray_hits->back[width * i + r];
    for (size_t k = 0; k < row->count; ++k)
        for (size_t r = 0; r < width && !is_closed(work, i, row->patches[k]); ++r)
            sum += (double)row->hits[width * k + r];
    return sum;
}

/* Whether rays of others hit the patch without a closed form. */
static bool is_met(const filling *work, size_t i) {
    const aur_ray_hits *const ray_hits = work->ray_hits;
    const size_t width = ray_hits->randomizations;
    for (size_t k = ray_hits->starts[i]; k < ray_hits->starts[i + 1]; ++k) {
        const uint16_t *const hits =
            &ray_hits->rows[ray_hits->sources[k]].hits[width * (size_t)ray_hits->hit_indices[k]];
        for (size_t r = 0; r < width; ++r)
            if (hits[r] > 0 && !is_closed(work, i, ray_hits->sources[k]))
                return true;
    }
    return false;
}

/* The unoccluded exchange of two patches. */
static double free_exchange(const aur_facets *facets, size_t i, size_t k) {
    double corners[2][3][3], first[4][3], second[4][3];
    aur_patch_corners(facets, i, corners[0]);
    aur_patch_corners(facets, k, corners[1]);
    const aur_plane planes[2] = {aur_patch_plane(facets, i), aur_patch_plane(facets, k)};
    const size_t counts[2] = {aur_polygon_clip(3, (const double(*)[3])corners[0], &planes[1], first),
                              aur_polygon_clip(3, (const double(*)[3])corners[1], &planes[0], second)};
    if (counts[0] == 0 || counts[1] == 0)
        return 0.0;
    return aur_contour_exchange(counts[0], (const double(*)[3])first, counts[1], (const double(*)[3])second);
}

/* Inserts the pair into its row, whose patches ascend. */
static bool insert(const filling *work, size_t i, size_t k, double exchange) {
    const bool first = aur_pair_stands_with(work->facets, i, k);
    aur_closed_row *const row = &work->pairs->rows[first ? i : k];
    const uint32_t other = (uint32_t)(first ? k : i);
    size_t capacity = row->count, same = row->count, at = row->count;
    if (!aur_array_reserve(&row->patches, &capacity, row->count + 1, sizeof *row->patches) ||
        !aur_array_reserve(&row->exchanges, &same, row->count + 1, sizeof *row->exchanges))
        return false;
    for (; at > 0 && row->patches[at - 1] > other; --at) {
        row->patches[at] = row->patches[at - 1];
        row->exchanges[at] = row->exchanges[at - 1];
    }
    row->patches[at] = other;
    row->exchanges[at] = exchange;
    ++row->count;
    return true;
}

static bool fill_patch(const filling *work, size_t i, double rest) {
    const aur_facets *const facets = work->facets;
    const double area = facets->areas[aur_facet_of(facets, i)];
    double sum = 0.0;
    for (size_t k = 0; k < facets->patch_count; ++k) {
        const size_t other = aur_facet_of(facets, k);
        const bool candidate = i != k && facets->areas[other] > 0.0 && !is_closed(work, i, k);
        work->possible[k] = candidate ? free_exchange(facets, i, k) : 0.0;
        sum += work->possible[k];
    }
    const double sky = work->open ? fmax(0.0, area - sum) : 0.0;
    if (!(sum + sky > 0.0))
        return true;
    for (size_t k = 0; k < facets->patch_count; ++k) {
        const double exchange = rest * work->possible[k] / (sum + sky);
        if (exchange > 0.0 && !insert(work, i, k, exchange))
            return false;
        work->exchanges[k] += exchange; /* which now also counts for the other patch */
    }
    for (size_t r = 0; r < work->ray_hits->randomizations; ++r)
        work->ray_hits->sky[work->ray_hits->randomizations * i + r] =
            (double)work->ray_hits->rays * rest * sky / (sum + sky) / area;
    return true;
}

aur_result aur_unseen_pairs_fill(const aur_facets *facets, aur_ray_hits *ray_hits, aur_closed_pairs *pairs,
                                 aur_error *error) {
    const size_t count = facets->patch_count;
    double *const numbers = calloc(2 * count, sizeof *numbers);
    if (numbers == NULL)
        return aur_fail_memory(error);
    filling work = {facets, ray_hits, pairs, numbers, numbers + count, facets->open};
    for (size_t i = 0; i < count * ray_hits->randomizations; ++i)
        work.open |= ray_hits->sky[i] > 0.0;
    for (size_t i = 0; i < count; ++i)
        for (size_t k = 0; k < pairs->rows[i].count; ++k) {
            work.exchanges[i] += pairs->rows[i].exchanges[k];
            work.exchanges[pairs->rows[i].patches[k]] += pairs->rows[i].exchanges[k];
        }
    bool good = true;
    for (size_t i = 0; good && i < count; ++i) {
        const double area = facets->areas[aur_facet_of(facets, i)], rest = area - work.exchanges[i];
        if (work.exchanges[i] > 0.0 && rest > SMALLEST_REST * area && count_sampled(&work, i) == 0.0 &&
            !is_met(&work, i))
            good = fill_patch(&work, i, rest);
    }
    free(numbers);
    return good ? AUR_OK : aur_fail_memory(error);
}
