#include "check.h"

#include "sphere_sets.h"
#include "square_sets.h"

static aur_series *table_to(double accuracy, const char *metric, const test_points *points, size_t threads) {
    const aur_measure_options options = {.size = sizeof options, .threads = threads, .accuracy = accuracy};
    aur_series *series;
    aur_error error = {0};
    assert_int_equal(
        aur_measure_series(metric, (const aur_points_view[]){seen(points)}, &options, &series, &error),
        AUR_OK);
    return series;
}

static aur_series *table(const char *metric, const test_points *points, size_t threads) {
    return table_to(0.0, metric, points, threads);
}

/* |sum w e^{-2 pi i k.x}|^2 / sum w^2 at every frequency, term by term. */
static void the_periodogram_is_the_transform(void **state) {
    (void)state;
    for (int weighted = 0; weighted < 2; ++weighted) {
        test_points points = random_points(300, 2, 4);
        double squares = 300.0;
        if (weighted) {
            squares = 0.0;
            points.weights = malloc(300 * sizeof(double));
            for (size_t i = 0; i < 300; ++i) {
                points.weights[i] = 0.5 + aur_unit_double(aur_hash2(6, i));
                squares += points.weights[i] * points.weights[i];
            }
        }
        aur_series *series = table("periodogram:7", &points, 0);
        assert_int_equal(aur_series_row_count(series), 15 * 15);
        double ring_sum = 0.0, ring_count = 0.0;
        for (size_t r = 0; r < aur_series_row_count(series); ++r) {
            const double *const row = aur_series_values(series) + 3 * r;
            double re = 0.0, im = 0.0;
            for (size_t i = 0; i < points.count; ++i) {
                const double angle =
                    2.0 * AUR_PI *
                    (row[0] * points.coordinates[2 * i] + row[1] * points.coordinates[2 * i + 1]);
                const double weight = weighted ? points.weights[i] : 1.0;
                re += weight * cos(angle);
                im += weight * sin(angle);
            }
            assert_near(row[2], (re * re + im * im) / squares, 1e-9);
            if (floor(hypot(row[0], row[1]) + 0.5) == 4.0) {
                ring_sum += row[2];
                ring_count += 1.0;
            }
        }
        aur_series_destroy(series);
        series = table("spectrum:7", &points, 0);
        assert_int_equal(aur_series_row_count(series), 7);
        assert_near(aur_series_values(series)[3 * 3], 4.0, 0.0);
        assert_near(aur_series_values(series)[3 * 3 + 1], ring_sum / ring_count, 1e-9);
        aur_series_destroy(series);
        release_points(&points);
    }
}

/* A grid has all its power at multiples of its frequency. */
static void a_grid_has_lines(void **state) {
    (void)state;
    test_points points = cube_points(64, 2);
    for (size_t i = 0; i < 64; ++i) {
        points.coordinates[2 * i] = (double)(i % 8) / 8.0;
        points.coordinates[2 * i + 1] = (double)(i / 8) / 8.0;
    }
    aur_series *series = table("periodogram:9", &points, 0);
    for (size_t r = 0; r < aur_series_row_count(series); ++r) {
        const double *const row = aur_series_values(series) + 3 * r;
        const int line = fmod(row[0], 8.0) == 0.0 && fmod(row[1], 8.0) == 0.0;
        assert_near(row[2], line ? 64.0 : 0.0, 1e-9);
    }
    aur_series_destroy(series);
    release_points(&points);
}

/* The addition theorem: S_l is the sum of w_i w_j P_l(x_i.x_j) over sum w^2. */
static void the_angular_spectrum_is_the_sum_of_legendre_polynomials(void **state) {
    (void)state;
    enum { COUNT = 150, DEGREES = 60 };
    test_points points = random_directions(COUNT, 8);
    points.coordinates[0] = points.coordinates[1] = 0.0;
    points.coordinates[2] = -1.0;
    points.weights = malloc(COUNT * sizeof(double));
    double squares = 0.0;
    double expected[DEGREES + 1] = {0};
    for (size_t i = 0; i < COUNT; ++i) {
        points.weights[i] = 0.5 + aur_unit_double(aur_hash2(6, i));
        squares += points.weights[i] * points.weights[i];
    }
    for (size_t i = 0; i < COUNT; ++i)
        for (size_t j = 0; j < COUNT; ++j) {
            const double *const p = points.coordinates + 3 * i, *const q = points.coordinates + 3 * j;
            const double t = p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
            double before = 1.0, here = t;
            for (int l = 1; l <= DEGREES; ++l) {
                expected[l] += points.weights[i] * points.weights[j] * here / squares;
                const double next = ((2.0 * l + 1.0) * t * here - l * before) / (l + 1.0);
                before = here;
                here = next;
            }
        }
    aur_series *series = table("spectrum:60", &points, 1);
    aur_series *same = table("spectrum:60", &points, 2);
    assert_int_equal(aur_series_row_count(series), DEGREES);
    for (int l = 1; l <= DEGREES; ++l)
        assert_near(aur_series_values(series)[2 * (l - 1) + 1], expected[l], 1e-9 * (1.0 + expected[l]));
    assert_memory_equal(aur_series_values(series), aur_series_values(same), 2 * DEGREES * sizeof(double));
    aur_series_destroy(series);
    aur_series_destroy(same);
    release_points(&points);
}

/* E^2 is the sum over l of 4 / ((2l-1)(2l+3)) S_l / N; for degrees beyond the last S_l is near 1. */
static void the_spectrum_adds_up_to_the_energy(void **state) {
    (void)state;
    test_points points = spherical_fibonacci(100, AUR_DOMAIN_SPHERE);
    aur_series *series = table("spectrum:1000", &points, 0);
    double sum = 0.0;
    for (size_t r = 0; r < aur_series_row_count(series); ++r) {
        const double l = aur_series_values(series)[2 * r];
        sum += 4.0 / ((2.0 * l - 1.0) * (2.0 * l + 3.0)) * aur_series_values(series)[2 * r + 1] / 100.0;
    }
    const double energy = measured("energy", &points);
    assert_relative(sum + 1.0 / 1001.0 / 100.0, energy * energy, 2e-3);
    aur_series_destroy(series);
    release_points(&points);
}

/* Powers by a grid equal those summed point by point, within the tolerance; bits do not depend on threads.
 * Without an error guarantee, powers are summed point by point. */
static void grids_reach_the_target_accuracy(void **state) {
    (void)state;
    enum { N = 1500 };
    test_points sets[3] = {random_points(N, 2, 4), random_points(N, 2, 5), random_directions(N, 6)};
    sets[1].weights = malloc(N * sizeof(double));
    for (size_t i = 0; i < N; ++i)
        sets[1].weights[i] = aur_unit_double(aur_hash2(6, i)) - 0.25;
    sets[1].coordinates[0] = 0.0;
    sets[1].coordinates[3] = 1.0; /* the same position as 0 */
    static const char *const metrics[3] = {"periodogram:33", "periodogram:64", "spectrum:70"};
    for (size_t s = 0; s < 3; ++s) {
        const double accuracy = 4e-9;
        aur_series *const plain = table(metrics[s], &sets[s], 0);
        aur_series *const one = table_to(accuracy, metrics[s], &sets[s], 1);
        aur_series *const three = table_to(accuracy, metrics[s], &sets[s], 3);
        aur_series *const strict = table_to(1e-12, metrics[s], &sets[s], 0);
        const size_t columns = aur_series_column_count(plain);
        const size_t size = columns * aur_series_row_count(plain);
        double worst = 0.0;
        for (size_t r = columns - 1; r < size; r += columns) {
            const double power = aur_series_values(plain)[r];
            worst = fmax(worst, fabs(aur_series_values(one)[r] - power) / fmax(power, 1.0));
        }
        assert_true(worst > 0.0 && worst <= accuracy);
        assert_int_equal(aur_series_row_count(one), aur_series_row_count(plain));
        assert_memory_equal(aur_series_values(one), aur_series_values(three), size * sizeof(double));
        assert_memory_equal(aur_series_values(strict), aur_series_values(plain), size * sizeof(double));
        aur_series_destroy(plain);
        aur_series_destroy(one);
        aur_series_destroy(three);
        aur_series_destroy(strict);
        release_points(&sets[s]);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_periodogram_is_the_transform),
        cmocka_unit_test(a_grid_has_lines),
        cmocka_unit_test(the_angular_spectrum_is_the_sum_of_legendre_polynomials),
        cmocka_unit_test(the_spectrum_adds_up_to_the_energy),
        cmocka_unit_test(grids_reach_the_target_accuracy),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
