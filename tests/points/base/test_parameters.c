#include "check.h"

#include <string.h>

#include "points/base/keys.h"
#include "points/base/text.h"

static void parses_a_specification(void **state) {
    (void)state;
    aur_parameters parameters;
    aur_error error = {0};
    assert_int_equal(aur_parameters_parse(&parameters, "set", "esfg:base=64,levels=3,shift=final", &error),
                     AUR_OK);
    assert_string_equal(parameters.plugin, "esfg");
    assert_string_equal(aur_parameters_find(&parameters, "base")->text, "64");
    assert_string_equal(aur_parameters_find(&parameters, "levels")->text, "3");
    assert_int_equal(aur_parameters_finish(&parameters, &error), AUR_ERROR_NAME);
    assert_string_equal(aur_parameters_find(&parameters, "shift")->text, "final");
    assert_null(aur_parameters_find(&parameters, "scramble"));
    assert_int_equal(aur_parameters_finish(&parameters, &error), AUR_OK);
    aur_parameters_release(&parameters);
}

static void keeps_commas_in_parentheses(void **state) {
    (void)state;
    aur_parameters parameters;
    aur_error error = {0};
    assert_int_equal(aur_parameters_parse(&parameters, "integrator", "x:a=(y:b=1,c=2),d=3", &error), AUR_OK);
    assert_string_equal(aur_parameters_find(&parameters, "a")->text, "y:b=1,c=2");
    assert_string_equal(aur_parameters_find(&parameters, "d")->text, "3");
    aur_parameters_release(&parameters);
}

typedef struct thing {
    double a;
} thing;

static const aur_key keys[] = {{AUR_KEY_OF_REAL(thing, "a", a, 0, 10, "0", "a number")}};

static const aur_row row = {.name = "x", .summary = "", .source = "", AUR_ROW_KEYS(keys)};

static void refuses_what_is_wrong(void **state) {
    (void)state;
    static const char *const texts[] = {"x:a=1e3x", "x:a=nan", "x:a=", "x:a=11", "x:b=3", "x:aa=1"};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; ++i) {
        aur_parameters parameters;
        aur_error error = {0};
        assert_int_equal(aur_parameters_parse(&parameters, "set", texts[i], &error), AUR_OK);
        thing value;
        assert_int_not_equal(aur_row_read(&row, &parameters, &value, &error), AUR_OK);
        assert_true(strlen(error.message) > 0);
        aur_parameters_release(&parameters);
    }
    aur_parameters parameters;
    aur_error error = {0};
    assert_int_equal(aur_parameters_parse(&parameters, "set", "x:a=1,a=2", &error), AUR_ERROR_FORMAT);
    assert_int_equal(aur_parameters_parse(&parameters, "set", "x:nothing", &error), AUR_ERROR_FORMAT);
}

/* A key that two tables request is listed once. */
static void lists_a_key_once(void **state) {
    (void)state;
    aur_parameters parameters;
    aur_error error = {0};
    assert_int_equal(aur_parameters_parse(&parameters, "set", "x:zzzz=3", &error), AUR_OK);
    static const char *const names[] = {"first", "second", "first", "third", "second", "first"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; ++i)
        assert_null(aur_parameters_find(&parameters, names[i]));
    assert_int_equal(aur_parameters_finish(&parameters, &error), AUR_ERROR_NAME);
    assert_string_equal(error.message, "set 'x' has no 'zzzz'; it has: first, third, second");
    aur_parameters_release(&parameters);
}

static void suggests_the_nearest_name(void **state) {
    (void)state;
    static const char *const names[] = {"reflectance", "radiance", "exponent"};
    assert_string_equal(aur_nearest_name("reflectence", 3, names), "reflectance");
    assert_null(aur_nearest_name("zzz", 3, names));
}

static void splits_numbers(void **state) {
    (void)state;
    double values[4];
    assert_int_equal(aur_parse_doubles(" 1, 2e-008\t3 ", values, 4), 3);
    assert_near(values[1], 2e-8, 0);
    assert_true(aur_parse_doubles("1, two", values, 4) == SIZE_MAX);
    assert_true(aur_parse_doubles("1, nan", values, 4) == SIZE_MAX);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(parses_a_specification), cmocka_unit_test(keeps_commas_in_parentheses),
        cmocka_unit_test(refuses_what_is_wrong),  cmocka_unit_test(suggests_the_nearest_name),
        cmocka_unit_test(lists_a_key_once),       cmocka_unit_test(splits_numbers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
