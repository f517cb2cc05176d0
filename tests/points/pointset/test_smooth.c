/* Sets for smooth functions, against brute force and their convergence rates. */
#include "points.h"

#include <math.h>

#include "points/base/vector.h"

static aur_pointset_options options_of(uint64_t count, size_t dimension) {
    return (aur_pointset_options){
        .size = sizeof(aur_pointset_options), .count = count, .dimension = dimension};
}

static uint64_t common_divisor(uint64_t a, uint64_t b) {
    return b == 0 ? a : common_divisor(b, a % b);
}

static double kernel(uint64_t k, uint64_t n) {
    const double x = (double)(k % n) / (double)n;
    return 2.0 * AUR_PI * AUR_PI * (x * x - x + 1.0 / 6.0);
}

/* The squared worst-case error of a lattice and 1. */
static double error_of(uint64_t n, size_t dimension, const uint64_t *vector) {
    double sum = 0.0;
    for (uint64_t k = 0; k < n; ++k) {
        double product = 1.0;
        for (size_t d = 0; d < dimension; ++d)
            product *= 1.0 + kernel(k * vector[d], n) / (double)((d + 1) * (d + 1));
        sum += product / (double)n;
    }
    return sum;
}

static void read_vector(const char *set, uint64_t n, size_t dimension, uint64_t *vector) {
    double *const points = make_points(set, options_of(n, dimension));
    for (size_t d = 0; d < dimension; ++d)
        vector[d] = (uint64_t)(points[dimension + d] * (double)n + 0.5);
    free(points);
}

/* Every component is the best one after those before it, at sizes of both searches. */
static void components_are_the_best(void **state) {
    (void)state;
    enum { DIMENSION = 4 };
    static const uint64_t sizes[] = {4, 8, 60, 64, 97, 256};
    for (size_t s = 0; s < sizeof sizes / sizeof sizes[0]; ++s) {
        const uint64_t n = sizes[s];
        uint64_t vector[DIMENSION];
        read_vector("cbc", n, DIMENSION, vector);
        assert_int_equal(vector[0], 1);
        for (size_t d = 1; d < DIMENSION; ++d) {
            uint64_t other[DIMENSION];
            memcpy(other, vector, sizeof other);
            const double found = error_of(n, d + 1, vector);
            for (other[d] = 1; other[d] < n; ++other[d])
                if (common_divisor(other[d], n) == 1)
                    assert_true(error_of(n, d + 1, other) > found - 1e-12);
        }
    }
}

static void korobov_is_powers_of_one_number(void **state) {
    (void)state;
    enum { DIMENSION = 5, SIZE = 512 };
    uint64_t vector[DIMENSION], given[DIMENSION], built[DIMENSION];
    read_vector("korobov", SIZE, DIMENSION, vector);
    read_vector("korobov:multiplier=11", SIZE, DIMENSION, given);
    read_vector("cbc", SIZE, DIMENSION, built);
    for (size_t d = 1; d < DIMENSION; ++d) {
        assert_int_equal(vector[d], vector[d - 1] * vector[1] % SIZE);
        assert_int_equal(given[d], given[d - 1] * 11 % SIZE);
    }
    assert_true(error_of(SIZE, DIMENSION, vector) < error_of(SIZE, DIMENSION, given));
    assert_true(error_of(SIZE, DIMENSION, vector) - 1.0 < 1.5 * (error_of(SIZE, DIMENSION, built) - 1.0));
}

/* The baker's transform comes after the shift, in pairs and in single coordinates. */
static void baker_folds(void **state) {
    (void)state;
    enum { SIZE = 128 };
    for (size_t dimension = 1; dimension <= 3; ++dimension) {
        aur_pointset_options options = options_of(SIZE, dimension);
        options.scramble = AUR_SCRAMBLE_SHIFT;
        options.seed = 7;
        double *const plain = make_points("cbc", options), *const folded =
                                                               make_points("cbc:baker=true", options);
        for (size_t i = 0; i < SIZE * dimension; ++i)
            assert_near(folded[i], 1.0 - fabs(2.0 * plain[i] - 1.0), 0x1p-52);
        free(plain);
        free(folded);
    }
}

/* Digits of Sobol's coordinates in turn. */
static void digits_are_interlaced(void **state) {
    (void)state;
    enum { SIZE = 256, DIMENSION = 3 };
    for (size_t order = 2; order <= 3; ++order) {
        double *const sobol = make_points("sobol", options_of(SIZE, DIMENSION * order));
        double *const points =
            make_points(order == 2 ? "interlaced" : "interlaced:order=3", options_of(SIZE, DIMENSION));
        for (size_t i = 0; i < SIZE * DIMENSION; ++i) {
            double value = 0.0;
            for (size_t digit = 0; digit < 53; ++digit) {
                const double component = sobol[i * order + digit % order];
                const uint64_t bits = (uint64_t)(component * 0x1p53);
                value += ldexp((double)(bits >> (52 - digit / order) & 1), -(int)digit - 1);
            }
            assert_near(points[i], value, 0.0);
        }
        free(sobol);
        free(points);
    }
    aur_pointset *set = NULL;
    aur_error error;
    const aur_pointset_options many = options_of(SIZE, 10000);
    assert_int_equal(aur_pointset_create("interlaced:order=3", &many, &set, &error), AUR_ERROR_ARGUMENT);
    assert_non_null(strstr(error.message, "at most 7067"));
}

/* The mean square error of x^2 y^3 over scramblings, times N^rate: order 2 falls by N^-5, Sobol's by N^-3
 * (Dick 2011, Owen 1997), but for powers of the logarithm. */
static double mean_square(const char *name, uint64_t size) {
    enum { SEEDS = 24 };
    double sum = 0.0;
    for (uint64_t seed = 0; seed < SEEDS; ++seed) {
        aur_pointset_options options = options_of(size, 2);
        options.scramble = AUR_SCRAMBLE_OWEN;
        options.seed = seed;
        double *const points = make_points(name, options), mean = -1.0 / 12.0;
        for (size_t i = 0; i < size; ++i)
            mean += pow(points[2 * i], 2.0) * pow(points[2 * i + 1], 3.0) / (double)size;
        sum += mean * mean / SEEDS;
        free(points);
    }
    return sum;
}

static void interlaced_nets_have_their_order(void **state) {
    (void)state;
    const double interlaced = mean_square("interlaced", 64) / mean_square("interlaced", 4096);
    const double sobol = mean_square("sobol", 64) / mean_square("sobol", 4096);
    assert_true(log2(interlaced) > 6 * 4.0 && log2(sobol) < 6 * 3.5);
}

/* Far from each other and from the diagonal in 200 dimensions too. */
static void r2_has_many_dimensions(void **state) {
    (void)state;
    enum { SIZE = 4, DIMENSION = 200 };
    double *const points = make_points("r2", options_of(SIZE, DIMENSION));
    long double low = 1.0L, high = 2.0L; /* the root of x^(s+1) = x + 1 */
    for (int step = 0; step < 70; ++step) {
        const long double middle = (low + high) / 2.0L;
        *(powl(middle, DIMENSION + 1) > middle + 1.0L ? &high : &low) = middle;
    }
    for (size_t d = 0; d < DIMENSION; ++d)
        for (size_t i = 0; i < SIZE; ++i)
            assert_near(points[i * DIMENSION + d],
                        (double)fmodl(0.5L + (long double)i * powl(low, -(long double)(d + 1)), 1.0L), 1e-15);
    free(points);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(components_are_the_best),
        cmocka_unit_test(korobov_is_powers_of_one_number),
        cmocka_unit_test(baker_folds),
        cmocka_unit_test(digits_are_interlaced),
        cmocka_unit_test(interlaced_nets_have_their_order),
        cmocka_unit_test(r2_has_many_dimensions),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
