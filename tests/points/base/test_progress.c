/* Progress of pieces: one series from 0 to 1 that never goes back. */
#include "points/base/progress.h"

#include "check.h"

static int keep(void *user, const char *what, uint64_t done, uint64_t total) {
    assert_string_equal(what, "piece");
    *(double *)user = (double)done / (double)total;
    return 7;
}

static void test_pieces(void **state) {
    (void)state;
    double seen = -1.0;
    aur_progress_span span = {.whole = {keep, &seen}, .from = 0.25, .to = 0.75};
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

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_pieces)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
