/* Writes the daylight coefficients of all sensors as a matrix, for programs that multiply them by sky
 * vectors. */
#include <aureole-lighting/daylight.h>
#include <aureole/statistics.h>
#include <aureole/text.h>
#include <stdlib.h>
#include <string.h>

#include "lighting/daylight/coefficients.h"
#include "lighting/irradiance/sensors.h"
#include "points/base/error.h"
#include "points/base/file.h"
#include "points/base/parallel.h"

enum { LANES = AUR_DAYLIGHT_LANES, CHANNELS = 3 };

typedef struct sensor_state {
    bool on_surface, doubtful;
    double dark, light;
} sensor_state;

typedef struct work {
    const aur_daylight_options *options;
    const aur_sensors_view *sensors;
    aur_coefficient_trace trace;
    double *coefficients, *errors;
    sensor_state *states;
} work;

size_t aur_daylight_patch_count(size_t subdivision) {
    return subdivision > 0 ? 144 * subdivision * subdivision + 2 : aur_daylight_patch_count(1);
}

static void reduce(const work *w, size_t sensor, const double *all) {
    const size_t patches = w->trace.patches.count, channels = CHANNELS;
    for (size_t p = 0; p < patches; ++p)
        for (size_t c = 0; c < channels; ++c) {
            const size_t at = channels * (sensor * patches + p) + c;
            aur_moments one = {0};
            for (size_t k = 0; k < LANES; ++k)
                aur_moments_add(&one, all[(c * patches + p) * LANES + k]);
            w->coefficients[at] = one.mean;
            if (w->errors != NULL)
                w->errors[at] = aur_moments_standard_error(&one);
            w->states[sensor].light += one.mean;
        }
}

static aur_result estimate_sensor(void *context, size_t sensor) {
    static const aur_closed_lights none = {0};
    const work *const w = context;
    const size_t count = CHANNELS * w->trace.patches.count * LANES;
    double *const all = malloc(2 * count * sizeof *all);
    if (all == NULL)
        return AUR_ERROR_MEMORY;
    aur_path_group group = {.sensor.panes = w->trace.panes};
    const aur_coefficients coefficients = {.patches = &w->trace.patches,
                                           .sky = &w->trace.sky,
                                           .channels = CHANNELS,
                                           .weights = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}},
                                           .all = all,
                                           .reflected = all + count};
    aur_sensor_point point;
    aur_sensor_sums sums;
    aur_path_group_prepare(&w->trace.path, w->trace.sky.scene, w->trace.sampler, &group);
    aur_sensor_point_create(w->trace.sky.scene, &none, w->sensors->positions + 3 * sensor,
                            w->sensors->normals + 3 * sensor, w->options->seed, NULL, &point);
    aur_coefficients_find(&group, &w->trace.rule, &point, &coefficients, &sums);
    w->states[sensor] = (sensor_state){.on_surface = point.on_surface,
                                       .doubtful = point.doubtful,
                                       .dark = (double)sums.dark / (double)(w->trace.rule.count * LANES)};
    reduce(w, sensor, all);
    free(all);
    return AUR_OK;
}

static void warn(const work *w) {
    aur_sensor_oddities odd = {0};
    for (size_t i = 0; i < w->sensors->count; ++i) {
        const sensor_state *const state = &w->states[i];
        aur_sensor_note(i, state->on_surface, state->doubtful, state->dark, state->light, &odd);
    }
    aur_sensors_warn(w->sensors, &w->options->warnings, &odd);
}

aur_result aur_daylight_coefficients(const aur_scene *scene, const aur_sensors_view *given,
                                     const aur_daylight_options *given_options, double *coefficients,
                                     double *errors, aur_error *error) {
    aur_daylight_options options;
    aur_sensors_view sensors = {.size = sizeof sensors};
    aur_result result = aur_daylight_options_read(given_options, &options, error);
    if (result == AUR_OK)
        result = aur_options_read(given, sizeof sensors, &sensors, "aur_sensors_view", error);
    if (result == AUR_OK)
        result = aur_sensors_check(&sensors, AUR_ERROR_ARGUMENT, error);
    if (result != AUR_OK)
        return result;
    options.ground_albedo = 1.0; /* the ground patch is traced for any reflectance */
    work w = {.options = &options, .sensors = &sensors, .coefficients = coefficients, .errors = errors};
    result = aur_coefficient_trace_create(scene, &options, &w.trace, error);
    w.states = calloc(sensors.count, sizeof *w.states);
    if (result == AUR_OK && w.states == NULL)
        result = aur_fail_memory(error);
    const aur_parallel_options parallel = {
        .threads = options.threads, .what = "sensors", .progress = options.progress, .flush_denormals = true};
    if (result == AUR_OK)
        result = aur_parallel_for(&parallel, sensors.count, estimate_sensor, &w, error);
    if (result == AUR_OK)
        warn(&w);
    free(w.states);
    aur_coefficient_trace_release(&w.trace);
    return result;
}

/* Radiance matrices are rows of r, g, b as floats in native byte order. */
static void write_radiance(size_t sensors, size_t patches, const double *coefficients, FILE *stream) {
    fprintf(stream, "#?RADIANCE\nNROWS=%zu\nNCOLS=%zu\nNCOMP=%d\nBigEndian=%d\nFORMAT=float\n\n", sensors,
            patches, CHANNELS, __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__);
    for (size_t i = 0; i < sensors * patches * CHANNELS; ++i)
        fwrite(&(float){(float)coefficients[i]}, sizeof(float), 1, stream);
}

static void write_npy(size_t sensors, size_t patches, const double *coefficients, FILE *stream) {
    char shape[64];
    aur_format(shape, sizeof shape, "%zu, %zu, %d", sensors, patches, CHANNELS);
    aur_daylight_npy_head(shape, stream);
    fwrite(coefficients, sizeof *coefficients, sensors * patches * CHANNELS, stream);
}

aur_result aur_daylight_coefficients_write(const char *path, size_t sensors, size_t subdivision,
                                           const double *coefficients, aur_error *error) {
    const size_t length = strlen(path), patches = aur_daylight_patch_count(subdivision);
    aur_file_writer writer;
    const aur_result result = aur_file_open(path, &writer, error);
    if (result != AUR_OK)
        return result;
    if (length > 4 && strcmp(path + length - 4, ".npy") == 0)
        write_npy(sensors, patches, coefficients, writer.stream);
    else
        write_radiance(sensors, patches, coefficients, writer.stream);
    return aur_file_commit(&writer, error);
}
