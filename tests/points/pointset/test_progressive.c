/* Sets of 2018 to 2021 against brute force: pmj02, cascaded Sobol' points, sliced optimal transport. */
#include "points.h"

#include <math.h>

#include "points/base/vector.h"

static aur_pointset_options options_of(uint64_t count, size_t dimension) {
    return (aur_pointset_options){
        .size = sizeof(aur_pointset_options), .count = count, .dimension = dimension};
}

/* Every power of 2 of the first points is a net, from any seed; smaller sets are the first points of larger
 * ones. */
static void prefixes_of_pmj02_are_nets(void **state) {
    (void)state;
    enum { DIGITS = 12 };
    double *before = NULL;
    for (uint64_t seed = 0; seed < 8; ++seed) {
        aur_pointset_options options = options_of((uint64_t)1 << DIGITS, 2);
        options.seed = seed;
        double *const points = make_points("pmj02", options);
        for (unsigned m = 0; m <= DIGITS; ++m)
            assert_true(is_net(2, m, points, 2, 0, 1));
        options.count = 300;
        double *const fewer = make_points("pmj02", options);
        assert_memory_equal(points, fewer, 600 * sizeof *points);
        free(fewer);
        assert_true(before == NULL || points[0] != before[0]);
        free(before);
        before = points;
    }
    free(before);
}

/* Neighbouring coordinates form nets in any dimension, unlike those of Sobol's points. */
static void neighbours_of_cascaded_points_are_nets(void **state) {
    (void)state;
    enum { DIGITS = 10, DIMENSION = 40 };
    aur_pointset_options options = options_of(1 << DIGITS, DIMENSION);
    double *const sobol = make_points("sobol", options);
    size_t bad = 0;
    for (size_t d = 0; d + 1 < DIMENSION; ++d)
        bad += !is_net(2, DIGITS, sobol, DIMENSION, d, d + 1);
    assert_true(bad > DIMENSION / 2);
    free(sobol);
    for (int scrambled = 0; scrambled < 2; ++scrambled) {
        options.scramble = scrambled != 0 ? AUR_SCRAMBLE_OWEN : AUR_SCRAMBLE_NONE;
        double *const points = make_points("cascaded", options);
        for (size_t d = 0; d + 1 < DIMENSION; ++d)
            assert_true(is_net(2, DIGITS, points, DIMENSION, d, d + 1));
        /* The first coordinate counts as van der Corput does, and the second is Sobol's at that index. */
        assert_true(scrambled != 0 || (points[DIMENSION] == 0.5 && points[2 * DIMENSION] == 0.25));
        free(points);
    }
}

/* The mean over points of the distance to the nearest other one, on the torus. */
static double mean_distance(size_t count, const double *points) {
    double sum = 0.0;
    for (size_t i = 0; i < count; ++i) {
        double least = 2.0;
        for (size_t j = 0; j < count; ++j) {
            double square = 0.0;
            for (size_t d = 0; d < 2; ++d) {
                const double a = fabs(points[2 * i + d] - points[2 * j + d]);
                square += fmin(a, 1.0 - a) * fmin(a, 1.0 - a);
            }
            least = j != i ? fmin(least, sqrt(square)) : least;
        }
        sum += least / (double)count;
    }
    return sum;
}

/* Optimised flips preserve the nets, and neighbours are farther apart than in any of 20 random scramblings.
 */
static void owen_trees_preserve_nets_and_distances(void **state) {
    (void)state;
    enum { DIGITS = 8, N = 1 << DIGITS };
    double drawn = 0.0;
    for (uint64_t seed = 0; seed < 20; ++seed) {
        aur_pointset_options options = options_of(N, 2);
        options.seed = seed;
        options.scramble = AUR_SCRAMBLE_OWEN;
        double *const points = make_points("sobol", options);
        drawn = fmax(drawn, mean_distance(N, points));
        free(points);
    }
    for (uint64_t seed = 0; seed < 3; ++seed) {
        aur_pointset_options options = options_of(N, 2);
        options.seed = seed;
        double *const points = make_points("owen-tree", options);
        for (unsigned m = 0; m <= DIGITS; ++m)
            assert_true(is_net(2, m, points, 2, 0, 1));
        assert_true(mean_distance(N, points) > drawn);
        free(points);
    }
}

static int ascending(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The mean square between projections on 32 directions and those of a fine grid. */
static double sliced_distance(const char *set) {
    enum { N = 256, FINE = 16 };
    double *const points = make_points(set, options_of(N, 2));
    static double fine[N * FINE * FINE], ours[N];
    double sum = 0.0;
    for (int k = 0; k < 32; ++k) {
        const double c = cos(AUR_PI * (k + 0.3) / 32), s = sin(AUR_PI * (k + 0.3) / 32);
        const size_t side = 16 * FINE;
        for (size_t i = 0; i < side * side; ++i)
            fine[i] =
                c * ((double)(i % side) + 0.5) / (double)side + s * ((double)(i / side) + 0.5) / (double)side;
        for (size_t i = 0; i < N; ++i)
            ours[i] = c * points[2 * i] + s * points[2 * i + 1];
        qsort(fine, side * side, sizeof *fine, ascending);
        qsort(ours, N, sizeof *ours, ascending);
        for (size_t i = 0; i < side * side; ++i)
            sum += pow(fine[i] - ours[i / (FINE * FINE)], 2) / (double)(side * side) / 32;
    }
    free(points);
    return sqrt(sum);
}

/* No other set here has projections that are as near to uniform ones. */
static void slices_are_even(void **state) {
    (void)state;
    static const char *const others[] = {"sobol", "bnot", "jittered", "pmj02"};
    const double distance = sliced_distance("sliced");
    for (size_t k = 0; k < sizeof others / sizeof others[0]; ++k)
        assert_true(distance < sliced_distance(others[k]));
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(prefixes_of_pmj02_are_nets),
                                       cmocka_unit_test(neighbours_of_cascaded_points_are_nets),
                                       cmocka_unit_test(owen_trees_preserve_nets_and_distances),
                                       cmocka_unit_test(slices_are_even)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
