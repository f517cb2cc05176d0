/* Intervals of the error of an image: in a closed furnace, whose radiance is 1 everywhere, the error is
 * known. */
#include <aureole-render/adaptive.h>
#include <aureole-render/render.h>
#include <math.h>

#include "check.h"

enum { SIDE = 6, RUNS = 600 };

/* Two rounds of a path tracer that ends paths at random; the root mean square of what the image is off 1. */
static double error_of(aur_renderer *renderer, uint64_t seed, aur_adaptive_report *report) {
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
    aur_image *image;
    assert_int_equal(aur_adaptive_create(renderer, &render, &target, &adaptive, NULL), AUR_OK);
    assert_int_equal(aur_adaptive_run(adaptive, NULL), AUR_OK);
    assert_int_equal(aur_adaptive_develop(adaptive, NULL, &image, NULL), AUR_OK);
    assert_int_equal(aur_adaptive_get_report(adaptive, report, NULL), AUR_OK);
    double squares = 0.0;
    for (size_t i = 0; i < 3 * SIDE * SIDE; ++i) {
        const double off =
            (double)aur_image_data(image)[i / 3 * aur_image_channel_count(image) + i % 3] - 1.0;
        squares += off * off;
    }
    aur_image_destroy(image);
    aur_adaptive_destroy(adaptive);
    return sqrt(squares / (3.0 * SIDE * SIDE));
}

/* Intervals of 50 %: a quarter of the errors may be on either side, and five standard deviations more; a
 * tenth at least is, as with intervals of 80 %. */
static void intervals_hold_the_error(void **state) {
    (void)state;
    aur_scene *scene;
    aur_renderer *renderer;
    assert_int_equal(aur_scene_load(AUR_SOURCE_DIR "/tests/render/driver/furnace.xml", NULL, &scene, NULL),
                     AUR_OK);
    assert_int_equal(aur_renderer_create(scene, &renderer, NULL), AUR_OK);
    size_t below = 0, above = 0;
    double squares = 0.0, estimated = 0.0;
    for (uint64_t seed = 0; seed < RUNS; ++seed) {
        aur_adaptive_report report = {.size = sizeof report};
        const double error = error_of(renderer, seed, &report);
        below += error < report.error_low * report.mean;
        above += error > report.error_high * report.mean;
        squares += error * error / RUNS;
        estimated += pow(report.error * report.mean, 2.0) / RUNS;
    }
    print_message("%zu below and %zu above of %d, mean square %.4g, estimated %.4g\n", below, above,
                  (int)RUNS, squares, estimated);
    assert_in_range(below, RUNS / 10, 203);
    assert_in_range(above, RUNS / 10, 203);
    /* A mean square error of 324 values has a relative spread of a tenth or so, its mean over 600 runs of .4
     * %. */
    assert_relative(estimated, squares, 0.05);
    aur_renderer_destroy(renderer);
    aur_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(intervals_hold_the_error)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
