/* Analytic skies: luminance is a gradation from horizon to zenith times an indicatrix about the sun. */
#pragma once

#include "points/base/error.h"
#include "render/scene/lights/sun_position.h"
#include "render/scene/scene.h"

/* The relative radiance of a direction is
 *
 *     (1 + slope cos Z + a exp(b / cos Z)) (1 + c (exp(d chi) - offset) + e cos^2 chi), at least 0,
 *
 * where Z is the angle from the zenith and chi the angle from the sun. */
typedef struct aur_sky_model {
    double slope, a, b; /* b <= 0 */
    double c, d, e, offset;
    double sun[3]; /* unit; +z is the zenith, and the sun is not below the horizon */
} aur_sky_model;

/* The fifteen CIE general skies (CIE S 011/E:2003, ISO 15469:2004), `type` 1 to 15. */
aur_sky_model aur_sky_model_cie(size_t type, const double sun[3]);
/* The same by coefficients a, b, c, d, e. */
aur_sky_model aur_sky_model_cie_of(const double coefficients[5], const double sun[3]);
/* The uniform sky, and the CIE overcast sky (Moon and Spencer 1942): three times as bright at the zenith as
 * at the horizon. */
AUR_INTERNAL aur_sky_model aur_sky_model_uniform(void);
AUR_INTERNAL aur_sky_model aur_sky_model_overcast(void);

/* Parameters derived from irradiances for the function below: clearness and brightness of Perez, Seals and
 * Michalsky (1993), equations (1) and (2), the latter limited to 0.01 to 0.6; the index of the clearness
 * class, 0 to 7; and the sun's zenith angle in radians. */
typedef struct aur_perez_conditions {
    double clearness, brightness, zenith;
    size_t category;
} aur_perez_conditions;
AUR_INTERNAL aur_perez_conditions aur_perez_conditions_of(double direct_normal, double diffuse_horizontal,
                                                          double extraterrestrial, const double sun[3]);

/* The all-weather sky of Perez, Seals and Michalsky (1993), Solar Energy 50(3), 235-245, with the clearness
 * of their equation (1) and the brightness of (2). Inputs in W/m^2: the sun's irradiance at normal incidence,
 * the sky's on the horizontal plane (> 0), and the sun's outside of the atmosphere. The brightness is limited
 * to 0.01 to 0.6, and to at least 0.2 for clearness from 1.065 to 2.8, as its authors advise. If their b is
 * above 0, as under a low sun in very clear air, radiance would be unbounded at the horizon: b is 0 then. */
AUR_INTERNAL aur_sky_model aur_sky_model_perez(double direct_normal, double diffuse_horizontal,
                                               double extraterrestrial, const double sun[3]);

/* The formula above; `direction` is a unit vector and not below the horizon. */
double aur_sky_model_radiance(const aur_sky_model *sky, const double direction[3]);

/* The two factors of the formula, to evaluate one of them for many directions: by cos Z, and by chi in
 * radians with cos chi (both, as callers have both). */
AUR_INTERNAL double aur_sky_model_gradation(const aur_sky_model *sky, double cosine);
AUR_INTERNAL double aur_sky_model_indicatrix(const aur_sky_model *sky, double angle, double along);

/* The irradiance of the sky on the horizontal plane: the integral of radiance times cos Z, with relative
 * error 1e-10 if the formula is nowhere negative. */
double aur_sky_model_irradiance(const aur_sky_model *sky);

/* A scene lit only by a uniform sky, in place of its lights: the basis of daylight coefficients. */

/* A view of another scene, which must outlive it. */
typedef struct aur_open_sky {
    const aur_scene *scene; /* the scene to trace rays in: the sky is its only light */
    aur_sun_position frame; /* orientation of up, north and east; without a sun */
    size_t removed_lights;  /* number of the scene's lights removed, not counting environments */
} aur_open_sky;

/* Radiance is 1 above the horizon and `ground` below. If `up` and `north` are all 0, the orientation is that
 * of the scene's sky; without a sky, +z and +y for Radiance scenes, else +y and -z. Errors: FORMAT
 * (directions that are 0 or parallel), MEMORY. */
AUR_INTERNAL aur_result aur_open_sky_create(const aur_scene *scene, double ground, const double up[3],
                                            const double north[3], aur_open_sky *open, aur_error *error);
AUR_INTERNAL void aur_open_sky_release(aur_open_sky *open); /* may be zero-initialised */
