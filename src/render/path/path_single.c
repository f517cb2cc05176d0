/* One path by itself: the clear form, which paths in packets are compared with. */
#include "render/film/clamp.h"
#include "render/path/path.h"
#include "render/vertex/candidates.h"
#include "render/vertex/vertex.h"

/* The unoccluded contribution of a light sample to the path; u chooses the light and the point. */
static bool draw_light(const aur_scene *scene, const aur_shading *shading, aur_vector beta, const float u[3],
                       aur_shadow *shadow) {
    if (!aur_vertex_draw_light(scene, shading, AUR_VERTEX_ALL, AUR_VERTEX_ONE_EACH, u, shadow))
        return false;
    shadow->radiance = aur_vector_multiply(beta, shadow->radiance);
    return true;
}

/* The same for one of `count` candidates, chosen by `selection`. */
static bool draw_candidates(const aur_scene *scene, const aur_shading *shading, aur_vector beta,
                            uint32_t count, const float u[3], float selection, aur_shadow *chosen) {
    float total = 0.0f, selected_weight = 0.0f;
    for (uint32_t i = 0; i < count; ++i) {
        float shifted[3];
        aur_candidate_shift(i, count, shifted);
        for (size_t d = 0; d < 3; ++d)
            shifted[d] = aur_candidate_number(u[d], shifted[d]);
        aur_shadow shadow;
        const bool lit = draw_light(scene, shading, beta, shifted, &shadow);
        const float weight = lit ? aur_candidate_weight(shadow.radiance) : 0.0f;
        if (!aur_candidate_wins(weight, &total, &selection))
            continue;
        *chosen = shadow;
        selected_weight = weight;
    }
    if (!(selected_weight > 0.0f))
        return false;
    chosen->radiance = aur_vector_scale(chosen->radiance, aur_candidate_scale(count, total, selected_weight));
    return true;
}

/* Adds direct light and continues in a sampled direction; false if the path ends. */
static bool scatter(const aur_path *data, const aur_scene *scene, const aur_surface *surface, uint32_t depth,
                    const float (*pairs)[2], aur_walk *walk) {
    const aur_shading shading = aur_shading_at(surface, aur_vector_scale(walk->ray.direction, -1.0f));
    const float *const position = pairs[AUR_PATH_POSITION], *const direction = pairs[AUR_PATH_DIRECTION];
    const float *const lobe = pairs[AUR_PATH_LOBE], *const choice = pairs[AUR_PATH_CHOICE];
    /* Both directions before the shadow ray: the processor works at them together. */
    const float u[3] = {choice[0], position[0], position[1]};
    aur_shadow shadow;
    const bool lit = aur_scene_emitter_count(scene) > 0 &&
                     (data->candidates > 1 ? draw_candidates(scene, &shading, walk->beta, data->candidates, u,
                                                             lobe[1], &shadow)
                                           : draw_light(scene, &shading, walk->beta, u, &shadow));
    const bool continues = aur_walk_scatter(&shading, AUR_VERTEX_ALL,
                                            (const float[3]){lobe[0], direction[0], direction[1]}, walk);
    if (lit && !aur_scene_occluded(scene, &shadow.ray))
        walk->radiance = aur_vector_add(walk->radiance, shadow.radiance);
    return continues &&
           (depth < data->rr_depth || aur_vertex_survives(aur_survival(walk->beta), choice[1], &walk->beta));
}

aur_vector aur_path_radiance(const aur_path *data, const aur_scene *scene, const aur_camera_sample *sample,
                             const aur_vector *emission, aur_vector *unscattered, aur_counters *counters) {
    /* Light sampling cannot hit the camera either. */
    aur_walk walk = {.radiance = emission != NULL ? *emission : (aur_vector){0},
                     .beta = {1.0f, 1.0f, 1.0f},
                     .ray = sample->ray,
                     .bounce = {.specular_bounce = true}};
    bool scattered = false; /* by more than passing unscattered through surfaces */
    float ahead[AUR_STREAM_BLOCK][2];
    for (uint32_t depth = 1; depth <= data->max_depth; ++depth) {
        /* Before the ray, so that the processor works at both. */
        if (depth % 2 == 0)
            aur_stream_pairs(&sample->stream, aur_path_pair(depth), AUR_STREAM_BLOCK, ahead);
        const float(*const pairs)[2] = depth == 1 ? &sample->first_pairs[AUR_PAIR_FIRST]
                                                  : (const float(*)[2]) & ahead[depth % 2 * AUR_PATH_PAIRS];
        aur_surface surface;
        const bool hide = data->hide_emitters && depth == 1, probed = emission != NULL && depth == 1;
        const bool found = aur_visible_surface(scene, hide, &walk.ray, &surface, counters);
        if (!found && !scattered && !probed && !hide)
            walk.radiance = aur_vector_add(
                walk.radiance,
                aur_vector_multiply(walk.beta, aur_scene_background(scene, walk.ray.direction)));
        else if (!probed && (found || !hide))
            aur_walk_add_emission(scene, found ? &surface : NULL, &walk);
        if (depth == 1)
            *unscattered = walk.radiance;
        const aur_vector before = walk.ray.direction;
        if (!found || depth == data->max_depth || aur_path_stops(depth, &counters->stopped) ||
            !scatter(data, scene, &surface, depth, pairs, &walk))
            break;
        scattered = scattered || !aur_walk_passed(&surface, before, &walk);
    }
    return walk.radiance;
}

void aur_path_add_sample(const aur_path *data, const aur_scene *scene, size_t x, size_t y, uint32_t index,
                         aur_tile *tile) {
    aur_camera_sample sample;
    aur_vector emission, unscattered;
    aur_view_sample(tile->view, x, y, index, &sample);
    const bool probed = aur_edge_probe(data->probes, tile, x, y, index, &emission);
    const aur_vector radiance =
        aur_path_radiance(data, scene, &sample, probed ? &emission : NULL, &unscattered, &tile->counters);
    aur_tile_add_clamped(tile, x, y, index, sample.offset, radiance, unscattered, data->clamp);
}
