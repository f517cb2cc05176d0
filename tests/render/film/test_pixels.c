/* Samples for single pixels: each has the bits of an image in which all pixels have as many. */
#include "check.h"

#include <stdlib.h>

#include <aureole-render/render.h>

#include "points/base/random.h"
#include "program/lab/gather.h"
#include "render/driver/renderer.h"
#include "render/film/film.h"
#include "render/image/format.h"

enum { WIDTH = 37, HEIGHT = 21, PIXELS = WIDTH * HEIGHT, MOST = 6 };

static aur_render *start(aur_renderer *renderer, const char *integrator, size_t threads) {
    const aur_render_options options = {.size = sizeof options,
                                        .integrator = integrator,
                                        .gather = &lab_finalgather,
                                        .filter = "box",
                                        .samples_per_pixel = MOST,
                                        .width = WIDTH,
                                        .height = HEIGHT,
                                        .threads = threads};
    aur_render *render = NULL;
    assert_int_equal(aur_render_create(renderer, &options, &render, NULL), AUR_OK);
    return render;
}

static aur_image *develop(const aur_render *render) {
    aur_image *image = NULL;
    assert_int_equal(aur_film_develop(aur_render_film(render), &image, NULL), AUR_OK);
    return image;
}

/* `even`[n] is the image of n + 1 samples everywhere. */
static void compare(const char *integrator, aur_renderer *renderer, aur_image *const even[MOST],
                    size_t threads, bool in_two_steps) {
    aur_render *const render = start(renderer, integrator, threads);
    uint32_t targets[PIXELS];
    for (uint32_t step = in_two_steps ? 0 : 1; step < 2; ++step) {
        for (size_t i = 0; i < PIXELS; ++i)
            targets[i] = (uint32_t)(aur_hash2(step, i) % MOST);
        assert_int_equal(aur_render_step_pixels(render, PIXELS, targets, NULL), AUR_OK);
    }
    const aur_film *const film = aur_render_film(render);
    aur_image *const image = develop(render);
    uint64_t samples = 0;
    for (size_t i = 0; i < PIXELS; ++i) {
        uint32_t expected = (uint32_t)(aur_hash2(1, i) % MOST);
        if (in_two_steps && aur_hash2(0, i) % MOST > expected)
            expected = (uint32_t)(aur_hash2(0, i) % MOST);
        assert_int_equal(film->given[i], expected);
        assert_int_equal(film->counts[i], expected);
        samples += expected;
        const size_t channels = image->channel_count;
        if (expected > 0)
            assert_memory_equal(&image->data[i * channels], &even[expected - 1]->data[i * channels],
                                channels * sizeof *image->data);
    }
    aur_render_statistics statistics = {.size = sizeof statistics};
    assert_int_equal(aur_render_get_statistics(render, &statistics, NULL), AUR_OK);
    assert_int_equal(statistics.samples, samples);
    aur_image_destroy(image);
    aur_render_destroy(render);
}

/* Without packets, except in the last row, whose packets hold samples of different pixels and indices: in
 * this scene Embree gives every ray of a packet the hit that it has alone. */
static void pixels_are_identical_to_even_images(void **state) {
    (void)state;
    static const struct {
        const char *integrator;
        bool cuts; /* its bits do not depend on the steps */
    } rows[] = {{"path:packets=false", true},
                {"direct", true},
                {"aov:aovs=(n:sample_count,d:depth)", true},
                {"aov:aovs=(n:sample_count,r:reflectance),integrator=none", true},
                {"ao:samples=8", true},
                {"finalgather-lab:photons=5000,diffuse_samples=8,split=8,edges=0,packets=false", false},
                {"finalgather:photons=5000,diffuse_samples=8,split=8,edges=0", false}};
    aur_scene *scene = NULL;
    aur_renderer *renderer = NULL;
    assert_int_equal(aur_scene_load(AUR_SOURCE_DIR "/scenes/cornell-box/cornell-box.xml", NULL, &scene, NULL),
                     AUR_OK);
    assert_int_equal(aur_renderer_create(scene, &renderer, NULL), AUR_OK);
    for (size_t r = 0; r < sizeof rows / sizeof rows[0]; ++r) {
        aur_image *even[MOST];
        for (uint32_t n = 1; n <= MOST; ++n) {
            aur_render *const render = start(renderer, rows[r].integrator, 1);
            assert_int_equal(aur_render_step(render, n, NULL), AUR_OK);
            even[n - 1] = develop(render);
            aur_render_destroy(render);
        }
        compare(rows[r].integrator, renderer, even, 1, false);
        compare(rows[r].integrator, renderer, even, 3, rows[r].cuts);
        for (size_t n = 0; n < MOST; ++n)
            aur_image_destroy(even[n]);
    }
    aur_renderer_destroy(renderer);
    aur_scene_destroy(scene);
}

/* If pixels share results, the pixels of a tile have the largest requested number of samples. */
static void tiles_stay_whole(void **state) {
    (void)state;
    aur_scene *scene = NULL;
    aur_renderer *renderer = NULL;
    assert_int_equal(aur_scene_load(AUR_SOURCE_DIR "/scenes/cornell-box/cornell-box.xml", NULL, &scene, NULL),
                     AUR_OK);
    assert_int_equal(aur_renderer_create(scene, &renderer, NULL), AUR_OK);
    aur_render *const render = start(renderer, "finalgather:photons=5000,diffuse_samples=8,share=true", 2);
    uint32_t targets[PIXELS] = {0};
    targets[5] = 2;
    targets[WIDTH + 4] = 1;
    assert_int_equal(aur_render_step_pixels(render, PIXELS, targets, NULL), AUR_OK);
    for (size_t i = 0; i < PIXELS; ++i)
        assert_int_equal(aur_render_film(render)->given[i],
                         i % WIDTH < AUR_TILE_SIZE && i / WIDTH < AUR_TILE_SIZE ? 2 : 0);
    aur_render_destroy(render);
    aur_renderer_destroy(renderer);
    aur_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(pixels_are_identical_to_even_images),
                                       cmocka_unit_test(tiles_stay_whole)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
