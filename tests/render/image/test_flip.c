/* LDR-FLIP against the authors' own program and closed forms. */
#include "render/image/format.h"
#include "test_images.h"

/* An image from display values in [0,1]: pattern number `pattern` at column x of row y, channel c. */
static aur_image *pattern_image(size_t width, size_t height, double (*value)(size_t, size_t, size_t)) {
    aur_image *const image = random_image(width, height, 3);
    for (size_t i = 0; i < width * height * 3; ++i)
        image->data[i] = (float)aur_srgb_decode(value(i / 3 % width, i / 3 / width, i % 3));
    return image;
}

static double flip_of(const aur_image *reference, const aur_image *image) {
    double value[4];
    aur_error error;
    assert_success(aur_image_compare(reference, image, AUR_IMAGE_FLIP, value, &error), &error);
    assert_true(value[0] == value[3] && value[1] == value[3] && value[2] == value[3]);
    return value[3];
}

static double black(size_t x, size_t y, size_t c) {
    (void)x, (void)y, (void)c;
    return 0.0;
}

static double white(size_t x, size_t y, size_t c) {
    (void)x, (void)y, (void)c;
    return 1.0;
}

static double green(size_t x, size_t y, size_t c) {
    (void)x, (void)y;
    return c == 1 ? 1.0 : 0.0;
}

static double blue(size_t x, size_t y, size_t c) {
    (void)x, (void)y;
    return c == 2 ? 1.0 : 0.0;
}

static double ramps(size_t x, size_t y, size_t c) {
    return c == 0 ? (double)x / 63.0 : c == 1 ? (double)y / 47.0 : (double)((x + y) % 16) / 15.0;
}

static double other_ramps(size_t x, size_t y, size_t c) {
    return c == 0 ? (double)y / 47.0 : c == 1 ? (double)x / 63.0 : (double)(x * y % 16) / 15.0;
}

static double point(size_t x, size_t y, size_t c) {
    (void)c;
    return x == 25 && y == 20 ? 1.0 : 0.0;
}

static double edge(size_t x, size_t y, size_t c) {
    (void)y, (void)c;
    return x >= 25 ? 1.0 : 0.0;
}

typedef struct flip_case {
    size_t width, height;
    double (*reference)(size_t, size_t, size_t);
    double (*image)(size_t, size_t, size_t);
    double expected;
} flip_case;

/* Means that the authors' program (flip-evaluator 1.7, in single precision) prints for these images. */
static void test_published_program(void **state) {
    (void)state;
    static const flip_case cases[] = {{64, 48, ramps, other_ramps, 0.765666},
                                      {50, 40, black, point, 0.00715464},
                                      {50, 40, black, edge, 0.540611}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
        aur_image *const reference = pattern_image(cases[i].width, cases[i].height, cases[i].reference);
        aur_image *const image = pattern_image(cases[i].width, cases[i].height, cases[i].image);
        const double value = flip_of(reference, image);
        assert_relative(value, cases[i].expected, 2e-4);
        assert_near(flip_of(image, reference), value, 1e-7); /* it is symmetric */
        assert_true(flip_of(image, image) == 0.0);
        aur_image_destroy(image);
        aur_image_destroy(reference);
    }
}

/* Filters leave uniform images alone and there are no features, so that only the colour error remains.
 * Green against blue is the largest, 1 by definition. Black against white has lightnesses 0 and 100 and no
 * chroma: e = 100^0.7 = 25.1189, the largest is 308.137^0.7 = 55.2 (see below), and the map to [0,1] gives
 * the rest. */
static void test_uniform_images(void **state) {
    (void)state;
    aur_image *const patterns[] = {pattern_image(9, 7, black), pattern_image(9, 7, white),
                                   pattern_image(9, 7, green), pattern_image(9, 7, blue)};
    assert_near(flip_of(patterns[2], patterns[3]), 1.0, 1e-6);
    /* CIELAB (D65, 2 degrees) of sRGB green and blue: (87.735, -86.183, 83.180), (32.302, 79.196, -107.855);
     * with the Hunt effect a and b are multiplied by L / 100. */
    const double lightness = 87.7347 - 32.3026;
    const double a = -86.1827 * 0.877347 - 79.1952 * 0.323026;
    const double b = 83.1797 * 0.877347 + 107.8554 * 0.323026;
    const double largest = pow(lightness + hypot(a, b), 0.7);
    const double knee = 0.4 * largest;
    const double expected = 0.95 + (pow(100.0, 0.7) - knee) / (largest - knee) * 0.05;
    assert_near(flip_of(patterns[0], patterns[1]), expected, 2e-5);
    for (size_t i = 0; i < 4; ++i)
        aur_image_destroy(patterns[i]);
}

/* Radiance beyond the screen looks like the screen's white; a single pixel has filters larger than itself. */
static void test_limits(void **state) {
    (void)state;
    aur_image *const one = pattern_image(1, 1, white);
    aur_image *const bright = pattern_image(1, 1, white);
    aur_image *const dark = pattern_image(1, 1, black);
    bright->data[0] = bright->data[1] = bright->data[2] = 1e30f;
    assert_near(flip_of(one, bright), 0.0, 0.0);
    dark->data[0] = -1e30f;
    assert_true(flip_of(one, dark) > 0.9);
    aur_error error;
    aur_image *map;
    bright->data[0] = INFINITY;
    assert_int_equal(aur_image_flip(one, bright, &map, &error), AUR_ERROR_ARGUMENT);
    assert_null(map);
    aur_image_destroy(dark);
    aur_image_destroy(bright);
    aur_image_destroy(one);
}

/* The map is large where the images differ and nothing away from there: filters reach 10 pixels. */
static void test_map(void **state) {
    (void)state;
    aur_image *const reference = pattern_image(50, 40, black);
    aur_image *const image = pattern_image(50, 40, point);
    aur_image *map, *colored;
    aur_error error;
    assert_success(aur_image_flip(reference, image, &map, &error), &error);
    assert_int_equal(map->channel_count, 1);
    float largest = 0.0f;
    for (size_t i = 0; i < 50 * 40; ++i) {
        const size_t x = i % 50, y = i / 50;
        largest = fmaxf(largest, map->data[i]);
        if (x + 10 < 25 || x > 35 || y + 10 < 20 || y > 30)
            assert_true(map->data[i] == 0.0f);
    }
    assert_true(map->data[20 * 50 + 25] == largest && largest <= 1.0f);
    assert_success(aur_image_false_color(map, 1, &colored, &error), &error);
    assert_true(colored->data[0] == 0.0f && colored->data[(20 * 50 + 25) * 3] > 0.0f);
    aur_image *none;
    assert_int_equal(aur_image_false_color(map, (double)NAN, &none, &error), AUR_ERROR_ARGUMENT);
    aur_image_destroy(map);
    aur_image_destroy(colored);
    aur_image_destroy(image);
    aur_image_destroy(reference);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_published_program),
        cmocka_unit_test(test_uniform_images),
        cmocka_unit_test(test_limits),
        cmocka_unit_test(test_map),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
