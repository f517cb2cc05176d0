/* Rendering to an error chooses the candidates of path tracing by trial. */
#include "render/scene/scene_text.h"

#include <aureole-render/adaptive.h>

/* A sky that is brighter at the horizon, with one spot that has some half of its power. */
static void write_sky(void) {
    enum { WIDTH = 32, HEIGHT = 16 };
    char file[64 + sizeof(float[3]) * WIDTH * HEIGHT];
    size_t used = (size_t)snprintf(file, sizeof file, "PF\n%d %d\n-1.0\n", WIDTH, HEIGHT);
    for (size_t i = 0; i < (size_t)WIDTH * HEIGHT; ++i) {
        const float height = ((float)(i / WIDTH) + 0.5f) / HEIGHT;
        const float value = i == 12 * WIDTH + 5 ? 150.0f : 0.2f + 2.0f * height * (1.0f - height);
        const float rgb[3] = {value, value, value};
        memcpy(file + used, rgb, sizeof rgb);
        used += sizeof rgb;
    }
    write_file("sky.pfm", file, used);
}

static const char open_floor[] =
    "<shape type='rectangle'><transform name='to_world'><scale value='50'/><rotate x='1' angle='-90'/>"
    "<translate y='-1'/></transform><bsdf type='roughplastic'><float name='alpha' value='.2'/></bsdf>"
    "</shape><emitter type='envmap'><string name='filename' value='sky.pfm'/></emitter>";
/* One lamp, which leaves no choice. */
static const char lit_floor[] =
    "<shape type='rectangle'><transform name='to_world'><scale value='50'/><rotate x='1' angle='-90'/>"
    "<translate y='-1'/></transform><bsdf type='roughplastic'><float name='alpha' value='.2'/></bsdf>"
    "</shape><shape type='rectangle'><transform name='to_world'><scale value='2'/><rotate x='1' angle='90'/>"
    "<translate y='2' z='6'/></transform><emitter type='area'><rgb name='radiance' value='5'/></emitter>"
    "</shape>";

static aur_adaptive *adaptive(aur_renderer *renderer, const char *integrator, size_t threads) {
    aur_render_options options = {.size = sizeof options};
    aur_render_options_init(&options, NULL);
    options.width = options.height = 72; /* fewer than 64 a side are not tried in fewer pixels */
    options.filter = "box";
    options.threads = threads;
    options.integrator = integrator;
    aur_adaptive_options target = {.size = sizeof target};
    aur_adaptive_options_init(&target, NULL);
    target.measure = AUR_ERROR_MEASURE_MEAN;
    target.error = 0.005;
    aur_adaptive *asked = NULL;
    assert_int_equal(aur_adaptive_create(renderer, &options, &target, &asked, NULL), AUR_OK);
    assert_int_equal(aur_adaptive_run(asked, NULL), AUR_OK);
    return asked;
}

static aur_image *picture_of(const aur_adaptive *asked) {
    aur_image *image = NULL;
    assert_int_equal(aur_adaptive_develop(asked, true, &image, NULL), AUR_OK);
    return image;
}

/* On an open floor under a sky candidates halve the variance and more. Who names the same integrator has the
 * same bits, on any threads. */
static void candidates_are_taken_under_a_sky(void **state) {
    (void)state;
    aur_renderer *renderer = NULL;
    write_sky();
    aur_scene *const scene = must_load_body(open_floor);
    assert_int_equal(aur_renderer_create(scene, &renderer, NULL), AUR_OK);
    aur_adaptive *const a = adaptive(renderer, NULL, 1);
    const char *const taken = aur_adaptive_integrator(a);
    assert_non_null(strstr(taken, "path:"));
    assert_non_null(strstr(taken, "candidates="));
    aur_adaptive *const b = adaptive(renderer, taken, 3);
    aur_image *const x = picture_of(a), *const y = picture_of(b);
    assert_memory_equal(aur_image_data(x), aur_image_data(y),
                        aur_image_width(x) * aur_image_height(x) * 6 * sizeof(float));
    aur_image_destroy(x);
    aur_image_destroy(y);
    aur_adaptive_destroy(a);
    aur_adaptive_destroy(b);
    aur_renderer_destroy(renderer);
    aur_scene_destroy(scene);
}

static void one_lamp_has_no_candidates(void **state) {
    (void)state;
    aur_renderer *renderer = NULL;
    aur_scene *const scene = must_load_body(lit_floor);
    assert_int_equal(aur_renderer_create(scene, &renderer, NULL), AUR_OK);
    aur_adaptive *const asked = adaptive(renderer, NULL, 0);
    assert_null(strstr(aur_adaptive_integrator(asked), "candidates="));
    aur_adaptive_destroy(asked);
    aur_renderer_destroy(renderer);
    aur_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(candidates_are_taken_under_a_sky),
                                       cmocka_unit_test(one_lamp_has_no_candidates)};
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
