/* How large final gathering is to be, from pilots whose law is known. */
#include "check.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "ask/candidates.h"
#include "ask/gather_size.h"

static const double POWER = 1.5; /* of the errors' squares, as in gather_size.c */

/* Of an error's square a + b lights^-POWER, and rays with so many a light. */
static aur_pilot_outcome pilot(double a, double b, double others, double a_light, double lights) {
    return (aur_pilot_outcome){sqrt(a + b * pow(lights, -POWER)), others + a_light * lights};
}

static aur_gather_pattern pattern_of(double a, double b, double others, double a_light) {
    return aur_gather_pattern_of(pilot(a, b, others, a_light, AUR_PILOT_LIGHTS),
                                 pilot(a, b, others, a_light, AUR_PILOT_LIGHTS_MORE));
}

/* The pattern found takes the least time of all to an error: beside it are those of each other number of
 * lights, by the law that the pilots follow exactly. The two differ by rounding alone. */
static void lights_are_those_that_cost_least(void **state) {
    (void)state;
    static const double parts[] = {0.0, 0.01, 0.1, 1.0, 10.0, 100.0};
    double before = 0.0;
    for (size_t i = 0; i < sizeof parts / sizeof parts[0]; ++i) {
        const double a = 0.01, b = a * parts[i], others = 10.0, a_light = 0.8;
        const aur_gather_pattern found = pattern_of(a, b, others, a_light);
        assert_near(found.error, sqrt(a + b * pow(found.lights, -POWER)), 1e-12);
        const double own = found.growing * pow(found.error, 2.0 / POWER);
        for (double l = 1.0; l <= 32.0; l *= 2.0) {
            const double growing = found.growing + 0.5 * (l - found.lights) * a_light;
            assert_true(own <= growing * pow(a + b * pow(l, -POWER), 1.0 / POWER) * (1.0 + 1e-12));
        }
        assert_true(found.lights >= before);
        before = found.lights;
    }
    assert_true(pattern_of(0.01, 0.0, 10.0, 0.8).lights == 1.0);
    assert_true(before >= 8.0);
}

/* Chance may make the pilot with more lights the worse one: then they bring nothing. */
static void lights_that_make_it_worse_are_not_taken(void **state) {
    (void)state;
    const aur_gather_pattern found =
        aur_gather_pattern_of((aur_pilot_outcome){0.1, 10.0}, (aur_pilot_outcome){0.11, 16.0});
    assert_true(found.lights == 1.0);
    assert_near(found.error, 0.1, 1e-12);
}

/* Points on bright texels cost half a ray here, and leave so much of what gathering's error is. They are
 * taken where they save more than a tenth of the time, which is as the error to the power 4 / 3, if whole
 * pictures save the square of it. Then the pattern is what pilots that all draw them would tell. */
static void bright_texels_are_drawn_where_they_pay(void **state) {
    (void)state;
    const double a = 0.01, b = 0.005, others = 10.0, a_light = 0.8, draw = 0.5;
    for (double left = 0.3; left < 1.3; left += 0.05) {
        const aur_gather_pattern drawn = pattern_of(left * a, b, others + draw, a_light);
        const aur_gather_pattern plain = pattern_of(a, b, others, a_light);
        const aur_gather_pattern found =
            aur_gather_pattern_best(pilot(a, b, others, a_light, AUR_PILOT_LIGHTS),
                                    pilot(a, b, others, a_light, AUR_PILOT_LIGHTS_MORE),
                                    pilot(left * a, b, others + draw, a_light, AUR_PILOT_LIGHTS_MORE));
        const double seen = fmin(pilot(left * a, b, 0.0, 0.0, AUR_PILOT_LIGHTS_MORE).error /
                                     pilot(a, b, 0.0, 0.0, AUR_PILOT_LIGHTS_MORE).error,
                                 1.0);
        const double power = 2.0 / POWER, unseen = pow(seen, power);
        const bool pays =
            1.1 * unseen * drawn.growing * pow(drawn.error, power) < plain.growing * pow(plain.error, power);
        const aur_gather_pattern *const expected = pays ? &drawn : &plain;
        assert_true(left > 0.5 || pays);
        assert_true(left < 1.0 || !pays);
        assert_true(found.bright == (pays ? AUR_PILOT_BRIGHT : 0.0));
        assert_near(found.error, expected->error, 1e-12);
        assert_near(found.growing, expected->growing, 1e-12);
        const aur_gather_size size = aur_gather_size_of(&found, 0.1 * found.error, 0.0, 1000, 7);
        /* As many a direction as the pilot's, in whole samples of a pattern of four. */
        const size_t least = size.directions * AUR_PILOT_BRIGHT / AUR_PILOT_DIRECTIONS;
        assert_true(pays ? size.bright % 4 == 0 && size.bright + 4 > least && size.bright <= least + 4
                         : size.bright == 0);
    }
}

static void less_error_takes_larger_patterns(void **state) {
    (void)state;
    const aur_gather_pattern pattern = pattern_of(0.01, 0.05, 10.0, 0.8);
    size_t before = SIZE_MAX;
    double rays = INFINITY;
    for (double wanted = 1e-4; wanted < 1.0; wanted *= 1.3) {
        const aur_gather_size size = aur_gather_size_of(&pattern, wanted, 0.0, 1000, 7);
        assert_true(size.directions <= before && size.directions >= 2 && size.directions <= 1024);
        assert_true(size.lights >= 1);
        assert_true(aur_gather_is_shared(size.directions) ||
                    (size.directions % 4 == 0 && size.lights % 4 == 0));
        assert_true(aur_gather_rays(&pattern, wanted, 0.0) <= rays);
        before = size.directions;
        rays = aur_gather_rays(&pattern, wanted, 0.0);
    }
    assert_int_equal(before, 2);
}

/* A tenth of the error that the largest pattern leaves takes a hundred of it. */
static void many_largest_patterns_are_counted(void **state) {
    (void)state;
    const aur_gather_pattern pattern = pattern_of(1.0, 0.0, 10.0, 0.8);
    assert_int_equal(aur_gather_size_of(&pattern, 1e-3, 0.0, 1000, 7).directions, 1024);
    assert_near(aur_gather_rays(&pattern, 1e-4, 0.0) / aur_gather_rays(&pattern, 1e-3, 0.0), 100.0, 1e-9);
}

/* The square of a pattern's error falls as its size to the power 1.5. Noise and bias come to less than the
 * error by the pattern that is taken alone, and beside one that is shared there is room for what sharing
 * adds, up to a fifth of the noise. The largest pattern ends the first, the least the second. */
static void bias_leaves_room_for_less_noise(void **state) {
    (void)state;
    const aur_gather_pattern fine = pattern_of(0.01, 0.0, 10.0, 0.8),
                             coarse = pattern_of(2e-3, 0.0, 10.0, 0.8);
    double before = 0.0;
    for (double part = 0.0; part < 0.96; part += 0.05) {
        const double wanted = 0.02, b = wanted * part;
        const double alone = (double)aur_gather_size_of(&fine, wanted, b * b, 1000, 7).directions;
        const double shared = (double)aur_gather_size_of(&coarse, wanted, b * b, 1000, 7).directions;
        /* Patterns that are not shared take 1.8 times as many. */
        const double noise = fine.error * pow(AUR_PILOT_DIRECTIONS * 1.8 / alone, 0.5 * POWER);
        assert_true(alone >= before && !aur_gather_is_shared((size_t)alone));
        assert_true(noise * noise + b * b < wanted * wanted);
        before = alone;
        if (!aur_gather_is_shared((size_t)shared))
            continue;
        const double rest = coarse.error * pow(AUR_PILOT_DIRECTIONS / shared, 0.5 * POWER);
        assert_true(rest * rest + pow(b + 0.2 * rest, 2.0) < wanted * wanted);
    }
}

static void photons_cost_a_part_of_the_rays(void **state) {
    (void)state;
    size_t before = 0;
    for (double rays = 1e4; rays < 1e10; rays *= 3.0) {
        const size_t photons = aur_gather_photons(rays);
        assert_true(photons >= before && photons >= AUR_LEAST_PHOTONS && photons <= 8000000);
        assert_true(photons < 2 * AUR_LEAST_PHOTONS || aur_photon_rays((double)photons) <= 0.25 * rays);
        before = photons;
    }
    assert_int_equal(before, 8000000);
}

static void assert_text(char *text, const char *expected) {
    assert_string_equal(text, expected);
    free(text);
}

static void texts_are_those_of_keys(void **state) {
    (void)state;
    assert_text(aur_ask_gather("path:max_depth=5", (aur_gather_size){1000, 7, 9, 3, 2}),
                "finalgather:split=1,diffuse_samples=9,glossy_samples=5,light_samples=3,bright_samples=2,"
                "photons=1000,"
                "photon_seed=7,edges=108,short_rays=2,share=near,max_depth=5");
    assert_text(aur_ask_gather("path", (aur_gather_size){1000, 7, 36, 8, 0}),
                "finalgather:split=4,diffuse_samples=36,glossy_samples=20,light_samples=2,photons=1000,"
                "photon_seed=7,edges=216,short_rays=2");
    assert_text(aur_ask_path("path", 1), "path");
    assert_text(aur_ask_path("path", 2), "path:candidates=2");
    assert_text(aur_ask_path("path:max_depth=5", 4), "path:max_depth=5,candidates=4");
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(lights_are_those_that_cost_least),
                                       cmocka_unit_test(lights_that_make_it_worse_are_not_taken),
                                       cmocka_unit_test(bright_texels_are_drawn_where_they_pay),
                                       cmocka_unit_test(less_error_takes_larger_patterns),
                                       cmocka_unit_test(many_largest_patterns_are_counted),
                                       cmocka_unit_test(bias_leaves_room_for_less_noise),
                                       cmocka_unit_test(photons_cost_a_part_of_the_rays),
                                       cmocka_unit_test(texts_are_those_of_keys)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
