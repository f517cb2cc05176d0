/* The interval of the error of a mean of replicas against its own promise: over many sets of random pictures
 * with known covariance it holds the true error as often as it says. */
#include "check.h"

#include <math.h>

#include "ask/interval.h"
#include "core/random.h"

enum { VALUES = 960, BLOCK_VALUES = 12, TRIALS = 2000 };

/* Box and Muller (1958). */
static double normal(uint64_t seed, uint64_t index) {
    const double u = (double)(aur_hash2(seed, 2 * index) >> 11) * 0x1p-53;
    const double v = (double)(aur_hash2(seed, 2 * index + 1) >> 11) * 0x1p-53;
    return sqrt(-2.0 * log(1.0 - u)) * cos(6.283185307179586 * v);
}

typedef struct coverage {
    size_t inside, below, above;
    double mean_degrees;
} coverage;

/* `deviation`: the standard deviation of value i. The truth is 0. */
static coverage cover(size_t count, double (*deviation)(size_t)) {
    coverage c = {0};
    for (size_t trial = 0; trial < TRIALS; ++trial) {
        aur_deviations sum = {0};
        double square = 0.0;
        for (size_t block = 0; block < VALUES / BLOCK_VALUES; ++block) {
            aur_gram gram = {.count = count};
            for (size_t i = block * BLOCK_VALUES; i < (block + 1) * BLOCK_VALUES; ++i) {
                double d[AUR_REPLICAS_MAX], mean = 0.0;
                for (size_t r = 0; r < count; ++r) {
                    d[r] = deviation(i) * normal(trial, i * count + r);
                    mean += d[r] / (double)count;
                }
                square += mean * mean;
                for (size_t r = 0; r < count; ++r)
                    for (size_t s = 0; s < count; ++s)
                        gram.products[r][s] += (d[r] - mean) * (d[s] - mean);
            }
            aur_deviations_add(&sum, &gram);
        }
        const aur_error_interval interval = aur_replica_interval(&sum, count, VALUES, 0.95);
        const double error = sqrt(square / VALUES);
        c.below += error < interval.low;
        c.above += error > interval.high;
        c.inside += error >= interval.low && error <= interval.high;
        c.mean_degrees += interval.degrees / TRIALS;
    }
    return c;
}

static double same(size_t i) {
    (void)i;
    return 1.0;
}

/* A third of the square error in a hundredth of the values. */
static double uneven(size_t i) {
    return i % 100 == 0 ? 7.0 : 1.0;
}

/* What holds in `share` of all trials holds in a binomial count of these: five of its standard deviations are
 * a false alarm in two million. */
static void check_share(size_t inside, double share) {
    const double expected = share * TRIALS, deviation = sqrt(expected * (1.0 - share));
    assert_in_range(inside, expected - 5.0 * deviation, expected + 5.0 * deviation);
}

/* The shares are those of this test with 100,000 trials, known to .0007: nearly the .95 that is asked. Of
 * four replicas of uneven values there are few degrees, and the interval holds a little less. */
static void test_holds_what_it_says(void **state) {
    (void)state;
    static const struct {
        size_t count;
        double even, uneven;
    } rows[] = {{4, 0.9545, 0.9439}, {8, 0.9521, 0.9522}};
    for (size_t k = 0; k < 2; ++k) {
        const size_t count = rows[k].count;
        const coverage even = cover(count, same), some = cover(count, uneven);
        print_message("%zu replicas: even %zu inside, %zu below, %zu above (%.0f degrees); uneven %zu, %zu, "
                      "%zu (%.0f)\n",
                      count, even.inside, even.below, even.above, even.mean_degrees, some.inside, some.below,
                      some.above, some.mean_degrees);
        check_share(even.inside, rows[k].even);
        check_share(some.inside, rows[k].uneven);
    }
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
                                       cmocka_unit_test(test_of_nothing)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
