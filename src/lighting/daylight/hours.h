/* Radiances of the sky and the sun in each hour of a year of weather. */
#pragma once

#include <aureole-lighting/daylight.h>
#include <stdbool.h>
#include <stddef.h>

#include "render/scene/lights/sky_model.h"

/* Sky patches: the 145 of Tregenza (1987), Lighting Research and Technology 19(1), 13-14, each divided into M
 * x M by Reinhart (2001), with one round patch at the zenith. Patch 0 is the ground; the others are ordered
 * from the horizon up, each row clockwise from the patch centred on north. */

enum { AUR_SKY_SUBDIVISION_MAX = 6, AUR_SKY_ROWS_MAX = 7 * AUR_SKY_SUBDIVISION_MAX + 1 };

typedef struct aur_sky_patches {
    size_t subdivision, row_count, count;
    double step;                        /* height of a row in radians, except for the zenith patch */
    size_t first[AUR_SKY_ROWS_MAX + 1]; /* first patch of each row */
    size_t up, around;                  /* subdivisions of a patch: in elevation and in azimuth */
    size_t around_zenith;               /* azimuth subdivisions of the zenith patch */
    double (*middles)[3];               /* unit directions of all subdivisions: by row, elevation, azimuth */
} aur_sky_patches;

/* `subdivision` is M, 1 to AUR_SKY_SUBDIVISION_MAX. */
aur_result aur_sky_patches_create(size_t subdivision, aur_sky_patches *patches, aur_error *error);
void aur_sky_patches_release(aur_sky_patches *patches);

/* The patch that contains a direction, given as (east, north, up) of unit length. */
size_t aur_sky_patches_find(const aur_sky_patches *patches, const double direction[3]);

/* Solid angle of the patch; and the integral over it of the cosine to the zenith, 0 for the ground. */
double aur_sky_patch_angle(const aur_sky_patches *patches, size_t patch);
double aur_sky_patch_cosine(const aur_sky_patches *patches, size_t patch);

/* radiance[count]: the model's mean over each patch, scaled so that the sky's irradiance on the horizontal
 * plane is `diffuse`; 0 for the ground. False if the model gives no light anywhere. */
bool aur_sky_patches_fill(const aur_sky_patches *patches, const aur_sky_model *sky, double diffuse,
                          double *radiance);

/* An hour with light. */
typedef struct aur_lit_hour {
    size_t hour;   /* of the year */
    double sun[3]; /* unit, as (east, north, up), at the middle of the part of the hour with the sun above the
                    * horizon */
    double direct; /* lux on a plane facing the sun; 0: no sun */
    bool counts;   /* the hour is occupied */
    size_t patch;  /* patch that contains the sun */
} aur_lit_hour;

typedef struct aur_lit_hours {
    size_t count;
    aur_lit_hour *hours;
    double *radiance;     /* cd/m^2, hours by patches, the ground first; layout: see product.h */
    size_t counted;       /* number of occupied hours, dark ones included */
    size_t unknown;       /* number of missing hours */
    size_t first_unknown; /* index of the first missing hour */
    bool *is_unknown;     /* for each hour of the year */
    size_t other_skies, first_other;
} aur_lit_hours;

/* Days from noon of 1 January 2000 to the date of an hour; false for an invalid date. */
bool aur_weather_days(const aur_weather_hour *hour, double *days);
/* The sun as (east, north, up) at the middle of the part of an hour with the sun above the horizon, its
 * distance relative to the mean, and whether it is above the horizon. Errors: ARGUMENT for an invalid date.
 */
aur_result aur_weather_sun(const aur_weather_view *weather, size_t index, double sun[3], double *distance,
                           bool *up, aur_error *error);
/* Errors: ARGUMENT (invalid locations and counts). */
aur_result aur_weather_check(const aur_weather_view *weather, aur_error *error);

/* Warns of contradictions in the weather: of the time zone and longitude, of ground, sun and sky irradiances,
 * and of the hours and the sun's position. Also warns of values that the reader has converted. */
void aur_weather_warn(const aur_weather_view *weather, const aur_warnings *warnings);

/* The options have their defaults filled in. Errors: ARGUMENT (invalid locations, counts and dates), FORMAT
 * (all occupied hours are missing), UNSUPPORTED (weekdays requested but unspecified), MEMORY. */
aur_result aur_lit_hours_create(const aur_weather_view *weather, const aur_daylight_options *options,
                                const aur_sky_patches *patches, aur_lit_hours *lit, aur_error *error);
void aur_lit_hours_release(aur_lit_hours *lit);

/* Luminous efficacy of the sky and the sun in lm/W: Perez, Ineichen, Seals, Michalsky and Stewart (1990),
 * Solar Energy 44(5), 271-289, equations (7) and (8) with the coefficients of table 4; `water` is in cm. */

double aur_efficacy_of_sky(const aur_perez_conditions *conditions, double water);
double aur_efficacy_of_sun(const aur_perez_conditions *conditions, double water);

/* Precipitable water in cm from the dew point in degrees Celsius (their equation (3)); 2 if that is NaN. */
double aur_precipitable_water(double dew_point);

/* Weather files from memory. */

/* As aur_weather_read, from `size` bytes, which are modified; an additional zero byte must follow them. */
aur_result aur_weather_parse(const char *path, char *data, size_t size, aur_weather **weather,
                             aur_error *error);
