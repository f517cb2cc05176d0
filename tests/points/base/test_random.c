#include "check.h"

#include "points/base/random.h"

/* All 24 orders of four items come about equally often: chi^2 of 23 degrees of freedom is below 60 in all but
 * 4 of 100,000 runs, and the seeds are fixed. */
static void shuffles_are_random_orders(void **state) {
    (void)state;
    enum { SEEDS = 24000 };
    size_t seen[256] = {0};
    for (uint64_t seed = 0; seed < SEEDS; ++seed) {
        uint32_t items[4] = {0, 1, 2, 3};
        aur_shuffle(4, items, seed);
        ++seen[items[0] << 6 | items[1] << 4 | items[2] << 2 | items[3]];
    }
    size_t orders = 0;
    double chi_squared = 0.0;
    for (size_t i = 0; i < 256; ++i) {
        if (seen[i] == 0)
            continue;
        ++orders;
        chi_squared += ((double)seen[i] - SEEDS / 24.0) * ((double)seen[i] - SEEDS / 24.0) / (SEEDS / 24.0);
    }
    assert_int_equal(orders, 24);
    assert_true(chi_squared < 60.0);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(shuffles_are_random_orders)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
