/* Weights that are exact to a degree. References: closed moments of monomials, a harmonic from its formula,
 * designs of known degree, and the golden values of spherical Fibonacci sets. */
#include <aureole/exact.h>
#include <aureole/quality.h>
#include <stdlib.h>
#include <string.h>

#include "exact_points.h"
#include "points/base/simd.h"
#include "points/base/vector.h"
#include "points/quadrature/exact/fast.h"
#include "points/quadrature/exact/system.h"

/* The mean of x^a y^b z^c over the density (m+1) z^m on the cap z >= low, where m = 0 unless low = 0. */
static double moment(int a, int b, int c, double low, double m) {
    if (a % 2 != 0 || b % 2 != 0)
        return 0.0;
    /* The mean of cos^a sin^b of the azimuth by 64 equal steps, exact below degree 64. */
    double mean = 0.0, sum = 0.0, mass = 0.0;
    for (int k = 0; k < 64; ++k)
        mean += pow(cos(2.0 * AUR_PI * k / 64.0), a) * pow(sin(2.0 * AUR_PI * k / 64.0), b) / 64.0;
    /* (1-z^2)^{(a+b)/2} z^{c+m}, term by term. */
    const int half = (a + b) / 2;
    double binomial = 1.0;
    for (int j = 0; j <= half; ++j) {
        const double power = c + m + 2.0 * j + 1.0;
        const double term = (1.0 - (low != 0.0 ? pow(low, power) : 0.0)) / power;
        sum += (j % 2 != 0 ? -1.0 : 1.0) * binomial * term;
        binomial *= (double)(half - j) / (j + 1.0);
    }
    mass = (1.0 - (low != 0.0 ? pow(low, m + 1.0) : 0.0)) / (m + 1.0);
    return mean * sum / mass;
}

/* The largest error among all monomials to the degree. */
static double worst_monomial(size_t count, const double *xyz, const double *weights, int degree, double low,
                             double m) {
    double worst = 0.0;
    for (int a = 0; a <= degree; ++a)
        for (int b = 0; a + b <= degree; ++b)
            for (int c = 0; a + b + c <= degree; ++c) {
                double sum = 0.0;
                for (size_t i = 0; i < count; ++i)
                    sum += weights[i] * pow(xyz[3 * i], a) * pow(xyz[3 * i + 1], b) * pow(xyz[3 * i + 2], c);
                worst = fmax(worst, fabs(sum - moment(a, b, c, low, m)));
            }
    return worst;
}

/* The figures that were found before this was written, by an independent program. */
static void golden(void **state) {
    (void)state;
    enum { N = 1000 };
    double *const xyz = points_of("spherical-fibonacci", N, AUR_DOMAIN_SPHERE, 0.0, 0.0), weights[N];
    aur_exact_options options = {.size = sizeof options};
    aur_exact_options_init(AUR_DOMAIN_SPHERE, &options, NULL);
    aur_exact_report report;
    aur_error error;
    assert_int_equal(aur_weights_exact(N, xyz, &options, N, weights, &report, &error), AUR_OK);
    assert_int_equal(report.degree, 30);
    assert_true(report.residual <= 1.5e-15);
    assert_near(report.least, 0.869413059, 1e-6);
    assert_near(report.largest, 1.138763250, 1e-6);
    free(xyz);
}

/* On every domain, against closed moments of all monomials: those are at most 1, so the rounding of N terms
 * of mean 1/N is some 1e-15. */
static void monomials(void **state) {
    (void)state;
    const struct {
        aur_domain domain;
        double cap, exponent;
        size_t degree;
    } cases[] = {{AUR_DOMAIN_SPHERE, 0.0, 0.0, 12},     {AUR_DOMAIN_HEMISPHERE, 0.0, 0.0, 8},
                 {AUR_DOMAIN_HEMISPHERE, 0.0, 1.0, 6},  {AUR_DOMAIN_HEMISPHERE, 0.0, 2.5, 4},
                 {AUR_DOMAIN_HEMISPHERE, 40.0, 0.0, 6}, {AUR_DOMAIN_SPHERE, 130.0, 0.0, 8},
                 {AUR_DOMAIN_HEMISPHERE, 0.0, 20.0, 3}};
    enum { N = 400 };
    double weights[N];
    aur_error error;
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; ++k) {
        double *const xyz =
            points_of("spherical-fibonacci", N, cases[k].domain, cases[k].exponent, cases[k].cap);
        aur_exact_options options = {.size = sizeof options};
        aur_exact_options_init(cases[k].domain, &options, NULL);
        options.cap_degrees = cases[k].cap;
        options.lobe.exponent = cases[k].exponent;
        options.degree = cases[k].degree;
        assert_int_equal(aur_weights_exact(N, xyz, &options, N, weights, NULL, &error), AUR_OK);
        const double low = cases[k].cap > 0.0                     ? cos(cases[k].cap / 180.0 * AUR_PI)
                           : cases[k].domain == AUR_DOMAIN_SPHERE ? -1.0
                                                                  : 0.0;
        assert_near(worst_monomial(N, xyz, weights, (int)cases[k].degree, low, cases[k].exponent), 0.0,
                    1e-13);
        free(xyz);
    }
}

/* Designs of known degree, with fewer points than harmonics: the vertices of the octahedron have degree 3, of
 * the cube 3, of the icosahedron 5, each with equal weights; the octahedron with the cube has 5 (the Lebedev
 * rule of 14 points, weights 1/15 and 3/40). */
static void designs(void **state) {
    (void)state;
    double xyz[3 * 14] = {1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1}, weights[14];
    for (size_t i = 0; i < 24; ++i)
        xyz[18 + i] = ((i / 3) >> (i % 3) & 1 ? 1.0 : -1.0) / sqrt(3.0);
    const double golden_ratio = 0.5 * (1.0 + sqrt(5.0)), length = sqrt(1.0 + golden_ratio * golden_ratio);
    double icosahedron[36];
    for (size_t i = 0; i < 12; ++i) {
        const double one = (i & 1 ? 1.0 : -1.0) / length,
                     two = (i & 2 ? golden_ratio : -golden_ratio) / length;
        icosahedron[3 * i + i / 4] = 0.0;
        icosahedron[3 * i + (i / 4 + 1) % 3] = one;
        icosahedron[3 * i + (i / 4 + 2) % 3] = two;
    }
    aur_exact_options options = {.size = sizeof options};
    aur_exact_options_init(AUR_DOMAIN_SPHERE, &options, NULL);
    aur_exact_report report;
    aur_error error;
    assert_int_equal(aur_weights_exact(6, xyz, &options, 14, weights, &report, &error), AUR_OK);
    assert_int_equal(report.degree, 3);
    assert_int_equal(aur_weights_exact(8, xyz + 18, &options, 14, weights, &report, &error), AUR_OK);
    assert_int_equal(report.degree, 3);
    assert_int_equal(aur_weights_exact(12, icosahedron, &options, 14, weights, &report, &error), AUR_OK);
    assert_int_equal(report.degree, 5);
    assert_int_equal(aur_weights_exact(14, xyz, &options, 14, weights, &report, &error), AUR_OK);
    assert_int_equal(report.degree, 5);
    assert_near(weights[0], 1.0 / 15.0, 1e-15);
    assert_near(weights[13], 3.0 / 40.0, 1e-15);
}

/* More points than the factorisation takes, and a degree with its neighbours. */
static void many_points(void **state) {
    (void)state;
    enum { N = 2600 };
    double *const xyz = points_of("spherical-fibonacci", N, AUR_DOMAIN_SPHERE, 0.0, 0.0);
    double *const weights = malloc(2 * N * sizeof *weights);
    aur_exact_options options = {.size = sizeof options};
    aur_exact_options_init(AUR_DOMAIN_SPHERE, &options, NULL);
    options.degree = 40;
    aur_exact_report report;
    aur_error error;
    for (size_t threads = 1; threads <= 3; threads += 2) {
        options.threads = threads;
        assert_int_equal(
            aur_weights_exact(N, xyz, &options, N, weights + (threads > 1 ? N : 0), &report, &error), AUR_OK);
        assert_true(report.residual < 1e-14 && report.iterations > 0 && report.least > 0.85);
    }
    assert_memory_equal(weights, weights + N, N * sizeof *weights);
    free(weights);
    free(xyz);
}

/* The guaranteed tolerance, checked by the plain transform: the solver uses the fast one. */
static void tolerances(void **state) {
    (void)state;
    enum { N = 5000, DEGREE = 60 };
    double *const xyz = points_of("spherical-fibonacci", N, AUR_DOMAIN_SPHERE, 0.0, 0.0);
    double *const weights = malloc(5 * N * sizeof *weights);
    const size_t size = aur_coefficient_count(DEGREE);
    double *const sums = malloc((size + AUR_TRANSFORM_BANDS * aur_transform_room(DEGREE)) * sizeof *sums);
    const aur_polar_points points = aur_polar_points_make(N, xyz, weights + N);
    aur_exact_options options = {.size = sizeof options};
    aur_exact_options_init(AUR_DOMAIN_SPHERE, &options, NULL);
    options.degree = DEGREE;
    aur_exact_report report;
    aur_error error;
    aur_basis basis;
    assert_int_equal(aur_basis_create(DEGREE, -1.0, 0.0, &basis, &error), AUR_OK);
    const aur_transform transform = {.basis = &basis, .points = &points, .threads = 1, .sums = sums + size};
    size_t steps = 0;
    for (double tolerance = 1e-3; tolerance > 1e-15; tolerance *= 1e-3) {
        options.tolerance = tolerance;
        assert_int_equal(aur_weights_exact(N, xyz, &options, N, weights, &report, &error), AUR_OK);
        assert_true(report.residual <= tolerance && report.iterations > steps);
        steps = report.iterations;
        assert_int_equal(aur_transform_analyse(&transform, weights, sums, &error), AUR_OK);
        double worst = fabs(sums[0] - 1.0);
        for (size_t j = 1; j < size; ++j)
            worst = fmax(worst, fabs(sums[j]));
        assert_near(worst, report.residual, 2e-15);
    }
    options.tolerance = 0.1;
    assert_int_equal(aur_weights_exact(N, xyz, &options, N, weights, &report, &error), AUR_ERROR_ARGUMENT);
    assert_non_null(strstr(error.message, "tolerance"));
    aur_basis_release(&basis);
    free(sums);
    free(weights);
    free(xyz);
}

/* Against the sums of the definition, at sizes of every kind. */
static void fourier(void **state) {
    (void)state;
    enum { MOST = 576 };
    static double turns[2 * MOST], re[MOST], im[MOST], work[2 * MOST];
    for (size_t least = 60; least <= MOST; least *= 2) {
        const size_t size = aur_fourier_size(least < 480 ? least : MOST);
        assert_true(size >= least && size % 64 == 0);
        aur_fourier_prepare(size, turns);
        for (size_t j = 0; j < size; ++j) {
            re[j] = sin(3.0 * (double)(j * j));
            im[j] = cos(5.0 * (double)j);
        }
        aur_fourier(size, turns, re, im, work);
        for (size_t k = 0; k < size; k += 7) {
            double sum[2] = {0.0, 0.0};
            for (size_t j = 0; j < size; ++j) {
                const double a = sin(3.0 * (double)(j * j)), b = cos(5.0 * (double)j);
                const double *const turn = turns + 2 * (j * k % size);
                sum[0] += a * turn[0] - b * turn[1];
                sum[1] += a * turn[1] + b * turn[0];
            }
            assert_near(re[k], sum[0], 1e-12);
            assert_near(im[k], sum[1], 1e-12);
        }
    }
}

static void bad_input(void **state) {
    (void)state;
    double xyz[15] = {0, 0, 1, 0, 0, -1, 0, 0, 1, 1, 0, 0, 0, 0, 1.1}, weights[5];
    aur_exact_options options = {.size = sizeof options};
    aur_exact_options_init(AUR_DOMAIN_SPHERE, &options, NULL);
    aur_exact_report report;
    aur_error error;
    assert_int_equal(aur_weights_exact(0, xyz, &options, 5, weights, NULL, &error), AUR_ERROR_ARGUMENT);
    assert_int_equal(aur_weights_exact(5, xyz, &options, 5, weights, NULL, &error), AUR_ERROR_ARGUMENT);
    assert_non_null(strstr(error.message, "point 5,"));
    assert_int_equal(aur_weights_exact(2, xyz, &options, 1, weights, NULL, &error), AUR_ERROR_CAPACITY);
    /* One point and two: degree 0; the two poles: degree 1. */
    assert_int_equal(aur_weights_exact(1, xyz, &options, 5, weights, &report, &error), AUR_OK);
    assert_true(report.degree == 0 && weights[0] == 1.0);
    assert_int_equal(aur_weights_exact(2, xyz, &options, 5, weights, &report, &error), AUR_OK);
    assert_int_equal(report.degree, 1);
    /* Duplicate points share a weight; given weights are unchanged. */
    assert_int_equal(aur_weights_exact(3, xyz, &options, 5, weights, &report, &error), AUR_OK);
    assert_true(report.degree == 1 && report.distinct_points == 2);
    assert_near(weights[0], 0.25, 1e-15);
    assert_near(weights[1], 0.5, 1e-15);
    options.near = (const double[]){0.0, 2.0, 2.0};
    assert_int_equal(aur_weights_exact(3, xyz, &options, 5, weights, &report, &error), AUR_OK);
    assert_true(weights[0] == 0.0 && report.distinct_points == 2);
    options.near = (const double[]){0.0, -2.0, 2.0};
    assert_int_equal(aur_weights_exact(3, xyz, &options, 5, weights, &report, &error), AUR_ERROR_ARGUMENT);
    options.near = (const double[]){0.0, 0.0, 0.0};
    assert_int_equal(aur_weights_exact(3, xyz, &options, 5, weights, &report, &error), AUR_ERROR_ARGUMENT);
    options.near = NULL;
    options.degree = 2;
    assert_int_equal(aur_weights_exact(4, xyz, &options, 5, weights, &report, &error), AUR_ERROR_ARGUMENT);
    assert_non_null(strstr(error.message, "degree 2"));
    options.degree = AUR_EXACT_DEGREE_MAX + 1;
    assert_int_equal(aur_weights_exact(4, xyz, &options, 5, weights, &report, &error), AUR_ERROR_ARGUMENT);
    options.size = sizeof(aur_exact_options);
    aur_exact_options_init(AUR_DOMAIN_HEMISPHERE, &options, NULL);
    assert_int_equal(aur_weights_exact(4, xyz, &options, 5, weights, &report, &error), AUR_ERROR_ARGUMENT);
    assert_non_null(strstr(error.message, "point 2 "));
    options.size = sizeof(aur_exact_options);
    aur_exact_options_init((aur_domain)9, &options, NULL);
    assert_int_equal(aur_weights_exact(1, xyz, &options, 5, weights, NULL, &error), AUR_ERROR_UNSUPPORTED);
    options.size = sizeof(aur_exact_options);
    aur_exact_options_init(AUR_DOMAIN_SPHERE, &options, NULL);
    options.lobe.exponent = 1.0;
    assert_int_equal(aur_weights_exact(1, xyz, &options, 5, weights, NULL, &error), AUR_ERROR_UNSUPPORTED);
    options.lobe.exponent = NAN;
    assert_int_equal(aur_weights_exact(1, xyz, &options, 5, weights, NULL, &error), AUR_ERROR_ARGUMENT);
    options.lobe.exponent = 0.0;
    options.cap_degrees = 181.0;
    assert_int_equal(aur_weights_exact(1, xyz, &options, 5, weights, NULL, &error), AUR_ERROR_ARGUMENT);
}

/* The largest error among the harmonics to a degree, whose mean square is 1, by the recurrence in the degree
 * of Holmes and Featherstone 2002, eq. 11. */
static double worst_harmonic(size_t count, const double *xyz, const double *weights, size_t degree) {
    double worst = 0.0;
    for (size_t m = 0; m <= degree; ++m) {
        double sums[2 * 64] = {0.0};
        assert_in_range(degree, 0, 63);
        for (size_t i = 0; i < count; ++i) {
            const double z = xyz[3 * i + 2], phi = atan2(xyz[3 * i + 1], xyz[3 * i]);
            double here = 1.0, before = 0.0;
            for (size_t k = 1; k <= m; ++k)
                here *= sqrt(1.0 - z * z) * (k == 1 ? sqrt(3.0) : sqrt(1.0 + 0.5 / (double)k));
            for (size_t l = m; l <= degree; ++l) {
                sums[2 * l] += weights[i] * here * cos((double)m * phi);
                sums[2 * l + 1] += weights[i] * here * sin((double)m * phi);
                const double n = (double)l + 1.0, q = n * n - (double)(m * m);
                const double next =
                    sqrt((4.0 * n * n - 1.0) / q) * z * here -
                    (l > m ? sqrt((2.0 * n + 1.0) * (q - 2.0 * n + 1.0) / (q * (2.0 * n - 3.0))) * before
                           : 0.0);
                before = here;
                here = next;
            }
        }
        for (size_t k = 2 * m; k < 2 * degree + 2; ++k)
            worst = fmax(worst, fabs(sums[k] - (m == 0 && k == 0 ? 1.0 : 0.0)));
    }
    return worst;
}

/* The residual that is reported is the one of the weights that are returned; that one is the largest error
 * among harmonics, which equal weights show far above rounding. Axes count once. */
static void reports(void **state) {
    (void)state;
    enum { N = 300, DEGREE = 24 };
    double *const xyz = points_of("spherical-fibonacci", N, AUR_DOMAIN_SPHERE, 0.0, 0.0), weights[N],
                  storage[4 * N];
    aur_exact_options options = {.size = sizeof options};
    aur_exact_options_init(AUR_DOMAIN_SPHERE, &options, NULL);
    aur_exact_report report;
    aur_exact_found found = {0};
    aur_error error;
    for (size_t i = 0; i < N; ++i)
        weights[i] = 1.0 / N;
    const aur_exact_system system = {.points = aur_polar_points_make(N, xyz, storage),
                                     .near = weights,
                                     .distinct_points = N,
                                     .lowest = -1.0};
    assert_int_equal(aur_exact_residual(&system, DEGREE, weights, &found, &error), AUR_OK);
    assert_true(found.residual > 1e-6);
    assert_relative(found.residual, worst_harmonic(N, xyz, weights, DEGREE), 1e-9);
    assert_int_equal(aur_weights_exact(N, xyz, &options, N, weights, &report, &error), AUR_OK);
    assert_int_equal(aur_exact_residual(&system, report.degree, weights, &found, &error), AUR_OK);
    assert_true(report.residual == found.residual && report.residual > 0.0);
    options.domain = AUR_DOMAIN_AXES;
    memcpy(xyz + 3, xyz, 3 * sizeof *xyz);
    assert_int_equal(aur_weights_exact(N, xyz, &options, N, weights, &report, &error), AUR_OK);
    assert_true(report.points == N && report.distinct_points == N - 1);
    free(xyz);
}

/* A random set at a degree that needs a negative weight: refused with the least one, or allowed. */
static void negative(void **state) {
    (void)state;
    enum { N = 200 };
    double *const xyz = points_of("random", N, AUR_DOMAIN_SPHERE, 0.0, 0.0), weights[N];
    aur_exact_options options = {.size = sizeof options};
    aur_exact_options_init(AUR_DOMAIN_SPHERE, &options, NULL);
    options.degree = 11;
    aur_exact_report report;
    aur_error error;
    assert_int_equal(aur_weights_exact(N, xyz, &options, N, weights, &report, &error), AUR_ERROR_ARGUMENT);
    assert_non_null(strstr(error.message, "negative weights, the least of them -"));
    options.negative = true;
    assert_int_equal(aur_weights_exact(N, xyz, &options, N, weights, &report, &error), AUR_OK);
    assert_true(report.least < 0.0);
    assert_true(worst_monomial(N, xyz, weights, 11, -1.0, 0.0) < 1e-12);
    free(xyz);
}

/* Each level of a grid is exact by itself, and the points after it have no weight. */
static void nested(void **state) {
    (void)state;
    enum { N = 512, LEVELS = 4 };
    const size_t counts[LEVELS] = {64, 128, 256, 512};
    double *const xyz = points_of("esfg:base=64", N, AUR_DOMAIN_SPHERE, 0.0, 0.0);
    double weights[LEVELS * N];
    aur_exact_options options = {.size = sizeof options};
    aur_exact_options_init(AUR_DOMAIN_SPHERE, &options, NULL);
    options.degree = 4;
    aur_exact_report reports[LEVELS];
    aur_error error;
    assert_int_equal(
        aur_weights_nested(N, xyz, LEVELS, counts, &options, LEVELS * N, weights, reports, &error), AUR_OK);
    for (size_t k = 0; k < LEVELS; ++k) {
        assert_true(reports[k].least > 0.0);
        assert_true(worst_monomial(N, xyz, weights + k * N, 4, -1.0, 0.0) < 1e-14);
        for (size_t i = counts[k]; i < N; ++i)
            assert_true(weights[k * N + i] == 0.0);
    }
    options.degree = 20; /* too much for the first level */
    assert_int_equal(
        aur_weights_nested(N, xyz, LEVELS, counts, &options, LEVELS * N, weights, reports, &error),
        AUR_ERROR_ARGUMENT);
    assert_int_equal(strncmp(error.message, "level 0: ", 9), 0);
    assert_int_equal(
        aur_weights_nested(N, xyz, LEVELS, counts, &options, LEVELS * N - 1, weights, reports, &error),
        AUR_ERROR_CAPACITY);
    assert_int_equal(
        aur_weights_nested(300, xyz, LEVELS, counts, &options, LEVELS * N, weights, NULL, &error),
        AUR_ERROR_ARGUMENT);
    assert_int_equal(
        aur_weights_nested(N, xyz, 2, (const size_t[]){64, 64}, &options, LEVELS * N, weights, NULL, &error),
        AUR_ERROR_ARGUMENT);
    free(xyz);
}

/* Areas of cells: the cube's vertices have one each; doubled points share; two points have a hemisphere each;
 * the cosine multiplies. */
static void cells(void **state) {
    (void)state;
    double xyz[27], weights[9];
    for (size_t i = 0; i < 24; ++i)
        xyz[i] = ((i / 3) >> (i % 3) & 1 ? 1.0 : -1.0) / sqrt(3.0);
    memcpy(xyz + 24, xyz, 3 * sizeof *xyz);
    aur_error error;
    assert_int_equal(aur_weights_voronoi(9, xyz, AUR_DOMAIN_SPHERE, NULL, NULL, 9, weights, &error), AUR_OK);
    assert_near(weights[0], 1.0 / 16.0, 1e-15);
    assert_near(weights[1], 1.0 / 8.0, 1e-15);
    assert_int_equal(aur_weights_voronoi(2, xyz, AUR_DOMAIN_SPHERE, NULL, NULL, 9, weights, &error), AUR_OK);
    assert_near(weights[0], 0.5, 0.0);
    assert_int_equal(aur_weights_voronoi(8, xyz, AUR_DOMAIN_SPHERE, NULL, NULL, 7, weights, &error),
                     AUR_ERROR_CAPACITY);
    assert_int_equal(aur_weights_voronoi(8, xyz, AUR_DOMAIN_DISK, NULL, NULL, 9, weights, &error),
                     AUR_ERROR_UNSUPPORTED);
    enum { N = 500 };
    double *const half = points_of("sobol", N, AUR_DOMAIN_HEMISPHERE, 0.0, 0.0), areas[N], weighed[N],
                  sum = 0.0;
    const aur_lobe cosine = {.exponent = 1.0};
    assert_int_equal(aur_weights_voronoi(N, half, AUR_DOMAIN_HEMISPHERE, NULL, NULL, N, areas, &error),
                     AUR_OK);
    assert_int_equal(aur_weights_voronoi(N, half, AUR_DOMAIN_HEMISPHERE, &cosine, NULL, N, weighed, &error),
                     AUR_OK);
    for (size_t i = 0; i < N; ++i)
        sum += areas[i] * half[3 * i + 2];
    for (size_t i = 0; i < N; ++i)
        assert_near(weighed[i], areas[i] * half[3 * i + 2] / sum, 1e-15);
    free(half);
}

/* Stops at call `last`. */
typedef struct countdown {
    size_t calls, last;
} countdown;

static int count_down(void *user, const char *what, uint64_t done, uint64_t total) {
    countdown *const c = user;
    (void)what;
    assert_true(done <= total);
    return ++c->calls == c->last;
}

/* A step over many points takes seconds: it polls for cancellation, and stops at once. */
static void stops_within_a_step(void **state) {
    (void)state;
    enum { N = 40000 };
    double *const xyz = points_of("spherical-fibonacci", N, AUR_DOMAIN_SPHERE, 0.0, 0.0);
    double *const weights = malloc(N * sizeof *weights);
    assert_non_null(weights);
    aur_exact_options options = {.size = sizeof options};
    aur_exact_options_init(AUR_DOMAIN_SPHERE, &options, NULL);
    countdown all = {0};
    aur_exact_report report;
    aur_error error;
    options.degree = 40;
    options.threads = 1;
    options.progress = (aur_progress){.function = count_down, .user = &all};
    assert_int_equal(aur_weights_exact(N, xyz, &options, N, weights, &report, &error), AUR_OK);
    assert_true(all.calls > 10 * (report.iterations + 1));
    for (size_t last = 1; last < all.calls; last += all.calls / 7) {
        countdown some = {.last = last};
        options.progress.user = &some;
        assert_int_equal(aur_weights_exact(N, xyz, &options, N, weights, &report, &error),
                         AUR_ERROR_CANCELLED);
        assert_int_equal(some.calls, last);
    }
    free(weights);
    free(xyz);
}

/* The minimum and maximum of the reported share, and the number of reports of 0. */
typedef struct search_progress {
    double share;
    size_t known, unknown;
} search_progress;

static int follow_search(void *user, const char *what, uint64_t done, uint64_t total) {
    search_progress *const p = user;
    assert_non_null(what);
    assert_true(done <= total);
    p->unknown += total == 0;
    p->known += total > 0;
    assert_true(total == 0 || (double)done / (double)total >= p->share);
    p->share = total > 0 ? (double)done / (double)total : p->share;
    return 0;
}

/* If the largest degree of a set is unknown, the remaining time is not reported until few degrees are left;
 * for even sets it is reported after the first degree. The reported share never decreases. */
static void searches_report(void **state) {
    (void)state;
    enum { N = 3000 };
    static const char *const sets[] = {"random", "spherical-fibonacci"};
    double *const weights = malloc(N * sizeof *weights);
    assert_non_null(weights);
    for (int k = 0; k < 2; ++k) {
        double *const xyz = points_of(sets[k], N, AUR_DOMAIN_SPHERE, 0.0, 0.0);
        aur_exact_options options = {.size = sizeof options};
        aur_exact_options_init(AUR_DOMAIN_SPHERE, &options, NULL);
        search_progress seen = {0};
        options.threads = 1;
        options.progress = (aur_progress){.function = follow_search, .user = &seen};
        assert_int_equal(aur_weights_exact(N, xyz, &options, N, weights, NULL, NULL), AUR_OK);
        assert_true(k == 0 ? seen.unknown > seen.known : seen.known > 4 * seen.unknown);
        assert_true(seen.known > 10 && seen.share > 0.7);
        free(xyz);
    }
    free(weights);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(golden),
                                       cmocka_unit_test(monomials),
                                       cmocka_unit_test(designs),
                                       cmocka_unit_test(tolerances),
                                       cmocka_unit_test(fourier),
                                       cmocka_unit_test(many_points),
                                       cmocka_unit_test(bad_input),
                                       cmocka_unit_test(negative),
                                       cmocka_unit_test(cells),
                                       cmocka_unit_test(nested),
                                       cmocka_unit_test(stops_within_a_step),
                                       cmocka_unit_test(reports),
                                       cmocka_unit_test(searches_report)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
