/* What one sensor sees: light along sixteen randomisations of a rule at once, one a lane. */
#pragma once

#include <aureole-lighting/irradiance.h>
#include <aureole/core.h>
#include <aureole/sphere.h>

#include "render/path/path_group.h"
#include "render/photons/irradiance.h"
#include "render/radiosity/solution.h"
#include "render/scene/scene.h"
#include "render/vertex/vertex.h"

/* What is known beforehand of the light that surfaces reflect: a photon map, or a radiosity solution. Where a
 * path meets such a surface for the first time it takes what is known, and goes on now and then to take away
 * what that is wrong by, as render/gather/continuation.h has it for images. So the mean is that of paths,
 * whatever is known. */

typedef struct aur_cached_light {
    aur_irradiance_map *map; /* or NULL */
    aur_radiosity *solution; /* or NULL */
    aur_vector *exitances;   /* of its patches: times the albedo they are radiances */
} aur_cached_light;

/* Finds what `options` (complete) ask for; nothing for paths. Errors: UNSUPPORTED for scenes that photons or
 * radiosity cannot do, CANCELLED, MEMORY. */
aur_result aur_cached_light_create(const aur_scene *scene, const aur_irradiance_options *options,
                                   aur_cached_light *known, aur_error *error);
void aur_cached_light_release(aur_cached_light *known);

/* At the surfaces that the group has met at `depth`, before it scatters there: the lanes of *pending, which
 * have not been here, add what is known; most of these end. */
void aur_cached_light_add(const aur_cached_light *known, aur_path_group *group, uint32_t depth,
                          uint32_t *pending);

/* The directions of sensors, as points of a torus: the azimuth, and the squared sine of the polar angle, in
 * which the cosine distribution is uniform. Shifted there at random (Cranley and Patterson 1976) each point
 * is uniform, so that means have no bias, and spherical Fibonacci points keep their distances. */

typedef struct aur_sensor_rule {
    size_t count;
    float *heights;         /* squared sines, in [0,1) */
    float *cosines, *sines; /* of the azimuth */
} aur_sensor_rule;

/* `count` directions of `set`. Errors: as aur_directions_create. */
aur_result aur_sensor_rule_create(const char *set, size_t count, uint64_t seed, const aur_warnings *warnings,
                                  aur_sensor_rule *rule, aur_error *error);
void aur_sensor_rule_release(aur_sensor_rule *rule);

/* Lights that are plane polygons of one radiance, whose light at a sensor has a closed form (Lambert 1760)
 * where nothing stands between. What does is counted by points on the light: with the closed form C, the
 * contribution c of a point and its visibility V,
 *
 *     a C + mean of c (V - a)
 *
 * is the light that arrives, whatever the number a. With a = 1 it is exact where all is seen, with a = 0
 * where nothing is; a pilot of few points of its own chooses it. */

typedef struct aur_closed_light aur_closed_light;

typedef struct aur_closed_lights {
    size_t emitter_count; /* of the scene */
    size_t count;
    aur_closed_light *lights;
    double (*corners)[3]; /* of all polygons */
} aur_closed_lights;

/* Finds them; none where there are so many that they are no cheaper than points. */
aur_result aur_closed_lights_create(const aur_scene *scene, aur_closed_lights *lights, aur_error *error);
void aur_closed_lights_release(aur_closed_lights *lights);

/* a of each emitter, or AUR_LIGHT_OPEN for those that are to be found by points and by directions. */
static const float AUR_LIGHT_OPEN = -1.0f;

/* Sets shares[emitter_count], and adds the sum of a C to direct[3]. The sensor's rays begin at `from`;
 * `position` is where it is, `normal` of unit length. */
void aur_closed_lights_at(const aur_scene *scene, const aur_closed_lights *lights, const double position[3],
                          const double normal[3], aur_vector from, uint64_t hash, float *shares,
                          double direct[3]);

_Static_assert((int)AUR_IRRADIANCE_REPLICATES == (int)AUR_PACKET_SIZE, "a lane is a randomisation");

/* A sensor that stands just off the surfaces on which it may lie. */
typedef struct aur_sensor_point {
    aur_vector position; /* where its rays begin */
    bool on_surface;     /* it has been moved off one */
    bool covered;        /* something lies on it: no light arrives but what that sends out */
    bool doubtful;       /* or may lie on it: surfaces are too near to each other to tell */
    aur_frame frame;     /* z is the normal */
    double closed[3];    /* the part of the direct light that has a closed form, r, g, b */
    float *shares;       /* of each emitter, see aur_closed_lights_at; NULL: there are no closed lights */
    uint64_t hash;       /* of seed, position and normal: of all random numbers */
} aur_sensor_point;

/* `position` and `normal` are finite, and the normal is not 0. A sensor on a surface looks from the side that
 * its normal shows; where that lies in the surface, from the surface's front. `shares` has room for the
 * closed lights' emitters and lasts as long as the place. */
void aur_sensor_point_create(const aur_scene *scene, const aur_closed_lights *lights,
                             const double position[3], const double normal[3], uint64_t seed, float *shares,
                             aur_sensor_point *surface_point);

/* Looks for what covers a sensor `from` the scene's origin, which stands on a surface within `offset` of it,
 * along the unit `axis` away from that. Sets covered, closed and doubtful. Light that passes by the cover's
 * edges is less than rounding. */
void aur_sensor_find_cover(const aur_scene *scene, const double from[3], aur_vector axis, float offset,
                           aur_sensor_point *surface_point);

/* Irradiance as the randomisations tell it. */
typedef struct aur_sensor_sums {
    double sums[AUR_PACKET_SIZE][AUR_IRRADIANCE_PARTS - 1][3]; /* direct, sky, reflected, sun; r, g, b */
    uint64_t dark; /* directions that meet a surface from behind that scatters nothing there */
} aur_sensor_sums;

/* Means over the directions of the rule. `known` may be NULL. `level` stands for independent numbers. What
 * group->sensor.from_sky is told of adds up to the irradiance of the sky times rule->count / pi. */
void aur_sensor_trace(aur_path_group *group, const aur_sensor_rule *rule,
                      const aur_sensor_point *surface_point, const aur_cached_light *known, uint32_t level,
                      aur_sensor_sums *sensor_sums);
