#include "render/scene/lights/hosek_wilkie.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

#include "points/base/vector3d.h"

enum { TURBIDITIES = 10, ALBEDOS = 2, CONTROL_POINTS = 6, CHANNELS = 3, PARAMETERS = 9, ELEVATIONS = 30 };

/* By turbidity, albedo, control point and channel: the parameters and the mean radiance. */
static const double sky_rows[TURBIDITIES * ALBEDOS * CONTROL_POINTS * CHANNELS][PARAMETERS + 1] = {
#include "data/hosek_wilkie_sky.inc"
};

/* By turbidity and elevation, from 2 degrees in steps of 3. */
static const double sun_rows[TURBIDITIES * ELEVATIONS][CHANNELS] = {
#include "data/hosek_wilkie_sun.inc"
};

/* The integral of CIE's Y over wavelengths in nm, as in Mitsuba. */
static const double CIE_Y_INTEGRAL = 106.7502593994140625;

/* Interpolation between `count` rows: weights 1 - share of row `low`, and share of the next. */
typedef struct between {
    size_t low;
    double share;
} between;

static between find_between(double position, size_t count) {
    const double held = fmin(fmax(position, 0.0), (double)(count - 1));
    const size_t low = held < (double)(count - 2) ? (size_t)held : count - 2;
    return (between){low, held - (double)low};
}

/* Adds the rows of one turbidity and albedo for channel c, times their Bernstein polynomials. */
static void add_rows(size_t turbidity, size_t albedo, size_t c, double x, double weight,
                     double sums[PARAMETERS + 1]) {
    static const double binomials[CONTROL_POINTS] = {1.0, 5.0, 10.0, 10.0, 5.0, 1.0};
    for (size_t k = 0; k < CONTROL_POINTS; ++k) {
        const double *const row =
            sky_rows[((turbidity * ALBEDOS + albedo) * CONTROL_POINTS + k) * CHANNELS + c];
        const double factor = weight * binomials[k] * pow(1.0 - x, (double)(5 - k)) * pow(x, (double)k);
        for (size_t i = 0; i <= PARAMETERS; ++i)
            sums[i] += factor * row[i];
    }
}

aur_hosek_wilkie_sky aur_hosek_wilkie_sky_make(double turbidity, aur_vector albedo, const double sun[3]) {
    aur_hosek_wilkie_sky sky = {.sun = {sun[0], sun[1], sun[2]}};
    const double elevation = atan2(sun[2], hypot(sun[0], sun[1])),
                 x = cbrt(fmax(elevation, 0.0) / (0.5 * AUR_PI));
    const double albedos[CHANNELS] = {(double)albedo.x, (double)albedo.y, (double)albedo.z};
    const between at = find_between(turbidity - 1.0, TURBIDITIES);
    for (size_t c = 0; c < CHANNELS; ++c) {
        double sums[PARAMETERS + 1] = {0.0};
        for (size_t t = 0; t < 2; ++t)
            for (size_t a = 0; a < ALBEDOS; ++a)
                add_rows(at.low + t, a, c, x,
                         (t == 1 ? at.share : 1.0 - at.share) * (a == 1 ? albedos[c] : 1.0 - albedos[c]),
                         sums);
        memcpy(sky.parameters[c], sums, sizeof sky.parameters[c]);
        sky.radiance[c] = sums[PARAMETERS] / CIE_Y_INTEGRAL;
    }
    return sky;
}

/* Equations (8) and (9) of Hosek and Wilkie 2012, with parameters in the order of their tables. */
static double radiance_of(const double p[PARAMETERS], double height, double angle) {
    const double along = cos(angle), square = along * along;
    const double halo = (1.0 + square) / pow(1.0 + p[8] * p[8] - 2.0 * p[8] * along, 1.5);
    const double gradation = 1.0 + p[0] * exp(p[1] / (height + 0.01));
    return gradation * (p[2] + p[3] * exp(p[4] * angle) + p[5] * square + p[6] * halo + p[7] * sqrt(height));
}

aur_vector aur_hosek_wilkie_sky_radiance(const aur_hosek_wilkie_sky *sky, const double direction[3]) {
    double across[3], value[CHANNELS];
    aur_cross3(direction, sky->sun, across);
    const double angle = atan2(aur_length3(across), aur_dot3(direction, sky->sun));
    /* Saturated colours are outside of sRGB: a negative part of one is no light. */
    for (size_t c = 0; c < CHANNELS; ++c)
        value[c] =
            fmax(sky->radiance[c] * radiance_of(sky->parameters[c], fmax(direction[2], 0.0), angle), 0.0);
    return (aur_vector){(float)value[0], (float)value[1], (float)value[2]};
}

aur_vector aur_hosek_wilkie_sun_radiance(double turbidity, double height) {
    const between air = find_between(turbidity - 1.0, TURBIDITIES);
    const between at = find_between((asin(fmin(height, 1.0)) * 180.0 / AUR_PI - 2.0) / 3.0, ELEVATIONS);
    double value[CHANNELS] = {0.0};
    for (size_t t = 0; t < 2; ++t)
        for (size_t e = 0; e < 2; ++e)
            for (size_t c = 0; c < CHANNELS; ++c)
                value[c] += (t == 1 ? air.share : 1.0 - air.share) * (e == 1 ? at.share : 1.0 - at.share) *
                            sun_rows[(air.low + t) * ELEVATIONS + at.low + e][c];
    return (aur_vector){(float)fmax(value[0], 0.0), (float)fmax(value[1], 0.0), (float)fmax(value[2], 0.0)};
}
