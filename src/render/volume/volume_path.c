/* Path tracing in media: distances and directions are sampled, and light is sampled at each scattering. Both
 * ways to find a light, and what the three colour channels would have sampled, are weighed by the balance
 * heuristic (Miller, Georgiev and Jarosz 2019). */
#include "render/volume/volume_path.h"

#include "points/base/random.h"
#include "render/scene/materials/sampling.h"
#include "render/vertex/vertex.h"

static bool pass_medium(const aur_medium *medium, const aur_ray *ray, float distance, aur_medium_walk *walk,
                        aur_counters *counters) {
    if (medium != NULL)
        medium->descriptor->pass(medium, ray, distance, walk);
    counters->cut += walk->cut;
    counters->stopped |= walk->stopped;
    return !walk->cut && !walk->stopped && aur_vector_max(walk->throughput) > 0.0f;
}

bool aur_volume_shadow(const aur_scene *scene, bool passes, float reach, const aur_ray *ray,
                       const aur_medium *medium, aur_medium_walk *walk, aur_counters *counters) {
    aur_ray rest = *ray;
    if (!passes) {
        return !aur_scene_occluded(scene, ray) && pass_medium(medium, ray, reach, walk, counters);
    }
    for (size_t i = 0; i < AUR_MOST_PASSED; ++i) {
        aur_hit hit;
        if (!aur_scene_intersect(scene, &rest, &hit))
            return pass_medium(medium, &rest, reach, walk, counters);
        aur_surface surface;
        aur_scene_surface(scene, &rest, &hit, &surface);
        const aur_vector view = aur_vector_scale(rest.direction, -1.0f);
        const aur_vector passed =
            aur_bsdf_passed(surface.bsdf, surface.texture, aur_frame_to_local(&surface.frame, view));
        if (aur_vector_is_zero(passed) || !pass_medium(medium, &rest, hit.distance, walk, counters))
            return false;
        walk->throughput = aur_vector_multiply(walk->throughput, passed);
        aur_surface_medium(scene, &surface, rest.direction, &medium);
        reach = aur_larger(reach - hit.distance, 0.0f);
        rest = aur_ray_behind(ray, &surface);
    }
    ++counters->cut;
    return false;
}

/* The state of a path. */
typedef struct volume_walk {
    aur_medium_walk state;
    aur_vector sum, unscattered; /* accumulated radiance, and its unscattered part */
    aur_ray ray;
    const aur_medium *medium; /* that the ray is inside; NULL: none */
    aur_bounce bounce;        /* of the ray; its pdf is in `state` */
    float ior_squared;        /* product over the boundaries: the factor by which radiance has grown */
    uint32_t depth;           /* of the edge that the ray belongs to */
    size_t passed;            /* surfaces that the path passed unscattered */
    const float (*pairs)[2];  /* the numbers of this depth */
    bool fresh;               /* the random number of its first distance is still unused */
} volume_walk;

static float mean(aur_vector color) {
    return (color.x + color.y + color.z) / 3.0f;
}

/* Scales the pdfs of all channels to a mean of 1, so that numbers stay in range; the throughput carries the
 * weight. False if no channel has a positive pdf. */
static bool normalise(aur_medium_walk *state) {
    const float size = mean(state->path);
    if (!(size > 0.0f) || !isfinite(size))
        return false;
    if (size == 1.0f)
        return true;
    state->throughput = aur_vector_scale(state->throughput, 1.0f / size);
    state->light = aur_vector_scale(state->light, 1.0f / size);
    state->path = aur_vector_scale(state->path, 1.0f / size);
    return true;
}

/* Adds emission that the ray hits; light sampling finds it with density `light_pdf`. */
static void add_light(volume_walk *walk, aur_vector radiance, float light_pdf) {
    if (aur_vector_is_zero(radiance))
        return;
    const aur_medium_walk *const state = &walk->state;
    const float density = walk->bounce.specular_bounce
                              ? mean(state->path)
                              : mean(aur_vector_add_scaled(state->path, light_pdf, state->light));
    if (density > 0.0f)
        walk->sum = aur_vector_add_scaled(walk->sum, 1.0f / density,
                                          aur_vector_multiply(state->throughput, radiance));
}

static void add_emission(const aur_scene *scene, const aur_surface *surface, volume_walk *walk) {
    float light_pdf = 0.0f;
    const aur_vector emission =
        surface == NULL && walk->depth == 1
            ? aur_scene_background(scene, walk->ray.direction)
            : aur_vertex_emission(scene, &walk->bounce, walk->ray.direction, surface, &light_pdf);
    const aur_vector before = walk->sum;
    add_light(walk, emission, light_pdf);
    if (walk->depth == 1)
        walk->unscattered = aur_vector_add(walk->unscattered, aur_vector_subtract(walk->sum, before));
}

/* Adds a light sample seen from `from` by a ray in `medium`. `scattered` is the fraction of light scattered
 * into the path; the path would sample this direction with `pdf`. */
static void add_drawn_light(const aur_volume_path *data, const aur_scene *scene, const volume_walk *walk,
                            const aur_light_sample *light, const aur_ray *ray, const aur_medium *medium,
                            aur_vector scattered, float pdf, aur_vector *sum, aur_counters *counters) {
    aur_medium_walk state = walk->state;
    state.hash =
        aur_mix64(state.hash ^
                  UINT64_C(0x736861646f77)); /* a separate stream: the path's random numbers do not change */
    state.light = state.path;
    state.throughput = aur_vector_multiply(state.throughput, aur_vector_multiply(scattered, light->radiance));
    if (aur_vector_is_zero(state.throughput) ||
        !aur_volume_shadow(scene, data->passes, aur_light_reach(scene, light, ray->origin), ray, medium,
                           &state, counters))
        return;
    const aur_vector drawn = aur_vector_scale(state.light, light->pdf);
    const float density = mean(light->delta ? drawn : aur_vector_add_scaled(drawn, pdf, state.path));
    *sum = aur_vector_add_scaled(*sum, 1.0f / density, state.throughput);
}

static bool draw_light(const aur_scene *scene, const aur_light_reference *from, const float (*pairs)[2],
                       aur_light_sample *light) {
    const float u[3] = {pairs[AUR_PATH_CHOICE][0], pairs[AUR_PATH_POSITION][0], pairs[AUR_PATH_POSITION][1]};
    return aur_scene_emitter_count(scene) > 0 && aur_light_sample_direct(scene, from, u, light) &&
           light->pdf > 0.0f;
}

/* Russian roulette. Radiance grows on entering glass and shrinks on leaving it: that gain does not raise the
 * survival probability. */
static bool survives(const aur_volume_path *data, volume_walk *walk) {
    if (!normalise(&walk->state) || aur_vector_is_zero(walk->state.throughput))
        return false;
    if (walk->depth < data->rr_depth)
        return true;
    const float survival = aur_survival(aur_vector_scale(walk->state.throughput, walk->ior_squared));
    return aur_vertex_survives(survival, walk->pairs[AUR_PATH_CHOICE][1], &walk->state.throughput);
}

/* In a medium: adds a light sample, and continues in a sampled direction. */
static bool scatter_in_medium(const aur_volume_path *data, const aur_scene *scene, float way,
                              volume_walk *walk, aur_counters *counters) {
    if (!normalise(&walk->state))
        return false;
    const aur_medium *const medium = walk->medium;
    const aur_vector before = walk->ray.direction;
    const aur_vector from = aur_vector_add_scaled(walk->ray.origin, way, before);
    const aur_light_reference reference = {.position = from};
    aur_light_sample light;
    if (medium->samples_emitters && draw_light(scene, &reference, walk->pairs, &light)) {
        const float value = aur_phase_evaluate(medium->phase, from, aur_vector_dot(before, light.direction));
        const aur_ray ray = aur_ray_between(from, light.position);
        add_drawn_light(data, scene, walk, &light, &ray, medium, (aur_vector){value, value, value}, value,
                        &walk->sum, counters);
    }
    const float *const u = walk->pairs[AUR_PATH_DIRECTION];
    const float cosine = aur_phase_draw(medium->phase, from, u[0]);
    const float pdf = aur_phase_evaluate(medium->phase, from, cosine);
    if (!(pdf > 0.0f))
        return false;
    const aur_frame frame = aur_frame_about(before);
    const aur_vector direction =
        aur_vector_normalize(aur_frame_to_world(&frame, aur_direction_at(cosine, u[1])));
    walk->state.light = aur_vector_scale(walk->state.path, 1.0f / pdf);
    walk->bounce = (aur_bounce){.from = reference, .specular_bounce = !medium->samples_emitters};
    walk->ray = (aur_ray){from, 0.0f, direction, INFINITY};
    return survives(data, walk);
}

/* Continues unscattered behind a surface. */
static void pass_surface(const aur_scene *scene, const aur_surface *surface, volume_walk *walk) {
    aur_surface_medium(scene, surface, walk->ray.direction, &walk->medium);
    walk->ray = aur_surface_ray(surface, walk->ray.direction);
    ++walk->passed;
}

/* At a surface; *edge becomes true if the path is scattered and so has a new edge, false if it passes
 * through. */
static bool scatter_at_surface(const aur_volume_path *data, const aur_scene *scene,
                               const aur_surface *surface, volume_walk *walk, bool *edge,
                               aur_counters *counters) {
    if (!normalise(&walk->state))
        return false;
    const aur_vector before = walk->ray.direction;
    const aur_shading shading = aur_shading_at(surface, aur_vector_scale(before, -1.0f));
    const bool last = walk->depth >= data->max_depth;
    const aur_light_reference reference = aur_shading_reference(&shading);
    aur_light_sample light;
    if (!last && draw_light(scene, &reference, walk->pairs, &light)) {
        float pdf;
        const aur_vector scattered = aur_vertex_evaluate(&shading, AUR_VERTEX_ALL, light.direction, &pdf);
        const aur_ray ray = aur_surface_ray_to(surface, light.position);
        const aur_medium *medium = walk->medium;
        aur_surface_medium(scene, surface, light.direction, &medium);
        add_drawn_light(data, scene, walk, &light, &ray, medium, scattered, pdf, &walk->sum, counters);
    }
    const float *const u = walk->pairs[AUR_PATH_DIRECTION];
    /* One that is passed takes no number of the edge. */
    const float choice =
        surface->bsdf->passes ? aur_draw_unit(&walk->state.hash) : walk->pairs[AUR_PATH_LOBE][0];
    aur_bsdf_sample drawn;
    if (!aur_vertex_direction(&shading, AUR_VERTEX_ALL, (const float[3]){choice, u[0], u[1]}, &drawn))
        return false;
    const bool passed_through = drawn.specular && surface->bsdf->passes && aur_is_unbent(before, drawn.light);
    *edge = !passed_through;
    walk->state.throughput = aur_vector_multiply(walk->state.throughput, drawn.weight);
    if (passed_through) {
        pass_surface(scene, surface, walk);
        return !aur_vector_is_zero(walk->state.throughput);
    }
    if (last)
        return false;
    if (!drawn.specular)
        walk->state.light = aur_vector_scale(walk->state.path, 1.0f / drawn.pdf);
    walk->bounce = (aur_bounce){.from = reference, .specular_bounce = drawn.specular};
    if (drawn.ior_squared > 0.0f)
        walk->ior_squared *= drawn.ior_squared;
    aur_surface_medium(scene, surface, drawn.light, &walk->medium);
    walk->ray = aur_surface_ray(surface, drawn.light);
    return survives(data, walk);
}

/* Goes to the next surface or scattering; false where the path ends. */
static bool step(const aur_volume_path *data, const aur_scene *scene, volume_walk *walk, bool *edge,
                 aur_counters *counters) {
    aur_hit hit;
    const bool found = aur_scene_intersect(scene, &walk->ray, &hit);
    if (walk->medium != NULL) {
        const float u = walk->fresh ? walk->pairs[AUR_PATH_LOBE][1] : aur_draw_unit(&walk->state.hash);
        float way;
        walk->fresh = false;
        if (walk->medium->descriptor->travel(
                walk->medium, &walk->ray, found ? hit.distance : walk->ray.farthest, u, &walk->state, &way)) {
            *edge = true;
            return walk->depth < data->max_depth && scatter_in_medium(data, scene, way, walk, counters);
        }
        counters->cut += walk->state.cut;
        counters->stopped |= walk->state.stopped;
        if (walk->state.cut || walk->state.stopped)
            return false;
    }
    const bool hides = data->hide_emitters && walk->depth == 1;
    if (!found) {
        if (!hides)
            add_emission(scene, NULL, walk);
        return false;
    }
    aur_surface surface;
    aur_scene_surface(scene, &walk->ray, &hit, &surface);
    *edge = false;
    if (hides && surface.emitter != AUR_NO_EMITTER) {
        pass_surface(scene, &surface, walk);
        return true;
    }
    add_emission(scene, &surface, walk);
    if (walk->depth >= data->max_depth && !surface.bsdf->passes)
        return false;
    return scatter_at_surface(data, scene, &surface, walk, edge, counters);
}

aur_vector aur_volume_path_radiance(const aur_volume_path *data, const aur_scene *scene,
                                    const aur_camera_sample *sample, aur_vector *unscattered,
                                    aur_counters *counters) {
    static const aur_vector one = {1.0f, 1.0f, 1.0f};
    const uint64_t pixel = aur_hash2(sample->stream.pixel, UINT64_C(0x6d65646961));
    volume_walk walk = {
        .state = {.throughput = one,
                  .path = one,
                  .light = one,
                  .channel = (size_t)((pixel + sample->stream.index) % 3), /* a third of the samples each */
                  .hash = aur_hash2(pixel, sample->stream.index)},
        .ray = sample->ray,
        .medium = aur_scene_camera_medium(scene),
        .bounce = {.specular_bounce = true}, /* light sampling cannot hit the camera either */
        .ior_squared = 1.0f,
        .depth = 1,
        .pairs = &sample->first_pairs[AUR_PAIR_FIRST],
        .fresh = true,
    };
    /* Media begin where the camera begins to see, as in Mitsuba 3. */
    walk.ray.origin = aur_vector_add_scaled(walk.ray.origin, walk.ray.nearest, walk.ray.direction);
    walk.ray.farthest -= walk.ray.nearest;
    walk.ray.nearest = 0.0f;
    float ahead[AUR_STREAM_BLOCK][2];
    bool edge;
    while (step(data, scene, &walk, &edge, counters)) {
        if (walk.passed > AUR_MOST_PASSED) {
            ++counters->cut;
            break;
        }
        if (!edge)
            continue;
        ++walk.depth;
        if (aur_path_stops(walk.depth, &counters->stopped))
            break;
        if (walk.depth % 2 == 0)
            aur_stream_pairs(&sample->stream, aur_path_pair(walk.depth), AUR_STREAM_BLOCK, ahead);
        walk.pairs = (const float(*)[2]) & ahead[walk.depth % 2 * AUR_PATH_PAIRS];
        walk.fresh = true;
    }
    *unscattered = walk.unscattered;
    return walk.sum;
}
