/* Counts and reports of samples that a render discards or truncates. */
#include "render/scene/scene_text.h"

#include <aureole-render/render.h>
#include <math.h>

#include "render/gather/incident.h"

enum { SIDE = 8, SAMPLES = 16, DIRECTIONS = 1024 };

static void store_message(void *user, const char *message) {
    snprintf(user, 512, "%s", message);
}

static aur_render_statistics statistics_of(const char *integrator, const char *body, char said[512]) {
    aur_scene *const scene = must_load_body(body);
    aur_renderer *renderer;
    aur_image *image;
    aur_render_statistics statistics = {.size = sizeof statistics};
    aur_render_options options = {.size = sizeof options};
    aur_render_options_init(&options, NULL);
    options.width = options.height = SIDE;
    options.samples_per_pixel = SAMPLES;
    options.integrator = integrator;
    options.filter = "box";
    options.warnings = (aur_warnings){store_message, said};
    said[0] = '\0';
    assert_int_equal(aur_renderer_create(scene, &renderer, NULL), AUR_OK);
    assert_int_equal(aur_renderer_render(renderer, &options, &image, &statistics, NULL), AUR_OK);
    aur_image_destroy(image);
    aur_renderer_destroy(renderer);
    aur_scene_destroy(scene);
    assert_int_equal(statistics.samples, SIDE * SIDE * SAMPLES);
    return statistics;
}

/* The square of a radiance of 1e30, which the variance is found from, is no float: samples that see the light
 * are left out. It covers one half of the image, and ends between pixels. */
static void invalid_samples_are_counted(void **state) {
    (void)state;
    char said[512];
    const aur_render_statistics s =
        statistics_of("aov:aovs=v:variance",
                      "<emitter type='constant'/><shape type='rectangle'><transform name='to_world'><rotate "
                      "y='1' angle='180'/>"
                      "<scale x='50' y='50'/><translate x='50' z='9'/></transform><emitter type='area'>"
                      "<rgb name='radiance' value='1e30'/></emitter></shape>",
                      said);
    assert_int_equal(s.invalid_samples, s.samples / 2);
    assert_int_equal(s.cut_paths, 0);
    assert_string_equal(said, "512 of 1024 samples were NaN, infinite or negative and are left out");
}

/* Within a mirror that absorbs nothing all paths are cut. */
static void cut_paths_are_counted(void **state) {
    (void)state;
    char said[512];
    const aur_render_statistics s = statistics_of(
        "finalgather",
        "<emitter type='constant'/><shape type='sphere'><bsdf type='twosided'><bsdf type='conductor'>"
        "<string name='material' value='none'/></bsdf></bsdf></shape>",
        said);
    assert_int_equal(s.cut_paths, s.samples);
    assert_int_equal(s.invalid_samples, 0);
    assert_non_null(strstr(said, "1024 paths of 1024 samples were cut"));
}

/* Gather rays from a small square are reflected within a large mirror, and each reflection goes on with
 * probability 0.95: those that survive one more than the longest chain are cut, and no others. Their number
 * is binomial; the limits are 5 standard deviations (1 in 1.7 million). One ray in 3 million meets the
 * square. */
static void cut_chains_of_gather_rays_are_counted(void **state) {
    (void)state;
    char said[512];
    const aur_render_statistics s = statistics_of(
        "finalgather:diffuse_samples=1024,photons=1000",
        "<emitter type='point'><point name='position' x='0' y='0' z='0.01'/></emitter>"
        "<shape type='rectangle'><transform name='to_world'><scale value='0.04'/>"
        "<rotate y='1' angle='180'/><translate z='0.02'/></transform></shape>"
        "<shape type='sphere'><float name='radius' value='100'/><point name='center' x='0' y='0' z='50'/>"
        "<bsdf type='twosided'><bsdf type='conductor'><string name='material' value='none'/></bsdf></bsdf>"
        "</shape>",
        said);
    const double p = pow(0.95, AUR_LONGEST_CHAIN + 1.0), rays = SIDE * SIDE * DIRECTIONS;
    const double margin = 5.0 * sqrt(rays * p * (1.0 - p)), expected = rays * p;
    assert_true(fabs((double)s.cut_paths - expected) < margin);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(invalid_samples_are_counted),
                                       cmocka_unit_test(cut_paths_are_counted),
                                       cmocka_unit_test(cut_chains_of_gather_rays_are_counted)};
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
