/* The parts of `aureole irradiance`. */
#pragma once

#include <aureole-lighting/daylight.h>
#include <aureole-lighting/irradiance.h>

#include "program/cli/options.h"

/* Draws the luminance of each sensor at its position, projected along the axis of least extent: cells with
 * contours for a grid of sensors, otherwise dots. `unit` labels the color scale; NULL: "luminance". Errors:
 * MEMORY, WRITE. */
aur_result cli_irradiance_plot(const char *path, const char *unit, const aur_sensors_view *sensors,
                               const aur_irradiance *results, aur_error *error);

/* Options of `aureole irradiance --weather`: a year of weather at sensors. */

typedef struct cli_daylight {
    const char *weather;  /* NULL: no annual simulation */
    const char *metrics;  /* a file for metrics over all sensors; NULL: none */
    const char *schedule; /* hours to count, or a file of them; NULL: 8-18 */
    bool coefficients;    /* write daylight coefficients instead of annual values */
    aur_daylight_options options;
} cli_daylight;
extern const cli_option cli_daylight_options[]; /* of a cli_daylight */

/* Front and rear of solar modules over a year (--bifacial, --tracker). */
typedef struct cli_bifacial {
    bool requested;
    const char *tracker;  /* its axis, or a file of normals; NULL: fixed modules */
    const char *rotation; /* the variable of the scene that gets the rotation; NULL: none */
    bool has_pivot;
    double pivot[3];
    char degrees[32]; /* its value while a scene is loaded */
} cli_bifacial;
extern const cli_option cli_bifacial_options[]; /* of a cli_bifacial */

/* What the year of modules takes from the other options. */
typedef struct cli_bifacial_run_options {
    const char *path, *weather;
    const aur_scene_options *load; /* of a scene that is turned; `rotation` is one of its definitions */
    const aur_daylight_options *daylight;
    double lift; /* of the sensors along their normals; the rear ones are as far on the other side */
} cli_bifacial_run_options;

/* False, with a message, if options conflict; completes `given`. */
bool cli_bifacial_check(const cli_call *call, cli_bifacial *given, const char *format);
/* Writes the annual sums of the sensors to `output`, and the series of hours if requested. */
aur_result cli_bifacial_run(cli_bifacial *given, const cli_bifacial_run_options *run, const aur_scene *scene,
                            const aur_sensors_view *sensors, const char *output, const char *format,
                            aur_error *error);

enum { CLI_MODIFIER_LIMIT = 64 };

/* Light sources to report separately (--modifier). */
typedef struct cli_contributions {
    size_t count;
    const char *names[CLI_MODIFIER_LIMIT];
} cli_contributions;
extern const cli_option cli_contributions_options[]; /* of a cli_contributions */

/* False, with a message, if options conflict. */
bool cli_contributions_check(const cli_call *call, const cli_contributions *given, const char *format);
/* Estimates the irradiance by the sources with each name and writes it to `output`; `lux`: the luminance
 * instead of r, g, b. */
aur_result cli_contributions_run(const cli_contributions *given, const char *path,
                                 const aur_scene_options *load, const aur_irradiance_options *estimate,
                                 bool lux, const aur_sensors_view *sensors, const char *output,
                                 const char *format, aur_error *error);

enum { CLI_LUMINAIRE_LIMIT = 256 };

/* The sky at one time (--sky), and luminaires (--lamp). */
typedef struct cli_sky {
    aur_scene_sky sky;
    bool daylight_factor;
    size_t luminaire_count;
    aur_scene_luminaire luminaires[CLI_LUMINAIRE_LIMIT];
} cli_sky;
extern const cli_option cli_sky_options[]; /* of a cli_sky */
/* False, with a message, if options conflict. */
bool cli_sky_check(const cli_call *call);

/* False, with a message, if one of these options was given without --weather. */
bool cli_daylight_check(const cli_call *call);

/* Writes the metrics over all sensors, a row per metric with its interval: CSV, or JSON by the file's
 * extension. Errors: MEMORY, WRITE. */
aur_result cli_daylight_metrics(const cli_daylight *given, const aur_daylight_summary *summary, size_t count,
                                const aur_daylight *results, aur_error *error);

/* Writes the daylight coefficients of the sensors to `output`. */
aur_result cli_daylight_coefficients(cli_daylight *given, const aur_scene *scene,
                                     const aur_sensors_view *sensors, const char *output, aur_error *error);

/* Writes the annual results of the sensors to `output`; `given->options` includes values of other options. */
aur_result cli_daylight_run(cli_daylight *given, const aur_scene *scene, const aur_sensors_view *sensors,
                            const char *output, const char *format, bool quiet, aur_error *error);
