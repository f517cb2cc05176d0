/* The reference integrator: unidirectional path tracing with next-event estimation, multiple importance
 * sampling and Russian roulette (Kajiya 1986; Veach 1997). */
#include <stdlib.h>

#include "transport/lights/direct_light.h"
#include "transport/lights/first_surface.h"
#include "transport/paths/path.h"

typedef struct path_parameters {
    int64_t max_depth, rr_depth;
    bool hide_emitters, strict_normals, packets, interleaved;
} path_parameters;

static const aur_key keys[] = {
    {AUR_KEY_OF_INTEGER(
        path_parameters, "max_depth", max_depth, -1, 1 << 20, "-1",
        "longest path in edges: 1 is emitted light only, 2 adds direct light; -1 is unlimited")},
    {AUR_KEY_OF_INTEGER(path_parameters, "rr_depth", rr_depth, 1, 1 << 20, "5",
                        "Russian roulette from this depth on")},
    {AUR_KEY_OF_BOOLEAN(path_parameters, "strict_normals", strict_normals, "false",
                        "of no effect: it is always so")},
    {AUR_KEY_OF_BOOLEAN(path_parameters, "hide_emitters", hide_emitters, "false",
                        "lights are black to the camera")},
    {AUR_KEY_OF_BOOLEAN(path_parameters, "packets", packets, "true",
                        "sixteen pixels in lockstep, else one path at a time: the same picture")},
    {AUR_KEY_OF_BOOLEAN(path_parameters, "interleaved", interleaved, "false",
                        "the pixels of a packet share the random numbers of all but their camera rays")},
};

static aur_result create(aur_parameters *parameters, const aur_integrator_context *context,
                         aur_integrator *integrator, aur_error *error) {
    path_parameters p;
    const aur_result result = aur_row_read(&integrator->descriptor->row, parameters, &p, error);
    if (result != AUR_OK)
        return result;
    if (aur_parameters_find(parameters, "strict_normals") != NULL)
        aur_warn_at(&context->warnings, parameters->location,
                    "integrator 'path': 'strict_normals' has no effect: it is always so");
    if (p.interleaved && (!p.packets || p.hide_emitters))
        return aur_fail_at(error, parameters->location, AUR_ERROR_FORMAT,
                           "integrator 'path': 'interleaved' goes neither with 'packets=false' nor with "
                           "'hide_emitters=true'");
    aur_path *const data = calloc(1, sizeof *data);
    if (data == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    *data = (aur_path){.max_depth = p.max_depth < 0 ? UINT32_MAX : (uint32_t)p.max_depth,
                       .rr_depth = (uint32_t)p.rr_depth,
                       .hide_emitters = p.hide_emitters,
                       .packets = p.packets,
                       .interleaved = p.interleaved};
    integrator->data = data;
    return aur_path_prepare(data, context->scene, error);
}

static void release(aur_integrator *integrator) {
    aur_path *const data = integrator->data;
    free(data->classes);
    free(data);
}

static aur_vector radiance(const aur_integrator *integrator, const aur_camera_sample *sample,
                           aur_counters *counters) {
    const aur_path *const data = integrator->data;
    const aur_scene *const scene = integrator->scene;
    const bool has_lights = aur_scene_emitter_count(scene) > 0;
    aur_vector sum = {0}, throughput = {1.0f, 1.0f, 1.0f};
    aur_vector previous = {0};
    float previous_pdf = 0.0f;
    bool previous_specular = true; /* the camera cannot be hit by light sampling either */
    aur_ray ray = sample->ray;
    float ahead[AUR_STREAM_BLOCK][2];

    for (uint32_t depth = 1; depth <= data->max_depth; ++depth) {
        /* Before the ray, so that the processor works at both. */
        if (depth % 2 == 0)
            aur_stream_pairs(&sample->stream, aur_path_pair(depth), AUR_STREAM_BLOCK, ahead);
        const float *const choice =
            depth == 1 ? sample->first_pairs[AUR_PAIR_FIRST] : ahead[depth % 2 * AUR_PATH_PAIRS];
        const float *const position = choice + 2, *const lobe = choice + 4, *const direction = choice + 6;
        aur_surface surface;
        const bool hide = data->hide_emitters && depth == 1;
        if (!aur_visible_surface(scene, hide, &ray, &surface, counters)) {
            if (hide)
                break;
            const aur_vector sky = aur_scene_environment(scene, ray.direction);
            if (!aur_vector_is_zero(sky)) {
                const float weight =
                    previous_specular
                        ? 1.0f
                        : aur_power_heuristic(previous_pdf, aur_environment_pdf_direct(scene, ray.direction));
                sum = aur_vector_add_scaled(sum, weight, aur_vector_multiply(throughput, sky));
            }
            break;
        }
        const aur_vector view = aur_vector_scale(ray.direction, -1.0f);
        if (surface.emitter != AUR_NO_EMITTER) {
            const aur_vector emission = aur_surface_emission(scene, &surface, view);
            const float weight =
                previous_specular || aur_vector_is_zero(emission)
                    ? 1.0f
                    : aur_power_heuristic(
                          previous_pdf,
                          aur_light_pdf_direct(scene, previous, AUR_LEAST_LIGHT_OF_PATHS, &surface));
            sum = aur_vector_add_scaled(sum, weight, aur_vector_multiply(throughput, emission));
        }
        if (depth == data->max_depth)
            break;

        const aur_shading shading = aur_shading_at(&surface, view);
        /* Both directions before the shadow ray: the processor works at them together. */
        aur_shadow shadow;
        const bool lit = has_lights && aur_direct_light_choose(scene, &shading, choice[0], position, &shadow);
        aur_bsdf_sample scattered;
        const bool goes_on =
            aur_shading_sample(&shading, (const float[3]){lobe[0], direction[0], direction[1]}, &scattered);
        if (lit) {
            ++counters->rays;
            if (!aur_scene_occluded(scene, &shadow.ray))
                sum = aur_vector_add(sum, aur_vector_multiply(throughput, shadow.radiance));
        }
        if (!goes_on)
            break;
        throughput = aur_vector_multiply(throughput, scattered.weight);
        if (depth >= data->rr_depth) {
            const float survival = aur_path_survival(throughput);
            if (!(choice[1] < survival))
                break;
            throughput = aur_vector_scale(throughput, 1.0f / survival);
        }
        if (aur_vector_is_zero(throughput))
            break;
        previous = surface.position;
        previous_pdf = scattered.pdf;
        previous_specular = scattered.specular;
        ray = aur_surface_ray(&surface, scattered.light);
    }
    return sum;
}

static void add_one_by_one(const aur_integrator *integrator, aur_tile *tile) {
    for (size_t y = tile->y0; y < tile->y1; ++y)
        for (size_t x = tile->x0; x < tile->x1; ++x)
            for (uint32_t i = 0; i < tile->count; ++i) {
                aur_camera_sample sample;
                const float weight = aur_view_sample(tile->view, x, y, tile->first + i, &sample);
                aur_tile_add(tile, x, y, weight, radiance(integrator, &sample, &tile->counters));
            }
}

static aur_result tile(const aur_integrator *integrator, aur_tile *tile) {
    const aur_path *const data = integrator->data;
    if (data->packets && !data->hide_emitters)
        aur_path_add_tile(data, integrator->scene, tile);
    else
        add_one_by_one(integrator, tile);
    return AUR_OK;
}

const aur_integrator_descriptor aur_integrator_path = {
    .row = {.name = "path",
            .summary = "unidirectional path tracing with multiple importance sampling, the reference",
            .source = "Kajiya 1986, Veach 1997",
            AUR_ROW_KEYS(keys)},
    .create = create,
    .release = release,
    .radiance = radiance,
    .tile = tile,
};
