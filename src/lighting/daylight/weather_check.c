/* A weather file has redundant data: warns of contradictions before a year is computed from it. */
#include <math.h>

#include "lighting/daylight/hours.h"
#include "points/base/error.h"
#include "points/base/vector.h"
#include "render/scene/lights/sun_position.h"

/* The sine of the sun's elevation during an hour. */
typedef struct heights {
    double mean;           /* mean, with 0 below the horizon */
    double least, largest; /* range */
} heights;

static heights heights_of(const aur_weather_view *weather, const aur_weather_hour *hour) {
    enum { PIECES = 12 };
    heights found = {0.0, 1.0, -1.0};
    double days = 0.0, sun[3];
    for (size_t i = 0; i < PIECES && aur_weather_days(hour, &days); ++i) {
        const double clock = (double)(hour->hour - 1) + ((double)i + 0.5) / PIECES - weather->timezone;
        aur_sun_locate(days + (clock - 12.0) / 24.0, clock, weather->latitude, weather->longitude, sun);
        found.mean += fmax(sun[2], 0.0) / PIECES;
        found.least = fmin(found.least, sun[2]);
        found.largest = fmax(found.largest, sun[2]);
    }
    return found;
}

/* Hours that can be checked, and the number of contradictions among them. */
typedef struct tally {
    size_t all, odd, first;
} tally;

static void count(tally *t, bool odd, size_t line) {
    ++t->all;
    if (odd && t->odd++ == 0)
        t->first = line;
}

/* Direct and diffuse irradiance do not sum to the global one, by more than a fifth of it and 50 W/m^2. With
 * the sun above 6 degrees during the whole hour this holds for up to 5 % of the hours of seven public files
 * (IWEC, TMY3, TMYx, PVGIS and others), and for 7 to 27 % with a clock off by an hour, except in one cloudy
 * place. */
static bool is_unbalanced(const aur_weather_hour *hour, double height) {
    const double computed = hour->direct_normal * height + hour->diffuse_horizontal;
    return fabs(hour->global_horizontal - computed) >
           fmax(50.0, 0.2 * fmax(computed, hour->global_horizontal));
}

static void check_hours(const aur_weather_view *weather, tally *balance, tally *night, tally *day) {
    static const double LOW = 0.1, HIGH = 0.3, DEEP = -0.05; /* sines of 6, 17 and -3 degrees */
    for (size_t i = 0; i < weather->count; ++i) {
        const aur_weather_hour *const hour = &weather->hours[i];
        const heights sun = heights_of(weather, hour);
        /* Direct irradiance at night, which some files have, is ignored. */
        const double bright = fmax(hour->diffuse_horizontal, hour->global_horizontal);
        const double sum = hour->direct_normal + hour->diffuse_horizontal + hour->global_horizontal;
        if (sun.least > LOW && sum > 0.0) /* not NaN */
            count(balance, is_unbalanced(hour, sun.mean), hour->line);
        if (bright > 20.0)
            count(night, sun.largest < DEEP, hour->line);
        if (sun.least > HIGH && sum >= 0.0)
            count(day, sum == 0.0, hour->line);
    }
}

static void warn_of(const aur_weather_view *weather, const tally *t, double share, const char *what,
                    const aur_warnings *warnings) {
    if ((double)t->odd > share * (double)t->all)
        aur_warn_at(warnings, (aur_location){.file = weather->file, .line = t->first},
                    "%s in %zu of %zu hours: check latitude, longitude, time zone and hours of the file",
                    what, t->odd, t->all);
}

static void warn_of_note(const aur_weather_view *weather, const aur_weather_note *n, const char *what,
                         const aur_warnings *warnings) {
    if (n->count > 0)
        aur_warn_at(warnings, (aur_location){.file = weather->file, .line = n->line}, "%zu %s", n->count,
                    what);
}

static void warn_of_form(const aur_weather_view *weather, const aur_warnings *warnings) {
    const aur_location file = {.file = weather->file};
    warn_of_note(weather, &weather->negative, "irradiances below 0 are read as 0", warnings);
    warn_of_note(weather, &weather->empty, "empty fields are read as missing", warnings);
    if (weather->from_zero)
        aur_warn_at(warnings, file, "hours are counted from 0 to 23: hour 0 is read as the first of a day");
    if (weather->records > 1)
        aur_warn_at(warnings, file, "%d records per hour are averaged", weather->records);
    if (weather->count < 8760)
        aur_warn_at(warnings, file, "the file has %zu of a year's 8760 hours: sums and shares are of these",
                    weather->count);
}

void aur_weather_warn(const aur_weather_view *weather, const aur_warnings *warnings) {
    static const double HOURS = 3.0;
    warn_of_form(weather, warnings);
    if (weather->latitude == 0.0 && weather->longitude == 0.0)
        aur_warn_at(warnings, (aur_location){.file = weather->file, .line = 1},
                    "the location is 0 degrees north and 0 east, in the sea: the file has no location");
    const double off = remainder(weather->timezone - weather->longitude / 15.0, 24.0);
    if (fabs(off) > HOURS)
        aur_warn_at(warnings, (aur_location){.file = weather->file, .line = 1},
                    "the time zone %g differs by %.1f hours from that of the longitude %g: east is positive",
                    weather->timezone, fabs(off), weather->longitude);
    tally balance = {0}, night = {0}, day = {0};
    check_hours(weather, &balance, &night, &day);
    warn_of(weather, &balance, 0.06,
            "global irradiance is not direct irradiance times the sine of the sun's height plus diffuse",
            warnings);
    warn_of(weather, &night, 0.005, "there is light with the sun below the horizon", warnings);
    warn_of(weather, &day, 0.05, "it is dark with the sun high", warnings);
}
