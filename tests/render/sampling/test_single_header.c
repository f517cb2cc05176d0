/* include/aureole_sampling.h without 128-bit integers, and its sampler compared with the renderer's. */
#undef __SIZEOF_INT128__
#include "../../../include/aureole_sampling.h"

#include "check.h"
#include "points/pointset/fraction128.h"
#include "render/sampling/stream.h"

static void test_products(void **state) {
    (void)state;
    for (uint64_t i = 0; i < 100000; ++i) {
        const uint64_t a = aur_mix64(i), b = i % 3 == 0 ? ~aur_mix64(a) >> (i % 64) : UINT64_MAX - i;
        assert_true(aureole_multiply_high(a, b) == (uint64_t)((aur_wide)a * b >> 64));
    }
}

static void test_sampler(void **state) {
    (void)state;
    aur_sampler *sampler = NULL;
    assert_int_equal(aur_sampler_create("sobol", 64, NULL, &sampler, NULL), AUR_OK);
    for (uint32_t index = 0; index < 64; ++index) {
        const aur_stream stream = {sampler, aur_hash3(7, 3, 5), index};
        aureole_sampler ours = aureole_sampler_begin(7, 5, 3, index);
        for (uint32_t pair = 0; pair < 20; ++pair) {
            float expected[2], found[2];
            aur_stream_pair(&stream, pair, expected);
            aureole_draw_2d(&ours, found);
            assert_true(found[0] == expected[0] && found[1] == expected[1]);
        }
        assert_true(aureole_draw_1d(&ours) == aur_stream_single(&stream, 20));
        /* A branch is another stream. */
        aureole_sampler branch = aureole_sampler_branch(&ours, 1);
        float u[2], v[2];
        aureole_sampler_pair(&branch, 0, u);
        aureole_sampler_pair(&ours, 0, v);
        assert_true(u[0] != v[0] || u[1] != v[1]);
    }
    aur_sampler_destroy(sampler);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_products), cmocka_unit_test(test_sampler)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
