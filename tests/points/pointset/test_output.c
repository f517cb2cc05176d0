/* Layouts, floats, randomisations, and that every instruction set writes the same bits. */
#include "points.h"

#include "points/base/simd.h"
#include "points/pointset/set.h"

static const uint64_t size = 1000;
static const struct {
    const char *text;
    size_t dimension;
    bool shifts, digits; /* the scramblings that it takes */
} cases[] = {
    {"halton", 3, true, true},
    {"hammersley", 3, true, true},
    {"van-der-corput", 1, true, true},
    {"sobol", 2, true, true},
    {"sobol", 1027, true, true},
    {"niederreiter", 5, true, true},
    {"larcher-pillichshammer", 2, true, true},
    {"fibonacci-lattice:offset=0.5", 2, true, false},
    {"rank1:vector=1/377", 2, true, false},
    {"r2", 2, true, false},
    {"golden:seed=0.25", 1, true, false},
    {"random", 3, false, false},
    {"lcg", 2, false, false},
    {"icg", 2, false, false},
    {"jittered", 2, false, false},
};

enum { CASE_COUNT = sizeof cases / sizeof cases[0], FIRST = 37, COUNT = 600 };

/* Both layouts, and floats, all against the points. */
static void check_case(size_t k, aur_scramble scramble) {
    const size_t dimension = cases[k].dimension;
    const aur_pointset_options options = {
        .size = sizeof options, .count = size, .dimension = dimension, .scramble = scramble, .seed = 4};
    aur_pointset *const set = make_set(cases[k].text, options);
    const size_t capacity = COUNT * dimension;
    double *const points = malloc(capacity * sizeof *points);
    double *const doubles = malloc(capacity * sizeof *doubles);
    float *const floats = malloc(capacity * sizeof *floats);
    assert_true(points != NULL && doubles != NULL && floats != NULL);
    assert_int_equal(aur_pointset_points(set, FIRST, COUNT, capacity, points, NULL), AUR_OK);
    assert_int_equal(aur_pointset_coordinates(set, 0, dimension, FIRST, COUNT,
                                              &(aur_output){.capacity = capacity, .doubles = doubles}, NULL),
                     AUR_OK);
    assert_memory_equal(points, doubles, capacity * sizeof *points);
    assert_int_equal(aur_pointset_coordinates(
                         set, 0, dimension, FIRST, COUNT,
                         &(aur_output){.layout = AUR_LAYOUT_ARRAYS, .capacity = capacity, .doubles = doubles},
                         NULL),
                     AUR_OK);
    assert_int_equal(aur_pointset_coordinates(set, 0, dimension, FIRST, COUNT,
                                              &(aur_output){.capacity = capacity, .floats = floats}, NULL),
                     AUR_OK);
    for (size_t i = 0; i < COUNT; ++i) {
        for (size_t d = 0; d < dimension; ++d) {
            const double x = points[i * dimension + d];
            assert_true(doubles[d * COUNT + i] == x);
            assert_true(floats[i * dimension + d] <= x && x < (double)floats[i * dimension + d] + 0x1p-24);
        }
        const size_t d = i % dimension;
        assert_true(aur_pointset_coordinate(set, FIRST + i, d) == points[i * dimension + d]);
    }
    assert_int_equal(aur_pointset_coordinates(
                         set, 0, dimension, FIRST, COUNT,
                         &(aur_output){.layout = AUR_LAYOUT_ARRAYS, .capacity = capacity, .floats = floats},
                         NULL),
                     AUR_OK);
    for (size_t i = 0; i < COUNT; ++i) {
        const double x = points[i * dimension + dimension - 1];
        const double f = (double)floats[(dimension - 1) * COUNT + i];
        assert_true(f <= x && x < f + 0x1p-24);
    }
    free(points);
    free(doubles);
    free(floats);
    aur_pointset_destroy(set);
}

static void all_forms_agree(void **state) {
    (void)state;
    for (size_t k = 0; k < CASE_COUNT; ++k) {
        check_case(k, AUR_SCRAMBLE_NONE);
        if (cases[k].shifts)
            check_case(k, AUR_SCRAMBLE_SHIFT);
        if (cases[k].digits)
            check_case(k, AUR_SCRAMBLE_OWEN);
    }
}

/* NULL: the previous environment. */
static void hold_isa(const char *name) {
    if (name != NULL)
        setenv("AUREOLE_ISA", name, 1);
    else
        unsetenv("AUREOLE_ISA");
    aur_isa_reset();
}

/* Prefixes of various lengths, starts and addresses, so that every lane, wrap and tail of a group is met. */
static void instruction_sets_agree(void **state) {
    (void)state;
    enum { LONGEST = 3000 };
    static const aur_scramble scrambles[] = {AUR_SCRAMBLE_NONE, AUR_SCRAMBLE_DIGIT, AUR_SCRAMBLE_OWEN,
                                             AUR_SCRAMBLE_SHIFT};
    static const char *const isas[] = {"avx2", "avx512"};
    static const struct {
        const char *text;
        uint64_t size;
        bool digits, plane; /* has digits to scramble; has two dimensions only */
    } sets[] = {
        {"sobol", UINT64_C(1) << 53, true, false},
        {"niederreiter", UINT64_C(1) << 53, true, false},
        {"random", UINT64_MAX, true, false},
        {"halton", UINT64_C(1) << 48, true, false},
        {"hammersley", (UINT64_C(1) << 48) - 1, true, false},
        {"larcher-pillichshammer", UINT64_C(1) << 48, true, true},
        {"r2", UINT64_MAX, false, false},
        {"rank1", UINT64_C(269887340401663), false, true},
        {"rank1:vector=1/70000", 5000, false, true},
        {"fibonacci-lattice", UINT64_C(1) << 47, false, true},
        {"fibonacci-lattice", 4181, false, true},
        {"golden-set", 5000, false, true},
    };
    enum { SETS = sizeof sets / sizeof sets[0] };
    static const uint64_t bases[] = {0, 1000, (UINT64_C(1) << 32) - 300, (UINT64_C(1) << 52) + 12345};
    _Alignas(64) static double plain[3 * LONGEST + 8], wide[3 * LONGEST + 8];
    const char *const before = getenv("AUREOLE_ISA");
    char *const saved = before != NULL ? strdup(before) : NULL;
    for (size_t attempt = 0; attempt < 600 * SETS; ++attempt) {
        const size_t k = attempt % SETS;
        const size_t round = attempt / SETS;
        const size_t dimension = sets[k].plane ? 2 : 1 + round % 3;
        const aur_pointset_options options = {
            .size = sizeof options,
            .count = sets[k].size,
            .dimension = dimension,
            .scramble = scrambles[sets[k].digits ? round / 3 % 4 : 3 * (round / 3 % 2)],
            .seed = attempt};
        aur_pointset *const set = make_set(sets[k].text, options);
        const size_t count = 1 + round * 7 % (round % 10 == 0 ? LONGEST : 300);
        const uint64_t base = bases[round / 12 % 4] + round % 67;
        const uint64_t first = base <= sets[k].size - count ? base : sets[k].size - count;
        const size_t offset = round / 2 % 8;
        hold_isa("portable");
        assert_int_equal(aur_pointset_points(set, first, count, 3 * LONGEST, plain + offset, NULL), AUR_OK);
        hold_isa(isas[round % 2]);
        plain[offset + count * dimension] = wide[offset + count * dimension] = -1.0;
        assert_int_equal(aur_pointset_points(set, first, count, 3 * LONGEST, wide + offset, NULL), AUR_OK);
        assert_memory_equal(plain + offset, wide + offset, (count * dimension + 1) * sizeof *plain);
        aur_pointset_destroy(set);
    }
    hold_isa(saved);
    free(saved);
}

/* Outputs beyond the caches are written past them: the same bits, from whatever address on. */
static void long_runs_agree(void **state) {
    (void)state;
    enum { LONG = 300000, PART = 1000 };
    static const char *const sets[] = {"sobol",   "random", "r2", "rank1", "halton", "larcher-pillichshammer",
                                       "jittered"};
    double *const room = malloc((2 * LONG + 8) * sizeof *room);
    double *const part = malloc(sizeof(double[2 * PART]));
    assert_true(room != NULL && part != NULL);
    for (size_t k = 0; k < 2 * sizeof sets / sizeof sets[0]; ++k) {
        double *const whole = room + k % 8;
        const aur_pointset_options options = {.size = sizeof options,
                                              .count = LONG + 5,
                                              .scramble = k == 0 ? AUR_SCRAMBLE_OWEN : AUR_SCRAMBLE_NONE,
                                              .seed = 6};
        aur_pointset *const set = make_set(sets[k / 2], options);
        assert_int_equal(aur_pointset_points(set, 5, LONG, 2 * LONG, whole, NULL), AUR_OK);
        for (size_t begin = 0; begin < LONG; begin += PART) {
            assert_int_equal(aur_pointset_points(set, 5 + begin, PART, 2 * PART, part, NULL), AUR_OK);
            assert_memory_equal(part, whole + 2 * begin, sizeof(double[2 * PART]));
        }
        aur_pointset_destroy(set);
    }
    free(room);
    free(part);
}

static void randomisations_need_nothing_again(void **state) {
    (void)state;
    static const char *const texts[] = {"sobol", "halton", "faure", "golden-set", "r2"};
    double a[64], b[64];
    for (size_t k = 0; k < 5; ++k) {
        const aur_scramble scramble = k < 3 ? AUR_SCRAMBLE_OWEN : AUR_SCRAMBLE_SHIFT;
        aur_pointset *const set =
            make_set(texts[k],
                     (aur_pointset_options){
                         .size = sizeof(aur_pointset_options), .count = 32, .scramble = scramble, .seed = 1});
        for (uint64_t seed = 1; seed < 5; ++seed) {
            aur_pointset *const other = make_set(
                texts[k],
                (aur_pointset_options){
                    .size = sizeof(aur_pointset_options), .count = 32, .scramble = scramble, .seed = seed});
            assert_int_equal(
                aur_pointset_randomize(set, seed, 0, 32, &(aur_output){.capacity = 64, .doubles = a}, NULL),
                AUR_OK);
            assert_int_equal(aur_pointset_points(other, 0, 32, 64, b, NULL), AUR_OK);
            assert_memory_equal(a, b, sizeof a);
            aur_pointset_destroy(other);
        }
        aur_pointset_destroy(set);
    }
    aur_pointset *const set =
        make_set("sobol", (aur_pointset_options){.size = sizeof(aur_pointset_options), .count = 32});
    assert_int_equal(aur_pointset_randomize(set, 1, 0, 32, &(aur_output){.capacity = 64, .doubles = a}, NULL),
                     AUR_ERROR_UNSUPPORTED);
    aur_pointset_destroy(set);
}

/* Owen: over seeds, the digit of a node is flipped half of the time, and two nodes of one level independently
 * of each other. 4096 seeds; counts of 2048 and 1024 within five standard deviations. 256 such tests. */
static void owen_flips_are_fair(void **state) {
    (void)state;
    enum { SEEDS = 4096 };
    static const unsigned digits[] = {0, 1, 2, 3, 5, 31, 32, 40};
    for (size_t k = 0; k < sizeof digits / sizeof digits[0]; ++k) {
        const unsigned digit = digits[k];
        for (uint64_t node = 0; node < 16; ++node) {
            const uint64_t a = aur_hash2(node, 1);
            /* Differs from `a` in the digit just before; digits beyond the 32nd depend on the first 32. */
            const unsigned other = digit <= 32 ? digit : 32;
            const uint64_t b = digit == 0 ? a : a ^ UINT64_C(1) << (64 - other);
            unsigned flipped = 0, both = 0;
            for (uint64_t seed = 0; seed < SEEDS; ++seed) {
                const uint64_t key = aur_scramble_key(seed, 0);
                const uint64_t flips_a = (a ^ aur_owen_word(a, key)) >> (63 - digit) & 1u;
                const uint64_t flips_b = (b ^ aur_owen_word(b, key)) >> (63 - digit) & 1u;
                flipped += (unsigned)flips_a;
                both += (unsigned)(flips_a & flips_b);
            }
            assert_near(flipped, SEEDS / 2.0, 5.0 * 32.0);
            if (digit > 0)
                assert_near(both, SEEDS / 4.0, 5.0 * 27.8);
        }
    }
}

/* Points above the digit where two words part stay together: the scrambling is nested. */
static void owen_is_nested(void **state) {
    (void)state;
    for (uint64_t attempt = 0; attempt < 20000; ++attempt) {
        const uint64_t a = aur_hash2(attempt, 1), key = aur_hash2(attempt, 2);
        const unsigned digit = (unsigned)(attempt % 64);
        const uint64_t b =
            a ^ UINT64_C(1) << (63 - digit) ^ (digit < 63 ? aur_hash2(attempt, 3) >> (digit + 1) : 0);
        const uint64_t difference = aur_owen_word(a, key) ^ aur_owen_word(b, key);
        assert_int_equal(__builtin_clzll(difference), digit);
    }
}

/* The result that is expected, with a message. */
static void refused(aur_result result, aur_result expected, aur_error *error) {
    assert_int_equal(result, expected);
    assert_int_equal(error->result, expected);
    assert_true(strlen(error->message) > 0);
    *error = (aur_error){0};
}

static void outputs_are_checked(void **state) {
    (void)state;
    double doubles[64];
    float floats[64];
    aur_pointset *const set =
        make_set("sobol", (aur_pointset_options){.size = sizeof(aur_pointset_options), .count = 1000});
    aur_pointset *const all =
        make_set("random", (aur_pointset_options){.size = sizeof(aur_pointset_options), .count = UINT64_MAX});
    const aur_output good = {.capacity = 64, .doubles = doubles};
    assert_int_equal(aur_pointset_coordinates(set, 0, 2, 0, 32, &good, NULL), AUR_OK);
    aur_error error = {0};
    refused(aur_pointset_coordinates(set, 0, 2, 0, 33, &good, &error), AUR_ERROR_CAPACITY, &error);
    refused(aur_pointset_coordinates(set, 0, 2, 0, SIZE_MAX, &good, &error), AUR_ERROR_ARGUMENT, &error);
    refused(aur_pointset_coordinates(set, 1, 2, 0, 8, &good, &error), AUR_ERROR_ARGUMENT, &error);
    refused(aur_pointset_coordinates(all, 0, 2, 0, SIZE_MAX, &good, &error), AUR_ERROR_CAPACITY, &error);
    refused(aur_golden_set_points(1.0, 8, &good, &error), AUR_ERROR_ARGUMENT, &error);
    refused(aur_golden_set_points(NAN, 8, &good, &error), AUR_ERROR_ARGUMENT, &error);
    refused(aur_golden_set_points(0.0, 0, &good, &error), AUR_ERROR_ARGUMENT, &error);
    const aur_output both = {.capacity = 64, .doubles = doubles, .floats = floats};
    refused(aur_pointset_coordinates(set, 0, 2, 0, 1, &both, &error), AUR_ERROR_ARGUMENT, &error);
    const aur_output narrow = {.layout = AUR_LAYOUT_ARRAYS, .stride = 7, .capacity = 64, .doubles = doubles};
    refused(aur_pointset_coordinates(set, 0, 2, 0, 8, &narrow, &error), AUR_ERROR_ARGUMENT, &error);
    const aur_output wide = {.layout = AUR_LAYOUT_ARRAYS, .stride = 56, .capacity = 64, .doubles = doubles};
    assert_int_equal(aur_pointset_coordinates(set, 0, 2, 0, 8, &wide, NULL), AUR_OK);
    refused(aur_pointset_coordinates(set, 0, 2, 0, 9, &wide, &error), AUR_ERROR_CAPACITY, &error);
    assert_int_equal(aur_output_capacity(AUR_LAYOUT_ARRAYS, 3, 5, 7), 19);
    assert_int_equal(aur_output_capacity(AUR_LAYOUT_POINTS, SIZE_MAX, 2, 0), SIZE_MAX);
    assert_true(isnan(aur_pointset_coordinate(set, 1000, 0)));
    assert_true(isnan(aur_pointset_coordinate(set, 0, 2)));
    aur_pointset_destroy(set);
    aur_pointset_destroy(all);
}

/* The whole golden set at once is the prepared one, in both layouts. */
static void golden_sets_agree(void **state) {
    (void)state;
    enum { N = 300777 };
    static double whole[2 * N]; /* larger than the caches */
    static float floats[2 * N];
    double *const prepared = make_points(
        "golden-set:seed=0.375", (aur_pointset_options){.size = sizeof(aur_pointset_options), .count = N});
    assert_int_equal(
        aur_golden_set_points(0.375, N, &(aur_output){.capacity = 2 * N, .doubles = whole}, NULL), AUR_OK);
    assert_memory_equal(whole, prepared, sizeof whole);
    const aur_output arrays = {.layout = AUR_LAYOUT_ARRAYS, .capacity = 2 * N, .floats = floats};
    assert_int_equal(aur_golden_set_points(0.375, N, &arrays, NULL), AUR_OK);
    for (size_t i = 0; i < N; ++i)
        assert_true(floats[N + i] <= prepared[2 * i + 1] &&
                    prepared[2 * i + 1] < (double)floats[N + i] + 0x1p-24);
    free(prepared);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_forms_agree),     cmocka_unit_test(instruction_sets_agree),
        cmocka_unit_test(long_runs_agree),     cmocka_unit_test(randomisations_need_nothing_again),
        cmocka_unit_test(owen_flips_are_fair), cmocka_unit_test(owen_is_nested),
        cmocka_unit_test(outputs_are_checked), cmocka_unit_test(golden_sets_agree),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
