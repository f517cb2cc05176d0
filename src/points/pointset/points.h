/* Points in arrays: those owned by the library, and checks of a caller's view. */
#pragma once

#include <aureole/pointset.h>
#include <stdio.h>

struct aur_points {
    aur_points_view view; /* of the arrays below */
    double *coordinates, *weights;
    size_t *lines;
};

/* Allocates `count` contiguous points, and their weights if weighted. Errors: MEMORY. */
aur_result aur_points_create(aur_domain domain, uint64_t count, size_t dimension, bool weighted,
                             aur_points **points, aur_error *error);

/* The caller's view in the layout of this library, with its stride filled in. Errors: ARGUMENT for an unknown
 * domain or a stride below the dimension. */
aur_result aur_points_view_read(const aur_points_view *given, aur_points_view *view, aur_error *error);

/* The name of a column: u,v on the square, x,y on the disk, x,y,z on the sphere, u1,u2,... on the cube,
 * w,x,y,z or m11,m12,... for rotations. */
enum { AUR_COLUMN_NAME_CAPACITY = 24 };
void aur_points_column_name(const aur_points_view *points, size_t column,
                            char name[AUR_COLUMN_NAME_CAPACITY]);
/* The header line of a CSV file, including the columns of weights: w, w2, ..., or weight, weight2, ... for
 * rotations. */
void aur_points_write_header(const aur_points_view *points, size_t weights, FILE *stream);

/* Whether there are weights other than 1/N. */
bool aur_points_weighted(const aur_points_view *points);

/* Whether these are directions with z >= 0, or axes, which need a domain's name to be unambiguous. */
bool aur_points_are_above(const aur_points_view *points);

/* Warns if a pattern uses only the first `used` points of a file. */
void aur_points_warn_of_prefix(const aur_points_view *points, uint64_t used, const char *path,
                               const aur_warnings *warnings);
/* Warns if the domain of a file's points was guessed from its numbers. */
void aur_points_warn_of_guess(const aur_points_view *points, const char *path, const aur_warnings *warnings);

/* The sets of the user: file:PATH, a file for each size (file:NAME-%d.csv, file:FOLDER), callback:NAME. */
typedef struct aur_user_request {
    const char *set;
    uint64_t count;           /* of the set; 0: all points of file:PATH, an error for the other sets */
    size_t dimension;         /* of a callback's cube; 0: 2 */
    const aur_domain *domain; /* the required domain, as in aur_points_read; or NULL */
} aur_user_request;

/* Whether the text of a SET names one of them. */
bool aur_set_is_user(const char *set);
/* Reads or computes the points of the set: all points of file:PATH, `count` points of the others. Errors:
 * those of aur_points_read, NAME for a callback that is not registered, ARGUMENT if a count is required,
 * FORMAT for a file with a number of points that differs from its name. */
aur_result aur_user_points(const aur_user_request *request, aur_points **points, aur_error *error);

static inline const double *aur_point_at(const aur_points_view *points, size_t index) {
    return points->coordinates + index * points->stride;
}
