
#include <stdlib.h>

#include "render/scene/patches.h"

/* The guide table (Chen and Asau 1974): the item at k / count of the total, for k = 0 .. count. It gives the
 * start of the search and does not change its result. For sky maps, a binary search over all rows and cells
 * would cause about a dozen cache misses. Small distributions have no table. */
static uint32_t *guide_of(const aur_distribution *distribution) {
    const size_t count = distribution->count;
    return count >= 16 && count < UINT32_MAX && distribution->total > 0.0
               ? (uint32_t *)(distribution->sums + count + 1)
               : NULL;
}

static void make_guide(aur_distribution *distribution) {
    uint32_t *const guide = guide_of(distribution);
    const double count = (double)distribution->count;
    uint32_t item = 0;
    for (size_t k = 0; k <= distribution->count && guide != NULL; ++k) {
        while (item + 1 < distribution->count &&
               distribution->sums[item + 1] <= (double)k / count * distribution->total)
            ++item;
        guide[k] = item;
    }
}

aur_result aur_distribution_create(aur_distribution *distribution, size_t count, const double *weights,
                                   aur_error *error) {
    distribution->count = count;
    distribution->sums = malloc((count + 1) * (sizeof *distribution->sums + sizeof(uint32_t)));
    if (distribution->sums == NULL)
        return aur_fail_memory(error);
    distribution->sums[0] = 0.0;
    for (size_t i = 0; i < count; ++i)
        distribution->sums[i + 1] = distribution->sums[i] + weights[i];
    distribution->total = distribution->sums[count];
    make_guide(distribution);
    return AUR_OK;
}

void aur_distribution_release(aur_distribution *distribution) {
    free(distribution->sums);
    *distribution = (aur_distribution){0};
}

/* The interval of the guide table that contains u. */
static size_t interval_of(const aur_distribution *distribution, double u) {
    const double count = (double)distribution->count, guess = u * count;
    return guess < count ? (size_t)guess : distribution->count - 1;
}

void aur_distribution_prefetch_guide(const aur_distribution *distribution, double u) {
    const uint32_t *const guide = guide_of(distribution);
    if (guide != NULL)
        __builtin_prefetch(&guide[interval_of(distribution, u)]);
}

void aur_distribution_prefetch_items(const aur_distribution *distribution, double u) {
    const uint32_t *const guide = guide_of(distribution);
    if (guide == NULL)
        return;
    const size_t k = interval_of(distribution, u);
    __builtin_prefetch(&distribution->sums[guide[k]]);
    __builtin_prefetch(&distribution->sums[guide[k + 1] + 1]);
}

size_t aur_distribution_choose_double(const aur_distribution *distribution, double *u) {
    if (distribution->count == 1)
        return 0;
    const double target = *u * distribution->total;
    size_t low = 0;
    size_t high = distribution->count;
    const uint32_t *const guide = guide_of(distribution);
    if (guide != NULL) {
        const size_t k = interval_of(distribution, *u);
        const size_t first = guide[k], beyond = (size_t)guide[k + 1] + 1;
        /* Rounding may give an item outside of the interval. */
        if (distribution->sums[first] <= target)
            low = first;
        if (distribution->sums[beyond] > target)
            high = beyond;
    }
    while (high - low > 1) {
        const size_t middle = (low + high) / 2;
        if (distribution->sums[middle] <= target)
            low = middle;
        else
            high = middle;
    }
    /* Rounding may give an index after the last item of non-zero weight. */
    while (low > 0 && distribution->sums[low + 1] <= distribution->sums[low])
        --low;
    const double width = distribution->sums[low + 1] - distribution->sums[low];
    const double rest = (target - distribution->sums[low]) / width;
    *u = rest < 0.0 ? 0.0 : rest < 1.0 ? rest : 0x1.fffffffffffffp-1;
    return low;
}

size_t aur_distribution_choose(const aur_distribution *distribution, float *u) {
    double rest = *u;
    const size_t chosen = aur_distribution_choose_double(distribution, &rest);
    *u = (float)rest < 0x1.fffffep-1f ? (float)rest : 0x1.fffffep-1f;
    return chosen;
}

aur_result aur_patches_create(aur_patches *patches, size_t row_count, size_t columns, const double *radiance,
                              const double *rises, aur_error *error) {
    *patches = (aur_patches){.row_count = row_count, .columns = columns};
    double *const sums = malloc(row_count * sizeof *sums);
    patches->cells = calloc(row_count, sizeof *patches->cells);
    aur_result result = sums != NULL && patches->cells != NULL ? AUR_OK : aur_fail_memory(error);
    for (size_t j = 0; result == AUR_OK && j < row_count; ++j) {
        result = aur_distribution_create(&patches->cells[j], columns, radiance + j * columns, error);
        sums[j] = patches->cells[j].total * rises[j];
    }
    if (result == AUR_OK)
        result = aur_distribution_create(&patches->rows, row_count, sums, error);
    free(sums);
    return result;
}

void aur_patches_release(aur_patches *patches) {
    for (size_t j = 0; patches->cells != NULL && j < patches->row_count; ++j)
        aur_distribution_release(&patches->cells[j]);
    free(patches->cells);
    aur_distribution_release(&patches->rows);
    *patches = (aur_patches){0};
}

void aur_patches_choose(const aur_patches *patches, float *u, float *v, size_t *column, size_t *row) {
    *row = aur_distribution_choose(&patches->rows, v);
    *column = aur_distribution_choose(&patches->cells[*row], u);
}
