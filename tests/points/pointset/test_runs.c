/* Runs by wide registers against the plain form, which is also the formula. */
#include "check.h"

#include <stdlib.h>

#include "points/base/random.h"
#include "points/pointset/generators/golden.h"
#include "points/pointset/runs.h"

static const aur_run_kernels *forms[3];
static size_t form_count;

static int find_forms(void **state) {
    (void)state;
    forms[form_count++] = &aur_runs_portable;
#if !defined(AUR_PORTABLE)
    if (aur_isa_available() >= AUR_ISA_AVX2)
        forms[form_count++] = &aur_runs_avx2;
    if (aur_isa_available() >= AUR_ISA_AVX512)
        forms[form_count++] = &aur_runs_avx512;
#endif
    return 0;
}

/* Quotients by multiplication equal those of a division: all below small sizes, and those of sizes about
 * powers of two up to the limit, whose quotients come closest to rounding boundaries. */
static void quotients_are_divisions(void **state) {
    (void)state;
    enum { COUNT = 777 };
    double plain[COUNT], wide[COUNT];
    for (uint64_t attempt = 0; attempt < 4000; ++attempt) {
        const uint64_t power = UINT64_C(1) << (attempt % 47 + 2);
        const uint64_t size =
            attempt < 700 ? attempt + 1 : power - aur_hash2(attempt, 0) % (attempt % 9 + 1) % power;
        const uint64_t position = aur_hash2(attempt, 1) % size;
        const uint64_t step = aur_hash2(attempt, 2) % size;
        aur_runs_portable.multiples(&(aur_multiples){.position = position, .step = step, .size = size}, COUNT,
                                    plain);
        for (size_t f = 1; f < form_count; ++f) {
            aur_multiples run = {.position = position, .step = step, .size = size};
            forms[f]->multiples(&run, AUR_RUN_GROUP, wide);
            forms[f]->multiples(&run, COUNT - AUR_RUN_GROUP, wide + AUR_RUN_GROUP);
            assert_memory_equal(plain, wide, sizeof plain);
        }
        double numerators[COUNT];
        for (size_t i = 0; i < COUNT; ++i)
            numerators[i] = (double)(int64_t)(aur_hash2(attempt, i + 3) % ((size + 1) / 2));
        const double base = (double)(int64_t)(size / 2);
        aur_runs_portable.quotients(base, numerators, (double)(int64_t)size, COUNT, plain);
        for (size_t f = 1; f < form_count; ++f) {
            forms[f]->quotients(base, numerators, (double)(int64_t)size, COUNT, wide);
            assert_memory_equal(plain, wide, sizeof plain);
        }
    }
}

/* The smallest value's index against a search through all. */
static void golden_order_begins_with_the_smallest(void **state) {
    (void)state;
    for (uint64_t attempt = 0; attempt < 3000; ++attempt) {
        const uint64_t count = 1 + (attempt < 600 ? attempt : aur_hash2(attempt, 0) % 20000);
        const uint64_t seed = attempt % 3 == 0 ? 0 : aur_hash2(attempt, 1);
        uint64_t smallest = 0;
        uint64_t word = seed;
        for (uint64_t i = 1; i < count; ++i) {
            const uint64_t other = seed + aur_phase(aur_golden_fraction, i);
            smallest = other < word ? i : smallest;
            word = other < word ? other : word;
        }
        assert_int_equal(aur_golden_order_of(seed, count).first, smallest);
    }
}

static void ascents_agree(void **state) {
    (void)state;
    enum { COUNT = 3000 };
    for (uint64_t attempt = 0; attempt < 600; ++attempt) {
        const uint64_t count =
            attempt < 300 ? attempt + 1 : (UINT64_C(1) << 32) - aur_hash2(attempt, 0) % 100000000;
        const uint64_t seed = aur_hash2(attempt, 1);
        const aur_golden_order order = aur_golden_order_of(seed, count);
        double values[3][COUNT];
        size_t written[3];
        for (size_t f = 0; f < form_count; ++f) {
            aur_ascent ascent = {seed, count, order.increment, order.increment + order.decrement,
                                 order.first};
            written[f] = forms[f]->ascent(&ascent, COUNT / 2, values[f]);
            written[f] += forms[f]->ascent(&ascent, COUNT - written[f], values[f] + written[f]);
            assert_true(written[f] > COUNT - 2 * AUR_RUN_SLACK);
            const size_t same = written[f] < written[0] ? written[f] : written[0];
            assert_memory_equal(values[f], values[0], same * sizeof(double));
        }
        for (size_t i = 1; i < count && i < written[0]; ++i)
            assert_true(values[0][i] > values[0][i - 1]);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(quotients_are_divisions),
        cmocka_unit_test(golden_order_begins_with_the_smallest),
        cmocka_unit_test(ascents_agree),
    };
    return cmocka_run_group_tests(tests, find_forms, NULL);
}
