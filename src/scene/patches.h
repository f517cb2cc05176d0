/* Rows of patches that cover the sphere between circles of latitude: directions are drawn in proportion to
 * how bright the patches are. */
#pragma once

#include "core/vector.h"
#include "scene/distribution.h"

typedef struct aur_patches {
    size_t row_count, columns;
    aur_distribution rows;   /* by the integral of what is bright */
    aur_distribution *cells; /* [row_count], each over the columns, by what is bright */
} aur_patches;

/* radiance[row_count][columns], >= 0 and finite, and for each row how much the height, the cosine of the
 * polar angle, changes over it. Errors: MEMORY; it is to be released then too. */
aur_result aur_patches_create(aur_patches *patches, size_t row_count, size_t columns, const double *radiance,
                              const double *rises, aur_error *error);
void aur_patches_release(aur_patches *patches);

/* The patch that u (along the columns) and v (along the rows) in [0,1) fall on; they become what is left. The
 * integral must not be 0. */
void aur_patches_choose(const aur_patches *patches, float *u, float *v, size_t *column, size_t *row);

/* The integral over all directions of the radiance that was given. */
static inline double aur_patches_integral(const aur_patches *patches) {
    return patches->rows.total * 2.0 * AUR_PI / (double)patches->columns;
}

/* The density, a steradian, with which azimuth and height that are uniform in a patch are drawn. */
static inline float aur_patches_density(const aur_patches *patches, size_t column, size_t row) {
    const double *const sums = &patches->cells[row].sums[column];
    return (float)((sums[1] - sums[0]) / patches->rows.total * (double)patches->columns / (2.0 * AUR_PI));
}
