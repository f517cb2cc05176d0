#include "check.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <aureole-render/render.h>

#include "render/driver/renderer.h"
#include "render/film/film.h"
#include "render/image/format.h"

static aur_scene *load(const char *name) {
    char path[1024];
    aur_scene *scene = NULL;
    snprintf(path, sizeof path, AUR_SOURCE_DIR "/%s", name);
    assert_int_equal(aur_scene_load(path, NULL, &scene, NULL), AUR_OK);
    return scene;
}

static aur_render_options small(const char *integrator, size_t threads) {
    return (aur_render_options){.size = sizeof(aur_render_options),
                                .integrator = integrator,
                                .samples_per_pixel = 8,
                                .width = 45,
                                .height = 37,
                                .threads = threads};
}

static aur_render *start(aur_renderer *renderer, const aur_render_options *options) {
    aur_render *render = NULL;
    assert_int_equal(aur_render_create(renderer, options, &render, NULL), AUR_OK);
    return render;
}

static aur_image *develop(const aur_film *film) {
    aur_image *image = NULL;
    assert_int_equal(aur_film_develop(film, &image, NULL), AUR_OK);
    return image;
}

static void assert_same(aur_image *a, aur_image *b) {
    assert_int_equal(a->width, b->width);
    assert_int_equal(a->height, b->height);
    assert_int_equal(a->channel_count, b->channel_count);
    assert_memory_equal(a->data, b->data, a->width * a->height * a->channel_count * sizeof *a->data);
    aur_image_destroy(a);
    aur_image_destroy(b);
}

typedef struct fixture {
    aur_scene *scene;
    aur_renderer *renderer;
} fixture;

static int set_up(void **state) {
    fixture *const f = calloc(1, sizeof *f);
    f->scene = load("scenes/cornell-box/cornell-box.xml");
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

/* Steps of any size, by any number of threads, equal one render of all samples. A film that was saved and
 * loaded into another render continues to the same bits, errors and counts, with filters that reach other
 * pixels and with one that does not. */
static void steps_are_one_render(void **state) {
    const fixture *const f = *state;
    static const char *const integrators[] = {"path", "aov:aovs=(n:sample_count,v:variance,d:depth)", "path",
                                              "finalgather:photons=5000,diffuse_samples=8,edges=0"};
    for (size_t i = 0; i < sizeof integrators / sizeof integrators[0]; ++i) {
        aur_render_options one = small(integrators[i], 1), three = small(integrators[i], 3);
        one.filter = three.filter = i == 2 ? "box" : NULL;
        aur_image *whole = NULL;
        assert_int_equal(aur_renderer_render(f->renderer, &one, &whole, NULL, NULL), AUR_OK);

        aur_render *const first = start(f->renderer, &three);
        assert_int_equal(aur_render_step(first, 1, NULL), AUR_OK);
        assert_int_equal(aur_render_step(first, 4, NULL), AUR_OK);
        assert_int_equal(aur_render_samples(first), 5);
        assert_int_equal(aur_film_save(aur_render_film(first), "half.film", NULL), AUR_OK);
        assert_int_equal(aur_render_step(first, 100, NULL), AUR_OK);
        assert_int_equal(aur_render_samples(first), 8);

        aur_film *half = NULL;
        assert_int_equal(aur_film_load("half.film", &half, NULL), AUR_OK);
        remove("half.film");
        aur_render *const second = start(f->renderer, &one);
        assert_int_equal(aur_render_merge(second, half, NULL), AUR_OK);
        assert_int_equal(aur_render_samples(second), 5);
        assert_int_equal(aur_render_step(second, 0, NULL), AUR_OK);
        double errors[2][4];
        assert_int_equal(aur_film_error(aur_render_film(first), errors[0], NULL, NULL), AUR_OK);
        assert_int_equal(aur_film_error(aur_render_film(second), errors[1], NULL, NULL), AUR_OK);
        for (size_t c = 0; c < 4; ++c)
            assert_true(errors[0][c] > 0.0 && fabs(errors[0][c] - errors[1][c]) <= 1e-12 * errors[0][c]);
        aur_render_statistics counted[2] = {{.size = sizeof *counted}, {.size = sizeof *counted}};
        assert_int_equal(aur_render_get_statistics(first, &counted[0], NULL), AUR_OK);
        assert_int_equal(aur_render_get_statistics(second, &counted[1], NULL), AUR_OK);
        assert_int_equal(counted[0].samples, 45 * 37 * 8);
        assert_int_equal(counted[1].samples, counted[0].samples);
        assert_int_equal(counted[1].rays, counted[0].rays);
        assert_same(develop(aur_render_film(first)), develop(aur_render_film(second)));
        /* finalgather sums its pixels' samples step by step, so its bits depend on the steps. */
        if (i < 3)
            assert_same(whole, develop(aur_render_film(second)));
        else
            aur_image_destroy(whole);
        aur_film_destroy(half);
        aur_render_destroy(first);
        aur_render_destroy(second);
    }
}

/* Parts whose crops are whole tiles, rendered apart, are the whole image. */
static void parts_are_merged(void **state) {
    const fixture *const f = *state;
    aur_render_options options = small("path", 2);
    options.filter = "box";
    aur_render *const whole = start(f->renderer, &options);
    aur_image *expected = NULL;
    assert_int_equal(aur_renderer_render(f->renderer, &options, &expected, NULL, NULL), AUR_OK);
    static const size_t crops[3][4] = {{0, 32, 0, 37}, {32, 45, 0, 16}, {32, 45, 16, 37}};
    for (size_t i = 0; i < 3; ++i) {
        options.crop_x0 = crops[i][0];
        options.crop_x1 = crops[i][1];
        options.crop_y0 = crops[i][2];
        options.crop_y1 = crops[i][3];
        aur_render *const part = start(f->renderer, &options);
        assert_int_equal(aur_render_step(part, 0, NULL), AUR_OK);
        assert_int_equal(aur_render_merge(whole, aur_render_film(part), NULL), AUR_OK);
        aur_render_destroy(part);
    }
    assert_int_equal(aur_render_samples(whole), 8);
    assert_same(expected, develop(aur_render_film(whole)));

    aur_error error = {0};
    options.crop_x0 = 3;
    aur_render *const crooked = start(f->renderer, &options);
    assert_int_equal(aur_render_merge(whole, aur_render_film(crooked), &error), AUR_ERROR_ARGUMENT);
    assert_non_null(strstr(error.message, "whole tiles"));
    aur_render_destroy(crooked);
    options = small("path", 1);
    options.filter = "box";
    options.width = 44;
    aur_render *const narrow = start(f->renderer, &options);
    assert_int_equal(aur_render_merge(whole, aur_render_film(narrow), &error), AUR_ERROR_ARGUMENT);
    aur_render_destroy(narrow);
    aur_render_destroy(whole);
}

static int stop_at(void *user, const char *what, uint64_t done, uint64_t total) {
    (void)what;
    (void)total;
    return done == *(const uint64_t *)user;
}

/* Pixels have the samples that a step gives each of them. */
static void pixels_get_independent_samples(void **state) {
    const fixture *const f = *state;
    aur_render_options options = small("path", 1);
    options.filter = "box";
    aur_render *const render = start(f->renderer, &options);
    static uint32_t targets[45 * 37];
    uint64_t all = 0;
    for (size_t i = 0; i < 45 * 37; ++i)
        all += targets[i] = i == 700 ? 7 : 2 + (uint32_t)(i % 3);
    assert_int_equal(aur_render_step_pixels(render, 45 * 37, targets, NULL), AUR_OK);
    aur_render_statistics statistics = {.size = sizeof statistics};
    assert_int_equal(aur_render_get_statistics(render, &statistics, NULL), AUR_OK);
    assert_int_equal(aur_film_samples(aur_render_film(render)), 2);
    assert_memory_equal(aur_render_film(render)->given, targets, sizeof targets);
    assert_int_equal(statistics.samples, all);
    aur_render_destroy(render);
}

/* A stopped render keeps its samples, and continues to the same bits. */
static void a_stopped_step_is_preserved_and_continued(void **state) {
    const fixture *const f = *state;
    aur_render_options options = small("path", 2);
    aur_image *whole = NULL;
    assert_int_equal(aur_renderer_render(f->renderer, &options, &whole, NULL, NULL), AUR_OK);
    uint64_t tiles = 4;
    options.progress = (aur_progress){.function = stop_at, .user = &tiles};
    aur_render *const render = start(f->renderer, &options);
    assert_int_equal(aur_render_step(render, 3, NULL), AUR_ERROR_CANCELLED);
    assert_int_equal(aur_render_samples(render), 0);
    const aur_film *const film = aur_render_film(render);
    uint32_t most = 0;
    for (size_t i = 0; i < aur_film_pixel_count(film); ++i)
        most = film->given[i] > most ? film->given[i] : most;
    assert_int_equal(most, 3);
    tiles = 0;
    assert_int_equal(aur_render_step(render, 3, NULL), AUR_OK);
    assert_int_equal(aur_render_samples(render), 3);
    aur_render_cancel(render);
    assert_int_equal(aur_render_step(render, 0, NULL), AUR_ERROR_CANCELLED);
    assert_int_equal(aur_render_step(render, 0, NULL), AUR_OK);
    assert_same(whole, develop(aur_render_film(render)));
    aur_render_destroy(render);

    tiles = 4;
    aur_image *partial = NULL;
    assert_int_equal(aur_renderer_render(f->renderer, &options, &partial, NULL, NULL), AUR_ERROR_CANCELLED);
    assert_non_null(partial);
    aur_image_destroy(partial);
}

static int stop_after(void *user, const char *what, uint64_t done, uint64_t total) {
    (void)what;
    (void)done;
    (void)total;
    uint64_t *const calls = user;
    return --*calls == 0;
}

/* An image of one tile, stopped within the tile: it keeps those samples if the integrator adds them one by
 * one, none otherwise, and continues to the same bits. */
static void a_tile_is_stopped_within(void **state) {
    const fixture *const f = *state;
    static const char *const integrators[] = {"path", "ao:samples=1024",
                                              "finalgather:photons=5000,diffuse_samples=2048", "radiosity"};
    for (size_t i = 0; i < sizeof integrators / sizeof integrators[0]; ++i) {
        aur_render_options options = small(integrators[i], 1);
        options.width = options.height = 16;
        options.samples_per_pixel = 512;
        aur_image *whole = NULL;
        assert_int_equal(aur_renderer_render(f->renderer, &options, &whole, NULL, NULL), AUR_OK);
        uint64_t calls = UINT64_MAX;
        options.progress = (aur_progress){.function = stop_after, .user = &calls};
        aur_render *const render = start(f->renderer, &options);
        calls = 3;
        assert_int_equal(aur_render_step(render, 0, NULL), AUR_ERROR_CANCELLED);
        const size_t samples = aur_render_samples(render);
        assert_true(i < 2 ? samples > 0 && samples < 512 : samples == 0);
        calls = UINT64_MAX;
        assert_int_equal(aur_render_step(render, 0, NULL), AUR_OK);
        aur_render_statistics counted = {.size = sizeof counted};
        assert_int_equal(aur_render_get_statistics(render, &counted, NULL), AUR_OK);
        assert_int_equal(counted.samples, 16 * 16 * 512);
        assert_same(whole, develop(aur_render_film(render)));
        aur_render_destroy(render);
    }
}

/* The estimated squared error is unbiased for independent samples: over pixels it is chi^2 with 7 degrees of
 * freedom each. The reference has 64 times the samples, so its variance adds 1/64. The ratio of the two mean
 * squares over P = 1665 pixels and 3 correlated channels has a relative standard deviation below sqrt((2/7 +
 * k) / P) with k = 2 + the excess kurtosis of a pixel's mean, at most 20 here: .12; 5 of them are allowed. */
static void the_error_is_that_of_independent_samples(void **state) {
    const fixture *const f = *state;
    aur_render_options options = small("direct", 2);
    options.sampler = "random";
    aur_render *const render = start(f->renderer, &options);
    double rmse[4];
    assert_int_equal(aur_render_step(render, 1, NULL), AUR_OK);
    assert_int_equal(aur_film_error(aur_render_film(render), rmse, NULL, NULL), AUR_ERROR_UNSUPPORTED);
    while (aur_render_samples(render) < 8)
        assert_int_equal(aur_render_step(render, 1, NULL), AUR_OK);
    aur_image *errors = NULL;
    assert_int_equal(aur_film_error(aur_render_film(render), rmse, &errors, NULL), AUR_OK);
    assert_int_equal(errors->channel_count, 3);
    aur_image_destroy(errors);

    options.samples_per_pixel = 512;
    options.seed = 1;
    aur_image *reference = NULL, *const image = develop(aur_render_film(render));
    double measured[4];
    assert_int_equal(aur_renderer_render(f->renderer, &options, &reference, NULL, NULL), AUR_OK);
    assert_int_equal(aur_image_compare(reference, image, AUR_IMAGE_RMSE, measured, NULL), AUR_OK);
    const double ratio = rmse[3] * rmse[3] * (1.0 + 1.0 / 64.0) / (measured[3] * measured[3]);
    print_message("estimated over measured squared error: %g\n", ratio);
    assert_true(fabs(ratio - 1.0) < 0.6);
    aur_image_destroy(reference);
    aur_image_destroy(image);
    aur_render_destroy(render);
}

/* Each pixel's squared error is the variance of its samples' mean: of steps of one sample each, which the
 * images after each step give. */
static void the_error_is_that_of_the_steps(void **state) {
    enum { STEPS = 8, PIXELS = 45 * 37 };
    const fixture *const f = *state;
    aur_render_options options = small("direct", 1);
    options.filter = "box";
    aur_render *const render = start(f->renderer, &options);
    static double sums[PIXELS], squares[PIXELS], before[PIXELS];
    for (size_t n = 1; n <= STEPS; ++n) {
        assert_int_equal(aur_render_step(render, 1, NULL), AUR_OK);
        aur_image *const image = develop(aur_render_film(render));
        for (size_t i = 0; i < PIXELS; ++i) {
            const double all = (double)n * (double)image->data[image->channel_count * i], x = all - before[i];
            before[i] = all;
            sums[i] += x;
            squares[i] += x * x;
        }
        aur_image_destroy(image);
    }
    aur_image *errors = NULL;
    double rmse[4];
    assert_int_equal(aur_film_error(aur_render_film(render), rmse, &errors, NULL), AUR_OK);
    for (size_t i = 0; i < PIXELS; ++i) {
        const double mean = sums[i] / STEPS, spread = squares[i] / STEPS - mean * mean;
        const double error = sqrt(fmax(spread, 0.0) / (STEPS - 1));
        /* Images are floats: of values up to all samples' sum. */
        assert_near((double)errors->data[3 * i], error, 1e-3 * error + 1e-4 * mean);
    }
    aur_image_destroy(errors);
    aur_render_destroy(render);
}

/* A struct with an unset size, or from a newer library with a used new field, is rejected; with unused fields
 * it is not. */
static void options_of_other_sizes(void **state) {
    const fixture *const f = *state;
    aur_error error = {0};
    aur_render *render = NULL;
    const aur_render_options empty = {0};
    assert_int_equal(aur_render_create(f->renderer, &empty, &render, &error), AUR_ERROR_ARGUMENT);
    assert_non_null(strstr(error.message, "aur_render_options"));
    struct {
        aur_render_options options;
        size_t more;
    } newer = {.options = small("depth", 1)};
    newer.options.size = sizeof newer;
    assert_int_equal(aur_render_create(f->renderer, &newer.options, &render, &error), AUR_OK);
    aur_render_destroy(render);
    newer.more = 1;
    assert_int_equal(aur_render_create(f->renderer, &newer.options, &render, &error), AUR_ERROR_UNSUPPORTED);
    assert_null(render);
}

static aur_result load_bytes(size_t size, const unsigned char *bytes) {
    aur_film *film = NULL;
    const aur_result result = aur_film_load_memory("bytes", size, bytes, &film, NULL);
    aur_film_destroy(film);
    return result;
}

/* A film that is cut short or has a changed byte is refused. */
static void damaged_films_are_refused(void **state) {
    const fixture *const f = *state;
    const aur_render_options options = small("path", 2);
    aur_render *const render = start(f->renderer, &options);
    assert_int_equal(aur_render_step(render, 1, NULL), AUR_OK);
    assert_int_equal(aur_film_save(aur_render_film(render), "whole.film", NULL), AUR_OK);
    aur_render_destroy(render);
    FILE *const stream = fopen("whole.film", "rb");
    assert_non_null(stream);
    static unsigned char bytes[1 << 20];
    const size_t size = fread(bytes, 1, sizeof bytes, stream);
    fclose(stream);
    remove("whole.film");
    assert_int_equal(load_bytes(size, bytes), AUR_OK);
    for (size_t cut = 0; cut < size; cut += 1 + cut / 2)
        assert_int_equal(load_bytes(cut, bytes), AUR_ERROR_FORMAT);
    for (size_t at = 0; at < size; at += at < 4096 ? 1 : 4099) {
        bytes[at] ^= 0x41;
        assert_int_equal(load_bytes(size, bytes), AUR_ERROR_FORMAT);
        bytes[at] ^= 0x41;
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(steps_are_one_render),
                                       cmocka_unit_test(parts_are_merged),
                                       cmocka_unit_test(pixels_get_independent_samples),
                                       cmocka_unit_test(a_stopped_step_is_preserved_and_continued),
                                       cmocka_unit_test(a_tile_is_stopped_within),
                                       cmocka_unit_test(the_error_is_that_of_independent_samples),
                                       cmocka_unit_test(the_error_is_that_of_the_steps),
                                       cmocka_unit_test(options_of_other_sizes),
                                       cmocka_unit_test(damaged_films_are_refused)};
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
