/* Golden values, nets before and after scrambling, discrepancies in closed form, and the guarantees of every
 * set. */
#include "points.h"

#include "points/sphere/native.h"

static aur_pointset_options options_of(uint64_t count) {
    return (aur_pointset_options){.size = sizeof(aur_pointset_options), .count = count};
}

static void larcher_pillichshammer_begins_as_published(void **state) {
    (void)state;
    static const double y[] = {0, .5, .75, .25, .875, .375, .125, .625};
    double *const points = make_points("larcher-pillichshammer", options_of(8));
    for (size_t i = 0; i < 8; ++i) {
        assert_near(points[2 * i], (double)i / 8.0, 0.0);
        assert_near(points[2 * i + 1], y[i], 0.0);
    }
    free(points);
}

static void halton_begins_as_published(void **state) {
    (void)state;
    static const double base3[] = {0,      1. / 3, 2. / 3, 1. / 9, 4. / 9,
                                   7. / 9, 2. / 9, 5. / 9, 8. / 9, 1. / 27};
    static const double base2[] = {0, .5, .25, .75, .125, .625, .375, .875, .0625, .5625};
    double *const points = make_points(
        "halton", (aur_pointset_options){.size = sizeof(aur_pointset_options), .count = 10, .dimension = 3});
    for (size_t i = 0; i < 10; ++i) {
        assert_near(points[3 * i], base2[i], 0.0);
        assert_near(points[3 * i + 1], base3[i], 1e-16);
        assert_near(points[3 * i + 2], (double)(i % 5) / 5.0 + (double)(i / 5) / 25.0, 2e-16);
    }
    free(points);
}

/* Point 1 is 1/2 in every dimension, and dimension d's first 2^m points are a permutation of the multiples of
 * 2^-m; the values are those of Joe and Kuo's program in natural order. */
static void sobol_begins_as_published(void **state) {
    (void)state;
    /* Points 2 and 3 in Gray-code order are 3 and 2 here. */
    static const double second[] = {.25, .75, .75, .75, .25}; /* point 2, dimensions 0.. */
    static const double third[] = {.75, .25, .25, .25, .75};  /* point 3 */
    double *const points = make_points(
        "sobol", (aur_pointset_options){.size = sizeof(aur_pointset_options), .count = 4, .dimension = 5});
    for (size_t d = 0; d < 5; ++d) {
        assert_near(points[d], 0.0, 0.0);
        assert_near(points[5 + d], 0.5, 0.0);
        assert_near(points[10 + d], second[d], 0.0);
        assert_near(points[15 + d], third[d], 0.0);
    }
    free(points);
}

static void sobol_is_stratified_in_every_dimension(void **state) {
    (void)state;
    enum { LOG = 7, COUNT = 1 << LOG, DIMENSION = 1500 };
    double *const points = make_points(
        "sobol",
        (aur_pointset_options){.size = sizeof(aur_pointset_options), .count = COUNT, .dimension = DIMENSION});
    for (size_t d = 0; d < DIMENSION; ++d) {
        unsigned char seen[COUNT] = {0};
        for (size_t i = 0; i < COUNT; ++i)
            assert_int_equal(seen[(size_t)(points[i * DIMENSION + d] * COUNT)]++, 0);
    }
    free(points);
}

/* Coordinates of one dimension, one after another. */
static void fill_dimension(const aur_pointset *set, size_t dimension, size_t count, double *values) {
    const aur_output output = {.doubles = values, .capacity = count};
    assert_int_equal(aur_pointset_coordinates(set, dimension, 1, 0, count, &output, NULL), AUR_OK);
}

/* SciPy 1.17's points 3, 77 and 255 in natural order, up to the last dimension of Joe and Kuo's table. */
static void sobol_has_all_published_dimensions(void **state) {
    (void)state;
    static const struct {
        size_t dimension;
        double values[3];
    } published[] = {{1024, {0x1p-2, 0x1.e8p-2, 0x1.2p-5}},
                     {3000, {0x1.8p-1, 0x1.88p-2, 0x1.fcp-2}},
                     {13425, {0x1p-2, 0x1.9cp-1, 0x1.a4p-2}},
                     {21200, {0x1.8p-1, 0x1.34p-1, 0x1.44p-2}}};
    aur_pointset *const set = make_set(
        "sobol",
        (aur_pointset_options){.size = sizeof(aur_pointset_options), .count = 256, .dimension = 21201});
    double values[256];
    for (size_t k = 0; k < sizeof published / sizeof published[0]; ++k) {
        fill_dimension(set, published[k].dimension, 256, values);
        assert_near(values[3], published[k].values[0], 0.0);
        assert_near(values[77], published[k].values[1], 0.0);
        assert_near(values[255], published[k].values[2], 0.0);
    }
    aur_pointset_destroy(set);
}

/* A dimension and its repeat are as independent as random ones: the correlation of 2^12 points is below five
 * standard deviations (1/64 each) of independent uniform numbers'. */
static void sobol_repeats_are_uncorrelated(void **state) {
    (void)state;
    enum { COUNT = 1 << 12, TABLE = 21201 };
    static double first[COUNT], second[COUNT];
    aur_pointset *const set = make_set("sobol", (aur_pointset_options){.size = sizeof(aur_pointset_options),
                                                                       .count = COUNT,
                                                                       .dimension = 2 * TABLE + 12});
    for (size_t d = 0; d < 12; ++d) {
        fill_dimension(set, d, COUNT, first);
        for (size_t repeat = d + TABLE; repeat < 2 * TABLE + 12; repeat += TABLE) {
            fill_dimension(set, repeat, COUNT, second);
            double sum = 0.0;
            for (size_t i = 0; i < COUNT; ++i)
                sum += (first[i] - 0.5) * (second[i] - 0.5);
            assert_near(12.0 * sum / COUNT, 0.0, 5.0 / 64.0);
        }
    }
    aur_pointset_destroy(set);
}

static const aur_scramble digital[] = {AUR_SCRAMBLE_NONE, AUR_SCRAMBLE_DIGIT, AUR_SCRAMBLE_OWEN};

static void nets_stay_nets(void **state) {
    (void)state;
    static const char *const names[] = {"sobol", "larcher-pillichshammer", "hammersley"};
    for (size_t n = 0; n < 3; ++n) {
        for (unsigned m = 0; m <= 12; m += 3) {
            for (size_t s = 0; s < 3; ++s) {
                for (uint64_t seed = 0; seed < 10; ++seed) {
                    double *const points =
                        make_points(names[n], (aur_pointset_options){.size = sizeof(aur_pointset_options),
                                                                     .count = UINT64_C(1) << m,
                                                                     .scramble = digital[s],
                                                                     .seed = seed});
                    assert_true(is_net(2, m, points, 2, 0, 1));
                    free(points);
                }
            }
        }
    }
}

/* An aligned run of 2^m points anywhere in Sobol's sequence is a net as well. */
/* The flips of the eight nodes of the fourth digit, over seeds: Owen's scrambling has all 256 patterns, each
 * as often (chi squared with 255 degrees of freedom, below 350 but for one in 10^4); the hash has no more
 * than half. Nets stay nets. */
static void nested_flips_are_independent(void **state) {
    (void)state;
    enum { SEEDS = 1 << 13, NODES = 8 };
    static const aur_scramble kinds[] = {AUR_SCRAMBLE_OWEN, AUR_SCRAMBLE_NESTED};
    for (size_t k = 0; k < 2; ++k) {
        unsigned counts[1 << NODES] = {0}, seen = 0;
        for (uint64_t seed = 0; seed < SEEDS; ++seed) {
            /* The first point of each node: multiples of 1/8, whose fourth digit is 0 before. */
            double *const points =
                make_points("sobol", (aur_pointset_options){.size = sizeof(aur_pointset_options),
                                                            .count = NODES,
                                                            .dimension = 1,
                                                            .scramble = kinds[k],
                                                            .seed = seed});
            unsigned pattern = 0;
            for (size_t i = 0; i < NODES; ++i)
                pattern |= ((unsigned)(points[i] * 2 * NODES) & 1u) << i;
            ++counts[pattern];
            free(points);
        }
        double chi = 0.0;
        for (size_t c = 0; c < 1 << NODES; ++c) {
            const double expected = (double)SEEDS / (1 << NODES), off = counts[c] - expected;
            chi += off * off / expected;
            seen += counts[c] > 0;
        }
        assert_true(kinds[k] == AUR_SCRAMBLE_NESTED ? seen == 256 && chi < 350.0 : seen <= 128);
    }
    static const char *const names[] = {"sobol", "larcher-pillichshammer"};
    for (size_t n = 0; n < 2; ++n)
        for (uint64_t seed = 0; seed < 10; ++seed) {
            double *const points =
                make_points(names[n], (aur_pointset_options){.size = sizeof(aur_pointset_options),
                                                             .count = 512,
                                                             .scramble = AUR_SCRAMBLE_NESTED,
                                                             .seed = seed});
            assert_true(is_net(2, 9, points, 2, 0, 1));
            free(points);
        }
}

static void sobol_is_a_sequence(void **state) {
    (void)state;
    aur_pointset *const set = make_set("sobol", (aur_pointset_options){.size = sizeof(aur_pointset_options),
                                                                       .count = UINT64_C(1) << 53,
                                                                       .scramble = AUR_SCRAMBLE_OWEN});
    static double points[2 << 10];
    static const uint64_t starts[] = {1024,
                                      UINT64_C(1) << 31,
                                      (UINT64_C(1) << 32) - 1024,
                                      UINT64_C(1) << 32,
                                      (UINT64_C(1) << 40) + 5 * 1024,
                                      (UINT64_C(1) << 53) - 1024};
    for (size_t k = 0; k < sizeof starts / sizeof starts[0]; ++k) {
        assert_int_equal(aur_pointset_points(set, starts[k], 1024, 2048, points, NULL), AUR_OK);
        assert_true(is_net(2, 10, points, 2, 0, 1));
    }
    aur_pointset_destroy(set);
}

/* Halton's coordinates stay stratified in their bases: base 3, 3^7 points. */
static void scrambled_halton_is_stratified(void **state) {
    (void)state;
    enum { COUNT = 2187 };
    static const char *const texts[] = {"halton", "halton", "halton", "halton:permute=random"};
    static const aur_scramble scrambles[] = {AUR_SCRAMBLE_NONE, AUR_SCRAMBLE_DIGIT, AUR_SCRAMBLE_OWEN,
                                             AUR_SCRAMBLE_NONE};
    for (size_t k = 0; k < 4; ++k) {
        double *const points = make_points(
            texts[k],
            (aur_pointset_options){
                .size = sizeof(aur_pointset_options), .count = COUNT, .scramble = scrambles[k], .seed = 7});
        unsigned char seen[COUNT] = {0};
        for (size_t i = 0; i < COUNT; ++i)
            assert_int_equal(seen[(size_t)(points[2 * i + 1] * COUNT + 1e-9)]++, 0);
        free(points);
    }
}

/* Hammersley: N D* = m/3 + 13/9 - (-1)^m 4/(9 2^m) at N = 2^m, m >= 2. */
static void discrepancies_have_their_closed_forms(void **state) {
    (void)state;
    for (unsigned m = 2; m <= 7; ++m) {
        const size_t count = (size_t)1 << m;
        double *const points = make_points("hammersley", options_of(count));
        const double expected =
            m / 3.0 + 13.0 / 9.0 - (m % 2 == 0 ? 1.0 : -1.0) * 4.0 / (9.0 * (double)count);
        assert_near((double)count * brute_star_discrepancy(count, points), expected, 1e-12);
        free(points);
    }
    static const struct {
        const char *set;
        double discrepancy;
    } golden[] = {{"hammersley", .053711}, {"sobol", .053711}, {"larcher-pillichshammer", .041016}};
    for (size_t k = 0; k < sizeof golden / sizeof golden[0]; ++k) {
        double *const points = make_points(golden[k].set, options_of(64));
        assert_near(brute_star_discrepancy(64, points), golden[k].discrepancy, 5e-7);
        free(points);
    }
}

/* The shortest valid name of each set, with its required keys. */
static bool needs_a_file(const char *name) {
    return strcmp(name, "file") == 0 || strcmp(name, "matrices") == 0;
}

/* Any part in any order is the same as the whole, for every set and scrambling; every coordinate is in [0,1).
 */
static void every_set_is_random_access(void **state) {
    (void)state;
    for (size_t k = 0; k < AUR_SQUARE_SET_COUNT; ++k) {
        const aur_square_set *const kind = (const aur_square_set *)aur_set_rows[k];
        if (needs_a_file(kind->description.row.name))
            continue;
        for (int s = AUR_SCRAMBLE_NONE; s <= AUR_SCRAMBLE_ROTATE; ++s) {
            const size_t dimension =
                kind->description.dimensions[1] < 2 ? kind->description.dimensions[1] : 2;
            if ((kind->scramblings >> s & 1u) == 0 || (dimension < 2 && s == AUR_SCRAMBLE_ROTATE))
                continue;
            enum { COUNT = 233 };
            const aur_pointset_options options = {.size = sizeof options,
                                                  .count = COUNT,
                                                  .dimension = dimension,
                                                  .scramble = (aur_scramble)s,
                                                  .seed = 5};
            double *const whole = make_points(kind->description.row.name, options);
            aur_pointset *const set = make_set(kind->description.row.name, options);
            for (size_t i = COUNT; i-- > 0;) {
                const size_t run = i % 7 < COUNT - i ? i % 7 : COUNT - i;
                double part[14];
                assert_int_equal(aur_pointset_points(set, i, run, 14, part, NULL), AUR_OK);
                assert_memory_equal(part, whole + i * dimension, run * dimension * sizeof *part);
            }
            aur_pointset_destroy(set);
            free(whole);
        }
    }
}

/* The first points of a larger set are the smaller set, if the table states it. */
static void extensible_sets_extend(void **state) {
    (void)state;
    for (size_t k = 0; k < AUR_SQUARE_SET_COUNT; ++k) {
        const aur_square_set *const kind = (const aur_square_set *)aur_set_rows[k];
        if (needs_a_file(kind->description.row.name))
            continue;
        const size_t dimension = kind->description.dimensions[1] < 2 ? kind->description.dimensions[1] : 2;
        double *const small =
            make_points(kind->description.row.name,
                        (aur_pointset_options){
                            .size = sizeof(aur_pointset_options), .count = 55, .dimension = dimension});
        double *const large =
            make_points(kind->description.row.name,
                        (aur_pointset_options){
                            .size = sizeof(aur_pointset_options), .count = 89, .dimension = dimension});
        const bool same = memcmp(small, large, 55 * dimension * sizeof *small) == 0;
        if (same != (kind->description.extensible != 0))
            print_error("%s\n", kind->description.row.name);
        assert_int_equal(same, kind->description.extensible != 0);
        free(small);
        free(large);
    }
}

/* Another seed gives other points, for every scrambling. */
static void the_seed_acts(void **state) {
    (void)state;
    for (int s = AUR_SCRAMBLE_DIGIT; s <= AUR_SCRAMBLE_ROTATE; ++s) {
        double *const a = make_points("sobol", (aur_pointset_options){.size = sizeof(aur_pointset_options),
                                                                      .count = 16,
                                                                      .scramble = (aur_scramble)s,
                                                                      .seed = 1});
        double *const b = make_points("sobol", (aur_pointset_options){.size = sizeof(aur_pointset_options),
                                                                      .count = 16,
                                                                      .scramble = (aur_scramble)s,
                                                                      .seed = 2});
        for (size_t i = 0; i < 16; ++i)
            assert_true(a[2 * i + 1] != b[2 * i + 1]);
        free(a);
        free(b);
    }
}

/* A rotation leaves the first coordinate alone and shifts the second one by one amount. */
static void rotate_shifts_the_azimuth(void **state) {
    (void)state;
    double *const plain = make_points("hammersley", options_of(32));
    double *const turned = make_points(
        "hammersley",
        (aur_pointset_options){
            .size = sizeof(aur_pointset_options), .count = 32, .scramble = AUR_SCRAMBLE_ROTATE, .seed = 3});
    for (size_t i = 0; i < 32; ++i) {
        assert_near(turned[2 * i], plain[2 * i], 0.0);
        double difference = turned[2 * i + 1] - plain[2 * i + 1];
        difference -= floor(difference);
        assert_near(difference, turned[1], 1e-15);
    }
    free(plain);
    free(turned);
}

static void options_can_grow(void **state) {
    (void)state;
    struct {
        aur_pointset_options current;
        int option;
    } newer;
    memset(&newer, 0, sizeof newer);
    newer.current.size = sizeof(aur_pointset_options);
    aur_pointset_options_init(4, &newer.current, NULL);
    newer.current.size = sizeof newer;
    aur_pointset *set = NULL;
    assert_int_equal(aur_pointset_create("sobol", &newer.current, &set, NULL), AUR_OK);
    assert_int_equal(aur_pointset_size(set), 4);
    aur_pointset_destroy(set);
    newer.option = 1;
    assert_int_equal(aur_pointset_create("sobol", &newer.current, &set, NULL), AUR_ERROR_UNSUPPORTED);
    const aur_pointset_options unset = {.count = 4};
    assert_int_equal(aur_pointset_create("sobol", &unset, &set, NULL), AUR_ERROR_ARGUMENT);
    assert_null(set);
}

static void expect_failure(const char *text, aur_pointset_options options, aur_result expected) {
    aur_pointset *set = NULL;
    aur_error error = {0};
    const aur_result result = aur_pointset_create(text, &options, &set, &error);
    if (result != expected)
        print_error("%s: %s (%s)\n", text, aur_result_string(result), error.message);
    assert_int_equal(result, expected);
    assert_null(set);
    assert_int_equal(error.result, expected);
    assert_true(error.message[0] != '\0');
}

static void bad_input_is_refused(void **state) {
    (void)state;
    expect_failure("sobool", options_of(8), AUR_ERROR_NAME);
    expect_failure("", options_of(8), AUR_ERROR_NAME);
    expect_failure("sobol:base=2", options_of(8), AUR_ERROR_NAME);
    expect_failure("halton:permute=maybe", options_of(8), AUR_ERROR_FORMAT);
    expect_failure("halton:permute", options_of(8), AUR_ERROR_FORMAT);
    expect_failure("sobol", options_of(0), AUR_ERROR_ARGUMENT);
    expect_failure("sobol", options_of((UINT64_C(1) << 53) + 1), AUR_ERROR_ARGUMENT);
    expect_failure("larcher-pillichshammer",
                   (aur_pointset_options){.size = sizeof(aur_pointset_options), .count = 4, .dimension = 3},
                   AUR_ERROR_ARGUMENT);
    expect_failure(
        "halton",
        (aur_pointset_options){.size = sizeof(aur_pointset_options), .count = 4, .dimension = 100000},
        AUR_ERROR_ARGUMENT);
    expect_failure("sobol",
                   (aur_pointset_options){
                       .size = sizeof(aur_pointset_options), .count = 4, .scramble = AUR_SCRAMBLE_ROTATE3D},
                   AUR_ERROR_UNSUPPORTED);
    expect_failure("sobol",
                   (aur_pointset_options){
                       .size = sizeof(aur_pointset_options), .count = 4, .scramble = (aur_scramble)77},
                   AUR_ERROR_ARGUMENT);

    aur_pointset *const set = make_set("sobol", options_of(8));
    double points[16];
    assert_int_equal(aur_pointset_points(set, 0, 9, 18, points, NULL), AUR_ERROR_ARGUMENT);
    assert_int_equal(aur_pointset_points(set, UINT64_MAX, 2, 16, points, NULL), AUR_ERROR_ARGUMENT);
    assert_int_equal(aur_pointset_points(set, 0, 8, 15, points, NULL), AUR_ERROR_CAPACITY);
    assert_int_equal(aur_pointset_points(set, 8, 0, 0, points, NULL), AUR_OK);
    aur_pointset_destroy(set);
}

static void count_warning(void *user, const char *message) {
    assert_non_null(strstr(message, "power of 2"));
    ++*(int *)user;
}

static void incomplete_nets_are_reported(void **state) {
    (void)state;
    int warnings = 0;
    aur_pointset_options options = {
        .size = sizeof options, .count = 64, .warnings = {count_warning, &warnings}};
    free(make_points("sobol", options));
    assert_int_equal(warnings, 0);
    options.count = 100;
    free(make_points("sobol", options));
    assert_int_equal(warnings, 1);
}

static void names_of_scramblings_round_trip(void **state) {
    (void)state;
    for (int s = AUR_SCRAMBLE_NONE; s <= AUR_SCRAMBLE_NESTED; ++s) {
        aur_scramble scramble;
        assert_int_equal(aur_scramble_from_name(aur_scramble_name((aur_scramble)s), &scramble, NULL), AUR_OK);
        assert_int_equal(scramble, s);
    }
    assert_null(aur_scramble_name((aur_scramble)7));
    aur_scramble scramble;
    assert_int_equal(aur_scramble_from_name("owens", &scramble, NULL), AUR_ERROR_NAME);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(larcher_pillichshammer_begins_as_published),
        cmocka_unit_test(halton_begins_as_published),
        cmocka_unit_test(sobol_begins_as_published),
        cmocka_unit_test(sobol_is_stratified_in_every_dimension),
        cmocka_unit_test(sobol_has_all_published_dimensions),
        cmocka_unit_test(sobol_repeats_are_uncorrelated),
        cmocka_unit_test(nets_stay_nets),
        cmocka_unit_test(nested_flips_are_independent),
        cmocka_unit_test(sobol_is_a_sequence),
        cmocka_unit_test(scrambled_halton_is_stratified),
        cmocka_unit_test(discrepancies_have_their_closed_forms),
        cmocka_unit_test(every_set_is_random_access),
        cmocka_unit_test(extensible_sets_extend),
        cmocka_unit_test(the_seed_acts),
        cmocka_unit_test(rotate_shifts_the_azimuth),
        cmocka_unit_test(bad_input_is_refused),
        cmocka_unit_test(incomplete_nets_are_reported),
        cmocka_unit_test(options_can_grow),
        cmocka_unit_test(names_of_scramblings_round_trip),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
