#include "check.h"

#include <string.h>

#include "points/base/random.h"
#include "render/scene/transform.h"

static aur_transform random_transform(uint64_t seed) {
    aur_transform a;
    for (size_t i = 0; i < 16; ++i)
        a.m[i] = 2.0 * aur_unit_double(aur_hash2(seed, i)) - 1.0;
    return a;
}

static void inverts(void **state) {
    (void)state;
    for (uint64_t seed = 0; seed < 200; ++seed) {
        const aur_transform a = random_transform(seed);
        aur_transform inverse;
        assert_true(aur_transform_inverse(&a, &inverse));
        const aur_transform one = aur_transform_multiply(&a, &inverse);
        for (size_t i = 0; i < 16; ++i)
            assert_near(one.m[i], i % 5 == 0, 1e-9);
    }
    aur_transform inverse;
    aur_transform flat = aur_transform_identity();
    flat.m[10] = 0.0;
    assert_false(aur_transform_inverse(&flat, &inverse));
    flat.m[10] = NAN;
    assert_false(aur_transform_inverse(&flat, &inverse));
}

static void rotates(void **state) {
    (void)state;
    aur_transform a;
    double moved[3];
    assert_true(aur_transform_rotate((double[3]){0, 0, 2}, 90.0, &a));
    aur_transform_point(&a, (double[3]){1, 0, 5}, moved);
    assert_near(moved[0], 0.0, 0.0);
    assert_near(moved[1], 1.0, 0.0);
    assert_near(moved[2], 5.0, 1e-15);
    assert_true(aur_transform_rotate((double[3]){1, 1, 1}, 120.0, &a)); /* x to y to z */
    aur_transform_point(&a, (double[3]){1, 2, 3}, moved);
    assert_near(moved[0], 3.0, 1e-14);
    assert_near(moved[1], 1.0, 1e-14);
    assert_near(moved[2], 2.0, 1e-14);
    assert_near(aur_transform_determinant(&a), 1.0, 1e-14);
    assert_false(aur_transform_rotate((double[3]){0, 0, 0}, 10.0, &a));
}

static void looks_at(void **state) {
    (void)state;
    aur_transform a;
    assert_true(aur_transform_look_at((double[3]){1, 2, 3}, (double[3]){1, 2, -7}, (double[3]){0, 1, 0}, &a));
    double moved[3];
    aur_transform_point(&a, (double[3]){0, 0, 10}, moved); /* the target is 10 ahead */
    assert_near(moved[0], 1.0, 1e-12);
    assert_near(moved[1], 2.0, 1e-12);
    assert_near(moved[2], -7.0, 1e-12);
    /* Looking along -z with y up, the left hand (camera +x) is world -x. */
    aur_transform_direction(&a, (double[3]){1, 0, 0}, moved);
    assert_near(moved[0], -1.0, 1e-12);
    assert_false(aur_transform_look_at((double[3]){0, 0, 0}, (double[3]){0, 1, 0}, (double[3]){0, 1, 0}, &a));
}

/* Normals remain perpendicular to transformed tangents. */
static void moves_normals(void **state) {
    (void)state;
    for (uint64_t seed = 0; seed < 50; ++seed) {
        aur_transform a = random_transform(seed), inverse;
        memcpy(&a.m[12], (double[4]){0, 0, 0, 1}, 4 * sizeof(double));
        assert_true(aur_transform_inverse(&a, &inverse));
        double normal[3], x[3], y[3];
        aur_transform_normal(&inverse, (double[3]){0, 0, 1}, normal);
        aur_transform_direction(&a, (double[3]){1, 0, 0}, x);
        aur_transform_direction(&a, (double[3]){0, 1, 0}, y);
        assert_near(normal[0] * x[0] + normal[1] * x[1] + normal[2] * x[2], 0.0, 1e-10);
        assert_near(normal[0] * y[0] + normal[1] * y[1] + normal[2] * y[2], 0.0, 1e-10);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(inverts),
        cmocka_unit_test(rotates),
        cmocka_unit_test(looks_at),
        cmocka_unit_test(moves_normals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
