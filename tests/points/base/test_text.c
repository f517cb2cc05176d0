#include "check.h"

#include <float.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/random.h"
#include "points/base/text.h"

/* strtod of glibc rounds correctly, and these tests run in the locale "C". */
static void reads_what_strtod_reads(void **state) {
    (void)state;
    static const char *const formats[] = {"%.17g", "%.16g", "%.15f", "%.19g", "%.30e", "%.6g", "%+.3f"};
    for (uint64_t i = 0; i < 400000; ++i) {
        const uint64_t hash = aur_hash2(i, 1);
        const double scale = pow(10.0, (double)(int)(hash % 50) - 25.0);
        const double number = (aur_unit_double(aur_hash2(i, 2)) - 0.5) * (i % 7 == 0 ? 1.0 : scale);
        char text[128];
        snprintf(text, sizeof text, formats[i % 7], number);
        double value;
        const char *const end = aur_read_double(text, AUR_NUMBER_FINITE, &value);
        assert_ptr_equal(end, text + strlen(text));
        const double expected = strtod(text, NULL);
        if (memcmp(&value, &expected, sizeof value) != 0)
            fail_msg("%s is read as %.17g, not %.17g", text, value, expected);
    }
}

static void reads_hard_numbers(void **state) {
    (void)state;
    static const char *const texts[] = {
        "0",
        "-0.0",
        ".5",
        "5.",
        "1e-008",
        "9007199254740993",         /* halfway between two doubles */
        "9007199254740993.0000001", /* just above it */
        "9007199254740991e22",
        "123456789012345678901234567890",
        "0.000000000000000000000000000000000123456789012345678901234567890",
        "4.9406564584124654e-324",
        "2.4703282292062327e-324",
        "2.2250738585072011e-308",
        "1.7976931348623157e308",
        "000000000000000000000000000001",
        "1e-99999999999",
    };
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; ++i) {
        double value;
        assert_true(aur_parse_double(texts[i], &value));
        const double expected = strtod(texts[i], NULL);
        assert_memory_equal(&value, &expected, sizeof value);
    }
}

static void refuses_other_spellings(void **state) {
    (void)state;
    static const char *const texts[] = {"",    " ",    "-",   ".",   "e5", "0x10", "1,5",
                                        "1 2", "1e5x", "nan", "NaN", "in", "1_0",  "+-1",
                                        "1e",  "1d5",  "--1", "1..", "1f", "infi", "0x1p-3"};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; ++i) {
        double value = 7.0;
        if (aur_parse_double(texts[i], &value) || value != 7.0)
            fail_msg("'%s' is read as %g", texts[i], value);
    }
    double value;
    assert_true(aur_parse_double(" -Infinity\t", &value) && value == -(double)INFINITY);
    assert_true(aur_parse_double("1e999", &value) && value == (double)INFINITY);
    assert_null(aur_read_double("inf", AUR_NUMBER_FINITE, &value));
    assert_null(aur_read_double("1e999", AUR_NUMBER_FINITE, &value));
    assert_null(aur_read_double("nan", AUR_NUMBER_INFINITE, &value));
    assert_non_null(aur_read_double("nan", AUR_NUMBER_ANY, &value));
    assert_true(isnan(value));
    /* A number ends where it ends. */
    assert_string_equal(aur_read_double("1.5mm", AUR_NUMBER_FINITE, &value), "mm");
    assert_string_equal(aur_read_double("1e+", AUR_NUMBER_FINITE, &value), "e+");
}

static void reads_whole_numbers(void **state) {
    (void)state;
    uint64_t value = 0;
    assert_true(aur_parse_integer("18446744073709551615", UINT64_MAX, &value) && value == UINT64_MAX);
    assert_false(aur_parse_integer("18446744073709551616", UINT64_MAX, &value));
    assert_true(aur_parse_integer("007", 7, &value) && value == 7);
    static const char *const texts[] = {"8", "10", "", "-1", "+1", " 1", "1 ", "1.0", "0x1"};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; ++i)
        assert_false(aur_parse_integer(texts[i], 7, &value));
    assert_string_equal(aur_read_integer("12,3", 100, &value), ",3");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reads_what_strtod_reads),
        cmocka_unit_test(reads_hard_numbers),
        cmocka_unit_test(refuses_other_spellings),
        cmocka_unit_test(reads_whole_numbers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
