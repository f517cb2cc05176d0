/* Daylight coefficients of one sensor: its illuminance per radiance of each sky patch, by one trace. */
#pragma once

#include <aureole-lighting/daylight.h>
#include <stdio.h>

#include "lighting/daylight/hours.h"
#include "lighting/daylight/product.h"
#include "lighting/irradiance/sensor_trace.h"
#include "render/scene/lights/sky_model.h"

/* The radiance of the ground in the traced scene; nonzero, so that its contribution is sampled as well as the
 * sky's. */
static const double AUR_DAYLIGHT_GROUND = 0.25;

typedef struct aur_coefficients {
    const aur_sky_patches *patches;
    const aur_open_sky *sky;
    size_t channels;      /* 1 to 3 */
    double weights[3][3]; /* weights of r, g, b in each channel */
    /* [channels][patches][16]: illuminance per radiance in each randomisation; of all light, and of reflected
     * light. */
    double *all, *reflected;
} aur_coefficients;

/* Shared by all sensors: the scene below an open sky, its patches, and directions. */
typedef struct aur_coefficient_trace {
    aur_path path;
    bool panes;
    aur_sampler *sampler;
    aur_sensor_rule rule;
    aur_sky_patches patches;
    aur_open_sky sky;
} aur_coefficient_trace;

/* The options must have their defaults filled in. Errors: as aur_daylight_estimate. On failure the caller
 * still calls aur_coefficient_trace_release. */
aur_result aur_coefficient_trace_create(const aur_scene *scene, const aur_daylight_options *options,
                                        aur_coefficient_trace *trace, aur_error *error);
void aur_coefficient_trace_release(aur_coefficient_trace *trace); /* may be zero */

/* Defaults filled in, ranges checked. */
aur_result aur_daylight_options_read(const aur_daylight_options *given, aur_daylight_options *options,
                                     aur_error *error);

/* Fills all[] and reflected[]. */
void aur_coefficients_find(aur_path_group *group, const aur_sensor_rule *rule, const aur_sensor_point *point,
                           const aur_coefficients *coefficients, aur_sensor_sums *sums);

/* seen[lit->count][16]: the illuminance directly from the sun in each hour, by one point of its disk per
 * randomisation. */
void aur_sun_seen(aur_path_group *group, const aur_sensor_point *point, const aur_coefficients *coefficients,
                  const aur_lit_hours *lit, double *seen);

/* The measures of a sensor from a year of illuminances. */

/* Illuminances of the lit hours, lux, sixteen randomisations per hour: of all light, and of direct sunlight.
 * `overcast` are the daylight factors. */
typedef struct aur_daylight_year {
    const double *all, *sun, *overcast;
} aur_daylight_year;

/* The measures of the mean over the randomisations, with jackknife standard errors (leave one randomisation
 * out). These equal the standard error for linear measures (daylight factor, annual sum), and are close to it
 * for shares of many hours. `scratch` has room for twice the lit hours. */
void aur_daylight_measure_year(const aur_lit_hours *lit, const aur_daylight_options *options,
                               const aur_daylight_year *year, double *scratch, aur_daylight *found);

/* A file of all hours of all sensors. */

/* values[sensors][2][hours]: illuminance and its standard error, lux, NaN for missing hours. The name ends in
 * .npy (that array, float64) or .csv (one line per hour and sensor). Errors: NAME (another ending), WRITE,
 * MEMORY. */
aur_result aur_daylight_series_check(const char *path, aur_error *error);
aur_result aur_daylight_series_write(const char *path, const aur_weather_view *weather, size_t sensors,
                                     const double *values, aur_error *error);

/* The header of an NPY file (1.0) of float64 with this shape, padded with blanks to a multiple of 64 bytes.
 */
void aur_daylight_npy_head(const char *shape, FILE *stream);
