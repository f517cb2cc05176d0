#include "sphere_check.h"

#include <string.h>

#include "points/sphere/sets/reference.h"

enum { AXES = 64 };

/* The mean of Legendre's polynomial P_l(axis . x), 0 where the points are exact for degree l > 0. */
static double legendre_mean(size_t degree, const double axis[3], size_t count, const double *xyz,
                            const double *weights) {
    double sum = 0.0;
    for (size_t i = 0; i < count; ++i) {
        const double cosine = check_dot(axis, xyz + 3 * i);
        double before = 1.0, here = cosine;
        for (size_t l = 1; l < degree; ++l) {
            const double k = (double)l;
            const double after = ((2.0 * k + 1.0) * cosine * here - k * before) / (k + 1.0);
            before = here;
            here = after;
        }
        sum += weights[i] * here;
    }
    return sum;
}

static double worst_mean(size_t degree, size_t count, const double *xyz, const double *weights) {
    double worst = 0.0;
    for (size_t a = 0; a < AXES; ++a) {
        double axis[3];
        check_random_direction(19, a, axis);
        worst = fmax(worst, fabs(legendre_mean(degree, axis, count, xyz, weights)));
    }
    return worst;
}

/* The scripts accept harmonics' means of 1e-13 (of length one in the mean); by Cauchy and Schwarz a mean of
 * P_l is smaller by sqrt(2 l + 1), which leaves room for rounding. One degree more is not exact. */
static void check_exact(const char *set, const aur_reference *reference) {
    const size_t count = reference->count;
    aur_directions_options options = {.size = sizeof options};
    aur_directions_options_init(count, AUR_DOMAIN_SPHERE, &options, NULL);
    aur_directions *directions;
    assert_int_equal(aur_directions_create(set, &options, &directions, NULL), AUR_OK);
    double *const xyz = malloc(3 * count * sizeof *xyz), *const weights = malloc(count * sizeof *weights);
    assert_non_null(xyz);
    assert_non_null(weights);
    assert_int_equal(aur_directions_points(directions, 0, count, 3 * count, xyz, weights, NULL), AUR_OK);
    double sum = 0.0;
    for (size_t i = 0; i < count; ++i) {
        assert_near(check_dot(xyz + 3 * i, xyz + 3 * i), 1.0, 1e-15);
        assert_true(weights[i] > 0.0);
        sum += weights[i];
    }
    assert_near(sum, 1.0, 1e-13);
    for (size_t l = 1; l <= reference->degree; ++l)
        assert_near(worst_mean(l, count, xyz, weights), 0.0, 1e-13);
    assert_true(worst_mean(reference->degree + 1u, count, xyz, weights) > 1e-4);
    assert_true(check_smallest_distance(count, xyz) > 1.0 / sqrt((double)count));

    /* A part of the set is the same points and weights. */
    double part[6], part_weights[2];
    assert_int_equal(aur_directions_points(directions, count - 2, 2, 6, part, part_weights, NULL), AUR_OK);
    assert_memory_equal(part, xyz + 3 * (count - 2), sizeof part);
    assert_memory_equal(part_weights, weights + count - 2, sizeof part_weights);
    aur_directions_destroy(directions);
    free(xyz);
    free(weights);
}

static void designs_are_exact(void **state) {
    (void)state;
    for (size_t r = 0; r < AUR_T_DESIGN_COUNT; ++r)
        check_exact("t-design", aur_t_designs + r);
}

static void lebedev_rules_are_exact(void **state) {
    (void)state;
    for (size_t r = 0; r < AUR_LEBEDEV_COUNT; ++r)
        check_exact("lebedev", aur_lebedev_rules + r);
}

/* Weights of the rule with 14 points: 1/15 on the axes and 3/40 on the diagonals of the cube. */
static void fourteen_points_have_known_weights(void **state) {
    (void)state;
    aur_directions_options options = {.size = sizeof options};
    aur_directions_options_init(14, AUR_DOMAIN_SPHERE, &options, NULL);
    aur_directions *directions;
    assert_int_equal(aur_directions_create("lebedev", &options, &directions, NULL), AUR_OK);
    double xyz[42], weights[14];
    assert_int_equal(aur_directions_points(directions, 0, 14, 42, xyz, weights, NULL), AUR_OK);
    for (size_t i = 0; i < 14; ++i) {
        const bool on_axis = fabs(xyz[3 * i]) + fabs(xyz[3 * i + 1]) + fabs(xyz[3 * i + 2]) < 1.1;
        assert_near(weights[i], on_axis ? 1.0 / 15.0 : 3.0 / 40.0, 1e-15);
    }
    aur_directions_destroy(directions);
}

static void other_sizes_are_refused(void **state) {
    (void)state;
    static const struct {
        const char *set;
        uint64_t count;
        const char *nearest;
    } wrong[] = {{"lebedev", 100, "86 or 110"},
                 {"lebedev", 5, "from 6"},
                 {"t-design", 17, "8 or 18"},
                 {"t-design", 1, "from 4"}};
    for (size_t k = 0; k < sizeof wrong / sizeof wrong[0]; ++k) {
        aur_directions_options options = {.size = sizeof options};
        aur_directions_options_init(wrong[k].count, AUR_DOMAIN_SPHERE, &options, NULL);
        aur_directions *directions;
        aur_error error = {0};
        assert_int_equal(aur_directions_create(wrong[k].set, &options, &directions, &error),
                         AUR_ERROR_ARGUMENT);
        assert_non_null(strstr(error.message, wrong[k].nearest));
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(designs_are_exact),
        cmocka_unit_test(lebedev_rules_are_exact),
        cmocka_unit_test(fourteen_points_have_known_weights),
        cmocka_unit_test(other_sizes_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
