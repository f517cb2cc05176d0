#include "render/scene/patches.h"

#include <stdlib.h>

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
