#include "check.h"

#include "render/sampling/stream_kernels.h"

#include "points/base/simd.h"

static aur_sampler *make(const char *set, size_t count) {
    aur_sampler *sampler = NULL;
    aur_error error = {0};
    assert_int_equal(aur_sampler_create(set, count, NULL, &sampler, &error), AUR_OK);
    return sampler;
}

static const char *const sets[] = {"random", "sobol", "larcher-pillichshammer", "halton", "hammersley"};

/* Repeated evaluation in any order gives the same pairs, and all are in [0,1). */
static void is_random_access(void **state) {
    (void)state;
    for (size_t s = 0; s < sizeof sets / sizeof sets[0]; ++s) {
        aur_sampler *const sampler = make(sets[s], 48);
        float first[48][2];
        for (uint32_t i = 0; i < 48; ++i)
            aur_stream_pair(&(aur_stream){sampler, 99, i}, 5, first[i]);
        for (uint32_t i = 48; i-- > 0;) {
            float again[2];
            aur_stream_pair(&(aur_stream){sampler, 99, i}, 5, again);
            for (size_t k = 0; k < 2; ++k) {
                assert_true(again[k] >= 0.0f && again[k] < 1.0f);
                assert_near(again[k], first[i][k], 0);
            }
        }
        aur_sampler_destroy(sampler);
    }
}

/* Over pixels every sample is uniform, whatever its index: mean 1/2 within 5 standard errors (two-sided
 * probability 6e-7 per check, about 1e-4 for the 160 checks; the numbers are fixed, so the test is
 * deterministic). */
static void is_uniform_over_pixels(void **state) {
    (void)state;
    enum { PIXELS = 4096 };
    for (size_t s = 0; s < sizeof sets / sizeof sets[0]; ++s) {
        aur_sampler *const sampler = make(sets[s], 16);
        for (uint32_t i = 0; i < 16; ++i) {
            double sum[2] = {0};
            for (uint64_t pixel = 0; pixel < PIXELS; ++pixel) {
                float u[2];
                aur_stream_pair(&(aur_stream){sampler, aur_hash2(pixel, s), i}, 3, u);
                sum[0] += (double)u[0];
                sum[1] += (double)u[1];
            }
            for (size_t k = 0; k < 2; ++k)
                assert_near(sum[k] / PIXELS, 0.5, 5.0 * sqrt(1.0 / 12.0 / PIXELS));
        }
        aur_sampler_destroy(sampler);
    }
}

/* The samples of a pixel form a net in every pair of dimensions of a net's stream: one per cell of every
 * 16-cell elementary grid. */
static void nets_stay_nets(void **state) {
    (void)state;
    for (size_t s = 1; s < 3; ++s) {
        aur_sampler *const sampler = make(sets[s], 16);
        for (uint64_t pixel = 0; pixel < 200; ++pixel) {
            for (unsigned k = 0; k <= 4; ++k) {
                unsigned seen = 0;
                for (uint32_t i = 0; i < 16; ++i) {
                    float u[2];
                    aur_stream_pair(&(aur_stream){sampler, aur_hash2(7, pixel), i}, 11, u);
                    seen |= 1u << ((unsigned)(u[0] * (float)(1u << k)) << (4 - k) |
                                   (unsigned)(u[1] * (float)(16u >> k)));
                }
                assert_int_equal(seen, 0xffff);
            }
        }
        aur_sampler_destroy(sampler);
    }
}

/* A set that is no net is permuted: in every pair each of its points is used once. */
static void tables_are_permuted(void **state) {
    (void)state;
    for (size_t count = 1; count <= 60; ++count) {
        aur_sampler *const sampler = make("halton", count);
        for (uint64_t pixel = 0; pixel < 20; ++pixel) {
            /* Halton's first dimension has distinct values, at least 1/64 apart; the shift is common to all.
             */
            float values[60];
            for (uint32_t i = 0; i < count; ++i)
                values[i] = aur_stream_single(&(aur_stream){sampler, pixel, i}, 2);
            for (size_t i = 0; i < count; ++i)
                for (size_t j = 0; j < i; ++j)
                    assert_true(fabsf(values[i] - values[j]) > 1e-4f);
        }
        aur_sampler_destroy(sampler);
    }
}

/* Pairs in blocks are bit-identical to single ones, for every count and instruction set. */
static void blocks_are_single_pairs(void **state) {
    (void)state;
    static const aur_stream_kernel_sets *const forms[] = {
        &aur_stream_kernels_portable,
#if !defined(AUR_PORTABLE)
        &aur_stream_kernels_avx2,
        &aur_stream_kernels_avx512
#endif
    };
    static const aur_isa needs[] = {AUR_ISA_PORTABLE, AUR_ISA_AVX2, AUR_ISA_AVX512};
    for (size_t s = 0; s < sizeof sets / sizeof sets[0]; ++s) {
        aur_sampler *const sampler = make(sets[s], 48);
        for (size_t form = 0; form < sizeof forms / sizeof forms[0]; ++form) {
            if (sampler->kernels == NULL ? form > 0 : needs[form] > aur_isa_available())
                continue;
            if (sampler->kernels != NULL)
                sampler->kernels =
                    sampler->kind == AUR_SAMPLER_SOBOL ? &forms[form]->sobol : &forms[form]->random;
            for (uint32_t count = 0; count <= 20; ++count) {
                const aur_stream stream = {sampler, aur_hash2(3, count), 0x9e3779b9u * count};
                float together[20][2], alone[2];
                aur_stream_pairs(&stream, 7 * count, count, together);
                for (uint32_t i = 0; i < count; ++i) {
                    aur_stream_pair(&stream, 7 * count + i, alone);
                    assert_near(together[i][0], alone[0], 0);
                    assert_near(together[i][1], alone[1], 0);
                }
            }
        }
        aur_sampler_destroy(sampler);
    }
}

/* Many pixels at once, by whatever instructions, have the pairs that each has. */
static void many_pixels_are_the_single_ones(void **state) {
    (void)state;
    enum { COUNT = 21 };
    for (size_t s = 0; s < sizeof sets / sizeof sets[0]; ++s) {
        aur_sampler *const sampler = make(sets[s], 16);
        uint64_t pixels[COUNT];
        for (size_t k = 0; k < COUNT; ++k)
            pixels[k] = aur_hash2(9, k);
        for (uint32_t index = 0; index < 40; index += 3) {
            float u[COUNT], v[COUNT];
            aur_stream_pixels(sampler, COUNT, pixels, index, 5, u, v);
            for (size_t k = 0; k < COUNT; ++k) {
                const aur_stream stream = {sampler, pixels[k], index};
                float one[2];
                aur_stream_pair(&stream, 5, one);
                assert_true(one[0] == u[k] && one[1] == v[k]);
            }
        }
        aur_sampler_destroy(sampler);
    }
}

/* And so have samples of several pixels, each with its own index. */
static void samples_of_many_pixels_are_the_single_ones(void **state) {
    (void)state;
    enum { COUNT = 21 };
    for (size_t s = 0; s < sizeof sets / sizeof sets[0]; ++s) {
        aur_sampler *const sampler = make(sets[s], 16);
        uint64_t pixels[COUNT];
        uint32_t indices[COUNT];
        float u[COUNT], v[COUNT];
        for (uint32_t k = 0; k < COUNT; ++k) {
            pixels[k] = aur_hash2(9, k / 2);
            indices[k] = k * 7 % 40;
        }
        aur_stream_samples(sampler, COUNT, pixels, indices, 5, u, v);
        for (size_t k = 0; k < COUNT; ++k) {
            const aur_stream stream = {sampler, pixels[k], indices[k]};
            float one[2];
            aur_stream_pair(&stream, 5, one);
            assert_true(one[0] == u[k] && one[1] == v[k]);
        }
        aur_sampler_destroy(sampler);
    }
}

/* And so have many samples of one pixel. */
static void many_samples_are_the_single_ones(void **state) {
    (void)state;
    enum { COUNT = 21 };
    for (size_t s = 0; s < sizeof sets / sizeof sets[0]; ++s) {
        aur_sampler *const sampler = make(sets[s], 16);
        uint32_t indices[COUNT];
        float u[COUNT], v[COUNT];
        for (uint32_t k = 0; k < COUNT; ++k)
            indices[k] = 3 * k;
        aur_stream_indices(sampler, 11, COUNT, indices, 5, u, v);
        for (size_t k = 0; k < COUNT; ++k) {
            float one[2];
            aur_stream_pair(&(aur_stream){sampler, 11, indices[k]}, 5, one);
            assert_true(one[0] == u[k] && one[1] == v[k]);
        }
        aur_sampler_destroy(sampler);
    }
}

static void refuses_bad_input(void **state) {
    (void)state;
    aur_sampler *sampler = NULL;
    aur_error error = {0};
    assert_int_equal(aur_sampler_create("sobol", 0, NULL, &sampler, &error), AUR_ERROR_ARGUMENT);
    assert_int_equal(aur_sampler_create("no-such-set", 4, NULL, &sampler, &error), AUR_ERROR_NAME);
    assert_null(sampler);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(is_random_access),
        cmocka_unit_test(is_uniform_over_pixels),
        cmocka_unit_test(nets_stay_nets),
        cmocka_unit_test(tables_are_permuted),
        cmocka_unit_test(many_pixels_are_the_single_ones),
        cmocka_unit_test(samples_of_many_pixels_are_the_single_ones),
        cmocka_unit_test(many_samples_are_the_single_ones),
        cmocka_unit_test(blocks_are_single_pairs),
        cmocka_unit_test(refuses_bad_input),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
