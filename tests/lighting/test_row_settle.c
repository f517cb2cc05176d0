/* Intervals after the correction: the deviations change as if each randomisation were corrected. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "lighting/viewfactors/exchange.h"
#include "points/base/random.h"

enum { ROWS = 4, ENTRIES = 14, UPPER = 9, PARTS = 8 };

/* All pairs except the first row and the last one; the third row sees itself only a little less. */
static const uint64_t starts[ROWS + 1] = {0, 3, 7, 11, 14};
static const uint32_t columns[ENTRIES] = {0, 1, 2, 0, 1, 2, 3, 0, 1, 2, 3, 1, 2, 3};
static const double sky_exchange = 0.1;

static double *copy_of(size_t count, const double *from) {
    double *const to = malloc(count * sizeof *to);
    assert_non_null(to);
    memcpy(to, from, count * sizeof *to);
    return to;
}

/* Numbers in [lowest, lowest + range), the same above and below the diagonal. */
static double number(size_t what, size_t a, size_t b) {
    return aur_unit_double(aur_hash3(what, a < b ? a : b, a < b ? b : a));
}

static double deviation(size_t what, size_t a, size_t b, size_t part) {
    double mean = 0.0;
    for (size_t r = 0; r < PARTS; ++r)
        mean += number(what + r, a, b) / PARTS;
    return 1e-3 * (number(what + part, a, b) - mean);
}

/* The report of the correction, from the entries and the sky before it. */
static void check_balance(const aur_exchange *g, const double *values, const double *sky,
                          const aur_balance *balance) {
    double squares = 0.0, area = 0.0, moved = 0.0, total = 0.0, largest = 0.0;
    for (size_t a = 0; a < ROWS; ++a) {
        double before = sky[a], after = g->sky[a];
        for (uint64_t e = starts[a]; e < starts[a + 1]; ++e) {
            before += values[e];
            after += g->values[e];
            moved += fabs(g->values[e] - values[e]);
            total += values[e];
        }
        area += g->areas[a];
        squares += pow(before - g->areas[a], 2.0) / g->areas[a];
        largest = fmax(largest, fabs(after / g->areas[a] - 1.0));
    }
    assert_near(balance->before, sqrt(squares / area), 1e-14);
    assert_near(balance->moved, moved / total, 1e-14);
    assert_near(balance->after, largest, 1e-14);
    assert_true(balance->after < 1e-12 && balance->unbalanced == 0);
}

/* The exchange with the deviations of one part, or with none where `part` is PARTS. */
static aur_exchange make(size_t part) {
    double values[ENTRIES], variances[ENTRIES], widths[ENTRIES], sky[ROWS], sky_widths[ROWS], areas[ROWS],
        zero[ROWS] = {0.0};
    float deviations[UPPER * PARTS];
    double losses[2 * ROWS * PARTS] = {0.0};
    size_t upper = 0;
    for (size_t a = 0; a < ROWS; ++a) {
        areas[a] = sky_exchange;
        for (uint64_t e = starts[a]; e < starts[a + 1]; ++e) {
            const size_t b = columns[e];
            areas[a] += 0.2 + 0.1 * number(1, a, b);
            values[e] = 0.2 + 0.1 * number(1, a, b) + (part < PARTS ? deviation(100, a, b, part) : 0.0);
            variances[e] = 0.5 + number(2, a, b);
            widths[e] = sqrt(variances[e]);
            for (size_t r = 0; b >= a && r < PARTS; ++r)
                deviations[PARTS * upper + r] = (float)deviation(100, a, b, r);
            upper += b >= a;
        }
        sky[a] = sky_exchange + (part < PARTS ? deviation(200, a, ROWS, part) : 0.0);
        sky_widths[a] = 0.1 + number(3, a, a);
        for (size_t r = 0; r < PARTS; ++r)
            losses[PARTS * a + r] = deviation(200, a, ROWS, r);
    }
    assert_true(upper == UPPER);
    aur_exchange g = {.rows = ROWS,
                      .starts = malloc(sizeof starts),
                      .columns = malloc(sizeof columns),
                      .values = copy_of(ENTRIES, values),
                      .variances = copy_of(ENTRIES, variances),
                      .half_widths = copy_of(ENTRIES, widths),
                      .deviations = malloc(sizeof deviations),
                      .loss_deviations = copy_of(2 * ROWS * PARTS, losses),
                      .randomizations = PARTS,
                      .student = 2.0,
                      .areas = copy_of(ROWS, areas),
                      .sky = copy_of(ROWS, sky),
                      .sky_half_widths = copy_of(ROWS, sky_widths),
                      .back = copy_of(ROWS, zero),
                      .back_half_widths = copy_of(ROWS, zero)};
    assert_true(g.starts != NULL && g.columns != NULL && g.deviations != NULL);
    memcpy(g.starts, starts, sizeof starts);
    memcpy(g.columns, columns, sizeof columns);
    memcpy(g.deviations, deviations, sizeof deviations);
    const aur_parallel_options parallel = {.threads = 1};
    aur_balance balance;
    aur_error error;
    assert_true(aur_exchange_balance(&g, &parallel, &balance, &error) == AUR_OK);
    check_balance(&g, values, sky, &balance);
    return g;
}

/* The spread of individually corrected randomisations equals the intervals. The mean needs no correction, so
 * the effect of the randomisations' sky on the weights is of second order in deviations below a hundredth.
 * Deviations are floats, solved to 1e-4. */
static void test_spread(void **state) {
    (void)state;
    const aur_exchange mean = make(PARTS);
    double squares[ENTRIES] = {0.0}, sky[ROWS] = {0.0};
    for (size_t r = 0; r < PARTS; ++r) {
        aur_exchange one = make(r);
        for (size_t e = 0; e < ENTRIES; ++e)
            squares[e] += (one.values[e] - mean.values[e]) * (one.values[e] - mean.values[e]);
        for (size_t a = 0; a < ROWS; ++a)
            sky[a] += (one.sky[a] - mean.sky[a]) * (one.sky[a] - mean.sky[a]);
        aur_exchange_release(&one);
    }
    const double scale = 2.0 / sqrt((double)PARTS * (PARTS - 1));
    double before = 0.0, after = 0.0;
    for (size_t a = 0; a < ROWS; ++a) {
        assert_near(mean.sky_half_widths[a], scale * sqrt(sky[a]), 2e-3 * mean.sky_half_widths[a]);
        for (uint64_t e = starts[a]; e < starts[a + 1]; ++e) {
            assert_near(mean.half_widths[e], scale * sqrt(squares[e]), 2e-3 * mean.half_widths[e]);
            double square = 0.0;
            for (size_t r = 0; r < PARTS; ++r)
                square += deviation(100, a, columns[e], r) * deviation(100, a, columns[e], r);
            before += scale * scale * square;
            after += mean.half_widths[e] * mean.half_widths[e];
        }
    }
    assert_true(after < 0.8 * before); /* four laws for thirteen numbers */
    aur_exchange_release((aur_exchange *)&mean);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_spread)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
