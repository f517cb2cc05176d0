/* Intervals of the error of an image: in a closed furnace, whose radiance is 1 everywhere, the error is
 * known. */
#include <aureole-render/adaptive.h>
#include <aureole-render/render.h>
#include <math.h>

#include "check.h"

enum { SIDE = 6, RUNS = 600 };

/* Two rounds of a path tracer with Russian roulette, and the error of the image, whose exact value is 1, by
 * every measure. */
static void errors_of(aur_renderer *renderer, uint64_t seed, aur_adaptive_report *report,
                      double errors[AUR_ERROR_MEASURE_COUNT]) {
    aur_render_options render = {.size = sizeof render};
    aur_render_options_init(&render, NULL);
    render.width = render.height = SIDE;
    render.integrator = "path:rr_depth=1";
    render.threads = 1;
    render.seed = seed;
    aur_adaptive_options target = {.size = sizeof target};
    aur_adaptive_options_init(&target, NULL);
    target.error = 0.0;
    target.rounds = 2;
    target.confidence = 0.5;
    aur_adaptive *adaptive;
    aur_image *image, *reference;
    assert_int_equal(aur_adaptive_create(renderer, &render, &target, &adaptive, NULL), AUR_OK);
    assert_int_equal(aur_adaptive_run(adaptive, NULL), AUR_OK);
    assert_int_equal(aur_adaptive_develop(adaptive, NULL, &image, NULL), AUR_OK);
    assert_int_equal(aur_adaptive_get_report(adaptive, report, NULL), AUR_OK);
    assert_int_equal(aur_image_create(SIDE, SIDE, 3, &reference, NULL), AUR_OK);
    for (size_t i = 0; i < 3 * SIDE * SIDE; ++i)
        aur_image_data(reference)[i] = 1.0f;
    for (size_t c = 0; c < 3; ++c)
        aur_image_name_channel(reference, c, (const char *const[]){"R", "G", "B"}[c], NULL);
    for (int m = 0; m < AUR_ERROR_MEASURE_COUNT; ++m)
        assert_int_equal(aur_image_error(reference, image, (aur_error_measure)m, &errors[m], NULL), AUR_OK);
    aur_image_destroy(reference);
    aur_image_destroy(image);
    aur_adaptive_destroy(adaptive);
}

/* Intervals of 50 %: a quarter of the errors may be on either side, and five standard deviations more; a
 * tenth at least is, as with intervals of 80 %. A mean square error of 324 values has a relative spread of a
 * tenth or so, its mean over 600 runs of .4 %. The display's curve is not linear, and the estimate of its
 * mean square is of first order. */
static void intervals_hold_the_error(void **state) {
    (void)state;
    aur_scene *scene;
    aur_renderer *renderer;
    assert_int_equal(aur_scene_load(AUR_SOURCE_DIR "/tests/render/driver/furnace.xml", NULL, &scene, NULL),
                     AUR_OK);
    assert_int_equal(aur_renderer_create(scene, &renderer, NULL), AUR_OK);
    size_t below[AUR_ERROR_MEASURE_COUNT] = {0}, above[AUR_ERROR_MEASURE_COUNT] = {0};
    double squares[AUR_ERROR_MEASURE_COUNT] = {0.0}, estimated[AUR_ERROR_MEASURE_COUNT] = {0.0};
    for (uint64_t seed = 0; seed < RUNS; ++seed) {
        aur_adaptive_report report = {.size = sizeof report};
        double errors[AUR_ERROR_MEASURE_COUNT];
        errors_of(renderer, seed, &report, errors);
        assert_true(report.error == report.errors[AUR_ERROR_MEASURE_RELATIVE].error);
        for (size_t m = 0; m < AUR_ERROR_MEASURE_COUNT; ++m) {
            below[m] += errors[m] < report.errors[m].low;
            above[m] += errors[m] > report.errors[m].high;
            squares[m] += errors[m] * errors[m] / RUNS;
            estimated[m] += pow(report.errors[m].error, 2.0) / RUNS;
        }
    }
    for (size_t m = 0; m < AUR_ERROR_MEASURE_COUNT; ++m) {
        print_message("%s: %zu below and %zu above of %d, mean square %.4g, estimated %.4g\n",
                      aur_error_measure_name((aur_error_measure)m), below[m], above[m], (int)RUNS, squares[m],
                      estimated[m]);
        assert_in_range(below[m], RUNS / 10, 203);
        assert_in_range(above[m], RUNS / 10, 203);
        if (m != AUR_ERROR_MEASURE_DISPLAY)
            assert_relative(estimated[m], squares[m], 0.05);
    }
    aur_renderer_destroy(renderer);
    aur_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(intervals_hold_the_error)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
