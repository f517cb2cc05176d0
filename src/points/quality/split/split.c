#include "points/quality/split/split.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "points/base/gauss.h"
#include "points/quadrature/exact/fast.h"

aur_result aur_powers_find(const aur_points_view *points, size_t degree, size_t threads, double *powers,
                           aur_error *error) {
    const size_t count = points->count, size = aur_coefficient_count(degree);
    double *const storage = malloc((5 * count + size) * sizeof *storage);
    aur_basis basis;
    aur_fast_transform *fast = NULL;
    aur_result result =
        storage != NULL ? aur_basis_create(degree, -1.0, 0.0, &basis, error) : aur_fail_memory(error);
    if (result != AUR_OK) {
        free(storage);
        return result;
    }
    const aur_polar_points polar = aur_polar_points_make(count, points->coordinates, storage);
    double *const weights = storage + 4 * count, *const sums = weights + count;
    for (size_t i = 0; i < count; ++i)
        weights[i] = aur_weight_at(points, i);
    result = aur_fast_transform_create(&basis, &polar, threads, (aur_progress){0}, &fast, error);
    if (result == AUR_OK)
        result = aur_fast_transform_analyse(fast, weights, sums, error);
    for (size_t l = 1; l <= degree && result == AUR_OK; ++l) {
        double square = 0.0;
        for (size_t m = 0; m <= l; ++m) {
            const double *const pair = sums + 2 * (aur_basis_at(degree, m) + l - m);
            square += pair[0] * pair[0] + pair[1] * pair[1];
        }
        powers[l] = square / (2.0 * (double)l + 1.0);
    }
    aur_fast_transform_destroy(fast);
    aur_basis_release(&basis);
    free(storage);
    return result;
}

/* Degrees that fill the grids of the transform. */
static const size_t degrees[] = {20, 42, 84, 120, 170, 240, 340, 480, 682, 960, 1364};
enum {
    DEGREES = sizeof degrees / sizeof degrees[0],
    SAMPLES = 64, /* points whose neighbours are counted to estimate the cost */
    PAIR = 16,    /* the cost of a near pair, where the transform's is the cube of the degree */
    POINT = 2000, /* the cost of a point in the transform */
    NODES = 256,  /* of integrals over the rest of the kernel */
    STEEPEST = 8  /* the power that smooths them at 0 */
};

/* The parameters of a split, and the choice that follows from them. */
typedef struct plan {
    double exponent;
    aur_split_kernel kernel;
    size_t degree;        /* L */
    double *coefficients; /* of F, degrees 0 .. 3 L / 2, for Legendre polynomials */
    double mean_of_rest;  /* of k - F over the sphere, S < 2 */
    double beyond;        /* the sum of the |coefficients| beyond L */
} plan;

/* --- the coefficients of the smooth part */

/* Adds factor * P_l(t) to sums[l], 0 <= l < count. */
static void add_legendre(double t, double factor, size_t count, double *sums) {
    double before = 0.0, here = 1.0;
    for (size_t l = 0; l < count; ++l) {
        sums[l] += factor * here;
        const double n = (double)l;
        const double next = ((2.0 * n + 1.0) * t * here - n * before) / (n + 1.0);
        before = here;
        here = next;
    }
}

/* (2l+1)/2 times the integral of (2-2t)^{-S/2} P_l(t) over -1 < t < 1, and of the logarithm likewise: a
 * recurrence in l (Baker, Erdelyi; for S = -1 Marques 2013 eq. 5). */
static double whole_coefficient(double exponent, size_t degree, double before) {
    const double l = (double)degree, s = 0.5 * exponent;
    if (exponent == 0.0)
        return degree == 0 ? 0.5 - log(2.0) : (l + 0.5) / (l * (l + 1.0));
    if (degree == 0)
        return pow(2.0, 1.0 - exponent) / (2.0 - exponent);
    return before * (2.0 * l + 1.0) / (2.0 * l - 1.0) * (l - 1.0 + s) / (l + 1.0 - s);
}

/* For S <= 1 the coefficients of F are those of k less those of the rest, which is small: the error of the
 * difference is the rounding of the former. In d = reach u^8 with dt = -d dd the integrand is smooth at 0. */
static void coefficients_of_difference(plan *p, size_t count) {
    double nodes[NODES], weights[NODES];
    aur_gauss_legendre(NODES, nodes, weights);
    for (size_t i = 0; i < NODES; ++i) {
        const double u = 0.5 * (1.0 + nodes[i]), d = p->kernel.reach * pow(u, STEEPEST);
        const double slope = STEEPEST * d / u;
        const double rest = aur_split_whole(p->exponent, d * d) - aur_split_smooth(&p->kernel, d * d);
        add_legendre(1.0 - 0.5 * d * d, 0.5 * weights[i] * slope * d * rest, count, p->coefficients);
    }
    p->mean_of_rest = 0.5 * p->coefficients[0];
    double whole = 0.0;
    for (size_t l = 0; l < count; ++l) {
        whole = whole_coefficient(p->exponent, l, whole);
        p->coefficients[l] = whole - ((double)l + 0.5) * p->coefficients[l];
    }
}

/* For larger S from F itself. */
static bool coefficients_of_smooth(plan *p, size_t count) {
    const size_t nodes = p->degree + p->degree / 2 + 32;
    double *const t = malloc(2 * nodes * sizeof *t), *const weights = t + nodes;
    if (t == NULL)
        return false;
    aur_gauss_legendre(nodes, t, weights);
    for (size_t i = 0; i < nodes; ++i)
        add_legendre(t[i], weights[i] * aur_split_smooth(&p->kernel, 2.0 - 2.0 * t[i]), count,
                     p->coefficients);
    for (size_t l = 0; l < count; ++l)
        p->coefficients[l] *= (double)l + 0.5;
    p->mean_of_rest = p->exponent < 2.0 ? whole_coefficient(p->exponent, 0, 0.0) - p->coefficients[0] : 0.0;
    free(t);
    return true;
}

/* Beyond 3/2 L coefficients are squares of those at L, and are neglected. */
static bool fill_coefficients(plan *p) {
    const size_t count = p->degree + p->degree / 2 + 1;
    for (size_t l = 0; l < count; ++l)
        p->coefficients[l] = 0.0;
    if (p->exponent <= 1.0)
        coefficients_of_difference(p, count);
    else if (!coefficients_of_smooth(p, count))
        return false;
    p->beyond = 0.0;
    for (size_t l = p->degree + 1; l < count; ++l)
        p->beyond += fabs(p->coefficients[l]);
    return true;
}

/* --- the choice of a degree */

/* counts[k]: points within the reach of degree k of one of SAMPLES points, on average. */
static void count_near(const aur_points_view *points, double range, double counts[DEGREES]) {
    for (size_t k = 0; k < DEGREES; ++k)
        counts[k] = 0.0;
    for (size_t s = 0; s < SAMPLES; ++s) {
        const double *const x = points->coordinates + 3 * (points->count * s / SAMPLES);
        for (size_t i = 0; i < points->count; ++i) {
            const double *const y = points->coordinates + 3 * i;
            const double dx = x[0] - y[0], dy = x[1] - y[1], dz = x[2] - y[2];
            const double square = dx * dx + dy * dy + dz * dz;
            for (size_t k = 0;
                 k < DEGREES && square * (double)(degrees[k] * degrees[k]) < 4.0 * range * range; ++k)
                counts[k] += 1.0 / SAMPLES;
        }
    }
}

/* The cheapest degree; false where the sum over all pairs is cheaper. */
static bool choose_degree(const aur_points_view *points, double pair_cost, double range, size_t *degree) {
    double counts[DEGREES];
    count_near(points, range, counts);
    const double count = (double)points->count;
    double least = 0.5 * count * count * pair_cost;
    bool found = false;
    for (size_t k = 0; k < DEGREES; ++k) {
        const double l = (double)degrees[k];
        const double cost = l * l * l + POINT * count + 0.5 * PAIR * count * counts[k];
        if (cost < least && range < l) {
            least = cost;
            *degree = degrees[k];
            found = true;
        }
    }
    return found;
}

/* The split whose two truncation errors are below the tolerance. With a reach of 2 range / L the smooth
 * part's harmonics fall like the remainder, e^-range. */
static aur_result make_plan(const aur_measure_request *request, double exponent, double pair_cost,
                            double tolerance, plan *p, bool *found, aur_error *error) {
    static const double widest = 44.0;
    *p = (plan){.exponent = exponent};
    double range = fmin(fmax(-log(tolerance), 6.0), widest);
    *found = choose_degree(request->points, pair_cost, range, &p->degree);
    if (!*found)
        return AUR_OK;
    p->coefficients =
        aur_arena_allocate(request->arena, (p->degree + p->degree / 2 + 1) * sizeof *p->coefficients);
    if (p->coefficients == NULL)
        return aur_fail_memory(error);
    for (;; range = fmin(range + 1.0, widest)) {
        p->kernel = aur_split_kernel_make(exponent, 2.0 * range / (double)p->degree, range);
        if (!fill_coefficients(p))
            return aur_fail_memory(error);
        if (range >= widest || fmax(p->beyond, p->kernel.rest) <= 0.25 * tolerance)
            return AUR_OK;
    }
}

/* --- the sums */

typedef struct masses {
    double sum, absolute, squares;
} masses;

static masses masses_of(const aur_points_view *points) {
    masses m = {0};
    for (size_t i = 0; i < points->count; ++i) {
        const double weight = aur_weight_at(points, i);
        m.sum += weight;
        m.absolute += fabs(weight);
        m.squares += weight * weight;
    }
    return m;
}

aur_result aur_split_pairs(const aur_measure_request *request, double exponent, double pair_cost,
                           double tolerance, bool *found, aur_split_mean *mean, aur_error *error) {
    plan p;
    const masses m = masses_of(request->points);
    const double spread = m.absolute * m.absolute / (m.sum * m.sum);
    aur_result result = make_plan(request, exponent, pair_cost, tolerance / spread, &p, found, error);
    if (result != AUR_OK || !*found)
        return result;
    aur_near_points near;
    double rest = 0.0;
    double *const powers = aur_arena_allocate(request->arena, (p.degree + 1) * sizeof *powers);
    if (powers == NULL)
        return aur_fail_memory(error);
    result = aur_powers_find(request->points, p.degree, request->options.threads, powers, error);
    if (result == AUR_OK)
        result = aur_near_points_create(request->points, p.kernel.reach, request->arena, &near, error);
    if (result == AUR_OK)
        result = aur_near_sum(&near, &p.kernel, request, &rest, error);
    if (result != AUR_OK)
        return result;
    double smooth = 0.0, largest = 0.0;
    for (size_t l = 1; l <= p.degree; ++l) {
        smooth += p.coefficients[l] * (powers[l] / (m.sum * m.sum));
        largest += fabs(p.coefficients[l]);
    }
    const double self_term = aur_split_smooth(&p.kernel, 0.0) * m.squares / (m.sum * m.sum);
    rest *= 2.0 / (m.sum * m.sum);
    *mean = (aur_split_mean){.mean = exponent < 2.0 ? whole_coefficient(exponent, 0, 0.0) : 0.0};
    mean->excess = smooth - self_term + rest - p.mean_of_rest + (exponent < 2.0 ? 0.0 : p.coefficients[0]);
    /* The error bound: truncation, the transform by Cauchy's inequality, and rounding. */
    const double error_of_sums = AUR_WINDOW_ERROR * sqrt(spread);
    mean->bound = spread * (p.beyond + p.kernel.rest) +
                  error_of_sums * (2.0 * sqrt(fabs(smooth) * largest) + error_of_sums * largest) +
                  4.0 * DBL_EPSILON * (fabs(smooth) + fabs(self_term) + fabs(rest) + fabs(p.mean_of_rest));
    return AUR_OK;
}
