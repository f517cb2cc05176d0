/* Lobes: densities on the hemisphere, and the warps from uniform points to them and back. */
#include <math.h>
#include <string.h>

#include "points/base/error.h"
#include "points/base/parameters.h"
#include "points/base/text.h"
#include "points/base/vector.h"
#include "points/base/vector3d.h"
#include "points/sphere/lobe.h"

enum { MAXIMUM_EXPONENT = 1000000000 };

aur_result aur_lobe_check(const aur_lobe *lobe, aur_error *error) {
    if (lobe->kind == AUR_LOBE_COSINE_POWER) {
        if (!(lobe->exponent >= 0.0 && lobe->exponent <= MAXIMUM_EXPONENT))
            return aur_fail(error, AUR_ERROR_ARGUMENT, "a lobe's exponent must be between 0 and 1e9, not %g",
                            lobe->exponent);
        return AUR_OK;
    }
    if (!aur_lobe_reflects(lobe))
        return aur_fail(error, AUR_ERROR_ARGUMENT, "unknown kind of lobe %d", (int)lobe->kind);
    if (!(lobe->alpha >= 1e-4 && lobe->alpha <= 1.0))
        return aur_fail(error, AUR_ERROR_ARGUMENT, "a ggx lobe's alpha must be between 0.0001 and 1, not %g",
                        lobe->alpha);
    if (!(lobe->view_degrees >= 0.0 && lobe->view_degrees < 90.0))
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "a ggx lobe's view angle must be at least 0 and below 90 degrees, not %g",
                        lobe->view_degrees);
    return AUR_OK;
}

/* "A" or "A:B" into values; returns their number, 0 for anything else. */
static size_t parse_pair(const char *text, double values[2]) {
    char first[64];
    const char *const colon = strchr(text, ':');
    const size_t length = colon != NULL ? (size_t)(colon - text) : strlen(text);
    if (length >= sizeof first)
        return 0;
    memcpy(first, text, length);
    first[length] = '\0';
    if (!aur_parse_double(first, &values[0]))
        return 0;
    if (colon == NULL)
        return 1;
    return aur_parse_double(colon + 1, &values[1]) ? 2 : 0;
}

aur_result aur_lobe_parse(const char *text, aur_lobe *lobe, aur_error *error) {
    *lobe = (aur_lobe){0};
    double values[2] = {0.0, 0.0};
    if (strcmp(text, "uniform") == 0)
        return AUR_OK;
    if (strcmp(text, "cosine") == 0) {
        lobe->exponent = 1.0;
        return AUR_OK;
    }
    if (strncmp(text, "phong:", 6) == 0 && parse_pair(text + 6, values) == 1) {
        lobe->exponent = values[0];
        return aur_lobe_check(lobe, error);
    }
    const bool visible = strncmp(text, "visible:", 8) == 0;
    if ((visible || strncmp(text, "ggx:", 4) == 0) && parse_pair(text + (visible ? 8 : 4), values) != 0) {
        *lobe = (aur_lobe){
            .kind = visible ? AUR_LOBE_VISIBLE : AUR_LOBE_GGX, .alpha = values[0], .view_degrees = values[1]};
        return aur_lobe_check(lobe, error);
    }
    return aur_fail(error, AUR_ERROR_NAME,
                    "unknown lobe '%s': expected uniform, cosine, phong:M, ggx:ALPHA[:VIEW_DEGREES] or "
                    "visible:ALPHA[:VIEW_DEGREES]",
                    text);
}

/* --- GGX: reflection by the visible normals of a surface
 *
 * Stretching the surface by 1/alpha makes it a hemisphere, whose visible normals reflect the stretched view
 * direction uniformly into the cap z > -view.z (Dupuy and Benyoub 2023, "Sampling visible GGX normals with
 * spherical caps"). So a uniform direction of the hemisphere becomes one of that cap by a linear map of z at
 * the same azimuth, and everything has an inverse. */

static void view_of(const aur_lobe *lobe, double view[3]) {
    const double angle = lobe->view_degrees * (AUR_PI / 180.0);
    view[0] = sin(angle);
    view[1] = 0.0;
    view[2] = cos(angle);
}

/* From the surface to the space where it is a hemisphere (scale = alpha for directions, 1/alpha for normals).
 */
static void stretch(double v[3], double scale) {
    v[0] *= scale;
    v[1] *= scale;
    aur_normalize3(v);
}

/* The point of a cap at height `z` with the azimuth of `from`. */
static void at_height(const double from[3], double z, double to[3]) {
    const double across = from[0] * from[0] + from[1] * from[1];
    const double scale = across > 0.0 ? sqrt(fmax((1.0 - z) * (1.0 + z), 0.0) / across) : 0.0;
    to[0] = from[0] * scale;
    to[1] = from[1] * scale;
    to[2] = z;
}

/* The view reflected by a normal, of unit length. */
static void reflect(const double view[3], const double normal[3], double out[3]) {
    const double twice = 2.0 * aur_dot3(view, normal);
    for (size_t i = 0; i < 3; ++i)
        out[i] = twice * normal[i] - view[i];
    aur_normalize3(out);
}

static void ggx_warp(const aur_lobe *lobe, const double uniform[3], double direction[3]) {
    double view[3], standard[3], normal[3];
    view_of(lobe, view);
    view_of(lobe, standard);
    stretch(standard, lobe->alpha);
    at_height(uniform, uniform[2] * (1.0 + standard[2]) - standard[2], normal);
    for (size_t i = 0; i < 3; ++i)
        normal[i] += standard[i];
    stretch(normal, lobe->alpha);
    reflect(view, normal, direction);
}

static void ggx_unwarp(const aur_lobe *lobe, const double direction[3], double uniform[3]) {
    double view[3], standard[3], cap[3];
    view_of(lobe, view);
    view_of(lobe, standard);
    stretch(standard, lobe->alpha);
    double normal[3] = {direction[0] + view[0], direction[1] + view[1], direction[2] + view[2]};
    stretch(normal, 1.0 / lobe->alpha);
    reflect(standard, normal, cap);
    const double z = (cap[2] + standard[2]) / (1.0 + standard[2]);
    at_height(cap, fmin(fmax(z, 0.0), 1.0), uniform);
}

static double ggx_pdf(const aur_lobe *lobe, const double direction[3]) {
    double view[3];
    view_of(lobe, view);
    double normal[3] = {direction[0] + view[0], direction[1] + view[1], direction[2] + view[2]};
    aur_normalize3(normal);
    if (normal[2] <= 0.0 || aur_dot3(view, normal) <= 0.0)
        return 0.0;
    /* G1(view) D(normal) / (4 view.z), Heitz 2018 eqs 1-3 with the Jacobian of the reflection. */
    const double alpha2 = lobe->alpha * lobe->alpha;
    const double across = normal[0] * normal[0] + normal[1] * normal[1];
    const double shape = across / alpha2 + normal[2] * normal[2];
    const double distribution = 1.0 / (AUR_PI * alpha2 * shape * shape);
    const double projected = view[2] + sqrt(view[2] * view[2] + alpha2 * view[0] * view[0]);
    return distribution / (2.0 * projected);
}

/* --- powers of the cosine, and the choice between the two */

/* ln z of a unit vector of the upper hemisphere, to full relative precision also near the pole. */
static double log_cosine(const double direction[3], double across) {
    return direction[2] > 0.5 ? log1p(-across / (1.0 + direction[2])) : log(fmax(direction[2], 0.0));
}

/* z becomes z^power at the same azimuth. */
static void raise_cosine(double power, const double from[3], double to[3]) {
    const double x = from[0];
    const double y = from[1];
    const double across = x * x + y * y;
    const double logarithm = power * log_cosine(from, across);
    const double scale = across > 0.0 ? sqrt(-expm1(2.0 * logarithm) / across) : 0.0;
    to[2] = exp(logarithm);
    to[0] = x * scale;
    to[1] = y * scale;
}

void aur_lobe_warp(const aur_lobe *lobe, size_t count, const double *uniform, double *xyz) {
    if (aur_lobe_reflects(lobe))
        for (size_t i = 0; i < count; ++i)
            ggx_warp(lobe, uniform + 3 * i, xyz + 3 * i);
    else if (lobe->exponent != 0.0)
        for (size_t i = 0; i < count; ++i)
            raise_cosine(1.0 / (lobe->exponent + 1.0), uniform + 3 * i, xyz + 3 * i);
    else
        memmove(xyz, uniform, 3 * count * sizeof *xyz);
}

void aur_lobe_unwarp(const aur_lobe *lobe, size_t count, const double *xyz, double *uniform) {
    if (aur_lobe_reflects(lobe))
        for (size_t i = 0; i < count; ++i)
            ggx_unwarp(lobe, xyz + 3 * i, uniform + 3 * i);
    else if (lobe->exponent != 0.0)
        for (size_t i = 0; i < count; ++i)
            raise_cosine(lobe->exponent + 1.0, xyz + 3 * i, uniform + 3 * i);
    else
        memmove(uniform, xyz, 3 * count * sizeof *uniform);
}

double aur_lobe_pdf(const aur_lobe *lobe, const double direction[3]) {
    if (aur_lobe_reflects(lobe))
        return ggx_pdf(lobe, direction);
    if (direction[2] < 0.0)
        return 0.0;
    const double m = lobe->exponent;
    return (m + 1.0) / (2.0 * AUR_PI) * (m != 0.0 ? pow(direction[2], m) : 1.0);
}

aur_result aur_lobe_optimal(const aur_lobe *lobe, double smoothness, aur_lobe *density, aur_error *error) {
    if (!(smoothness > 1.0 && smoothness < 6.0))
        return aur_fail(error, AUR_ERROR_ARGUMENT, "the smoothness must be above 1 and below 6, not %g",
                        smoothness);
    if (aur_lobe_reflects(lobe))
        return aur_fail(error, AUR_ERROR_UNSUPPORTED,
                        "the optimal density of a ggx or visible lobe has no closed form: use density same");
    *density = *lobe;
    density->exponent *= 2.0 / (smoothness + 1.0);
    return AUR_OK;
}
