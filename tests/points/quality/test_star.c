#include "check.h"

#include <stdlib.h>

#include "square_sets.h"

/* Every box whose sides are coordinates of points or 1, open and closed. */
static double star_by_all_boxes(const test_points *points) {
    double best = 0.0, mass = 0.0;
    for (size_t i = 0; i < points->count; ++i)
        mass += points->weights != NULL ? points->weights[i] : 1.0;
    for (size_t a = 0; a <= points->count; ++a)
        for (size_t b = 0; b <= points->count; ++b) {
            const double x = a < points->count ? points->coordinates[2 * a] : 1.0;
            const double y = b < points->count ? points->coordinates[2 * b + 1] : 1.0;
            double closed = 0.0, open = 0.0;
            for (size_t i = 0; i < points->count; ++i) {
                const double *const p = points->coordinates + 2 * i;
                const double weight = (points->weights != NULL ? points->weights[i] : 1.0) / mass;
                closed += p[0] <= x && p[1] <= y ? weight : 0.0;
                open += p[0] < x && p[1] < y ? weight : 0.0;
            }
            best = fmax(best, fmax(closed - x * y, x * y - open));
        }
    return best;
}

static void star_agrees_with_all_boxes(void **state) {
    (void)state;
    for (uint64_t seed = 0; seed < 60; ++seed) {
        const size_t count = 1 + seed;
        test_points points = random_points(count, 2, seed);
        /* Ties in one axis, in the other, and in both. */
        for (size_t i = 0; i < 2 * count && seed % 3 > 0; ++i)
            points.coordinates[i] =
                floor(points.coordinates[i] * (seed % 3 == 1 ? 8.0 : 100.0)) / (seed % 3 == 1 ? 8.0 : 100.0);
        if (seed % 2 == 0) {
            points.weights = malloc(count * sizeof(double));
            for (size_t i = 0; i < count; ++i)
                points.weights[i] = 0.1 + aur_unit_double(aur_hash3(seed, i, 1));
        }
        assert_near(measured("star", &points), star_by_all_boxes(&points), 1e-14);
        release_points(&points);
    }
}

/* Hammersley's closed form N D* = m/3 + 13/9 - (-1)^m 4/(9 2^m) (Halton and Zaremba 1969), and golden
 * figures. */
static void hammersley_has_its_closed_form(void **state) {
    (void)state;
    for (int m = 2; m <= 14; ++m) {
        const size_t count = (size_t)1 << m;
        test_points points = scrambled_set("hammersley", count, 2, AUR_SCRAMBLE_NONE);
        const double sign = m % 2 == 0 ? 1.0 : -1.0;
        const double expected = m / 3.0 + 13.0 / 9.0 - sign * 4.0 / (9.0 * (double)count);
        assert_near(measured("star", &points) * (double)count, expected, 1e-9);
        release_points(&points);
    }
}

/* On the line (2i-1)/(2N) are the best points: D* = 1/(2N), centred^2 = 1/(12 N^2), wrap-around^2 = 1/(6
 * N^2). */
static void the_best_points_of_the_line_have_closed_forms(void **state) {
    (void)state;
    static const size_t counts[] = {1, 2, 5, 64};
    for (size_t c = 0; c < 4; ++c) {
        const double n = (double)counts[c];
        test_points points = cube_points(counts[c], 1);
        for (size_t i = 0; i < counts[c]; ++i)
            points.coordinates[i] = ((double)i + 0.5) / n;
        assert_near(measured("star", &points), 0.5 / n, 1e-15);
        assert_near(measured("l2-star", &points), sqrt(1.0 / 12.0) / n, 1e-14);
        assert_near(measured("centered", &points), sqrt(1.0 / 12.0) / n, 1e-14);
        assert_near(measured("wraparound", &points), sqrt(1.0 / 6.0) / n, 1e-14);
        release_points(&points);
    }
}

/* The definition, integrated by the midpoint rule on a grid that the points' cells do not cross. */
static void l2_star_is_the_mean_over_boxes(void **state) {
    (void)state;
    enum { GRID = 64, FINE = 1024 };
    test_points points = random_points(9, 2, 5);
    for (size_t i = 0; i < 18; ++i)
        points.coordinates[i] = floor(points.coordinates[i] * GRID) / GRID;
    double sum = 0.0;
    for (int a = 0; a < FINE; ++a)
        for (int b = 0; b < FINE; ++b) {
            const double x = (a + 0.5) / FINE, y = (b + 0.5) / FINE;
            double inside = 0.0;
            for (size_t i = 0; i < 9; ++i)
                inside +=
                    points.coordinates[2 * i] < x && points.coordinates[2 * i + 1] < y ? 1.0 / 9.0 : 0.0;
            sum += (inside - x * y) * (inside - x * y);
        }
    assert_near(measured("l2-star", &points), sqrt(sum) / FINE, 1e-5);
    release_points(&points);
}

/* E of the squares over independent points: (p - c)/N with p the mean of the diagonal and c that of all
 * pairs. Five standard errors of 300 sets. */
static void random_sets_have_the_exact_expectations(void **state) {
    (void)state;
    enum { SETS = 300, COUNT = 20, DIMENSION = 3 };
    const double expected[3] = {(pow(1.0 / 2.0, DIMENSION) - pow(1.0 / 3.0, DIMENSION)) / COUNT,
                                (pow(5.0 / 4.0, DIMENSION) - pow(13.0 / 12.0, DIMENSION)) / COUNT,
                                (pow(3.0 / 2.0, DIMENSION) - pow(4.0 / 3.0, DIMENSION)) / COUNT};
    static const char *const metrics[3] = {"l2-star", "centered", "wraparound"};
    for (int m = 0; m < 3; ++m) {
        double sum = 0.0, squares = 0.0;
        for (uint64_t seed = 0; seed < SETS; ++seed) {
            test_points points = random_points(COUNT, DIMENSION, seed);
            const double value = measured(metrics[m], &points);
            sum += value * value;
            squares += value * value * value * value;
            release_points(&points);
        }
        const double mean = sum / SETS;
        assert_near(mean, expected[m], 5.0 * sqrt((squares / SETS - mean * mean) / SETS));
    }
}

static void exact_star_is_for_two_dimensions(void **state) {
    (void)state;
    test_points points = random_points(10, 3, 1);
    double value = 0.0;
    assert_int_equal(aur_measure("star", (const aur_points_view[]){seen(&points)}, NULL, &value, NULL),
                     AUR_ERROR_UNSUPPORTED);
    release_points(&points);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(star_agrees_with_all_boxes),
        cmocka_unit_test(hammersley_has_its_closed_form),
        cmocka_unit_test(the_best_points_of_the_line_have_closed_forms),
        cmocka_unit_test(l2_star_is_the_mean_over_boxes),
        cmocka_unit_test(random_sets_have_the_exact_expectations),
        cmocka_unit_test(exact_star_is_for_two_dimensions),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
