#include "check.h"

#include <stdlib.h>

#include "points/base/array.h"

static void grows_and_preserves_its_contents(void **state) {
    (void)state;
    double *items = NULL;
    size_t capacity = 0, moves = 0;
    for (size_t i = 0; i < 10000; ++i) {
        const size_t before = capacity;
        assert_true(aur_array_reserve(&items, &capacity, i + 1, sizeof *items));
        assert_true(capacity > i);
        moves += capacity != before;
        items[i] = (double)i;
    }
    assert_in_range(moves, 1, 14); /* doubling: log2(10000) */
    for (size_t i = 0; i < 10000; ++i)
        assert_true(items[i] == (double)i);
    assert_true(aur_array_reserve(&items, &capacity, 100000, sizeof *items));
    assert_true(capacity >= 100000);
    free(items);
}

static void refuses_what_a_size_cannot_count(void **state) {
    (void)state;
    double *items = NULL;
    size_t capacity = 0;
    assert_false(aur_array_reserve(&items, &capacity, SIZE_MAX / 8 + 1, sizeof *items));
    assert_null(items);
    assert_int_equal(capacity, 0);
    size_t product = 1;
    assert_false(aur_size_product(SIZE_MAX / 2 + 1, 2, &product));
    assert_int_equal(product, 1);
    assert_true(aur_size_product(SIZE_MAX, 1, &product));
    assert_true(product == SIZE_MAX);
    assert_true(aur_size_product(SIZE_MAX, 0, &product));
    assert_int_equal(product, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(grows_and_preserves_its_contents),
                                       cmocka_unit_test(refuses_what_a_size_cannot_count)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
