/* Legendre series of the kernel and of cos^m; see docs/papers/marques-2018.md for the derivation. */
#include "points/quadrature/potential/potential.h"

#include <aureole/quadrature.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/vector.h"
#include "points/quadrature/check.h"
#include "points/quadrature/kernel.h"

enum { LANES = 16, MOST_TERMS = 20000 };

/* Terms decay as l^-(m+2s+1), beginning where the lobe is resolved (l about sqrt m). */
size_t aur_zonal_terms(double exponent, double smoothness) {
    const double resolve = 64.0 + 7.0 * sqrt(exponent);
    const double tail = pow(1e14, 1.0 / (exponent + 2.0 * smoothness));
    return (size_t)fmin(MOST_TERMS, resolve + tail);
}

/* moments[l] = (m+1) integral over [0,1] of x^m P_l(x). */
static void lobe_moments(double exponent, size_t count, double *moments) {
    moments[0] = 1.0;
    if (count > 1)
        moments[1] = (exponent + 1.0) / (exponent + 2.0);
    for (size_t l = 0; l + 2 < count; ++l)
        moments[l + 2] = moments[l] * (exponent - (double)l) / (exponent + (double)l + 3.0);
}

/* terms[l] = k_l mu_l. Needs 2 * count elements. */
static void series_terms(double exponent, double smoothness, size_t count, double *terms, double *moments) {
    aur_kernel_coefficients(smoothness, count, terms);
    lobe_moments(exponent, count, moments);
    for (size_t l = 0; l < count; ++l)
        terms[l] *= moments[l];
}

/* Clenshaw's recurrence for Legendre polynomials, LANES arguments at a time. */
static void legendre_sum(size_t term_count, const double *terms, size_t count, const double *x, double *z) {
    for (size_t first = 0; first < count; first += LANES) {
        const size_t size = count - first < LANES ? count - first : LANES;
        double argument[LANES] = {0}, later[LANES] = {0}, next[LANES] = {0};
        memcpy(argument, x + first, size * sizeof *x);
        for (size_t l = term_count; l-- > 0;) {
            const double degree = (double)l;
            const double alpha = (2.0 * degree + 1.0) / (degree + 1.0);
            const double beta = (degree + 1.0) / (degree + 2.0);
            const double term = terms[l];
            for (size_t i = 0; i < LANES; ++i) {
                const double value = term + alpha * argument[i] * next[i] - beta * later[i];
                later[i] = next[i];
                next[i] = value;
            }
        }
        memcpy(z + first, next, size * sizeof *z);
    }
}

/* Chebyshev coefficients of a function known at the `count` roots cos(pi (i + 1/2) / count). */
static void chebyshev_coefficients(size_t count, const double *values, double *cosines,
                                   double *coefficients) {
    for (size_t i = 0; i < 4 * count; ++i)
        cosines[i] = cos(AUR_PI * (double)i / (2.0 * (double)count));
    for (size_t k = 0; k < count; ++k) {
        double sum = 0.0;
        for (size_t i = 0; i < count; ++i)
            sum += values[i] * cosines[k * (2 * i + 1) % (4 * count)];
        coefficients[k] = (k == 0 ? 1.0 : 2.0) / (double)count * sum;
    }
}

/* The number of coefficients relevant at double precision. */
static size_t significant(size_t count, const double *coefficients) {
    double largest = 0.0;
    for (size_t k = 0; k < count; ++k)
        largest = fmax(largest, fabs(coefficients[k]));
    while (count > 1 && fabs(coefficients[count - 1]) < 1e-15 * largest)
        --count;
    return count;
}

aur_result aur_zonal_create(double exponent, double smoothness, aur_zonal *zonal, aur_error *error) {
    *zonal = (aur_zonal){0};
    const size_t terms = aur_zonal_terms(exponent, smoothness);
    /* Where the lobe ends z has a term |x|^{m+2s}: coefficients decay slowly for small m. */
    const size_t nodes = 64 + (size_t)(8.0 * sqrt(exponent) + 128.0 / (1.0 + exponent));
    double *const storage = malloc((2 * terms + 6 * nodes) * sizeof *storage);
    double *const coefficients = malloc(2 * nodes * sizeof *coefficients);
    if (storage == NULL || coefficients == NULL) {
        free(storage);
        free(coefficients);
        return aur_fail_memory(error);
    }
    double *const series = storage;
    double *const moments = storage + terms;
    double *const x = storage + 2 * terms;
    double *const values = x + nodes;
    double *const cosines = values + nodes;
    series_terms(exponent, smoothness, terms, series, moments);
    for (size_t l = terms; l-- > 0;)
        zonal->self_energy += series[l] * moments[l];
    for (size_t side = 0; side < 2; ++side) {
        const double sign = side == 0 ? 0.5 : -0.5;
        for (size_t i = 0; i < nodes; ++i)
            x[i] = sign * (1.0 + cos(AUR_PI * ((double)i + 0.5) / (double)nodes));
        legendre_sum(terms, series, nodes, x, values);
        zonal->coefficients[side] = coefficients + side * nodes;
        chebyshev_coefficients(nodes, values, cosines, zonal->coefficients[side]);
        zonal->count[side] = significant(nodes, zonal->coefficients[side]);
    }
    free(storage);
    return AUR_OK;
}

void aur_zonal_release(aur_zonal *zonal) {
    free(zonal->coefficients[0]);
    *zonal = (aur_zonal){0};
}

static void chebyshev_sum(size_t term_count, const double *terms, const double *t, double *z) {
    double twice[LANES], later[LANES] = {0}, next[LANES] = {0};
    for (size_t i = 0; i < LANES; ++i)
        twice[i] = 2.0 * t[i];
    for (size_t k = term_count; k-- > 1;) {
        const double term = terms[k];
        for (size_t i = 0; i < LANES; ++i) {
            const double value = term + twice[i] * next[i] - later[i];
            later[i] = next[i];
            next[i] = value;
        }
    }
    for (size_t i = 0; i < LANES; ++i)
        z[i] = terms[0] + t[i] * next[i] - later[i];
}

void aur_zonal_evaluate(const aur_zonal *zonal, size_t count, const double *x, double *z) {
    for (size_t side = 0; side < 2; ++side) {
        size_t at[LANES];
        double t[LANES] = {0}, value[LANES];
        size_t used = 0;
        for (size_t i = 0; i < count; ++i) {
            if ((x[i] < 0.0) == (side == 1)) {
                const double distance = fabs(x[i]);
                at[used] = i;
                t[used++] = 2.0 * (distance > 1.0 ? 1.0 : distance) - 1.0; /* NaN stays NaN */
            }
            if (used == LANES || (i + 1 == count && used > 0)) {
                chebyshev_sum(zonal->count[side], zonal->coefficients[side], t, value);
                while (used > 0) {
                    --used;
                    z[at[used]] = value[used];
                }
            }
        }
    }
}

aur_result aur_cross_energy(double exponent, double other_exponent, double cosine, double smoothness,
                            double *energy, aur_error *error) {
    aur_result result = aur_check_exponent(exponent, error);
    if (result == AUR_OK)
        result = aur_check_exponent(other_exponent, error);
    if (result == AUR_OK)
        result = aur_check_smoothness(smoothness, error);
    if (result == AUR_OK && !(fabs(cosine) <= 1.0))
        result = aur_fail(error, AUR_ERROR_ARGUMENT, "a cosine must be between -1 and 1, not %g", cosine);
    if (result != AUR_OK)
        return result;
    /* The product of the moments decays as l^-(m+m'+3), so one lobe's count is sufficient. */
    const size_t terms = aur_zonal_terms(fmax(exponent, other_exponent), smoothness);
    double *const storage = malloc(3 * terms * sizeof *storage);
    if (storage == NULL)
        return aur_fail_memory(error);
    series_terms(exponent, smoothness, terms, storage, storage + terms);
    lobe_moments(other_exponent, terms, storage + terms);
    for (size_t l = 0; l < terms; ++l)
        storage[l] *= storage[terms + l];
    legendre_sum(terms, storage, 1, &cosine, energy);
    free(storage);
    return AUR_OK;
}
