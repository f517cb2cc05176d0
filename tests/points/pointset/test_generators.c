/* Each generator against its definition. */
#include "points.h"

#include "points/base/random.h"
#include "points/pointset/fraction128.h"
#include "points/pointset/generators/golden.h"
#include "points/pointset/set.h"

static void lcg_is_minstd(void **state) {
    (void)state;
    /* Park and Miller 1988: from seed 1, value 10000 is 1043618065. */
    aur_pointset *const set =
        make_set("lcg", (aur_pointset_options){.size = sizeof(aur_pointset_options), .count = 5000});
    double first[2], last[2];
    assert_int_equal(aur_pointset_points(set, 0, 1, 2, first, NULL), AUR_OK);
    assert_int_equal(aur_pointset_points(set, 4999, 1, 2, last, NULL), AUR_OK);
    assert_near(first[0] * 2147483647.0, 16807.0, 1e-6);
    assert_near(first[1] * 2147483647.0, 282475249.0, 1e-6);
    assert_near(last[1] * 2147483647.0, 1043618065.0, 1e-6);
    aur_pointset_destroy(set);
}

/* The recursion step by step, inverses by Fermat's theorem in plain loops, across the point at infinity of
 * the projective line, which random access must skip. */
static void icg_is_the_recursion(void **state) {
    (void)state;
    const uint64_t p = 2147483647;
    enum { COUNT = 3000 };
    double *const points = make_points(
        "icg", (aur_pointset_options){.size = sizeof(aur_pointset_options), .count = COUNT, .dimension = 1});
    uint64_t x = 0;
    for (size_t i = 0; i < COUNT; ++i) {
        assert_near(points[i] * (double)p, (double)x, 1e-6);
        uint64_t inverse = 1, base = x;
        for (uint64_t e = p - 2; e > 0; e >>= 1) {
            inverse = e & 1u ? inverse * base % p : inverse;
            base = base * base % p;
        }
        x = (9102 * inverse + 36884165) % p;
    }
    free(points);
    /* Jumping lands where walking does, and the period is full: the last value steps back to 0. */
    aur_pointset *const set = make_set(
        "icg", (aur_pointset_options){.size = sizeof(aur_pointset_options), .count = p, .dimension = 1});
    double ends[2];
    assert_int_equal(aur_pointset_points(set, 2999, 1, 1, ends, NULL), AUR_OK);
    assert_int_equal(aur_pointset_points(set, p - 1, 1, 1, ends + 1, NULL), AUR_OK);
    const uint64_t last = (uint64_t)(ends[1] * (double)p + 0.5);
    /* 9102 / last + 36884165 = 0 */
    assert_int_equal((9102 + last * 36884165 % p) % p, 0);
    aur_pointset_destroy(set);
}

static void expect_run(const char *text, aur_pointset_options options, uint64_t first) {
    enum { COUNT = 700 };
    double *const run = malloc(COUNT * options.dimension * sizeof *run);
    aur_pointset *const set = make_set(text, options);
    assert_int_equal(aur_pointset_points(set, first, COUNT, COUNT * options.dimension, run, NULL), AUR_OK);
    for (size_t i = 0; i < COUNT; ++i)
        for (size_t d = 0; d < options.dimension; ++d)
            assert_true(aur_pointset_coordinate(set, first + i, d) == run[i * options.dimension + d]);
    aur_pointset_destroy(set);
    free(run);
}

/* Runs count on from point to point, single points jump: through carries of many digits, and through the end
 * of the stream of icg, where it starts again at 0 and the line has its infinity. */
static void runs_are_their_points(void **state) {
    (void)state;
    static const char *const faure[] = {"faure:base=5", "faure:base=67",
                                        "faure:base=5,scramble=lower-triangular",
                                        "faure:base=67,scramble=lower-triangular"};
    for (size_t k = 0; k < 4; ++k) {
        const uint64_t base = k % 2 == 0 ? 5 : 67, power = base * base * base * base;
        const aur_pointset_options options = {
            .size = sizeof options, .count = UINT64_C(1) << 40, .dimension = 5, .seed = 3};
        expect_run(faure[k], options, 0);
        expect_run(faure[k], options, power - 350);
        expect_run(faure[k], options, 3 * power * base - 17);
    }
    const uint64_t p = 2147483647;
    for (size_t dimension = 1; dimension <= 3; ++dimension) {
        const uint64_t start = aur_mix64(11) % p;
        const aur_pointset_options options = {
            .size = sizeof options, .count = p / dimension, .dimension = dimension, .seed = 11};
        expect_run("icg", options, (p - start) / dimension - 350);
        expect_run("icg",
                   (aur_pointset_options){
                       .size = sizeof(aur_pointset_options), .count = 1000, .dimension = dimension},
                   0);
    }
}

/* Cells have equal area, so the column of the first coordinate and the row of the second follow from the
 * index. */
static void jittered_points_are_in_their_cells(void **state) {
    (void)state;
    for (size_t count = 1; count < 400; ++count) {
        double *const points = make_points(
            "jittered",
            (aur_pointset_options){.size = sizeof(aur_pointset_options), .count = count, .seed = count});
        const size_t columns = (size_t)sqrt((double)count);
        size_t index = 0;
        for (size_t c = 0; c < columns; ++c) {
            const size_t begin = c * count / columns, end = (c + 1) * count / columns;
            for (size_t r = begin; r < end; ++r, ++index) {
                const double x = points[2 * index] * (double)count;
                const double y = points[2 * index + 1] * (double)(end - begin);
                assert_true(x >= (double)begin - 1e-9 && x <= (double)end + 1e-9);
                assert_true(y >= (double)(r - begin) - 1e-9 && y <= (double)(r - begin + 1) + 1e-9);
            }
        }
        assert_int_equal(index, count);
        free(points);
    }
}

static void faure_is_a_net_in_its_base(void **state) {
    (void)state;
    static const struct {
        size_t base, dimension;
        unsigned m;
        const char *text;
    } cases[] = {{2, 2, 9, "faure"},
                 {3, 3, 6, "faure:base=3"},
                 {5, 5, 4, "faure:base=5"},
                 {7, 4, 3, "faure:base=7"},
                 {3, 3, 6, "faure:base=3,scramble=lower-triangular"},
                 {5, 5, 4, "faure:base=5,scramble=lower-triangular"},
                 {7, 4, 3, "faure:base=7,scramble=lower-triangular"}};
    static const aur_scramble scrambles[] = {AUR_SCRAMBLE_NONE, AUR_SCRAMBLE_DIGIT, AUR_SCRAMBLE_OWEN};
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; ++k) {
        size_t count = 1;
        for (unsigned m = 0; m < cases[k].m; ++m)
            count *= cases[k].base;
        for (size_t s = 0; s < 3; ++s) {
            const size_t dimension = cases[k].dimension;
            double *const points =
                make_points(cases[k].text, (aur_pointset_options){.size = sizeof(aur_pointset_options),
                                                                  .count = count,
                                                                  .dimension = dimension,
                                                                  .scramble = scrambles[s],
                                                                  .seed = 11});
            for (size_t a = 0; a < dimension; ++a)
                for (size_t b = 0; b < a; ++b)
                    assert_true(is_net(cases[k].base, cases[k].m, points, dimension, a, b));
            free(points);
        }
    }
}

/* Entry (r, c) of coordinate d's matrix is binomial(c, r) d^(c - r): the first points of base 3 in 3
 * dimensions. */
static void faure_begins_as_published(void **state) {
    (void)state;
    static const double ninths[9][3] = {{0, 0, 0}, {3, 3, 3}, {6, 6, 6}, {1, 4, 7}, {4, 7, 1},
                                        {7, 1, 4}, {2, 8, 5}, {5, 2, 8}, {8, 5, 2}};
    double *const points = make_points(
        "faure", (aur_pointset_options){.size = sizeof(aur_pointset_options), .count = 9, .dimension = 3});
    for (size_t i = 0; i < 9; ++i)
        for (size_t d = 0; d < 3; ++d)
            assert_near(9.0 * points[3 * i + d], ninths[i][d], 1e-12);
    free(points);
}

/* Sums of e - 1 over the degrees 1, 1, 2, 3, 3 of the first irreducible polynomials: every elementary
 * interval of volume 2^(t - m) holds 2^t points. */
static void niederreiter_has_its_quality_parameter(void **state) {
    (void)state;
    enum { LOG = 9, COUNT = 1 << LOG, DIMENSION = 5 };
    static const unsigned degrees[DIMENSION] = {1, 1, 2, 3, 3};
    for (int scramble = AUR_SCRAMBLE_NONE; scramble <= AUR_SCRAMBLE_OWEN; ++scramble) {
        double *const points =
            make_points("niederreiter", (aur_pointset_options){.size = sizeof(aur_pointset_options),
                                                               .count = COUNT,
                                                               .dimension = DIMENSION,
                                                               .scramble = (aur_scramble)scramble,
                                                               .seed = 3});
        for (size_t a = 0; a < DIMENSION; ++a) {
            for (size_t b = 0; b < a; ++b) {
                const unsigned t = degrees[a] + degrees[b] - 2;
                for (unsigned k = 0; k + t <= LOG; ++k) {
                    const size_t columns = (size_t)1 << k, rows = (size_t)1 << (LOG - t - k);
                    unsigned cells[COUNT] = {0};
                    for (size_t i = 0; i < COUNT; ++i)
                        ++cells[(size_t)(points[i * DIMENSION + a] * (double)columns) * rows +
                                (size_t)(points[i * DIMENSION + b] * (double)rows)];
                    for (size_t c = 0; c < columns * rows; ++c)
                        assert_int_equal(cells[c], 1u << t);
                }
            }
        }
        free(points);
    }
}

/* A sieve of all polynomials over GF(2) of degree 13 or less. */
static void niederreiter_has_the_irreducible_polynomials(void **state) {
    (void)state;
    static const uint16_t polynomials[] = {
#include "data/irreducible.inc"
    };
    enum { END = 1 << 14, COUNT = sizeof polynomials / sizeof *polynomials };
    static bool composite[END];
    size_t found = 0;
    for (uint32_t a = 2; a < END && found < COUNT; ++a) {
        if (composite[a])
            continue;
        assert_int_equal(polynomials[found++], a);
        const unsigned degree = 31u - (unsigned)__builtin_clz(a);
        for (uint32_t b = a; b < (uint32_t)END >> degree; ++b) {
            uint64_t product = 0;
            for (unsigned k = 0; b >> k != 0; ++k)
                product ^= (b >> k & 1) != 0 ? (uint64_t)a << k : 0;
            composite[product] = true;
        }
    }
    assert_int_equal(found, COUNT);
}

static void niederreiter_begins_as_sobol(void **state) {
    (void)state;
    double *const a = make_points("niederreiter",
                                  (aur_pointset_options){.size = sizeof(aur_pointset_options), .count = 512});
    double *const b =
        make_points("sobol", (aur_pointset_options){.size = sizeof(aur_pointset_options), .count = 512});
    assert_memory_equal(a, b, 1024 * sizeof *a);
    free(a);
    free(b);
}

static void write_text(const char *path, const char *text) {
    FILE *const file = fopen(path, "w");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0);
    assert_int_equal(fclose(file), 0);
}

static void matrices_are_read(void **state) {
    (void)state;
    static const char path[] = "test_matrices.tmp";
    /* Identity and Pascal's triangle: Sobol's first two coordinates. */
    write_text(path, "# a comment\nbase 2\n1 0 0\n0 1 0\n0 0 1\n\n111\n010\n001\n");
    aur_pointset_options options = {.size = sizeof options, .count = 8};
    double *points = make_points("matrices:file=test_matrices.tmp", options);
    static const double expected[] = {0,    0,    .5,   .5,   .25,  .75,  .75,  .25,
                                      .125, .625, .625, .125, .375, .875, .875, .375};
    static const double second[] = {0, .5, .75, .25, .625, .125, .375, .875};
    for (size_t i = 0; i < 8; ++i) {
        assert_near(points[2 * i], expected[2 * i], 0.0);
        assert_near(points[2 * i + 1], second[i], 0.0);
    }
    free(points);
    write_text(path, "base 3\n1 0\n0 1\n\n1 1\n0 1\n");
    options.count = 9;
    options.scramble = AUR_SCRAMBLE_OWEN;
    points = make_points("matrices:file=test_matrices.tmp", options);
    assert_true(is_net(3, 2, points, 2, 0, 1));
    free(points);

    static const struct {
        const char *text;
        aur_result result;
        size_t line;
    } bad[] = {{"1 0\n0 2\n", AUR_ERROR_FORMAT, 2},
               {"1 0\n0 1 1\n", AUR_ERROR_FORMAT, 2},
               {"1 0\n0 1\n\n1 0\n", AUR_ERROR_FORMAT, 4},
               {"base 4\n1\n", AUR_ERROR_FORMAT, 1},
               {"1 x\n", AUR_ERROR_FORMAT, 1},
               {"", AUR_ERROR_FORMAT, 0},
               {"1 0\n0 1\n", AUR_ERROR_ARGUMENT, 0},
               {"1\n\n1\n", AUR_ERROR_ARGUMENT, 0},
               {"1\nbase 3\n", AUR_ERROR_FORMAT, 2}};
    for (size_t k = 0; k < sizeof bad / sizeof bad[0]; ++k) {
        write_text(path, bad[k].text);
        aur_pointset *set;
        aur_error error = {0};
        assert_int_equal(aur_pointset_create("matrices:file=test_matrices.tmp", &options, &set, &error),
                         bad[k].result);
        assert_string_equal(error.file, path);
        assert_int_equal(error.line, bad[k].line);
    }
    aur_pointset *set;
    assert_int_equal(aur_pointset_create("matrices", &options, &set, NULL), AUR_ERROR_ARGUMENT);
    remove(path);
}

static void lattices_are_exact(void **state) {
    (void)state;
    double *points = make_points("fibonacci-lattice",
                                 (aur_pointset_options){.size = sizeof(aur_pointset_options), .count = 89});
    for (size_t i = 0; i < 89; ++i) {
        assert_near(points[2 * i], (double)i / 89.0, 0.0);
        assert_near(points[2 * i + 1], (double)(i * 55 % 89) / 89.0, 0.0);
    }
    double *const by_default =
        make_points("rank1", (aur_pointset_options){.size = sizeof(aur_pointset_options), .count = 89});
    assert_memory_equal(points, by_default, 178 * sizeof *points);
    free(by_default);
    free(points);
    points = make_points("rank1:vector=1/3/10",
                         (aur_pointset_options){.size = sizeof(aur_pointset_options), .count = 17});
    for (size_t i = 0; i < 17; ++i)
        assert_near(points[3 * i + 2], (double)(i * 10 % 17) / 17.0, 0.0);
    free(points);
}

/* floor(2^128 / Phi) from Phi's equation: g = 1/Phi is the root of g^2 + g = 1, so 2^256 - g^2 - 2^128 g
 * changes sign at the constant. By schoolbook arithmetic on four 64-bit limbs. */
typedef struct wide256 {
    uint64_t limb[4];
} wide256;

static wide256 square_plus(uint64_t high, uint64_t low) {
    __extension__ typedef unsigned __int128 wide;
    const uint64_t digits[2] = {low, high};
    wide256 result = {{0, 0, low, high}}; /* 2^128 g */
    for (size_t i = 0; i < 2; ++i) {
        uint64_t carry = 0;
        for (size_t j = 0; j < 2; ++j) {
            const wide sum = (wide)digits[i] * digits[j] + result.limb[i + j] + carry;
            result.limb[i + j] = (uint64_t)sum;
            carry = (uint64_t)(sum >> 64);
        }
        for (size_t k = i + 2; k < 4; ++k) {
            const wide sum = (wide)result.limb[k] + carry;
            result.limb[k] = (uint64_t)sum;
            carry = (uint64_t)(sum >> 64);
        }
    }
    return result; /* modulo 2^256: below it before the root, wrapped after it */
}

static void the_golden_constant_is_the_root(void **state) {
    (void)state;
    const aur_fraction128 g = aur_golden_fraction;
    assert_true(square_plus(g.high, g.low).limb[3] > UINT64_MAX / 2);
    assert_true(square_plus(g.high, g.low + 1).limb[3] < UINT64_MAX / 2);
}

/* i / Phi modulo 1 at large i: floor(i F_k / F_{k+1}) converges from both sides; F_91 and F_92 differ from
 * the ratio by less than 2^-123, so that i F_91 mod F_92 / F_92 is the phase to 1e-26. */
static void golden_phases_are_exact(void **state) {
    (void)state;
    __extension__ typedef unsigned __int128 wide;
    uint64_t before = 1, number = 1;
    for (int k = 2; k < 92; ++k) {
        const uint64_t next = before + number;
        before = number;
        number = next;
    }
    aur_pointset *const set = make_set("golden", (aur_pointset_options){.size = sizeof(aur_pointset_options),
                                                                        .count = UINT64_C(1) << 60,
                                                                        .dimension = 1});
    for (uint64_t k = 0; k < 2000; ++k) {
        const uint64_t index = (k < 1000 ? UINT64_C(1000000000) : UINT64_C(1000000000000)) + k * 7919;
        double x;
        assert_int_equal(aur_pointset_points(set, index, 1, 1, &x, NULL), AUR_OK);
        const uint64_t rest = (uint64_t)((wide)(index + 1) * before % number);
        assert_near(x, (double)rest / (double)number, 0x1p-52);
    }
    aur_pointset_destroy(set);
}

/* The order without sorting is the sorted order for every N up to 20000: the values ascend, so that all of
 * them are different, and there are as many as there should be. */
static void golden_order_is_a_sort(void **state) {
    (void)state;
    static uint64_t words[20000];
    for (uint64_t count = 1; count <= 20000; ++count) {
        const uint64_t seed = count % 3 == 0 ? 0 : aur_hash2(count, 5);
        for (uint64_t i = 0; i < count; ++i)
            words[i] = seed + aur_phase(aur_golden_fraction, i);
        const aur_golden_order order = aur_golden_order_of(seed, count);
        uint64_t index = order.first;
        bool ascending = index < count;
        for (uint64_t i = 1; i < count && ascending; ++i) {
            const uint64_t next = aur_golden_next(&order, index);
            ascending = next < count && words[next] > words[index];
            index = next;
        }
        assert_true(ascending);
    }
}

static void golden_figures(void **state) {
    (void)state;
    static const struct {
        const char *text;
        double discrepancy;
    } cases[] = {{"golden-set", .035574}, {"r2", .073908}, {"fibonacci-lattice:offset=0.5", .036170}};
    for (size_t k = 0; k < 3; ++k) {
        double *const points = make_points(
            cases[k].text, (aur_pointset_options){.size = sizeof(aur_pointset_options), .count = 64});
        assert_near(brute_star_discrepancy(64, points), cases[k].discrepancy, 5e-7);
        free(points);
    }
}

/* The second coordinate of two seeds is another golden sequence, and the first one ascends. */
static void golden_set_of_two_seeds(void **state) {
    (void)state;
    double *const points =
        make_points("golden-set:form=two-seeds,seed=0.25",
                    (aur_pointset_options){.size = sizeof(aur_pointset_options), .count = 1000, .seed = 9});
    for (size_t i = 1; i < 1000; ++i) {
        assert_true(points[2 * i] > points[2 * i - 2]);
        const double step = points[2 * i + 1] - points[2 * i - 1];
        assert_near(step - floor(step), 0.61803398874989485, 1e-15);
    }
    free(points);
}

static void files_are_sets(void **state) {
    (void)state;
    static const char path[] = "test_file,set=x.tmp";
    write_text(path, "u,v\n0,0.5\n0.25,0.75\n0.5,0.125\n");
    double *const points =
        make_points("file:test_file,set=x.tmp", (aur_pointset_options){.size = sizeof(aur_pointset_options)});
    assert_near(points[5], 0.125, 0.0);
    free(points);
    aur_pointset *set;
    aur_error error = {0};
    aur_pointset_options options = {.size = sizeof options, .count = 4};
    assert_int_equal(aur_pointset_create("file:test_file,set=x.tmp", &options, &set, &error),
                     AUR_ERROR_ARGUMENT);
    options = (aur_pointset_options){
        .size = sizeof(aur_pointset_options), .count = 2, .scramble = AUR_SCRAMBLE_OWEN};
    assert_int_equal(aur_pointset_create("file:test_file,set=x.tmp", &options, &set, &error),
                     AUR_ERROR_UNSUPPORTED);
    options = (aur_pointset_options){.size = sizeof(aur_pointset_options), .count = 2, .dimension = 3};
    assert_int_equal(aur_pointset_create("file:test_file,set=x.tmp", &options, &set, &error),
                     AUR_ERROR_ARGUMENT);
    write_text(path, "x,y,z\n0,0,1\n");
    options = (aur_pointset_options){.size = sizeof(aur_pointset_options)};
    assert_int_equal(aur_pointset_create("file:test_file,set=x.tmp", &options, &set, &error),
                     AUR_ERROR_UNSUPPORTED);
    remove(path);
    assert_int_equal(aur_pointset_create("file:test_file,set=x.tmp", &options, &set, &error), AUR_ERROR_OPEN);
    assert_int_equal(aur_pointset_create("file:", &options, &set, &error), AUR_ERROR_FORMAT);
    assert_int_equal(aur_pointset_create("file", &options, &set, &error), AUR_ERROR_FORMAT);
}

static void expect(const char *text, aur_pointset_options options, aur_result expected) {
    aur_pointset *set;
    aur_error error = {0};
    const aur_result result = aur_pointset_create(text, &options, &set, &error);
    if (result != expected)
        print_error("%s: %s\n", text, error.message);
    assert_int_equal(result, expected);
}

static void bad_keys_are_refused(void **state) {
    (void)state;
    const aur_pointset_options four = {.size = sizeof four, .count = 4};
    expect("faure:base=4", four, AUR_ERROR_ARGUMENT);
    expect("faure:base=1", four, AUR_ERROR_FORMAT);
    expect("faure:base=3",
           (aur_pointset_options){.size = sizeof(aur_pointset_options), .count = 4, .dimension = 4},
           AUR_ERROR_ARGUMENT);
    expect("rank1:vector=1/", four, AUR_ERROR_FORMAT);
    expect("rank1:vector=1/-2", four, AUR_ERROR_FORMAT);
    expect("rank1:vector=1/2/3",
           (aur_pointset_options){.size = sizeof(aur_pointset_options), .count = 4, .dimension = 2},
           AUR_ERROR_ARGUMENT);
    expect("rank1", (aur_pointset_options){.size = sizeof(aur_pointset_options), .count = 4, .dimension = 3},
           AUR_ERROR_ARGUMENT);
    expect("golden-set:seed=1", four, AUR_ERROR_FORMAT);
    expect("golden-set:seed=nan", four, AUR_ERROR_FORMAT);
    expect("golden:seed=inf", four, AUR_ERROR_FORMAT);
    expect("golden", (aur_pointset_options){.size = sizeof(aur_pointset_options), .count = 4, .dimension = 2},
           AUR_ERROR_ARGUMENT);
    expect("lcg", (aur_pointset_options){.size = sizeof(aur_pointset_options), .count = UINT64_C(1) << 31},
           AUR_ERROR_ARGUMENT);
    expect("icg", (aur_pointset_options){.size = sizeof(aur_pointset_options), .count = UINT64_C(1) << 31},
           AUR_ERROR_ARGUMENT);
    expect("r2",
           (aur_pointset_options){
               .size = sizeof(aur_pointset_options), .count = 4, .scramble = AUR_SCRAMBLE_OWEN},
           AUR_ERROR_UNSUPPORTED);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lcg_is_minstd),
        cmocka_unit_test(icg_is_the_recursion),
        cmocka_unit_test(runs_are_their_points),
        cmocka_unit_test(jittered_points_are_in_their_cells),
        cmocka_unit_test(faure_is_a_net_in_its_base),
        cmocka_unit_test(faure_begins_as_published),
        cmocka_unit_test(niederreiter_has_its_quality_parameter),
        cmocka_unit_test(niederreiter_begins_as_sobol),
        cmocka_unit_test(niederreiter_has_the_irreducible_polynomials),
        cmocka_unit_test(matrices_are_read),
        cmocka_unit_test(lattices_are_exact),
        cmocka_unit_test(the_golden_constant_is_the_root),
        cmocka_unit_test(golden_phases_are_exact),
        cmocka_unit_test(golden_order_is_a_sort),
        cmocka_unit_test(golden_figures),
        cmocka_unit_test(golden_set_of_two_seeds),
        cmocka_unit_test(files_are_sets),
        cmocka_unit_test(bad_keys_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
