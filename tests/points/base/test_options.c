#include "check.h"

#include <string.h>

#include "points/base/error.h"

/* The struct of the library, and the callers' structs of an older and of a newer header. */
typedef struct test_options {
    size_t size;
    double a, b;
} test_options;
typedef struct old_options {
    size_t size;
    double a;
} old_options;
typedef struct new_options {
    size_t size;
    double a, b, c;
} new_options;

static aur_result read(const void *given, test_options *read_options, aur_error *error) {
    *read_options = (test_options){.a = 1, .b = 2};
    return aur_options_read(given, sizeof *read_options, read_options, "options", error);
}

static void reads_older_and_newer_structs(void **state) {
    (void)state;
    aur_error error;
    test_options read_options;
    assert_int_equal(read(NULL, &read_options, &error), AUR_OK);
    assert_true(read_options.a == 1 && read_options.b == 2);
    const old_options old = {.size = sizeof old, .a = 5};
    assert_int_equal(read(&old, &read_options, &error), AUR_OK);
    assert_true(read_options.a == 5 && read_options.b == 2 && read_options.size == sizeof read_options);
    new_options newer = {.size = sizeof newer, .a = 5, .b = 6};
    assert_int_equal(read(&newer, &read_options, &error), AUR_OK);
    assert_true(read_options.a == 5 && read_options.b == 6);
    newer.c = 1;
    assert_int_equal(read(&newer, &read_options, &error), AUR_ERROR_UNSUPPORTED);
    const size_t never_sizes[] = {0, sizeof(size_t) / 2, sizeof(size_t) + 4};
    for (size_t i = 0; i < sizeof never_sizes / sizeof never_sizes[0]; ++i) {
        const old_options unset = {.size = never_sizes[i], .a = 5};
        assert_int_equal(read(&unset, &read_options, &error), AUR_ERROR_ARGUMENT);
        assert_non_null(strstr(error.message, "size"));
        assert_true(read_options.a == 1 && read_options.b == 2); /* untouched by an error */
    }
    const size_t first = sizeof first; /* the struct of a header before `a` came */
    assert_int_equal(read(&first, &read_options, &error), AUR_OK);
    assert_true(read_options.a == 1 && read_options.b == 2 && read_options.size == sizeof read_options);
}

static void fills_older_and_newer_descriptions(void **state) {
    (void)state;
    aur_error error;
    const test_options read_options = {.size = sizeof read_options, .a = 1, .b = 2};
    old_options old = {.size = sizeof old};
    assert_int_equal(aur_description_write(&read_options, sizeof read_options, &old, "description", &error),
                     AUR_OK);
    assert_true(old.a == 1 && old.size == sizeof old);
    new_options newer = {.size = sizeof newer, .c = 9};
    assert_int_equal(aur_description_write(&read_options, sizeof read_options, &newer, "description", &error),
                     AUR_OK);
    assert_true(newer.a == 1 && newer.b == 2 && newer.c == 0 && newer.size == sizeof newer);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(reads_older_and_newer_structs),
                                       cmocka_unit_test(fills_older_and_newer_descriptions)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
