/* Clamping of the light that later path vertices add to a sample. */
#include "render/scene/scene_text.h"

#include <aureole-render/adaptive.h>

enum { SIDE = 16, VALUES = 3 * SIDE * SIDE };

/* A small bright emitter in front of a mirror and a grey wall, so that some samples are fireflies; it is
 * visible. */
static const char body[] =
    "<shape type='rectangle'><transform name='to_world'><scale value='4'/><rotate y='1' "
    "angle='180'/><translate "
    "z='6'/></transform><bsdf type='diffuse'/></shape><shape type='sphere'><point name='center' x='1' z='5'/>"
    "<bsdf type='roughconductor'><float name='alpha' value='.1'/></bsdf></shape><shape type='sphere'><float "
    "name='radius' value='.3'/><point name='center' x='-1' y='.5' z='4'/><emitter type='area'><rgb "
    "name='radiance' "
    "value='40 30 20'/></emitter></shape>";

static aur_image *render(const aur_scene *scene, const char *integrator, double clamp, size_t samples) {
    aur_renderer *renderer = NULL;
    aur_image *image = NULL;
    aur_error error = {0};
    aur_render_options options = {.size = sizeof options};
    assert_int_equal(aur_render_options_init(&options, NULL), AUR_OK);
    options.integrator = integrator;
    options.width = options.height = SIDE;
    options.samples_per_pixel = samples;
    options.filter = "box";
    options.clamp = clamp;
    assert_int_equal(aur_renderer_create(scene, &renderer, NULL), AUR_OK);
    if (aur_renderer_render(renderer, &options, &image, NULL, &error) != AUR_OK)
        fail_msg("%s: %s", integrator, error.message);
    aur_renderer_destroy(renderer);
    return image;
}

/* The clamped image plus the removed light is the image without a limit; single samples are at most the limit
 * plus the first surface's emission. */
static void takes_no_more_than_it_says(void **state) {
    (void)state;
    static const char *const integrators[][2] = {
        {"path", "path:max_depth=1"},
        {"path:packets=false", "path:max_depth=1,packets=false"},
        {"path:hide_emitters=true", "path:max_depth=1,hide_emitters=true"},
        {"volpath", "volpath:max_depth=1"},
    };
    aur_scene *const scene = must_load_body(body);
    for (size_t i = 0; i < sizeof integrators / sizeof integrators[0]; ++i)
        for (size_t samples = 1; samples <= 8; samples += 7) {
            const double limit = 0.25;
            aur_image *const all = render(scene, integrators[i][0], 0.0, samples);
            aur_image *const limited = render(scene, integrators[i][0], limit, samples);
            aur_image *const unscattered = render(scene, integrators[i][1], 0.0, samples);
            assert_int_equal(aur_image_channel_count(all), 3);
            assert_int_equal(aur_image_channel_count(limited), 6);
            assert_string_equal(aur_image_channel_name(limited, 3), "clamped.R");
            double taken = 0.0;
            for (size_t k = 0; k < VALUES; ++k) {
                const float *const pixel = &aur_image_data(limited)[k / 3 * 6 + k % 3];
                const double whole = (double)aur_image_data(all)[k];
                taken += (double)pixel[3];
                assert_true(pixel[3] >= 0.0f);
                assert_near((double)pixel[0] + (double)pixel[3], whole, 1e-5 * whole);
                assert_true((double)pixel[0] <=
                            (double)aur_image_data(unscattered)[k] * (1.0 + 1e-5) + limit * (1.0 + 1e-5));
            }
            assert_true(taken > 0.0);
            aur_image_destroy(all);
            aur_image_destroy(limited);
            aur_image_destroy(unscattered);
        }
    aur_scene_destroy(scene);
}

/* A limit that nothing reaches changes no bit. */
static void changes_nothing_below(void **state) {
    (void)state;
    aur_scene *const scene = must_load_body(body);
    aur_image *const all = render(scene, "path", 0.0, 4), *const limited = render(scene, "path", 1e20, 4);
    for (size_t k = 0; k < VALUES; ++k) {
        assert_true(aur_image_data(limited)[k / 3 * 6 + k % 3] == aur_image_data(all)[k]);
        assert_true(aur_image_data(limited)[k / 3 * 6 + 3 + k % 3] == 0.0f);
    }
    aur_image_destroy(all);
    aur_image_destroy(limited);
    aur_scene_destroy(scene);
}

/* Integrators without the key, and limits that are none. */
static void refuses(void **state) {
    (void)state;
    static const struct {
        const char *integrator;
        double clamp;
        size_t samples;
        const char *message;
    } rows[] = {
        {"finalgather", 1.0, 4, "'clamp'"},
        {"path", -1.0, 4, "'clamp'"},
        {"path:clamp=2", 1.0, 4, "'clamp'"},
    };
    aur_scene *const scene = must_load_body(body);
    aur_renderer *renderer = NULL;
    assert_int_equal(aur_renderer_create(scene, &renderer, NULL), AUR_OK);
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; ++i) {
        aur_render *created = NULL;
        aur_error error = {0};
        aur_render_options options = {.size = sizeof options};
        assert_int_equal(aur_render_options_init(&options, NULL), AUR_OK);
        options.integrator = rows[i].integrator;
        options.samples_per_pixel = rows[i].samples;
        options.clamp = rows[i].clamp;
        assert_true(aur_render_create(renderer, &options, &created, &error) != AUR_OK);
        assert_non_null(strstr(error.message, rows[i].message));
        aur_render_destroy(created);
    }
    aur_renderer_destroy(renderer);
    aur_scene_destroy(scene);
}

/* The interval of a target is that of the limited image, next to a long render with the same limit. */
static void has_an_interval(void **state) {
    (void)state;
    aur_scene *const scene = must_load_body(body);
    aur_image *const reference = render(scene, "path", 0.05, 4096);
    aur_renderer *renderer = NULL;
    assert_int_equal(aur_renderer_create(scene, &renderer, NULL), AUR_OK);
    size_t missed = 0;
    for (uint64_t seed = 1; seed <= 5; ++seed) {
        aur_render_options options = {.size = sizeof options};
        assert_int_equal(aur_render_options_init(&options, NULL), AUR_OK);
        aur_adaptive_options target = {.size = sizeof target};
        assert_int_equal(aur_adaptive_options_init(&target, NULL), AUR_OK);
        options.integrator = "path";
        options.width = options.height = SIDE;
        options.filter = "box";
        options.clamp = 0.05;
        options.seed = seed;
        target.error = 0.05;
        target.measure = AUR_ERROR_MEASURE_MEAN;
        aur_adaptive *adaptive = NULL;
        aur_image *image = NULL;
        aur_adaptive_report report = {.size = sizeof report};
        double error = 0.0;
        assert_int_equal(aur_adaptive_create(renderer, &options, &target, &adaptive, NULL), AUR_OK);
        assert_int_equal(aur_adaptive_run(adaptive, NULL), AUR_OK);
        assert_int_equal(aur_adaptive_get_report(adaptive, &report, NULL), AUR_OK);
        assert_int_equal(aur_adaptive_develop(adaptive, false, &image, NULL), AUR_OK);
        assert_int_equal(aur_image_channel_count(image), 6);
        assert_string_equal(aur_image_channel_name(image, 3), "clamped.R");
        assert_int_equal(aur_image_error(reference, image, target.measure, &error, NULL), AUR_OK);
        print_message("%g in [%g, %g]\n", error, report.error_low, report.error_high);
        assert_true(report.error_high <= target.error);
        missed += error < report.error_low || error > report.error_high;
        aur_image_destroy(image);
        aur_adaptive_destroy(adaptive);
    }
    assert_true(missed <= 1); /* at 95 %, more in one of 44 */
    aur_image_destroy(reference);
    aur_renderer_destroy(renderer);
    aur_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(takes_no_more_than_it_says),
        cmocka_unit_test(changes_nothing_below),
        cmocka_unit_test(refuses),
        cmocka_unit_test(has_an_interval),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
