/* What a year of illuminances at a sensor says of it. */
#pragma once

#include "lighting/daylight/hours.h"

/* Illuminances of the lit hours, lux, hour by hour sixteen randomisations each: of all light, and of that
 * which comes straight from the sun. `overcast` are the daylight factors. */
typedef struct aur_daylight_year {
    const double *all, *sun, *overcast;
} aur_daylight_year;

/* The measures of the mean over the randomisations, with the jackknife's standard errors: of what the
 * measures are without one randomisation after the other. That is the standard error where they are linear
 * (daylight factor, annual sum), and close to it for shares of many hours. `scratch` has room for twice the
 * lit hours. */
void aur_daylight_measure_year(const aur_lit_hours *lit, const aur_daylight_options *options,
                               const aur_daylight_year *year, double *scratch, aur_daylight *found);
