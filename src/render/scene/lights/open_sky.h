/* A scene under a sky of the same radiance everywhere, in the place of all its lights: from it come daylight
 * coefficients. */
#pragma once

#include "points/base/internal.h"
#include "render/scene/lights/sun_position.h"
#include "render/scene/scene.h"

/* A view of another scene, which must outlive it. */
typedef struct aur_open_sky {
    const aur_scene *scene; /* what rays are to be traced in: the sky is its only light */
    aur_sun_position frame; /* where up, north and east are; without a sun */
    size_t lamps;           /* lights of the scene that are left out but for those beyond it */
} aur_open_sky;

/* The radiance is 1 above the horizon and `ground` below. `up` and `north` all 0: those of the scene's sky;
 * where it has none, +z and +y for scenes of Radiance, else +y and -z. Errors: FORMAT (directions that are
 * 0 or lie along each other), MEMORY. */
AUR_INTERNAL aur_result aur_open_sky_create(const aur_scene *scene, double ground, const double up[3],
                                            const double north[3], aur_open_sky *open, aur_error *error);
AUR_INTERNAL void aur_open_sky_release(aur_open_sky *open); /* may be zero */
