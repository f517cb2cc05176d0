/* Direct light alone: what the lights send to the surfaces that the camera sees, by sampling lights and BSDF
 * with any number of samples each, weighted by the power heuristic (Veach 1997). A mirror shows the lights.
 */
#include "render/film/integrator.h"
#include "render/vertex/vertex.h"

typedef struct direct_data {
    int64_t shading_samples, emitter_samples, bsdf_samples; /* -1: not given */
    bool hide_emitters;
} direct_data;

static const direct_data initial = {.shading_samples = -1, .emitter_samples = -1, .bsdf_samples = -1};

enum { MOST_SAMPLES = 1 << 16 };

static const aur_key keys[] = {
    {AUR_KEY_OF_INTEGER(direct_data, "shading_samples", shading_samples, 1, MOST_SAMPLES, "1",
                        "samples of lights and of the BSDF each"),
     .computed = true},
    {AUR_KEY_OF_INTEGER(direct_data, "emitter_samples", emitter_samples, 0, MOST_SAMPLES,
                        "as shading_samples", "samples of lights, instead of shading_samples"),
     .computed = true},
    {AUR_KEY_OF_INTEGER(direct_data, "bsdf_samples", bsdf_samples, 0, MOST_SAMPLES, "as shading_samples",
                        "samples of the BSDF, instead of shading_samples"),
     .computed = true},
    {AUR_KEY_OF_BOOLEAN(direct_data, "hide_emitters", hide_emitters, "false",
                        "lights are black to the camera")},
};

static aur_result create(aur_parameters *parameters, const aur_integrator_context *context,
                         aur_integrator *integrator, aur_error *error) {
    (void)context;
    direct_data *const data = integrator->data;
    if (data->shading_samples >= 0 && (data->emitter_samples >= 0 || data->bsdf_samples >= 0))
        return aur_fail_at(error, parameters->location, AUR_ERROR_FORMAT,
                           "integrator 'direct': give either 'shading_samples' or 'emitter_samples' and "
                           "'bsdf_samples'");
    if (data->emitter_samples == 0 && data->bsdf_samples == 0)
        return aur_fail_at(error, parameters->location, AUR_ERROR_FORMAT,
                           "integrator 'direct': 'emitter_samples' and 'bsdf_samples' cannot both be 0");
    const int64_t each = data->shading_samples >= 0 ? data->shading_samples : 1;
    if (data->emitter_samples < 0)
        data->emitter_samples = each;
    if (data->bsdf_samples < 0)
        data->bsdf_samples = each;
    return AUR_OK;
}

static aur_vector sample_light(const aur_scene *scene, const direct_data *data, const aur_shading *shading,
                               const float u[3]) {
    const aur_vertex_samples samples = {(float)data->emitter_samples, (float)data->bsdf_samples};
    aur_shadow shadow;
    if (!aur_vertex_draw_light(scene, shading, AUR_VERTEX_ALL, samples, u, &shadow))
        return (aur_vector){0};
    return aur_scene_occluded(scene, &shadow.ray) ? (aur_vector){0} : shadow.radiance;
}

static aur_vector sample_bsdf(const aur_scene *scene, const direct_data *data, const aur_shading *shading,
                              const float u[3]) {
    aur_bsdf_sample sample;
    if (!aur_vertex_direction(shading, AUR_VERTEX_ALL, u, &sample))
        return (aur_vector){0};
    const float count = (float)data->bsdf_samples;
    const aur_bounce bounce = {aur_shading_reference(shading), count * sample.pdf,
                               (float)data->emitter_samples, sample.specular};
    const aur_ray ray = aur_surface_ray(shading->surface, sample.light);
    aur_hit hit;
    aur_surface surface;
    const bool found = aur_scene_intersect(scene, &ray, &hit);
    if (found)
        aur_scene_surface(scene, &ray, &hit, &surface);
    float light_pdf;
    const aur_vector emission =
        aur_vertex_emission(scene, &bounce, ray.direction, found ? &surface : NULL, &light_pdf);
    if (aur_vector_is_zero(emission))
        return (aur_vector){0};
    return aur_vector_scale(aur_vector_multiply(sample.weight, emission),
                            aur_bounce_weight(&bounce, light_pdf) / count);
}

static aur_vector radiance(const aur_integrator *integrator, const aur_camera_sample *sample,
                           aur_counters *counters) {
    const direct_data *const data = integrator->data;
    const aur_scene *const scene = integrator->scene;
    aur_ray ray = sample->ray;
    aur_surface surface;
    if (!aur_visible_surface(scene, data->hide_emitters, &ray, &surface, counters))
        return data->hide_emitters ? (aur_vector){0} : aur_scene_background(scene, ray.direction);
    const aur_vector view = aur_vector_scale(ray.direction, -1.0f);
    aur_vector sum = aur_surface_emission(scene, &surface, view);
    if (aur_scene_emitter_count(scene) == 0)
        return sum;
    const aur_shading shading = aur_shading_at(&surface, view);
    uint32_t pair = AUR_PAIR_FIRST; /* two per sample: choice, then position or direction */
    for (int64_t i = 0; i < data->emitter_samples + data->bsdf_samples; ++i, pair += 2) {
        float u[2][2];
        aur_stream_pairs(&sample->stream, pair, 2, u);
        const float numbers[3] = {u[0][0], u[1][0], u[1][1]};
        sum = aur_vector_add(sum, i < data->emitter_samples ? sample_light(scene, data, &shading, numbers)
                                                            : sample_bsdf(scene, data, &shading, numbers));
    }
    return sum;
}

const aur_integrator_descriptor aur_integrator_direct = {
    .row = {.name = "direct",
            .summary = "direct light by sampling lights and materials",
            .source = "Veach 1997",
            AUR_ROW_KEYS(keys)},
    .size = sizeof(direct_data),
    .initial = &initial,
    .create = create,
    .radiance = radiance,
    .own_image = true,
};
