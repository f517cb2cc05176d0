/* Estimates the irradiance of all sensors: the number of directions per sensor, and means and intervals over
 * the randomisations. */
#include <aureole-lighting/irradiance.h>
#include <stdlib.h>
#include <string.h>

#include "lighting/irradiance/sensor_trace.h"
#include "lighting/irradiance/sensors.h"
#include "points/base/error.h"
#include "points/base/parallel.h"
#include "points/quadrature/estimate/levels.h"
#include "render/scene/scene_data.h"

enum {
    REPLICATES = AUR_IRRADIANCE_REPLICATES,
    DEFAULT_DIRECTIONS = 16384,
    DEFAULT_PARTICLES = 500000,
    MOST_DIRECTIONS = 1 << 20, /* default maximum for a sensor with a target error */
    LIMIT = 1 << 28,
    LEVELS = 32,
    FIRST_LEVEL = 16, /* directions per randomisation */
    LEAST_DARK = 256, /* per randomisation, before a sensor is accepted as having no light */
    BLOCK = 16        /* sensors per task */
};

typedef struct work {
    const aur_irradiance_options *options;
    const aur_sensors_view *sensors;
    aur_path path;
    bool panes;
    const aur_scene *scene;
    aur_sampler *sampler;
    aur_closed_lights lights;
    aur_cached_light cache;
    size_t level_count;
    aur_sensor_rule rules[LEVELS]; /* one per level, each with more directions than the previous one */
    aur_irradiance *results;
} work;

static const double REC709[3] = {0.2126, 0.7152, 0.0722};

static aur_result read_options(const aur_irradiance_options *given, aur_irradiance_options *o,
                               aur_error *error) {
    o->size = sizeof(aur_irradiance_options);
    aur_irradiance_options_init(o, NULL);
    const aur_result result = aur_options_read(given, sizeof *o, o, "aur_irradiance_options", error);
    if (result != AUR_OK)
        return result;
    if (o->set == NULL)
        o->set = "spherical-fibonacci";
    if (o->confidence == 0.0)
        o->confidence = 0.95;
    if (o->particles == 0)
        o->particles = DEFAULT_PARTICLES;
    if (o->directions == 0)
        o->directions = o->error > 0.0 ? MOST_DIRECTIONS : DEFAULT_DIRECTIONS;
    if (o->luminance[0] == 0.0 && o->luminance[1] == 0.0 && o->luminance[2] == 0.0)
        for (size_t c = 0; c < 3; ++c)
            o->luminance[c] = REC709[c];
    if (!(o->confidence > 0.0 && o->confidence < 1.0))
        return aur_fail(error, AUR_ERROR_ARGUMENT, "the confidence must be in (0,1), not %g", o->confidence);
    if (!(o->error >= 0.0 && o->error < 1.0))
        return aur_fail(error, AUR_ERROR_ARGUMENT, "the error must be in (0,1), or 0 for none, not %g",
                        o->error);
    if (o->directions > LIMIT)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "there must be 1 to %d directions, not %zu", LIMIT,
                        o->directions);
    if ((unsigned)o->reflected > AUR_REFLECTED_BY_RADIOSITY)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "unknown method %u for reflected light",
                        (unsigned)o->reflected);
    if (o->particles > LIMIT)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "there must be 1 to %d particles, not %zu", LIMIT,
                        o->particles);
    for (size_t c = 0; c < 3; ++c)
        if (!(isfinite(o->luminance[c]) && o->luminance[c] >= 0.0))
            return aur_fail(error, AUR_ERROR_ARGUMENT,
                            "the weights of luminance must be finite and not negative, not %g",
                            o->luminance[c]);
    return AUR_OK;
}

/* One level with all directions, or levels that double their number. */
static aur_result make_rules(work *w, aur_error *error) {
    const aur_irradiance_options *const o = w->options;
    const size_t most = (o->directions + REPLICATES - 1) / REPLICATES;
    size_t count = o->error > 0.0 && most > FIRST_LEVEL ? FIRST_LEVEL : most;
    aur_warnings warnings = o->warnings;
    for (size_t total = 0; total < most && w->level_count < LEVELS; total += count, count *= 2) {
        const size_t rest = most - total;
        const size_t next = rest < 2 * count ? rest : count;
        const aur_result result =
            aur_sensor_rule_create(o->set, next, o->seed, &warnings, &w->rules[w->level_count], error);
        if (result != AUR_OK)
            return result;
        warnings = (aur_warnings){0}; /* warnings about a set are sent once */
        ++w->level_count;
        if (next == rest)
            break;
    }
    return AUR_OK;
}

/* --- one sensor */

enum { CHANNELS = AUR_IRRADIANCE_CHANNELS, VALUES = AUR_IRRADIANCE_PARTS * CHANNELS };

/* Components and channels of each randomisation. */
static void find_values(const work *w, const aur_sensor_sums *sensor_sums,
                        double values[REPLICATES][VALUES]) {
    const double *const luminance = w->options->luminance;
    memset(values, 0, REPLICATES * sizeof values[0]);
    for (size_t r = 0; r < REPLICATES; ++r)
        for (size_t part = 1; part < AUR_IRRADIANCE_PARTS; ++part) {
            const double *const rgb = sensor_sums->sums[r][part - 1];
            const double all[CHANNELS] = {rgb[0], rgb[1], rgb[2],
                                          luminance[0] * rgb[0] + luminance[1] * rgb[1] +
                                              luminance[2] * rgb[2]};
            for (size_t c = 0; c < CHANNELS; ++c) {
                values[r][part * CHANNELS + c] = all[c];
                values[r][AUR_IRRADIANCE_TOTAL * CHANNELS + c] += all[c];
            }
        }
}

static void judge(const work *w, const aur_levels *levels, aur_irradiance *found) {
    for (size_t part = 0; part < AUR_IRRADIANCE_PARTS; ++part)
        for (size_t c = 0; c < CHANNELS; ++c) {
            const aur_moments one = aur_levels_moments(levels, part * CHANNELS + c);
            found->value[part][c] = one.mean;
            found->error[part][c] = aur_moments_standard_error(&one);
            if (part == AUR_IRRADIANCE_TOTAL)
                found->half_width[c] = aur_moments_interval(&one, w->options->confidence);
        }
}

static bool is_reached(const work *w, const aur_irradiance *found) {
    const size_t luminance = AUR_IRRADIANCE_CHANNELS - 1;
    const double value = found->value[AUR_IRRADIANCE_TOTAL][luminance];
    if (!(value > 0.0))
        return found->directions >= (uint64_t)LEAST_DARK * REPLICATES;
    return found->half_width[luminance] <= w->options->error * value;
}

/* `shares` has room for all emitters. */
static aur_irradiance estimate(const work *w, aur_path_group *group, size_t sensor, float *shares) {
    aur_sensor_point surface_point;
    aur_sensor_point_create(w->scene, &w->lights, w->sensors->positions + 3 * sensor,
                            w->sensors->normals + 3 * sensor, w->options->seed, shares, &surface_point);
    double values[REPLICATES][VALUES], sums[REPLICATES * VALUES] = {0};
    aur_levels levels = {.replicates = REPLICATES, .values = VALUES, .sums = sums};
    const bool has_cache = w->cache.map != NULL || w->cache.solution != NULL;
    uint64_t dark = 0;
    aur_irradiance found = {.on_surface = surface_point.on_surface, .doubtful = surface_point.doubtful};
    for (size_t level = 0; level < w->level_count; ++level) {
        aur_sensor_sums sensor_sums;
        aur_sensor_trace(group, &w->rules[level], &surface_point, has_cache ? &w->cache : NULL,
                         (uint32_t)level, &sensor_sums);
        find_values(w, &sensor_sums, values);
        aur_levels_add(&levels, w->rules[level].count, values[0]);
        dark += sensor_sums.dark;
        found.directions += w->rules[level].count * REPLICATES;
        found.dark = (double)dark / (double)found.directions;
        judge(w, &levels, &found);
        if (w->options->error > 0.0 && is_reached(w, &found))
            break;
    }
    return found;
}

static aur_result estimate_block(void *context, size_t index) {
    const work *const w = context;
    aur_path_group group = {.sensor.panes = w->panes};
    float *const shares = malloc((w->lights.emitter_count + 1) * sizeof *shares);
    if (shares == NULL)
        return AUR_ERROR_MEMORY;
    aur_path_group_prepare(&w->path, w->scene, w->sampler, &group);
    for (size_t i = index * BLOCK; i < (index + 1) * BLOCK && i < w->sensors->count; ++i)
        w->results[i] = estimate(w, &group, i, shares);
    free(shares);
    return AUR_OK;
}

/* --- warnings */

static void warn(const work *w) {
    const size_t luminance = AUR_IRRADIANCE_CHANNELS - 1;
    const aur_irradiance_options *const o = w->options;
    aur_sensor_oddities odd = {0};
    aur_sensor_oddity unreached = {0};
    double worst = 0.0;
    for (size_t i = 0; i < w->sensors->count; ++i) {
        const aur_irradiance *const found = &w->results[i];
        const double value = found->value[AUR_IRRADIANCE_TOTAL][luminance];
        aur_sensor_note(i, found->on_surface, found->doubtful, found->dark, value, &odd);
        if (o->error > 0.0 && found->half_width[luminance] > o->error * value) {
            aur_sensor_count(i, &unreached);
            worst = fmax(worst, value > 0.0 ? found->half_width[luminance] / value : INFINITY);
        }
    }
    aur_sensors_warn(w->sensors, &o->warnings, &odd);
    if (unreached.count > 0)
        aur_warn_at(&o->warnings, aur_sensor_location(w->sensors, unreached.first),
                    "%zu of %zu sensors did not reach the error with %zu directions (the first is sensor "
                    "%zu); the worst reached %.3g",
                    unreached.count, w->sensors->count, o->directions, unreached.first, worst);
}

static aur_result run(work *w, aur_error *error) {
    const aur_irradiance_options *const o = w->options;
    aur_result result = aur_scene_refuse_media(w->scene, "irradiance at sensors", error);
    if (result == AUR_OK)
        result = make_rules(w, error);
    if (result == AUR_OK)
        result = aur_path_prepare(&w->path, w->scene, error);
    if (result == AUR_OK)
        result = aur_closed_lights_create(w->scene, &w->lights, error);
    if (result == AUR_OK)
        result = aur_cached_light_create(w->scene, o, &w->cache, error);
    if (result == AUR_OK)
        result = aur_sampler_create("sobol", w->rules[w->level_count - 1].count, NULL, &w->sampler, error);
    if (result == AUR_OK) {
        const aur_parallel_options parallel = {
            .threads = o->threads, .what = "sensors", .progress = o->progress, .flush_denormals = true};
        result =
            aur_parallel_for(&parallel, (w->sensors->count + BLOCK - 1) / BLOCK, estimate_block, w, error);
    }
    if (result == AUR_OK)
        warn(w);
    return result;
}

aur_result aur_irradiance_estimate(const aur_scene *scene, const aur_sensors_view *given,
                                   const aur_irradiance_options *given_options, size_t result_size,
                                   aur_irradiance *results, aur_error *error) {
    aur_irradiance_options options;
    aur_sensors_view sensors = {.size = sizeof sensors};
    aur_result result = read_options(given_options, &options, error);
    if (result == AUR_OK)
        result = aur_options_read(given, sizeof sensors, &sensors, "aur_sensors_view", error);
    if (result == AUR_OK && result_size != sizeof *results)
        result = aur_fail(error, AUR_ERROR_ARGUMENT, "the results have %zu bytes each, not %zu",
                          sizeof *results, result_size);
    if (result == AUR_OK)
        result = aur_sensors_check(&sensors, AUR_ERROR_ARGUMENT, error);
    if (result == AUR_OK && scene->emitter_count == 0)
        result = aur_fail_at(error, scene->document.tree.root->location, AUR_ERROR_UNSUPPORTED,
                             "the scene has no light, so that all would be 0");
    if (result != AUR_OK)
        return result;
    work w = {.options = &options,
              .sensors = &sensors,
              .scene = scene,
              .path = {.max_depth = options.max_depth > 0 && options.max_depth < UINT32_MAX
                                        ? (uint32_t)options.max_depth
                                        : UINT32_MAX,
                       .rr_depth = 5},
              .panes = aur_panes_exist(scene),
              .results = results};
    result = run(&w, error);
    for (size_t i = 0; i < w.level_count; ++i)
        aur_sensor_rule_release(&w.rules[i]);
    aur_closed_lights_release(&w.lights);
    aur_cached_light_release(&w.cache);
    aur_sampler_destroy(w.sampler);
    free(w.path.classes);
    return result;
}

aur_result aur_irradiance_options_init(aur_irradiance_options *options, aur_error *error) {
    static const aur_irradiance_options defaults = {.size = sizeof defaults};
    return aur_description_write(&defaults, sizeof defaults, options, "aur_irradiance_options", error);
}
