/* Quality measures of point sets.
 *
 * A measure is named NAME[:PARAMETER] everywhere (energy, riesz:1, ...). Coordinates have the layout of
 * aur_points_view. Directions within 1e-6 of unit length are normalised; others are an error. Weights are
 * masses and are divided by their sum (except for wce, which uses them unchanged); without weights each point
 * has the mass 1/N. Distances are chords, angles radians, areas of Voronoi cells in units of the mean area.
 */
#ifndef AUREOLE_QUALITY_H
#define AUREOLE_QUALITY_H

#include <aureole/sphere.h>
#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

/* One row of the table of measures. */
typedef struct aur_measure_description {
    aur_row row;           /* name, summary and source; a measure has a parameter instead of keys */
    const char *parameter; /* ":S" for riesz:S, "[:B]" where it is optional, NULL for none */
    const char *domains;   /* "sphere, hemisphere, caps": the first is the default */
    bool bound;            /* the value is a lower bound of the measure */
    bool series;           /* a table rather than one value: call aur_measure_series */
} aur_measure_description;

AUR_API size_t aur_measure_count(void);
AUR_API const aur_measure_description *aur_measure_at(size_t index); /* NULL beyond the table */

/* The row of NAME[:PARAMETER]; the parameter's value is not checked. Errors: NAME, with the nearest name;
 * ARGUMENT for a missing or superfluous parameter. */
AUR_API aur_result aur_measure_find(const char *metric, const aur_measure_description **description,
                                    aur_error *error) AUR_NONNULL(1, 2);

typedef struct aur_measure_options {
    size_t size;    /* sizeof the caller's struct */
    size_t threads; /* 0: all */
    bool fast;      /* sums over pairs to 2e-14 relative instead of to rounding, in half the time */
    uint64_t seed;  /* of measures with a random search */
    aur_progress progress;
    aur_warnings warnings;
    /* 0: sums over all pairs, to rounding. Else the allowed relative error (below 1). Energies and riesz:S,
     * -1.95 < S <= 16, of directions then take about N^1.2 time (Ewald 1921, by spherical harmonics), where
     * that is faster and the error bound suffices; spectrum and periodogram use Fourier transforms of grids,
     * with an error of no more than this times the larger of 1 and the power. */
    double accuracy;
    /* 0: all of the domain. Else the points are on the cap of this polar angle about +z, at most 90 degrees
     * on the hemisphere and 180 on the sphere: covering, mesh-ratio and areas of cells end at its rim;
     * min-distance, min-angle and riesz:S use pairs of points only; other measures are an error. */
    double cap_degrees;
} aur_measure_options;

AUR_API aur_result aur_measure_options_init(aur_measure_options *options, aur_error *error) AUR_NONNULL(1);

/* Computes one measure, by name, of points with optional weights. `options` may be NULL. The result does not
 * depend on the number of threads. The value is finite except for riesz:S with S >= 0 and mesh-ratio of
 * coincident points, which are infinite. Errors: NAME, ARGUMENT (a parameter, a point or a weight that is out
 * of range, too few points, a stride below the dimension), UNSUPPORTED for a measure that is not defined on
 * the points' domain, CANCELLED, MEMORY. When one point is invalid, the message counts points from 1, and
 * error->line is the point's line if points->lines is set. */
AUR_API aur_result aur_measure(const char *metric, const aur_points_view *points,
                               const aur_measure_options *options, double *value, aur_error *error)
    AUR_NONNULL(1, 2, 4);

/* The same with a bound of the value's error: 0 where it is exact to rounding, else at most options->accuracy
 * times the value. */
AUR_API aur_result aur_measure_bounded(const char *metric, const aur_points_view *points,
                                       const aur_measure_options *options, double *value, double *bound,
                                       aur_error *error) AUR_NONNULL(1, 2, 4, 5);

enum { AUR_SERIES_COLUMNS_MAX = 6 };

/* A table computed by a measure. */
typedef struct aur_series aur_series;

AUR_API size_t aur_series_row_count(const aur_series *series) AUR_NONNULL(1);
AUR_API size_t aur_series_column_count(const aur_series *series) AUR_NONNULL(1);
/* The name of a column, static storage; NULL beyond the last. No table has more than AUR_SERIES_COLUMNS_MAX.
 */
AUR_API const char *aur_series_column(const aur_series *series, size_t column) AUR_NONNULL(1);
/* The number at row * column count + column, valid as long as the series. */
AUR_API const double *aur_series_values(const aur_series *series) AUR_NONNULL(1);
AUR_API void aur_series_destroy(aur_series *series); /* NULL is allowed */

/* A measure that is a table: `series` is set in its description. Errors as for aur_measure; UNSUPPORTED for a
 * measure that is one value; *series is then NULL. Free with aur_series_destroy. */
AUR_API aur_result aur_measure_series(const char *metric, const aur_points_view *points,
                                      const aur_measure_options *options, aur_series **series,
                                      aur_error *error) AUR_NONNULL(1, 2, 4);

/* weights[count] of unit vectors xyz[3 * count] on the SPHERE or the HEMISPHERE, or of AXES: the area of each
 * point's Voronoi cell times the density of the lobe at the point (NULL: uniform; others on the hemisphere),
 * scaled to sum 1; with options->cap_degrees cells end at the cap's rim, and the lobe is uniform; with GGX
 * points below the surface (z < 0) have weight 0. Coincident points share their cell. The weights are exact
 * for functions that are constant within each cell; exact.h has weights that are exact for smooth functions.
 * `options` may be NULL. Errors: ARGUMENT for a vector that is not of unit length or lies outside the domain;
 * UNSUPPORTED for cells that reach 90 degrees from their points, as with few points, and for other domains
 * and lobes; CAPACITY where `capacity` weights are fewer than `count`; MEMORY; CANCELLED. */
AUR_API aur_result aur_weights_voronoi(size_t count, const double *xyz, aur_domain domain,
                                       const aur_lobe *lobe, const aur_measure_options *options,
                                       size_t capacity, double *weights, aur_error *error) AUR_NONNULL(2, 7);

#ifdef __cplusplus
}
#endif

#endif
