/* Shifts of a pattern that complete each other: together they are the finer pattern. */
#include "check.h"

#include "points/base/random.h"
#include "render/sampling/rule.h"

/* A direction of a hash, and the part of the hemisphere of solid angle that is within 72 degrees of it, by
 * a copy of the rule. */
static double share_of_cap(const aur_gather_rule *rule, size_t copy, uint64_t hash) {
    const double azimuth = 2.0 * AUR_PI * (double)aur_unit_float((uint32_t)hash);
    const double height = (double)aur_unit_float((uint32_t)(hash >> 32));
    const double radius = sqrt(1.0 - height * height);
    const aur_vector axis = {(float)(radius * cos(azimuth)), (float)(radius * sin(azimuth)), (float)height};
    double inside = 0.0;
    for (size_t i = 0; i < rule->count; ++i) {
        aur_vector v;
        aur_gather_rule_direction(rule, &rule->rotations[copy], i, &v);
        inside += aur_vector_dot(v, axis) > 0.3f ? 1.0 : 0.0;
    }
    return inside / (double)rule->count;
}

/* Spherical Fibonacci sets, evenly over the hemisphere. */
static aur_gather_rule must_make(size_t count, bool nested) {
    const aur_gather_rule_options options = {.set = "spherical-fibonacci",
                                             .count = count,
                                             .map = AUR_MAP_LAMBERT,
                                             .scramble = AUR_SCRAMBLE_ROTATE,
                                             .nested = nested,
                                             .rotations = 1};
    aur_gather_rule rule;
    assert_int_equal(aur_gather_rule_create(&options, 0.0, &rule, NULL), AUR_OK);
    return rule;
}

enum { CAPS = 200 };

/* The mean square error of such caps by the copies together that the pixels of one block have: their numbers
 * differ in the highest bits. */
static double square_error(const aur_gather_rule *rule, size_t copies, const double *reference) {
    double sum = 0.0;
    for (uint64_t t = 0; t < CAPS; ++t) {
        double share = 0.0;
        for (size_t k = 0; k < copies; ++k)
            share += share_of_cap(rule, rule->copies / copies * k, aur_hash2(7, t)) / (double)copies;
        sum += (share - reference[t]) * (share - reference[t]) / CAPS;
    }
    return sum;
}

/* The pixels of each 2 x 2, 4 x 4 and 8 x 8 block have together a pattern that is about as good as one
 * spherical Fibonacci set of as many points. The peer's error is measured in the same run; twice its square
 * is allowed, where shifts by chance would have 4^.6 = 2.3 times as much a level (an error of N^-.8). */
static void blocks_make_finer_patterns(void **state) {
    (void)state;
    enum { FINE = 40000 };
    double reference[CAPS];
    aur_gather_rule fine = must_make(FINE, false);
    for (uint64_t t = 0; t < CAPS; ++t)
        reference[t] = share_of_cap(&fine, 0, aur_hash2(7, t));
    aur_gather_rule_release(&fine);
    static const size_t counts[] = {4, 16, 44};
    for (size_t c = 0; c < sizeof counts / sizeof counts[0]; ++c) {
        aur_gather_rule nested = must_make(counts[c], true);
        assert_int_equal(nested.copies, AUR_NESTED_COUNT);
        for (size_t copies = 4; copies <= AUR_NESTED_COUNT; copies *= 4) {
            aur_gather_rule peer = must_make(copies * counts[c], false);
            const double nested_square = square_error(&nested, copies, reference);
            const double square = square_error(&peer, 1, reference);
            if (nested_square > 2.0 * square)
                fail_msg("%zu shifts of %zu directions: error %g, of one set %g", copies, counts[c],
                         sqrt(nested_square), sqrt(square));
            aur_gather_rule_release(&peer);
        }
        aur_gather_rule_release(&nested);
    }
}

/* Heights of all shifts are the middles of equal steps, eight points on each. */
static void heights_lie_in_the_middle_of_steps(void **state) {
    (void)state;
    for (size_t count = 4; count < 60; count += 7) {
        const size_t steps = 8 * count;
        size_t met[8 * 60] = {0};
        for (size_t number = 0; number < AUR_NESTED_COUNT; ++number)
            for (size_t i = 0; i < count; ++i) {
                double point[2] = {0.0, 1.0 - ((double)i + 0.5) / (double)count};
                aur_nested_shift(count, number, point);
                const double step = point[1] * (double)steps;
                assert_true(step > 0.0 && step < (double)steps);
                assert_near(step - floor(step), 0.5, 1e-9);
                ++met[(size_t)step];
            }
        for (size_t i = 0; i < steps; ++i)
            assert_int_equal(met[i], 8);
    }
}

/* Blocks of pixels contain each number once, and those of one 2 x 2 block differ only in the highest bits. */
static void pixels_have_their_numbers(void **state) {
    (void)state;
    for (uint64_t seed = 0; seed < 20; ++seed) {
        uint64_t met = 0;
        for (size_t y = 0; y < 8; ++y)
            for (size_t x = 0; x < 8; ++x) {
                const size_t number = aur_nested_number(seed, x + 8, y + 16);
                const size_t even = ~(size_t)1, fourth = ~(size_t)3;
                met |= UINT64_C(1) << number;
                assert_int_equal(number % 16, aur_nested_number(seed, (x & even) + 8, (y & even) + 16) % 16);
                assert_int_equal(number % 4,
                                 aur_nested_number(seed, (x & fourth) + 8, (y & fourth) + 16) % 4);
            }
        assert_true(met == UINT64_MAX);
    }
}

/* Pixels 4 apart that differ in eighths alone would be wrong alike, as would pixels 8 apart of one number.
 * They are so by chance, one in 16 and one in 64; five standard deviations of such a count are left. */
static void blocks_have_distinct_numbers(void **state) {
    (void)state;
    enum { SEEDS = 6400 };
    double similar = 0.0, same = 0.0;
    for (uint64_t seed = 0; seed < SEEDS; ++seed) {
        similar += aur_nested_number(seed, 1, 2) >> 2 == aur_nested_number(seed, 5, 2) >> 2 ? 1.0 : 0.0;
        same += aur_nested_number(seed, 1, 2) == aur_nested_number(seed, 1, 10) ? 1.0 : 0.0;
    }
    assert_near(similar, SEEDS / 16.0, 5.0 * sqrt(SEEDS / 16.0 * 15.0 / 16.0));
    assert_near(same, SEEDS / 64.0, 5.0 * sqrt(SEEDS / 64.0 * 63.0 / 64.0));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(blocks_make_finer_patterns), cmocka_unit_test(heights_lie_in_the_middle_of_steps),
        cmocka_unit_test(pixels_have_their_numbers), cmocka_unit_test(blocks_have_distinct_numbers)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
