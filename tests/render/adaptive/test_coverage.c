/* Intervals of the error of an image: in a closed furnace, whose radiance is 1 everywhere, the error is
 * known. */
#include "render/prepared.h"

#include <math.h>

enum { SIDE = 6, RUNS = 600 };

/* Two rounds of a path tracer with Russian roulette, and the error of the image, whose exact value is 1, by
 * every measure. */
static void errors_of(aur_renderer *renderer, uint64_t seed, aur_adaptive_report *report,
                      double errors[AUR_ERROR_MEASURE_COUNT]) {
    aur_render_options render = image_of_size(SIDE, SIDE);
    render.integrator = "path:rr_depth=1";
    render.threads = 1;
    render.seed = seed;
    aur_adaptive_options target = target_of(0.0, AUR_ERROR_MEASURE_RELATIVE);
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
    const prepared furnace = prepare_file(AUR_SOURCE_DIR "/tests/render/driver/furnace.xml");
    size_t below[AUR_ERROR_MEASURE_COUNT] = {0}, above[AUR_ERROR_MEASURE_COUNT] = {0};
    double squares[AUR_ERROR_MEASURE_COUNT] = {0.0}, estimated[AUR_ERROR_MEASURE_COUNT] = {0.0};
    for (uint64_t seed = 0; seed < RUNS; ++seed) {
        aur_adaptive_report report = {.size = sizeof report};
        double errors[AUR_ERROR_MEASURE_COUNT];
        errors_of(furnace.renderer, seed, &report, errors);
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
    release(furnace);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(intervals_hold_the_error)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
