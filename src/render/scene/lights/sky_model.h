/* How bright skies are from where: a gradation from the horizon to the zenith times an indicatrix about the
 * sun. */
#pragma once

#include "points/base/error.h"
#include "render/scene/lights/sun_position.h"
#include "render/scene/scene.h"

/* The radiance of a direction, but for a factor, is
 *
 *     (1 + slope cos Z + a exp(b / cos Z)) (1 + c (exp(d chi) - offset) + e cos^2 chi), at least 0,
 *
 * where Z is its angle from the zenith and chi from the sun. */
typedef struct aur_sky_model {
    double slope, a, b; /* b <= 0 */
    double c, d, e, offset;
    double sun[3]; /* unit; +z is the zenith, and the sun is not below the horizon */
} aur_sky_model;

/* The fifteen CIE general skies (CIE S 011/E:2003, ISO 15469:2004), `type` 1 to 15. */
aur_sky_model aur_sky_model_cie(size_t type, const double sun[3]);
/* The same by their coefficients a, b, c, d, e. */
aur_sky_model aur_sky_model_cie_of(const double coefficients[5], const double sun[3]);
/* The same everywhere, and the CIE overcast sky (Moon and Spencer 1942): three times as bright at the zenith
 * as at the horizon. */
AUR_INTERNAL aur_sky_model aur_sky_model_uniform(void);
AUR_INTERNAL aur_sky_model aur_sky_model_overcast(void);

/* What irradiances say of the weather, as the function below takes them: the clearness and brightness of
 * Perez, Seals and Michalsky (1993), equations (1) and (2), the latter held to 0.01 to 0.6; which of their
 * eight classes of clearness it is, from 0 on; and the sun's angle from the zenith in radians. */
typedef struct aur_perez_conditions {
    double clearness, brightness, zenith;
    size_t category;
} aur_perez_conditions;
AUR_INTERNAL aur_perez_conditions aur_perez_conditions_of(double direct_normal, double diffuse_horizontal,
                                                          double extraterrestrial, const double sun[3]);

/* The all-weather sky of Perez, Seals and Michalsky (1993), Solar Energy 50(3), 235-245, with the clearness
 * of their equation (1) and the brightness of (2), for the sun's irradiance on a plane that faces it, that of
 * the sky on the horizontal plane (> 0), and that of the sun outside of the atmosphere, all in W/m^2. The
 * brightness is held to 0.01 to 0.6, and to 0.2 at least for clearness from 1.065 to 2.8, as its authors
 * advise. Where their b is above 0, which has no bound at the horizon and happens under a low sun in very
 * clear air, it is 0. */
AUR_INTERNAL aur_sky_model aur_sky_model_perez(double direct_normal, double diffuse_horizontal,
                                               double extraterrestrial, const double sun[3]);

/* The formula above; `direction` is of unit length and not below the horizon. */
double aur_sky_model_radiance(const aur_sky_model *sky, const double direction[3]);

/* Its two factors, for those who evaluate one of them for many directions: by cos Z, and by chi in radians
 * with cos chi, which who has found the angle from it need not find again. */
AUR_INTERNAL double aur_sky_model_gradation(const aur_sky_model *sky, double cosine);
AUR_INTERNAL double aur_sky_model_indicatrix(const aur_sky_model *sky, double angle, double along);

/* The irradiance of the sky on the horizontal plane: the integral of its radiance times cos Z, to 1e-10 of
 * it where the formula is nowhere below 0. */
double aur_sky_model_irradiance(const aur_sky_model *sky);

/* A scene under a sky of the same radiance everywhere, in the place of all its lights: from it come daylight
 * coefficients. */

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
