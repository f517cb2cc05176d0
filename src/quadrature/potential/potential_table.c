#include "quadrature/potential/potential_table.h"

#include <math.h>
#include <stdlib.h>

#include "core/error.h"
#include "core/vector.h"

struct aur_potential_table {
    size_t angle_count, exponent_count;
    double largest; /* log(1 + m) of the last row */
    double *z;      /* a row an exponent */
};

aur_result aur_potential_table_create(const aur_z_grid *grid, double smoothness, aur_potential_table **table,
                                      aur_error *error) {
    const size_t angle_count = grid->angle_count, exponent_count = grid->exponent_count;
    const double largest_exponent = grid->largest_exponent;
    *table = NULL;
    if (angle_count < 2 || exponent_count < 2 || angle_count > 1 << 16 || exponent_count > 1 << 12)
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "a table of z has 2 to 65536 angles and 2 to 4096 lobe widths, not %zu and %zu",
                        angle_count, exponent_count);
    if (!(largest_exponent > 0.0 && largest_exponent <= AUR_EXPONENT_MAXIMUM))
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "the largest exponent must be above 0 and at most %g, not %g", AUR_EXPONENT_MAXIMUM,
                        largest_exponent);
    aur_potential_table *const created = calloc(1, sizeof *created);
    double *const z = malloc((angle_count * exponent_count + 3 * angle_count) * sizeof *z);
    if (created == NULL || z == NULL) {
        free(created);
        free(z);
        return aur_fail_memory(error);
    }
    *created = (aur_potential_table){angle_count, exponent_count, log1p(largest_exponent), z};
    double *const xyz = z + angle_count * exponent_count;
    for (size_t i = 0; i < angle_count; ++i) {
        const double theta = AUR_PI * (double)i / (double)(angle_count - 1);
        xyz[3 * i] = sin(theta);
        xyz[3 * i + 1] = 0.0;
        xyz[3 * i + 2] = cos(theta);
    }
    aur_result result = AUR_OK;
    for (size_t j = 0; j < exponent_count && result == AUR_OK; ++j) {
        const double m = expm1(created->largest * (double)j / (double)(exponent_count - 1));
        const aur_density density = {.size = sizeof density, .exponent = m};
        aur_potential *potential;
        result = aur_potential_create(&density, smoothness, &potential, error);
        if (result == AUR_OK)
            aur_potential_evaluate(potential, angle_count, xyz, z + j * angle_count);
        aur_potential_destroy(potential);
    }
    if (result != AUR_OK) {
        aur_potential_table_destroy(created);
        return result;
    }
    *table = created;
    return AUR_OK;
}

void aur_potential_table_destroy(aur_potential_table *table) {
    if (table == NULL)
        return;
    free(table->z);
    free(table);
}

/* The cell that `position` of `count` places is in, and how far: position in [0, count - 1]. */
static size_t cell(double position, size_t count, double *part) {
    const double inside = fmax(0.0, fmin(position, (double)(count - 1)));
    const size_t index = (size_t)fmin(inside, (double)(count - 2));
    *part = inside - (double)index;
    return index;
}

void aur_potential_table_evaluate(const aur_potential_table *table, double exponent, size_t count,
                                  const double *cosines, double *z) {
    double across;
    const size_t row = cell(log1p(exponent) / table->largest * (double)(table->exponent_count - 1),
                            table->exponent_count, &across);
    const double *const lower = table->z + row * table->angle_count;
    const double *const upper = lower + table->angle_count;
    for (size_t i = 0; i < count; ++i) {
        const double theta = acos(fmax(-1.0, fmin(1.0, cosines[i])));
        double along;
        const size_t at = cell(theta / AUR_PI * (double)(table->angle_count - 1), table->angle_count, &along);
        z[i] = (1.0 - across) * ((1.0 - along) * lower[at] + along * lower[at + 1]) +
               across * ((1.0 - along) * upper[at] + along * upper[at + 1]);
    }
}
