/* A quadrature of the GGX lobe in the slopes of its half-vectors.
 *
 * By the slope (x, y) of the half-vector of a view (s, 0, c) and a direction the lobe is D(x, y) (s x + c) G
 * dx dy with D = 1 / (1 + (x^2 + y^2) / alpha^2)^2 and the height-correlated masking G. Directions above the
 * surface are the disk of radius 1/c about (s/c, 0). In polar coordinates about the slope 0 it ends at R =
 * s/c cos phi + sqrt((s/c cos phi)^2 + 1), which is analytic, and with r = alpha sinh(tau) functions analytic
 * in r remain analytic within pi/2 of the real axis, however narrow the lobe. Gauss-Legendre in tau, with
 * nodes concentrated at the horizon, where G changes within alpha; equal steps in psi with tan phi = c^{-1/2}
 * tan psi, which moves the branch points of R and the poles of polynomials equally far away. */
#include <math.h>
#include <stdlib.h>

#include "points/base/gauss.h"
#include "points/base/vector.h"
#include "points/quadrature/exact/system.h"

typedef struct ggx_lobe {
    double alpha, sine, cosine; /* of the view */
} ggx_lobe;

/* cos times (1 + sqrt(1 + alpha^2 tan^2)) / 2: the cosine times 1 + Lambda (Heitz 2014). */
static double masked_cosine(double alpha, double cosine) {
    return 0.5 * (cosine + sqrt(cosine * cosine + alpha * alpha * (1.0 - cosine * cosine)));
}

/* The direction and the mass per dr dphi at a slope. */
static double place(const ggx_lobe *lobe, double r, double phi, double direction[3]) {
    const double x = r * cos(phi), y = r * sin(phi), scale = 1.0 / (1.0 + r * r);
    const double seen = lobe->sine * x + lobe->cosine; /* view . half-vector over the latter's height */
    direction[0] = 2.0 * seen * scale * x - lobe->sine;
    direction[1] = 2.0 * seen * scale * y;
    direction[2] = fmax(2.0 * seen * scale - lobe->cosine, 0.0);
    const double shape = 1.0 + r * r / (lobe->alpha * lobe->alpha), z = direction[2];
    /* z times G over the view's cosine, up to a factor: 1 + Lambda and Lambda' with z multiplied out. */
    const double masking =
        z / (z * masked_cosine(lobe->alpha, lobe->cosine) / lobe->cosine + masked_cosine(lobe->alpha, z) - z);
    return r * seen * masking / (shape * shape);
}

static size_t turns_count(double cosine, size_t degree) {
    const double reach = atanh(fmin(sqrt(cosine), 0.9999));
    return 16 + 2 * degree + (size_t)((30.0 + 3.0 * (double)degree) / reach);
}

aur_result aur_exact_ggx_nodes(const aur_lobe *lobe, size_t degree, aur_exact_nodes *nodes,
                               aur_error *error) {
    const double angle = lobe->view_degrees / 180.0 * AUR_PI;
    const ggx_lobe ggx = {lobe->alpha, sin(angle), cos(angle)};
    const size_t along = 64 + degree, around = turns_count(ggx.cosine, degree);
    const size_t count = along * around;
    double *const storage = malloc((4 * count + 2 * along) * sizeof *storage);
    if (storage == NULL)
        return aur_fail_memory(error);
    double *const gauss = storage + 4 * count, *const share = gauss + along;
    *nodes = (aur_exact_nodes){count, storage, storage + 3 * count};
    aur_gauss_legendre(along, gauss, share);
    const double stretch = 1.0 / sqrt(ggx.cosine);
    double sum = 0.0;
    for (size_t k = 0; k < around; ++k) {
        const double psi = 2.0 * AUR_PI * ((double)k + 0.5) / (double)around;
        const double across = cos(psi), aside = stretch * sin(psi);
        const double phi = atan2(aside, across), step = stretch / (across * across + aside * aside);
        const double middle = ggx.sine / ggx.cosine * cos(phi), root = sqrt(middle * middle + 1.0);
        const double reach = middle < 0.0 ? 1.0 / (root - middle) : root + middle;
        const double length = asinh(reach / ggx.alpha);
        for (size_t j = 0; j < along; ++j) {
            const double rest = 0.5 * (1.0 - gauss[j]); /* of the interval, before squaring */
            const double tau = length * (1.0 - rest * rest);
            const size_t at = k * along + j;
            nodes->mass[at] = length * rest * share[j] * step * cosh(tau) *
                              place(&ggx, ggx.alpha * sinh(tau), phi, nodes->xyz + 3 * at);
            sum += nodes->mass[at];
        }
    }
    for (size_t i = 0; i < count; ++i)
        nodes->mass[i] /= sum;
    return AUR_OK;
}
