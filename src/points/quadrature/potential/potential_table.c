#include "points/quadrature/potential/potential.h"

#include <math.h>
#include <stdlib.h>

#include "points/base/error.h"
#include "points/base/vector.h"

struct aur_potential_table {
    aur_z_grid grid;
    double z[]; /* one row per exponent, followed by the directions of the columns */
};

aur_result aur_potential_table_create(const aur_z_grid *grid, double smoothness, aur_potential_table **table,
                                      aur_error *error) {
    const size_t angles = grid->angle_count, exponents = grid->exponent_count;
    *table = NULL;
    if (angles < 2 || exponents < 2 || angles > 1 << 16 || exponents > 1 << 12)
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "a table of z has 2 to 65536 angles and 2 to 4096 lobe widths, not %zu and %zu",
                        angles, exponents);
    if (!(grid->largest_exponent > 0.0 && grid->largest_exponent <= AUR_EXPONENT_MAXIMUM))
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "the largest exponent must be above 0 and at most %g, not %g", AUR_EXPONENT_MAXIMUM,
                        grid->largest_exponent);
    aur_potential_table *const created =
        malloc(sizeof *created + (exponents + 3) * angles * sizeof created->z[0]);
    if (created == NULL)
        return aur_fail_memory(error);
    created->grid = *grid;
    double *const xyz = created->z + exponents * angles;
    for (size_t i = 0; i < angles; ++i) {
        const double theta = AUR_PI * (double)i / (double)(angles - 1);
        xyz[3 * i] = sin(theta);
        xyz[3 * i + 1] = 0.0;
        xyz[3 * i + 2] = cos(theta);
    }
    const double largest = log1p(grid->largest_exponent);
    aur_result result = AUR_OK;
    for (size_t j = 0; j < exponents && result == AUR_OK; ++j) {
        const double m = expm1(largest * (double)j / (double)(exponents - 1));
        const aur_density density = {.size = sizeof density, .exponent = m};
        aur_potential *potential;
        result = aur_potential_create(&density, smoothness, &potential, error);
        if (result == AUR_OK)
            aur_potential_evaluate(potential, angles, xyz, created->z + j * angles);
        aur_potential_destroy(potential);
    }
    if (result == AUR_OK)
        *table = created;
    else
        free(created);
    return result;
}

void aur_potential_table_destroy(aur_potential_table *table) {
    free(table);
}

/* The cell of `position` among `count` nodes, and the fraction within it: position in [0, count - 1]. */
static size_t cell(double position, size_t count, double *part) {
    const double inside = fmax(0.0, fmin(position, (double)(count - 1)));
    const size_t index = (size_t)fmin(inside, (double)(count - 2));
    *part = inside - (double)index;
    return index;
}

void aur_potential_table_evaluate(const aur_potential_table *table, double exponent, size_t count,
                                  const double *cosines, double *z) {
    double across;
    const aur_z_grid *const grid = &table->grid;
    const size_t row =
        cell(log1p(exponent) / log1p(grid->largest_exponent) * (double)(grid->exponent_count - 1),
             grid->exponent_count, &across);
    const double *const lower = table->z + row * grid->angle_count;
    const double *const upper = lower + grid->angle_count;
    for (size_t i = 0; i < count; ++i) {
        const double theta = acos(fmax(-1.0, fmin(1.0, cosines[i])));
        double along;
        const size_t at = cell(theta / AUR_PI * (double)(grid->angle_count - 1), grid->angle_count, &along);
        z[i] = (1.0 - across) * ((1.0 - along) * lower[at] + along * lower[at + 1]) +
               across * ((1.0 - along) * upper[at] + along * upper[at + 1]);
    }
}
