/* Additional camera rays at edges do not change means, including that of an emitter smaller than a pixel,
 * which a pixel's few samples hit with small probability. */
#include "render/scene/scene_text.h"

#include "program/lab/gather.h"
#include "render/driver/renderer.h"
#include "render/film/film.h"

#include <aureole-render/render.h>

enum { SEEDS = 3000, SAMPLES = 4 };

/* The film spans [-1, 1]; its 8 x 8 pixels have sides of a quarter, the emitter one of a thirty-second. */
#define EMITTER(x, y)                                                                                        \
    "<shape type='rectangle'><transform name='to_world'><scale value='0.015625'/><rotate y='1' "             \
    "angle='180'/><translate x='" x "' y='" y "' z='3'/></transform><emitter type='area'><rgb "              \
    "name='radiance' value='64'/></emitter></shape>"

/* A light that covers the left of 8 x 8 pixels and 3/8 of column 4 (of 0 to 7). */
static const char half[] = "<scene version='3.0.0'><sensor type='orthographic'><film type='hdrfilm'><integer "
                           "name='width' value='8'/><integer name='height' value='8'/><rfilter "
                           "type='box'/></film></sensor><shape type='rectangle'><transform "
                           "name='to_world'><scale value='2'/><rotate y='1' angle='180'/><translate "
                           "x='2' z='3'/><translate x='-0.09375'/></transform><emitter type='area'><rgb "
                           "name='radiance' value='1'/></emitter></shape></scene>";

static aur_renderer *open_scene(const char *file, const char *text, aur_scene **scene) {
    aur_renderer *renderer;
    assert_int_equal(aur_scene_load(write_text(file, text), NULL, scene, NULL), AUR_OK);
    assert_int_equal(aur_renderer_create(*scene, &renderer, NULL), AUR_OK);
    return renderer;
}

static void preserves_the_mean_of_a_small_emitter(void **state) {
    (void)state;
    aur_scene *scene;
    aur_renderer *const renderer = open_scene(
        "lamp.xml",
        "<scene version='3.0.0'><sensor type='orthographic'/>" EMITTER("0.125", "0.125") "</scene>", &scene);
    double mean = 0.0;
    for (size_t s = 0; s < SEEDS; ++s) {
        aur_render_options options = {.size = sizeof options};
        aur_render_options_init(&options, NULL);
        options.integrator = "finalgather-lab:incident=emitters";
        options.gather = &lab_finalgather;
        options.sampler = "random";
        options.filter = "box";
        options.samples_per_pixel = SAMPLES;
        options.seed = s;
        options.width = options.height = 8;
        options.threads = 1;
        aur_image *image;
        assert_int_equal(aur_renderer_render(renderer, &options, &image, NULL, NULL), AUR_OK);
        for (size_t i = 0; i < 64; ++i)
            mean += (double)aur_image_data(image)[i * aur_image_channel_count(image)] / SEEDS;
        aur_image_destroy(image);
    }
    /* The lamp fills 1/64 of its pixel and is 64 times as bright as a full one would be. Samples meet it or
     * not: their variance is 64^2 p (1 - p), and the mean lies within 4.4 standard errors but once in 1e5. */
    const double part = 1.0 / 64.0;
    assert_near(mean, 1.0, 4.4 * 64.0 * sqrt(part * (1.0 - part) / (SAMPLES * SEEDS)));
    aur_renderer_destroy(renderer);
    aur_scene_destroy(scene);
}

/* A pixel that alone gets more samples finds the edge by what its neighbours see, as it did in the first
 * step. The lamp covers the image's left and 3/8 of column 4 (of 0 to 7): four random samples of such a
 * pixel have a variance of 3/8 x 5/8 / 4, and with 64 that only look it is a 17th of that. A mean of squares
 * over 256 seeds varies by a tenth: half of the first is five times that away from either. */
static void finds_edges_where_only_some_pixels_go_on(void **state) {
    (void)state;
    enum { SIDE = 8, PIXEL = 3 * SIDE + 4, STEP = 4, RUNS = 256 };
    const double part = 0.375;
    aur_scene *scene;
    aur_renderer *const renderer = open_scene("half.xml", half, &scene);
    double squares = 0.0;
    for (size_t s = 0; s < RUNS; ++s) {
        aur_render_options options = {.size = sizeof options};
        aur_render_options_init(&options, NULL);
        options.integrator = "finalgather-lab:incident=emitters,edges=64,split=4";
        options.gather = &lab_finalgather;
        options.sampler = "random";
        options.samples_per_pixel = 2 * STEP;
        options.seed = s;
        options.threads = 1;
        aur_render *render;
        assert_int_equal(aur_render_create(renderer, &options, &render, NULL), AUR_OK);
        uint32_t targets[SIDE * SIDE];
        aur_image *images[2];
        for (size_t step = 0; step < 2; ++step) {
            for (size_t i = 0; i < SIDE * SIDE; ++i)
                targets[i] = step > 0 && i == PIXEL ? 2 * STEP : STEP;
            assert_int_equal(aur_render_step_pixels(render, SIDE * SIDE, targets, NULL), AUR_OK);
            assert_int_equal(aur_film_develop(aur_render_film(render), &images[step], NULL), AUR_OK);
        }
        const double first = (double)aur_image_data(images[0])[3 * PIXEL];
        const double second = 2.0 * (double)aur_image_data(images[1])[3 * PIXEL] - first;
        squares += (second - part) * (second - part) / RUNS;
        aur_image_destroy(images[0]);
        aur_image_destroy(images[1]);
        aur_render_destroy(render);
    }
    const double plain = part * (1.0 - part) / STEP, least = 0.5 * plain;
    if (!(squares < least))
        fail_msg("a variance of %g, that of four samples is %g", squares, plain);
    aur_renderer_destroy(renderer);
    aur_scene_destroy(scene);
}

/* Rounds to one, 4, 16 and 64 samples in all of an edge's pixels: each adds rays, so that in the long run the
 * variance falls at least as fast as one over the samples; the second has few rays for that. If rounds
 * repeated their rays, it would hardly fall. Its mean over the eight pixels of column 4 and 128 seeds varies
 * by less than a tenth. */
static void rounds_measure_edges_more_exactly(void **state) {
    (void)state;
    enum { SIDE = 8, COLUMN = 4, ROUNDS = 4, RUNS = 128 };
    const double part = 0.375;
    double squares[ROUNDS] = {0.0};
    aur_scene *scene;
    aur_renderer *const renderer = open_scene("half.xml", half, &scene);
    for (size_t s = 0; s < RUNS; ++s) {
        aur_render_options options = {.size = sizeof options};
        aur_render_options_init(&options, NULL);
        options.integrator = "finalgather-lab:incident=emitters,edges=32,split=1";
        options.gather = &lab_finalgather;
        options.sampler = "sobol";
        options.samples_per_pixel = AUR_SAMPLES_PER_PIXEL_MAX;
        options.seed = s;
        options.threads = 1;
        aur_render *render;
        assert_int_equal(aur_render_create(renderer, &options, &render, NULL), AUR_OK);
        for (size_t round = 0; round < ROUNDS; ++round) {
            uint32_t targets[SIDE * SIDE];
            aur_image *image;
            for (size_t i = 0; i < SIDE * SIDE; ++i)
                targets[i] = i % SIDE == COLUMN || round == 0 ? 1u << 2 * round : 1;
            assert_int_equal(aur_render_step_pixels(render, SIDE * SIDE, targets, NULL), AUR_OK);
            assert_int_equal(aur_film_develop(aur_render_film(render), &image, NULL), AUR_OK);
            for (size_t row = 0; row < SIDE; ++row)
                squares[round] +=
                    pow((double)aur_image_data(image)[3 * (row * SIDE + COLUMN)] - part, 2.0) / (SIDE * RUNS);
            aur_image_destroy(image);
        }
        aur_render_destroy(render);
    }
    print_message("squares of errors at an edge: %.3g, %.3g, %.3g, %.3g\n", squares[0], squares[1],
                  squares[2], squares[3]);
    assert_true(squares[1] < squares[0]);
    for (size_t round = 2; round < ROUNDS; ++round)
        assert_true(squares[round] < 2.0 * squares[0] / (double)(1u << 2 * round));
    aur_renderer_destroy(renderer);
    aur_scene_destroy(scene);
}

/* The integral of exp(-x^2/2) - exp(-8), of which the filter is a part, from 0 to x standard deviations. */
static double gaussian_mass(double x) {
    return sqrt(2.0 * atan(1.0)) * erf(x / sqrt(2.0)) - exp(-8.0) * x;
}

/* A wide filter sees a little of what lies beyond the pixels next to its own. The lamp covers the image's
 * columns 0 to 3, and its edge is 3 standard deviations from the centre of column 5: a sample there meets it
 * with a chance of .001, and one in column 4 with .16, so that in an eighth of the images no pixel next to
 * those of column 5 has met it. If these looked no farther, their variance would be three times that of all
 * samples. The mean of squares varies by a 34th: twice is 34 times that away from one. */
static void finds_edges_that_a_wide_filter_sees(void **state) {
    (void)state;
    enum { SIDE = 8, COLUMN = 5, SAMPLES_HERE = 4, EDGES = 64, RUNS = 2048 };
    const double part = 0.5 * (1.0 - gaussian_mass(3.0) / gaussian_mass(4.0));
    aur_scene *scene;
    aur_renderer *const renderer =
        open_scene("wide.xml",
                   "<scene version='3.0.0'><sensor type='orthographic'/><shape "
                   "type='rectangle'><transform name='to_world'><scale value='2'/><rotate y='1' "
                   "angle='180'/><translate x='2' z='3'/></transform><emitter type='area'><rgb "
                   "name='radiance' value='1'/></emitter></shape></scene>",
                   &scene);
    double squares = 0.0, mean = 0.0;
    for (size_t s = 0; s < RUNS; ++s) {
        aur_render_options options = {.size = sizeof options};
        aur_render_options_init(&options, NULL);
        options.integrator = "finalgather-lab:incident=emitters,edges=64,split=4";
        options.gather = &lab_finalgather;
        options.sampler = "random";
        options.filter = "gaussian";
        options.samples_per_pixel = SAMPLES_HERE;
        options.seed = s;
        options.width = options.height = SIDE;
        options.threads = 1;
        aur_image *image;
        assert_int_equal(aur_renderer_render(renderer, &options, &image, NULL, NULL), AUR_OK);
        for (size_t y = 0; y < SIDE; ++y) {
            const size_t pixel = y * SIDE + COLUMN;
            const double value = (double)aur_image_data(image)[pixel * aur_image_channel_count(image)];
            mean += value / (RUNS * SIDE);
            squares += (value - part) * (value - part) / (RUNS * SIDE);
        }
        aur_image_destroy(image);
    }
    const double variance = part * (1.0 - part) / (SAMPLES_HERE + EDGES);
    /* Five standard errors of the mean. */
    assert_near(mean, part, 5.0 * sqrt(variance / (RUNS * SIDE)));
    if (!(squares < 2.0 * variance))
        fail_msg("a variance of %g, that of all samples is %g", squares, variance);
    aur_renderer_destroy(renderer);
    aur_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(preserves_the_mean_of_a_small_emitter),
                                       cmocka_unit_test(finds_edges_where_only_some_pixels_go_on),
                                       cmocka_unit_test(rounds_measure_edges_more_exactly),
                                       cmocka_unit_test(finds_edges_that_a_wide_filter_sees)};
    return cmocka_run_group_tests_name("transport/edges", tests, enter_folder, leave_folder);
}
