/* Daylight coefficients of one sensor: what reaches it of each patch of the sky, by one trace. */
#pragma once

#include "lighting/daylight/hours.h"
#include "lighting/daylight/product.h"
#include "lighting/irradiance/look.h"
#include "render/scene/lights/sky_model.h"

/* The radiance of the ground in the scene that is traced: what it sends is found as well as the sky's. */
static const double AUR_DAYLIGHT_GROUND = 0.25;

typedef struct aur_coefficients {
    const aur_sky_patches *patches;
    const aur_open_sky *sky;
    double luminance[3]; /* weights that add up to 1 */
    /* [patches][16]: illuminance by radiance of each randomisation; of all light, and of what came by
     * reflection. */
    double *all, *reflected;
} aur_coefficients;

/* Fills all[] and reflected[]. */
void aur_coefficients_find(aur_path_group *group, const aur_sensor_rule *rule, const aur_sensor_place *place,
                           const aur_coefficients *coefficients, aur_look *look);

/* seen[lit->count][16]: the illuminance straight from the sun of each hour, by a point of its disk for each
 * randomisation. */
void aur_sun_seen(aur_path_group *group, const aur_sensor_place *place, const aur_coefficients *coefficients,
                  const aur_lit_hours *lit, double *seen);
