/* Properties estimated from a function's values: gaps by sorting, tails of known shape, jumps and gaps that
 * close. */
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "points/base/random.h"
#include "points/quadrature/integrate/evidence.h"

enum { COUNT = 8192 };

static double values[COUNT], scratch[COUNT];

static aur_evidence judge(double (*function)(double u), size_t older) {
    for (size_t i = 0; i < COUNT; ++i)
        values[i] = function(aur_unit_double(aur_hash2(i, 7)));
    return aur_evidence_of(COUNT, older, values, scratch);
}

static double line(double u) {
    return u;
}
static double step(double u) {
    return u < 0.3 ? u : u + 2.0;
}
static double cubic_singularity(double u) {
    return pow(u, -1.0 / 3.0);
}
static double pole(double u) {
    return pow(u, -0.8);
}
static double rare(double u) {
    return u < 1e-3 ? 1.0 : 0.0;
}
static double constant(double u) {
    (void)u;
    return 3.0;
}
static double one_large(double u) {
    return u == aur_unit_double(aur_hash2(77, 7)) ? 1e6 : u;
}

static void shapes(void **state) {
    (void)state;
    /* A quarter of the values has four times the largest gap: it closes. */
    aur_evidence evidence = judge(line, COUNT / 4);
    assert_true(evidence.jump == 0.0 && !evidence.all_equal && !evidence.sparse && !evidence.heavy_tail);
    assert_true(fabs(evidence.magnitude - 0.5) < 0.02);
    /* Without older values to compare with it is taken for a jump: of the longest of 8192 exponential gaps.
     */
    evidence = judge(line, 0);
    assert_true(evidence.jump > 1.0 / COUNT && evidence.jump < 30.0 / COUNT);
    evidence = judge(step, COUNT / 4);
    assert_true(fabs(evidence.jump - 2.0) < 0.01);
    /* Finite variance, but the largest value is not seen. */
    evidence = judge(cubic_singularity, COUNT / 4);
    assert_true(evidence.jump > 5.0 && !evidence.heavy_tail);
    evidence = judge(pole, COUNT / 4);
    assert_true(evidence.heavy_tail);
    evidence = judge(rare, COUNT / 4);
    assert_true(evidence.sparse && evidence.jump == 1.0 && !evidence.heavy_tail);
    evidence = judge(one_large, COUNT / 4);
    assert_true(evidence.dominated && evidence.jump > 9e5);
    evidence = judge(constant, COUNT / 4);
    assert_true(evidence.all_equal && evidence.jump == 0.0 && !evidence.sparse);
    evidence = aur_evidence_of(0, 0, values, scratch);
    assert_true(evidence.all_equal && evidence.count == 0);
    values[0] = 2.0;
    evidence = aur_evidence_of(1, 0, values, scratch);
    assert_true(evidence.all_equal);
}

static int ascending(const void *left, const void *right) {
    const double a = *(const double *)left, b = *(const double *)right;
    return (a > b) - (a < b);
}

/* The gap against brute force, for few values with ties. */
static void gaps(void **state) {
    (void)state;
    for (uint64_t seed = 0; seed < 200; ++seed) {
        const size_t count = 2 + (size_t)(aur_hash2(seed, 1) % 60);
        double sorted[64], gap = 0.0;
        for (size_t i = 0; i < count; ++i)
            sorted[i] = values[i] = floor(50.0 * aur_unit_double(aur_hash3(seed, 2, i)));
        qsort(sorted, count, sizeof *sorted, ascending);
        for (size_t i = 1; i < count; ++i)
            gap = fmax(gap, sorted[i] - sorted[i - 1]);
        const aur_evidence evidence = aur_evidence_of(count, 0, values, scratch);
        /* A heavy tail may raise it to the largest distance from the median. */
        assert_true(evidence.jump >= gap &&
                    (evidence.jump == gap || evidence.jump > 2.0 * gap || count > 24));
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(shapes), cmocka_unit_test(gaps)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
