/* A user's points as a set: file:PATH, CSV or NPY, points of the square or the cube, and the other sets of
 * user_points.c. Sets have no weights: a file with weights is an error. */
#include <stdlib.h>
#include <string.h>

#include "points/pointset/points.h"
#include "points/pointset/set.h"

/* The whole text of the set: file:PATH or callback:NAME. */
typedef struct file_keys {
    const char *path;
} file_keys;

static const aur_key keys[] = {
    {AUR_KEY_OF_TEXT(file_keys, "PATH", path, NULL, "the file: file:PATH")},
};

static aur_result prepare(aur_pointset *set, aur_parameters *parameters, aur_error *error) {
    file_keys p = {NULL};
    aur_result result = aur_row_read(&set->kind->description.row, parameters, &p, error);
    if (result != AUR_OK)
        return result;
    if (p.path == NULL || !aur_set_is_user(p.path) || strcmp(p.path, "file:") == 0)
        return aur_fail(error, AUR_ERROR_FORMAT, "a file of points is named by file:PATH");
    const char *const path = strchr(p.path, ':') + 1;
    aur_points *points;
    result = aur_user_points(
        &(const aur_user_request){p.path, set->size, set->dimension, &(const aur_domain){AUR_DOMAIN_CUBE}},
        &points, error);
    if (result != AUR_OK)
        return result;
    const aur_location where = {.file = path};
    if (set->options->count == 0)
        set->size = points->view.count;
    if (set->options->dimension == 0)
        set->dimension = points->view.dimension;
    if (set->size > points->view.count)
        result =
            aur_fail_at(error, where, AUR_ERROR_ARGUMENT, "the file has only %zu points", points->view.count);
    else if (set->dimension != points->view.dimension)
        result = aur_fail_at(error, where, AUR_ERROR_ARGUMENT, "the points have %zu coordinates, not %zu",
                             points->view.dimension, set->dimension);
    else if (aur_points_weighted(&points->view))
        result = aur_fail_at(error, where, AUR_ERROR_UNSUPPORTED,
                             "the points have weights (the column w), which sets have not: leave the column "
                             "out");
    if (result == AUR_OK) {
        aur_points_warn_of_prefix(&points->view, set->size, path, &set->options->warnings);
        set->data = points->coordinates;
        points->coordinates = NULL;
    }
    aur_points_destroy(points);
    return result;
}

const aur_square_set aur_set_file = {
    .description = {.row = {.name = "file",
                            .summary = "points from CSV or NPY: a file, or one for each size (NAME-%d.csv)",
                            .source = "the user",
                            AUR_ROW_KEYS(keys)},
                    .domains = AUR_ON_SQUARE | AUR_ON_CUBE,
                    .dimensions = {1, SIZE_MAX},
                    .maximum_size = UINT64_MAX,
                    .sized_by_file = true,
                    .extensible = true},
    .scramblings = AUR_SCRAMBLES_SHIFT,
    .prepare = prepare,
    .fill = aur_fill_table,
};
