/* A vertex of a light path, for all estimators: emission at a hit, light sampling, BSDF sampling, multiple
 * importance sampling of the two (Veach 1997, power heuristic), Russian roulette. */
#pragma once

#include "points/base/error.h"
#include "render/film/integrator.h"
#include "render/film/tile.h"
#include "render/vertex/shading.h"

/* --- random numbers of a vertex */

/* Dimension pairs of one bounce: (light choice, roulette), light position, (lobe choice, choice among
 * candidates), direction. */
enum { AUR_PATH_CHOICE, AUR_PATH_POSITION, AUR_PATH_LOBE, AUR_PATH_DIRECTION, AUR_PATH_PAIRS };

/* The first pair of a bounce. Those of the first come with the camera's, the others two bounces at once. */
static inline uint32_t aur_path_pair(uint32_t depth) {
    return depth == 1 ? AUR_PAIR_FIRST : AUR_STREAM_BLOCK + AUR_PATH_PAIRS * (depth - 2);
}

/* Whether to abandon a path that has become long because the render was cancelled. */
static inline bool aur_path_stops(uint32_t depth, bool *stopped) {
    enum { EDGES_BETWEEN = 1 << 10 };
    if (depth % EDGES_BETWEEN == 0 && aur_parallel_stops())
        *stopped = true;
    return *stopped;
}

/* --- emission that a ray hits */

/* How the direction of a ray was drawn. */
typedef struct aur_bounce {
    aur_light_reference from; /* the vertex that the ray leaves, as light sampling sees it */
    float pdf;                /* of the direction, per steradian, times the directions drawn there */
    float light_samples;      /* points on lights drawn there */
    bool specular_bounce;     /* light sampling cannot find what the ray hits: mirrors, camera rays */
} aur_bounce;

/* The MIS weight of a sample of density `pdf` where the other strategy has density `other`. */
static inline float aur_power_heuristic(float pdf, float other) {
    const float ratio = other / pdf;
    return 1.0f / (1.0f + ratio * ratio);
}

/* The MIS weight of emission that a ray hits; light sampling draws it with density `light_pdf`. */
static inline float aur_bounce_weight(const aur_bounce *bounce, float light_pdf) {
    return bounce->specular_bounce ? 1.0f
                                   : aur_power_heuristic(bounce->pdf, bounce->light_samples * light_pdf);
}

/* Radiance, RGB, that `surface` emits against the unit `direction` of a ray, or the environment's if the ray
 * hit nothing (NULL). *light_pdf: the solid-angle density with which light sampling draws it from
 * bounce->from; 0 after a specular bounce or without emission, where it is not needed. */
aur_vector aur_vertex_emission(const aur_scene *scene, const aur_bounce *bounce, aur_vector direction,
                               const aur_surface *surface, float *light_pdf);

/* --- scattering */

/* The lobes of a BSDF that count. Directions are always sampled from all lobes, except where the excluded
 * lobes are the only ones that can be left out. */
typedef enum aur_vertex_lobes {
    AUR_VERTEX_ALL,
    AUR_VERTEX_MAPPED,  /* those that a photon map covers: all but the specular and the sampled ones */
    AUR_VERTEX_UNMAPPED /* specular and sampled lobes */
} aur_vertex_lobes;

/* BSDF * |cos| of the lobes towards `wi` (world), and the density of aur_vertex_direction there. */
aur_vector aur_vertex_evaluate(const aur_shading *shading, aur_vertex_lobes lobes, aur_vector wi, float *pdf);
/* A direction by the BSDF, from u in [0,1)^3, in world coordinates; false: the path ends. */
bool aur_vertex_direction(const aur_shading *shading, aur_vertex_lobes lobes, const float u[3],
                          aur_bsdf_sample *sample);

/* The weight of a particle of light that arrives from `in` (world), the view of `shading`, and continues in
 * the sampled direction: by the adjoint BSDF, as light leaves where the sampling routine thinks that it
 * arrives (Veach 1997, section 5.3.2). Power counts per area perpendicular to `normal`. Unless the scattering
 * is specular, a cosine of incidence below `least` is taken as `least`, which bounds the weight. */
aur_vector aur_vertex_adjoint(const aur_shading *shading, const aur_bsdf_sample *sample, aur_vector in,
                              aur_vector normal, float least);

/* --- a point on a light */

/* A light sample before its visibility is tested. */
typedef struct aur_shadow {
    aur_ray ray;         /* from the surface to the light */
    aur_vector radiance; /* reflected towards wo if unoccluded, with its weight */
} aur_shadow;

/* How many points on lights are drawn at a vertex, and how many directions by the BSDF. */
typedef struct aur_vertex_samples {
    float lights, directions;
} aur_vertex_samples;

static const aur_vertex_samples AUR_VERTEX_ONE_EACH = {1.0f, 1.0f};

/* The MIS weight of a light sample that the BSDF draws with density `pdf`. */
static inline float aur_light_weight(const aur_light_sample *light, aur_vertex_samples samples, float pdf) {
    return light->delta ? 1.0f : aur_power_heuristic(samples.lights * light->pdf, samples.directions * pdf);
}

/* Sets the unoccluded contribution of a light sample; false if it is zero. */
static inline bool aur_shadow_radiance(const aur_light_sample *light, aur_vector value, float weight,
                                       aur_shadow *shadow) {
    const aur_vector radiance = aur_vector_multiply(value, light->radiance);
    shadow->radiance = aur_vector_scale(radiance, weight / light->pdf);
    return !aur_vector_is_zero(radiance);
}

/* The shadow ray to a light sample and its unoccluded contribution, from `value`: BSDF * |cos|, or a part of
 * it. False if no light arrives. */
static inline bool aur_vertex_shadow(const aur_surface *surface, const aur_light_sample *light,
                                     aur_vector value, float weight, aur_shadow *shadow) {
    if (!aur_shadow_radiance(light, value, weight, shadow))
        return false;
    shadow->ray = aur_surface_ray_to(surface, light->position);
    return true;
}
/* The same for lobes of the BSDF, with the MIS weight, for a given light sample. */
bool aur_vertex_light(const aur_shading *shading, aur_vertex_lobes lobes, aur_vertex_samples samples,
                      const aur_light_sample *light, aur_shadow *shadow);
/* The same for the irradiance of a sensor, which samples directions with the density cos / pi. */
AUR_INTERNAL bool aur_vertex_irradiance(const aur_light_reference *sensor, aur_vertex_samples samples,
                                        const aur_light_sample *light, aur_shadow *shadow);
/* Draws the point: u[0] chooses the light, u[1], u[2] the point on it, in [0,1). */
bool aur_vertex_draw_light(const aur_scene *scene, const aur_shading *shading, aur_vertex_lobes lobes,
                           aur_vertex_samples samples, const float u[3], aur_shadow *shadow);

/* --- Russian roulette */

/* The survival probability of a path. */
static inline float aur_survival(aur_vector beta) {
    return aur_smaller(aur_vector_max(beta), 0.95f);
}

/* The same for a particle, whose power a vertex changes: all survivors have nearly equal power. Powers below
 * the smallest normal float are 0. */
static inline float aur_particle_survival(aur_vector before, aur_vector after) {
    const float most = aur_vector_max(before);
    return most > 0.0f ? aur_smaller(aur_vector_max(after) / most, 1.0f) : 0.0f;
}

/* Whether u in [0,1) lets a path survive; then its beta is divided by the survival probability. */
static inline bool aur_vertex_survives(float survival, float u, aur_vector *beta) {
    if (!(u < survival))
        return false;
    *beta = aur_vector_scale(*beta, 1.0f / survival);
    return true;
}

/* --- a path from vertex to vertex */

typedef struct aur_walk {
    aur_vector radiance; /* accumulated so far */
    aur_vector beta;     /* BSDF * |cos| / pdf of all vertices */
    aur_ray ray;
    aur_bounce bounce; /* of the ray */
} aur_walk;

/* Adds the emission that the ray hits; `surface` NULL: the environment's. */
void aur_walk_add_emission(const aur_scene *scene, const aur_surface *surface, aur_walk *walk);
/* Samples a direction with u in [0,1)^3 and continues the walk; false if the path ends. */
bool aur_walk_scatter(const aur_shading *shading, aur_vertex_lobes lobes, const float u[3], aur_walk *walk);

/* Whether a ray that arrived in direction `before` continues unscattered in direction `after`. */
static inline bool aur_is_unbent(aur_vector before, aur_vector after) {
    return aur_vector_dot(after, before) > 1.0f - 1e-6f;
}

/* Whether the walk, which arrived in `direction`, has passed unscattered through a surface. */
static inline bool aur_walk_passed(const aur_surface *surface, aur_vector direction, const aur_walk *walk) {
    return surface->bsdf->passes && walk->bounce.specular_bounce &&
           aur_is_unbent(direction, walk->ray.direction);
}

/* The surface that a camera ray sees. */

/* The nearest surface along *ray. With hidden emitters the ray restarts behind each emitter that it passes.
 * False if there is no surface. */
static inline bool aur_visible_surface(const aur_scene *scene, bool hide_emitters, aur_ray *ray,
                                       aur_surface *surface, aur_counters *counters) {
    enum { MOST_LIGHTS = 1000 }; /* hidden ones, one after another */
    for (size_t i = 0; i < MOST_LIGHTS; ++i) {
        aur_hit hit;
        if (!aur_scene_intersect(scene, ray, &hit))
            return false;
        aur_scene_surface(scene, ray, &hit, surface);
        if (!hide_emitters || surface->emitter == AUR_NO_EMITTER)
            return true;
        *ray = aur_surface_ray(surface, ray->direction);
    }
    ++counters->cut;
    return false;
}

/* Surfaces that transmit light unscattered: panes, masks. */

/* Whether the scene has any. */
AUR_INTERNAL bool aur_panes_exist(const aur_scene *scene);

/* The rest of the ray behind a surface, to the same end point: direction and length are computed again. */
aur_ray aur_ray_behind(const aur_ray *ray, const aur_surface *surface);

/* The transmittance of the surfaces on a ray, at most `most` of them; 0 if one of them is opaque. */
aur_vector aur_panes_passed(const aur_scene *scene, const aur_ray *ray, size_t most);
