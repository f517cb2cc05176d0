#include "check.h"

#include <aureole/sphere.h>
#include <math.h>
#include <stdlib.h>

static double *points_of(const char *set, size_t count, aur_domain domain) {
    aur_directions_options options = {.size = sizeof options};
    aur_directions_options_init(count, domain, &options, NULL);
    double *const xyz = malloc(3 * count * sizeof *xyz);
    aur_directions *directions = NULL;
    aur_error error = {0};
    if (aur_directions_create(set, &options, &directions, &error) != AUR_OK ||
        aur_directions_points(directions, 0, count, 3 * count, xyz, NULL, &error) != AUR_OK)
        fail_msg("%s", error.message);
    aur_directions_destroy(directions);
    return xyz;
}

static double distance(const double *a, const double *b, double sign) {
    double square = 0.0;
    for (size_t d = 0; d < 3; ++d)
        square += (a[d] - sign * b[d]) * (a[d] - sign * b[d]);
    return sqrt(square);
}

/* No candidate is farther from all before than the point chosen; the candidates are a spherical Fibonacci
 * set. */
static void each_point_is_the_farthest(void **state) {
    (void)state;
    enum { N = 20, CANDIDATES = 1 << 16 };
    for (int axes = 0; axes < 2; ++axes) {
        const aur_domain domain = axes ? AUR_DOMAIN_AXES : AUR_DOMAIN_SPHERE;
        double *const candidates = points_of("spherical-fibonacci", CANDIDATES, domain);
        double *const xyz = points_of("greedy", N, domain);
        for (size_t n = 1; n < N; ++n) {
            double chosen = 0.0, most = 0.0;
            for (size_t c = 0; c <= CANDIDATES; ++c) {
                const double *const x = c < CANDIDATES ? candidates + 3 * c : xyz + 3 * n;
                double sum = 0.0;
                for (size_t j = 0; j < n; ++j)
                    sum += distance(x, xyz + 3 * j, 1.0) + (axes ? distance(x, xyz + 3 * j, -1.0) : 0.0);
                if (c < CANDIDATES)
                    most = fmax(most, sum);
                else
                    chosen = sum;
            }
            assert_near(chosen, most, 1e-6); /* distances of nearly opposite ends have half the digits */
        }
        free(candidates);
        free(xyz);
    }
}

/* E_n n^(3/4) of every prefix is below 1.12 (spirals of their own size have .90, random points 1.15 n^(1/4)),
 * and a smaller set is the beginning of a larger one. */
static void every_prefix_is_good(void **state) {
    (void)state;
    enum { N = 1024 };
    double *const xyz = points_of("greedy", N, AUR_DOMAIN_SPHERE);
    double sum = 0.0;
    for (size_t i = 0; i < N; ++i) {
        for (size_t j = 0; j < i; ++j)
            sum += 2.0 * distance(xyz + 3 * i, xyz + 3 * j, 1.0);
        const double n = (double)(i + 1);
        if (i >= 15)
            assert_true(sqrt(4.0 / 3.0 - sum / (n * n)) * pow(n, 0.75) < 1.12);
    }
    double *const few = points_of("greedy", 100, AUR_DOMAIN_SPHERE);
    assert_memory_equal(few, xyz, 300 * sizeof *few);
    free(few);
    free(xyz);
}

static void caps_are_refused(void **state) {
    (void)state;
    aur_directions_options options = {.size = sizeof options};
    aur_directions_options_init(10, AUR_DOMAIN_HEMISPHERE, &options, NULL);
    aur_directions *directions;
    assert_int_equal(aur_directions_create("greedy", &options, &directions, NULL), AUR_ERROR_UNSUPPORTED);
    options.size = sizeof(aur_directions_options);
    aur_directions_options_init(16385, AUR_DOMAIN_SPHERE, &options, NULL);
    assert_int_equal(aur_directions_create("greedy", &options, &directions, NULL), AUR_ERROR_ARGUMENT);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(each_point_is_the_farthest),
                                       cmocka_unit_test(every_prefix_is_good),
                                       cmocka_unit_test(caps_are_refused)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
