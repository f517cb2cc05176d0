/* Symmetric spherical t-designs (Delsarte, Goethals and Seidel 1977; Womersley 2018): points whose plain mean
 * is exact for polynomials up to degree t. scripts/t_design_table.py solves for them. The second half of the
 * points are the opposites of the first. */
#include "points/sphere/sets/reference.h"

#include <stdlib.h>

#include "points/base/error.h"

static const double points[][3] = {
#include "data/t_design.inc"
};

const aur_reference aur_t_designs[AUR_T_DESIGN_COUNT] = {
#include "data/t_design_sizes.inc"
};

static aur_result prepare(const aur_row *row, aur_parameters *parameters, const aur_native_request *request,
                          void **data, aur_error *error) {
    (void)parameters;
    const aur_reference *found;
    const aur_result result =
        aur_reference_find(row->name, AUR_T_DESIGN_COUNT, aur_t_designs, request, &found, error);
    if (result != AUR_OK)
        return result;
    aur_reference *const design = malloc(sizeof *design);
    if (design == NULL)
        return aur_fail_memory(error);
    *design = *found;
    *data = design;
    return AUR_OK;
}

static void fill(const void *data, uint64_t first, size_t count, double *xyz) {
    const aur_reference *const design = data;
    for (size_t i = 0; i < count; ++i) {
        const size_t at = (size_t)first + i;
        const double sign = at < design->rows ? 1.0 : -1.0;
        const double *const point = points[design->first + at % design->rows];
        for (size_t d = 0; d < 3; ++d)
            xyz[3 * i + d] = sign * point[d];
    }
}

static uint64_t size_at(size_t index) {
    return index < AUR_T_DESIGN_COUNT ? aur_t_designs[index].count : 0;
}

const aur_native_set aur_native_t_design = {
    .description = {.row = {.name = "t-design",
                            .summary = "symmetric spherical designs of degree 1, 3, .. 51: a plain mean is "
                                       "exact for polynomials",
                            .source = "Delsarte, Goethals, Seidel 1977; Womersley 2018"},
                    .domains = AUR_ON_SPHERE,
                    .dimensions = {3, 3},
                    .size_at = size_at,
                    .maximum_size = 1338},
    .prepare = prepare,
    .fill = fill,
};
