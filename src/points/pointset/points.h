/* Points in arrays: those that the library keeps, and reading a view of somebody's. */
#pragma once

#include <aureole/pointset.h>
#include <stdio.h>

struct aur_points {
    aur_points_view view; /* of the arrays below */
    double *coordinates, *weights;
    size_t *lines;
};

/* Room for `count` points one after another, and for their weights where they are weighted. Errors: MEMORY.
 */
aur_result aur_points_create(aur_domain domain, uint64_t count, size_t dimension, bool weighted,
                             aur_points **points, aur_error *error);

/* The caller's view as this library knows it, with its stride. Errors: ARGUMENT for an unknown domain or a
 * stride below the dimension. */
aur_result aur_points_view_read(const aur_points_view *given, aur_points_view *view, aur_error *error);

/* The name of a column: u,v on the square, x,y on the disk, x,y,z on the sphere, u1,u2,... on the cube,
 * w,x,y,z or m11,m12,... of rotations. */
enum { AUR_COLUMN_NAME_CAPACITY = 24 };
void aur_points_column_name(const aur_points_view *points, size_t column,
                            char name[AUR_COLUMN_NAME_CAPACITY]);
/* The line of a CSV file that names the columns, those of weights too: w, w2, ..., and weight, weight2, ...
 * of rotations. */
void aur_points_write_header(const aur_points_view *points, size_t weights, FILE *stream);

/* Whether there are weights, and they are not all 1/N, which say nothing. */
bool aur_points_weighted(const aur_points_view *points);

/* Whether these are directions with z >= 0, or axes: without their domain's name they could be of several. */
bool aur_points_are_above(const aur_points_view *points);

/* Warns where a pattern is the first `used` of a file's points, and not all. */
void aur_points_warn_of_prefix(const aur_points_view *points, uint64_t used, const char *path,
                               const aur_warnings *warnings);
/* Warns where only the numbers said what domain the points of a file are of. */
void aur_points_warn_of_guess(const aur_points_view *points, const char *path, const aur_warnings *warnings);

/* The sets of the user: file:PATH, a file for each size (file:NAME-%d.csv, file:FOLDER), callback:NAME. */
typedef struct aur_user_request {
    const char *set;
    uint64_t count;           /* of the set; 0: all points of file:PATH, which the other sets refuse */
    size_t dimension;         /* of a callback's cube; 0: 2 */
    const aur_domain *domain; /* where the points must be, as in aur_points_read; or NULL */
} aur_user_request;

/* Whether a SET's text is one of them. */
bool aur_set_is_user(const char *set);
/* Makes the points of the set; file:PATH has all of its points, the others have `count`. Errors: those of
 * aur_points_read, NAME for a callback that is not registered, ARGUMENT where a count is needed, FORMAT for a
 * file with another number of points than its name says. */
aur_result aur_user_points(const aur_user_request *request, aur_points **points, aur_error *error);

static inline const double *aur_point_at(const aur_points_view *points, size_t index) {
    return points->coordinates + index * points->stride;
}
