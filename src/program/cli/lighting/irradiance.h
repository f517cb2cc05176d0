/* The parts of `aureole irradiance`. */
#pragma once

#include <aureole-lighting/irradiance.h>

/* Draws the luminance of each sensor at its place, seen along the axis in which the sensors spread least:
 * cells where they stand on a grid, else dots. `unit` is the word at the scale; NULL: "luminance". Errors:
 * MEMORY, WRITE. */
aur_result cli_irradiance_plot(const char *path, const char *unit, const aur_sensors_view *sensors,
                               const aur_irradiance *results, aur_error *error);
