/* Progress of parts: one series from 0 to 1 that never decreases. */
#include "points/base/parallel.h"

#include <math.h>

#include "check.h"

static int record(void *user, const char *what, uint64_t done, uint64_t total) {
    assert_string_equal(what, "piece");
    *(double *)user = (double)done / (double)total;
    return 7;
}

static void test_pieces(void **state) {
    (void)state;
    double seen = -1.0;
    aur_progress_span span = {.whole = {record, &seen}, .from = 0.25, .to = 0.75};
    const aur_progress piece = aur_progress_within(&span);
    assert_int_equal(piece.function(piece.user, "piece", 1, 2), 7);
    assert_true(seen == 0.5);
    piece.function(piece.user, "piece", 2, 2);
    assert_true(seen == 0.75);
    span.from = 0.5; /* an estimate that was too high */
    piece.function(piece.user, "piece", 0, 0);
    assert_true(seen == 0.75);
    span.to = 1.0;
    piece.function(piece.user, "piece", 3, 3);
    assert_true(seen == 1.0);
    span.whole.function = NULL;
    assert_null(aur_progress_within(&span).function);
}

typedef struct report {
    uint64_t done, total;
} report;

static int record_both(void *user, const char *what, uint64_t done, uint64_t total) {
    (void)what;
    *(report *)user = (report){done, total};
    return 0;
}

/* If the total is known, the share is that of the work. If estimates of the total change, the share never
 * decreases, and its rate predicts the remaining work. If the total is unknown, the share waits. */
static void test_share(void **state) {
    (void)state;
    report seen;
    const aur_progress progress = {record_both, &seen};
    aur_progress_share share = {0}, s = {0};
    for (int i = 1; i <= 10; ++i) {
        aur_progress_report_work(&progress, "all", &share, i, 10 - i);
        assert_near((double)seen.done / (double)seen.total, fmin(i / 10.0, 1.0 - 1e-9), 1e-11);
    }
    const double lefts[] = {INFINITY, 100.0, 99.0, 10.0, 500.0, 3.0, INFINITY, 40.0};
    for (size_t i = 0; i < sizeof lefts / sizeof lefts[0]; ++i) {
        const double before = s.share;
        aur_progress_report_work(&progress, "some", &s, (double)i + 1.0, lefts[i]);
        if (lefts[i] == INFINITY) {
            assert_true(s.share == before && seen.done == 0 && seen.total == 0);
            continue;
        }
        assert_near((1.0 - s.share) / (s.share - before), lefts[i], 1e-9 * lefts[i]);
        assert_near((double)seen.done / (double)seen.total, s.share, 1e-11);
    }
    aur_progress_report_work(&progress, "some", &s, 9.0, 0.0);
    assert_near((double)seen.done / (double)seen.total, 1.0 - 1e-9,
                1e-11); /* not full before the work ends */
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_pieces), cmocka_unit_test(test_share)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
