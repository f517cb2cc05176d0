/* More rays of the eye at edges change no mean: not that of a lamp smaller than a pixel either, which a
 * pixel's few samples meet by chance. */
#include "scene/scene_text.h"

#include <aureole/render.h>

enum { SEEDS = 3000, SAMPLES = 4 };

/* The film spans [-1, 1]; its 8 x 8 pixels have edges of a quarter, the lamp one of a thirty-second. */
#define LAMP(x, y)                                                                                           \
    "<shape type='rectangle'><transform name='to_world'><scale value='0.015625'/><rotate y='1' "             \
    "angle='180'/><translate x='" x "' y='" y "' z='3'/></transform><emitter type='area'><rgb "              \
    "name='radiance' value='64'/></emitter></shape>"

static void keeps_the_mean_of_a_small_lamp(void **state) {
    (void)state;
    aur_scene *scene;
    assert_int_equal(
        aur_scene_load(write_text("lamp.xml", "<scene version='3.0.0'><sensor type='orthographic'/>" LAMP(
                                                  "0.125", "0.125") "</scene>"),
                       NULL, &scene, NULL),
        AUR_OK);
    aur_renderer *renderer;
    assert_int_equal(aur_renderer_create(scene, &renderer, NULL), AUR_OK);
    double mean = 0.0;
    for (size_t s = 0; s < SEEDS; ++s) {
        aur_render_options options = aur_render_options_default();
        options.integrator = "finalgather:incident=emitters";
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

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(keeps_the_mean_of_a_small_lamp)};
    return cmocka_run_group_tests_name("transport/edges", tests, enter_folder, leave_folder);
}
