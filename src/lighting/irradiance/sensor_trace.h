/* Traces the light at one sensor for sixteen randomisations of a rule at once, one per lane. */
#pragma once

#include <aureole-lighting/irradiance.h>
#include <aureole/core.h>
#include <aureole/sphere.h>

#include "render/path/path_group.h"
#include "render/photons/irradiance.h"
#include "render/radiosity/solution.h"
#include "render/scene/scene.h"
#include "render/vertex/vertex.h"

/* Precomputed reflected light: a photon map, or a radiosity solution. A path that first meets a supported
 * surface adds the cached light there. Some paths continue to remove the bias of the cache, as in
 * render/gather/continuation.h for images. So the mean equals that of path tracing, for any cache. */

typedef struct aur_cached_light {
    aur_irradiance_map *map; /* or NULL */
    aur_radiosity *solution; /* or NULL */
    aur_vector *exitances;   /* of its patches: times the albedo they are radiances */
} aur_cached_light;

/* Computes the cache that `options` (with defaults filled in) select; nothing for path tracing. Errors:
 * UNSUPPORTED for scenes that photons or radiosity do not support, CANCELLED, MEMORY. */
aur_result aur_cached_light_create(const aur_scene *scene, const aur_irradiance_options *options,
                                   aur_cached_light *cache, aur_error *error);
void aur_cached_light_release(aur_cached_light *cache);

/* Called at the hits of the group at `depth`, before scattering: the lanes in *pending, which have not used
 * the cache yet, add the cached light; most of them end. */
void aur_cached_light_add(const aur_cached_light *cache, aur_path_group *group, uint32_t depth,
                          uint32_t *pending);

/* The directions of sensors, as points on a torus: the azimuth, and the squared sine of the polar angle, in
 * which the cosine distribution is uniform. With random shifts (Cranley and Patterson 1976) each point is
 * uniform, so means are unbiased, and spherical Fibonacci points preserve their distances. */

typedef struct aur_sensor_rule {
    size_t count;
    float *heights;         /* squared sines, in [0,1) */
    float *cosines, *sines; /* of the azimuth */
} aur_sensor_rule;

/* `count` directions of `set`. Errors: as aur_directions_create. */
aur_result aur_sensor_rule_create(const char *set, size_t count, uint64_t seed, const aur_warnings *warnings,
                                  aur_sensor_rule *rule, aur_error *error);
void aur_sensor_rule_release(aur_sensor_rule *rule);

/* Planar polygonal emitters of constant radiance, whose irradiance at a sensor has a closed form (Lambert
 * 1760) without occlusion. Occlusion is estimated by points on the emitter: with the closed form C, the
 * contribution c of a point and its visibility V,
 *
 * a C + mean of c (V - a)
 *
 * is unbiased for any number a (control variate). a = 1 is exact if all is visible, a = 0 if nothing is; a
 * separate pilot of few points selects it. */

typedef struct aur_closed_light aur_closed_light;

typedef struct aur_closed_lights {
    size_t emitter_count; /* of the scene */
    size_t count;
    aur_closed_light *lights;
    double (*corners)[3]; /* of all polygons */
} aur_closed_lights;

/* Finds the polygons; none if there are so many that points are as cheap. */
aur_result aur_closed_lights_create(const aur_scene *scene, aur_closed_lights *lights, aur_error *error);
void aur_closed_lights_release(aur_closed_lights *lights);

/* a of each emitter, or AUR_LIGHT_OPEN for emitters that are sampled by points and directions. */
static const float AUR_LIGHT_OPEN = -1.0f;

/* Sets shares[emitter_count], and adds the sum of a C to direct[3]. The sensor's rays start at `from`;
 * `position` is the sensor's, `normal` has unit length. */
void aur_closed_lights_at(const aur_scene *scene, const aur_closed_lights *lights, const double position[3],
                          const double normal[3], aur_vector from, uint64_t hash, float *shares,
                          double direct[3]);

_Static_assert((int)AUR_IRRADIANCE_REPLICATES == (int)AUR_PACKET_SIZE, "a lane is a randomisation");

/* A sensor, moved just off the surfaces on which it may lie. */
typedef struct aur_sensor_point {
    aur_vector position; /* start of its rays */
    bool on_surface;     /* it has been moved off a surface */
    bool covered;        /* a surface lies on it: it receives only that surface's emission */
    bool doubtful;       /* surfaces are too close together to determine whether it is covered */
    aur_frame frame;     /* z is the normal */
    double closed[3];    /* closed-form part of the direct light, r, g, b */
    float *shares;       /* per emitter, see aur_closed_lights_at; NULL: no closed forms */
    uint64_t hash;       /* of seed, position and normal; seeds all random numbers */
} aur_sensor_point;

/* `position` and `normal` are finite, and the normal is nonzero. A sensor on a surface is on the side to
 * which its normal points; if the normal is tangential, on the surface's front. `shares` has room for the
 * scene's emitters and must outlive the result. */
void aur_sensor_point_create(const aur_scene *scene, const aur_closed_lights *lights,
                             const double position[3], const double normal[3], uint64_t seed, float *shares,
                             aur_sensor_point *surface_point);

/* Looks for surfaces that cover a sensor at `from`, relative to the scene's origin. The sensor lies on a
 * surface within `offset`; the unit `axis` points away from it. Sets covered, closed and doubtful. Light past
 * the cover's edges is below rounding. */
void aur_sensor_find_cover(const aur_scene *scene, const double from[3], aur_vector axis, float offset,
                           aur_sensor_point *surface_point);

/* Irradiance by randomisation. */
typedef struct aur_sensor_sums {
    double sums[AUR_PACKET_SIZE][AUR_IRRADIANCE_PARTS - 1][3]; /* direct, sky, reflected, sun; r, g, b */
    uint64_t dark; /* directions that hit a surface's back that scatters nothing */
} aur_sensor_sums;

/* Means over the directions of the rule. `cache` (the cached light) may be NULL. `level` selects independent
 * random numbers. The contributions passed to group->sensor.from_sky add up to the irradiance of the sky
 * times rule->count / pi. */
void aur_sensor_trace(aur_path_group *group, const aur_sensor_rule *rule,
                      const aur_sensor_point *surface_point, const aur_cached_light *cache, uint32_t level,
                      aur_sensor_sums *sensor_sums);
