/* Pooled irradiance: the errors of the joint pattern's parts cancel, linear light is preserved, and surfaces
 * are not mixed. */
#include "check.h"

#include <stdlib.h>

#include "render/gather/strata.h"

enum { SIDE = AUR_TILE_SIZE, BLOCK = AUR_GROUPS_A_SIDE };

/* The excess of the pattern's part at a position in a 4 x 4 block: zero over all sixteen. */
static double part(size_t x, size_t y) {
    static const double of_column[BLOCK] = {0.7, -0.3, 0.1, -0.5}, of_row[BLOCK] = {-0.2, 0.4, -0.6, 0.4};
    return of_column[x % BLOCK] + of_row[y % BLOCK] + 8.0 * of_column[x % BLOCK] * of_row[y % BLOCK];
}

/* Adds a stratum of `weight` samples on the plane z = 0 with this irradiance, reflected by a half. */
static void add(aur_pixel_strata *strata, size_t x, size_t y, uint64_t key, aur_vector normal, float weight,
                double irradiance) {
    aur_pixel_strata *const pixel = &strata[y * SIDE + x];
    const float light = (float)irradiance;
    pixel->strata[pixel->count++] =
        (aur_stratum){.key = key,
                      .gathers = weight,
                      .pooled = {.irradiance = aur_vector_scale((aur_vector){light, light, light}, weight),
                                 .coefficient = aur_vector_scale((aur_vector){0.5f, 0.5f, 0.5f}, weight),
                                 .position = aur_vector_scale((aur_vector){(float)x, (float)y, 0.0f}, weight),
                                 .normal = aur_vector_scale(normal, weight)}};
}

static aur_pixel_strata *create(void) {
    aur_pixel_strata *const strata = calloc(AUR_TILE_PIXELS, sizeof *strata);
    assert_non_null(strata);
    return strata;
}

static const aur_vector up = {0.0f, 0.0f, 1.0f};

/* Of a pixel's window along one axis: the pixel, except for the two at either rim. */
static double middle_of_window(size_t at) {
    return at < 2 ? 1.5 : at > SIDE - 3 ? SIDE - 2.5 : (double)at;
}

static void linear_light_is_preserved(void **state) {
    (void)state;
    aur_pixel_strata *const strata = create();
    for (size_t i = 0; i < AUR_TILE_PIXELS; ++i) {
        const double x = (double)(i % SIDE), y = (double)(i / SIDE);
        add(strata, i % SIDE, i / SIDE, 1, up, 2.0f, 3.0 + 0.25 * x - 0.125 * y + part(i % SIDE, i / SIDE));
    }
    assert_true(aur_gather_pool_irradiance(false, strata));
    for (size_t i = 0; i < AUR_TILE_PIXELS; ++i) {
        const double expected = 3.0 + 0.25 * middle_of_window(i % SIDE) - 0.125 * middle_of_window(i / SIDE);
        assert_near(strata[i].strata[0].sum[0], 2.0 * 0.5 * expected, 1e-5);
    }
    free(strata);
}

/* Three pixels about it, whose outer ones count .16; at the rim of the tile there are two. */
static double middle_of_near_window(size_t at) {
    return at == 0 ? 0.16 / 1.16 : at == SIDE - 1 ? SIDE - 1 - 0.16 / 1.16 : (double)at;
}

static void near_pools_preserve_linear_light(void **state) {
    (void)state;
    aur_pixel_strata *const strata = create();
    for (size_t i = 0; i < AUR_TILE_PIXELS; ++i)
        add(strata, i % SIDE, i / SIDE, 1, up, 2.0f,
            3.0 + 0.25 * (double)(i % SIDE) - 0.125 * (double)(i / SIDE));
    assert_true(aur_gather_pool_irradiance(true, strata));
    for (size_t i = 0; i < AUR_TILE_PIXELS; ++i) {
        const double expected =
            3.0 + 0.25 * middle_of_near_window(i % SIDE) - 0.125 * middle_of_near_window(i / SIDE);
        assert_near(strata[i].strata[0].sum[0], 2.0 * 0.5 * expected, 1e-5);
    }
    free(strata);
}

/* Left and right halves of one shape that face differently, another shape in the middle of both, and nothing
 * in the first column. Each kind of surface has one irradiance, so mixing would show. */
static void surfaces_stay_apart(void **state) {
    (void)state;
    static const aur_vector tilted = {0.8f, 0.0f, 0.6f};
    aur_pixel_strata *const strata = create();
    for (size_t i = 0; i < AUR_TILE_PIXELS; ++i) {
        const size_t x = i % SIDE, y = i / SIDE;
        if (x == 0)
            continue;
        add(strata, x, y, 1, x < SIDE / 2 ? up : tilted, 1.0f, x < SIDE / 2 ? 1.0 : 2.0);
        if (y > 5 && y < 10)
            add(strata, x, y, 2, up, 0.5f, 4.0);
    }
    assert_true(aur_gather_pool_irradiance(false, strata));
    for (size_t i = 0; i < AUR_TILE_PIXELS; ++i) {
        const aur_pixel_strata *const pixel = &strata[i];
        if (pixel->count > 0)
            assert_near(pixel->strata[0].sum[1], i % SIDE < SIDE / 2 ? 0.5 : 1.0, 1e-6);
        if (pixel->count > 1)
            assert_near(pixel->strata[1].sum[2], 0.5 * 0.5 * 4.0, 1e-6);
    }
    free(strata);
}

/* A plane behind the other one, at the same position in the image. */
static void depths_stay_apart(void **state) {
    (void)state;
    aur_pixel_strata *const strata = create();
    for (size_t i = 0; i < AUR_TILE_PIXELS; ++i) {
        const bool behind = i % 2 == 1;
        add(strata, i % SIDE, i / SIDE, 1, up, 1.0f, behind ? 3.0 : 1.0);
        strata[i].strata[0].pooled.position.z = behind ? -20.0f : 0.0f;
    }
    assert_true(aur_gather_pool_irradiance(false, strata));
    for (size_t i = 0; i < AUR_TILE_PIXELS; ++i)
        assert_near(strata[i].strata[0].sum[0], i % 2 == 1 ? 1.5 : 0.5, 1e-6);
    free(strata);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(linear_light_is_preserved), cmocka_unit_test(near_pools_preserve_linear_light),
        cmocka_unit_test(surfaces_stay_apart), cmocka_unit_test(depths_stay_apart)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
