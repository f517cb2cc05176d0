/* Coverage of the interval of the error of a mean of replicas: over many sets of random images with known
 * covariance it covers the true error at the stated rate. */
#include "check.h"

#include <math.h>
#include <stdbool.h>

#include "points/base/random.h"
#include "render/image/error_interval.h"

enum { VALUES = 960, BLOCK_VALUES = 12, TRIALS = 2000, SPREADS = 2 };

/* Box and Muller (1958). */
static double normal(uint64_t seed, uint64_t index) {
    const double u = (double)(aur_hash2(seed, 2 * index) >> 11) * 0x1p-53;
    const double v = (double)(aur_hash2(seed, 2 * index + 1) >> 11) * 0x1p-53;
    return sqrt(-2.0 * log(1.0 - u)) * cos(6.283185307179586 * v);
}

typedef struct coverage {
    size_t inside, below, above;
    double mean_degrees, spreads[SPREADS], squares[SPREADS]; /* means over the trials */
} coverage;

/* The deviations of `count` values from their mean, which is returned. */
static double deviations_of(size_t count, double *d) {
    double mean = 0.0;
    for (size_t r = 0; r < count; ++r)
        mean += d[r] / (double)count;
    for (size_t r = 0; r < count; ++r)
        d[r] -= mean;
    return mean;
}

/* Adds the products of a pixel's deviations to those of its block, and its spread to `cell` and `sum`. */
static void add_pixel(size_t count, const double *d, double *block, aur_deviations *sum, aur_cell *cell) {
    double products[AUR_GRAM_ENTRIES(AUR_REPLICAS_MAX)], squares = 0.0,
                                                         channels[3][AUR_REPLICAS_MAX] = {{0.0}};
    for (size_t r = 0; r < count; ++r) {
        channels[0][r] = d[r];
        squares += d[r] * d[r];
        for (size_t s = 0; s <= r; ++s)
            block[AUR_GRAM_ENTRIES(r) + s] += products[AUR_GRAM_ENTRIES(r) + s] = d[r] * d[s];
    }
    aur_deviations_add_pixel(sum, products, channels, squares, cell);
}

/* Adds a cell that has all its pixels, and begins another. */
static void end_cell(aur_deviations *sum, aur_cell *cell) {
    if (cell->pixels < AUR_CELL_PIXELS)
        return;
    aur_deviations_add_cell(sum, cell);
    *cell = (aur_cell){.count = cell->count};
}

/* Value i from normal number `index` of a trial. */
typedef double (*value_function)(size_t i, uint64_t candidate, uint64_t index);

enum { COLUMNS = 10, BLOCKS = VALUES / BLOCK_VALUES, ROWS = BLOCKS / COLUMNS };

/* Replicas of a trial, from number `first` on. Returns the square of their mean's error. */
static double add_values(size_t count, value_function draw, uint64_t candidate, uint64_t first,
                         aur_deviations *sum, aur_block_spread blocks[BLOCKS]) {
    double products[BLOCKS * AUR_GRAM_ENTRIES(AUR_REPLICAS_MAX)] = {0.0}, square = 0.0;
    aur_cell cell = {.count = count};
    for (size_t i = 0; i < VALUES; ++i) {
        double d[AUR_REPLICAS_MAX];
        for (size_t r = 0; r < count; ++r)
            d[r] = draw(i, candidate, (first + i) * count + r);
        const double mean = deviations_of(count, d);
        square += mean * mean;
        add_pixel(count, d, products + i / BLOCK_VALUES * AUR_GRAM_ENTRIES(count), sum, &cell);
        end_cell(sum, &cell);
    }
    aur_blocks_measure(count, COLUMNS, ROWS, products, blocks);
    return square;
}

/* The true value is 0. `pooled`: a previous round had other replicas with the same variances. */
static coverage cover(size_t count, value_function draw, bool pooled) {
    coverage c = {0};
    for (size_t candidate = 0; candidate < TRIALS; ++candidate) {
        aur_deviations sum = {.overlap = 1.0}, ignored = {.overlap = 1.0};
        aur_block_spread blocks[BLOCKS], before[BLOCKS];
        const double square = add_values(count, draw, candidate, 0, &sum, blocks);
        aur_deviations_set_blocks(&sum, COLUMNS, ROWS, blocks);
        if (pooled) {
            add_values(count, draw, candidate, VALUES, &ignored, before);
            for (size_t b = 0; b < BLOCKS; ++b) {
                blocks[b].variance = 0.5 * (blocks[b].variance + before[b].variance);
                blocks[b].spread = 0.5 * (blocks[b].spread + before[b].spread);
            }
            aur_deviations_pool(&sum, count, COLUMNS, ROWS, blocks);
        }
        const aur_error_interval interval = aur_replica_interval(&sum, count, VALUES, 0.95);
        const double error = sqrt(square / VALUES);
        c.below += error < interval.low;
        c.above += error > interval.high;
        c.inside += error >= interval.low && error <= interval.high;
        c.mean_degrees += interval.degrees / TRIALS;
        const double spreads[SPREADS] = {sum.blocks, sum.cells};
        for (size_t k = 0; k < SPREADS; ++k) {
            c.spreads[k] += spreads[k] / TRIALS;
            c.squares[k] += spreads[k] * spreads[k] / TRIALS;
        }
    }
    return c;
}

static double same(size_t i, uint64_t candidate, uint64_t index) {
    (void)i;
    return normal(candidate, index);
}

/* A third of the square error in a hundredth of the values. */
static double uneven(size_t i, uint64_t candidate, uint64_t index) {
    return (i % 100 == 0 ? 7.0 : 1.0) * normal(candidate, index);
}

enum { RARE = 32 };

/* One in RARE is large, and the others are lower to compensate; the variance is 1. */
static double rare(size_t i, uint64_t candidate, uint64_t index) {
    (void)i;
    const double large = aur_hash2(candidate, index) < UINT64_MAX / RARE ? (double)RARE : 0.0;
    return (large - 1.0) / sqrt(RARE - 1.0);
}

/* An event with probability `share` per trial has a binomial count: five standard deviations give a false
 * alarm in two million. */
static void check_share(size_t inside, double share) {
    const double expected = share * TRIALS, deviation = sqrt(expected * (1.0 - share));
    assert_in_range(inside, expected - 5.0 * deviation, expected + 5.0 * deviation);
}

/* From four replicas on, the estimates of tr C^2, the number of these values, by blocks and cells are
 * unbiased for any distribution: five standard deviations of the mean give a false alarm in two million. */
static void check_spreads(const coverage *c) {
    for (size_t s = 0; s < SPREADS; ++s) {
        const double deviation = sqrt((c->squares[s] - c->spreads[s] * c->spreads[s]) / TRIALS);
        print_message("  tr C^2 %.1f +- %.1f\n", c->spreads[s], deviation);
        assert_near(c->spreads[s], VALUES, 5.0 * deviation);
    }
}

/* The shares are those of this test with 20,000 trials, known to .0017: nearly the target .95. With
 * three replicas, spreads take values to be normal: rare values make the interval too wide. */
static void test_holds_what_it_says(void **state) {
    (void)state;
    static const struct {
        size_t count;
        double even, uneven, rare;
    } rows[] = {{3, 0.9654, 0.9362, 0.9997}, {4, 0.9652, 0.9344, 0.9819}, {8, 0.9539, 0.954, 0.9694}};
    for (size_t k = 0; k < sizeof rows / sizeof rows[0]; ++k) {
        const size_t count = rows[k].count;
        const coverage even = cover(count, same, false), some = cover(count, uneven, false),
                       few = cover(count, rare, false);
        print_message("%zu replicas: even %zu inside, %zu below, %zu above (%.0f degrees); uneven %zu, %zu, "
                      "%zu (%.0f); rare %zu, %zu, %zu (%.0f)\n",
                      count, even.inside, even.below, even.above, even.mean_degrees, some.inside, some.below,
                      some.above, some.mean_degrees, few.inside, few.below, few.above, few.mean_degrees);
        check_share(even.inside, rows[k].even);
        check_share(some.inside, rows[k].uneven);
        check_share(few.inside, rows[k].rare);
        if (count > 3)
            check_spreads(&few);
    }
}

/* Nine tenths of the square error in one value. */
static double single(size_t i, uint64_t candidate, uint64_t index) {
    return (i == 100 ? sqrt(9.0 * (VALUES - 1)) : 1.0) * normal(candidate, index);
}

/* If one value has all the error, its spread is uncertain, and the interval a little too narrow without the
 * round before. The shares are of 20,000 trials. */
static void test_of_one_value(void **state) {
    (void)state;
    const coverage now = cover(4, single, false), all = cover(4, single, true);
    const coverage even = cover(4, same, true);
    print_message("one value: %zu inside, %zu above; with the round before %zu, %zu; even %zu\n", now.inside,
                  now.above, all.inside, all.above, even.inside);
    check_share(now.inside, 0.8884);
    check_share(all.inside, 0.9457);
    check_share(even.inside, 0.9627);
}

/* Values that a display clips at 1: the error of their mean falls less than with their number. The power of
 * the number that one and three replicas lead to halves the jackknife's error at least; under a linear
 * measure they lead to the same. */
static void test_of_clipped_values(void **state) {
    (void)state;
    enum { COUNT = 4 };
    aur_deviations clipped = {.overlap = 1.0}, linear = {.overlap = 1.0};
    double square = 0.0;
    const double all = 20.0 * VALUES;
    for (uint64_t i = 0; i < 20 * VALUES; ++i) {
        double x[COUNT], single[COUNT], others[COUNT], mean = 0.0, sum = 0.0;
        for (size_t r = 0; r < COUNT; ++r)
            mean += (x[r] = 0.18 * exp(2.0 * normal(11, i * COUNT + r) - 2.0)) / COUNT;
        for (size_t r = 0; r < COUNT; ++r) {
            single[r] = fmin(x[r], 1.0);
            others[r] = (COUNT - 1.0) * fmin((COUNT * mean - x[r]) / (COUNT - 1.0), 1.0);
        }
        square += pow(fmin(mean, 1.0) - 0.18, 2.0) / all;
        deviations_of(COUNT, single);
        deviations_of(COUNT, others);
        for (size_t r = 0; r < COUNT; ++r) {
            clipped.trace += single[r] * single[r];
            clipped.others += others[r] * others[r];
            sum += x[r] * x[r];
        }
        linear.trace = linear.others += sum - COUNT * mean * mean;
    }
    const double jackknife = clipped.others / (COUNT * (COUNT - 1.0) * all);
    const double power = pow(aur_replica_interval(&clipped, COUNT, (size_t)all, 0.95).estimate, 2.0);
    print_message("clipped: mean square %.4f, estimated %.4f, jackknife %.4f\n", square, power, jackknife);
    assert_true(fabs(power - square) < 0.5 * fabs(jackknife - square));
    assert_relative(pow(aur_replica_interval(&linear, COUNT, (size_t)all, 0.95).estimate, 2.0),
                    linear.trace / (COUNT * (COUNT - 1.0) * all), 1e-12);
}

/* White noise through a filter of weights 1/2, 1, 1/2 along each axis: covariances 3/2, 1, 1/4 with the
 * pixels at distances 0, 1, 2. */
enum { SIDE = 32, CELL = 4 };

static void filter_noise(uint64_t seed, double values[SIDE * SIDE]) {
    enum { NOISE = SIDE + 2 };
    static double noise[NOISE * NOISE];
    for (size_t i = 0; i < NOISE * NOISE; ++i)
        noise[i] = normal(seed, i);
    for (size_t i = 0; i < SIDE * SIDE; ++i) {
        values[i] = 0.0;
        for (size_t k = 0; k < 9; ++k) {
            const double weight = (k / 3 == 1 ? 1.0 : 0.5) * (k % 3 == 1 ? 1.0 : 0.5);
            values[i] += weight * noise[(i / SIDE + k / 3) * NOISE + i % SIDE + k % 3];
        }
    }
}

static size_t held_in_filtered_noise(double overlap) {
    enum { COUNT = 4 };
    static double values[COUNT][SIDE * SIDE];
    size_t held = 0;
    for (size_t trial = 0; trial < TRIALS; ++trial) {
        aur_deviations sum = {.overlap = overlap};
        double square = 0.0;
        for (size_t r = 0; r < COUNT; ++r)
            filter_noise(trial * COUNT + r, values[r]);
        double products[SIDE * SIDE / (CELL * CELL)][AUR_GRAM_ENTRIES(COUNT)] = {{0.0}};
        aur_block_spread blocks[SIDE * SIDE / (CELL * CELL)];
        for (size_t block = 0; block < SIDE * SIDE / (CELL * CELL); ++block) {
            aur_cell cell = {.count = COUNT};
            for (size_t k = 0; k < CELL * CELL; ++k) {
                const size_t column = k / AUR_CELL_PIXELS % (CELL / 2), row = k / (2 * CELL);
                const size_t x = block * CELL % SIDE + 2 * column + k % 2;
                const size_t y = block * CELL / SIDE * CELL + 2 * row + k / 2 % 2;
                double d[COUNT];
                for (size_t r = 0; r < COUNT; ++r)
                    d[r] = values[r][y * SIDE + x];
                const double mean = deviations_of(COUNT, d);
                square += mean * mean / (SIDE * SIDE);
                add_pixel(COUNT, d, products[block], &sum, &cell);
                end_cell(&sum, &cell);
            }
        }
        aur_blocks_measure(COUNT, SIDE / CELL, SIDE / CELL, products[0], blocks);
        aur_deviations_set_blocks(&sum, SIDE / CELL, SIDE / CELL, blocks);
        const aur_error_interval interval = aur_replica_interval(&sum, COUNT, SIDE * SIDE, 0.95);
        held += sqrt(square) >= interval.low && sqrt(square) <= interval.high;
    }
    return held;
}

/* With the overlap of the filter intervals of 95 % hold in 93 to 97 %, and five standard deviations of 2,000
 * trials more on either side. */
static void test_holds_where_pixels_share_samples(void **state) {
    (void)state;
    const double along = 1.0 + 2.0 * (1.0 + 0.25 * 0.25) / (1.5 * 1.5);
    const size_t held = held_in_filtered_noise(along * along);
    print_message("filtered noise: %zu of %d\n", held, (int)TRIALS);
    assert_in_range(held, 0.93 * TRIALS - 57, 0.97 * TRIALS + 38);
}

/* Two blocks side by side: with one source of noise they count like one block; independent ones with equal
 * sums of squares like two, and a little more by chance. */
static void test_counts_what_blocks_have_in_common(void **state) {
    (void)state;
    enum { COUNT = AUR_REPLICAS_MAX, VALUES_OF_BLOCK = 16, MANY = 400 };
    double together = 0.0, apart = 0.0;
    for (uint64_t trial = 0; trial < MANY; ++trial) {
        double products[2][2][AUR_GRAM_ENTRIES(COUNT)] = {{{0.0}}}; /* [independent][block] */
        aur_deviations sums[2] = {{.overlap = 1.0}, {.overlap = 1.0}};
        for (size_t i = 0; i < 2 * VALUES_OF_BLOCK; ++i)
            for (size_t independent = 0; independent < 2; ++independent) {
                double d[COUNT];
                const size_t value = independent == 1 ? i : i % VALUES_OF_BLOCK;
                for (size_t r = 0; r < COUNT; ++r)
                    d[r] = normal(trial, value * COUNT + r);
                deviations_of(COUNT, d);
                for (size_t r = 0; r < COUNT; ++r)
                    for (size_t s = 0; s <= r; ++s)
                        products[independent][i / VALUES_OF_BLOCK][AUR_GRAM_ENTRIES(r) + s] += d[r] * d[s];
            }
        for (size_t independent = 0; independent < 2; ++independent) {
            aur_block_spread blocks[2];
            aur_blocks_measure(COUNT, 2, 1, products[independent][0], blocks);
            aur_deviations_set_blocks(&sums[independent], 2, 1, blocks);
        }
        together += sums[0].square_blocks / (sums[0].blocks * sums[0].blocks) / MANY;
        apart += sums[1].square_blocks / (sums[1].blocks * sums[1].blocks) / MANY;
    }
    print_message("squares over the square of the sum: together %.3f, apart %.3f\n", together, apart);
    assert_relative(together, 1.0, 1e-12);
    assert_true(apart > 0.5 && apart < 0.6);
}

/* Of blocks or cells. */
static void test_takes_the_larger_spread(void **state) {
    (void)state;
    const aur_deviations blocks = {.trace = 300.0, .others = 300.0, .overlap = 4.0, .blocks = 40.0};
    aur_deviations larger = blocks, cells = blocks, less = blocks;
    larger.blocks = 160.0;
    cells.cells = 40.0;
    less.cells = 9.0;
    const aur_error_interval narrow = aur_replica_interval(&blocks, 4, VALUES, 0.95),
                             wide = aur_replica_interval(&larger, 4, VALUES, 0.95),
                             of_cells = aur_replica_interval(&cells, 4, VALUES, 0.95),
                             same = aur_replica_interval(&less, 4, VALUES, 0.95);
    assert_memory_equal(&of_cells, &wide, sizeof wide);
    assert_true(wide.degrees < narrow.degrees && wide.low < narrow.low && wide.high > narrow.high);
    assert_memory_equal(&same, &narrow, sizeof same);
}

/* The sums over fours of replicas against all of them one by one. */
static void test_fours(void **state) {
    (void)state;
    enum { COUNT = 6, LENGTH = 5 };
    double x[COUNT][LENGTH], mean[LENGTH] = {0.0};
    double products[AUR_GRAM_ENTRIES(COUNT)] = {0.0};
    for (size_t i = 0; i < LENGTH; ++i)
        for (size_t r = 0; r < COUNT; ++r) {
            x[r][i] = normal(7, i * COUNT + r);
            mean[i] += x[r][i] / COUNT;
        }
    for (size_t r = 0; r < COUNT; ++r)
        for (size_t s = 0; s <= r; ++s)
            for (size_t i = 0; i < LENGTH; ++i)
                products[AUR_GRAM_ENTRIES(r) + s] += (x[r][i] - mean[i]) * (x[s][i] - mean[i]);
    aur_block_spread block;
    aur_blocks_measure(COUNT, 1, 1, products, &block);
    double squares = 0.0;
    size_t fours = 0;
    for (size_t code = 0; code < COUNT * COUNT * COUNT * COUNT; ++code) {
        const size_t a = code % COUNT, b = code / COUNT % COUNT, c = code / (COUNT * COUNT) % COUNT,
                     d = code / (COUNT * COUNT * COUNT);
        if (a == b || a == c || a == d || b == c || b == d || c == d)
            continue;
        double product = 0.0;
        for (size_t i = 0; i < LENGTH; ++i)
            product += (x[a][i] - x[b][i]) * (x[c][i] - x[d][i]);
        squares += 0.25 * product * product;
        ++fours;
    }
    assert_near(block.spread, squares / (double)fours, 1e-12 * block.spread);
}

/* The sum over a cell's pairs of pixels against all pairs one by one. */
static void test_pairs_of_a_cell(void **state) {
    (void)state;
    enum { COUNT = 4 };
    aur_deviations sum = {.overlap = 1.0};
    aur_cell cell = {.count = COUNT};
    double d[AUR_CELL_PIXELS][3][AUR_REPLICAS_MAX], expected = 0.0;
    for (size_t p = 0; p < AUR_CELL_PIXELS; ++p) {
        double products[AUR_GRAM_ENTRIES(COUNT)] = {0.0};
        aur_block_spread pixel;
        for (size_t c = 0; c < 3; ++c) {
            for (size_t r = 0; r < COUNT; ++r)
                d[p][c][r] = normal(5, (p * 3 + c) * COUNT + r);
            deviations_of(COUNT, d[p][c]);
            for (size_t r = 0; r < COUNT; ++r)
                for (size_t s = 0; s <= r; ++s)
                    products[AUR_GRAM_ENTRIES(r) + s] += d[p][c][r] * d[p][c][s];
        }
        aur_deviations_add_pixel(&sum, products, d[p], 0.0, &cell);
        aur_blocks_measure(COUNT, 1, 1, products, &pixel); /* compared with all sets of four in test_fours */
        expected += pixel.spread / AUR_CELL_PIXELS;
    }
    aur_deviations_add_cell(&sum, &cell);
    for (size_t code = 0; code < AUR_CELL_PIXELS * AUR_CELL_PIXELS * 9; ++code) {
        const size_t p = code % AUR_CELL_PIXELS, q = code / AUR_CELL_PIXELS % AUR_CELL_PIXELS;
        const size_t a = code / (AUR_CELL_PIXELS * AUR_CELL_PIXELS) % 3,
                     b = code / (AUR_CELL_PIXELS * AUR_CELL_PIXELS) / 3;
        double first = 0.0, second = 0.0;
        for (size_t r = 0; r < COUNT; ++r) {
            first += d[p][a][r] * d[p][b][r] / (COUNT - 1.0);
            second += d[q][a][r] * d[q][b][r] / (COUNT - 1.0);
        }
        expected += p != q ? first * second / AUR_CELL_PIXELS : 0.0;
    }
    assert_relative(sum.cells, expected, 1e-12);
}

/* The estimate does not depend on where borders of blocks are: light in four pixels about a corner gives the
 * same whether it is in one block, in two or in four. */
static void test_borders_cut_nothing(void **state) {
    (void)state;
    enum { COUNT = 5, WIDTH = 3, PARTS = 4, ENTRIES = AUR_GRAM_ENTRIES(COUNT) };
    static const size_t places[][PARTS] = {
        {4, 4, 4, 4}, {3, 3, 4, 4}, {1, 4, 1, 4}, {4, 5, 7, 8}, {1, 3, 3, 1}};
    double sums[sizeof places / sizeof places[0]];
    for (size_t k = 0; k < sizeof places / sizeof places[0]; ++k) {
        double products[WIDTH * WIDTH][ENTRIES] = {{0.0}};
        aur_block_spread blocks[WIDTH * WIDTH];
        aur_deviations sum = {0};
        for (size_t p = 0; p < PARTS; ++p) {
            double d[COUNT];
            for (size_t r = 0; r < COUNT; ++r)
                d[r] = normal(9, r);
            deviations_of(COUNT, d);
            for (size_t r = 0; r < COUNT; ++r)
                for (size_t s = 0; s <= r; ++s)
                    products[places[k][p]][AUR_GRAM_ENTRIES(r) + s] += d[r] * d[s];
        }
        aur_blocks_measure(COUNT, WIDTH, WIDTH, products[0], blocks);
        aur_deviations_set_blocks(&sum, WIDTH, WIDTH, blocks);
        sums[k] = sum.blocks;
        assert_relative(sums[k], sums[0], 1e-12);
        assert_relative(sum.square_blocks, sums[0] * sums[0], 1e-12);
    }
    assert_true(sums[0] > 0.0);
}

/* Replicas that agree have no error. */
static void test_of_nothing(void **state) {
    (void)state;
    const aur_deviations none = {0};
    const aur_error_interval interval = aur_replica_interval(&none, 4, 100, 0.95);
    assert_true(interval.estimate == 0.0 && interval.low == 0.0 && interval.high == 0.0);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_holds_what_it_says),
                                       cmocka_unit_test(test_of_one_value),
                                       cmocka_unit_test(test_of_clipped_values),
                                       cmocka_unit_test(test_holds_where_pixels_share_samples),
                                       cmocka_unit_test(test_counts_what_blocks_have_in_common),
                                       cmocka_unit_test(test_takes_the_larger_spread),
                                       cmocka_unit_test(test_fours),
                                       cmocka_unit_test(test_pairs_of_a_cell),
                                       cmocka_unit_test(test_borders_cut_nothing),
                                       cmocka_unit_test(test_of_nothing)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
