/* Pixels that share samples: every sample counts in all pixels that its filter reaches. */
#include "check.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <aureole-render/render.h>

#include "render/driver/renderer.h"
#include "render/film/film.h"
#include "render/film/integrator.h"
#include "render/image/format.h"

enum { WIDTH = 37, HEIGHT = 21, PIXELS = WIDTH * HEIGHT, SAMPLES = 3 };

static const char *const filters[] = {"tent", "gaussian", "mitchell", "catmullrom", "lanczos"};
enum { FILTER_COUNT = sizeof filters / sizeof filters[0] };

typedef struct fixture {
    aur_scene *scene;
    aur_renderer *renderer;
} fixture;

static int set_up(void **state) {
    fixture *const f = calloc(1, sizeof *f);
    assert_int_equal(
        aur_scene_load(AUR_SOURCE_DIR "/scenes/cornell-box/cornell-box.xml", NULL, &f->scene, NULL), AUR_OK);
    assert_int_equal(aur_renderer_create(f->scene, &f->renderer, NULL), AUR_OK);
    *state = f;
    return 0;
}

static int tear_down(void **state) {
    fixture *const f = *state;
    aur_renderer_destroy(f->renderer);
    aur_scene_destroy(f->scene);
    free(f);
    return 0;
}

static aur_render_options options_of(const char *integrator, const char *filter) {
    return (aur_render_options){.size = sizeof(aur_render_options),
                                .integrator = integrator,
                                .filter = filter,
                                .samples_per_pixel = SAMPLES,
                                .width = WIDTH,
                                .height = HEIGHT,
                                .threads = 1};
}

static aur_render *start(const fixture *f, const aur_render_options *options) {
    aur_render *render = NULL;
    aur_error error = {0};
    if (aur_render_create(f->renderer, options, &render, &error) != AUR_OK)
        fail_msg("%s", error.message);
    return render;
}

static aur_image *develop(const aur_render *render) {
    aur_image *image = NULL;
    assert_int_equal(aur_film_develop(aur_render_film(render), &image, NULL), AUR_OK);
    return image;
}

static aur_image *render_all(const fixture *f, const aur_render_options *options) {
    aur_render *const render = start(f, options);
    assert_int_equal(aur_render_step(render, 0, NULL), AUR_OK);
    aur_image *const image = develop(render);
    aur_render_destroy(render);
    return image;
}

static void assert_same(aur_image *a, aur_image *b) {
    assert_int_equal(a->channel_count, b->channel_count);
    assert_memory_equal(a->data, b->data, a->width * a->height * a->channel_count * sizeof *a->data);
    aur_image_destroy(b);
}

/* All samples of all pixels of a render, and where they lie. */
static float values[PIXELS][SAMPLES][3], offsets[PIXELS][SAMPLES][2];

static void take_samples(const fixture *f, aur_render *render) {
    const aur_integrator *const integrator = aur_render_integrator(render);
    aur_sampler *sampler = NULL;
    assert_int_equal(aur_sampler_create(aur_scene_sampler(f->scene), SAMPLES, NULL, &sampler, NULL), AUR_OK);
    const aur_view view = {.scene = f->scene,
                           .sampler = sampler,
                           .filter = aur_filter_find("box"),
                           .width = WIDTH,
                           .height = HEIGHT};
    aur_counters counters = {0};
    for (size_t i = 0; i < PIXELS * SAMPLES; ++i) {
        const size_t pixel = i / SAMPLES, s = i % SAMPLES;
        aur_camera_sample sample;
        aur_view_sample(&view, pixel % WIDTH, pixel / WIDTH, (uint32_t)s, &sample);
        const aur_vector l = integrator->descriptor->radiance(integrator, &sample, &counters);
        memcpy(values[pixel][s], (const float[3]){l.x, l.y, l.z}, sizeof values[pixel][s]);
        memcpy(offsets[pixel][s], sample.offset, sizeof sample.offset);
    }
    aur_sampler_destroy(sampler);
}

/* The weight of sample `i` of all in a pixel. */
static double weight_of(const aur_filter *filter, size_t i, size_t pixel) {
    const size_t other = i / SAMPLES, s = i % SAMPLES;
    const double x = (double)(other % WIDTH) - (double)(pixel % WIDTH);
    const double y = (double)(other / WIDTH) - (double)(pixel / WIDTH);
    return fabs(x) > 4.0 || fabs(y) > 4.0 ? 0.0
                                          : aur_filter_value(filter, x + (double)offsets[other][s][0]) *
                                                aur_filter_value(filter, y + (double)offsets[other][s][1]);
}

/* Brute force: all samples of all pixels, weighed by the filter's definition. */
static void pixels_are_the_weighed_means_of_all_samples(void **state) {
    const fixture *const f = *state;
    for (size_t k = 0; k < FILTER_COUNT; ++k) {
        const aur_filter *const filter = aur_filter_find(filters[k]);
        const aur_render_options options = options_of("direct", filters[k]);
        aur_render *const render = start(f, &options);
        take_samples(f, render);
        assert_int_equal(aur_render_step(render, 0, NULL), AUR_OK);
        aur_image *const image = develop(render);
        for (size_t pixel = 0; pixel < PIXELS; ++pixel) {
            double sums[3] = {0}, weight = 0.0, sizes = 0.0, most = 0.0;
            for (size_t i = 0; i < PIXELS * SAMPLES; ++i) {
                const double w = weight_of(filter, i, pixel);
                weight += w;
                sizes += fabs(w);
                for (size_t c = 0; c < 3; ++c) {
                    const double value = (double)values[i / SAMPLES][i % SAMPLES][c];
                    sums[c] += w * value;
                    most = w != 0.0 ? fmax(most, value) : most;
                }
            }
            /* The table has an error of at most 1e-5 of the filter's peak, times the number of samples. */
            const double bound = 1e-4 * most * (1.0 + sizes) / weight;
            for (size_t c = 0; c < 3; ++c)
                assert_true(fabs((double)image->data[3 * pixel + c] - sums[c] / weight) <= bound);
        }
        aur_image_destroy(image);
        aur_render_destroy(render);
    }
}

/* Brute force: a pixel is the ratio of two sums over cells of pixels, s / w = v, with independent steps of
 * one sample: the variance of the mean of s - v w over a cell's steps, added over cells, over w^2. */
static double brute_error(const aur_filter *filter, size_t cell, size_t pixel) {
    enum { CELLS_MOST = PIXELS };
    static double sums[CELLS_MOST][SAMPLES][2]; /* of red, and of the weights */
    double s = 0.0, w = 0.0, square = 0.0;
    const size_t across = (WIDTH + cell - 1) / cell, cells = across * ((HEIGHT + cell - 1) / cell);
    memset(sums, 0, sizeof sums);
    for (size_t i = 0; i < PIXELS * SAMPLES; ++i) {
        const size_t other = i / SAMPLES, step = i % SAMPLES;
        const double weight = weight_of(filter, i, pixel);
        double *const sum = sums[other / WIDTH / cell * across + other % WIDTH / cell][step];
        sum[0] += weight * (double)values[other][step][0];
        sum[1] += weight;
        s += weight * (double)values[other][step][0];
        w += weight;
    }
    for (size_t k = 0; k < cells; ++k) {
        double mean = 0.0, spread = 0.0;
        for (size_t step = 0; step < SAMPLES; ++step)
            mean += (sums[k][step][0] - s / w * sums[k][step][1]) / SAMPLES;
        for (size_t step = 0; step < SAMPLES; ++step)
            spread += pow(sums[k][step][0] - s / w * sums[k][step][1] - mean, 2.0);
        square += spread * SAMPLES / (SAMPLES - 1);
    }
    return sqrt(square) / w;
}

static void errors_are_those_of_the_steps(void **state) {
    const fixture *const f = *state;
    for (size_t k = 0; k < FILTER_COUNT; ++k) {
        const aur_render_options options = options_of("direct", filters[k]);
        aur_render *const render = start(f, &options);
        take_samples(f, render);
        for (size_t step = 0; step < SAMPLES; ++step)
            assert_int_equal(aur_render_step(render, 1, NULL), AUR_OK);
        const aur_film *const film = aur_render_film(render);
        aur_image *errors = NULL;
        double rmse[4], most = 0.0;
        assert_int_equal(aur_film_error(film, rmse, &errors, NULL), AUR_OK);
        for (size_t i = 0; i < PIXELS; ++i)
            most = fmax(most, (double)errors->data[3 * i]);
        for (size_t i = 0; i < PIXELS; i += 7) {
            const double error = brute_error(aur_filter_find(filters[k]), film->spread->cell, i);
            assert_near((double)errors->data[3 * i], error, 1e-3 * error + 1e-4 * most);
        }
        aur_image_destroy(errors);
        aur_render_destroy(render);
    }
}

static void assert_crop_is_cut(const fixture *f, const aur_render_options *options, const aur_image *whole,
                               const size_t crop[4]) {
    aur_render_options part = *options;
    part.crop_x0 = crop[0];
    part.crop_x1 = crop[1];
    part.crop_y0 = crop[2];
    part.crop_y1 = crop[3];
    aur_image *const image = render_all(f, &part);
    const size_t channels = whole->channel_count;
    for (size_t y = crop[2]; y < crop[3]; ++y)
        assert_memory_equal(&image->data[channels * (y - crop[2]) * image->width],
                            &whole->data[channels * (y * WIDTH + crop[0])],
                            channels * image->width * sizeof *image->data);
    aur_image_destroy(image);
}

static void assert_goes_on(const fixture *f, const aur_render_options *options, aur_image *whole) {
    aur_render *const first = start(f, options);
    assert_int_equal(aur_render_step(first, 1, NULL), AUR_OK);
    assert_int_equal(aur_film_save(aur_render_film(first), "half.film", NULL), AUR_OK);
    aur_film *half = NULL;
    assert_int_equal(aur_film_load("half.film", &half, NULL), AUR_OK);
    remove("half.film");
    aur_render *const second = start(f, options);
    assert_int_equal(aur_render_merge(second, half, NULL), AUR_OK);
    assert_int_equal(aur_render_samples(second), 1);
    assert_int_equal(aur_render_step(second, 0, NULL), AUR_OK);
    assert_same(whole, develop(second));
    aur_film_destroy(half);
    aur_render_destroy(first);
    aur_render_destroy(second);
}

static void assert_is_of_parts(const fixture *f, const aur_render_options *options, aur_image *whole) {
    enum { PARTS = 3 };
    aur_render *const all = start(f, options);
    for (size_t part = PARTS; part > 0; --part) {
        aur_render_options part_options = *options;
        part_options.shard = part;
        part_options.shard_count = PARTS;
        aur_render *const render = start(f, &part_options);
        assert_int_equal(aur_render_step(render, 0, NULL), AUR_OK);
        assert_int_equal(aur_render_merge(all, aur_render_film(render), NULL), AUR_OK);
        aur_render_destroy(render);
    }
    assert_int_equal(aur_render_samples(all), options->samples_per_pixel);
    assert_same(whole, develop(all));
    aur_render_destroy(all);
}

/* Threads, crops that cut tiles or have one pixel, parts, and films continued from a file change no bit. */
static void nothing_changes_a_bit(void **state) {
    const fixture *const f = *state;
    static const char *const integrators[] = {"path", "aov:aovs=(n:sample_count,v:variance,d:depth)", "ao",
                                              "finalgather:photons=2000,diffuse_samples=4,edges=4"};
    static const size_t crops[][4] = {{5, 30, 14, 19}, {17, 18, 15, 16}, {0, 1, 0, 1}, {36, 37, 20, 21}};
    for (size_t k = 0; k < FILTER_COUNT; ++k)
        for (size_t i = 0; i < sizeof integrators / sizeof integrators[0]; ++i) {
            aur_render_options options = options_of(integrators[i], filters[k]);
            aur_image *const whole = render_all(f, &options);
            options.threads = 3;
            assert_same(whole, render_all(f, &options));
            for (size_t c = 0; c < sizeof crops / sizeof crops[0]; ++c)
                assert_crop_is_cut(f, &options, whole, crops[c]);
            if (i < 3) /* finalgather sums its samples step by step */
                assert_goes_on(f, &options, whole);
            assert_is_of_parts(f, &options, whole);
            aur_image_destroy(whole);
        }
}

/* A rectangle has the values of its pixels one by one, which the first test computes from all samples: in a
 * crop, for cells of any size and any numbers of samples. */
static void rectangles_have_the_values_of_their_pixels(void **state) {
    const fixture *const f = *state;
    enum { X0 = 5, X1 = 30, Y0 = 3, Y1 = 20, COLUMNS = X1 - X0, ALL = COLUMNS * (Y1 - Y0) };
    static const size_t corners[][2] = {
        {0, 0}, {0, 15 * COLUMNS + 15}, {2 * COLUMNS + 20, 16 * COLUMNS + 24}, {ALL - 1, ALL - 1}};
    uint32_t targets[ALL];
    for (size_t k = 0; k < 2 * FILTER_COUNT; ++k) {
        aur_render_options options = options_of("aov:aovs=(d:depth,n:position)", filters[k / 2]);
        options.samples_per_pixel = k % 2 == 0 ? SAMPLES : AUR_SAMPLES_PER_PIXEL_MAX; /* in cells of 16, 4 */
        options.crop_x0 = X0, options.crop_x1 = X1, options.crop_y0 = Y0, options.crop_y1 = Y1;
        options.sampler = "sobol";
        aur_render *const render = start(f, &options);
        for (size_t i = 0; i < ALL; ++i)
            targets[i] = (uint32_t)(i % COLUMNS / 4 % SAMPLES + (k % 2 == 0));
        assert_int_equal(aur_render_step_pixels(render, ALL, targets, NULL), AUR_OK);
        const aur_film *const film = aur_render_film(render);
        for (size_t r = 0; r < sizeof corners / sizeof corners[0]; ++r)
            for (size_t first = 0; first <= 4; first += 4) {
                static double read[AUR_TILE_SIZE * AUR_TILE_SIZE][3];
                const size_t width = corners[r][1] % COLUMNS - corners[r][0] % COLUMNS + 1;
                aur_film_colours(film, corners[r], first, read);
                for (size_t i = 0; corners[r][0] + i / width * COLUMNS + i % width <= corners[r][1]; ++i)
                    for (size_t c = 0; c < 3; ++c)
                        assert_true(
                            read[i][c] ==
                            aur_film_mean(film, corners[r][0] + i / width * COLUMNS + i % width, first + c));
            }
        aur_render_destroy(render);
    }
}

/* Cells are weighted by their means. If some pixels have many more samples than others, the image of a simple
 * function of the film is still the filtered one; with equal weights of all samples it would not be. The
 * scene is a camera that sees only depth: its only noise is the samples' positions. */
static void cells_have_equal_weights_for_any_number_of_samples(void **state) {
    const fixture *const f = *state;
    aur_render_options options = options_of("aov:aovs=(d:depth)", "gaussian");
    options.samples_per_pixel = AUR_SAMPLES_PER_PIXEL_MAX;
    options.sampler = "sobol";
    aur_image *images[2];
    static uint32_t targets[PIXELS];
    for (size_t r = 0; r < 2; ++r) {
        aur_render *const render = start(f, &options);
        for (size_t i = 0; i < PIXELS; ++i)
            targets[i] = r == 0 ? 256 : i % WIDTH / 4 % 2 == 0 ? 16 : 256;
        assert_int_equal(aur_render_step_pixels(render, PIXELS, targets, NULL), AUR_OK);
        images[r] = develop(render);
        aur_render_destroy(render);
    }
    double sum = 0.0, square = 0.0;
    for (size_t i = 0; i < PIXELS; ++i) {
        const double a = (double)images[0]->data[4 * i + 3], b = (double)images[1]->data[4 * i + 3];
        sum += fabs(b - a) / a / PIXELS;
        square += a > 0.0;
    }
    assert_int_equal((size_t)square, PIXELS);
    print_message("mean difference of depths: %g\n", sum);
    assert_true(sum < 2e-3); /* 1e-2 if cells counted by their samples */
    aur_image_destroy(images[0]);
    aur_image_destroy(images[1]);
}

/* Direct light by final gathering and by paths, with two seeds each: the products of both differences have a
 * mean of 0 unless one of them filters something else. By blocks of pixels, which share few samples:
 * above 4.5 standard errors once in ten thousand for these 36 blocks (Student), and the numbers are fixed. */
static void gathers_count_where_they_lie(void **state) {
    enum { SIDE = 24, BLOCK = 4, BLOCKS = (SIDE / BLOCK) * (SIDE / BLOCK) };
    static const char text[] =
        "<scene version='3.0.0'><sensor type='perspective'><float name='fov' value='40'/><transform "
        "name='to_world'>"
        "<lookat origin='0,-4,3' target='0,0,.3' up='0,0,1'/></transform></sensor><emitter type='point'>"
        "<point name='position' x='1' y='-1' z='3'/></emitter><shape type='rectangle'><transform "
        "name='to_world'>"
        "<scale value='3'/></transform><bsdf type='diffuse'><texture type='checkerboard' name='reflectance'>"
        "<transform name='to_uv'><scale value='5'/></transform></texture></bsdf></shape><shape type='sphere'>"
        "<point name='center' x='0' y='0' z='.6'/><float name='radius' value='.6'/></shape></scene>";
    (void)state;
    fixture prepared, *const f = &prepared;
    assert_int_equal(aur_scene_load_memory("text.xml", sizeof text - 1, text, NULL, &prepared.scene, NULL),
                     AUR_OK);
    assert_int_equal(aur_renderer_create(prepared.scene, &prepared.renderer, NULL), AUR_OK);
    static const char *const tried[] = {"gaussian", "mitchell"};
    for (size_t k = 0; k < 2; ++k) {
        aur_image *images[4];
        for (size_t i = 0; i < 4; ++i) {
            const bool gathers = i % 2 == 1;
            aur_render_options options = options_of(
                gathers ? "finalgather:max_depth=2,photons=1000,edges=0" : "path:max_depth=2", tried[k]);
            options.width = options.height = SIDE;
            options.samples_per_pixel = gathers ? 128 : 512;
            options.seed = i + 1;
            images[i] = render_all(f, &options);
        }
        double sums[BLOCKS] = {0.0}, mean = 0.0, square = 0.0;
        for (size_t p = 0; p < SIDE * SIDE; ++p)
            for (size_t c = 0; c < 3; ++c) {
                const size_t at = 3 * p + c, block = p / SIDE / BLOCK * (SIDE / BLOCK) + p % SIDE / BLOCK;
                sums[block] += ((double)images[0]->data[at] - (double)images[1]->data[at]) *
                               ((double)images[2]->data[at] - (double)images[3]->data[at]);
            }
        for (size_t b = 0; b < BLOCKS; ++b) {
            mean += sums[b] / BLOCKS;
            square += sums[b] * sums[b] / BLOCKS;
        }
        const double error = sqrt((square - mean * mean) / (BLOCKS - 1));
        assert_true(mean < 4.5 * error);
        for (size_t i = 0; i < 4; ++i)
            aur_image_destroy(images[i]);
    }
    aur_renderer_destroy(prepared.renderer);
    aur_scene_destroy(prepared.scene);
}

/* Filters wider than the image, and images of one pixel. */
static void small_images(void **state) {
    const fixture *const f = *state;
    for (size_t k = 0; k < FILTER_COUNT; ++k)
        for (size_t side = 1; side <= 3; ++side) {
            aur_render_options options = options_of("path", filters[k]);
            options.width = options.height = side;
            aur_image *const image = render_all(f, &options);
            for (size_t i = 0; i < 3 * side * side; ++i)
                assert_true(isfinite(image->data[i]));
            aur_image_destroy(image);
        }
}

/* White noise through a tent of radius 1: the integral of its square is 2/3, of its product with itself a
 * pixel away 1/6. So along each axis the squared correlations are 1 and twice 1/16. The table's bins change
 * that by about one over their number. */
static void overlap_is_the_sum_of_squared_correlations(void **state) {
    (void)state;
    const aur_filter tent = {.kind = AUR_FILTER_TENT, .scale = 1.0f};
    aur_spread *spread;
    assert_true(aur_spread_create(&tent, AUR_TILE_SIZE, 3, 1, &spread));
    assert_relative(aur_spread_overlap(spread), 81.0 / 64.0, 1.0 / AUR_SPREAD_BINS);
    aur_spread_destroy(spread);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(pixels_are_the_weighed_means_of_all_samples),
                                       cmocka_unit_test(errors_are_those_of_the_steps),
                                       cmocka_unit_test(nothing_changes_a_bit),
                                       cmocka_unit_test(rectangles_have_the_values_of_their_pixels),
                                       cmocka_unit_test(cells_have_equal_weights_for_any_number_of_samples),
                                       cmocka_unit_test(gathers_count_where_they_lie),
                                       cmocka_unit_test(small_images),
                                       cmocka_unit_test(overlap_is_the_sum_of_squared_correlations)};
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
