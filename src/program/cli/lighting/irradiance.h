/* The parts of `aureole irradiance`. */
#pragma once

#include <aureole-lighting/daylight.h>
#include <aureole-lighting/irradiance.h>

#include "program/cli/options.h"

/* Draws the luminance of each sensor at its place, seen along the axis in which the sensors spread least:
 * cells with contours where they stand on a grid, else dots. `unit` is the word at the scale; NULL:
 * "luminance". Errors: MEMORY, WRITE. */
aur_result cli_irradiance_plot(const char *path, const char *unit, const aur_sensors_view *sensors,
                               const aur_irradiance *results, aur_error *error);

/* A year of weather at sensors: the part of `aureole irradiance` that --weather asks for. */

typedef struct cli_daylight {
    const char *weather;  /* NULL: none is asked for */
    const char *metrics;  /* a file for figures of all sensors together; NULL: none */
    const char *schedule; /* hours that count, or a file of them; NULL: 8-18 */
    bool coefficients;    /* daylight coefficients instead of a year */
    aur_daylight_options options;
} cli_daylight;
extern const cli_option cli_daylight_options[]; /* of a cli_daylight */

enum { CLI_LAMP_LIMIT = 256 };

/* The sky at one time that --sky adds, and the lamps of --lamp. */
typedef struct cli_sky {
    aur_scene_sky sky;
    bool daylight_factor;
    size_t lamp_count;
    aur_scene_lamp lamps[CLI_LAMP_LIMIT];
} cli_sky;
extern const cli_option cli_sky_options[]; /* of a cli_sky */
/* False, with a message, where options do not go together. */
bool cli_sky_check(const cli_call *call);

/* False, with a message, where one of these options was given without --weather. */
bool cli_daylight_check(const cli_call *call);

/* Writes what is told of all sensors together, a row a metric with its interval: CSV, or JSON where the name
 * ends so. Errors: MEMORY, WRITE. */
aur_result cli_daylight_metrics(const cli_daylight *given, const aur_daylight_summary *summary, size_t count,
                                const aur_daylight *results, aur_error *error);

/* Daylight coefficients of the sensors, written to `output`. */
aur_result cli_daylight_coefficients(cli_daylight *given, const aur_scene *scene,
                                     const aur_sensors_view *sensors, const char *output, aur_error *error);

/* The year at the sensors, written to `output`; `given->options` holds what other options said too. */
aur_result cli_daylight_run(cli_daylight *given, const aur_scene *scene, const aur_sensors_view *sensors,
                            const char *output, const char *format, bool quiet, aur_error *error);
