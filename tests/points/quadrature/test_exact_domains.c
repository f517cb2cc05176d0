/* Exact weights on square, cube, disk and rotations, and with symmetries. Oracles: closed moments of
 * monomials, and the sums of characters over pairs that vanish where all Wigner functions of a degree do. */
#include <aureole/exact.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"

static aur_error error;
static aur_exact_report report;
enum { MOST = 1024 };
static double weights[2 * MOST];

static aur_points *points_of(const char *set, size_t count, aur_domain domain, size_t dimension,
                             const double **coordinates) {
    aur_directions_options options = {.size = sizeof options};
    aur_directions_options_init(count, domain, &options, NULL);
    aur_points_request request = {.size = sizeof request};
    aur_points_request_init(&options, &request, NULL);
    request.dimension = dimension;
    aur_points *points;
    assert_int_equal(aur_points_generate(set, &request, &points, &error), AUR_OK);
    *coordinates = aur_points_get_view(points)->coordinates;
    return points;
}

static aur_exact_options options_of(aur_domain domain, size_t dimension, size_t degree) {
    aur_exact_options options = {.size = sizeof options};
    aur_exact_options_init(domain, &options, NULL);
    options.dimension = dimension;
    options.degree = degree;
    return options;
}

/* The mean of a monomial over the cube, or of x^a y^b over the unit disk. */
static double moment(bool disk, size_t dimension, const size_t *powers) {
    double mean = 1.0;
    for (size_t d = 0; d < dimension && !disk; ++d)
        mean /= (double)powers[d] + 1.0;
    if (!disk)
        return mean;
    const double a = (double)powers[0], b = (double)powers[1];
    if (powers[0] % 2 != 0 || powers[1] % 2 != 0)
        return 0.0;
    return tgamma(0.5 * (a + 1.0)) * tgamma(0.5 * (b + 1.0)) / tgamma(0.5 * (a + b) + 2.0) / acos(-1.0);
}

/* The largest error of a monomial of a total degree of at most `degree`. */
static double worst(bool disk, size_t count, size_t dimension, const double *points, size_t degree) {
    size_t powers[8] = {0};
    double largest = 0.0;
    for (;;) {
        size_t total = 0;
        for (size_t d = 0; d < dimension; ++d)
            total += powers[d];
        double sum = 0.0;
        for (size_t i = 0; i < count && total <= degree; ++i) {
            double value = weights[i];
            for (size_t d = 0; d < dimension; ++d)
                value *= pow(points[i * dimension + d], (double)powers[d]);
            sum += value;
        }
        if (total <= degree)
            largest = fmax(largest, fabs(sum - moment(disk, dimension, powers)));
        size_t d = 0;
        while (d < dimension && powers[d] == degree)
            powers[d++] = 0;
        if (d == dimension)
            return largest;
        ++powers[d];
    }
}

static void monomials(void **state) {
    (void)state;
    static const struct {
        const char *set;
        aur_domain domain;
        size_t count, dimension, degree;
    } cases[] = {{"sobol", AUR_DOMAIN_SQUARE, 256, 2, 9},
                 {"random", AUR_DOMAIN_SQUARE, 100, 2, 4},
                 {"fibonacci-lattice", AUR_DOMAIN_SQUARE, 144, 2, 5},
                 {"sobol", AUR_DOMAIN_CUBE, 64, 1, 12},
                 {"sobol", AUR_DOMAIN_CUBE, 256, 3, 5},
                 {"sobol", AUR_DOMAIN_CUBE, 256, 6, 3},
                 {"sobol", AUR_DOMAIN_DISK, 500, 2, 14},
                 {"spherical-fibonacci", AUR_DOMAIN_DISK, 256, 2, 12}};
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; ++k) {
        const size_t d = cases[k].dimension, n = cases[k].count;
        const bool disk = cases[k].domain == AUR_DOMAIN_DISK;
        const double *x;
        aur_points *const points = points_of(cases[k].set, n, cases[k].domain, d, &x);
        aur_exact_options options = options_of(cases[k].domain, d, cases[k].degree);
        assert_int_equal(aur_weights_exact(n, x, &options, n, weights, &report, &error), AUR_OK);
        assert_true(report.residual < 1e-14 && report.least > 0.0);
        assert_true(worst(disk, n, d, x, cases[k].degree) < 1e-14);
        assert_true(worst(disk, n, d, x, cases[k].degree + 1) > 1e-9);
        options.degree = AUR_DEGREE_LARGEST;
        assert_int_equal(aur_weights_exact(n, x, &options, n, weights, &report, &error), AUR_OK);
        assert_true(report.degree >= cases[k].degree && report.least > 0.0);
        assert_true(worst(disk, n, d, x, report.degree) < 1e-14);
        aur_points_destroy(points);
    }
}

static double character(size_t l, const double *p, const double *q) {
    const double cosine = p[0] * q[0] + p[1] * q[1] + p[2] * q[2] + p[3] * q[3]; /* of half the angle */
    double before = 1.0, here = 2.0 * cosine;                                    /* Chebyshev's U */
    for (size_t k = 1; k < 2 * l; ++k) {
        const double next = 2.0 * cosine * here - before;
        before = here;
        here = next;
    }
    return l == 0 ? 1.0 : here;
}

static void multiply(const double *a, const double *b, double *product) {
    product[0] = a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3];
    product[1] = a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2];
    product[2] = a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1];
    product[3] = a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0];
}

/* The mean square of what the weights make of the invariant functions of a degree. */
static double energy(size_t count, const double *q, aur_symmetry crystal, aur_symmetry sample, size_t l) {
    double right[4 * AUR_SYMMETRY_ORDER_MAX], left[4 * AUR_SYMMETRY_ORDER_MAX], sum = 0.0;
    const size_t rights = aur_symmetry_group(crystal, right), lefts = aur_symmetry_group(sample, left);
    for (size_t g = 0; g < rights; ++g)
        for (size_t s = 0; s < lefts; ++s)
            for (size_t i = 0; i < count; ++i) {
                double turned[4], image[4];
                multiply(q + 4 * i, right + 4 * g, turned);
                multiply(left + 4 * s, turned, image);
                for (size_t j = 0; j < count; ++j)
                    sum += weights[i] * weights[j] * character(l, image, q + 4 * j);
            }
    return sum / (double)(rights * lefts);
}

static void rotations(void **state) {
    (void)state;
    static const struct {
        const char *set;
        size_t count, degree;
        aur_symmetry crystal, sample;
    } cases[] = {{"super-fibonacci", 500, 5, AUR_SYMMETRY_1, AUR_SYMMETRY_1},
                 {"random", 400, 2, AUR_SYMMETRY_1, AUR_SYMMETRY_1},
                 {"super-fibonacci", 120, 7, AUR_SYMMETRY_432, AUR_SYMMETRY_1},
                 {"super-fibonacci", 120, 7, AUR_SYMMETRY_622, AUR_SYMMETRY_222},
                 {"sobol", 128, 6, AUR_SYMMETRY_1, AUR_SYMMETRY_432}};
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; ++k) {
        const size_t n = cases[k].count;
        const double *q;
        aur_points *const points = points_of(cases[k].set, n, AUR_DOMAIN_ROTATIONS, 0, &q);
        aur_exact_options options = options_of(AUR_DOMAIN_ROTATIONS, 0, cases[k].degree);
        options.crystal = cases[k].crystal;
        options.sample = cases[k].sample;
        assert_int_equal(aur_weights_exact(n, q, &options, n, weights, &report, &error), AUR_OK);
        for (size_t l = 1; l <= cases[k].degree; ++l)
            assert_true(fabs(energy(n, q, options.crystal, options.sample, l)) < 1e-13);
        assert_true(energy(n, q, options.crystal, options.sample, cases[k].degree + 1) > 1e-9 ||
                    energy(n, q, options.crystal, options.sample, cases[k].degree + 2) > 1e-9);
        aur_points_destroy(points);
    }
}

/* Doubled points, and q and -q, share the weight of one; the others stay as they are without the copy. */
static void doubled(void **state) {
    (void)state;
    enum { N = 60 };
    const double *q;
    aur_points *const points = points_of("super-fibonacci", N, AUR_DOMAIN_ROTATIONS, 0, &q);
    double more[4 * (N + 1)], alone[N];
    memcpy(more, q, 4 * N * sizeof *q);
    for (size_t d = 0; d < 4; ++d)
        more[4 * N + d] = -q[4 * 7 + d];
    const aur_exact_options options = options_of(AUR_DOMAIN_ROTATIONS, 0, 2);
    assert_int_equal(aur_weights_exact(N, q, &options, N, alone, NULL, &error), AUR_OK);
    assert_int_equal(aur_weights_exact(N + 1, more, &options, N + 1, weights, &report, &error), AUR_OK);
    assert_int_equal(report.distinct_points, N);
    assert_near(weights[7], weights[N], 1e-15);
    assert_near(weights[7] + weights[N], alone[7], 1e-13);
    assert_near(weights[20], alone[20], 1e-13);
    aur_points_destroy(points);
}

static void nested(void **state) {
    (void)state;
    const double *x;
    aur_points *const points = points_of("sobol", 256, AUR_DOMAIN_CUBE, 3, &x);
    const aur_exact_options options = options_of(AUR_DOMAIN_CUBE, 3, 3);
    const size_t counts[] = {128, 256};
    assert_int_equal(aur_weights_nested(256, x, 2, counts, &options, 512, weights, NULL, &error), AUR_OK);
    assert_true(worst(false, 256, 3, x, 3) < 1e-14 && weights[128] == 0.0 && weights[127] != 0.0);
    aur_points_destroy(points);
}

/* Functions with the symmetry alone: images of the points with equal parts of the weights integrate all
 * even powers of x. */
static void point_groups(void **state) {
    (void)state;
    static const struct {
        const char *name;
        size_t count, degree;
    } cases[] = {{"Oh", 800, 17}, {"D2h", 300, 12}, {"C5v", 300, 10}};
    static double xyz[3 * MOST];
    static aur_point_group group;
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; ++k) {
        const double *all;
        aur_points *const points =
            points_of("spherical-fibonacci", cases[k].count, AUR_DOMAIN_SPHERE, 0, &all);
        memcpy(xyz, all, 3 * cases[k].count * sizeof *xyz);
        aur_points_destroy(points);
        assert_int_equal(aur_point_group_from_name(cases[k].name, &group, &error), AUR_OK);
        const size_t n = aur_point_group_select(&group, cases[k].count, xyz, NULL);
        assert_true(fabs((double)(n * group.order) - (double)cases[k].count) < 0.5 * (double)cases[k].count);
        aur_exact_options options = options_of(AUR_DOMAIN_SPHERE, 0, cases[k].degree);
        options.group = &group;
        assert_int_equal(aur_weights_exact(n, xyz, &options, n, weights, &report, &error), AUR_OK);
        for (int power = 0; power <= (int)cases[k].degree; power += 2)
            for (int d = 0; d < 3; ++d) {
                double sum = 0.0;
                for (size_t i = 0; i < n; ++i)
                    for (size_t g = 0; g < group.order; ++g) {
                        double image[3] = {xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]};
                        aur_rotation_apply(&group.elements[g], 1, image);
                        sum += weights[i] * pow(image[d], power) / (double)group.order;
                    }
                assert_near(sum, 1.0 / (power + 1.0), 1e-13);
            }
    }
}

/* Of Lebedev's rule of 110 points one point of each orbit, with the weights of the orbits: sizes 6, 8, 24 (4
 * times) and so 6 points. */
static void orbits(void **state) {
    (void)state;
    const double *all;
    aur_points *const points = points_of("lebedev", 110, AUR_DOMAIN_SPHERE, 0, &all);
    double xyz[3 * 110], sum = 0.0, mean = 0.0;
    aur_point_group group;
    memcpy(xyz, all, sizeof xyz);
    memcpy(weights, aur_points_get_view(points)->weights, 110 * sizeof *weights);
    assert_int_equal(aur_point_group_from_name("Oh", &group, &error), AUR_OK);
    assert_int_equal(aur_point_group_select(&group, 110, xyz, weights), 6);
    for (size_t i = 0; i < 6; ++i) {
        const double *const u = xyz + 3 * i;
        sum += weights[i];
        mean += weights[i] * (pow(u[0], 4) + pow(u[1], 4) + pow(u[2], 4));
    }
    assert_near(sum, 1.0, 1e-14);
    assert_near(mean, 0.6, 1e-14);
    aur_points_destroy(points);
}

static void expect(size_t count, const double *x, const aur_exact_options *options, aur_result result,
                   const char *words) {
    assert_int_equal(aur_weights_exact(count, x, options, count, weights, NULL, &error), result);
    assert_non_null(strstr(error.message, words));
}

static void bad_input(void **state) {
    (void)state;
    double x[2 * MOST] = {0.5, 0.5, 0.25, 2.0};
    aur_exact_options options = options_of(AUR_DOMAIN_SQUARE, 2, AUR_DEGREE_LARGEST);
    expect(0, x, &options, AUR_ERROR_ARGUMENT, "at least one point");
    expect(2, x, &options, AUR_ERROR_ARGUMENT, "point 2 has a coordinate outside of [0,1]");
    x[3] = NAN;
    expect(2, x, &options, AUR_ERROR_ARGUMENT, "point 2");
    options.degree = 2;
    expect(1, x, &options, AUR_ERROR_ARGUMENT, "6 polynomials of degree 2");
    options.degree = AUR_EXACT_DEGREE_MAX + 1;
    expect(1, x, &options, AUR_ERROR_ARGUMENT, "at most 1500");
    options.degree = 0;
    assert_int_equal(aur_weights_exact(1, x, &options, 1, weights, &report, &error), AUR_OK);
    assert_true(weights[0] == 1.0);
    options.cap_degrees = 10.0;
    expect(1, x, &options, AUR_ERROR_UNSUPPORTED, "caps and lobes");
    options = options_of(AUR_DOMAIN_CUBE, 0, 0);
    expect(1, x, &options, AUR_ERROR_ARGUMENT, "between 1 and 4096");
    options = options_of(AUR_DOMAIN_CUBE, 1, 1400);
    for (size_t i = 0; i < 2 * MOST; ++i)
        x[i] = 0.0;
    expect(2 * MOST, x, &options, AUR_ERROR_ARGUMENT, "1401 polynomials");
    options = options_of(AUR_DOMAIN_DISK, 0, 0);
    x[0] = x[1] = 0.8;
    expect(1, x, &options, AUR_ERROR_ARGUMENT, "outside the disk");
    options = options_of(AUR_DOMAIN_ROTATIONS, 0, 0);
    expect(1, x, &options, AUR_ERROR_ARGUMENT, "not a unit quaternion");
    options.crystal = (aur_symmetry)99;
    expect(1, x, &options, AUR_ERROR_ARGUMENT, "unknown symmetry 99");
    aur_point_group group;
    aur_point_group_from_name("Oh", &group, NULL);
    options = options_of(AUR_DOMAIN_HEMISPHERE, 0, 0);
    options.group = &group;
    expect(1, (const double[]){0, 0, 1}, &options, AUR_ERROR_UNSUPPORTED, "whole sphere");
    options = options_of(AUR_DOMAIN_SPHERE, 0, 9);
    options.group = &group;
    expect(1, (const double[]){0, 0, 1}, &options, AUR_ERROR_ARGUMENT, "degree 9");
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(monomials),    cmocka_unit_test(rotations),
                                       cmocka_unit_test(doubled),      cmocka_unit_test(nested),
                                       cmocka_unit_test(point_groups), cmocka_unit_test(orbits),
                                       cmocka_unit_test(bad_input)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
