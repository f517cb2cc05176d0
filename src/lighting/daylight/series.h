/* All hours of all sensors as a file. */
#pragma once

#include <aureole-lighting/daylight.h>

/* values[sensors][2][hours]: illuminance and its standard error, lux, NaN where the weather does not tell.
 * The name ends in .npy (that array, float64) or .csv (a line an hour and sensor). Errors: NAME (another
 * ending), WRITE, MEMORY. */
aur_result aur_daylight_series_check(const char *path, aur_error *error);
aur_result aur_daylight_series_write(const char *path, const aur_weather_view *weather, size_t sensors,
                                     const double *values, aur_error *error);
