/* Lights that are plane polygons of one radiance, whose light at a sensor has a closed form (Lambert 1760)
 * where nothing stands between. What does is counted by points on the light: with the closed form C, the
 * contribution c of a point and its visibility V,
 *
 *     a C + mean of c (V - a)
 *
 * is the light that arrives, whatever the number a. With a = 1 it is exact where all is seen, with a = 0
 * where nothing is; a pilot of few points of its own chooses it. */
#pragma once

#include <aureole/core.h>

#include "render/scene/scene.h"

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
