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
    /* Six gradations a, b and six indicatrices c, d, e; each type has one of both (table 1). */
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

/* Table 1 of Perez et al. (1993) with its erratum, Solar Energy 51(5), 423: for each class of clearness, four
 * coefficients for each of a, b, c, d and e. */
static const struct {
    double below;
    double of[5][4];
} perez_classes[] = {
    {1.065,
     {{1.3525, -0.2576, -0.2690, -1.4366},
      {-0.7670, 0.0007, 1.2734, -0.1233},
      {2.8000, 0.6004, 1.2375, 1.0000},
      {1.8734, 0.6297, 0.9738, 0.2809},
      {0.0356, -0.1246, -0.5718, 0.9938}}},
    {1.230,
     {{-1.2219, -0.7730, 1.4148, 1.1016},
      {-0.2054, 0.0367, -3.9128, 0.9156},
      {6.9750, 0.1774, 6.4477, -0.1239},
      {-1.5798, -0.5081, -1.7812, 0.1080},
      {0.2624, 0.0672, -0.2190, -0.4285}}},
    {1.500,
     {{-1.1000, -0.2515, 0.8952, 0.0156},
      {0.2782, -0.1812, -4.5000, 1.1766},
      {24.7219, -13.0812, -37.7000, 34.8438},
      {-5.0000, 1.5218, 3.9229, -2.6204},
      {-0.0156, 0.1597, 0.4199, -0.5562}}},
    {1.950,
     {{-0.5484, -0.6654, -0.2672, 0.7117},
      {0.7234, -0.6219, -5.6812, 2.6297},
      {33.3389, -18.3000, -62.2500, 52.0781},
      {-3.5000, 0.0016, 1.1477, 0.1062},
      {0.4659, -0.3296, -0.0876, -0.0329}}},
    {2.800,
     {{-0.6000, -0.3566, -2.5000, 2.3250},
      {0.2937, 0.0496, -5.6812, 1.8415},
      {21.0000, -4.7656, -21.5906, 7.2492},
      {-3.5000, -0.1554, 1.4062, 0.3988},
      {0.0032, 0.0766, -0.0656, -0.1294}}},
    {4.500,
     {{-1.0156, -0.3670, 1.0078, 1.4051},
      {0.2875, -0.5328, -3.8500, 3.3750},
      {14.0000, -0.9999, -7.1406, 7.5469},
      {-3.4000, -0.1078, -1.0750, 1.5702},
      {-0.0672, 0.4016, 0.3017, -0.4844}}},
    {6.200,
     {{-1.0000, 0.0211, 0.5025, -0.5119},
      {-0.3000, 0.1922, 0.7023, -1.6317},
      {19.0000, -5.0000, 1.2438, -1.9094},
      {-4.0000, 0.0250, 0.3844, 0.2656},
      {1.0468, -0.3788, -2.4517, 1.4656}}},
    {INFINITY,
     {{-1.0500, 0.0289, 0.4260, 0.3590},
      {-0.3250, 0.1156, 0.7781, 0.0025},
      {31.0625, -14.5000, -46.1148, 55.3750},
      {-7.2312, 0.4050, 13.3500, 0.6234},
      {1.5000, -0.6426, 1.8564, 0.5636}}},
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
    while (found.clearness >= perez_classes[found.category].below)
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
        const double *const x = perez_classes[row].of[i];
        value[i] = x[0] + x[1] * zenith + brightness * (x[2] + x[3] * zenith);
    }
    if (row == 0) { /* their equations (7) and (8) */
        const double *const x = perez_classes[0].of[2], *const y = perez_classes[0].of[3];
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
    if (sky->c == 0.0 && sky->e == 0.0) /* the indicatrix is 1 */
        return fmax(aur_sky_model_gradation(sky, direction[2]), 0.0);
    double across[3];
    aur_cross3(direction, sky->sun, across);
    const double angle = atan2(aur_length3(across), aur_dot3(direction, sky->sun));
    const double indicatrix = aur_sky_model_indicatrix(sky, angle, cos(angle));
    return fmax(aur_sky_model_gradation(sky, direction[2]) * indicatrix, 0.0);
}

/* --- the integral over the sky */

typedef double one_variable(const void *data, double x);

/* The double exponential rule (Takahasi and Mori 1974): functions that are smooth inside of the interval, and
 * whatever they do at its ends. */
static double integrate(one_variable *function, const void *data, double from, double to) {
    static const double STEP = 1.0 / 16.0;
    const double half = 0.5 * (to - from);
    double sum = 0.0;
    for (int i = -56; i <= 56; ++i) {
        const double t = STEP * (double)i, inner = 0.5 * AUR_PI * sinh(t), scale = cosh(inner);
        const double weight = 0.5 * AUR_PI * cosh(t) / (scale * scale);
        /* By the distance from the nearer end, which is small. */
        const double gap = half * exp(-fabs(inner)) / scale;
        sum += weight * function(data, i < 0 ? from + gap : to - gap);
    }
    return STEP * half * sum;
}

/* A circle about the sun, which has one indicatrix; an azimuth of 0 lies towards the zenith. */
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

/* Circles that lie above the horizon, and arcs of those that cross it. */
double aur_sky_model_irradiance(const aur_sky_model *sky) {
    const double low = hypot(sky->sun[0], sky->sun[1]);
    const double elevation = atan2(sky->sun[2], low);
    return integrate(over_circle, sky, 0.0, elevation) +
           integrate(over_circle, sky, elevation, AUR_PI - elevation);
}
