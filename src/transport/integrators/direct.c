/* Direct light alone: what the lights send to the surfaces that the camera sees, by sampling lights and BSDF
 * with any number of samples each, weighted by the power heuristic (Veach 1997). A mirror shows the lights.
 */
#include <stdlib.h>

#include "transport/integrator.h"
#include "transport/lights/direct_light.h"
#include "transport/lights/first_surface.h"

typedef struct direct_data {
    uint32_t emitter_samples, bsdf_samples;
    bool hide_emitters;
} direct_data;

typedef struct direct_parameters {
    int64_t shading, emitter, bsdf; /* -1: not given */
    bool hide_emitters;
} direct_parameters;

enum { MOST_SAMPLES = 1 << 16 };

static const aur_key keys[] = {
    {AUR_KEY_OF_INTEGER(direct_parameters, "shading_samples", shading, 1, MOST_SAMPLES, "1",
                        "samples of lights and of the BSDF each"),
     .computed = true},
    {AUR_KEY_OF_INTEGER(direct_parameters, "emitter_samples", emitter, 0, MOST_SAMPLES, "1",
                        "samples of lights, in place of shading_samples"),
     .computed = true},
    {AUR_KEY_OF_INTEGER(direct_parameters, "bsdf_samples", bsdf, 0, MOST_SAMPLES, "1",
                        "samples of the BSDF, in place of shading_samples"),
     .computed = true},
    {AUR_KEY_OF_BOOLEAN(direct_parameters, "hide_emitters", hide_emitters, "false",
                        "lights are black to the camera")},
};

/* What the keys mean together. */
static aur_result check(const direct_parameters *p, aur_location location, aur_error *error) {
    if (p->shading >= 0 && (p->emitter >= 0 || p->bsdf >= 0))
        return aur_fail_at(error, location, AUR_ERROR_FORMAT,
                           "integrator 'direct': give either 'shading_samples' or 'emitter_samples' and "
                           "'bsdf_samples'");
    if (p->emitter == 0 && p->bsdf == 0)
        return aur_fail_at(error, location, AUR_ERROR_FORMAT,
                           "integrator 'direct': 'emitter_samples' and 'bsdf_samples' cannot both be 0");
    return AUR_OK;
}

static aur_result create(aur_parameters *parameters, const aur_integrator_context *context,
                         aur_integrator *integrator, aur_error *error) {
    (void)context;
    direct_parameters p = {.shading = -1, .emitter = -1, .bsdf = -1};
    aur_result result = aur_row_read(&integrator->descriptor->row, parameters, &p, error);
    if (result == AUR_OK)
        result = check(&p, parameters->location, error);
    if (result != AUR_OK)
        return result;
    const int64_t each = p.shading >= 0 ? p.shading : 1;
    direct_data *const data = malloc(sizeof *data);
    if (data == NULL)
        return aur_fail_memory(error);
    *data = (direct_data){.emitter_samples = (uint32_t)(p.emitter >= 0 ? p.emitter : each),
                          .bsdf_samples = (uint32_t)(p.bsdf >= 0 ? p.bsdf : each),
                          .hide_emitters = p.hide_emitters};
    integrator->data = data;
    return AUR_OK;
}

static void release(aur_integrator *integrator) {
    free(integrator->data);
}

static aur_vector sample_light(const aur_scene *scene, const direct_data *data, const aur_shading *shading,
                               const float u[3], aur_counters *counters) {
    const aur_light_draws draws = {AUR_LEAST_LIGHT_SEEN, (float)data->emitter_samples,
                                   (float)data->bsdf_samples};
    aur_shadow shadow;
    if (!aur_direct_light_choose(scene, shading, &draws, u, &shadow))
        return (aur_vector){0};
    ++counters->rays;
    return aur_scene_occluded(scene, &shadow.ray) ? (aur_vector){0} : shadow.radiance;
}

static aur_vector sample_bsdf(const aur_scene *scene, const direct_data *data, const aur_shading *shading,
                              const float u[3], aur_counters *counters) {
    const aur_vector black = {0};
    aur_bsdf_sample sample;
    if (!aur_shading_sample(shading, u, &sample))
        return black;
    const aur_ray ray = aur_surface_ray(shading->surface, sample.light);
    aur_hit hit;
    aur_vector light;
    float rival;
    ++counters->rays;
    if (aur_scene_intersect(scene, &ray, &hit)) {
        aur_surface surface;
        aur_scene_surface(scene, &ray, &hit, &surface);
        light = aur_surface_emission(scene, &surface, aur_vector_scale(ray.direction, -1.0f));
        rival = aur_light_pdf_direct(scene, shading->surface->position, AUR_LEAST_LIGHT_SEEN, &surface);
    } else {
        light = aur_scene_environment(scene, ray.direction);
        rival = aur_environment_pdf_direct(scene, ray.direction);
    }
    if (aur_vector_is_zero(light))
        return black;
    const float count = (float)data->bsdf_samples;
    const float weight = sample.specular
                             ? 1.0f
                             : aur_power_heuristic(count * sample.pdf, (float)data->emitter_samples * rival);
    return aur_vector_scale(aur_vector_multiply(sample.weight, light), weight / count);
}

static aur_vector radiance(const aur_integrator *integrator, const aur_camera_sample *sample,
                           aur_counters *counters) {
    const direct_data *const data = integrator->data;
    const aur_scene *const scene = integrator->scene;
    aur_ray ray = sample->ray;
    aur_surface surface;
    if (!aur_visible_surface(scene, data->hide_emitters, &ray, &surface, counters))
        return data->hide_emitters ? (aur_vector){0} : aur_scene_environment(scene, ray.direction);
    const aur_vector view = aur_vector_scale(ray.direction, -1.0f);
    aur_vector sum = aur_surface_emission(scene, &surface, view);
    if (aur_scene_emitter_count(scene) == 0)
        return sum;
    const aur_shading shading = aur_shading_at(&surface, view);
    uint32_t pair = AUR_PAIR_FIRST; /* two a sample: choice, then position or direction */
    for (uint32_t i = 0; i < data->emitter_samples + data->bsdf_samples; ++i, pair += 2) {
        float u[2][2];
        aur_stream_pairs(&sample->stream, pair, 2, u);
        const float numbers[3] = {u[0][0], u[1][0], u[1][1]};
        sum = aur_vector_add(sum, i < data->emitter_samples
                                      ? sample_light(scene, data, &shading, numbers, counters)
                                      : sample_bsdf(scene, data, &shading, numbers, counters));
    }
    return sum;
}

const aur_integrator_descriptor aur_integrator_direct = {
    .row = {.name = "direct",
            .summary = "direct light by sampling lights and materials",
            .source = "Veach 1997",
            AUR_ROW_KEYS(keys)},
    .create = create,
    .release = release,
    .radiance = radiance,
};
