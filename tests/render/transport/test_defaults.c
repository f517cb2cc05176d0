/* Options that are on by default for speed trace no more rays than the plain form. `aureole-bench defaults`
 * compares the same rows by time. */
#include "check.h"
#include "program/lab/gather.h"

#include <aureole-render/render.h>
#include <stdio.h>

typedef struct default_row {
    const char *scene, *usual, *plain;
    bool same; /* as many rays; else fewer */
} default_row;

static const default_row rows[] = {
    {"cornell-box/cornell-box.xml", "path", "path:packets=false", true},
    {"cornell-box/glossy.xml", "path", "path:packets=false", true},
    {"keller/cube.xml", "path", "path:packets=false", true},
    {"cornell-box/cornell-box.xml", "finalgather:photons=5000,diffuse_samples=16",
     "finalgather-lab:photons=5000,diffuse_samples=16,packets=false", true},
    {"cornell-box/glossy.xml", "finalgather:photons=5000,diffuse_samples=16,glossy_samples=8",
     "finalgather-lab:photons=5000,diffuse_samples=16,glossy_samples=8,packets=false", true},
    /* Other rotations find other short rays. */
    {"cornell-box/glossy.xml", "finalgather:photons=5000,diffuse_samples=16,glossy_samples=8,short_rays=0",
     "finalgather-lab:photons=5000,diffuse_samples=16,glossy_samples=8,short_rays=0,rotations=0", true},
    {"cornell-box/glossy.xml", "ao:samples=16", "ao:samples=16,rotations=0", true},
    {"keller/living-room.xml", "radiosity:gather_samples=4", "radiosity:gather_samples=4,light_sampling=all",
     false},
};

/* By a renderer that has nothing prepared. */
static uint64_t rays_of(const aur_scene *scene, const char *integrator) {
    aur_renderer *renderer;
    assert_int_equal(aur_renderer_create(scene, &renderer, NULL), AUR_OK);
    const aur_render_options options = {.size = sizeof options,
                                        .integrator = integrator,
                                        .gather = &lab_finalgather,
                                        .width = 24,
                                        .height = 24,
                                        .samples_per_pixel = 4};
    aur_render_statistics statistics = {.size = sizeof statistics};
    aur_image *image;
    assert_int_equal(aur_renderer_render(renderer, &options, &image, &statistics, NULL), AUR_OK);
    aur_image_destroy(image);
    aur_renderer_destroy(renderer);
    assert_true(statistics.rays > 0);
    return statistics.rays;
}

static void defaults_trace_no_more_rays(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; ++i) {
        char path[512];
        snprintf(path, sizeof path, "%s/scenes/%s", AUR_SOURCE_DIR, rows[i].scene);
        aur_scene *scene;
        assert_int_equal(aur_scene_load(path, NULL, &scene, NULL), AUR_OK);
        const uint64_t usual = rays_of(scene, rows[i].usual), plain = rays_of(scene, rows[i].plain);
        print_message("%s, %s: %llu rays, plain %llu\n", rows[i].scene, rows[i].usual,
                      (unsigned long long)usual, (unsigned long long)plain);
        /* Roundings of lanes send a few paths another way. */
        assert_true(rows[i].same ? (double)usual <= 1.001 * (double)plain : usual < plain);
        aur_scene_destroy(scene);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(defaults_trace_no_more_rays)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
