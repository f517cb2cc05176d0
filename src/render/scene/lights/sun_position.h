/* Where up, north and the sun are: keys that skies and suns share. */
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

/* Rows for tables of keys; the struct has an aur_sun_keys called sun. */
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
    double sun[3];         /* unit: to the sun, by east, north and up */
    double solar_distance; /* from the sun, in its mean distances; 1 without a date */
} aur_sun_position;

/* The last day of a month, 1 to 12 (Gregorian). */
AUR_INTERNAL unsigned aur_days_of_month(long year, unsigned month);
/* Whole days from noon of the first of January 2000 to that of the date (Fliegel and Van Flandern 1968), or
 * false for a day that there is not, and for years before 1950 and after 2050. */
AUR_INTERNAL bool aur_days_since_2000(long year, unsigned month, unsigned day, double *days);
/* The sun by east, north and up, at a time in days since noon of the first of January 2000 (UTC), of which
 * `hours` is the time of day; and how far it is, in its mean distances. Michalsky (1988): .01 degrees,
 * without refraction. */
AUR_INTERNAL double aur_sun_locate(double days, double hours, double latitude, double longitude,
                                   double sun[3]);

/* Reads what the keys say. By date and time the position is that of Michalsky (1988), Solar Energy 40(3),
 * 227-235: to .01 degrees, without refraction. Errors: FORMAT (which key; both ways given; the sun below the
 * horizon by date and time). */
aur_result aur_sun_position_read(const aur_sun_keys *keys, aur_parameters *parameters,
                                 aur_sun_position *position, aur_error *error);

/* A direction of the world by east, north and up, made a unit; and back. */
void aur_sun_position_to_local(const aur_sun_position *position, aur_vector direction, double local[3]);
aur_vector aur_sun_position_to_world(const aur_sun_position *position, const double local[3]);

/* Refuses a thing that cannot do without the sun where no key says where it is. */
aur_result aur_sun_position_need(const aur_sun_position *position, const aur_parameters *parameters,
                                 aur_error *error);
