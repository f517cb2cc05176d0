/* Emitter rays: the visible share of an emitter in pixels against its size in closed form, the reduction of
 * variance, and identical bits in packets, by single paths, in any steps, in crops and with any threads. */
#include "check.h"

#include <math.h>

#include "render/scene/scene_text.h"
#include <aureole-render/film.h>
#include <aureole-render/render.h>

/* A sphere of radius .2 and radiance 100 at a distance of 10, 45 degrees across 32 pixels, before a square
 * that it lights: its image has a diameter of 1.5 pixels. */
enum { SIDE = 32, SEEDS = 64 };
static const double radius = 0.2, distance = 10.0, radiance = 100.0;
static const char body[] =
    "<shape type='sphere'><point name='center' x='0' y='0' z='10'/><float name='radius' value='0.2'/>"
    "<bsdf type='diffuse'><rgb name='reflectance' value='0'/></bsdf>"
    "<emitter type='area'><rgb name='radiance' value='100'/></emitter></shape>"
    "<shape type='rectangle'><transform name='to_world'><scale value='20'/><rotate y='1' angle='180'/>"
    "<translate z='12'/></transform><bsdf type='diffuse'><rgb name='reflectance' value='.5'/></bsdf></shape>";

static aur_render_options options_of(const char *integrator, size_t seed) {
    aur_render_options options = {.size = sizeof options};
    aur_render_options_init(&options, NULL);
    options.width = options.height = SIDE;
    options.filter = "box";
    options.sampler = "sobol";
    options.integrator = integrator;
    options.samples_per_pixel = 4;
    options.seed = seed;
    return options;
}

/* The image by steps of so many samples. */
static aur_image *image_in_steps(aur_renderer *renderer, const aur_render_options *options, size_t step) {
    aur_render *render = NULL;
    aur_image *image = NULL;
    assert_int_equal(aur_render_create(renderer, options, &render, NULL), AUR_OK);
    for (size_t done = 0; done < options->samples_per_pixel; done += step)
        assert_int_equal(aur_render_step(render, step, NULL), AUR_OK);
    assert_int_equal(aur_film_develop(aur_render_film(render), &image, NULL), AUR_OK);
    aur_render_destroy(render);
    return image;
}

/* Mean and variance over seeds of the sum of R over all pixels. */
typedef struct moments {
    double mean, variance;
} moments;

static moments measure(aur_renderer *renderer, const char *integrator) {
    double sum = 0.0, squares = 0.0;
    for (size_t seed = 0; seed < SEEDS; ++seed) {
        const aur_render_options options = options_of(integrator, seed);
        aur_image *const image = image_in_steps(renderer, &options, 4);
        double value = 0.0;
        for (size_t i = 0; i < (size_t)SIDE * SIDE; ++i)
            value += (double)aur_image_data(image)[3 * i];
        sum += value;
        squares += value * value;
        aur_image_destroy(image);
    }
    return (moments){sum / SEEDS, (squares - sum * sum / SEEDS) / (SEEDS - 1)};
}

/* On the axis the emitter's outline is a circle of tangent r / root(d^2 - r^2), exactly. With camera rays
 * only, the variance is many times larger: for four samples, n^-1.5 with a mean number of probes of some
 * dozens. */
static void reports_the_visible_share_of_an_emitter(void **state) {
    (void)state;
    aur_scene *const scene = must_load_body(body);
    aur_renderer *renderer = NULL;
    assert_int_equal(aur_renderer_create(scene, &renderer, NULL), AUR_OK);
    const double pixel = 2.0 * tan(22.5 * AUR_PI / 180.0) / SIDE;
    const double emitter =
        radiance * AUR_PI * radius * radius / (distance * distance - radius * radius) / (pixel * pixel);
    const moments with = measure(renderer, "path:max_depth=1");
    const moments without = measure(renderer, "path:max_depth=1,lamp_rays=0");
    const double z = (with.mean - emitter) / sqrt(with.variance / SEEDS);
    const double z_without = (without.mean - emitter) / sqrt(without.variance / SEEDS);
    print_message("%.4f and %.3f of %.4f, z %.2f and %.2f, variances %.3g of %.3g\n", with.mean, without.mean,
                  emitter, z, z_without, with.variance, without.variance);
    assert_true(fabs(z) < 4.0 && fabs(z_without) < 4.0); /* one time in 8,000 of normal values */
    assert_true(with.variance < 0.05 * without.variance);
    /* The light of paths is the same, whichever rays count the directly visible emission. */
    const moments paths = measure(renderer, "path"), plain = measure(renderer, "path:lamp_rays=0");
    assert_true(fabs(paths.mean - plain.mean) < 4.0 * sqrt((paths.variance + plain.variance) / SEEDS));
    assert_true(paths.mean > 1.01 * with.mean && paths.variance < plain.variance);
    aur_renderer_destroy(renderer);
    aur_scene_destroy(scene);
}

static void assert_same_values(aur_image *a, aur_image *b) {
    assert_memory_equal(aur_image_data(a), aur_image_data(b), sizeof(float[3]) * SIDE * SIDE);
}

static void same_bits_in_any_way(void **state) {
    (void)state;
    aur_scene *const scene = must_load_body(body);
    aur_renderer *renderer = NULL;
    assert_int_equal(aur_renderer_create(scene, &renderer, NULL), AUR_OK);
    aur_render_options options = options_of("path", 1);
    options.threads = 1;
    aur_image *const whole = image_in_steps(renderer, &options, 4);
    aur_image *const steps = image_in_steps(renderer, &options, 1);
    options.threads = 3;
    aur_image *const threads = image_in_steps(renderer, &options, 4);
    options.integrator = "path:packets=false,max_depth=1";
    aur_image *const singles = image_in_steps(renderer, &options, 4);
    options.integrator = "path:max_depth=1";
    aur_image *const packets = image_in_steps(renderer, &options, 4);
    assert_same_values(whole, steps);
    assert_same_values(whole, threads);
    assert_same_values(packets, singles);
    options.integrator = "path";
    options.crop_x0 = options.crop_y0 = SIDE / 2 - 1;
    options.crop_x1 = options.crop_y1 = SIDE / 2 + 3;
    aur_image *const crop = image_in_steps(renderer, &options, 4);
    for (size_t y = 0; y < 4; ++y)
        assert_memory_equal(aur_image_data(crop) + 12 * y,
                            aur_image_data(whole) + 3 * ((SIDE / 2 - 1 + y) * SIDE + SIDE / 2 - 1),
                            sizeof(float[12]));
    aur_image *const all[] = {whole, steps, threads, singles, packets, crop};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; ++i)
        aur_image_destroy(all[i]);
    aur_renderer_destroy(renderer);
    aur_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(reports_the_visible_share_of_an_emitter),
                                       cmocka_unit_test(same_bits_in_any_way)};
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
