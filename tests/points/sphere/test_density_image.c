#include "sphere_check.h"

#include <stdbool.h>
#include <string.h>

static aur_density_image *make(size_t width, size_t height, const float *density) {
    aur_density_image *image;
    aur_error error = {0};
    if (aur_density_image_create(width, height, density, &image, &error) != AUR_OK)
        fail_msg("%s", error.message);
    return image;
}

/* A ramp along u: density 2u in steps of 1/256, so that the distribution is u^2 and the inverse sqrt u, exact
 * at the edges of pixels (Schretter 2012 fig. 4, top). */
static void a_ramp_warps_by_a_root(void **state) {
    (void)state;
    enum { WIDTH = 256 };
    float ramp[WIDTH];
    for (size_t x = 0; x < WIDTH; ++x)
        ramp[x] = (float)x + 0.5f;
    aur_density_image *const image = make(WIDTH, 1, ramp);
    for (size_t i = 0; i <= 1000; ++i) {
        const double square[2] = {(double)i / 1000.5, 0.3};
        double warped[2];
        aur_density_image_warp(image, square, warped);
        assert_near(warped[0], sqrt(square[0]), 0.5 / WIDTH);
        assert_near(warped[1], 0.3, 1e-15);
    }
    for (size_t x = 1; x < WIDTH; ++x) {
        const double edge = (double)x / WIDTH;
        double warped[2];
        aur_density_image_warp(image, (const double[2]){edge * edge, 0.0}, warped);
        assert_near(warped[0], edge, 1e-14);
    }
    aur_density_image_destroy(image);
}

/* A random image with empty pixels, rows and columns. */
enum { SIDE_X = 37, SIDE_Y = 23 };

static void random_image(float density[SIDE_X * SIDE_Y]) {
    for (size_t y = 0; y < SIDE_Y; ++y) {
        for (size_t x = 0; x < SIDE_X; ++x) {
            const double random = aur_unit_double(aur_hash3(5, x, y));
            const bool empty = y % 7 == 0 || x % 11 == 0 || y == SIDE_Y - 1 || random < 0.2;
            density[y * SIDE_X + x] = empty ? 0.0f : (float)(random * random * 5.0);
        }
    }
}

/* The inverse, the density as the Jacobian, and that nothing lands where there is no density. */
static void inverse_and_density_agree(void **state) {
    (void)state;
    float density[SIDE_X * SIDE_Y];
    random_image(density);
    aur_density_image *const image = make(SIDE_X, SIDE_Y, density);
    for (uint64_t i = 0; i < 5000; ++i) {
        const double square[2] = {aur_unit_double(aur_hash2(1, i)), aur_unit_double(aur_hash2(2, i))};
        double warped[2], back[2];
        aur_density_image_warp(image, square, warped);
        assert_true(warped[0] >= 0.0 && warped[0] < 1.0 && warped[1] >= 0.0 && warped[1] < 1.0);
        aur_density_image_unwarp(image, warped, back);
        assert_near(back[0], square[0], 1e-12);
        assert_near(back[1], square[1], 1e-12);
        const double pdf = aur_density_image_pdf(image, warped);
        assert_true(pdf > 0.0);
        const double h = 1e-7;
        double right[2], above[2];
        aur_density_image_warp(image, (const double[2]){square[0] + h, square[1]}, right);
        aur_density_image_warp(image, (const double[2]){square[0], square[1] + h}, above);
        const bool within = square[0] + h < 1.0 && square[1] + h < 1.0 &&
                            floor(right[0] * SIDE_X) == floor(warped[0] * SIDE_X) &&
                            floor(above[1] * SIDE_Y) == floor(warped[1] * SIDE_Y);
        if (within)
            assert_relative(1.0 / pdf, (right[0] - warped[0]) * (above[1] - warped[1]) / (h * h), 1e-5);
    }
    aur_density_image_destroy(image);
}

/* The share of a fine grid that lands in a pixel is the pixel's share of the mass, top row first and v
 * upwards. */
static void pixels_receive_their_mass(void **state) {
    (void)state;
    enum { GRID = 1500 };
    float density[SIDE_X * SIDE_Y];
    random_image(density);
    aur_density_image *const image = make(SIDE_X, SIDE_Y, density);
    double received[SIDE_X * SIDE_Y] = {0};
    double sum = 0.0;
    for (size_t i = 0; i < GRID * GRID; ++i) {
        const double square[2] = {((double)(i % GRID) + 0.5) / GRID, ((double)(i / GRID) + 0.5) / GRID};
        double warped[2];
        aur_density_image_warp(image, square, warped);
        const size_t x = (size_t)(warped[0] * SIDE_X);
        const size_t row = SIDE_Y - 1 - (size_t)(warped[1] * SIDE_Y);
        received[row * SIDE_X + x] += 1.0 / ((double)GRID * GRID);
    }
    for (size_t i = 0; i < SIDE_X * SIDE_Y; ++i)
        sum += (double)density[i];
    for (size_t i = 0; i < SIDE_X * SIDE_Y; ++i) {
        if (density[i] == 0.0f)
            assert_true(received[i] == 0.0);
        assert_near(received[i], (double)density[i] / sum, 1e-4);
    }
    aur_density_image_destroy(image);
}

/* For any coordinates, NaN and infinities included: the value at the nearer end of [0,1), and no read beyond
 * the tables (checked by the sanitizers). */
static void coordinates_beyond_the_square_are_clamped(void **state) {
    (void)state;
    float density[SIDE_X * SIDE_Y];
    random_image(density);
    aur_density_image *const image = make(SIDE_X, SIDE_Y, density);
    const double last = 0x1.fffffffffffffp-1;
    const double wild[][2] = {{1.0, last},     {2.0, last},      {1e300, last}, {INFINITY, last},
                              {-0x1p-60, 0.0}, {-INFINITY, 0.0}, {NAN, 0.0}};
    for (size_t i = 0; i < sizeof wild / sizeof wild[0]; ++i) {
        for (size_t axis = 0; axis < 2; ++axis) {
            double outside[2] = {0.3, 0.3}, inside[2] = {0.3, 0.3}, got[2], expected[2];
            outside[axis] = wild[i][0];
            inside[axis] = wild[i][1];
            aur_density_image_warp(image, outside, got);
            aur_density_image_warp(image, inside, expected);
            assert_memory_equal(got, expected, sizeof got);
            aur_density_image_unwarp(image, outside, got);
            aur_density_image_unwarp(image, inside, expected);
            assert_memory_equal(got, expected, sizeof got);
            const double density_there = aur_density_image_pdf(image, inside);
            assert_near(aur_density_image_pdf(image, outside), density_there, 0.0);
        }
    }
    aur_density_image_destroy(image);
}

static void refuses_what_is_wrong(void **state) {
    (void)state;
    aur_density_image *image;
    const float wrong[][2] = {{0.0f, 0.0f}, {1.0f, -1.0f}, {NAN, 1.0f}, {1.0f, INFINITY}};
    for (size_t i = 0; i < 4; ++i) {
        aur_error error = {0};
        assert_int_equal(aur_density_image_create(2, 1, wrong[i], &image, &error), AUR_ERROR_ARGUMENT);
        assert_null(image);
        assert_true(strlen(error.message) > 0);
    }
    assert_int_equal(aur_density_image_create(0, 1, wrong[0], &image, NULL), AUR_ERROR_ARGUMENT);
    assert_int_equal(aur_density_image_create(70000, 1, wrong[0], &image, NULL), AUR_ERROR_ARGUMENT);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_ramp_warps_by_a_root),
        cmocka_unit_test(inverse_and_density_agree),
        cmocka_unit_test(pixels_receive_their_mass),
        cmocka_unit_test(coordinates_beyond_the_square_are_clamped),
        cmocka_unit_test(refuses_what_is_wrong),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
