/* A vertex of a light path, for all estimators: the emission that a ray meets, a point on a light, a
 * direction by the BSDF, multiple importance sampling of the two (Veach 1997, power heuristic), Russian
 * roulette. */
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

/* Whether a path that has become long is to be left because the work stops. */
static inline bool aur_path_stops(uint32_t depth, bool *stopped) {
    enum { EDGES_BETWEEN = 1 << 10 };
    if (depth % EDGES_BETWEEN == 0 && aur_parallel_stops())
        *stopped = true;
    return *stopped;
}

/* --- the emission that a ray meets */

/* How the direction of a ray was drawn. */
typedef struct aur_bounce {
    aur_light_reference from; /* the vertex that the ray leaves, as light sampling sees it */
    float pdf;                /* of the direction, per steradian, times the directions drawn there */
    float light_samples;      /* points on lights drawn there */
    bool specular_bounce;     /* light sampling cannot find what the ray meets: mirrors, rays of the camera */
} aur_bounce;

/* The weight of a sample drawn with density `pdf` where the other strategy has density `other`. */
static inline float aur_power_heuristic(float pdf, float other) {
    const float ratio = other / pdf;
    return 1.0f / (1.0f + ratio * ratio);
}

/* The weight of light that a ray meets; light sampling draws it with density `light_pdf`. */
static inline float aur_bounce_weight(const aur_bounce *bounce, float light_pdf) {
    return bounce->specular_bounce ? 1.0f
                                   : aur_power_heuristic(bounce->pdf, bounce->light_samples * light_pdf);
}

/* Radiance, RGB, that `surface` emits against the unit `direction` of a ray, or the environment if the ray
 * met nothing (NULL). *light_pdf: the density per steradian with which light sampling draws it from
 * bounce->from; 0 if that is not needed: after a specular bounce, or for no emission. */
aur_vector aur_vertex_emission(const aur_scene *scene, const aur_bounce *bounce, aur_vector direction,
                               const aur_surface *surface, float *light_pdf);

/* --- scattering */

/* The lobes of a BSDF that count. Directions are drawn by all lobes in any case, unless the others have no
 * part that can be left out. */
typedef enum aur_vertex_lobes {
    AUR_VERTEX_ALL,
    AUR_VERTEX_MAPPED,  /* a photon map answers for them: all but the specular and the sampled ones */
    AUR_VERTEX_UNMAPPED /* specular and sampled lobes */
} aur_vertex_lobes;

/* BSDF * |cos| of the lobes towards `wi` (world), and the density of aur_vertex_direction there. */
aur_vector aur_vertex_evaluate(const aur_shading *shading, aur_vertex_lobes lobes, aur_vector wi, float *pdf);
/* A direction by the BSDF, from u in [0,1)^3, in world coordinates; false: the path ends. */
bool aur_vertex_direction(const aur_shading *shading, aur_vertex_lobes lobes, const float u[3],
                          aur_bsdf_sample *sample);

/* --- a point on a light */

/* A light sample before it is known whether anything lies between. */
typedef struct aur_shadow {
    aur_ray ray;         /* from the surface to the light */
    aur_vector radiance; /* reflected towards wo if nothing does, by its share in the sum of samples */
} aur_shadow;

/* How many points on lights are drawn at a vertex, and how many directions by the BSDF. */
typedef struct aur_vertex_samples {
    float lights, directions;
} aur_vertex_samples;

static const aur_vertex_samples AUR_VERTEX_ONE_EACH = {1.0f, 1.0f};

/* The MIS weight of a point on a light, which the BSDF finds with density `pdf`. */
static inline float aur_light_weight(const aur_light_sample *light, aur_vertex_samples samples, float pdf) {
    return light->delta ? 1.0f : aur_power_heuristic(samples.lights * light->pdf, samples.directions * pdf);
}

/* The ray to a point on a light, and what the light brings, from `value`: BSDF * |cos|, or a part of it.
 * False: no light comes that way. */
bool aur_vertex_shadow(const aur_surface *surface, const aur_light_sample *light, aur_vector value,
                       float weight, aur_shadow *shadow);
/* The same of the lobes, with their MIS weight, for a point that has been drawn. */
bool aur_vertex_light(const aur_shading *shading, aur_vertex_lobes lobes, aur_vertex_samples samples,
                      const aur_light_sample *light, aur_shadow *shadow);
/* The same of the irradiance of a sensor, which draws directions with the density cos / pi. */
AUR_INTERNAL bool aur_vertex_irradiance(const aur_light_reference *sensor, aur_vertex_samples samples,
                                        const aur_light_sample *light, aur_shadow *shadow);
/* Draws the point: u[0] chooses the light, u[1], u[2] the point on it, in [0,1). */
bool aur_vertex_draw_light(const aur_scene *scene, const aur_shading *shading, aur_vertex_lobes lobes,
                           aur_vertex_samples samples, const float u[3], aur_shadow *shadow);

/* --- Russian roulette */

/* The probability that a path goes on. */
static inline float aur_survival(aur_vector beta) {
    return aur_smaller(aur_vector_max(beta), 0.95f);
}

/* The same of a particle, whose power a vertex changes: all that go on have nearly the same. */
static inline float aur_particle_survival(aur_vector before, aur_vector after) {
    return fminf(aur_vector_max(after) / aur_vector_max(before), 1.0f);
}

/* Whether u in [0,1) lets a path go on, whose beta grows by as much as others end. */
static inline bool aur_vertex_survives(float survival, float u, aur_vector *beta) {
    if (!(u < survival))
        return false;
    *beta = aur_vector_scale(*beta, 1.0f / survival);
    return true;
}

/* --- a path from vertex to vertex */

typedef struct aur_walk {
    aur_vector radiance; /* found so far */
    aur_vector beta;     /* BSDF * |cos| / pdf of all vertices */
    aur_ray ray;
    aur_bounce bounce; /* of the ray */
} aur_walk;

/* Adds the emission that the ray meets; `surface` NULL: the environment's. */
void aur_walk_add_emission(const aur_scene *scene, const aur_surface *surface, aur_walk *walk);
/* Goes on by a direction that u in [0,1)^3 draws; false where the path ends. */
bool aur_walk_scatter(const aur_shading *shading, aur_vertex_lobes lobes, const float u[3], aur_walk *walk);

/* Whether a ray that came in direction `before` goes straight on in direction `after`. */
static inline bool aur_is_unbent(aur_vector before, aur_vector after) {
    return aur_vector_dot(after, before) > 1.0f - 1e-6f;
}

/* Whether the walk, which came in `direction`, has gone straight on through a surface that lets light pass.
 */
static inline bool aur_walk_passed(const aur_surface *surface, aur_vector direction, const aur_walk *walk) {
    return surface->bsdf->passes && walk->bounce.specular_bounce &&
           aur_is_unbent(direction, walk->ray.direction);
}

/* The surface that a camera ray sees. */

/* The nearest surface along *ray, which starts again behind each light that it passes when lights are hidden;
 * false when there is none. */
static inline bool aur_visible_surface(const aur_scene *scene, bool hide_emitters, aur_ray *ray,
                                       aur_surface *surface, aur_counters *counters) {
    enum { MOST_LIGHTS = 1000 }; /* hidden ones, one behind the other */
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

/* Surfaces that let light straight through: panes, masks. */

/* Whether the scene has any. */
AUR_INTERNAL bool aur_panes_exist(const aur_scene *scene);

/* The rest of the ray behind a surface, to the same end: its direction is found again, as its length is. */
aur_ray aur_ray_behind(const aur_ray *ray, const aur_surface *surface);

/* What the surfaces on a ray, at most `most` of them, leave of the light that comes along it; 0 where one of
 * them lets none through. */
aur_vector aur_panes_passed(const aur_scene *scene, const aur_ray *ray, size_t most);
