/* Up, north and the sun's position: parameters shared by skies and suns. */
#pragma once

#include "points/base/error.h"
#include "points/base/keys.h"
#include "points/base/vector.h"
#include "render/scene/transform.h"

typedef struct aur_sun_keys {
    double up[3], north[3];
    double sun_direction[3];
    const char *date, *time;
    double latitude, longitude, timezone;
} aur_sun_keys;

/* Rows for tables of parameters; the struct has a member `aur_sun_keys sun`. */
#define AUR_SUN_KEYS(struct_)                                                                                \
    {AUR_KEY_OF_VECTOR(struct_, "up", sun.up, -AUR_REACH, AUR_REACH, "0 1 0", "to the zenith")},             \
        {AUR_KEY_OF_VECTOR(struct_, "north", sun.north, -AUR_REACH, AUR_REACH, "-z, or +y where z is up",    \
                           "to the north, for the position by date and time"),                               \
         .computed = true},                                                                                  \
        {AUR_KEY_OF_VECTOR(struct_, "sun_direction", sun.sun_direction, -AUR_REACH, AUR_REACH,               \
                           "by date and time", "to the sun"),                                                \
         .computed = true},                                                                                  \
        {AUR_KEY_OF_TEXT(struct_, "date", sun.date, NULL,                                                    \
                         "YYYY-MM-DD, 1950 to 2050, instead of sun_direction")},                             \
        {AUR_KEY_OF_TEXT(struct_, "time", sun.time, "12:00",                                                 \
                         "HH:MM or HH:MM:SS by the clock of the time zone")},                                \
        {AUR_KEY_OF_REAL(struct_, "latitude", sun.latitude, -90.0, 90.0, "0", "degrees to the north")},      \
        {AUR_KEY_OF_REAL(struct_, "longitude", sun.longitude, -180.0, 180.0, "0", "degrees to the east")}, { \
        AUR_KEY_OF_REAL(struct_, "timezone", sun.timezone, -14.0, 14.0, "0",                                 \
                        "time zone: hours ahead of UTC")                                                     \
    }

typedef struct aur_sun_position {
    double east[3], north[3], up[3]; /* unit vectors of the world */
    bool has_sun;
    double sun[3];         /* unit direction to the sun: east, north, up */
    double solar_distance; /* distance of the sun, relative to the mean; 1 without a date */
} aur_sun_position;

/* The last day of a month, 1 to 12 (Gregorian). */
AUR_INTERNAL unsigned aur_days_of_month(long year, unsigned month);
/* Days from noon of 1 January 2000 to noon of the date (Fliegel and Van Flandern 1968); false for an invalid
 * date, and for years outside 1950 to 2050. */
AUR_INTERNAL bool aur_days_since_2000(long year, unsigned month, unsigned day, double *days);
/* The direction of the sun (east, north, up), and its distance relative to the mean. Time is in days since
 * noon of 1 January 2000 (UTC); `hours` is its time of day. Michalsky (1988): .01 degrees, without
 * refraction. */
AUR_INTERNAL double aur_sun_locate(double days, double hours, double latitude, double longitude,
                                   double sun[3]);

/* Interprets the parameters. From date and time the position is by Michalsky (1988), Solar Energy 40(3),
 * 227-235: accurate to .01 degrees, without refraction. Errors: FORMAT (names the parameter; both forms
 * given; the sun below the horizon by date and time). */
aur_result aur_sun_position_read(const aur_sun_keys *keys, aur_parameters *parameters,
                                 aur_sun_position *position, aur_error *error);

/* Converts a world direction to a unit vector (east, north, up), and back. */
void aur_sun_position_to_local(const aur_sun_position *position, aur_vector direction, double local[3]);
aur_vector aur_sun_position_to_world(const aur_sun_position *position, const double local[3]);

/* An error if the plugin requires the sun but no parameter gives its position. */
aur_result aur_sun_position_need(const aur_sun_position *position, const aur_parameters *parameters,
                                 aur_error *error);
