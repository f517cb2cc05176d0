#include "check.h"

#include <string.h>

#include "points/base/random.h"
#include "points/pointset/net_2d.h"

/* The second dimension by its direction numbers: polynomial x + 1, m_1 = 1, m_k = 2 m_{k-1} xor m_{k-1}. */
static uint32_t second_by_direction_numbers(uint32_t index) {
    uint32_t direction = 0x80000000u, sum = 0;
    for (; index != 0; index >>= 1) {
        if (index & 1u)
            sum ^= direction;
        direction ^= direction >> 1;
    }
    return sum;
}

static void second_dimension_is_the_recurrence(void **state) {
    (void)state;
    for (uint32_t i = 0; i < 100000; ++i) {
        const uint32_t index = i < 50000 ? i : (uint32_t)aur_mix64(i);
        assert_int_equal(aur_sobol_second(index), second_by_direction_numbers(index));
    }
}

/* Every elementary interval of area 2^-m holds exactly one of the 2^m points. */
static void scrambled_points_stay_a_net(void **state) {
    (void)state;
    enum { LOG = 10, COUNT = 1 << LOG };
    for (uint32_t seed = 0; seed < 20; ++seed) {
        const uint32_t a = (uint32_t)aur_hash2(seed, 1), b = (uint32_t)aur_hash2(seed, 2);
        for (unsigned k = 0; k <= LOG; ++k) {
            unsigned char seen[COUNT] = {0};
            for (uint32_t i = 0; i < COUNT; ++i) {
                const uint64_t x = aur_owen_scramble(aur_sobol_first(i), a);
                const uint64_t y = aur_owen_scramble(aur_sobol_second(i), b);
                const size_t cell = (size_t)((x << k >> 32) << (LOG - k) | (y << (LOG - k) >> 32));
                assert_int_equal(seen[cell], 0);
                seen[cell] = 1;
            }
        }
    }
}

/* Over many seeds a scrambled word is uniform: 16 cells of expectation 4096, chi-square with 15 degrees of
 * freedom, 99.99 % quantile 44.3; the seeds are fixed, so the test is not flaky. */
static void scrambling_is_uniform_over_seeds(void **state) {
    (void)state;
    for (uint32_t x = 0; x < 8; ++x) {
        unsigned cells[16] = {0};
        for (uint32_t seed = 0; seed < 65536; ++seed)
            ++cells[aur_owen_scramble(x << 29, (uint32_t)aur_hash2(seed, 7)) >> 28];
        double chi = 0;
        for (size_t i = 0; i < 16; ++i)
            chi += (cells[i] - 4096.0) * (cells[i] - 4096.0) / 4096.0;
        assert_true(chi < 44.3);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(second_dimension_is_the_recurrence),
        cmocka_unit_test(scrambled_points_stay_a_net),
        cmocka_unit_test(scrambling_is_uniform_over_seeds),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
