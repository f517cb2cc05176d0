/* The reference integrator: unidirectional path tracing with next-event estimation, multiple importance
 * sampling and Russian roulette (Kajiya 1986; Veach 1997). */
#include <stdlib.h>

#include "transport/direct_light.h"
#include "transport/integrator.h"
#include "transport/visible.h"

typedef struct path_data {
    uint32_t max_depth; /* UINT32_MAX: no limit; 1 is visible light only, 2 adds direct light */
    uint32_t rr_depth;  /* Russian roulette from this depth on */
    bool hide_emitters; /* from the camera */
} path_data;

static aur_result create(aur_parameters *parameters, const aur_integrator_context *context,
                         aur_integrator *integrator, aur_error *error) {
    int64_t max_depth = -1, rr_depth = 5;
    aur_result result = aur_parameters_integer(parameters, "max_depth", -1, 1 << 20, &max_depth, error);
    if (result == AUR_OK)
        result = aur_parameters_integer(parameters, "rr_depth", 1, 1 << 20, &rr_depth, error);
    bool hide_emitters = false, strict_normals = false;
    if (result == AUR_OK)
        result = aur_parameters_boolean(parameters, "strict_normals", &strict_normals, error);
    if (result == AUR_OK && aur_parameters_find(parameters, "strict_normals") != NULL)
        aur_warn_at(&context->warnings, parameters->location,
                    "integrator 'path': 'strict_normals' has no effect: it is always so");
    if (result == AUR_OK)
        result = aur_parameters_boolean(parameters, "hide_emitters", &hide_emitters, error);
    if (result == AUR_OK)
        result = aur_parameters_finish(parameters, error);
    if (result != AUR_OK)
        return result;
    path_data *const data = malloc(sizeof *data);
    if (data == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    *data = (path_data){.max_depth = max_depth < 0 ? UINT32_MAX : (uint32_t)max_depth,
                        .rr_depth = (uint32_t)rr_depth,
                        .hide_emitters = hide_emitters};
    integrator->data = data;
    return AUR_OK;
}

static void release(aur_integrator *integrator) {
    free(integrator->data);
}

/* Pairs of one bounce: (light choice, roulette), light position, (lobe choice, unused), direction. Those of
 * the first come with the camera's, the others two bounces at once. */
enum { PAIRS_A_BOUNCE = 4, PAIRS_AT_ONCE = AUR_STREAM_BLOCK };

static aur_vector radiance(const aur_integrator *integrator, const aur_camera_sample *sample,
                           aur_counters *counters) {
    const path_data *const data = integrator->data;
    const aur_scene *const scene = integrator->scene;
    const bool has_lights = aur_scene_emitter_count(scene) > 0;
    aur_vector sum = {0}, throughput = {1.0f, 1.0f, 1.0f};
    aur_vector previous = {0};
    float previous_pdf = 0.0f;
    bool previous_specular = true; /* the camera cannot be hit by light sampling either */
    aur_ray ray = sample->ray;
    float ahead[PAIRS_AT_ONCE][2];

    for (uint32_t depth = 1; depth <= data->max_depth; ++depth) {
        /* Before the ray, so that the processor works at both. */
        if (depth % 2 == 0)
            aur_stream_pairs(&sample->stream, PAIRS_AT_ONCE + PAIRS_A_BOUNCE * (depth - 2), PAIRS_AT_ONCE,
                             ahead);
        const float *const choice =
            depth == 1 ? sample->first_pairs[AUR_PAIR_FIRST] : ahead[depth % 2 * PAIRS_A_BOUNCE];
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
                    : aur_power_heuristic(previous_pdf, aur_light_pdf_direct(scene, previous, &surface));
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
            const float survival = aur_smaller(aur_vector_max(throughput), 0.95f);
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

const aur_integrator_descriptor aur_integrator_path = {
    .description = {.name = "path",
                    .keys = "max_depth=-1, rr_depth=5, hide_emitters=false",
                    .summary = "unidirectional path tracing with multiple importance sampling, the reference",
                    .source = "Kajiya 1986, Veach 1997"},
    .create = create,
    .release = release,
    .radiance = radiance,
};
