/* Symmetric spherical t-designs (Delsarte, Goethals and Seidel 1977; Womersley 2018): points whose mean with
 * equal weights is exact for polynomials up to degree t. The table has degrees to 51, computed by
 * scripts/t_design_table.py; larger ones are computed (design.h) and cached. The second half of the points
 * are the opposites of the first. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/error.h"
#include "points/base/file.h"
#include "points/sphere/sets/design.h"
#include "points/sphere/sets/reference.h"

/* VERSION: of the cached data. */
enum { VERSION = 1, SOLVED = (AUR_DESIGN_DEGREE_MAX - 51) / 2, SIZES = AUR_T_DESIGN_COUNT + SOLVED };

static const double points[][3] = {
#include "data/t_design.inc"
};

const aur_reference aur_t_designs[AUR_T_DESIGN_COUNT] = {
#include "data/t_design_sizes.inc"
};

static aur_reference reference_at(size_t index) {
    if (index < AUR_T_DESIGN_COUNT)
        return aur_t_designs[index];
    const size_t degree = aur_t_designs[AUR_T_DESIGN_COUNT - 1].degree + 2 * (index - AUR_T_DESIGN_COUNT + 1);
    const size_t half = aur_design_half(degree);
    return (aur_reference){(uint16_t)(2 * half), (uint16_t)degree, 0, (uint16_t)half};
}

/* One half of the points. */
typedef struct design {
    size_t rows;
    double points[][3];
} design;

/* Computes the points, or takes them from the cache. */
static aur_result solve(const char *name, const aur_reference *reference, design *solved, aur_error *error) {
    char key[64];
    size_t size;
    snprintf(key, sizeof key, "%s %d %u", name, VERSION, (unsigned)reference->degree);
    char *const found = aur_cache_file_read(name, key, &size);
    const size_t bytes = reference->rows * sizeof solved->points[0];
    const bool right = found != NULL && size == bytes;
    if (right)
        memcpy(solved->points, found, bytes);
    free(found);
    const aur_result result = right ? AUR_OK : aur_design_solve(reference->degree, solved->points[0], error);
    if (result == AUR_OK && !right)
        aur_cache_file_write(name, key, bytes, solved->points);
    return result;
}

static aur_result prepare(const aur_row *row, aur_parameters *parameters, const aur_native_request *request,
                          void **data, aur_error *error) {
    (void)parameters;
    aur_reference all[SIZES];
    for (size_t i = 0; i < SIZES; ++i)
        all[i] = reference_at(i);
    const aur_reference *found;
    aur_result result = aur_reference_find(row->name, SIZES, all, request, &found, error);
    if (result != AUR_OK)
        return result;
    design *const solved = malloc(sizeof *solved + found->rows * sizeof solved->points[0]);
    if (solved == NULL)
        return aur_fail_memory(error);
    solved->rows = found->rows;
    if (found - all < AUR_T_DESIGN_COUNT)
        memcpy(solved->points, points + found->first, found->rows * sizeof solved->points[0]);
    else
        result = solve(row->name, found, solved, error);
    if (result == AUR_OK)
        *data = solved;
    else
        free(solved);
    return result;
}

static void fill(const void *data, uint64_t first, size_t count, double *xyz) {
    const design *const solved = data;
    for (size_t i = 0; i < count; ++i) {
        const size_t at = (size_t)first + i;
        const double sign = at < solved->rows ? 1.0 : -1.0;
        for (size_t d = 0; d < 3; ++d)
            xyz[3 * i + d] = sign * solved->points[at % solved->rows][d];
    }
}

static uint64_t size_at(size_t index) {
    return index < SIZES ? reference_at(index).count : 0;
}

const aur_native_set aur_native_t_design = {
    .description = {.row = {.name = "t-design",
                            .summary = "symmetric spherical designs of degree 1, 3, .. 101: a plain mean is "
                                       "exact for polynomials",
                            .source = "Delsarte, Goethals, Seidel 1977; Womersley 2018"},
                    .domains = AUR_ON_SPHERE,
                    .dimensions = {3, 3},
                    .size_at = size_at,
                    .maximum_size = 5178},
    .prepare = prepare,
    .fill = fill,
};
