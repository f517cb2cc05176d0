#include "check.h"

#include <string.h>

#include "sphere_sets.h"

static double measured(const char *metric, const test_points *points, size_t threads) {
    double value = NAN;
    aur_error error = {0};
    const aur_measure_options options = {.size = sizeof options, .threads = threads};
    assert_int_equal(aur_measure(metric, (const aur_points_view[]){seen(points)}, &options, &value, &error),
                     AUR_OK);
    return value;
}

/* The mass of the closed cap about `w` whose boundary is at `height`, less its area. */
static double value_of(const test_points *points, const double w[3], double height) {
    double mass = 0.0, total = 0.0;
    for (size_t k = 0; k < points->count; ++k) {
        const double *const x = points->coordinates + 3 * k;
        const double weight = points->weights != NULL ? points->weights[k] : 1.0;
        total += weight;
        if (w[0] * x[0] + w[1] * x[1] + w[2] * x[2] >= height - 1e-12)
            mass += weight;
    }
    return mass / total - 0.5 * (1.0 - height);
}

static double both_sides(const test_points *points, double w[3], const double x[3]) {
    const double length = sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
    if (length < 1e-9)
        return 0.0;
    for (int d = 0; d < 3; ++d)
        w[d] /= length;
    const double height = w[0] * x[0] + w[1] * x[1] + w[2] * x[2];
    const double opposite[3] = {-w[0], -w[1], -w[2]};
    return fmax(value_of(points, w, height), value_of(points, opposite, -height));
}

/* Every cap through three points, with two on a diameter, or about one: O(N^4). */
static double cap_by_all_triples(const test_points *points) {
    double best = 0.0;
    const double *const x = points->coordinates;
    for (size_t i = 0; i < points->count; ++i) {
        const double *const a = x + 3 * i;
        double w[3] = {a[0], a[1], a[2]};
        best = fmax(best, both_sides(points, w, a));
        for (size_t j = 0; j < i; ++j) {
            const double *const b = x + 3 * j;
            double middle[3] = {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
            best = fmax(best, both_sides(points, middle, a));
            for (size_t k = 0; k < j; ++k) {
                const double *const c = x + 3 * k;
                double p[3], q[3];
                for (int d = 0; d < 3; ++d) {
                    p[d] = b[d] - a[d];
                    q[d] = c[d] - a[d];
                }
                double normal[3] = {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2],
                                    p[0] * q[1] - p[1] * q[0]};
                best = fmax(best, both_sides(points, normal, a));
            }
        }
    }
    return best;
}

static void caps_have_their_closed_forms(void **state) {
    (void)state;
    test_points points = octahedron();
    assert_near(measured("cap", &points, 1), 1.0 / 3.0, 1e-12);
    points.count = 2; /* an antipodal pair: one point, or both in a hemisphere */
    assert_near(measured("cap", &points, 1), 0.5, 1e-12);
    points.count = 1;
    assert_near(measured("cap", &points, 1), 1.0, 1e-12);
    points.count = 6;
    memcpy(points.coordinates + 3, points.coordinates, 3 * sizeof(double)); /* a coincident pair */
    points.count = 2;
    assert_near(measured("cap", &points, 1), 1.0, 1e-12);
    release_points(&points);
}

/* Marques 2013 has none; computed by an independent program. */
static void caps_have_their_golden_figures(void **state) {
    (void)state;
    test_points points = spherical_fibonacci(64, AUR_DOMAIN_SPHERE);
    assert_near(measured("cap", &points, 0), 0.072890, 0.51e-6);
    assert_true(measured("cap-bound", &points, 0) < 0.072890);
    assert_true(measured("cap-bound", &points, 0) > 0.9 * 0.072890);
    release_points(&points);
}

/* The same by all triples: random points, points of a grid (coplanar, coincident and antipodal ones among
 * them), points that almost coincide, and weights. */
static void caps_agree_with_all_triples(void **state) {
    (void)state;
    for (uint64_t seed = 0; seed < 24; ++seed) {
        test_points points = random_directions(2 + 2 * seed, seed);
        if (seed % 3 == 1)
            for (size_t i = 0; i < points.count; ++i) {
                double *const x = points.coordinates + 3 * i;
                double length = 0.0;
                for (int d = 0; d < 3; ++d)
                    x[d] = round(1.5 * x[d]);
                for (int d = 0; d < 3; ++d)
                    length += x[d] * x[d];
                for (int d = 0; d < 3; ++d)
                    x[d] = length > 0.0 ? x[d] / sqrt(length) : (d == 2 ? 1.0 : 0.0);
            }
        /* Pairs that almost coincide. */
        for (size_t i = 0; seed % 3 == 2 && i + 1 < points.count; i += 3) {
            double *const x = points.coordinates + 3 * i;
            for (int d = 0; d < 3; ++d)
                x[3 + d] = x[d] + 1e-7 * (aur_unit_double(aur_hash3(seed, i, (uint64_t)d)) - 0.5);
            const double length = sqrt(x[3] * x[3] + x[4] * x[4] + x[5] * x[5]);
            for (int d = 3; d < 6; ++d)
                x[d] /= length;
        }
        if (seed % 2 == 1) {
            points.weights = malloc(points.count * sizeof(double));
            for (size_t i = 0; i < points.count; ++i)
                points.weights[i] = aur_unit_double(aur_hash3(seed, i, 9));
        }
        assert_near(measured("cap", &points, 1), cap_by_all_triples(&points), 1e-11);
        release_points(&points);
    }
}

static void threads_change_no_bit(void **state) {
    (void)state;
    test_points points = random_directions(150, 4);
    const double one = measured("cap", &points, 1);
    const double two = measured("cap", &points, 2);
    assert_memory_equal(&one, &two, sizeof one);
    const double bound = measured("cap-bound:500", &points, 1);
    const double same = measured("cap-bound:500", &points, 2);
    assert_memory_equal(&bound, &same, sizeof bound);
    assert_true(bound <= one);
    release_points(&points);
}

static void negative_masses_are_refused(void **state) {
    (void)state;
    test_points points = octahedron();
    points.weights = malloc(6 * sizeof(double));
    for (size_t i = 0; i < 6; ++i)
        points.weights[i] = i == 3 ? -0.5 : 1.0;
    double value = 0.0;
    aur_error error = {0};
    assert_int_equal(aur_measure("cap", (const aur_points_view[]){seen(&points)}, NULL, &value, &error),
                     AUR_ERROR_ARGUMENT);
    assert_non_null(strstr(error.message, "point 4"));
    release_points(&points);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(caps_have_their_closed_forms), cmocka_unit_test(caps_have_their_golden_figures),
        cmocka_unit_test(caps_agree_with_all_triples),  cmocka_unit_test(threads_change_no_bit),
        cmocka_unit_test(negative_masses_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
