/* All pairs of points j, j + k have the azimuth difference 2 pi k / Phi. Their distances are a smooth
 * function of j except for square roots at the poles, and are summed as its samples: one by one near the
 * poles, else by the Euler-Maclaurin formula with Gauss-Legendre panels that double their length away from
 * the poles.
 *
 * With z_j = 1 - (2j+1)/M, t = j + 1/2, A = t (M-t-k) and B = (t+k) (M-t), the distance is
 *     (2/M) sqrt((kM / (sqrt A + sqrt B))^2 + 4 sin^2(pi k / Phi) sqrt(A B)). */
#include "points/quality/sphere/fibonacci_sum.h"

#include <math.h>
#include <stdlib.h>

#include "points/base/gauss.h"
#include "points/base/vector.h"
#include "points/sphere/phase.h"

enum {
    NODES = 12,  /* of a panel */
    DIRECT = 16, /* samples next to a pole that are added one by one */
    WHOLE = 64,  /* lags with fewer samples are added one by one */
    ORDER = 8,   /* Taylor coefficients 0..7 */
    LANES = 8,   /* of the sums, so that their order does not depend on registers */
    LAGS_PER_ITEM = 256
};

typedef struct lag {
    double k, points;   /* M */
    double sine_square; /* 4 sin^2 of half the difference of azimuths */
} lag;

typedef struct rule {
    double nodes[NODES], weights[NODES]; /* on [0,1] */
} rule;

static inline double half_distance(const lag *l, double t) {
    const double first = sqrt(t * (l->points - t - l->k));
    const double second = sqrt((t + l->k) * (l->points - t));
    const double along = l->k * l->points / (first + second);
    return sqrt(along * along + l->sine_square * (first * second));
}

/* Truncated power series. */
static void series_root(const double a[ORDER], double root[ORDER]) {
    root[0] = sqrt(a[0]);
    for (int n = 1; n < ORDER; ++n) {
        double rest = a[n];
        for (int m = 1; m < n; ++m)
            rest -= root[m] * root[n - m];
        root[n] = rest / (2.0 * root[0]);
    }
}

static void series_product(const double a[ORDER], const double b[ORDER], double product[ORDER]) {
    for (int n = 0; n < ORDER; ++n) {
        product[n] = 0.0;
        for (int m = 0; m <= n; ++m)
            product[n] += a[m] * b[n - m];
    }
}

/* The Euler-Maclaurin terms of the midpoint rule at t: the sum over [t, ...) is the integral less this. */
static double end_correction(const lag *l, double t) {
    const double a[ORDER] = {t * (l->points - t - l->k), l->points - 2.0 * t - l->k, -1.0};
    const double b[ORDER] = {(t + l->k) * (l->points - t), l->points - 2.0 * t - l->k, -1.0};
    double first[ORDER], second[ORDER], difference[ORDER], square[ORDER], product[ORDER], distance[ORDER];
    series_root(a, first);
    series_root(b, second);
    for (int n = 0; n < ORDER; ++n)
        difference[n] = second[n] - first[n];
    difference[0] = l->k * l->points / (first[0] + second[0]);
    series_product(difference, difference, square);
    series_product(first, second, product);
    for (int n = 0; n < ORDER; ++n)
        square[n] += l->sine_square * product[n];
    series_root(square, distance);
    /* B_2p(1/2) / (2p)! times the derivatives of order 2p - 1. */
    return -1.0 / 24.0 * distance[1] + 7.0 / 960.0 * distance[3] - 31.0 / 8064.0 * distance[5] +
           127.0 / 30720.0 * distance[7];
}

static double direct_sum(const lag *l, size_t count) {
    double sum = 0.0;
    for (size_t j = 0; j < count; ++j)
        sum += half_distance(l, (double)j + 0.5);
    return sum;
}

/* The integral over [first, last] by panels [first 2^i, first 2^(i+1)]. */
static double graded_integral(const lag *l, const rule *gauss, double first, double last) {
    double nodes[64 * NODES], weights[64 * NODES];
    size_t count = 0;
    for (double start = first; start < last; start *= 2.0) {
        const double length = fmin(start, last - start);
        for (int i = 0; i < NODES; ++i) {
            nodes[count] = start + length * gauss->nodes[i];
            weights[count++] = length * gauss->weights[i];
        }
    }
    for (; count % LANES != 0; ++count) {
        nodes[count] = first;
        weights[count] = 0.0;
    }
    for (size_t i = 0; i < count; ++i)
        nodes[i] = weights[i] * half_distance(l, nodes[i]);
    double lanes[LANES] = {0};
    for (size_t i = 0; i < count; i += LANES)
        for (size_t j = 0; j < LANES; ++j)
            lanes[j] += nodes[i + j];
    double sum = 0.0;
    for (int i = 0; i < LANES; ++i)
        sum += lanes[i];
    return sum;
}

/* Half the sum of the lag's distances, in units of 1/M. */
static double lag_sum(const lag *l, const rule *gauss, size_t samples, aur_domain domain) {
    if (samples < WHOLE)
        return direct_sum(l, samples);
    const double near_pole = direct_sum(l, DIRECT);
    const double start = end_correction(l, DIRECT);
    if (domain == AUR_DOMAIN_SPHERE) /* the other half is the mirror image */
        return 2.0 * (near_pole + graded_integral(l, gauss, DIRECT, 0.5 * (double)samples) - start);
    const double end = (double)samples;
    return near_pole + graded_integral(l, gauss, DIRECT, end) - start + end_correction(l, end);
}

typedef struct lags {
    size_t count;
    aur_domain domain;
    rule gauss;
    aur_twofold *sums;
} lags;

static aur_result sum_lags(void *context, size_t index) {
    const lags *const work = context;
    const double points = (work->domain == AUR_DOMAIN_SPHERE ? 1.0 : 2.0) * (double)work->count;
    aur_twofold total = {0.0, 0.0};
    for (size_t i = 0; i < LAGS_PER_ITEM; ++i) {
        const size_t k = index * LAGS_PER_ITEM + i + 1;
        if (k >= work->count)
            break;
        const double turn = (double)(int64_t)((uint64_t)k * AUR_GOLDEN_PHASE) * 0x1p-64;
        const double sine = sin(AUR_PI * turn);
        const lag l = {(double)k, points, 4.0 * sine * sine};
        const double sum = lag_sum(&l, &work->gauss, work->count - k, work->domain);
        total = aur_twofold_add(total, (aur_twofold){sum, 0.0});
    }
    work->sums[index] = total;
    return AUR_OK;
}

aur_result aur_fibonacci_distance_sum(size_t count, aur_domain domain, const aur_measure_options *options,
                                      aur_twofold *sum, aur_error *error) {
    const size_t items = (count + LAGS_PER_ITEM - 1) / LAGS_PER_ITEM;
    lags work = {.count = count, .domain = domain, .sums = malloc(items * sizeof *work.sums)};
    if (work.sums == NULL)
        return aur_fail_memory(error);
    aur_gauss_legendre(NODES, work.gauss.nodes, work.gauss.weights);
    for (int i = 0; i < NODES; ++i) {
        work.gauss.nodes[i] = 0.5 * (1.0 + work.gauss.nodes[i]);
        work.gauss.weights[i] *= 0.5;
    }
    /* Rounding of the weights would affect the whole sum. */
    aur_twofold sum_of_weights = {-1.0, 0.0};
    for (int i = 0; i < NODES; ++i)
        sum_of_weights = aur_twofold_add(sum_of_weights, (aur_twofold){work.gauss.weights[i], 0.0});
    work.gauss.weights[NODES / 2] -= sum_of_weights.high;
    const aur_result result = aur_measure_items(
        options, "summing lags", items, sum_lags, &work,
        (aur_parallel_slice){work.sums, sizeof *work.sums, items * sizeof *work.sums}, error);
    *sum = (aur_twofold){0.0, 0.0};
    for (size_t i = 0; i < items && result == AUR_OK; ++i)
        *sum = aur_twofold_add(*sum, work.sums[i]);
    free(work.sums);
    const double points = (domain == AUR_DOMAIN_SPHERE ? 1.0 : 2.0) * (double)count;
    *sum = aur_twofold_multiply(*sum, aur_twofold_ratio(2.0, points));
    return result;
}

int aur_is_spherical_fibonacci(const aur_points_view *points) {
    static const double tolerance = 4e-15;
    if (points->dimension != 3 || points->weights != NULL || points->count == 0)
        return 0;
    const size_t count = points->count;
    const double size = (points->domain == AUR_DOMAIN_SPHERE ? 1.0 : 2.0) * (double)count;
    /* The rotation, from the point farthest from the axis. */
    const size_t widest = points->domain == AUR_DOMAIN_SPHERE ? count / 2 : count - 1;
    const double *const wide = points->coordinates + 3 * widest;
    const double shift =
        atan2(wide[1], wide[0]) - 2.0 * AUR_PI * 0x1p-64 * (double)((uint64_t)widest * AUR_GOLDEN_PHASE);
    const double cosine = cos(shift), sine = sin(shift);
    for (size_t j = 0; j < count; ++j) {
        const double *const x = points->coordinates + 3 * j;
        const double below = (2.0 * (double)j + 1.0) / size;
        if (!(fabs(x[2] - (1.0 - below)) <= tolerance))
            return 0;
        const double radius = sqrt(below * (2.0 - below));
        const double phi = 2.0 * AUR_PI * 0x1p-64 * (double)((uint64_t)j * AUR_GOLDEN_PHASE);
        const double along = radius * cos(phi), across = radius * sin(phi);
        /* The error of a radius from a rounded z is that of z divided by the radius. */
        const double slack = tolerance + 0x1p-52 / radius;
        if (!(fabs(x[0] - (cosine * along - sine * across)) <= slack &&
              fabs(x[1] - (sine * along + cosine * across)) <= slack))
            return 0;
    }
    return 1;
}

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
