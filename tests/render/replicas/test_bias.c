/* The bias of an integrator, from replicas with much larger noise: coverage of the interval for synthetic
 * films of known bias. */
#include "render/prepared.h"

#include <math.h>

#include "points/base/random.h"
#include "render/film/film.h"
#include "render/replicas/bias.h"

enum { SIDE = 32, REPLICAS = 4, RUNS = 300 };

static double uniform(uint64_t a, uint64_t b) {
    return (double)aur_unit_float((uint32_t)aur_hash2(a, b));
}

/* Nearly normal, or with rare large values, which paths have; of mean 0 and variance 1. */
static double noise(bool rare, uint64_t a, uint64_t b) {
    if (rare)
        return (uniform(a, b) < 0.01 ? 1.0 : 0.0) / sqrt(0.01 * 0.99) - sqrt(0.01 / 0.99);
    double sum = -6.0;
    for (uint64_t k = 0; k < 12; ++k)
        sum += uniform(a, 12 * b + k);
    return sum;
}

typedef struct bias_case {
    double bias, deviation;
    bool rare;
    size_t blocks; /* with samples */
    double maps;   /* deviation of a value that all pixels of a replica share, as a photon map's error is */
} bias_case;

/* What a replica's map adds to all of its pixels. */
static double of_map(const bias_case *of, uint64_t run, size_t r) {
    return of->maps * noise(false, aur_hash2(run, r), 1 << 20);
}

static void fill(const bias_case *of, uint64_t run, const aur_blocks *blocks, const aur_replicas *replicas) {
    for (size_t r = 0; r < REPLICAS; ++r) {
        aur_film *const film = (aur_film *)aur_render_film(replicas->renders[r]);
        for (size_t i = 0; i < SIDE * SIDE; ++i)
            film->given[i] = film->counts[i] = 0;
        for (size_t b = 0; b < of->blocks; ++b) {
            size_t pixels[AUR_BLOCK_PIXELS];
            const size_t count = aur_blocks_pixels(blocks, blocks->order[b], pixels);
            for (size_t p = 0; p < count; ++p) {
                film->given[pixels[p]] = film->counts[pixels[p]] = 1;
                for (size_t c = 0; c < 3; ++c)
                    film->sums[pixels[p] * film->layout.channel_count + c] =
                        of->bias + of_map(of, run, r) +
                        of->deviation * noise(of->rare, aur_hash2(run, r), 3 * pixels[p] + c);
            }
        }
    }
}

/* What the spread of the replicas does not have of the square of the mean error: (b + mean m)^2 less the
 * square of the standard error of the mean of m. */
static double expected_of(const bias_case *of, uint64_t run) {
    double mean = 0.0, squares = 0.0;
    for (size_t r = 0; r < REPLICAS; ++r) {
        const double error = of->bias + of_map(of, run, r);
        mean += error / REPLICAS;
        squares += error * error;
    }
    return mean * mean - (squares - REPLICAS * mean * mean) / (REPLICAS * (REPLICAS - 1));
}

/* An interval of 95 % misses 15 of 300 runs; five standard deviations (of 3.8) more are allowed. With noise
 * alone it may not exclude 0, and is wider than it needs to be. */
static void test_interval(void **state) {
    (void)state;
    static const bias_case cases[] = {
        {0.0, 1.0, false, 64, 0.0}, {0.05, 1.0, false, 54, 0.0}, {0.5, 1.0, false, 54, 0.0},
        {0.1, 0.0, false, 20, 0.0}, {0.0, 1.0, true, 64, 0.0},   {0.05, 1.0, true, 54, 0.0},
        {0.5, 1.0, true, 54, 0.0},  {0.0, 0.1, false, 54, 0.1},  {0.2, 0.1, false, 54, 0.1}};
    const prepared box = prepare_file(CORNELL_BOX);
    aur_render_options options = image_of_size(SIDE, SIDE);
    options.filter = "box";
    aur_replicas replicas;
    aur_blocks blocks;
    assert_int_equal(aur_replicas_create(box.renderer, &options, "path", REPLICAS, &replicas, NULL), AUR_OK);
    assert_int_equal(aur_blocks_create(SIDE, SIDE, &blocks, NULL), AUR_OK);
    assert_int_equal(blocks.count, 64);
    static aur_error_weight weights[SIDE * SIDE];
    static double values[SIDE * SIDE][3];
    for (size_t i = 0; i < SIDE * SIDE; ++i)
        for (size_t c = 0; c < 3; ++c)
            weights[i].channel[c] = values[i][c] = 1.0;
    const aur_weighing weighing = {AUR_ERROR_MEASURE_MEAN, weights};
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; ++k) {
        size_t missed = 0;
        double mean = 0.0, high = 0.0;
        for (uint64_t run = 0; run < RUNS; ++run) {
            fill(&cases[k], aur_hash2(run, k), &blocks, &replicas);
            const aur_bias bias =
                aur_replicas_bias(&replicas, NULL, weighing, (const double(*)[3])values, 0.95);
            const double expected = expected_of(&cases[k], aur_hash2(run, k));
            missed += bias.low > fmax(expected, 0.0) * (1.0 + 1e-6) || bias.high < expected * (1.0 - 1e-6);
            mean += bias.estimate / RUNS;
            high += bias.high / RUNS;
        }
        print_message("bias %g, noise %g: %zu of %d missed, mean square %g\n", cases[k].bias,
                      cases[k].deviation, missed, (int)RUNS, mean);
        assert_true(missed <= 34);
        /* The products' standard deviation is at most about .01 a run here. */
        assert_true(fabs(mean - cases[k].bias * cases[k].bias) < 0.01);
        /* Maps widen the interval by their own error, not by what four values leave to its expectation. */
        if (cases[k].maps > 0.0)
            assert_true(high < cases[k].bias * cases[k].bias + cases[k].maps * cases[k].maps / 2);
    }
    aur_blocks_release(&blocks);
    aur_replicas_release(&replicas);
    release(box);
}

/* Widths in squares; nothing is taken from a bias that is certain. */
static void test_with_noise(void **state) {
    (void)state;
    const aur_bias measured = {.estimate = 9.0, .high = 25.0, .half = 16.0}, certain = {.high = 25.0};
    assert_true(aur_bias_with_noise(&measured, 2.0, 4.0) == sqrt(4.0 + 9.0 + 20.0));
    assert_true(aur_bias_with_noise(&certain, 2.0, 4.0) == sqrt(16.0 + 25.0));
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_interval), cmocka_unit_test(test_with_noise)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
