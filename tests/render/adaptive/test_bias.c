/* The bias of one integrator, from replicas whose noise is far larger than it. The light that `path` with
 * max_depth 2 lacks is known from many samples; of integrators without bias none is found. */
#include "check.h"

#include "render/adaptive/choose.h"
#include <aureole-render/render.h>

enum { WIDTH = 32, HEIGHT = 32, REPLICAS = 4 };

static void replicas_of(aur_renderer *renderer, const char *integrator, size_t samples, uint64_t seed,
                        aur_replicas *replicas) {
    aur_render_options options = {.size = sizeof options};
    aur_render_options_init(&options, NULL);
    options.integrator = integrator;
    options.sampler = "sobol";
    options.width = WIDTH;
    options.height = HEIGHT;
    options.samples_per_pixel = samples;
    options.seed = seed;
    assert_int_equal(aur_replicas_create(renderer, &options, REPLICAS, replicas, NULL), AUR_OK);
    for (size_t r = 0; r < REPLICAS; ++r)
        assert_int_equal(aur_render_step(replicas->renders[r], samples, NULL), AUR_OK);
}

static double mean_of(const aur_replicas *replicas) {
    static double variances[REPLICAS * WIDTH * HEIGHT], spreads[WIDTH * HEIGHT];
    const aur_pixel_measure pixels = {variances, spreads};
    aur_replica_measure measure;
    aur_replicas_measure(replicas, (aur_weighing){.measure = AUR_ERROR_MEASURE_MEAN}, &measure, &pixels);
    return measure.mean;
}

static void finds_what_is_missing(void **state) {
    (void)state;
    const double confidence = 0.999;
    aur_scene *scene;
    aur_renderer *renderer;
    assert_int_equal(aur_scene_load(AUR_SOURCE_DIR "/scenes/cornell-box/cornell-box.xml", NULL, &scene, NULL),
                     AUR_OK);
    assert_int_equal(aur_renderer_create(scene, &renderer, NULL), AUR_OK);
    aur_replicas all, direct, few, fewer, others;
    replicas_of(renderer, "path", 512, 1, &all);
    replicas_of(renderer, "path:max_depth=2", 512, 1, &direct);
    const double mean = mean_of(&all);
    const aur_bias truth = aur_replicas_bias(&direct, &all, mean, confidence);

    replicas_of(renderer, "path", 8, 2, &few);
    replicas_of(renderer, "path:max_depth=2", 8, 2, &fewer);
    const aur_bias found = aur_replicas_bias(&fewer, &few, mean, confidence);
    /* The interval is that of blocks drawn from a picture like this one, so it is wide even without noise. */
    assert_true(found.low > 0.0 && found.low <= truth.estimate && found.high >= truth.estimate);

    /* The same light by other random numbers. */
    replicas_of(renderer, "path", 8, 3, &others);
    const aur_bias none = aur_replicas_bias(&others, &few, mean, confidence);
    assert_true(none.low == 0.0 && none.high > 0.0);
    aur_replicas_release(&all);
    aur_replicas_release(&direct);
    aur_replicas_release(&few);
    aur_replicas_release(&fewer);
    aur_replicas_release(&others);
    aur_renderer_destroy(renderer);
    aur_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(finds_what_is_missing)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
