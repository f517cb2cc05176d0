/* Errors of images by the measures of a target error, against their formulas. */
#include "render/image/error_measure.h"

#include <math.h>
#include <string.h>

#include "test_images.h"

static double error_by(aur_error_measure measure, const aur_image *reference, const aur_image *image) {
    double value = -1.0;
    assert_int_equal(aur_image_error(reference, image, measure, &value, NULL), AUR_OK);
    return value;
}

/* A grey image of value v that is off by e everywhere. */
static void test_constant(void **state) {
    (void)state;
    const double v = 4.0, e = 0.5;
    aur_image *const reference = flat_image(7, 5, 4.0f, 4.0f, 4.0f);
    aur_image *const image = flat_image(7, 5, 4.5f, 4.5f, 4.5f);
    assert_relative(error_by(AUR_ERROR_MEASURE_RELATIVE, reference, image), e / (1.01 * v), 1e-12);
    assert_relative(error_by(AUR_ERROR_MEASURE_MEAN, reference, image), e / v, 1e-12);
    assert_relative(error_by(AUR_ERROR_MEASURE_DISPLAY, reference, image),
                    aur_srgb_encode(0.18 * (1.0 + e / v)) - aur_srgb_encode(0.18), 1e-12);
    aur_image_destroy(image);
    aur_image_destroy(reference);
}

/* Next to bright light, filters with negative lobes make dark pixels negative. Errors there are in relation
 * to magnitudes: signed means cross zero, and no number of samples would make them accurate. */
static void test_negative(void **state) {
    (void)state;
    enum { WIDTH = 40, HEIGHT = 5, HALF = WIDTH / 2 };
    const double bright = 4.0, dark = -1.0, e = 0.5, mean = 0.5 * (bright + dark);
    aur_image *const reference = flat_image(WIDTH, HEIGHT, 4.0f, 4.0f, 4.0f);
    aur_image *const image = flat_image(WIDTH, HEIGHT, 4.5f, 4.5f, 4.5f);
    for (size_t i = 0; i < 3 * WIDTH * HEIGHT; ++i)
        if (i / 3 % WIDTH >= HALF) {
            reference->data[i] = -1.0f;
            image->data[i] = -0.5f;
        }
    double sum = 0.0;
    for (int x = 0; x < WIDTH; ++x) {
        double around = 0.0, count = 0.0;
        for (int u = x - 2; u <= x + 2; ++u)
            if (u >= 0 && u < WIDTH) {
                around += u < HALF ? bright : -dark;
                count += 1.0;
            }
        sum += pow(e / (around / count + 0.01 * mean), 2.0) / WIDTH;
    }
    assert_relative(error_by(AUR_ERROR_MEASURE_RELATIVE, reference, image), sqrt(sum), 1e-12);
    aur_image_destroy(image);
    aur_image_destroy(reference);
}

/* Luminance by means over 5 x 5 pixels, by definition. */
static void test_relative(void **state) {
    (void)state;
    enum { WIDTH = 9, HEIGHT = 8 };
    aur_image *const reference = random_image(WIDTH, HEIGHT, 3), *const image =
                                                                     random_image(WIDTH, HEIGHT, 3);
    double y[2][HEIGHT][WIDTH], mean = 0.0, sum = 0.0;
    for (size_t i = 0; i < WIDTH * HEIGHT; ++i) {
        image->data[3 * i + i % 3] += 0.25f;
        for (size_t k = 0; k < 2; ++k) {
            const float *const v = (k == 0 ? reference : image)->data + 3 * i;
            y[k][i / WIDTH][i % WIDTH] =
                0.2126 * (double)v[0] + 0.7152 * (double)v[1] + 0.0722 * (double)v[2];
        }
        mean += y[0][i / WIDTH][i % WIDTH] / (WIDTH * HEIGHT);
    }
    for (int j = 0; j < HEIGHT; ++j)
        for (int i = 0; i < WIDTH; ++i) {
            double around = 0.0;
            int count = 0;
            for (int b = j - 2; b <= j + 2; ++b)
                for (int a = i - 2; a <= i + 2; ++a)
                    if (a >= 0 && b >= 0 && a < WIDTH && b < HEIGHT) {
                        around += y[0][b][a];
                        ++count;
                    }
            sum += pow((y[1][j][i] - y[0][j][i]) / (around / count + 0.01 * mean), 2.0);
        }
    assert_relative(error_by(AUR_ERROR_MEASURE_RELATIVE, reference, image), sqrt(sum / (WIDTH * HEIGHT)),
                    1e-6);
    aur_image_destroy(image);
    aur_image_destroy(reference);
}

/* The mean agrees with the metric of the same meaning; equal images have no error, also black ones. */
static void test_edges(void **state) {
    (void)state;
    aur_image *const reference = random_image(6, 4, 3), *const black = flat_image(6, 4, 0, 0, 0);
    double value[4];
    assert_int_equal(aur_image_compare(reference, black, AUR_IMAGE_RELATIVE_RMSE, value, NULL), AUR_OK);
    assert_relative(error_by(AUR_ERROR_MEASURE_MEAN, reference, black), value[3], 1e-6);
    for (int m = 0; m < AUR_ERROR_MEASURE_COUNT; ++m) {
        aur_error_measure found;
        assert_true(error_by((aur_error_measure)m, reference, reference) == 0.0);
        assert_true(error_by((aur_error_measure)m, black, black) == 0.0);
        assert_true(isinf(error_by((aur_error_measure)m, black, reference)));
        assert_int_equal(
            aur_error_measure_from_name(aur_error_measure_name((aur_error_measure)m), &found, NULL), AUR_OK);
        assert_int_equal(found, m);
    }
    aur_error error;
    double one;
    assert_int_equal(
        aur_image_error(reference, black, (aur_error_measure)AUR_ERROR_MEASURE_COUNT, &one, &error),
        AUR_ERROR_ARGUMENT);
    assert_null(aur_error_measure_name((aur_error_measure)AUR_ERROR_MEASURE_COUNT));
    aur_error_measure measure;
    assert_int_equal(aur_error_measure_from_name("relativ", &measure, &error), AUR_ERROR_NAME);
    assert_non_null(strstr(error.message, "relative"));
    aur_image_destroy(black);
    aur_image_destroy(reference);
}

/* Clipped values are displayed as they were: an error above white is none. */
static void test_clipped(void **state) {
    (void)state;
    aur_image *const reference = flat_image(10, 10, 1, 1, 1), *const image = flat_image(10, 10, 1, 1, 1);
    for (size_t c = 0; c < 3; ++c) {
        reference->data[c] = 1000.0f;
        image->data[c] = 500.0f;
    }
    assert_true(error_by(AUR_ERROR_MEASURE_DISPLAY, reference, image) == 0.0);
    assert_true(error_by(AUR_ERROR_MEASURE_MEAN, reference, image) > 1.0);
    aur_image_destroy(image);
    aur_image_destroy(reference);
}

/* A light that each of n samples of some replicas meets with probability p, next to other light: the variance
 * of the displayed mean of the replicas, by summing over all numbers of hits, is below the bound, which
 * saturated pixels make small. */
static void test_rare_light(void **state) {
    (void)state;
    static const double shares[] = {0.001, 0.03, 0.2, 0.9}, lights[] = {0.5, 5.0, 500.0},
                        others[] = {0.0, 0.3};
    for (size_t k = 0; k < 4 * 3 * 2 * 2; ++k)
        for (unsigned samples = 1; samples <= 64; samples *= 4) {
            const unsigned replicas = k / 24 == 0 ? 1 : 4, n = samples * replicas;
            const double p = shares[k % 4], light = lights[k / 4 % 3], other = others[k / 12 % 2];
            double probability = pow(1.0 - p, n), sum = 0.0, squares = 0.0;
            for (unsigned hits = 0; hits <= n; ++hits) {
                const double shown = aur_srgb_encode(other + light * hits / n);
                sum += probability * shown;
                squares += probability * shown * shown;
                probability *= (double)(n - hits) / (hits + 1.0) * p / (1.0 - p);
            }
            const double exposure = 2.0,
                         variance = 3.0 * p * (1.0 - p) * light * light / (exposure * exposure);
            const aur_rare_light rare = {variance / samples, p, samples, replicas};
            const aur_error_weight weight = {{exposure, exposure, exposure}};
            const double bound = aur_error_variance_bound(AUR_ERROR_MEASURE_DISPLAY, &weight, &rare);
            /* Where values are dark the display's slope is up to 12.92, which the linear part leaves out. */
            assert_true(bound <= 0.75 * replicas + 1e-12);
            if (light > 100.0)
                assert_true(3.0 * replicas * (squares - sum * sum) <= bound * (1.0 + 1e-9) + 1e-14);
            if (light > 100.0 && p * n > 8.0)
                assert_true(bound < 0.01);
        }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_constant), cmocka_unit_test(test_relative),
                                       cmocka_unit_test(test_negative), cmocka_unit_test(test_edges),
                                       cmocka_unit_test(test_clipped),  cmocka_unit_test(test_rare_light)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
