/* Emitters smaller than a pixel: their estimated size against the closed form, and renders to a target error
 * that must not end before a sample has hit one. */
#include "render/prepared.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "render/adaptive/candidate.h"
#include "render/driver/renderer.h"
#include "render/film/integrator.h"
#include "render/scene/scene_text.h"
#include "render/vertex/visible_emitters.h"

/* A sphere of radius .05 and radiance 1000 at a distance of 10, 45 degrees across 32 pixels: it covers a
 * ninth of the pixel that it is in. Behind it a dim square fills the image. */
static const double radius = 0.05, distance = 10.0, radiance = 1000.0;
enum { SIDE = 32 };
static const char body[] =
    "<shape type='sphere'><point name='center' x='-0.1' y='0.1' z='10'/><float name='radius' value='0.05'/>"
    "<bsdf type='diffuse'><rgb name='reflectance' value='0'/></bsdf>"
    "<emitter type='area'><rgb name='radiance' value='1000'/></emitter></shape>"
    "<shape type='rectangle'><transform name='to_world'><scale value='20'/><rotate y='1' angle='180'/>"
    "<translate z='20'/></transform><bsdf type='diffuse'><rgb name='reflectance' value='0'/></bsdf>"
    "<emitter type='area'><rgb name='radiance' value='.5'/></emitter></shape>";

/* The pixel's side at distance 1 is 2 tan(22.5 degrees) / SIDE; the lamp's outline is an ellipse that differs
 * from a disk by less than its angle to the axis squared. */
static double share_of_emitter(void) {
    const double pixel = 2.0 * tan(22.5 * AUR_PI / 180.0) / SIDE;
    return AUR_PI * radius * radius / (distance * distance * pixel * pixel);
}

/* The dim square behind the sphere, which has points in some pixels, changes nothing. */
static void reports_the_size_of_an_emitter(void **state) {
    (void)state;
    aur_scene *const scene = must_load_body(body);
    const aur_film_layout layout = {.width = SIDE, .height = SIDE, .x1 = SIDE, .y1 = SIDE};
    const double share = share_of_emitter(), variance = 3.0 * radiance * radiance * share;
    /* A replica is accepted if it is expected to have hit the emitter eight times. */
    const uint32_t few = (uint32_t)(4.0 / share), many = (uint32_t)(16.0 / share);
    for (uint64_t seed = 1; seed <= 8; ++seed) {
        aur_visible_emitters visible;
        assert_int_equal(aur_visible_emitters_find(scene, &layout, AUR_EMITTER_POINTS, seed, &visible, NULL),
                         AUR_OK);
        size_t most = 0;
        for (size_t i = 0; i < SIDE * SIDE; ++i)
            most = visible.variance[i] > visible.variance[most] ? i : most;
        /* 10 mrad to the left of the axis and above it, which is within the pixel left of the middle and
         * above. */
        assert_int_equal(most, (SIDE / 2 - 1) * SIDE + SIDE / 2);
        /* The sphere gets a part of the 4096 points that its power has: 6.25 pi 10^-3 1000 of 400 / 2 more,
         * 9 %. The share is known to the root of one over 380 of them. */
        print_message("share %g of %g, variance %g of %g\n", visible.share[most], share,
                      visible.variance[most], variance);
        assert_near(visible.variance[most], variance, 0.25 * variance);
        assert_near(visible.share[most], share, 0.25 * share);
        assert_true(aur_visible_emitters_variance(&visible, most, few) == visible.variance[most] / few);
        assert_true(aur_visible_emitters_variance(&visible, most, many) == 0.0);
        aur_visible_emitters_release(&visible);
    }
    aur_scene_destroy(scene);
}

/* A sample with several emitter rays: n times as many hit one, and their mean has 1/n of the variance. Pixels
 * with none use their camera ray. */
static void uses_more_rays_for_emitters(void **state) {
    (void)state;
    aur_scene *const scene = must_load_body(body);
    const aur_film_layout layout = {.width = SIDE, .height = SIDE, .x0 = 8, .x1 = SIDE, .y0 = 4, .y1 = SIDE};
    aur_visible_emitters before, after;
    assert_int_equal(aur_visible_emitters_find(scene, &layout, AUR_EMITTER_POINTS, 1, &before, NULL), AUR_OK);
    assert_int_equal(aur_visible_emitters_find(scene, &layout, AUR_EMITTER_POINTS, 1, &after, NULL), AUR_OK);
    uint16_t probes[SIDE * SIDE]; /* of the whole image, where the film is a part of it */
    for (size_t i = 0; i < SIDE * SIDE; ++i)
        probes[i] = (uint16_t)(i % 5 == 0 ? 0 : 1u << i % 5);
    aur_visible_emitters_take_probes(&layout, probes, &after);
    const size_t width = layout.x1 - layout.x0;
    for (size_t i = 0; i < width * (layout.y1 - layout.y0); ++i) {
        const uint16_t count = probes[(layout.y0 + i / width) * SIDE + layout.x0 + i % width];
        const double rays = count > 0 ? count : 1;
        assert_true(after.share[i] == before.share[i] * rays); /* powers of two */
        assert_true(after.variance[i] == before.variance[i] / rays);
    }
    aur_visible_emitters_release(&before);
    aur_visible_emitters_release(&after);
    aur_scene_destroy(scene);
}

/* A candidate's integrator settings are those of the keys, with their defaults. */
static void knows_its_integrator(void **state) {
    (void)state;
    static const struct {
        const char *integrator;
        size_t pattern_samples;
        bool probes;
    } cases[] = {
        {"path", 1, false},
        {"path:rr_depth=3", 1, false},
        {"path:lamp_rays=.5", 1, true},
        {"finalgather:photons=100,split=8", 8, true},
        {"finalgather:photons=100,split=4,edges=0", 4, false},
    };
    const prepared lit = prepare(must_load_body(body));
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
        aur_render_options options = image_of_size(SIDE, SIDE);
        options.filter = "box";
        aur_candidate candidate = {.integrator = strdup(cases[i].integrator)};
        aur_error error = {0};
        if (aur_candidate_create(lit.renderer, &options, 2, AUR_ERROR_MEASURE_MEAN, &candidate, &error) !=
            AUR_OK)
            fail_msg("%s: %s", cases[i].integrator, error.message);
        const aur_integrator *const created = aur_render_integrator(candidate.replicas.renders[0]);
        assert_int_equal(candidate.pattern_samples, cases[i].pattern_samples);
        assert_true((created->emitter_probes != NULL) == cases[i].probes);
        assert_true(created->refines_emitter_edges == (i == 3)); /* `edges` is 128 by default */
        assert_non_null(candidate.visible.share);
        aur_candidate_release(&candidate);
    }
    release(lit);
}

/* Pixels of a cell get samples together, so what one of them needs for an emitter counts for all: the numbers
 * of samples by which variances are divided are those of the film. */
static void knows_the_samples_of_cells(void **state) {
    (void)state;
    enum { REPLICAS = 4, ROUNDS = 4 };
    const prepared lit = prepare(must_load_body(body));
    aur_render_options options = image_of_size(SIDE, SIDE);
    options.filter = "gaussian";
    for (size_t measure = 0; measure < AUR_ERROR_MEASURE_COUNT; ++measure) {
        aur_candidate candidate = {.integrator = strdup("path")};
        assert_int_equal(aur_candidate_create(lit.renderer, &options, REPLICAS, (aur_error_measure)measure,
                                              &candidate, NULL),
                         AUR_OK);
        const size_t pixels = candidate.replicas.pixel_count;
        atomic_bool cancelled = false;
        for (size_t round = 0; round < ROUNDS; ++round) {
            assert_true(aur_candidate_plan(&candidate, 0.5));
            assert_int_equal(aur_candidate_render(&candidate, 0.95, &cancelled, NULL), AUR_OK);
            for (size_t i = 0; i < candidate.value_count; ++i)
                assert_int_equal(candidate.targets[i],
                                 aur_render_film(candidate.replicas.renders[i / pixels])->counts[i % pixels]);
        }
        aur_candidate_release(&candidate);
    }
    release(lit);
}

static void meets_emitters(void **state) {
    (void)state;
    const prepared lit = prepare(must_load_body(body));
    aur_render_options options = image_of_size(SIDE, SIDE);
    options.filter = "box";
    options.integrator = "path";
    const aur_adaptive_options target = target_of(0.3, AUR_ERROR_MEASURE_RELATIVE);
    const double emitter = radiance * share_of_emitter();
    for (size_t seed = 0; seed < 8; ++seed) {
        aur_adaptive *adaptive = NULL;
        aur_image *image = NULL;
        aur_adaptive_report report = {.size = sizeof report};
        options.seed = seed;
        assert_int_equal(aur_adaptive_create(lit.renderer, &options, &target, &adaptive, NULL), AUR_OK);
        assert_int_equal(aur_adaptive_run(adaptive, NULL), AUR_OK);
        assert_int_equal(aur_adaptive_get_report(adaptive, &report, NULL), AUR_OK);
        assert_int_equal(aur_adaptive_develop(adaptive, false, &image, NULL), AUR_OK);
        const double value = (double)aur_image_data(image)[3 * ((SIDE / 2 - 1) * SIDE + SIDE / 2)];
        const double error = fabs(value - 0.5 - emitter) / SIDE / report.mean;
        print_message("seed %zu: %.2f of %.2f by %.0f samples a pixel, error %.3f of %.3f\n", seed, value,
                      emitter, report.samples_per_pixel, error, report.error);
        assert_true(value >
                    0.5 * emitter); /* without, none of 13 samples meets it but for one in eight times */
        /* The measure is relative to the pixel. */
        assert_true(fabs(value - 0.5 - emitter) <= target.error * emitter);
        aur_image_destroy(image);
        aur_adaptive_destroy(adaptive);
    }
    release(lit);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reports_the_size_of_an_emitter), cmocka_unit_test(uses_more_rays_for_emitters),
        cmocka_unit_test(knows_its_integrator), cmocka_unit_test(knows_the_samples_of_cells),
        cmocka_unit_test(meets_emitters)};
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
