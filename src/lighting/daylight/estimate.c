/* A year at all sensors: the coefficients of each sensor times the radiances of each hour. */
#include <aureole-lighting/daylight.h>
#include <aureole/statistics.h>
#include <math.h>
#include <stdlib.h>

#include "lighting/daylight/coefficients.h"
#include "lighting/irradiance/sensors.h"
#include "points/base/error.h"
#include "points/base/parallel.h"

enum { LANES = AUR_DAYLIGHT_LANES, DEFAULT_DIRECTIONS = 16384, LIMIT = 1 << 28 };

typedef struct work {
    const aur_daylight_options *options;
    const aur_sensors_view *sensors;
    const aur_weather_view *weather;
    aur_coefficient_trace trace;
    aur_lit_hours lit;
    double *overcast; /* radiance of the patches per lux outside */
    double *series;   /* NULL: not requested */
    bool owns_series;
    aur_daylight *results;
} work;

static bool is_zero(const double v[3]) {
    return v[0] == 0.0 && v[1] == 0.0 && v[2] == 0.0;
}

static aur_result check_options(const aur_daylight_options *o, aur_error *error) {
    if (o->directions > LIMIT)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "there must be 1 to %d directions, not %zu", LIMIT,
                        o->directions);
    if (o->subdivision > AUR_SKY_SUBDIVISION_MAX)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "the subdivision of patches must be 1 to %d, not %zu",
                        AUR_SKY_SUBDIVISION_MAX, o->subdivision);
    if (!(o->ground_albedo >= 0.0 && o->ground_albedo <= 1.0))
        return aur_fail(error, AUR_ERROR_ARGUMENT, "the ground's albedo must be from 0 to 1, not %g",
                        o->ground_albedo);
    if (!(o->threshold > 0.0 && isfinite(o->threshold)))
        return aur_fail(error, AUR_ERROR_ARGUMENT, "the threshold must be above 0 and finite, not %g",
                        o->threshold);
    if (!(o->useful[0] >= 0.0 && o->useful[1] > o->useful[0] && isfinite(o->useful[1])))
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "useful illuminances must go from 0 or more to something larger, not from %g to %g",
                        o->useful[0], o->useful[1]);
    if (o->from < 0 || o->from > 23 || o->to < 0 || o->to > 24 || o->from == o->to)
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "hours that count must lie between 0 and 24 o'clock, not from %d to %d", o->from,
                        o->to);
    double sum = 0.0;
    for (size_t c = 0; c < 3; ++c)
        sum += o->luminance[c] >= 0.0 ? o->luminance[c] : NAN;
    if (!(sum > 0.0 && isfinite(sum)))
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "the weights of luminance must be finite and not negative");
    return o->series != NULL ? aur_daylight_series_check(o->series, error) : AUR_OK;
}

aur_result aur_daylight_options_read(const aur_daylight_options *given, aur_daylight_options *o,
                                     aur_error *error) {
    static const double REC709[3] = {0.2126, 0.7152, 0.0722};
    o->size = sizeof(aur_daylight_options);
    aur_daylight_options_init(o, NULL);
    const aur_result result = aur_options_read(given, sizeof *o, o, "aur_daylight_options", error);
    if (result != AUR_OK)
        return result;
    if (o->set == NULL)
        o->set = "spherical-fibonacci";
    if (o->directions == 0)
        o->directions = DEFAULT_DIRECTIONS;
    if (o->subdivision == 0)
        o->subdivision = 1;
    if (o->no_ground)
        o->ground_albedo = 0.0;
    else if (o->ground_albedo == 0.0)
        o->ground_albedo = 0.2;
    if (o->threshold == 0.0)
        o->threshold = 300.0;
    if (o->useful[0] == 0.0 && o->useful[1] == 0.0) {
        o->useful[0] = 100.0;
        o->useful[1] = 3000.0;
    }
    if (o->from == 0 && o->to == 0) {
        o->from = 8;
        o->to = 18;
    }
    if (is_zero(o->luminance))
        for (size_t c = 0; c < 3; ++c)
            o->luminance[c] = REC709[c];
    return check_options(o, error);
}

/* --- one sensor */

/* Buffers of one thread, reused for each sensor. */
typedef struct room {
    double *memory;
    aur_coefficients coefficients;
    double *all, *sun; /* of the lit hours, rounded up to blocks */
    double *scratch;
} room;

static bool make_room(const work *w, room *r) {
    const size_t coefficients = w->trace.patches.count * LANES,
                 hours = aur_daylight_blocks(w->lit.count) * LANES;
    r->memory = malloc((2 * coefficients + 2 * hours + 2 * w->lit.count + 1) * sizeof *r->memory);
    if (r->memory == NULL)
        return false;
    const double *const weights = w->options->luminance, sum = weights[0] + weights[1] + weights[2];
    r->coefficients = (aur_coefficients){.patches = &w->trace.patches,
                                         .sky = &w->trace.sky,
                                         .channels = 1,
                                         .weights = {{weights[0] / sum, weights[1] / sum, weights[2] / sum}},
                                         .all = r->memory,
                                         .reflected = r->memory + coefficients};
    r->all = r->coefficients.reflected + coefficients;
    r->sun = r->all + hours;
    r->scratch = r->sun + hours;
    return true;
}

/* The illuminances of all hours. */
static void multiply(const work *w, const room *r) {
    const aur_coefficients *const c = &r->coefficients;
    AUR_KERNEL_HERE(aur_daylight_product)
    (aur_daylight_blocks(w->lit.count), w->trace.patches.count, w->lit.radiance, c->all, r->all);
    for (size_t i = 0; i < w->lit.count; ++i) {
        const aur_lit_hour *const hour = &w->lit.hours[i];
        const double angle = aur_sky_patch_angle(&w->trace.patches, hour->patch);
        const double *const reflected = c->reflected + hour->patch * LANES;
        for (size_t k = 0; k < LANES; ++k)
            r->all[i * LANES + k] += r->sun[i * LANES + k] + hour->direct / angle * reflected[k];
    }
}

static void store_series(const work *w, size_t sensor, const double *all) {
    const size_t hours = w->weather->count;
    double *const values = w->series + 2 * hours * sensor, *const errors = values + hours;
    for (size_t h = 0; h < hours; ++h)
        values[h] = errors[h] = w->lit.is_unknown[h] ? NAN : 0.0;
    for (size_t i = 0; i < w->lit.count; ++i) {
        aur_moments one = {0};
        for (size_t k = 0; k < LANES; ++k)
            aur_moments_add(&one, all[i * LANES + k]);
        values[w->lit.hours[i].hour] = one.mean;
        errors[w->lit.hours[i].hour] = aur_moments_standard_error(&one);
    }
}

static void estimate_sensor(const work *w, aur_path_group *group, const room *r, size_t sensor) {
    static const aur_closed_lights none = {0};
    aur_sensor_point point;
    aur_sensor_sums sums;
    double overcast[LANES] = {0.0};
    aur_sensor_point_create(w->trace.sky.scene, &none, w->sensors->positions + 3 * sensor,
                            w->sensors->normals + 3 * sensor, w->options->seed, NULL, &point);
    aur_coefficients_find(group, &w->trace.rule, &point, &r->coefficients, &sums);
    aur_sun_seen(group, &point, &r->coefficients, &w->lit, r->sun);
    multiply(w, r);
    for (size_t p = 0; p < w->trace.patches.count; ++p)
        for (size_t k = 0; k < LANES; ++k)
            overcast[k] += w->overcast[p] * r->coefficients.all[p * LANES + k];
    aur_daylight *const found = &w->results[sensor];
    *found = (aur_daylight){.directions = w->trace.rule.count * LANES,
                            .on_surface = point.on_surface,
                            .doubtful = point.doubtful};
    found->dark = (double)sums.dark / (double)found->directions;
    const aur_daylight_year year = {r->all, r->sun, overcast};
    aur_daylight_measure_year(&w->lit, w->options, &year, r->scratch, found);
    if (w->series != NULL)
        store_series(w, sensor, r->all);
}

enum { BLOCK = 4 }; /* sensors per task */

static aur_result estimate_block(void *context, size_t index) {
    const work *const w = context;
    aur_path_group group = {.sensor.panes = w->trace.panes};
    room r = {.memory = NULL};
    if (!make_room(w, &r))
        return AUR_ERROR_MEMORY;
    aur_path_group_prepare(&w->trace.path, w->trace.sky.scene, w->trace.sampler, &group);
    for (size_t i = index * BLOCK; i < (index + 1) * BLOCK && i < w->sensors->count; ++i)
        estimate_sensor(w, &group, &r, i);
    free(r.memory);
    return AUR_OK;
}

/* --- all sensors */

static aur_result prepare(work *w, const aur_scene *scene, aur_error *error) {
    const aur_daylight_options *const o = w->options;
    aur_result result = aur_coefficient_trace_create(scene, o, &w->trace, error);
    if (result == AUR_OK)
        result = aur_lit_hours_create(w->weather, o, &w->trace.patches, &w->lit, error);
    if (result != AUR_OK)
        return result;
    w->overcast = malloc(w->trace.patches.count * sizeof *w->overcast);
    if (w->overcast == NULL)
        return aur_fail_memory(error);
    const aur_sky_model overcast = aur_sky_model_overcast();
    aur_sky_patches_fill(&w->trace.patches, &overcast, 1.0, w->overcast);
    w->overcast[0] = o->ground_albedo / AUR_PI;
    w->series = o->hourly;
    w->owns_series = o->series != NULL && o->hourly == NULL;
    if (!w->owns_series)
        return AUR_OK;
    if (w->sensors->count <= SIZE_MAX / (2 * w->weather->count * sizeof *w->series))
        w->series = malloc(2 * w->weather->count * w->sensors->count * sizeof *w->series);
    return w->series != NULL ? AUR_OK
                             : aur_fail(error, AUR_ERROR_MEMORY, "out of memory for %zu hours of %zu sensors",
                                        w->weather->count, w->sensors->count);
}

/* Percents of the sensors. */
static void summarize(const work *w, aur_daylight_summary *computed) {
    enum { WEAK = 50, SUNNY = 250 };
    const double t = aur_student_quantile(LANES - 1, 0.975), one = 100.0 / (double)w->sensors->count;
    computed->hours = w->lit.counted;
    computed->unknown_hours = w->lit.unknown;
    computed->other_skies = w->lit.other_skies;
    size_t enough = 0, least = 0, most = 0, sunny = 0;
    for (size_t i = 0; i < w->sensors->count; ++i) {
        const aur_daylight *const found = &w->results[i];
        const double value = found->value[AUR_DAYLIGHT_AUTONOMY];
        const double half = t * found->error[AUR_DAYLIGHT_AUTONOMY];
        enough += value >= WEAK;
        least += value - half >= WEAK;
        most += value + half >= WEAK;
        sunny += found->value[AUR_DAYLIGHT_SUN_HOURS] > SUNNY;
    }
    computed->spatial_autonomy = one * (double)enough;
    computed->spatial_autonomy_least = one * (double)least;
    computed->spatial_autonomy_most = one * (double)most;
    computed->sunlight_exposure = one * (double)sunny;
}

static void warn(const work *w) {
    const aur_warnings *const to = &w->options->warnings;
    const aur_lit_hours *const lit = &w->lit;
    if (w->trace.sky.removed_lights > 0)
        aur_warn_at(
            to, (aur_location){.file = NULL},
            "%zu light sources of the scene are left out: daylight comes only from the sky and the sun",
            w->trace.sky.removed_lights);
    if (lit->unknown > 0)
        aur_warn_at(
            to, (aur_location){.file = w->weather->file, .line = w->weather->hours[lit->first_unknown].line},
            "%zu hours of daylight are missing (the first is here): they do not count", lit->unknown);
    if (lit->other_skies > 0)
        aur_warn_at(
            to, (aur_location){.file = w->weather->file, .line = w->weather->hours[lit->first_other].line},
            "for the irradiances of %zu hours (the first is here) the model of Perez has no light anywhere: "
            "their sky is uniform",
            lit->other_skies);
    size_t occupied = 0;
    for (size_t i = 0; i < lit->count; ++i)
        occupied += lit->hours[i].counts;
    if (lit->count > 0 && occupied == 0 && w->options->evaluated == NULL)
        aur_warn_at(to, (aur_location){.file = w->weather->file},
                    "no occupied hour has daylight: check the schedule and the clock of the weather");
    aur_sensor_oddities odd = {0};
    for (size_t i = 0; i < w->sensors->count; ++i)
        aur_sensor_note(i, w->results[i].on_surface, w->results[i].doubtful, w->results[i].dark,
                        w->results[i].value[AUR_DAYLIGHT_ANNUAL], &odd);
    aur_sensors_warn(w->sensors, to, &odd);
}

aur_result aur_daylight_estimate(const aur_scene *scene, const aur_sensors_view *given,
                                 const aur_weather_view *given_weather,
                                 const aur_daylight_options *given_options, size_t result_size,
                                 aur_daylight *results, aur_daylight_summary *summary, aur_error *error) {
    aur_daylight_options options;
    aur_sensors_view sensors = {.size = sizeof sensors};
    aur_weather_view weather = {.size = sizeof weather};
    aur_daylight_summary computed = {.size = sizeof computed};
    aur_result result = aur_daylight_options_read(given_options, &options, error);
    if (result == AUR_OK)
        result = aur_options_read(given, sizeof sensors, &sensors, "aur_sensors_view", error);
    if (result == AUR_OK)
        result = aur_options_read(given_weather, sizeof weather, &weather, "aur_weather_view", error);
    if (result == AUR_OK && result_size != sizeof *results)
        result = aur_fail(error, AUR_ERROR_ARGUMENT, "the results have %zu bytes each, not %zu",
                          sizeof *results, result_size);
    if (result == AUR_OK)
        result = aur_sensors_check(&sensors, AUR_ERROR_ARGUMENT, error);
    if (result != AUR_OK)
        return result;
    work w = {.options = &options, .sensors = &sensors, .weather = &weather, .results = results};
    result = prepare(&w, scene, error);
    if (result == AUR_OK) {
        aur_weather_warn(&weather, &options.warnings);
        const aur_parallel_options parallel = {.threads = options.threads,
                                               .what = "sensors",
                                               .progress = options.progress,
                                               .flush_denormals = true};
        result = aur_parallel_for(&parallel, (sensors.count + BLOCK - 1) / BLOCK, estimate_block, &w, error);
    }
    if (result == AUR_OK && options.series != NULL)
        result = aur_daylight_series_write(options.series, &weather, sensors.count, w.series, error);
    if (result == AUR_OK) {
        warn(&w);
        summarize(&w, &computed);
        if (summary != NULL)
            result =
                aur_description_write(&computed, sizeof computed, summary, "aur_daylight_summary", error);
    }
    aur_lit_hours_release(&w.lit);
    aur_coefficient_trace_release(&w.trace);
    free(w.overcast);
    if (w.owns_series)
        free(w.series);
    return result;
}

aur_result aur_daylight_options_init(aur_daylight_options *options, aur_error *error) {
    static const aur_daylight_options defaults = {.size = sizeof defaults};
    return aur_description_write(&defaults, sizeof defaults, options, "aur_daylight_options", error);
}
