/* What the sky and the sun send in each hour of a year of weather. */
#pragma once

#include <aureole-lighting/daylight.h>

#include "lighting/daylight/patches.h"

/* An hour with light. */
typedef struct aur_lit_hour {
    size_t hour;   /* of the year */
    double sun[3]; /* unit, by east, north and up: in the middle of that part of the hour in which it is up */
    double direct; /* lux on a plane that faces the sun; 0: no sun */
    bool counts;   /* among the hours that the options ask for */
    size_t patch;  /* in which the sun stands */
} aur_lit_hour;

typedef struct aur_lit_hours {
    size_t count;
    aur_lit_hour *hours;
    double *radiance; /* lux a steradian, patches a row: a row an hour, first the ground's; see product.h */
    size_t counted;   /* hours that count, with light or without it */
    size_t unknown;   /* hours that the weather does not tell */
    size_t first_unknown; /* one of them */
    bool *is_unknown;     /* for each hour of the year */
    size_t other_skies, first_other;
} aur_lit_hours;

/* Days from noon of 1 January 2000 to that of an hour's date; false for a day that there is not. */
bool aur_weather_days(const aur_weather_hour *hour, double *days);

/* Warns of what the weather says twice, and not the same: its zone and longitude, its irradiances of the
 * ground, the sun and the sky, and its hours and the sun's; and of what was read in another than the plain
 * form. */
void aur_weather_warn(const aur_weather_view *weather, const aur_warnings *warnings);

/* The options have their defaults filled in. Errors: ARGUMENT (places, counts and dates that cannot be),
 * FORMAT (no hour that counts is known), UNSUPPORTED (days of the week that are not known), MEMORY. */
aur_result aur_lit_hours_create(const aur_weather_view *weather, const aur_daylight_options *options,
                                const aur_sky_patches *patches, aur_lit_hours *lit, aur_error *error);
void aur_lit_hours_release(aur_lit_hours *lit);
