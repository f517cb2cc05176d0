#include "render/scene/lights/sun_position.h"

#include "points/base/text.h"
#include "points/base/vector.h"
#include "points/base/vector3d.h"

static const double RADIAN = 180.0 / AUR_PI;

/* Parses integers with a separator between them and nothing after. Returns their count, 0 for malformed text.
 */
static size_t read_fields(const char *text, char mark, size_t capacity, uint64_t *fields) {
    for (size_t i = 0; i < capacity; ++i) {
        text = aur_read_integer(text, 9999, &fields[i]);
        if (text == NULL)
            return 0;
        if (*text == '\0')
            return i + 1;
        if (*text++ != mark)
            return 0;
    }
    return 0;
}

unsigned aur_days_of_month(long year, unsigned month) {
    static const unsigned lengths[12] = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
    const bool leap = year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
    return lengths[month - 1] + (month == 2 && leap);
}

bool aur_days_since_2000(long year, unsigned month_of_year, unsigned day_of_month, double *days) {
    if (year < 1950 || year > 2050 || month_of_year < 1 || month_of_year > 12 || day_of_month < 1 ||
        day_of_month > aur_days_of_month(year, month_of_year))
        return false;
    const long month = (long)month_of_year, day = (long)day_of_month, shift = (month - 14) / 12;
    const long julian = 1461 * (year + 4800 + shift) / 4 + 367 * (month - 2 - 12 * shift) / 12 -
                        3 * ((year + 4900 + shift) / 100) / 4 + day - 32075;
    *days = (double)(julian - 2451545);
    return true;
}

double aur_sun_locate(double days, double hours, double latitude_degrees, double longitude_degrees,
                      double sun[3]) {
    const double anomaly = (357.528 + 0.9856003 * days) / RADIAN;
    const double longitude =
        (280.460 + 0.9856474 * days + 1.915 * sin(anomaly) + 0.020 * sin(2.0 * anomaly)) / RADIAN;
    const double tilt = (23.439 - 0.0000004 * days) / RADIAN;
    const double ascension = atan2(cos(tilt) * sin(longitude), cos(longitude));
    const double declination = asin(sin(tilt) * sin(longitude));
    const double sidereal = 15.0 * (6.697375 + 0.0657098242 * days + hours) + longitude_degrees;
    const double angle = sidereal / RADIAN - ascension, latitude = latitude_degrees / RADIAN;
    sun[0] = -cos(declination) * sin(angle);
    sun[1] = sin(declination) * cos(latitude) - cos(declination) * sin(latitude) * cos(angle);
    sun[2] = sin(declination) * sin(latitude) + cos(declination) * cos(latitude) * cos(angle);
    aur_normalize3(sun);
    return 1.00014 - 0.01671 * cos(anomaly) - 0.00014 * cos(2.0 * anomaly);
}

static aur_result read_time(const aur_sun_keys *keys, aur_parameters *parameters, aur_sun_position *position,
                            aur_error *error) {
    uint64_t date[3], clock[3] = {0};
    double days;
    if (read_fields(keys->date, '-', 3, date) != 3 ||
        !aur_days_since_2000((long)date[0], (unsigned)date[1], (unsigned)date[2], &days))
        return aur_parameters_fail_value(parameters, aur_parameters_find(parameters, "date"),
                                         "a day as 2026-06-21, from 1950 to 2050", error);
    if (read_fields(keys->time, ':', 3, clock) < 2 || clock[0] > 23 || clock[1] > 59 || clock[2] > 59)
        return aur_parameters_fail_value(parameters, aur_parameters_find(parameters, "time"),
                                         "a time as 14:30 or 14:30:00", error);
    const double hours =
        (double)clock[0] + (double)clock[1] / 60.0 + (double)clock[2] / 3600.0 - keys->timezone;
    position->solar_distance =
        aur_sun_locate(days + (hours - 12.0) / 24.0, hours, keys->latitude, keys->longitude, position->sun);
    position->has_sun = true;
    if (position->sun[2] <= 0.0)
        return aur_parameters_fail(parameters, error, AUR_ERROR_FORMAT,
                                   "the sun is %.2f degrees below the horizon at that date, time and place",
                                   -asin(position->sun[2]) * RADIAN);
    return AUR_OK;
}

static aur_result fail_direction(const aur_parameters *parameters, const char *name, const char *why,
                                 aur_error *error) {
    return aur_parameters_fail(parameters, error, AUR_ERROR_FORMAT, "'%s' must not be %s", name, why);
}

static aur_result read_frame(const aur_sun_keys *keys, aur_parameters *parameters, aur_sun_position *position,
                             aur_error *error) {
    double *const up = position->up, *const north = position->north;
    for (int d = 0; d < 3; ++d)
        up[d] = keys->up[d];
    if (aur_normalize3(up) < 1.0 / AUR_REACH)
        return fail_direction(parameters, "up", "0 0 0 or nearly 0", error);
    if (aur_parameters_find(parameters, "north") != NULL)
        for (int d = 0; d < 3; ++d)
            north[d] = keys->north[d];
    else /* perpendicular to the axis nearest to `up` */
        north[fabs(up[2]) > fabs(up[1]) ? 1 : 2] = fabs(up[2]) > fabs(up[1]) ? 1.0 : -1.0;
    const double length = aur_normalize3(north), along = aur_dot3(north, up);
    for (int d = 0; d < 3; ++d)
        north[d] -= along * up[d];
    if (length < 1.0 / AUR_REACH || aur_normalize3(north) < 1e-6)
        return fail_direction(parameters, "north", "0 0 0, nor along 'up'", error);
    aur_cross3(north, up, position->east);
    return AUR_OK;
}

aur_result aur_sun_position_read(const aur_sun_keys *keys, aur_parameters *parameters,
                                 aur_sun_position *position, aur_error *error) {
    *position = (aur_sun_position){.solar_distance = 1.0};
    const aur_result result = read_frame(keys, parameters, position, error);
    if (result != AUR_OK)
        return result;
    const bool aimed = aur_parameters_find(parameters, "sun_direction") != NULL;
    if (aimed && keys->date != NULL)
        return aur_parameters_fail(parameters, error, AUR_ERROR_FORMAT,
                                   "give 'sun_direction' or 'date', not both");
    if (keys->date != NULL)
        return read_time(keys, parameters, position, error);
    if (!aimed)
        return AUR_OK;
    position->has_sun = true;
    position->sun[0] = aur_dot3(keys->sun_direction, position->east);
    position->sun[1] = aur_dot3(keys->sun_direction, position->north);
    position->sun[2] = aur_dot3(keys->sun_direction, position->up);
    if (aur_normalize3(position->sun) < 1.0 / AUR_REACH)
        return fail_direction(parameters, "sun_direction", "0 0 0 or nearly 0", error);
    return AUR_OK;
}

void aur_sun_position_to_local(const aur_sun_position *position, aur_vector direction, double local[3]) {
    double d[3];
    aur_vector_to_doubles(direction, d);
    local[0] = aur_dot3(d, position->east);
    local[1] = aur_dot3(d, position->north);
    local[2] = aur_dot3(d, position->up);
    aur_normalize3(local);
}

aur_vector aur_sun_position_to_world(const aur_sun_position *position, const double local[3]) {
    double world[3];
    for (int d = 0; d < 3; ++d)
        world[d] = local[0] * position->east[d] + local[1] * position->north[d] + local[2] * position->up[d];
    return (aur_vector){(float)world[0], (float)world[1], (float)world[2]};
}

aur_result aur_sun_position_need(const aur_sun_position *position, const aur_parameters *parameters,
                                 aur_error *error) {
    return position->has_sun ? AUR_OK
                             : aur_parameters_fail(parameters, error, AUR_ERROR_FORMAT,
                                                   "needs 'sun_direction', or 'date' with 'time', "
                                                   "'latitude', 'longitude' and 'timezone'");
}
