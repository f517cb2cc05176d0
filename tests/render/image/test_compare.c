/* Metrics against closed forms, differences, downsampling, selection. */
#include "test_images.h"

static void check_metric(const aur_image *reference, const aur_image *image, aur_image_metric metric,
                         const double expected[4]) {
    double value[4];
    aur_error error;
    assert_success(aur_image_compare(reference, image, metric, value, &error), &error);
    for (size_t i = 0; i < 4; ++i)
        assert_near(value[i], expected[i], 1e-14);
}

/* References 0.5, 1, 0 and images 1, 1.5, 0.25: every term is the same in every pixel. */
static void test_flat_images(void **state) {
    (void)state;
    aur_image *const reference = flat_image(7, 3, 0.5f, 1.0f, 0.0f);
    aur_image *const image = flat_image(7, 3, 1.0f, 1.5f, 0.25f);
    const double mse = (0.25 + 0.25 + 0.0625) / 3.0;
    const double relmse[] = {0.25 / 0.26, 0.25 / 1.01, 0.0625 / 0.01};
    check_metric(reference, image, AUR_IMAGE_MSE, (double[]){0.25, 0.25, 0.0625, mse});
    check_metric(reference, image, AUR_IMAGE_RMSE, (double[]){0.5, 0.5, 0.25, sqrt(mse)});
    check_metric(reference, image, AUR_IMAGE_MAE, (double[]){0.5, 0.5, 0.25, 1.25 / 3.0});
    check_metric(reference, image, AUR_IMAGE_RELMSE,
                 (double[]){relmse[0], relmse[1], relmse[2], (relmse[0] + relmse[1] + relmse[2]) / 3.0});
    check_metric(reference, image, AUR_IMAGE_MRSE, (double[]){1.0, 0.25, 0.0, 0.625}); /* blue: no r > 0 */
    double value[4];
    aur_error error;
    assert_success(aur_image_compare(reference, image, AUR_IMAGE_RELATIVE_RMSE, value, &error), &error);
    assert_near(value[0], 1.0, 1e-14);
    assert_true(isinf(value[2]));
    assert_near(value[3], sqrt(mse) / 0.5, 1e-14);
    aur_image_destroy(image);
    aur_image_destroy(reference);
}

/* Against a sum in another order and with no shared code. */
static void test_random_images(void **state) {
    (void)state;
    aur_image *const reference = random_image(31, 17, 3);
    aur_image *const image = random_image(31, 17, 4); /* other values, and an alpha that must not count */
    double sum[3] = {0}, mean[3] = {0};
    for (size_t i = 31 * 17; i-- > 0;) {
        for (size_t c = 0; c < 3; ++c) {
            const double d = (double)image->data[4 * i + c] - (double)reference->data[3 * i + c];
            sum[c] += d * d;
            mean[c] += (double)reference->data[3 * i + c];
        }
    }
    double value[4];
    aur_error error;
    assert_success(aur_image_compare(reference, image, AUR_IMAGE_RMSE, value, &error), &error);
    for (size_t c = 0; c < 3; ++c)
        assert_relative(value[c], sqrt(sum[c] / 527.0), 1e-13);
    const double all = sqrt((sum[0] + sum[1] + sum[2]) / 1581.0);
    assert_relative(value[3], all, 1e-13);
    assert_success(aur_image_compare(reference, image, AUR_IMAGE_RELATIVE_RMSE, value, &error), &error);
    assert_relative(value[3], all / ((mean[0] + mean[1] + mean[2]) / 1581.0), 1e-13);
    aur_image_destroy(image);
    aur_image_destroy(reference);
}

static void test_equal_images_are_equal(void **state) {
    (void)state;
    aur_image *const image = random_image(13, 11, 3);
    aur_image *const black = flat_image(2, 2, 0, 0, 0);
    for (int metric = 0; metric < AUR_IMAGE_METRIC_COUNT; ++metric) {
        check_metric(image, image, (aur_image_metric)metric, (double[4]){0});
        check_metric(black, black, (aur_image_metric)metric, (double[4]){0});
        aur_image_metric found;
        aur_error error;
        assert_success(
            aur_image_metric_from_name(aur_image_metric_name((aur_image_metric)metric), &found, &error),
            &error);
        assert_int_equal(found, metric);
    }
    aur_image_destroy(black);
    aur_image_destroy(image);
}

static void assert_not_comparable(const aur_image *reference, const aur_image *image, const char *message) {
    double value[4];
    aur_error error;
    assert_int_equal(aur_image_compare(reference, image, AUR_IMAGE_MSE, value, &error), AUR_ERROR_ARGUMENT);
    if (strstr(error.message, message) == NULL)
        print_error("'%s' is not in '%s'\n", message, error.message);
    assert_non_null(strstr(error.message, message));
    aur_image *difference;
    assert_int_equal(aur_image_difference(reference, image, 0, &difference, &error), AUR_ERROR_ARGUMENT);
    assert_null(difference);
}

static void test_what_cannot_be_compared(void **state) {
    (void)state;
    aur_image *const reference = random_image(8, 6, 3);
    aur_image *const other_size = random_image(6, 8, 3);
    aur_image *const colorless = random_image(8, 6, 5);
    aur_image *const broken = random_image(8, 6, 3);
    assert_not_comparable(reference, other_size, "8 x 6 pixels, the image 6 x 8");
    assert_not_comparable(reference, colorless, "no channels R, G, B");
    broken->data[(2 * 8 + 5) * 3 + 1] = NAN;
    assert_not_comparable(reference, broken, "the image has the value nan at column 5 of row 2, channel G");
    broken->data[(2 * 8 + 5) * 3 + 1] = -INFINITY;
    assert_not_comparable(broken, reference,
                          "the reference has the value -inf at column 5 of row 2, channel G");
    double value[4];
    aur_error error;
    assert_int_equal(aur_image_compare(reference, reference, (aur_image_metric)99, value, &error),
                     AUR_ERROR_ARGUMENT);
    assert_null(aur_image_metric_name((aur_image_metric)99));
    aur_image_metric metric;
    assert_int_equal(aur_image_metric_from_name("rsme", &metric, &error), AUR_ERROR_NAME);
    assert_non_null(strstr(error.message, "rmse"));
    aur_image_destroy(broken);
    aur_image_destroy(colorless);
    aur_image_destroy(other_size);
    aur_image_destroy(reference);
}

/* Black where equal, the brightest colour at the scale and beyond, brighter for more in between. */
static void test_difference(void **state) {
    (void)state;
    enum { WIDTH = 101 };
    aur_image *const reference = flat_image(WIDTH, 1, 1, 1, 1);
    aur_image *const image = flat_image(WIDTH, 1, 1, 1, 1);
    for (size_t x = 0; x < WIDTH; ++x)
        image->data[3 * x + x % 3] += (x % 2 == 0 ? 1.0f : -1.0f) * (float)x / 100.0f;
    aur_image *difference, *scaled;
    aur_error error;
    assert_success(aur_image_difference(reference, image, 0, &difference, &error), &error);
    assert_success(aur_image_difference(reference, image, 0.5, &scaled, &error), &error);
    double before = -1.0;
    for (size_t x = 0; x < WIDTH; ++x) {
        const float *const rgb = difference->data + 3 * x;
        const double luminance = 0.2126 * (double)rgb[0] + 0.7152 * (double)rgb[1] + 0.0722 * (double)rgb[2];
        assert_true(luminance > before);
        before = luminance;
        if (x >= 50)
            assert_memory_equal(scaled->data + 3 * x, difference->data + 3 * (WIDTH - 1), 3 * sizeof(float));
    }
    for (size_t c = 0; c < 3; ++c)
        assert_true(difference->data[c] == 0.0f);
    aur_image_destroy(scaled);
    assert_int_equal(aur_image_difference(reference, image, -1, &scaled, &error), AUR_ERROR_ARGUMENT);
    aur_image_destroy(difference);
    aur_image_destroy(image);
    aur_image_destroy(reference);
}

static void test_downsample(void **state) {
    (void)state;
    aur_image *const image = random_image(5, 3, 2);
    for (size_t i = 0; i < 30; ++i)
        image->data[i] = (float)i; /* pixel (x, y): 10 y + 2 x and one more */
    aur_image *half, *all, *same;
    aur_error error;
    assert_success(aur_image_downsample(image, 2, &half, &error), &error);
    assert_int_equal(half->width, 3);
    assert_int_equal(half->height, 2);
    assert_string_equal(half->channel_names[1], "A");
    /* Full blocks: 10 y + 2 x at the centre; the last column and row have separate centres. */
    static const float expected[] = {6, 7, 10, 11, 13, 14, 21, 22, 25, 26, 28, 29};
    assert_memory_equal(half->data, expected, sizeof expected);
    assert_success(aur_image_downsample(image, 1000, &all, &error), &error);
    assert_int_equal(all->width * all->height, 1);
    assert_true(all->data[0] == 14.0f && all->data[1] == 15.0f);
    assert_success(aur_image_downsample(image, 1, &same, &error), &error);
    assert_same_image(image, same);
    aur_image_destroy(same);
    assert_int_equal(aur_image_downsample(image, 0, &same, &error), AUR_ERROR_ARGUMENT);
    aur_image_destroy(all);
    aur_image_destroy(half);
    aur_image_destroy(image);
}

static void test_select(void **state) {
    (void)state;
    aur_image *const image = random_image(3, 2, 4);
    aur_image *selected;
    aur_error error;
    assert_success(aur_image_select(image, 2, (const char *[]){"A", "G"}, &selected, &error), &error);
    for (size_t i = 0; i < 6; ++i) {
        assert_true(selected->data[2 * i] == image->data[4 * i + 3]);
        assert_true(selected->data[2 * i + 1] == image->data[4 * i + 1]);
    }
    assert_string_equal(selected->channel_names[0], "A");
    aur_image_destroy(selected);
    assert_int_equal(aur_image_select(image, 1, (const char *[]){"Z"}, &selected, &error), AUR_ERROR_NAME);
    assert_non_null(strstr(error.message, "R, G, B, A"));
    assert_null(selected);
    aur_image_destroy(image);
}

static void test_sizes_are_checked(void **state) {
    (void)state;
    static const size_t sizes[][3] = {{0, 1, 1},
                                      {1, 0, 1},
                                      {1, 1, 0},
                                      {SIZE_MAX, 2, 1},
                                      {(size_t)1 << 31, (size_t)1 << 31, 4},
                                      {((size_t)1 << 28) + 1, 1, 4}};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; ++i) {
        aur_image *image;
        aur_error error;
        assert_int_equal(aur_image_create(sizes[i][0], sizes[i][1], sizes[i][2], &image, &error),
                         AUR_ERROR_ARGUMENT);
        assert_null(image);
    }
    aur_image_destroy(NULL);
}

/* A caller's array is read and written in place, and is not freed. */
static void test_wrap(void **state) {
    (void)state;
    float values[2 * 1 * 3] = {0.0f, 1.0f, 2.0f, 3.0f, 4.0f, 5.0f};
    aur_image *image, *selected;
    aur_error error;
    assert_success(aur_image_wrap(2, 1, 3, values, &image, &error), &error);
    assert_int_equal(aur_image_width(image), 2);
    assert_int_equal(aur_image_height(image), 1);
    assert_int_equal(aur_image_channel_count(image), 3);
    assert_ptr_equal(aur_image_data(image), values);
    assert_string_equal(aur_image_channel_name(image, 1), "G");
    assert_null(aur_image_channel_name(image, 3));
    assert_success(aur_image_name_channel(image, 1, "depth", &error), &error);
    const char *const names[] = {"depth"};
    assert_success(aur_image_select(image, 1, names, &selected, &error), &error);
    assert_true(aur_image_data(selected)[0] == 1.0f && aur_image_data(selected)[1] == 4.0f);
    aur_image_destroy(selected);

    char name[AUR_CHANNEL_NAME_CAPACITY + 1];
    memset(name, 'x', AUR_CHANNEL_NAME_CAPACITY);
    name[AUR_CHANNEL_NAME_CAPACITY] = '\0';
    assert_int_equal(aur_image_name_channel(image, 0, name, &error), AUR_ERROR_ARGUMENT);
    assert_int_equal(aur_image_name_channel(image, 3, "Z", &error), AUR_ERROR_ARGUMENT);
    aur_image_destroy(image);
    assert_true(values[5] == 5.0f);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_flat_images),
        cmocka_unit_test(test_random_images),
        cmocka_unit_test(test_equal_images_are_equal),
        cmocka_unit_test(test_what_cannot_be_compared),
        cmocka_unit_test(test_difference),
        cmocka_unit_test(test_downsample),
        cmocka_unit_test(test_select),
        cmocka_unit_test(test_sizes_are_checked),
        cmocka_unit_test(test_wrap),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
