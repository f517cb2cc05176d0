/* What one sensor sees: light along sixteen randomisations of a rule at once, one a lane. */
#pragma once

#include <aureole-lighting/irradiance.h>

#include "lighting/irradiance/closed_lights.h"
#include "lighting/irradiance/known_light.h"
#include "lighting/irradiance/rule.h"
#include "render/path/path_group.h"
#include "render/vertex/panes.h"

_Static_assert((int)AUR_IRRADIANCE_REPLICATES == (int)AUR_PACKET_SIZE, "a lane is a randomisation");

/* A sensor that stands just off the surfaces on which it may lie. */
typedef struct aur_sensor_place {
    aur_vector position; /* where its rays begin */
    bool on_surface;     /* it has been moved off one */
    bool covered;        /* something lies on it: no light arrives but what that sends out */
    aur_frame frame;     /* z is the normal */
    double closed[3];    /* the part of the direct light that has a closed form, r, g, b */
    float *shares;       /* of each emitter, see aur_closed_lights_at; NULL: there are no closed lights */
    uint64_t hash;       /* of seed, position and normal: of all random numbers */
} aur_sensor_place;

/* `position` and `normal` are finite, and the normal is not 0. A sensor on a surface looks from the side that
 * its normal shows; where that lies in the surface, from the surface's front. `shares` has room for the
 * closed lights' emitters and lasts as long as the place. */
void aur_sensor_place_create(const aur_scene *scene, const aur_closed_lights *lights,
                             const double position[3], const double normal[3], uint64_t seed, float *shares,
                             aur_sensor_place *place);

/* Irradiance as the randomisations tell it. */
typedef struct aur_look {
    double sums[AUR_PACKET_SIZE][AUR_IRRADIANCE_PARTS - 1][3]; /* direct, sky, reflected, sun; r, g, b */
    uint64_t dark; /* directions that meet a surface from behind that scatters nothing there */
} aur_look;

/* Means over the directions of the rule. `known` may be NULL. `level` stands for independent numbers. What
 * group->sensor.from_sky is told of adds up to the irradiance of the sky times rule->count / pi. */
void aur_sensor_look(aur_path_group *group, const aur_sensor_rule *rule, const aur_sensor_place *place,
                     const aur_known_light *known, uint32_t level, aur_look *look);
