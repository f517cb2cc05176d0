/* One path by itself: the clear form, which paths in packets are compared with. */
#include "render/path/path.h"
#include "render/vertex/candidates.h"
#include "render/vertex/first_surface.h"
#include "render/vertex/vertex.h"

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

/* A ray to a point on a light, and what that brings along the path if nothing lies between. */
typedef struct light_draw {
    aur_ray ray;
    aur_vector light;
    bool lit; /* light comes that way */
} light_draw;

/* `u` chooses the light and a point on it. */
static light_draw draw_light(const aur_scene *scene, const aur_shading *shading, aur_vector throughput,
                             const float u[3]) {
    aur_shadow shadow;
    if (!aur_direct_light_choose(scene, shading, &AUR_LIGHT_DRAWS_OF_PATHS, u, &shadow))
        return (light_draw){0};
    return (light_draw){shadow.ray, aur_vector_multiply(throughput, shadow.radiance), true};
}

/* The same of one of `count` candidates, which `selection` chooses. */
static light_draw draw_candidates(const aur_scene *scene, const aur_shading *shading, aur_vector throughput,
                                  uint32_t count, const float u[3], float selection) {
    light_draw kept = {0};
    float total = 0.0f, own = 0.0f;
    for (uint32_t i = 0; i < count; ++i) {
        float shifted[3];
        aur_candidate_shift(i, count, shifted);
        for (size_t d = 0; d < 3; ++d)
            shifted[d] = aur_candidate_number(u[d], shifted[d]);
        const light_draw draw = draw_light(scene, shading, throughput, shifted);
        const float weight = draw.lit ? aur_candidate_weight(draw.light) : 0.0f;
        if (!aur_candidate_wins(weight, &total, &selection))
            continue;
        kept = draw;
        own = weight;
    }
    if (kept.lit)
        kept.light = aur_vector_scale(kept.light, aur_candidate_scale(count, total, own));
    return kept;
}

/* Adds direct light and goes on in a drawn direction; false where the path ends. */
static bool scatter(const aur_path *data, const aur_scene *scene, const aur_surface *surface, aur_vector view,
                    uint32_t depth, const float (*pairs)[2], aur_path_walk *walk) {
    const aur_shading shading = aur_shading_at(surface, view);
    const float *const position = pairs[AUR_PATH_POSITION], *const direction = pairs[AUR_PATH_DIRECTION];
    /* Both directions before the shadow ray: the processor works at them together. */
    const float u[3] = {pairs[AUR_PATH_CHOICE][0], position[0], position[1]};
    light_draw draw = {0};
    if (aur_scene_emitter_count(scene) > 0)
        draw = data->candidates > 1 ? draw_candidates(scene, &shading, walk->throughput, data->candidates, u,
                                                      pairs[AUR_PATH_LOBE][1])
                                    : draw_light(scene, &shading, walk->throughput, u);
    aur_bsdf_sample drawn;
    const bool goes_on = aur_shading_sample(
        &shading, (const float[3]){pairs[AUR_PATH_LOBE][0], direction[0], direction[1]}, &drawn);
    if (draw.lit) {
        if (!aur_scene_occluded(scene, &draw.ray))
            walk->sum = aur_vector_add(walk->sum, draw.light);
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
        if (depth == data->max_depth || aur_path_stops(depth, &counters->stopped) ||
            !scatter(data, scene, &surface, view, depth, pairs, &walk))
            break;
    }
    return walk.sum;
}

void aur_path_add_sample(const aur_path *data, const aur_scene *scene, size_t x, size_t y, uint32_t index,
                         aur_tile *tile) {
    aur_camera_sample sample;
    aur_vector seen;
    const float weight = aur_view_sample(tile->view, x, y, index, &sample);
    const bool told = aur_lamp_look(data->looks, tile->view, x, y, index, &seen);
    aur_tile_add(tile, x, y, weight,
                 aur_path_radiance(data, scene, &sample, told ? &seen : NULL, &tile->counters));
}
