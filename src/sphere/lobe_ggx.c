/* Reflection by the visible normals of a GGX surface.
 *
 * Stretching the surface by 1/alpha makes it a hemisphere, whose visible normals reflect the stretched view
 * direction uniformly into the cap z > -view.z (Dupuy and Benyoub 2023, "Sampling visible GGX normals with
 * spherical caps"). So a uniform direction of the hemisphere becomes one of that cap by a linear map of z at
 * the same azimuth, and everything has an inverse. */
#include "sphere/lobe_ggx.h"

#include <math.h>

#include "core/vector.h"

static void normalize(double v[3]) {
    const double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (size_t i = 0; i < 3 && length > 0.0; ++i)
        v[i] /= length;
}

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

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
    normalize(v);
}

/* The point of a cap at height `z` with the azimuth of `from`. */
static void at_height(const double from[3], double z, double to[3]) {
    const double across = from[0] * from[0] + from[1] * from[1];
    const double scale = across > 0.0 ? sqrt(fmax((1.0 - z) * (1.0 + z), 0.0) / across) : 0.0;
    to[0] = from[0] * scale;
    to[1] = from[1] * scale;
    to[2] = z;
}

/* view reflected by a normal */
static void reflect(const double view[3], const double normal[3], double out[3]) {
    const double twice = 2.0 * dot(view, normal);
    for (size_t i = 0; i < 3; ++i)
        out[i] = twice * normal[i] - view[i];
    normalize(out);
}

void aur_ggx_warp(const aur_lobe *lobe, const double uniform[3], double direction[3]) {
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

void aur_ggx_unwarp(const aur_lobe *lobe, const double direction[3], double uniform[3]) {
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

double aur_ggx_pdf(const aur_lobe *lobe, const double direction[3]) {
    double view[3];
    view_of(lobe, view);
    double normal[3] = {direction[0] + view[0], direction[1] + view[1], direction[2] + view[2]};
    normalize(normal);
    if (normal[2] <= 0.0 || dot(view, normal) <= 0.0)
        return 0.0;
    /* G1(view) D(normal) / (4 view.z), Heitz 2018 eqs 1-3 with the Jacobian of the reflection. */
    const double alpha2 = lobe->alpha * lobe->alpha;
    const double across = normal[0] * normal[0] + normal[1] * normal[1];
    const double shape = across / alpha2 + normal[2] * normal[2];
    const double distribution = 1.0 / (AUR_PI * alpha2 * shape * shape);
    const double projected = view[2] + sqrt(view[2] * view[2] + alpha2 * view[0] * view[0]);
    return distribution / (2.0 * projected);
}
