#include "sphere_check.h"

#include <string.h>

static double *pixels(size_t side) {
    aur_directions_options options = {.size = sizeof options};
    aur_directions_options_init(12 * side * side, AUR_DOMAIN_SPHERE, &options, NULL);
    return check_directions("healpix", options);
}

/* Rings of the published scheme: for k = 2 the latitudes z = 11/12, 2/3, 1/3, 0, ... with 4, 8, 8, 8, ...
 * pixels, and the first azimuths pi/4, pi/8, 0, pi/8, 0 (Gorski 2005, eqs 4, 5, 8 and 9). */
static void pixels_of_side_two_stand_where_they_should(void **state) {
    (void)state;
    static const struct {
        size_t first;
        double z, azimuth;
    } expected[] = {{0, 11.0 / 12.0, 0.25},  {4, 2.0 / 3.0, 0.125},    {5, 2.0 / 3.0, 0.375},
                    {12, 1.0 / 3.0, 0.0},    {20, 0.0, 0.125},         {28, -1.0 / 3.0, 0.0},
                    {36, -2.0 / 3.0, 0.125}, {44, -11.0 / 12.0, 0.25}, {47, -11.0 / 12.0, 1.75}};
    double *const xyz = pixels(2);
    for (size_t k = 0; k < sizeof expected / sizeof expected[0]; ++k) {
        const double *const x = xyz + 3 * expected[k].first;
        double azimuth = atan2(x[1], x[0]) / AUR_PI;
        azimuth += azimuth < -1e-12 ? 2.0 : 0.0;
        assert_near(x[2], expected[k].z, 1e-15);
        assert_near(azimuth, expected[k].azimuth, 1e-15);
    }
    free(xyz);
}

/* Points of equal areas: the sphere's own moments, but for an error that falls as 1/N; and each has its
 * opposite. */
static void pixels_are_symmetric_and_equal(void **state) {
    (void)state;
    for (size_t side = 1; side < 40; side += 6) {
        const size_t count = 12 * side * side;
        double *const xyz = pixels(side);
        double squares[3] = {0.0};
        for (size_t i = 0; i < count; ++i) {
            assert_near(check_dot(xyz + 3 * i, xyz + 3 * i), 1.0, 1e-14);
            for (size_t d = 0; d < 3; ++d) {
                squares[d] += xyz[3 * i + d] * xyz[3 * i + d] / (double)count;
                assert_near(xyz[3 * i + 2], -xyz[3 * (count - 1 - i) + 2], 1e-15);
            }
        }
        for (size_t d = 0; d < 3; ++d)
            assert_near(squares[d], 1.0 / 3.0, 0.5 / (double)count);
        if (side > 1)
            assert_true(check_smallest_distance(count < 2000 ? count : 2000, xyz) >
                        1.8 / sqrt((double)count));
        free(xyz);
    }
}

/* healpy 1.20's. */
static void directions_have_their_pixels(void **state) {
    (void)state;
    static const struct {
        uint64_t side;
        double direction[3];
        uint64_t ring, nested;
    } expected[] = {{1, {0.1, 0.2, 0.3}, 0, 0},
                    {4, {0.0, 0.0, 1.0}, 0, 15},
                    {4, {0.0, 0.0, -1.0}, 188, 128},
                    {4, {1.0, 0.0, 0.0}, 88, 70},
                    {4, {-0.3, -0.5, 0.1}, 83, 123},
                    {64, {0.1, -0.2, -0.9}, 48454, 45235},
                    {1024, {0.3, -0.2, 0.9}, 452022, 4043388},
                    {1024, {-0.6, 0.7, -0.2}, 7622094, 10454255},
                    {16777216, {0.123, 0.456, 0.789}, 239780591234526, 138701662095607},
                    {16777216, {-0.5, 0.1, -0.2}, 2305530657756251, 1728197228684217},
                    {1 << 29, {0.123, 0.456, 0.789}, 245535300266565352, 142030501985902575},
                    {1 << 29, {-0.5, 0.1, -0.2}, 2360863372011539321, 1769673962172638708},
                    {4, {1e300, 1e300, 1e300}, 42, 3},
                    {4, {1e-300, 1e-300, 1e-300}, 42, 3}};
    uint64_t pixel;
    for (size_t k = 0; k < sizeof expected / sizeof expected[0]; ++k)
        for (int nested = 0; nested < 2; ++nested) {
            assert_int_equal(
                aur_healpix_pixels(expected[k].side, nested != 0, 1, expected[k].direction, 1, &pixel, NULL),
                AUR_OK);
            assert_int_equal(pixel, nested != 0 ? expected[k].nested : expected[k].ring);
        }
    const double none[3] = {0.0};
    assert_int_equal(aur_healpix_pixels(1 << 30, false, 1, expected[0].direction, 1, &pixel, NULL),
                     AUR_ERROR_ARGUMENT);
    assert_int_equal(aur_healpix_pixels(3, true, 1, expected[0].direction, 1, &pixel, NULL),
                     AUR_ERROR_ARGUMENT);
    assert_int_equal(aur_healpix_pixels(0, false, 1, expected[0].direction, 1, &pixel, NULL),
                     AUR_ERROR_ARGUMENT);
    assert_int_equal(aur_healpix_pixels(4, false, 1, none, 1, &pixel, NULL), AUR_ERROR_ARGUMENT);
    assert_int_equal(aur_healpix_pixels(4, false, 1, expected[0].direction, 0, &pixel, NULL),
                     AUR_ERROR_CAPACITY);
}

/* Both ways: the centre of a pixel lies in it; nested pixels are the four quarters of larger ones. */
static void centres_lie_in_their_pixels(void **state) {
    (void)state;
    enum { SIDE = 8, COUNT = 12 * SIDE * SIDE };
    static const char *const sets[] = {"healpix", "healpix:order=nested"};
    uint64_t found[COUNT];
    for (size_t s = 0; s < 2; ++s) {
        aur_directions_options options = {.size = sizeof options};
        aur_directions_options_init(COUNT, AUR_DOMAIN_SPHERE, &options, NULL);
        double *const xyz = check_directions(sets[s], options);
        assert_int_equal(aur_healpix_pixels(SIDE, s == 1, COUNT, xyz, COUNT, found, NULL), AUR_OK);
        for (size_t i = 0; i < COUNT; ++i)
            assert_int_equal(found[i], i);
        free(xyz);
    }
    for (size_t i = 0; i < 1000; ++i) {
        double direction[3];
        uint64_t pixels[30];
        check_random_direction(5, i, direction);
        for (size_t k = 0; k < 30; ++k) {
            assert_int_equal(aur_healpix_pixels(UINT64_C(1) << k, true, 1, direction, 1, pixels + k, NULL),
                             AUR_OK);
            assert_true(k == 0 || pixels[k] / 4 == pixels[k - 1]);
        }
    }
}

static void other_sizes_are_refused(void **state) {
    (void)state;
    aur_directions_options options = {.size = sizeof options};
    aur_directions_options_init(100, AUR_DOMAIN_SPHERE, &options, NULL);
    aur_directions *directions;
    aur_error error = {0};
    assert_int_equal(aur_directions_create("healpix", &options, &directions, &error), AUR_ERROR_ARGUMENT);
    assert_non_null(strstr(error.message, "108, 192"));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pixels_of_side_two_stand_where_they_should),
        cmocka_unit_test(pixels_are_symmetric_and_equal),
        cmocka_unit_test(directions_have_their_pixels),
        cmocka_unit_test(centres_lie_in_their_pixels),
        cmocka_unit_test(other_sizes_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
