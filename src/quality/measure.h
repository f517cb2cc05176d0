/* The table of measures: a measure is one descriptor, defined in the file that computes it, and one line in
 * measure.c. */
#ifndef AUR_QUALITY_MEASURE_H
#define AUR_QUALITY_MEASURE_H

#include <aureole/quality.h>

#include "core/error.h"

/* What a measure is given: points on one of its domains, at least `minimum_count` of them, finite coordinates
 * inside the domain (directions scaled to unit length), finite weights with a positive sum. */
typedef struct aur_measure_request {
    const aur_points *points;
    const char *parameter; /* what follows the first ':', or NULL */
    aur_measure_options options;
} aur_measure_request;

typedef struct aur_measure_row {
    aur_measure_description description;
    size_t minimum_count; /* 0 stands for 1 */
    int masses;           /* weights must not be negative */
    /* One of the two, as description.series says. */
    aur_result (*compute)(const aur_measure_request *request, double *value, aur_error *error);
    aur_result (*tabulate)(const aur_measure_request *request, aur_series *series, aur_error *error);
} aur_measure_row;

/* A number within [minimum, maximum] from the parameter, or `missing` when there is no parameter. */
aur_result aur_measure_number(const aur_measure_request *request, double minimum, double maximum,
                              double missing, double *value, aur_error *error);

/* Gives the series its columns and room for rows * columns values. */
aur_result aur_series_create(aur_series *series, size_t row_count, size_t column_count,
                             const char *const *columns, aur_error *error);

extern const aur_measure_row aur_measure_energy;
extern const aur_measure_row aur_measure_scd;
extern const aur_measure_row aur_measure_l2_cap;
extern const aur_measure_row aur_measure_l2_cap_mean;
extern const aur_measure_row aur_measure_riesz;
extern const aur_measure_row aur_measure_cap;
extern const aur_measure_row aur_measure_cap_bound;
extern const aur_measure_row aur_measure_min_distance;
extern const aur_measure_row aur_measure_covering;
extern const aur_measure_row aur_measure_mesh_ratio;
extern const aur_measure_row aur_measure_voronoi_min;
extern const aur_measure_row aur_measure_voronoi_max;
extern const aur_measure_row aur_measure_voronoi_deviation;
extern const aur_measure_row aur_measure_voronoi;
extern const aur_measure_row aur_measure_star_bound;
extern const aur_measure_row aur_measure_net;
extern const aur_measure_row aur_measure_spectrum;
extern const aur_measure_row aur_measure_periodogram;
extern const aur_measure_row aur_measure_wce;
extern const aur_measure_row aur_measure_star;
extern const aur_measure_row aur_measure_l2_star;
extern const aur_measure_row aur_measure_centered;
extern const aur_measure_row aur_measure_wraparound;

#endif
