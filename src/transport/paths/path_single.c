/* One path by itself: the clear form, which paths in packets are compared with. */
#include "transport/lights/direct_light.h"
#include "transport/lights/first_surface.h"
#include "transport/paths/path.h"

/* A path on its way. */
typedef struct aur_path_walk {
    aur_vector sum, throughput;
    aur_ray ray;
    /* The surface that the ray left and the density of its direction there. */
    aur_light_reference from;
    float pdf;
    /* No light sample could have found what the ray meets. */
    bool specular;
} aur_path_walk;

static void add_sky(const aur_scene *scene, aur_path_walk *walk) {
    float rival;
    const aur_vector sky = aur_environment_light(scene, walk->ray.direction, &rival);
    if (aur_vector_is_zero(sky))
        return;
    const float weight = walk->specular ? 1.0f : aur_power_heuristic(walk->pdf, rival);
    walk->sum = aur_vector_add_scaled(walk->sum, weight, aur_vector_multiply(walk->throughput, sky));
}

static void add_emission(const aur_scene *scene, const aur_surface *surface, aur_vector view,
                         aur_path_walk *walk) {
    if (surface->emitter == AUR_NO_EMITTER)
        return;
    const aur_vector emission = aur_surface_emission(scene, surface, view);
    const float weight =
        walk->specular || aur_vector_is_zero(emission)
            ? 1.0f
            : aur_power_heuristic(walk->pdf, aur_light_pdf_direct(scene, &walk->from, surface));
    walk->sum = aur_vector_add_scaled(walk->sum, weight, aur_vector_multiply(walk->throughput, emission));
}

/* Adds direct light and goes on in a drawn direction; false where the path ends. */
static bool scatter(const aur_path *data, const aur_scene *scene, const aur_surface *surface, aur_vector view,
                    uint32_t depth, const float (*pairs)[2], aur_path_walk *walk, aur_counters *counters) {
    const aur_shading shading = aur_shading_at(surface, view);
    const float *const position = pairs[AUR_PATH_POSITION], *const direction = pairs[AUR_PATH_DIRECTION];
    /* Both directions before the shadow ray: the processor works at them together. */
    aur_shadow shadow;
    const bool lit = aur_scene_emitter_count(scene) > 0 &&
                     aur_direct_light_choose(
                         scene, &shading, &AUR_LIGHT_DRAWS_OF_PATHS,
                         (const float[3]){pairs[AUR_PATH_CHOICE][0], position[0], position[1]}, &shadow);
    aur_bsdf_sample drawn;
    const bool goes_on = aur_shading_sample(
        &shading, (const float[3]){pairs[AUR_PATH_LOBE][0], direction[0], direction[1]}, &drawn);
    if (lit) {
        ++counters->rays;
        if (!aur_scene_occluded(scene, &shadow.ray))
            walk->sum = aur_vector_add(walk->sum, aur_vector_multiply(walk->throughput, shadow.radiance));
    }
    if (!goes_on)
        return false;
    walk->throughput = aur_vector_multiply(walk->throughput, drawn.weight);
    if (depth >= data->rr_depth) {
        const float survival = aur_path_survival(walk->throughput);
        if (!(pairs[AUR_PATH_CHOICE][1] < survival))
            return false;
        walk->throughput = aur_vector_scale(walk->throughput, 1.0f / survival);
    }
    walk->from = aur_shading_reference(&shading);
    walk->pdf = drawn.pdf;
    walk->specular = drawn.specular;
    walk->ray = aur_surface_ray(surface, drawn.light);
    return !aur_vector_is_zero(walk->throughput);
}

aur_vector aur_path_radiance(const aur_path *data, const aur_scene *scene, const aur_camera_sample *sample,
                             const aur_vector *seen, aur_counters *counters) {
    /* Light sampling cannot hit the camera either. */
    aur_path_walk walk = {.sum = seen != NULL ? *seen : (aur_vector){0},
                          .throughput = {1.0f, 1.0f, 1.0f},
                          .ray = sample->ray,
                          .specular = true};
    float ahead[AUR_STREAM_BLOCK][2];
    for (uint32_t depth = 1; depth <= data->max_depth; ++depth) {
        /* Before the ray, so that the processor works at both. */
        if (depth % 2 == 0)
            aur_stream_pairs(&sample->stream, aur_path_pair(depth), AUR_STREAM_BLOCK, ahead);
        const float(*const pairs)[2] = depth == 1 ? &sample->first_pairs[AUR_PAIR_FIRST]
                                                  : (const float(*)[2]) & ahead[depth % 2 * AUR_PATH_PAIRS];
        aur_surface surface;
        const bool hide = data->hide_emitters && depth == 1, told = seen != NULL && depth == 1;
        if (!aur_visible_surface(scene, hide, &walk.ray, &surface, counters)) {
            if (!hide && !told)
                add_sky(scene, &walk);
            break;
        }
        const aur_vector view = aur_vector_scale(walk.ray.direction, -1.0f);
        if (!told)
            add_emission(scene, &surface, view, &walk);
        if (depth == data->max_depth || !scatter(data, scene, &surface, view, depth, pairs, &walk, counters))
            break;
    }
    return walk.sum;
}

void aur_path_add_sample(const aur_path *data, const aur_scene *scene, size_t x, size_t y, uint32_t index,
                         aur_tile *tile) {
    aur_camera_sample sample;
    aur_vector seen;
    const float weight = aur_view_sample(tile->view, x, y, index, &sample);
    const bool told = aur_lamp_look(data->looks, tile->view, x, y, index, &seen, &tile->counters);
    aur_tile_add(tile, x, y, weight,
                 aur_path_radiance(data, scene, &sample, told ? &seen : NULL, &tile->counters));
}
