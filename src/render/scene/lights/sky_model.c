#include "render/scene/lights/sky_model.h"

#include <math.h>

#include "points/base/vector.h"
#include "points/base/vector3d.h"

aur_sky_model aur_sky_model_uniform(void) {
    return (aur_sky_model){.sun = {0.0, 0.0, 1.0}};
}

aur_sky_model aur_sky_model_overcast(void) {
    return (aur_sky_model){.slope = 2.0, .sun = {0.0, 0.0, 1.0}};
}

aur_sky_model aur_sky_model_cie_of(const double coefficients[5], const double sun[3]) {
    return (aur_sky_model){.a = coefficients[0],
                           .b = coefficients[1],
                           .c = coefficients[2],
                           .d = coefficients[3],
                           .e = coefficients[4],
                           .offset = exp(coefficients[3] * 0.5 * AUR_PI),
                           .sun = {sun[0], sun[1], sun[2]}};
}

aur_sky_model aur_sky_model_cie(size_t type, const double sun[3]) {
    /* Six gradations a, b and six indicatrices c, d, e; each type combines one of each (table 1). */
    static const double gradations[6][2] = {{4.0, -0.70},  {1.1, -0.80},  {0.0, -1.00},
                                            {-1.0, -0.55}, {-1.0, -0.32}, {-1.0, -0.15}};
    static const double indicatrices[6][3] = {{0.0, -1.0, 0.00},  {2.0, -1.5, 0.15},  {5.0, -2.5, 0.30},
                                              {10.0, -3.0, 0.45}, {16.0, -3.0, 0.30}, {24.0, -2.8, 0.15}};
    static const unsigned char pairs[15][2] = {{0, 0}, {0, 1}, {1, 0}, {1, 1}, {2, 0}, {2, 1}, {2, 2}, {2, 3},
                                               {3, 1}, {3, 2}, {3, 3}, {4, 3}, {4, 4}, {5, 4}, {5, 5}};
    const double *const gradation = gradations[pairs[type - 1][0]];
    const double *const indicatrix = indicatrices[pairs[type - 1][1]];
    return aur_sky_model_cie_of(
        (const double[5]){gradation[0], gradation[1], indicatrix[0], indicatrix[1], indicatrix[2]}, sun);
}

/* Table 1 of Perez et al. (1993): the upper bound of clearness of each class, and four coefficients for each
 * of a, b, c, d and e. */
enum { PEREZ_CLASSES = 8 };
static const double clearness_below[PEREZ_CLASSES] = {1.065, 1.23, 1.5, 1.95, 2.8, 4.5, 6.2, INFINITY};
static const double perez[PEREZ_CLASSES][5 * 4] = {
#include "data/perez_sky.inc"
};

aur_perez_conditions aur_perez_conditions_of(double direct_normal, double diffuse_horizontal,
                                             double extraterrestrial, const double sun[3]) {
    const double zenith = acos(fmin(sun[2], 1.0)), cube = 1.041 * zenith * zenith * zenith;
    /* Kasten (1966) */
    const double air_mass = 1.0 / (cos(zenith) + 0.15 * pow(93.885 - zenith * 180.0 / AUR_PI, -1.253));
    aur_perez_conditions found = {
        .zenith = zenith,
        .clearness = ((diffuse_horizontal + direct_normal) / diffuse_horizontal + cube) / (1.0 + cube),
        .brightness = fmin(fmax(diffuse_horizontal * air_mass / extraterrestrial, 0.01), 0.6)};
    while (found.clearness >= clearness_below[found.category])
        ++found.category;
    return found;
}

aur_sky_model aur_sky_model_perez(double direct_normal, double diffuse_horizontal, double extraterrestrial,
                                  const double sun[3]) {
    const aur_perez_conditions found =
        aur_perez_conditions_of(direct_normal, diffuse_horizontal, extraterrestrial, sun);
    const double zenith = found.zenith;
    const bool bright = found.clearness > 1.065 && found.clearness < 2.8;
    const double brightness = bright ? fmax(found.brightness, 0.2) : found.brightness;
    const size_t row = found.category;
    double value[5];
    for (size_t i = 0; i < 5; ++i) {
        const double *const x = perez[row] + 4 * i;
        value[i] = x[0] + x[1] * zenith + brightness * (x[2] + x[3] * zenith);
    }
    if (row == 0) { /* their equations (7) and (8) */
        const double *const x = perez[0] + 8, *const y = perez[0] + 12;
        value[2] = exp(pow(brightness * (x[0] + x[1] * zenith), x[2])) - x[3];
        value[3] = -exp(brightness * (y[0] + y[1] * zenith)) + y[2] + brightness * y[3];
    }
    value[1] = fmin(value[1], 0.0);
    aur_sky_model sky = aur_sky_model_cie_of(value, sun);
    sky.offset = 0.0;
    return sky;
}

double aur_sky_model_gradation(const aur_sky_model *sky, double cosine) {
    return 1.0 + sky->slope * cosine + (sky->a != 0.0 ? sky->a * exp(sky->b / fmax(cosine, 1e-12)) : 0.0);
}

double aur_sky_model_indicatrix(const aur_sky_model *sky, double angle, double along) {
    return 1.0 + sky->c * (exp(sky->d * angle) - sky->offset) + sky->e * along * along;
}

double aur_sky_model_radiance(const aur_sky_model *sky, const double direction[3]) {
    if (sky->c == 0.0 && sky->e == 0.0) /* the indicatrix is constant, 1 */
        return fmax(aur_sky_model_gradation(sky, direction[2]), 0.0);
    double across[3];
    aur_cross3(direction, sky->sun, across);
    const double angle = atan2(aur_length3(across), aur_dot3(direction, sky->sun));
    const double indicatrix = aur_sky_model_indicatrix(sky, angle, cos(angle));
    return fmax(aur_sky_model_gradation(sky, direction[2]) * indicatrix, 0.0);
}

/* --- the integral over the sky */

typedef double one_variable(const void *data, double x);

/* Double exponential quadrature (Takahasi and Mori 1974), for integrands that are smooth inside of the
 * interval but may be singular at its ends. */
static double integrate(one_variable *function, const void *data, double from, double to) {
    static const double STEP = 1.0 / 16.0;
    const double half = 0.5 * (to - from);
    double sum = 0.0;
    for (int i = -56; i <= 56; ++i) {
        const double t = STEP * (double)i, inner = 0.5 * AUR_PI * sinh(t), scale = cosh(inner);
        const double weight = 0.5 * AUR_PI * cosh(t) / (scale * scale);
        /* Evaluates by distance from the nearer end, which is accurate when small. */
        const double gap = half * exp(-fabs(inner)) / scale;
        sum += weight * function(data, i < 0 ? from + gap : to - gap);
    }
    return STEP * half * sum;
}

/* The integral along a circle about the sun, where the indicatrix is constant; azimuth 0 is towards the
 * zenith. */
typedef struct circle {
    const aur_sky_model *sky;
    double indicatrix, height, reach; /* cos Z is height + reach cos(azimuth) */
} circle;

static double on_circle(const void *data, double azimuth) {
    const circle *const at = data;
    const double cosine = fmax(at->height + at->reach * cos(azimuth), 0.0);
    return cosine * fmax(aur_sky_model_gradation(at->sky, cosine) * at->indicatrix, 0.0);
}

static double over_circle(const void *data, double angle) {
    const aur_sky_model *const sky = data;
    const double low = hypot(sky->sun[0], sky->sun[1]);
    const double along = cos(angle);
    const circle at = {sky, aur_sky_model_indicatrix(sky, angle, along), sky->sun[2] * along,
                       low * sin(angle)};
    const double end = at.height >= at.reach ? AUR_PI : acos(fmin(-at.height / at.reach, 1.0));
    return 2.0 * sin(angle) * integrate(on_circle, &at, 0.0, end);
}

/* Circles above the horizon, and arcs of circles that cross it. */
double aur_sky_model_irradiance(const aur_sky_model *sky) {
    const double low = hypot(sky->sun[0], sky->sun[1]);
    const double elevation = atan2(sky->sun[2], low);
    return integrate(over_circle, sky, 0.0, elevation) +
           integrate(over_circle, sky, elevation, AUR_PI - elevation);
}
