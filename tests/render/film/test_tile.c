#include "check.h"

#include <aureole-render/render.h>
#include <string.h>

#include "render/image/format.h"

static aur_image *render(const aur_scene *scene, const char *integrator, const size_t crop[4]) {
    aur_renderer *renderer = NULL;
    aur_image *image = NULL;
    const aur_render_options options = {.size = sizeof options,
                                        .integrator = integrator,
                                        .samples_per_pixel = 2,
                                        .width = 45,
                                        .height = 37,
                                        .crop_x0 = crop[0],
                                        .crop_x1 = crop[1],
                                        .crop_y0 = crop[2],
                                        .crop_y1 = crop[3]};
    assert_int_equal(aur_renderer_create(scene, &renderer, NULL), AUR_OK);
    assert_int_equal(aur_renderer_render(renderer, &options, &image, NULL, NULL), AUR_OK);
    aur_renderer_destroy(renderer);
    return image;
}

/* A crop that cuts through tiles and blocks of 4 x 4 pixels is bit-identical to that part of the whole image,
 * though packets, shared patterns and edge detection use neighbours. */
static void a_crop_equals_a_part_of_the_image(void **state) {
    (void)state;
    static const char *const integrators[] = {"path",
                                              "path:interleaved=true,rr_depth=2",
                                              "finalgather:photons=5000,diffuse_samples=8",
                                              "finalgather:photons=5000,diffuse_samples=2,share=true",
                                              "finalgather:photons=5000,diffuse_samples=4,share=near",
                                              "finalgather:photons=5000,pattern=sobol,edges=8"};
    static const size_t whole[4] = {0, 45, 0, 37}, part[4] = {5, 30, 14, 19};
    aur_scene *scene = NULL;
    assert_int_equal(aur_scene_load(AUR_SOURCE_DIR "/scenes/cornell-box/cornell-box.xml", NULL, &scene, NULL),
                     AUR_OK);
    for (size_t i = 0; i < sizeof integrators / sizeof integrators[0]; ++i) {
        aur_image *const all = render(scene, integrators[i], whole);
        aur_image *const some = render(scene, integrators[i], part);
        const size_t channels = some->channel_count;
        assert_int_equal(channels, all->channel_count);
        for (size_t y = part[2]; y < part[3]; ++y)
            assert_memory_equal(&some->data[channels * (y - part[2]) * some->width],
                                &all->data[channels * (y * all->width + part[0])],
                                channels * some->width * sizeof *some->data);
        aur_image_destroy(all);
        aur_image_destroy(some);
    }
    aur_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_crop_equals_a_part_of_the_image)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
