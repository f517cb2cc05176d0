/* A measure is one aur_measure_row, defined in the file that computes it, and one line in measures.h. */
#pragma once

#include <aureole/quality.h>
#include <stdbool.h>

#include "points/base/array.h"
#include "points/base/error.h"
#include "points/base/parallel.h"
#include "points/pointset/points.h"

/* The input of a measure: at least `minimum_count` points on one of its domains, with finite coordinates
 * inside the domain and finite weights with a positive sum. Directions have unit length and are contiguous;
 * aur_point_at returns points of the other domains. For rows with `masses` the points have weights, and they
 * add up to 1. Axes are passed as points of the sphere: the given directions in the first half of the points,
 * their opposites in the same order in the second half; likewise rotations, in four dimensions. */
typedef struct aur_measure_request {
    const aur_points_view *points;
    const char *parameter;       /* the text after the first ':', or NULL */
    size_t variant;              /* of the row */
    aur_measure_options options; /* cap_degrees is 0 if the cap is the whole domain */
    aur_arena *arena;            /* freed when the measure ends */
    double *bound;               /* of the value's error, for measures that used options.accuracy; else 0 */
} aur_measure_request;

typedef struct aur_measure_row {
    aur_measure_description description;
    size_t minimum_count; /* 0: 1 */
    bool masses;          /* weights are normalised, 1/N without weights; negative ones are an error */
    size_t variant;       /* distinguishes rows that share a function */
    /* One of the two, according to description.series. */
    aur_result (*compute)(const aur_measure_request *request, double *value, aur_error *error);
    aur_result (*tabulate)(const aur_measure_request *request, aur_series *series, aur_error *error);
} aur_measure_row;

struct aur_series {
    size_t row_count, column_count;
    const char *columns[AUR_SERIES_COLUMNS_MAX];
    double *values;
};

/* A number within [minimum, maximum] from the parameter, or `missing` when there is no parameter. */
aur_result aur_measure_number(const aur_measure_request *request, double minimum, double maximum,
                              double missing, double *value, aur_error *error);

/* Runs items of work with the threads and the progress of the options; `what` names it. `found` is the array
 * of all results, so that several processes can share the items (points/base/parallel.h); without data each
 * process runs all. */
aur_result aur_measure_items(const aur_measure_options *options, const char *what, size_t count,
                             aur_parallel_function function, void *context, aur_parallel_slice found,
                             aur_error *error);

/* The same for rows of a triangle: item i takes time proportional to i. */
aur_result aur_measure_rows(const aur_measure_options *options, const char *what, size_t count,
                            aur_parallel_function function, void *context, aur_parallel_slice found,
                            aur_error *error);

static inline double aur_weight_at(const aur_points_view *points, size_t index) {
    return points->weights != NULL ? points->weights[index] : 1.0;
}

/* Sets the columns of the series and allocates rows * columns values. */
aur_result aur_series_create(aur_series *series, size_t row_count, size_t column_count,
                             const char *const *columns, aur_error *error);

/* The sum of squared weights (N without weights): the mean power of a random set's spectrum. */
double aur_sum_of_squares(const aur_points_view *points);

/* The smallest Euclidean distance of two of at least two points. */
aur_result aur_smallest_distance(const aur_measure_request *request, double *distance, aur_error *error);
