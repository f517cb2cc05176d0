/* The error of a denoised image, estimated from two halves of the replicas. */
#include "render/prepared.h"

#include <math.h>

enum { SIDE = 16, VALUES = 3 * SIDE * SIDE };

typedef struct fixture {
    prepared box;
    aur_adaptive *adaptive;
    aur_image *halves[2], *processed[2];
} fixture;

static aur_render_options small(void) {
    aur_render_options options = image_of_size(SIDE, SIDE);
    options.integrator = "path";
    return options;
}

/* `value` is that of all pixels of the denoised image; below 0: that of the halves. */
static aur_error_figures compare(fixture *f, float value, aur_error_measure measure) {
    const aur_render_options options = small();
    aur_adaptive_options target = target_of(0.0, measure);
    target.rounds = 3;
    f->box = prepare_file(CORNELL_BOX);
    assert_int_equal(aur_adaptive_create(f->box.renderer, &options, &target, &f->adaptive, NULL), AUR_OK);
    assert_int_equal(aur_adaptive_run(f->adaptive, NULL), AUR_OK);
    for (size_t h = 0; h < 2; ++h) {
        assert_int_equal(aur_adaptive_develop_half(f->adaptive, h, &f->halves[h], NULL), AUR_OK);
        assert_int_equal(aur_adaptive_develop_half(f->adaptive, h, &f->processed[h], NULL), AUR_OK);
        for (size_t i = 0; i < 2 * VALUES && value >= 0.0f; ++i)
            aur_image_data(f->processed[h])[i] = value;
    }
    aur_error_figures figures;
    const aur_image *const processed[2] = {f->processed[0], f->processed[1]};
    assert_int_equal(aur_adaptive_compare_halves(f->adaptive, processed, &figures, NULL), AUR_OK);
    return figures;
}

static void end(fixture *f) {
    for (size_t h = 0; h < 2; ++h) {
        aur_image_destroy(f->halves[h]);
        aur_image_destroy(f->processed[h]);
    }
    aur_adaptive_destroy(f->adaptive);
    release(f->box);
}

static double mean_of(const aur_image *image) {
    double sum = 0.0;
    for (size_t i = 0; i < VALUES; ++i)
        sum += (double)aur_image_data(image)[i / 3 * aur_image_channel_count(image) + i % 3] / VALUES;
    return sum;
}

/* Without denoising the error is that of the halves: the root of half of the mean square of their difference.
 */
static void test_nothing_denoised(void **state) {
    (void)state;
    fixture f;
    const aur_error_figures figures = compare(&f, -1.0f, AUR_ERROR_MEASURE_MEAN);
    double change;
    aur_image *whole;
    assert_int_equal(aur_image_error(f.halves[0], f.halves[1], AUR_ERROR_MEASURE_MEAN, &change, NULL),
                     AUR_OK);
    assert_int_equal(aur_adaptive_develop(f.adaptive, false, &whole, NULL), AUR_OK);
    assert_near(figures.error, change * mean_of(f.halves[0]) / mean_of(whole) / sqrt(2.0), 1e-6);
    assert_true(figures.low < figures.error && figures.error < figures.high);
    for (size_t i = 0; i < VALUES; ++i) {
        const size_t at = i / 3 * 6 + i % 3;
        const float a = aur_image_data(f.halves[0])[at], b = aur_image_data(f.halves[1])[at];
        assert_near((double)aur_image_data(whole)[i], 0.5 * ((double)a + (double)b), 1e-5);
    }
    aur_image_destroy(whole);
    end(&f);
}

/* A bias is found, although no image is without noise: here one of all pixels, next to a long render. */
static void test_bias_is_found(void **state) {
    (void)state;
    for (int m = 0; m < AUR_ERROR_MEASURE_COUNT; ++m) {
        fixture f;
        const aur_error_figures figures = compare(&f, 0.2f, (aur_error_measure)m);
        aur_render_options options = small();
        options.samples_per_pixel = 1024;
        aur_image *reference, *flat;
        double error;
        assert_int_equal(aur_renderer_render(f.box.renderer, &options, &reference, NULL, NULL), AUR_OK);
        assert_int_equal(aur_image_create(SIDE, SIDE, 3, &flat, NULL), AUR_OK);
        for (size_t i = 0; i < VALUES; ++i)
            aur_image_data(flat)[i] = 0.2f;
        assert_int_equal(aur_image_error(reference, flat, (aur_error_measure)m, &error, NULL), AUR_OK);
        print_message("%d: %.4f between %.4f and %.4f, true %.4f\n", m, figures.error, figures.low,
                      figures.high, error);
        assert_true(figures.low < error && error < figures.high);
        if (m != AUR_ERROR_MEASURE_RELATIVE) /* dominated by few dark pixels */
            assert_near(figures.error, error, 0.1 * error);
        aur_image_destroy(reference);
        aur_image_destroy(flat);
        end(&f);
    }
}

static void test_bad_input(void **state) {
    (void)state;
    fixture f;
    compare(&f, 0.2f, AUR_ERROR_MEASURE_MEAN);
    aur_image *image = NULL;
    assert_int_equal(aur_adaptive_develop_half(f.adaptive, 2, &image, NULL), AUR_ERROR_ARGUMENT);
    assert_null(image);
    assert_int_equal(aur_image_create(SIDE, SIDE - 1, 3, &image, NULL), AUR_OK);
    const aur_image *const processed[2] = {f.processed[0], image};
    aur_error_figures figures;
    assert_int_equal(aur_adaptive_compare_halves(f.adaptive, processed, &figures, NULL), AUR_ERROR_ARGUMENT);
    aur_image_destroy(image);
    end(&f);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_nothing_denoised),
                                       cmocka_unit_test(test_bias_is_found),
                                       cmocka_unit_test(test_bad_input)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
