#include "sphere_check.h"

#include <string.h>

static aur_lobe parse(const char *text) {
    aur_lobe lobe;
    aur_error error = {0};
    if (aur_lobe_parse(text, &lobe, &error) != AUR_OK)
        fail_msg("%s: %s", text, error.message);
    return lobe;
}

static const char *const lobes[] = {"uniform",   "cosine",  "phong:0.3",  "phong:20",
                                    "phong:777", "ggx:0.3", "ggx:0.6:50", "ggx:0.2:70"};
enum { LOBE_COUNT = 8 };

static void texts_become_lobes(void **state) {
    (void)state;
    assert_true(parse("cosine").exponent == 1.0);
    assert_true(parse("phong:2.5").exponent == 2.5);
    const aur_lobe visible = parse("visible:0.2:30");
    assert_true(visible.kind == AUR_LOBE_VISIBLE && visible.alpha == 0.2 && visible.view_degrees == 30.0);
    const aur_lobe ggx = parse("ggx:0.2:30");
    const double at[3] = {0.6, 0.0, 0.8};
    assert_true(aur_lobe_pdf(&visible, at) == aur_lobe_pdf(&ggx, at));
    assert_true(ggx.kind == AUR_LOBE_GGX && ggx.alpha == 0.2 && ggx.view_degrees == 30.0);
    static const char *const wrong[] = {"",          "phong",     "phong:",    "phong:-1",   "phong:nan",
                                        "phong:inf", "phong:1:2", "ggx:0",     "ggx:0.5:90", "ggx:0.5:x",
                                        "ggx:2",     "cosine:1",  "phong:1e10"};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; ++i) {
        aur_lobe lobe;
        aur_error error = {0};
        assert_int_not_equal(aur_lobe_parse(wrong[i], &lobe, &error), AUR_OK);
        assert_true(strlen(error.message) > 0);
    }
}

/* z' = z^{1/(M+1)} at the same azimuth. */
static void cosine_power_warps_by_a_root(void **state) {
    (void)state;
    for (size_t l = 0; l < 5; ++l) {
        const aur_lobe lobe = parse(lobes[l]);
        for (uint64_t i = 0; i < 200; ++i) {
            double from[3], to[3];
            check_random_direction(3, i, from);
            from[2] = fabs(from[2]);
            aur_lobe_warp(&lobe, 1, from, to);
            assert_near(to[2], pow(from[2], 1.0 / (lobe.exponent + 1.0)), 2e-15);
            assert_near(to[0] * from[1] - to[1] * from[0], 0.0, 1e-15);
            assert_near(check_dot(to, to), 1.0, 1e-14);
        }
        double to[3];
        aur_lobe_warp(&lobe, 1, (const double[3]){0, 0, 1}, to);
        assert_true(to[0] == 0.0 && to[1] == 0.0 && to[2] == 1.0);
        aur_lobe_warp(&lobe, 1, (const double[3]){0.6, 0.8, 0.0}, to);
        assert_near(to[0], 0.6, 1e-15);
        assert_near(to[2], 0.0, 0);
    }
}

static void inverses_round_trip(void **state) {
    (void)state;
    for (size_t l = 0; l < LOBE_COUNT; ++l) {
        const aur_lobe lobe = parse(lobes[l]);
        const double tolerance = lobe.kind == AUR_LOBE_GGX ? 1e-8 : 1e-12;
        for (uint64_t i = 0; i < 500; ++i) {
            double from[3], to[3], back[3];
            check_random_direction(5, i, from);
            from[2] = fabs(from[2]);
            aur_lobe_warp(&lobe, 1, from, to);
            aur_lobe_unwarp(&lobe, 1, to, back);
            assert_near(check_distance(from, back), 0.0, tolerance);
        }
    }
}

/* The warp is what the density says: by Monte Carlo the share of warped points in a random cap against the
 * integral of the density over it (midpoint rule, whose error is below 3e-3:
 * the horizon cuts cells). With 40000 points one standard
 * error is at most 0.0025; five of them are exceeded by chance less than once in a million. */
static void warps_follow_their_densities(void **state) {
    (void)state;
    enum { POINTS = 40000, SIDE = 600 };
    for (size_t l = 0; l < LOBE_COUNT; ++l) {
        const aur_lobe lobe = parse(lobes[l]);
        double axis[3];
        aur_lobe_warp(&lobe, 1, (const double[3]){0.28, 0.0, 0.96}, axis);
        const double threshold = lobe.exponent > 100.0 ? 0.999 : 0.9;
        double inside = 0.0;
        for (uint64_t i = 0; i < POINTS; ++i) {
            double from[3], to[3];
            check_random_direction(11, i, from);
            from[2] = fabs(from[2]);
            aur_lobe_warp(&lobe, 1, from, to);
            inside += check_dot(to, axis) > threshold ? 1.0 / POINTS : 0.0;
        }
        double integral = 0.0, all = 0.0;
        for (size_t i = 0; i < (size_t)SIDE * SIDE; ++i) {
            /* finer about the pole, where lobes are narrow: u = a^3 */
            const double a = ((double)(i % SIDE) + 0.5) / SIDE;
            const double square[2] = {a * a * a, ((double)(i / SIDE) + 0.5) / SIDE};
            double direction[3];
            aur_map_to_cap(AUR_MAP_LAMBERT, AUR_CAP_SPHERE, 1, square, direction, NULL);
            const double part =
                aur_lobe_pdf(&lobe, direction) * 4.0 * AUR_PI * 3.0 * a * a / ((double)SIDE * SIDE);
            all += part;
            integral += check_dot(direction, axis) > threshold ? part : 0.0;
        }
        assert_near(all, 1.0, 3e-3);
        assert_true(integral > 0.02 && integral < 0.999);
        assert_near(inside, integral, 0.0125 + 3e-3);
    }
}

static void optimal_density_is_a_power(void **state) {
    (void)state;
    const aur_lobe lobe = parse("phong:20");
    aur_lobe density;
    assert_int_equal(aur_lobe_optimal(&lobe, 1.5, &density, NULL), AUR_OK);
    assert_near(density.exponent, 16.0, 1e-14);
    aur_error error = {0};
    assert_int_equal(aur_lobe_optimal(&lobe, 6.0, &density, &error), AUR_ERROR_ARGUMENT);
    assert_int_equal(aur_lobe_optimal(&lobe, NAN, &density, &error), AUR_ERROR_ARGUMENT);
    const aur_lobe ggx = parse("ggx:0.4");
    assert_int_equal(aur_lobe_optimal(&ggx, 1.5, &density, &error), AUR_ERROR_UNSUPPORTED);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(texts_become_lobes),         cmocka_unit_test(cosine_power_warps_by_a_root),
        cmocka_unit_test(inverses_round_trip),        cmocka_unit_test(warps_follow_their_densities),
        cmocka_unit_test(optimal_density_is_a_power),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
