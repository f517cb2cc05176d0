/* A user's own points as a set: file:PATH, CSV or NPY, points of the square or the cube. Their weights, if
 * there are any, are no part of the set. */
#include <stdlib.h>
#include <string.h>

#include "pointset/set.h"

static aur_result prepare(aur_pointset *set, aur_parameters *keys, const aur_pointset_options *options,
                          aur_error *error) {
    const aur_parameter *const item = aur_parameters_find(keys, "path");
    if (item == NULL || item->text[0] == '\0')
        return aur_fail(error, AUR_ERROR_FORMAT, "a file of points is named by file:PATH");
    const char *const path = item->text;
    aur_points points;
    aur_result result = aur_points_read_on(path, AUR_DOMAIN_CUBE, &points, error);
    if (result != AUR_OK)
        return result;
    const aur_location where = {.file = path};
    if (options->count == 0)
        set->size = points.count;
    if (options->dimension == 0)
        set->dimension = points.dimension;
    if (set->size > points.count)
        result = aur_fail_at(error, where, AUR_ERROR_ARGUMENT, "the file has only %zu points", points.count);
    else if (set->dimension != points.dimension)
        result = aur_fail_at(error, where, AUR_ERROR_ARGUMENT, "the points have %zu coordinates, not %zu",
                             points.dimension, set->dimension);
    if (result == AUR_OK) {
        set->data = points.coordinates;
        points.coordinates = NULL;
    }
    aur_points_release(&points);
    return result;
}

const aur_square_set aur_set_file = {
    .description = {.name = "file",
                    .keys = "file:PATH",
                    .summary = "points from a CSV or NPY file",
                    .domains = "square, cube",
                    .sizes = "up to the file's",
                    .extensible = 1,
                    .source = "the user"},
    .minimum_dimension = 1,
    .maximum_dimension = SIZE_MAX,
    .maximum_size = UINT64_MAX,
    .own_size = true,
    .scramblings = AUR_SCRAMBLES_SHIFT,
    .prepare = prepare,
    .fill = aur_fill_table,
};
