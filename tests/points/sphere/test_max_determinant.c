/* Points of greatest determinant: Hadamard's bound, which the tetrahedron reaches, Womersley's lower bound,
 * points that no small move improves, and weights that are positive and exact. */
#include "sphere_check.h"

enum { MOST = 36 };

static double xyz[3 * MOST], weights[MOST];

static void read(size_t count) {
    aur_directions_options options = {.size = sizeof options};
    aur_directions_options_init(count, AUR_DOMAIN_SPHERE, &options, NULL);
    aur_directions *directions;
    aur_error error = {0};
    assert_int_equal(aur_directions_create("max-determinant", &options, &directions, &error), AUR_OK);
    assert_int_equal(aur_directions_points(directions, 0, count, 3 * count, xyz, weights, &error), AUR_OK);
    aur_directions_destroy(directions);
}

static double legendre(size_t l, double t) {
    double before = 1.0, here = t;
    for (size_t k = 1; k < l; ++k) {
        const double next = ((2.0 * (double)k + 1.0) * t * here - (double)k * before) / ((double)k + 1.0);
        before = here;
        here = next;
    }
    return l == 0 ? 1.0 : here;
}

/* log det of the kernel's matrix, by elimination. */
static double log_determinant(size_t degree, const double *points) {
    static double a[MOST][MOST];
    const size_t n = (degree + 1) * (degree + 1);
    double sum = 0.0;
    for (size_t i = 0; i < n; ++i)
        for (size_t j = 0; j < n; ++j) {
            a[i][j] = 0.0;
            for (size_t l = 0; l <= degree; ++l)
                a[i][j] += (2.0 * (double)l + 1.0) / (4.0 * AUR_PI) *
                           legendre(l, check_dot(points + 3 * i, points + 3 * j));
        }
    for (size_t k = 0; k < n; ++k) {
        sum += log(a[k][k]);
        for (size_t i = k + 1; i < n; ++i)
            for (size_t j = n; j-- > k;)
                a[i][j] -= a[i][k] / a[k][k] * a[k][j];
    }
    return sum;
}

static void bounds(void **state) {
    (void)state;
    for (size_t degree = 1; degree <= 5; ++degree) {
        const size_t n = (degree + 1) * (degree + 1);
        read(n);
        const double found = log_determinant(degree, xyz);
        const double hadamard = (double)n * log((double)n / (4.0 * AUR_PI));
        const double lowest = lgamma((double)n + 1.0) - (double)n * log(4.0 * AUR_PI);
        assert_true(found > lowest && found < hadamard + 1e-12);
        assert_true(degree > 1 || found > hadamard - 1e-12);
        /* Moves of a thousandth lose by their square, and never gain. */
        for (size_t attempt = 0; attempt < 20; ++attempt) {
            double moved[3 * MOST];
            for (size_t i = 0; i < n; ++i) {
                double u[3], square = 0.0;
                check_random_direction(attempt, i, u);
                for (size_t d = 0; d < 3; ++d) {
                    moved[3 * i + d] = xyz[3 * i + d] + 1e-3 * u[d];
                    square += moved[3 * i + d] * moved[3 * i + d];
                }
                for (size_t d = 0; d < 3; ++d)
                    moved[3 * i + d] /= sqrt(square);
            }
            assert_true(log_determinant(degree, moved) < found);
        }
    }
}

/* All sums of w_i w_j P_l(x_i . x_j) vanish to the degree, and the weights are positive. */
static void weights_are_exact(void **state) {
    (void)state;
    for (size_t degree = 1; degree <= 5; ++degree) {
        const size_t n = (degree + 1) * (degree + 1);
        read(n);
        for (size_t l = 0; l <= degree; ++l) {
            double sum = 0.0;
            for (size_t i = 0; i < n; ++i)
                for (size_t j = 0; j < n; ++j)
                    sum += weights[i] * weights[j] * legendre(l, check_dot(xyz + 3 * i, xyz + 3 * j));
            assert_near(sum, l == 0 ? 1.0 : 0.0, 1e-14);
        }
        for (size_t i = 0; i < n; ++i)
            assert_true(weights[i] > 0.5 / (double)n && weights[i] < 1.7 / (double)n);
    }
}

static void other_sizes_are_refused(void **state) {
    (void)state;
    for (size_t count = 1; count < 40; ++count) {
        aur_directions_options options = {.size = sizeof options};
        aur_directions_options_init(count, AUR_DOMAIN_SPHERE, &options, NULL);
        aur_directions *directions = NULL;
        const bool has = count == 4 || count == 9 || count == 16 || count == 25 || count == 36;
        if (!has)
            assert_int_equal(aur_directions_create("max-determinant", &options, &directions, NULL),
                             AUR_ERROR_ARGUMENT);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(bounds), cmocka_unit_test(weights_are_exact),
                                       cmocka_unit_test(other_sizes_are_refused)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
