/* How large final gathering is to be, by a law. */
#include "check.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "render/adaptive/comparison.h"
#include "render/adaptive/gather_size.h"

/* Squares by 4 directions and by one point on lights, which falls as points^-1.5. */
static aur_gather_model model_of(double gather, double lights) {
    return (aur_gather_model){.gather = gather,
                              .power = 1.5,
                              .lights = {lights, lights * pow(8.0, -1.5), lights * pow(32.0, -1.5)},
                              .fixed = 2.0,
                              .direction = 2.0,
                              .light = 0.4};
}

static void less_error_takes_larger_patterns(void **state) {
    (void)state;
    const aur_gather_model model = model_of(0.01, 0.05);
    size_t before = SIZE_MAX;
    double rays = INFINITY;
    for (double wanted = 1e-4; wanted < 1.0; wanted *= 1.3) {
        const aur_gather_size size = aur_gather_size_of(&model, wanted, 0.0, 1000, 7);
        assert_true(size.directions <= before && size.directions >= 2 && size.directions <= 1024);
        assert_true(size.lights >= 1);
        assert_true(aur_gather_is_shared(size.directions) ||
                    (size.directions % 4 == 0 && size.lights % 4 == 0));
        assert_true(aur_gather_rays(&model, wanted, 0.0) <= rays);
        before = size.directions;
        rays = aur_gather_rays(&model, wanted, 0.0);
    }
    assert_int_equal(before, 2);
}

/* A tenth of the error that the largest pattern leaves takes a hundred of it. */
static void many_largest_patterns_are_counted(void **state) {
    (void)state;
    const aur_gather_model model = model_of(1.0, 0.0);
    assert_int_equal(aur_gather_size_of(&model, 1e-3, 0.0, 1000, 7).directions, 1024);
    assert_near(aur_gather_rays(&model, 1e-4, 0.0) / aur_gather_rays(&model, 1e-3, 0.0), 100.0, 1e-9);
}

/* The square of a pattern's error falls as its size to the power 1.5. Noise and bias come to less than the
 * error by the pattern that is taken alone, and beside one that is shared there is room for what sharing
 * adds, up to a fifth of the noise. The largest pattern ends the first, the least the second. */
static void bias_leaves_room_for_less_noise(void **state) {
    (void)state;
    const aur_gather_model fine = model_of(0.01, 0.0), coarse = model_of(2e-3, 0.0);
    double before = 0.0;
    for (double part = 0.0; part < 0.96; part += 0.05) {
        const double wanted = 0.02, b = wanted * part;
        const double alone = (double)aur_gather_size_of(&fine, wanted, b * b, 1000, 7).directions;
        const double shared = (double)aur_gather_size_of(&coarse, wanted, b * b, 1000, 7).directions;
        /* Patterns that are not shared take 1.8 times as many. */
        const double noise = sqrt(fine.gather * pow(AUR_PILOT_DIRECTIONS * 1.8 / alone, fine.power));
        assert_true(alone >= before && !aur_gather_is_shared((size_t)alone));
        assert_true(noise * noise + b * b < wanted * wanted);
        before = alone;
        if (!aur_gather_is_shared((size_t)shared))
            continue;
        const double rest = sqrt(coarse.gather * pow(AUR_PILOT_DIRECTIONS / shared, coarse.power));
        assert_true(rest * rest + pow(b + 0.2 * rest, 2.0) < wanted * wanted);
    }
}

/* One sample's pattern is shared, unless it leaves too much of where its camera ray is, or pixels stand out.
 */
static void patterns_are_shared_where_one_sample_does(void **state) {
    (void)state;
    aur_gather_model model = model_of(2e-3, 0.0);
    const double wanted = 0.02, noise = 0.92 * wanted / sqrt(1.04); /* beside a fifth of it by sharing */
    assert_true(aur_gather_is_shared(aur_gather_size_of(&model, wanted, 0.0, 1000, 7).directions));
    model.camera = 0.74 * noise * noise;
    const aur_gather_size most = aur_gather_size_of(&model, 2.0 * wanted, 0.0, 1000, 7);
    assert_true(aur_gather_is_shared(most.directions));
    model.camera = 0.76 * noise * noise;
    assert_false(aur_gather_is_shared(aur_gather_size_of(&model, wanted, 0.0, 1000, 7).directions));
    assert_true(isfinite(aur_gather_rays(&model, wanted, 0.0)));
    model.camera = 4.0 * 16.5 * wanted * wanted; /* of four samples sixteen times the square of the error */
    assert_false(isfinite(aur_gather_rays(&model, wanted, 0.0)));
    model.camera = 0.0;
    model.alone = true;
    assert_false(aur_gather_is_shared(aur_gather_size_of(&model, wanted, 0.0, 1000, 7).directions));
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
    assert_text(aur_adaptive_gather("path:max_depth=5", (aur_gather_size){1000, 7, 9, 3, 2}),
                "finalgather:split=1,diffuse_samples=9,glossy_samples=5,light_samples=3,bright_samples=2,"
                "photons=1000,"
                "photon_seed=7,edges=108,short_rays=2,share=near,max_depth=5");
    assert_text(aur_adaptive_gather("path", (aur_gather_size){1000, 7, 36, 8, 0}),
                "finalgather:split=4,diffuse_samples=36,glossy_samples=20,light_samples=2,photons=1000,"
                "photon_seed=7,edges=216,short_rays=2");
    assert_text(aur_adaptive_path("path", 1), "path");
    assert_text(aur_adaptive_path("path", 2), "path:candidates=2");
    assert_text(aur_adaptive_path("path:max_depth=5", 4), "path:max_depth=5,candidates=4");
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(less_error_takes_larger_patterns),
                                       cmocka_unit_test(many_largest_patterns_are_counted),
                                       cmocka_unit_test(bias_leaves_room_for_less_noise),
                                       cmocka_unit_test(patterns_are_shared_where_one_sample_does),
                                       cmocka_unit_test(photons_cost_a_part_of_the_rays),
                                       cmocka_unit_test(texts_are_those_of_keys)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
