/* What the sky and the sun send in each hour of a year of weather. */
#pragma once

#include <aureole-lighting/daylight.h>
#include <stdbool.h>
#include <stddef.h>

#include "render/scene/lights/sky_model.h"

/* Patches of the sky: the 145 of Tregenza (1987), Lighting Research and Technology 19(1), 13-14, each cut
 * into M x M by Reinhart (2001), with one round patch about the zenith. Patch 0 is the ground; the others go
 * from the horizon up, in each row clockwise from the one whose middle is in the north. */

enum { AUR_SKY_SUBDIVISION_MAX = 6, AUR_SKY_ROWS_MAX = 7 * AUR_SKY_SUBDIVISION_MAX + 1 };

typedef struct aur_sky_patches {
    size_t subdivision, row_count, count;
    double step;                        /* radians of height of a row, but for the patch at the zenith */
    size_t first[AUR_SKY_ROWS_MAX + 1]; /* patch of each row */
    size_t up, around;                  /* pieces of a patch, from the horizon to the zenith and along it */
    size_t around_zenith;               /* along it of the one at the zenith */
    double (*middles)[3]; /* of all pieces, unit: row by row, piece of a height by piece, all around */
} aur_sky_patches;

/* `subdivision` is M, 1 to AUR_SKY_SUBDIVISION_MAX. */
aur_result aur_sky_patches_create(size_t subdivision, aur_sky_patches *patches, aur_error *error);
void aur_sky_patches_release(aur_sky_patches *patches);

/* The patch of a direction, by east, north and up, of unit length. */
size_t aur_sky_patches_find(const aur_sky_patches *patches, const double direction[3]);

/* Its solid angle; and the integral of the cosine with the zenith over it, 0 for the ground. */
double aur_sky_patch_angle(const aur_sky_patches *patches, size_t patch);
double aur_sky_patch_cosine(const aur_sky_patches *patches, size_t patch);

/* radiance[count]: the mean of the model over each patch, times what makes `diffuse` the sky's irradiance on
 * the horizontal plane; 0 for the ground. False where the model has no light anywhere. */
bool aur_sky_patches_fill(const aur_sky_patches *patches, const aur_sky_model *sky, double diffuse,
                          double *radiance);

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

/* Lumens a watt of the sky and the sun: Perez, Ineichen, Seals, Michalsky and Stewart (1990), Solar Energy
 * 44(5), 271-289, equations (7) and (8) with the coefficients of table 4, where `water` is in cm. */

double aur_efficacy_of_sky(const aur_perez_conditions *conditions, double water);
double aur_efficacy_of_sun(const aur_perez_conditions *conditions, double water);

/* Water in the air, in cm, by the dew point in degrees Celsius (their equation (3)); 2 where that is NaN. */
double aur_precipitable_water(double dew_point);

/* Weather files from memory. */

/* As aur_weather_read, from `size` bytes that are changed and end with a zero byte that is not counted. */
aur_result aur_weather_parse(const char *path, char *data, size_t size, aur_weather **weather,
                             aur_error *error);
