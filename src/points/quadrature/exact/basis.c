#include "points/quadrature/exact/transform.h"

#include <math.h>
#include <stdlib.h>

#include "points/base/gauss.h"

/* The recurrence of the spherical harmonics. */
static void fill_sphere(aur_basis *basis) {
    const size_t degree = basis->degree;
    basis->start[0] = 1.0;
    for (size_t m = 0; m <= degree; ++m) {
        const double order = (double)m;
        if (m > 0) /* sin and cos have the mean square 1/2 */
            basis->start[m] = sqrt((2.0 * order + 1.0) / (2.0 * order) * (m == 1 ? 2.0 : 1.0));
        aur_basis_step *const steps = basis->steps + aur_basis_at(degree, m) - m;
        for (size_t k = m + 1; k <= degree; ++k) {
            const double l = (double)k;
            const double a = sqrt((4.0 * l * l - 1.0) / (l * l - order * order));
            const double b =
                sqrt(((l - 1.0) * (l - 1.0) - order * order) / (4.0 * (l - 1.0) * (l - 1.0) - 1.0));
            steps[k] = (aur_basis_step){a, 0.0, k > m + 1 ? a * b : 0.0};
        }
    }
}

/* A rule in z for the density: `mass` sums to 1. */
typedef struct heights {
    size_t count;
    double *z, *mass;
    double *here, *before; /* a polynomial and the one before it, at the nodes */
    double *storage;
} heights;

/* Gauss-Legendre nodes in t. For densities that vanish at the equator z = t^4, which makes their fractional
 * powers t^{4 exponent + 3} smooth enough; for even ones z is linear in t. */
static bool make_heights(size_t degree, double lowest, double exponent, heights *h) {
    const bool stretched = exponent > 0.0;
    h->count = degree + 2;
    if (stretched)
        h->count = 4 * (degree + 1) + 2 * (size_t)exponent + 32;
    h->storage = malloc(4 * h->count * sizeof *h->storage);
    if (h->storage == NULL)
        return false;
    h->z = h->storage;
    h->mass = h->z + h->count;
    h->here = h->mass + h->count;
    h->before = h->here + h->count;
    aur_gauss_legendre(h->count, h->z, h->mass);
    double sum = 0.0;
    for (size_t i = 0; i < h->count; ++i) {
        const double t = 0.5 * (1.0 + h->z[i]);
        h->z[i] = stretched ? t * t * t * t : lowest + (1.0 - lowest) * t;
        h->mass[i] *= stretched ? pow(t, 4.0 * exponent + 3.0) : 1.0;
        sum += h->mass[i];
    }
    for (size_t i = 0; i < h->count; ++i)
        h->mass[i] /= sum;
    return true;
}

/* The polynomials of one order, orthonormal for `mass`, by Stieltjes' procedure (Gautschi 2004, section
 * 2.2.3). */
static void fill_order(const heights *h, size_t count, aur_basis_step *steps) {
    double norm = 0.0;
    for (size_t i = 0; i < h->count; ++i)
        norm += h->mass[i];
    for (size_t i = 0; i < h->count; ++i) {
        h->here[i] = 1.0 / sqrt(norm);
        h->before[i] = 0.0;
    }
    double last = 0.0;
    for (size_t k = 1; k < count; ++k) {
        double mean = 0.0, square = 0.0;
        for (size_t i = 0; i < h->count; ++i)
            mean += h->mass[i] * h->z[i] * h->here[i] * h->here[i];
        for (size_t i = 0; i < h->count; ++i) {
            const double next = (h->z[i] - mean) * h->here[i] - last * h->before[i];
            h->before[i] = h->here[i];
            h->here[i] = next;
            square += h->mass[i] * next * next;
        }
        const double length = sqrt(square);
        for (size_t i = 0; i < h->count; ++i)
            h->here[i] /= length;
        steps[k] = (aur_basis_step){1.0 / length, -mean / length, last / length};
        last = length;
    }
}

/* Order m uses the density times (1-z^2)^m, scaled by the ratio of its sum to that of order m-1, so that
 * nothing underflows. */
static void fill_cap(const heights *h, aur_basis *basis) {
    const size_t degree = basis->degree;
    basis->start[0] = 1.0;
    for (size_t m = 0; m <= degree; ++m) {
        if (m > 0) {
            double sum = 0.0;
            for (size_t i = 0; i < h->count; ++i) {
                h->mass[i] *= 1.0 - h->z[i] * h->z[i];
                sum += h->mass[i];
            }
            for (size_t i = 0; i < h->count; ++i)
                h->mass[i] /= sum;
            basis->start[m] = sqrt((m == 1 ? 2.0 : 1.0) / sum);
        }
        fill_order(h, degree + 1 - m, basis->steps + aur_basis_at(degree, m));
    }
}

aur_result aur_basis_create(size_t degree, double lowest, double exponent, aur_basis *basis,
                            aur_error *error) {
    const size_t pairs = aur_basis_pairs(degree);
    *basis = (aur_basis){.degree = degree,
                         .start = malloc((degree + 1) * sizeof(double)),
                         .steps = malloc(pairs * sizeof *basis->steps)};
    heights h = {0};
    const bool room = basis->start != NULL && basis->steps != NULL;
    if (!room || (lowest > -1.0 && !make_heights(degree, lowest, exponent, &h))) {
        aur_basis_release(basis);
        return aur_fail_memory(error);
    }
    if (lowest > -1.0)
        fill_cap(&h, basis);
    else
        fill_sphere(basis);
    free(h.storage);
    return AUR_OK;
}

void aur_basis_release(aur_basis *basis) {
    free(basis->start);
    free(basis->steps);
    *basis = (aur_basis){0};
}
