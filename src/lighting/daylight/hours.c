#include "lighting/daylight/hours.h"

#include <math.h>
#include <stdlib.h>

#include "lighting/daylight/product.h"
#include "points/base/error.h"
#include "points/base/parallel.h"
#include "points/base/vector.h"
#include "points/base/vector3d.h"
#include "render/scene/lights/sun_position.h"

/* a, b, c, d of each class of clearness. */
static const double sky_rows[8][4] = {{97.24, -0.46, 12.00, -8.91},   {107.22, 1.15, 0.59, -3.95},
                                      {104.97, 2.96, -5.53, -8.77},   {102.39, 5.59, -13.95, -13.90},
                                      {100.71, 5.94, -22.75, -23.74}, {106.42, 3.83, -36.15, -28.83},
                                      {141.88, 1.90, -53.24, -14.03}, {152.23, 0.35, -45.27, -7.98}};
static const double sun_rows[8][4] = {{57.20, -4.55, -2.98, 117.12}, {98.99, -3.46, -1.21, 12.38},
                                      {109.83, -4.90, -1.71, -8.81}, {110.34, -5.84, -1.99, -4.56},
                                      {106.36, -3.97, -1.75, -6.16}, {107.19, -1.25, -1.51, -26.73},
                                      {105.75, 0.77, -1.26, -34.44}, {101.18, 1.58, -1.10, -8.29}};

double aur_efficacy_of_sky(const aur_perez_conditions *conditions, double water) {
    const double *const row = sky_rows[conditions->category];
    return fmax(row[0] + row[1] * water + row[2] * cos(conditions->zenith) +
                    row[3] * log(conditions->brightness),
                0.0);
}

double aur_efficacy_of_sun(const aur_perez_conditions *conditions, double water) {
    const double *const row = sun_rows[conditions->category];
    return fmax(row[0] + row[1] * water + row[2] * exp(5.73 * conditions->zenith - 5.0) +
                    row[3] * conditions->brightness,
                0.0);
}

double aur_precipitable_water(double dew_point) {
    return isnan(dew_point) ? 2.0 : exp(0.07 * dew_point - 0.075);
}

/* An hour while it is converted to light: irradiances of the sky and the sun. */
typedef struct hour_sky {
    bool up; /* the sun is above the horizon */
    double distance;
    double direct, diffuse; /* W/m^2, then lux */
    aur_sky_model model;
} hour_sky;

typedef struct work {
    const aur_weather_view *weather;
    const aur_daylight_options *options;
    const aur_sky_patches *patches;
    aur_lit_hours *lit;
    hour_sky *skies; /* of the lit hours */
    bool *odd;       /* the model gives no light */
    bool *daylight;  /* the daylight hours of EN 17037; NULL: not requested */
} work;

static aur_location location_of(const aur_weather_view *weather, size_t hour) {
    return (aur_location){.file = weather->file, .line = weather->hours[hour].line};
}

/* --- the sun */

/* Years outside the algorithm's range, and years without the weather's days, are replaced by 2001 or 2004. */
bool aur_weather_days(const aur_weather_hour *hour, double *days) {
    const unsigned month = (unsigned)hour->month, day = (unsigned)hour->day;
    return aur_days_since_2000(hour->year, month, day, days) ||
           aur_days_since_2000(month == 2 && day == 29 ? 2004 : 2001, month, day, days);
}

aur_result aur_weather_sun(const aur_weather_view *weather, size_t index, double sun[3], double *distance,
                           bool *up, aur_error *error) {
    enum { PIECES = 12 };
    const aur_weather_hour *const hour = &weather->hours[index];
    double days = 0.0, sum = 0.0;
    if (hour->month < 1 || hour->month > 12 || hour->day < 1 || hour->day > 31 || hour->hour < 1 ||
        hour->hour > 24 || !aur_weather_days(hour, &days))
        return aur_fail_at(error, location_of(weather, index), AUR_ERROR_ARGUMENT,
                           "unknown date %d-%d-%d with hour %d", hour->year, hour->month, hour->day,
                           hour->hour);
    size_t count = 0;
    for (size_t i = 0; i < PIECES; ++i) {
        const double clock = (double)(hour->hour - 1) + ((double)i + 0.5) / PIECES - weather->timezone;
        aur_sun_locate(days + (clock - 12.0) / 24.0, clock, weather->latitude, weather->longitude, sun);
        if (sun[2] > 0.0) {
            sum += clock;
            ++count;
        }
    }
    const double middle = count > 0 ? sum / (double)count : (double)hour->hour - 0.5 - weather->timezone;
    *distance =
        aur_sun_locate(days + (middle - 12.0) / 24.0, middle, weather->latitude, weather->longitude, sun);
    *up = sun[2] > 0.0;
    return AUR_OK;
}

/* --- irradiances */

/* Any two of global, direct and diffuse irradiance determine the third. False: the hour is missing. */
static bool find_irradiances(const aur_weather_hour *hour, double height, hour_sky *sky) {
    const double all = hour->global_horizontal;
    sky->direct = hour->direct_normal;
    sky->diffuse = hour->diffuse_horizontal;
    if (!sky->up) { /* missing values at night are 0 */
        sky->direct = 0.0;
        sky->diffuse = isnan(sky->diffuse) ? 0.0 : sky->diffuse;
        return true;
    }
    if (isnan(sky->diffuse))
        sky->diffuse = fmax(all - sky->direct * height, 0.0 * all * sky->direct);
    else if (isnan(sky->direct))
        sky->direct = height > 0.02 ? fmax((all - sky->diffuse) / height, 0.0 * all) : 0.0 * all;
    return !isnan(sky->diffuse) && !isnan(sky->direct);
}

/* Computes the sky model, and illuminances from irradiances. */
static void find_sky(const work *w, const aur_weather_hour *hour, const double sun[3], hour_sky *sky) {
    const bool constant = w->options->efficacy != AUR_EFFICACY_PEREZ;
    const double lumens = w->options->efficacy == AUR_EFFICACY_NONE ? 1.0 : 179.0;
    sky->model = aur_sky_model_uniform();
    if (!sky->up || !(sky->diffuse > 0.0)) {
        sky->direct *= lumens;
        sky->diffuse *= lumens;
        return;
    }
    const double outside = 1367.0 / (sky->distance * sky->distance);
    const aur_perez_conditions found = aur_perez_conditions_of(sky->direct, sky->diffuse, outside, sun);
    const double water = aur_precipitable_water(hour->dew_point);
    sky->model = aur_sky_model_perez(sky->direct, sky->diffuse, outside, sun);
    sky->direct *= constant ? lumens : aur_efficacy_of_sun(&found, water);
    sky->diffuse *= constant ? lumens : aur_efficacy_of_sky(&found, water);
}

/* --- daylight hours */

typedef struct diffuse_hour {
    double irradiance;
    size_t hour;
} diffuse_hour;

/* The most irradiance first; of equal hours the earlier one. */
static int compare_diffuse(const void *first, const void *second) {
    const diffuse_hour *const a = first, *const b = second;
    if (a->irradiance != b->irradiance)
        return a->irradiance > b->irradiance ? -1 : 1;
    return a->hour < b->hour ? -1 : 1;
}

/* The half of the hours with the most diffuse irradiance; missing hours have none. */
static aur_result find_daylight_hours(work *w, aur_error *error) {
    const size_t count = w->weather->count;
    diffuse_hour *const order = malloc(count * sizeof *order);
    w->daylight = malloc(count * sizeof *w->daylight);
    if (order == NULL || w->daylight == NULL) {
        free(order);
        return aur_fail_memory(error);
    }
    aur_result result = AUR_OK;
    for (size_t i = 0; i < count && result == AUR_OK; ++i) {
        hour_sky sky = {.up = false};
        double sun[3];
        result = aur_weather_sun(w->weather, i, sun, &sky.distance, &sky.up, error);
        const bool known = result == AUR_OK && find_irradiances(&w->weather->hours[i], sun[2], &sky);
        order[i] = (diffuse_hour){known ? sky.diffuse : 0.0, i};
    }
    if (result == AUR_OK)
        qsort(order, count, sizeof *order, compare_diffuse);
    for (size_t i = 0; i < count && result == AUR_OK; ++i)
        w->daylight[order[i].hour] = i < count / 2;
    free(order);
    return result;
}

/* --- all hours */

static bool counts(const work *w, size_t index) {
    const aur_daylight_options *const o = w->options;
    const int hour = w->weather->hours[index].hour;
    const size_t weekday = ((size_t)w->weather->first_weekday + index / 24) % 7;
    const bool late = o->from < hour, early = hour <= o->to;
    const bool within = o->schedule != NULL   ? o->schedule[index]
                        : w->daylight != NULL ? w->daylight[index]
                        : o->from < o->to     ? late && early
                                              : late || early;
    return within && !(o->weekdays && (weekday == 0 || weekday == 6));
}

static aur_result find_hours(work *w, aur_error *error) {
    aur_lit_hours *const lit = w->lit;
    for (size_t i = 0; i < w->weather->count; ++i) {
        const aur_weather_hour *const hour = &w->weather->hours[i];
        hour_sky sky = {.up = false};
        aur_lit_hour here = {.hour = i, .counts = counts(w, i)};
        const aur_result result = aur_weather_sun(w->weather, i, here.sun, &sky.distance, &sky.up, error);
        if (result != AUR_OK)
            return result;
        if (!find_irradiances(hour, here.sun[2], &sky)) {
            lit->is_unknown[i] = true;
            lit->first_unknown = lit->unknown++ == 0 ? i : lit->first_unknown;
            continue;
        }
        if (sky.direct < 0.0 || sky.diffuse < 0.0 || !(sky.direct + sky.diffuse < 1e6))
            return aur_fail_at(error, location_of(w->weather, i), AUR_ERROR_ARGUMENT,
                               "irradiances must be 0 or more and finite");
        lit->counted += here.counts;
        if (!(sky.direct + sky.diffuse > 0.0) || (w->options->evaluated != NULL && !w->options->evaluated[i]))
            continue;
        here.sun[2] = fmax(here.sun[2], 0.0);
        aur_normalize3(here.sun);
        find_sky(w, hour, here.sun, &sky);
        here.direct = sky.direct;
        here.patch = aur_sky_patches_find(w->patches, here.sun);
        w->skies[lit->count] = sky;
        lit->hours[lit->count++] = here;
    }
    if (lit->counted == 0)
        return aur_fail_at(error, (aur_location){.file = w->weather->file}, AUR_ERROR_FORMAT,
                           "no hour of the schedule has weather data");
    return AUR_OK;
}

/* Computes the radiances of one block of hours. */
static aur_result fill_block(void *context, size_t index) {
    const work *const w = context;
    const size_t patches = w->patches->count;
    const aur_sky_model uniform = aur_sky_model_uniform();
    double *const row = malloc(patches * sizeof *row);
    if (row == NULL)
        return AUR_ERROR_MEMORY;
    for (size_t i = index * AUR_DAYLIGHT_BLOCK; i < (index + 1) * AUR_DAYLIGHT_BLOCK && i < w->lit->count;
         ++i) {
        const hour_sky *const sky = &w->skies[i];
        w->odd[i] = !aur_sky_patches_fill(w->patches, &sky->model, sky->diffuse, row);
        if (w->odd[i])
            aur_sky_patches_fill(w->patches, &uniform, sky->diffuse, row);
        row[0] = w->options->ground_albedo / AUR_PI * (sky->diffuse + sky->direct * w->lit->hours[i].sun[2]);
        for (size_t p = 0; p < patches; ++p)
            w->lit->radiance[aur_daylight_index(patches, i, p)] = row[p];
    }
    free(row);
    return AUR_OK;
}

aur_result aur_weather_check(const aur_weather_view *weather, aur_error *error) {
    if (weather->count == 0 || weather->count > 8784 || weather->count % 24 != 0)
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "weather has whole days of 24 hours, 8784 at most, not %zu hours", weather->count);
    return fabs(weather->latitude) <= 90.0 && fabs(weather->longitude) <= 180.0 &&
                   fabs(weather->timezone) <= 14.0
               ? AUR_OK
               : aur_fail(error, AUR_ERROR_ARGUMENT,
                          "the location of the weather is not on earth: latitude %g must be within 90, "
                          "longitude %g within 180 and the time zone %g within 14",
                          weather->latitude, weather->longitude, weather->timezone);
}

static aur_result check(const aur_weather_view *weather, const aur_daylight_options *options,
                        aur_error *error) {
    const aur_result result = aur_weather_check(weather, error);
    if (result != AUR_OK)
        return result;
    if (options->schedule != NULL && options->daylight_hours)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "a schedule and daylight_hours exclude each other");
    if (options->schedule != NULL && options->schedule_count != weather->count)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "the schedule has %zu hours and the weather %zu",
                        options->schedule_count, weather->count);
    if (options->weekdays && !(weather->first_weekday >= 0 && weather->first_weekday < 7))
        return aur_fail_at(error, (aur_location){.file = weather->file}, AUR_ERROR_UNSUPPORTED,
                           "the weather does not state on which day of the week its year begins");
    return AUR_OK;
}

aur_result aur_lit_hours_create(const aur_weather_view *weather, const aur_daylight_options *options,
                                const aur_sky_patches *patches, aur_lit_hours *lit, aur_error *error) {
    *lit = (aur_lit_hours){0};
    aur_result result = check(weather, options, error);
    if (result != AUR_OK)
        return result;
    work w = {.weather = weather, .options = options, .patches = patches, .lit = lit};
    w.skies = malloc(weather->count * sizeof *w.skies);
    w.odd = calloc(weather->count, sizeof *w.odd);
    lit->hours = malloc(weather->count * sizeof *lit->hours);
    lit->is_unknown = calloc(weather->count, sizeof *lit->is_unknown);
    result = w.skies != NULL && w.odd != NULL && lit->hours != NULL && lit->is_unknown != NULL
                 ? AUR_OK
                 : aur_fail_memory(error);
    if (result == AUR_OK && options->daylight_hours)
        result = find_daylight_hours(&w, error);
    if (result == AUR_OK)
        result = find_hours(&w, error);
    const size_t rows = aur_daylight_blocks(lit->count);
    if (result == AUR_OK) {
        lit->radiance = calloc(rows * patches->count + 1, sizeof *lit->radiance);
        const aur_parallel_options parallel = {.threads = options->threads, .what = "skies of hours"};
        result = lit->radiance != NULL
                     ? aur_parallel_for(&parallel, rows / AUR_DAYLIGHT_BLOCK, fill_block, &w, error)
                     : aur_fail_memory(error);
    }
    for (size_t i = 0; i < lit->count && result == AUR_OK; ++i)
        if (w.odd[i])
            lit->first_other = lit->other_skies++ == 0 ? lit->hours[i].hour : lit->first_other;
    free(w.skies);
    free(w.odd);
    free(w.daylight);
    if (result != AUR_OK)
        aur_lit_hours_release(lit);
    return result;
}

void aur_lit_hours_release(aur_lit_hours *lit) {
    free(lit->hours);
    free(lit->radiance);
    free(lit->is_unknown);
    *lit = (aur_lit_hours){0};
}
