/* Pixels that gather along the same directions, or trace paths by the same numbers, have correlated errors:
 * these must form no pattern in the image, nor add up over its parts. */
#include "check.h"

#include <aureole-render/render.h>
#include <stdio.h>
#include <string.h>

#include "../../../bench/error_pattern.h"

enum { WIDTH = 96 };

static void open_pattern(const char *scene_path, const char *integrator, const size_t samples[2],
                         error_pattern *pattern) {
    aur_scene *scene;
    aur_renderer *renderer;
    aur_image *images[2];
    aur_error error = {0};
    static const aur_definition definition = {"integrator", "path"};
    aur_scene_options load = {.size = sizeof load};
    aur_scene_options_init(&load, NULL);
    load.definitions = &definition;
    load.definition_count = strstr(scene_path, "keller") != NULL ? 1 : 0;
    if (aur_scene_load(scene_path, &load, &scene, &error) != AUR_OK)
        fail_msg("%s", error.message);
    assert_int_equal(aur_renderer_create(scene, &renderer, NULL), AUR_OK);
    for (size_t k = 0; k < 2; ++k) {
        aur_render_options options = {.size = sizeof options};
        aur_render_options_init(&options, NULL);
        options.integrator = integrator;
        options.sampler = "sobol";
        options.filter = "box";
        options.samples_per_pixel = samples[k];
        options.seed = k + 1;
        options.width = options.height = WIDTH;
        options.threads = 1;
        if (aur_renderer_render(renderer, &options, &images[k], NULL, &error) != AUR_OK)
            fail_msg("%s: %s", integrator, error.message);
    }
    assert_true(error_pattern_open(WIDTH, WIDTH, aur_image_channel_count(images[0]),
                                   aur_image_data(images[0]), aur_image_data(images[1]), pattern));
    for (size_t k = 0; k < 2; ++k)
        aur_image_destroy(images[k]);
    aur_renderer_destroy(renderer);
    aur_scene_destroy(scene);
}

/* A peak of more than 4.5 standard errors comes by chance once in 290,000 looks, of which there are 20 here.
 * Means over 8 x 8 pixels, 144 of them in 3 channels that are wrong nearly alike, have a root mean square
 * that is known to a seventeenth, 1 / sqrt(2 * 144); `most` has four of these above what is there. */
static void check_pattern(const char *scene, const char *integrator, size_t first, size_t second,
                          double most) {
    error_pattern pattern;
    open_pattern(scene, integrator, (const size_t[2]){first, second}, &pattern);
    const double clumps = error_pattern_clumps(&pattern, 8);
    printf("%s: means over 8 x 8 pixels %.2f of independent ones; peaks", integrator, clumps);
    for (size_t lag = 4; lag <= 8; lag += 4)
        for (size_t down = 0; down < 2; ++down) {
            const double peak = error_pattern_peak(&pattern, lag, down != 0);
            printf(" %.1f", peak);
            assert_true(peak < 4.5);
        }
    printf("\n");
    assert_true(clumps < most);
    error_pattern_close(&pattern);
}

#define CUBE AUR_SOURCE_DIR "/scenes/keller/cube.xml"

/* Eleven samples are a whole pattern of eight and three of the next one. */
static void gathering_leaves_no_pattern(void **state) {
    (void)state;
    check_pattern(CUBE, "finalgather:split=8,diffuse_samples=16,photons=250000", 11, 11, 1.5);
}

/* The first samples of a pattern have directions at all heights, as the whole has. */
static void parts_are_no_worse_than_the_whole(void **state) {
    (void)state;
    check_pattern(CUBE, "finalgather:split=8,diffuse_samples=16,photons=250000", 3, 32, 1.5);
}

/* Glossy lobes have separate patterns; few of their directions show where they repeat. */
static void glossy_lobes_leave_no_pattern(void **state) {
    (void)state;
    check_pattern(
        AUR_SOURCE_DIR "/scenes/cornell-box/glossy.xml",
        "finalgather:split=1,diffuse_samples=32,glossy_samples=1,light_samples=8,photons=100000,edges=512,"
        "share=near",
        1, 1, 1.08);
}

/* Of 64 pixels four each have the same numbers. */
static void paths_leave_no_pattern(void **state) {
    (void)state;
    check_pattern(CUBE, "path:interleaved=true", 8, 8, 2.0);
}

static void occlusion_leaves_no_pattern(void **state) {
    (void)state;
    check_pattern(AUR_SOURCE_DIR "/scenes/cornell-box/cornell-box.xml", "ao:samples=16", 4, 4, 1.5);
}

/* Columns of 1, 1, -1, -1: of period 4 along rows, with the same error down each column, and blocks of 8 x 8
 * pixels that have no mean. Half of all products of pixels one apart are 1, the others -1. */
static void statistics_of_a_given_pattern(void **state) {
    (void)state;
    enum { SIDE = 16 };
    double values[3 * SIDE * SIDE];
    for (size_t i = 0; i < 3 * SIDE * SIDE; ++i)
        values[i] = i / 3 % 4 < 2 ? 1.0 : -1.0;
    error_pattern pattern = {SIDE, SIDE, values};
    assert_true(error_pattern_clumps(&pattern, 8) == 0.0);
    assert_true(error_pattern_clumps(&pattern, 2) == sqrt(4.0)); /* blocks of four equal errors */
    static const double along[] = {1.0, 1.0 / 15.0, -1.0, -1.0 / 13.0, 1.0};
    for (size_t lag = 0; lag <= 4; ++lag) { /* of 15 and 13 pairs per row, one more is correlated or is not */
        assert_float_equal(error_pattern_product(&pattern, lag, false), along[lag], 1e-14);
        assert_float_equal(error_pattern_product(&pattern, lag, true), 1.0, 1e-14);
    }
    assert_true(error_pattern_peak(&pattern, 4, false) > 4.5);
    assert_true(error_pattern_peak(&pattern, 4, true) == 0.0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(statistics_of_a_given_pattern),     cmocka_unit_test(gathering_leaves_no_pattern),
        cmocka_unit_test(parts_are_no_worse_than_the_whole), cmocka_unit_test(paths_leave_no_pattern),
        cmocka_unit_test(glossy_lobes_leave_no_pattern),     cmocka_unit_test(occlusion_leaves_no_pattern),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
