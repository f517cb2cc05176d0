/* Coverage of the interval of the error of a mean of replicas: over many sets of random images with known
 * covariance it covers the true error at the stated rate. */
#include "check.h"

#include <math.h>
#include <stdbool.h>

#include "points/base/random.h"
#include "render/image/error_interval.h"

enum { VALUES = 960, BLOCK_VALUES = 12, TRIALS = 2000 };

/* Box and Muller (1958). */
static double normal(uint64_t seed, uint64_t index) {
    const double u = (double)(aur_hash2(seed, 2 * index) >> 11) * 0x1p-53;
    const double v = (double)(aur_hash2(seed, 2 * index + 1) >> 11) * 0x1p-53;
    return sqrt(-2.0 * log(1.0 - u)) * cos(6.283185307179586 * v);
}

typedef struct coverage {
    size_t inside, below, above;
    double mean_degrees, mean_spread, square_spreads; /* means over the trials */
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

static aur_pixel_spread spread_of(size_t count, const double *d) {
    aur_gram gram = {.count = count};
    double squares = 0.0;
    for (size_t r = 0; r < count; ++r) {
        squares += d[r] * d[r];
        for (size_t s = 0; s < count; ++s)
            gram.products[r][s] = d[r] * d[s];
    }
    return (aur_pixel_spread){squares / (double)(count - 1), aur_gram_spread(&gram)};
}

/* Of the mean of the two variances. */
static aur_pixel_spread pool(aur_pixel_spread a, aur_pixel_spread b) {
    return (aur_pixel_spread){0.5 * (a.variance + b.variance),
                              0.25 * (a.spread + 2.0 * a.variance * b.variance + b.spread)};
}

/* Value i from normal number `index` of a trial. */
typedef double (*value_function)(size_t i, uint64_t candidate, uint64_t index);

/* The true value is 0. `pooled`: a previous round had other replicas with the same variances. */
static coverage cover(size_t count, value_function draw, bool pooled) {
    coverage c = {0};
    for (size_t candidate = 0; candidate < TRIALS; ++candidate) {
        aur_deviations sum = {0};
        double square = 0.0;
        aur_pixel_spread pixels[VALUES];
        for (size_t block = 0; block < VALUES / BLOCK_VALUES; ++block) {
            aur_gram gram = {.count = count};
            for (size_t i = block * BLOCK_VALUES; i < (block + 1) * BLOCK_VALUES; ++i) {
                double d[AUR_REPLICAS_MAX], before[AUR_REPLICAS_MAX];
                for (size_t r = 0; r < count; ++r) {
                    d[r] = draw(i, candidate, i * count + r);
                    before[r] = pooled ? draw(i, candidate, (VALUES + i) * count + r) : 0.0;
                }
                const double mean = deviations_of(count, d);
                deviations_of(count, before);
                square += mean * mean;
                pixels[i] = pool(spread_of(count, d), spread_of(count, before));
                for (size_t r = 0; r < count; ++r)
                    for (size_t s = 0; s < count; ++s)
                        gram.products[r][s] += d[r] * d[s];
            }
            aur_deviations_add(&sum, &gram);
        }
        if (pooled)
            aur_deviations_pool(&sum, count, VALUES, pixels);
        const aur_error_interval interval = aur_replica_interval(&sum, count, VALUES, 0.95);
        const double error = sqrt(square / VALUES);
        c.below += error < interval.low;
        c.above += error > interval.high;
        c.inside += error >= interval.low && error <= interval.high;
        c.mean_degrees += interval.degrees / TRIALS;
        c.mean_spread += sum.spread / TRIALS;
        c.square_spreads += sum.spread * sum.spread / TRIALS;
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

/* The shares are those of this test with 20,000 trials, known to .0017: nearly the target .95. For three or
 * four replicas of uneven values there are few degrees of freedom, and the coverage is slightly lower; three
 * do not show that values are rare, and the interval is far too wide. */
static void test_holds_what_it_says(void **state) {
    (void)state;
    static const struct {
        size_t count;
        double even, uneven, rare;
    } rows[] = {{3, 0.9571, 0.9370, 0.9999}, {4, 0.9575, 0.9375, 0.9888}, {8, 0.9504, 0.9548, 0.9692}};
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
    }
}

/* Nine tenths of the square error in one value. */
static double single(size_t i, uint64_t candidate, uint64_t index) {
    return (i == 100 ? sqrt(9.0 * (VALUES - 1)) : 1.0) * normal(candidate, index);
}

/* If one value has all the error, the current replicas give too little information on its spread, and a
 * previous round helps. The shares are those of 20,000 trials. */
static void test_of_one_value(void **state) {
    (void)state;
    const coverage now = cover(4, single, false), all = cover(4, single, true);
    const coverage even = cover(4, same, true);
    print_message("one value: %zu inside, %zu above; with the round before %zu, %zu; even %zu\n", now.inside,
                  now.above, all.inside, all.above, even.inside);
    check_share(now.inside, 0.888);
    check_share(all.inside, 0.960);
    check_share(even.inside, 0.957);
}

/* From four replicas on, the estimate of tr C^2, the number of these values, is unbiased for any
 * distribution: five standard deviations of the mean give a false alarm in two million. */
static void test_spread_has_no_bias(void **state) {
    (void)state;
    static const size_t counts[] = {4, 5, 8};
    for (size_t k = 0; k < sizeof counts / sizeof counts[0]; ++k) {
        const coverage c = cover(counts[k], rare, false);
        const double deviation = sqrt((c.square_spreads - c.mean_spread * c.mean_spread) / TRIALS);
        print_message("%zu replicas: tr C^2 %.1f +- %.1f\n", counts[k], c.mean_spread, deviation);
        assert_near(c.mean_spread, VALUES, 5.0 * deviation);
    }
}

/* The larger of the two estimates of tr C^2 is taken: fewer degrees of freedom and a wider interval, as if
 * the spread between replicas had been as large. */
static void test_covariances_between_values_count(void **state) {
    (void)state;
    const aur_deviations alone = {.trace = 300.0, .spread = 40.0}, larger = {.trace = 300.0, .spread = 160.0};
    aur_deviations with = alone;
    with.neighbours = 160.0;
    const aur_error_interval narrow = aur_replica_interval(&alone, 4, VALUES, 0.95),
                             wide = aur_replica_interval(&larger, 4, VALUES, 0.95),
                             seen = aur_replica_interval(&with, 4, VALUES, 0.95);
    assert_memory_equal(&seen, &wide, sizeof seen);
    assert_true(seen.degrees < narrow.degrees && seen.low < narrow.low && seen.high > narrow.high);
    with.neighbours = 10.0;
    const aur_error_interval same = aur_replica_interval(&with, 4, VALUES, 0.95);
    assert_memory_equal(&same, &narrow, sizeof same);
}

/* The sums over fours of replicas against all of them one by one. */
static void test_fours(void **state) {
    (void)state;
    enum { COUNT = 6, LENGTH = 5 };
    double x[COUNT][LENGTH], mean[LENGTH] = {0.0};
    aur_gram gram = {.count = COUNT};
    for (size_t i = 0; i < LENGTH; ++i)
        for (size_t r = 0; r < COUNT; ++r) {
            x[r][i] = normal(7, i * COUNT + r);
            mean[i] += x[r][i] / COUNT;
        }
    for (size_t r = 0; r < COUNT; ++r)
        for (size_t s = 0; s < COUNT; ++s)
            for (size_t i = 0; i < LENGTH; ++i)
                gram.products[r][s] += (x[r][i] - mean[i]) * (x[s][i] - mean[i]);
    aur_deviations sum = {0};
    aur_deviations_add(&sum, &gram);
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
    assert_near(sum.spread, squares / (double)fours, 1e-12 * sum.spread);
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
                                       cmocka_unit_test(test_spread_has_no_bias),
                                       cmocka_unit_test(test_of_one_value),

                                       cmocka_unit_test(test_covariances_between_values_count),
                                       cmocka_unit_test(test_fours),
                                       cmocka_unit_test(test_of_nothing)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
