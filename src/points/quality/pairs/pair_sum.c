#include "points/quality/pairs/pair_sum.h"

#include <stdlib.h>
#include <string.h>

#include "points/base/simd.h"

aur_result aur_axes_create(const aur_points_view *points, aur_axes *axes, aur_error *error) {
    const size_t padded = (points->count + 7) / 8 * 8;
    const size_t size = (points->weights != NULL ? 4 : 3) * padded * sizeof(double);
    double *const values = aligned_alloc(64, size);
    if (values == NULL)
        return aur_fail_memory(error);
    memset(values, 0, size);
    *axes = (aur_axes){.count = points->count,
                       .x = values,
                       .y = values + padded,
                       .z = values + 2 * padded,
                       .weights = points->weights != NULL ? values + 3 * padded : NULL};
    for (size_t i = 0; i < points->count; ++i) {
        axes->x[i] = points->coordinates[3 * i];
        axes->y[i] = points->coordinates[3 * i + 1];
        axes->z[i] = points->coordinates[3 * i + 2];
        if (axes->weights != NULL)
            axes->weights[i] = points->weights[i];
    }
    return AUR_OK;
}

void aur_axes_release(aur_axes *axes) {
    free(axes->x);
    *axes = (aur_axes){0};
}

/* The tiles of the lower triangle, row by row: tile (r, c) with c <= r has the number r (r + 1) / 2 + c. */
typedef struct tiles {
    const aur_axes *axes;
    aur_pair_tile_function function;
    double parameter;
    aur_twofold *sums;
} tiles;

static size_t least(size_t a, size_t b) {
    return a < b ? a : b;
}

static aur_result sum_tile(void *context, size_t index) {
    const tiles *const work = context;
    size_t row = (size_t)((sqrt(8.0 * (double)index + 1.0) - 1.0) / 2.0);
    while (row * (row + 1) / 2 > index)
        --row;
    while ((row + 1) * (row + 2) / 2 <= index)
        ++row;
    const size_t column = index - row * (row + 1) / 2;
    const size_t count = work->axes->count;
    const aur_pair_tile tile = {row * AUR_TILE_POINTS, least((row + 1) * AUR_TILE_POINTS, count),
                                column * AUR_TILE_POINTS, least((column + 1) * AUR_TILE_POINTS, count)};
    work->sums[index] = work->function(work->axes, tile, work->parameter);
    return AUR_OK;
}

aur_result aur_pair_sum(const aur_axes *axes, aur_pair_tile_function function, double parameter,
                        const aur_measure_options *options, aur_twofold *sum, aur_error *error) {
    const size_t side = (axes->count + AUR_TILE_POINTS - 1) / AUR_TILE_POINTS;
    const size_t count = side * (side + 1) / 2;
    tiles work = {axes, function, parameter, malloc(count * sizeof *work.sums)};
    if (work.sums == NULL)
        return aur_fail_memory(error);
    const aur_result result = aur_measure_items(
        options, "summing pairs", count, sum_tile, &work,
        (aur_parallel_slice){work.sums, sizeof *work.sums, count * sizeof *work.sums}, error);
    *sum = (aur_twofold){0.0, 0.0};
    for (size_t i = 0; i < count && result == AUR_OK; ++i)
        *sum = aur_twofold_add(*sum, work.sums[i]);
    free(work.sums);
    return result;
}

aur_result aur_distance_sum(const aur_axes *axes, const aur_measure_options *options, aur_twofold *sum,
                            aur_error *error) {
    const aur_distance_kernels *const kernels = &AUR_KERNEL_HERE(aur_distance);
    const bool fast = options->fast && axes->weights == NULL;
    return aur_pair_sum(axes, fast ? kernels->fast : kernels->exact, 0.0, options, sum, error);
}
