/* View factors of two polygons against the closed forms of Howell's catalogue and other laws. */
#include <aureole-lighting/view_factors.h>
#include <string.h>

#include "check.h"

#define PI 3.14159265358979323846

static double factor_of(size_t n, const double *from, size_t m, const double *to) {
    double factor = NAN;
    assert_int_equal(aur_view_factor_polygons(n, from, m, to, &factor, NULL), AUR_OK);
    return factor;
}

/* Howell C-11: directly opposed rectangles of sides a, b at the distance c. */
static double parallel_rectangles(double a, double b, double c) {
    const double x = a / c, y = b / c, x2 = 1.0 + x * x, y2 = 1.0 + y * y;
    return 2.0 / (PI * x * y) *
           (0.5 * log(x2 * y2 / (x2 + y * y)) + x * sqrt(y2) * atan(x / sqrt(y2)) +
            y * sqrt(x2) * atan(y / sqrt(x2)) - x * atan(x) - y * atan(y));
}

/* Howell C-14: rectangles that share the edge l at a right angle; from w to h. */
static double perpendicular_rectangles(double h, double w, double l) {
    const double H = h / l, W = w / l, h2 = H * H, w2 = W * W, s = h2 + w2;
    const double logs = log((1.0 + w2) * (1.0 + h2) / (1.0 + s)) +
                        w2 * log(w2 * (1.0 + s) / ((1.0 + w2) * s)) +
                        h2 * log(h2 * (1.0 + s) / ((1.0 + h2) * s));
    return 1.0 / (PI * W) *
           (W * atan(1.0 / W) + H * atan(1.0 / H) - sqrt(s) * atan(1.0 / sqrt(s)) + 0.25 * logs);
}

static void test_parallel_rectangles(void **state) {
    (void)state;
    static const double cases[][3] = {{1, 1, 1},     {2, 1, 1},    {1, 3, 0.5},
                                      {10, 7, 0.01}, {1, 1, 1e-3}, {3, 1e-3, 1}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
        const double a = cases[i][0], b = cases[i][1], c = cases[i][2];
        const double floor[] = {0, 0, 0, a, 0, 0, a, b, 0, 0, b, 0};
        const double roof[] = {0, 0, c, 0, b, c, a, b, c, a, 0, c};
        const double exact = parallel_rectangles(a, b, c);
        /* The closed form is a small difference of its terms, which are rounded to 2e-16. */
        const double tolerance = 1e-11 * exact + 1e-15 * c * c / (a * b);
        assert_near(factor_of(4, floor, 4, roof), exact, tolerance);
        assert_near(factor_of(4, roof, 4, floor), exact, tolerance);
    }
}

static void test_perpendicular_rectangles(void **state) {
    (void)state;
    static const double cases[][3] = {{1, 1, 1},     {2, 1, 1},    {1, 3, 0.5},
                                      {10, 7, 0.01}, {1e-3, 1, 1}, {1, 1e-3, 1}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
        const double h = cases[i][0], w = cases[i][1], l = cases[i][2];
        const double floor[] = {0, 0, 0, w, 0, 0, w, l, 0, 0, l, 0};
        const double wall[] = {0, 0, 0, 0, l, 0, 0, l, h, 0, 0, h};
        assert_relative(factor_of(4, floor, 4, wall), perpendicular_rectangles(h, w, l), 1e-11);
        assert_relative(factor_of(4, wall, 4, floor) * h, perpendicular_rectangles(h, w, l) * w, 1e-11);
    }
}

/* Howell C-41: coaxial disks of radii r1, r2 at the distance h. Regular polygons of n corners instead of the
 * disks differ by terms in 1/n^2, 1/n^4, .., which are taken away by extrapolation (Romberg). */
static void test_disks(void **state) {
    (void)state;
    enum { LEVELS = 4, MOST = 16 << (LEVELS - 1) };
    static const double cases[][3] = {{1, 1, 1}, {1, 2, 1.5}, {0.5, 1, 2}};
    for (size_t i = 0; i < 3; ++i) {
        const double r1 = cases[i][0], r2 = cases[i][1], h = cases[i][2];
        const double x = 1.0 + (h * h + r2 * r2) / (r1 * r1);
        const double exact = 0.5 * (x - sqrt(x * x - 4.0 * (r2 / r1) * (r2 / r1)));
        double table[LEVELS];
        for (size_t level = 0; level < LEVELS; ++level) {
            static double lower[3 * MOST], upper[3 * MOST];
            const size_t n = 16u << level;
            for (size_t k = 0; k < n; ++k) {
                const double angle = 2.0 * PI * (double)k / (double)n;
                memcpy(&lower[3 * k], (double[3]){r1 * cos(angle), r1 * sin(angle), 0.0}, 3 * sizeof(double));
                memcpy(&upper[3 * k], (double[3]){r2 * cos(angle), -r2 * sin(angle), h}, 3 * sizeof(double));
            }
            table[level] = factor_of(n, lower, n, upper);
        }
        for (size_t step = 1; step < LEVELS; ++step)
            for (size_t level = LEVELS - 1; level >= step; --level)
                table[level] += (table[level] - table[level - 1]) / (pow(4.0, (double)step) - 1.0);
        assert_near(table[LEVELS - 1], exact, 1e-8);
    }
}

/* A box is closed: the light of a face arrives at the other five, whether a face is one polygon or two. */
static void test_box_is_closed(void **state) {
    (void)state;
    const double s[3] = {1.0, 0.37, 2.2};
    static const int faces[6][4] = {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1},
                                    {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}}; /* seen from inside */
    double corners[8][3], triangles[12][9];
    for (int i = 0; i < 8; ++i)
        for (int d = 0; d < 3; ++d)
            corners[i][d] = (i >> d & 1) != 0 ? s[d] : 0.0;
    for (int t = 0; t < 12; ++t)
        for (int k = 0; k < 3; ++k)
            memcpy(&triangles[t][3 * k], corners[faces[t / 2][k == 0 ? 0 : k + t % 2]], sizeof corners[0]);
    for (int i = 0; i < 12; ++i) {
        double sum = 0.0;
        for (int k = 0; k < 12; ++k)
            sum += i != k ? factor_of(3, triangles[i], 3, triangles[k]) : 0.0;
        assert_near(sum, 1.0, 1e-13);
    }
}

/* Far away a factor is cos cos A / (pi r^2); its digits do not drown in the sum of edges. */
static void test_far_polygons(void **state) {
    (void)state;
    const double floor[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    for (double distance = 1.0; distance < 2e6; distance *= 1.7) {
        double roof[9] = {0, 0, distance, 0, 1, distance, 1, 0, distance};
        /* Both means are above each other. The rule of the seven nodes is exact enough from 1e3 on. */
        const double factor = factor_of(3, floor, 3, roof);
        const double simple = 0.5 / (PI * distance * distance);
        if (distance > 1e4)
            assert_relative(factor, simple, 1e-8);
        assert_near(factor_of(3, roof, 3, floor), factor, 1e-11 * factor);
        /* The same as the sum over four parts, which take other rules. */
        double parts = 0.0;
        for (int k = 0; k < 4; ++k) {
            double part[9];
            for (int c = 0; c < 3; ++c)
                for (int d = 0; d < 3; ++d) {
                    const double a = roof[3 * c + d], b = roof[3 * ((c + 1) % 3) + d];
                    part[3 * c + d] = k == 3 ? 0.5 * (a + b) : 0.5 * (a + roof[3 * k + d]);
                }
            parts += factor_of(3, floor, 3, part);
        }
        assert_relative(parts, factor, 1e-10);
    }
}

/* The part behind a plane is clipped: a wall through the floor counts from the floor on. */
static void test_horizon(void **state) {
    (void)state;
    const double floor[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    const double through[] = {0, 0, -2, 0, 1, -2, 0, 1, 1, 0, 0, 1};
    assert_relative(factor_of(4, floor, 4, through), perpendicular_rectangles(1, 1, 1), 1e-11);
    const double behind[] = {0, 0, -2, 0, 1, -2, 0, 1, -1, 0, 0, -1};
    assert_true(factor_of(4, floor, 4, behind) == 0.0);
    const double away[] = {0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1};
    assert_true(factor_of(4, floor, 4, away) == 0.0);
    const double next_to[] = {1, 0, 0, 2, 0, 0, 2, 1, 0, 1, 1, 0};
    assert_true(factor_of(4, floor, 4, next_to) == 0.0);
}

/* Edges that nearly touch, intersect or coincide: the factors converge to those of touching ones. */
static void test_near_misses(void **state) {
    (void)state;
    const double floor[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    const double touching = perpendicular_rectangles(1, 1, 1);
    for (double gap = 1e-14; gap < 1e-3; gap *= 10.0) {
        const double wall[] = {-gap, gap, gap, -gap, 1 + gap, gap, -gap, 1 + gap, 1, -gap, gap, 1};
        /* The factor changes by the gap times its logarithm. */
        assert_near(factor_of(4, floor, 4, wall), touching, 3.0 * gap * (3.0 - log(gap)));
        const double turned[] = {0, gap, 0, 0, 1, gap, 0, 1, 1, 0, 0, 1};
        assert_near(factor_of(4, floor, 4, turned), touching, 3.0 * gap * (3.0 - log(gap)));
    }
}

static void test_errors(void **state) {
    (void)state;
    const double good[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0};
    const double line[] = {0, 0, 0, 1, 0, 0, 2, 0, 0};
    const double bent[] = {0, 0, 0, 1, 0, 0, 1, 1, 0.5, 0, 1, 0};
    const double hollow[] = {0, 0, 0, 1, 0, 0, 0.1, 0.1, 0, 0, 1, 0};
    const double wild[] = {0, 0, 0, 1, 0, 0, 0, NAN, 0};
    double factor;
    aur_error error;
    assert_int_equal(aur_view_factor_polygons(2, good, 3, good, &factor, &error), AUR_ERROR_ARGUMENT);
    assert_int_equal(aur_view_factor_polygons(3, good, 3, line, &factor, &error), AUR_ERROR_ARGUMENT);
    assert_non_null(strstr(error.message, "`to` has no area"));
    assert_int_equal(aur_view_factor_polygons(4, bent, 3, good, &factor, &error), AUR_ERROR_ARGUMENT);
    assert_int_equal(aur_view_factor_polygons(4, hollow, 3, good, &factor, &error), AUR_ERROR_ARGUMENT);
    assert_int_equal(aur_view_factor_polygons(3, wild, 3, good, &factor, &error), AUR_ERROR_ARGUMENT);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_parallel_rectangles),
        cmocka_unit_test(test_perpendicular_rectangles),
        cmocka_unit_test(test_disks),
        cmocka_unit_test(test_box_is_closed),
        cmocka_unit_test(test_far_polygons),
        cmocka_unit_test(test_horizon),
        cmocka_unit_test(test_near_misses),
        cmocka_unit_test(test_errors),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
