/* Emitters of a few pixels are sampled by many probe rays wherever they are, from the scene description,
 * because samples may miss them. */
#include "check.h"

#include <math.h>

#include "program/lab/gather.h"
#include "render/driver/renderer.h"
#include "render/film/integrator.h"
#include "render/scene/scene_text.h"
#include <aureole-render/render.h>

/* A sphere of radius .05 and radiance 1000 at a distance of 10, 45 degrees across 32 pixels: it covers a
 * ninth of the pixel that it is in. */
enum { SIDE = 32, SAMPLES = 4, EDGES = 64, RUNS = 512 };
static const double radius = 0.05, distance = 10.0, radiance = 1000.0;
static const char body[] =
    "<shape type='sphere'><point name='center' x='-0.1' y='0.1' z='10'/><float name='radius' value='0.05'/>"
    "<bsdf type='diffuse'><rgb name='reflectance' value='0'/></bsdf>"
    "<emitter type='area'><rgb name='radiance' value='1000'/></emitter></shape>";

static double share_of_emitter(void) {
    const double pixel = 2.0 * tan(22.5 * AUR_PI / 180.0) / SIDE;
    return AUR_PI * radius * radius / (distance * distance * pixel * pixel);
}

static aur_render_options options_of(const char *integrator, const char *filter, uint64_t seed) {
    aur_render_options options = {.size = sizeof options};
    aur_render_options_init(&options, NULL);
    options.width = options.height = SIDE;
    options.integrator = integrator;
    options.gather = &lab_finalgather;
    options.filter = filter;
    options.sampler = "random";
    options.samples_per_pixel = SAMPLES;
    options.seed = seed;
    options.threads = 1;
    return options;
}

/* The images' sums of R have the lamp's radiance times its share as their mean, and the variance of as many
 * random samples as there are rays; by four alone it would be 17 times that. A wide filter spreads the share
 * over pixels with small chances, whose variances come to no more. Over 512 seeds a variance varies by a
 * 16th: twice is 16 of these. */
static void hits_the_emitter_by_all_rays(void **state) {
    (void)state;
    aur_scene *const scene = must_load_body(body);
    aur_renderer *renderer = NULL;
    assert_int_equal(aur_renderer_create(scene, &renderer, NULL), AUR_OK);
    static const char *const filters[] = {"box", "gaussian"};
    for (size_t f = 0; f < 2; ++f) {
        double sum = 0.0, squares = 0.0;
        for (size_t s = 0; s < RUNS; ++s) {
            const aur_render_options options =
                options_of("finalgather-lab:incident=emitters,edges=64", filters[f], s);
            aur_image *image = NULL;
            assert_int_equal(aur_renderer_render(renderer, &options, &image, NULL, NULL), AUR_OK);
            double value = 0.0;
            for (size_t i = 0; i < (size_t)SIDE * SIDE; ++i)
                value += (double)aur_image_data(image)[3 * i];
            sum += value;
            squares += value * value;
            aur_image_destroy(image);
        }
        const double share = share_of_emitter(), mean = sum / RUNS;
        const double variance = (squares - sum * mean) / (RUNS - 1);
        const double expected = radiance * radiance * share * (1.0 - share) / (SAMPLES + EDGES);
        print_message("%s: mean %g of %g, variance %g of %g\n", filters[f], mean, radiance * share, variance,
                      expected);
        assert_near(mean, radiance * share, 5.0 * sqrt(expected / RUNS));
        assert_true(variance < 2.0 * expected);
    }
    aur_renderer_destroy(renderer);
    aur_scene_destroy(scene);
}

/* Pixels are those around the emitter's, as far as the filter reaches, and none without edges requested. */
static void marks_what_the_filter_reaches(void **state) {
    (void)state;
    static const struct {
        const char *integrator, *filter;
        size_t side; /* of the square that is marked */
    } cases[] = {{"finalgather-lab:incident=emitters", "box", 1},
                 {"finalgather-lab:incident=emitters", "gaussian", 5},
                 {"finalgather-lab:incident=emitters,edges=0", "box", 0},
                 {"finalgather-lab:incident=emitters,pixel=centre", "box", 0}};
    aur_scene *const scene = must_load_body(body);
    aur_renderer *renderer = NULL;
    assert_int_equal(aur_renderer_create(scene, &renderer, NULL), AUR_OK);
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
        const aur_render_options options = options_of(cases[i].integrator, cases[i].filter, 1);
        aur_render *render = NULL;
        assert_int_equal(aur_render_create(renderer, &options, &render, NULL), AUR_OK);
        const uint16_t *const probes = aur_render_integrator(render)->emitter_probes;
        const long reach = (long)cases[i].side / 2, x0 = SIDE / 2, y0 = SIDE / 2 - 1;
        for (long p = 0; p < (long)SIDE * SIDE; ++p) {
            const bool within =
                cases[i].side > 0 && labs(p % SIDE - x0) <= reach && labs(p / SIDE - y0) <= reach;
            assert_true((probes != NULL && probes[p] > 0) == within);
        }
        aur_render_destroy(render);
    }
    aur_renderer_destroy(renderer);
    aur_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(hits_the_emitter_by_all_rays),
                                       cmocka_unit_test(marks_what_the_filter_reaches)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
