#include "points/quality/sphere/hemisphere.h"

#include <math.h>

#include "points/base/vector.h"

/* Bulirsch's general complete elliptic integral (Bulirsch 1969): the integral over [0, pi/2] of
 * (a cos^2 t + b sin^2 t) / ((cos^2 t + p sin^2 t) sqrt(cos^2 t + k^2 sin^2 t)), for k > 0 and p > 0. */
static double complete_elliptic(double k, double p, double a, double b) {
    double geometric = k, arithmetic = 1.0, root = sqrt(p);
    b /= root;
    for (int i = 0; i < 64; ++i) {
        const double f = a;
        a += b / root;
        const double g = geometric / root;
        b = 2.0 * (b + f * g);
        root += g;
        const double before = arithmetic;
        arithmetic += k;
        if (fabs(before - k) <= before * 1e-9)
            break;
        k = 2.0 * sqrt(geometric);
        geometric = k * arithmetic;
    }
    return AUR_PI / 2.0 * (b + a * arithmetic) / (arithmetic * (arithmetic + root));
}

/* The function G of the angle g to x with Laplacian 2 sin(g/2) - 4/3 has G' sin g = 8/3 (S^3 - S^2), S =
 * sin(g/2). The divergence theorem turns the mean over the hemisphere into an integral over the equator, P(z)
 * = z / (3 pi) times the integral over phi of 2 S / (1 + s cos phi), where s = sqrt(1 - z^2) and S^2 = (1 - s
 * cos phi) / 2, which is a complete elliptic integral. P(z) + P(-z) = 8/3. */
double aur_hemisphere_potential(double z) {
    const double height = fmin(fabs(z), 1.0);
    if (height < 1e-150)
        return 4.0 / 3.0;
    const double sine = sqrt((1.0 - height) * (1.0 + height));
    const double modulus = height / (1.0 + sine);
    const double elliptic = complete_elliptic(modulus, 1.0 / (modulus * modulus), 1.0, modulus * modulus);
    const double factor = 8.0 / (3.0 * sqrt(2.0) * AUR_PI);
    const double above = factor * sqrt(1.0 + sine) / modulus * elliptic;
    return z > 0.0 ? above : 8.0 / 3.0 - above;
}
