/* Pixels that have an error of their own, of trials whose variances are known. */
#include "check.h"

#include <math.h>
#include <string.h>

#include "render/adaptive/comparison.h"

enum { REPLICAS = 4, PIXELS = 400, FEW = PIXELS / 100 };

typedef struct known_candidate {
    aur_candidate candidate;
    aur_pixel_spread pixels[PIXELS];
    uint32_t targets[REPLICAS * PIXELS];
    double scratch[2 * PIXELS];
} known_candidate;

/* Of variances between 1 and 2, with so many samples in each pixel. */
static void begin(known_candidate *known, uint32_t samples) {
    *known = (known_candidate){.candidate = {.replicas = {.count = REPLICAS, .pixel_count = PIXELS}}};
    for (size_t i = 0; i < PIXELS; ++i)
        known->pixels[i].variance = 1.0 + (double)(i * 7 % PIXELS) / PIXELS;
    for (size_t i = 0; i < REPLICAS * PIXELS; ++i)
        known->targets[i] = samples;
    known->candidate.pixels = known->pixels;
    known->candidate.targets = known->targets;
    known->candidate.scratch = known->scratch;
}

static double sum_of(const known_candidate *known) {
    double sum = 0.0;
    for (size_t i = 0; i < PIXELS; ++i)
        sum += known->pixels[i].variance;
    return sum;
}

/* Three pixels stand out in both: one sample of path tracing varies most there, though it has so many that
 * its pixel does not. What is left is the others' sum without the fourth that belongs to the hundredth, and
 * the rays are those of samples in proportion to deviations. */
static void pixels_of_both_are_left_out(void **state) {
    (void)state;
    static const size_t at[] = {17, 200, 399};
    static known_candidate path, gather;
    begin(&path, 1);
    begin(&gather, 1);
    size_t fourth = 0; /* the largest of all others */
    for (size_t i = 0; i < PIXELS; ++i)
        if (i != 17 && i != 200 && i != 399 && path.pixels[i].variance > path.pixels[fourth].variance)
            fourth = i;
    const double others = sum_of(&gather) - gather.pixels[17].variance - gather.pixels[200].variance -
                          gather.pixels[399].variance;
    for (size_t i = 0; i < 3; ++i) {
        gather.pixels[at[i]].variance = 1e4;
        for (size_t r = 0; r < REPLICAS; ++r)
            path.targets[r * PIXELS + at[i]] = 100; /* one sample's variance is 100 and more */
    }
    const aur_outliers found = aur_outliers_find(&path.candidate, &gather.candidate);
    /* The fifth value is the limit: those above it are the three and the fourth. */
    const double rest = others - gather.pixels[fourth].variance;
    assert_near(found.rest, rest / (others + 3e4), 1e-12);
    const double mean = rest / (PIXELS - FEW);
    const double roots = 3.0 * 100.0 + sqrt(gather.pixels[fourth].variance);
    assert_near(found.price, 1.0 + (roots / sqrt(mean) - FEW) / PIXELS, 1e-12);
}

/* What is rare lies anywhere: pixels of the one are not those of the other. */
static void probability_is_no_outlier(void **state) {
    (void)state;
    static known_candidate path, gather;
    begin(&path, 1);
    begin(&gather, 1);
    path.pixels[17].variance = 1e4;
    gather.pixels[200].variance = 1e4;
    const aur_outliers found = aur_outliers_find(&path.candidate, &gather.candidate);
    assert_true(found.rest == 1.0 && found.price == 1.0);
}

/* Pixels that have less than three quarters of the square are no matter. */
static void small_parts_are_left(void **state) {
    (void)state;
    static known_candidate path, gather;
    begin(&path, 1);
    begin(&gather, 1);
    const double others = sum_of(&gather) - gather.pixels[17].variance;
    path.pixels[17].variance = 1e4;
    gather.pixels[17].variance = 2.9 * others;
    assert_true(aur_outliers_find(&path.candidate, &gather.candidate).rest == 1.0);
    gather.pixels[17].variance = 3.1 * others;
    assert_true(aur_outliers_find(&path.candidate, &gather.candidate).rest < 0.25);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(pixels_of_both_are_left_out),
                                       cmocka_unit_test(probability_is_no_outlier),
                                       cmocka_unit_test(small_parts_are_left)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
