#include "check.h"

#include <string.h>

#include "points/base/keys.h"

typedef enum color { RED, GREEN, BLUE } color;

typedef struct thing {
    bool flag;
    int64_t number;
    uint32_t small;
    double real;
    float single;
    color color;
    const char *text;
    double vector[3];
    float triple[3];
    aur_color shade;
    double transform[16];
    const aur_parameter *item;
    double computed;
} thing;

static const aur_key keys[] = {
    {AUR_KEY_OF_BOOLEAN(thing, "flag", flag, "true", "a flag")},
    {AUR_KEY_OF_INTEGER(thing, "number", number, -3, 1 << 30, "7", "a number")},
    {AUR_KEY_OF_INTEGER(thing, "small", small, 0, INFINITY, "1", "a number of 32 bits")},
    {AUR_KEY_OF_REAL(thing, "real", real, 1, 2, "1.5", "an open range"), .minimum_open = true,
     .maximum_open = true},
    {AUR_KEY_OF_REAL(thing, "single", single, 0, 1, "0.25", "half open"), .maximum_open = true},
    {AUR_KEY_OF_CHOICE(thing, "color", color, "green", "a word", "red", "green", "blue")},
    {AUR_KEY_OF_TEXT(thing, "text", text, "sobol", "a text")},
    {AUR_KEY_OF_VECTOR(thing, "vector", vector, -INFINITY, INFINITY, "0 0 1", "doubles")},
    {AUR_KEY_OF_VECTOR(thing, "triple", triple, 0, 9, "2", "floats")},
    {AUR_KEY_OF_COLOR(thing, "shade", shade, 1, "0.5", "a colour")},
    {AUR_KEY_OF_TRANSFORM(thing, "transform", transform, "a map")},
    {AUR_KEY_OF_ITEM(thing, "item", item, "path", "another thing", "integrator")},
    {AUR_KEY_OF_REAL(thing, "computed", computed, 0, INFINITY, "by the others", "follows from others"),
     .computed = true},
};

static const aur_row row = {.name = "thing", .summary = "", .source = "", AUR_ROW_KEYS(keys)};

static aur_result read(const char *text, thing *parsed, aur_error *error) {
    aur_parameters parameters;
    *parsed = (thing){.computed = -1.0};
    *error = (aur_error){0};
    assert_int_equal(aur_parameters_parse(&parameters, "thing", text, error), AUR_OK);
    const aur_result result = aur_row_read(&row, &parameters, parsed, error);
    parsed->item = NULL; /* the parameters' own */
    if (parsed->text != NULL && strcmp(parsed->text, "sobol") != 0)
        parsed->text = NULL;
    aur_parameters_release(&parameters);
    return result;
}

static void takes_the_defaults(void **state) {
    (void)state;
    thing parsed;
    aur_error error;
    assert_int_equal(read("thing", &parsed, &error), AUR_OK);
    assert_true(parsed.flag);
    assert_int_equal(parsed.number, 7);
    assert_int_equal(parsed.small, 1);
    assert_near(parsed.real, 1.5, 0);
    assert_near(parsed.single, 0.25, 0);
    assert_int_equal(parsed.color, GREEN);
    assert_string_equal(parsed.text, "sobol");
    assert_near(parsed.vector[0], 0, 0);
    assert_near(parsed.vector[2], 1, 0);
    assert_near(parsed.triple[2], 2, 0);
    assert_near(parsed.shade.constant.y, 0.5, 0);
    assert_near(parsed.computed, -1, 0); /* left alone */
}

static void takes_what_is_given(void **state) {
    (void)state;
    thing parsed;
    aur_error error;
    assert_int_equal(read("thing:flag=False,number=-3,small=4000000000,real=1.25,single=0,color=blue,"
                          "vector=(1 2 inf),triple=(1,2,3),shade=1,computed=inf,item=(path:rr_depth=3)",
                          &parsed, &error),
                     AUR_OK);
    assert_false(parsed.flag);
    assert_int_equal(parsed.number, -3);
    assert_true(parsed.small == 4000000000u);
    assert_near(parsed.real, 1.25, 0);
    assert_int_equal(parsed.color, BLUE);
    assert_true(isinf(parsed.vector[2]));
    assert_near(parsed.triple[1], 2, 0);
    assert_near(parsed.shade.constant.z, 1, 0);
    assert_true(isinf(parsed.computed));
}

static void says_what_is_wrong(void **state) {
    (void)state;
    static const char *const wrong[][2] = {
        {"thing:flag=yes", "thing 'thing': 'flag' must be true or false, not 'yes'"},
        {"thing:number=x", "thing 'thing': 'number' must be an integer, not 'x'"},
        {"thing:number=1.5", "thing 'thing': 'number' must be an integer, not '1.5'"},
        {"thing:number=-4", "thing 'thing': 'number' must be between -3 and 1073741824, not '-4'"},
        {"thing:number=99999999999999999999",
         "thing 'thing': 'number' must be between -3 and 1073741824, not '99999999999999999999'"},
        {"thing:small=-1", "thing 'thing': 'small' must be at least 0, not '-1'"},
        {"thing:real=1", "thing 'thing': 'real' must be between 1 and 2, both exclusive, not '1'"},
        {"thing:real=nan", "thing 'thing': 'real' must be a number, not 'nan'"},
        {"thing:single=1", "thing 'thing': 'single' must be at least 0 and below 1, not '1'"},
        {"thing:color=pink", "thing 'thing': 'color' must be one of red, green, blue, not 'pink'"},
        {"thing:vector=1 2", "thing 'thing': 'vector' must be one or three numbers, not '1 2'"},
        {"thing:triple=(1,2,10)", "thing 'thing': 'triple' must be between 0 and 9, not '1,2,10'"},
        {"thing:transform=1", "thing 'thing': 'transform' must be a transform, not '1'"},
        {"thing:nunber=1", "thing 'thing' has no 'nunber'; did you mean 'number'?"},
        {"thing:zzz=1", "thing 'thing' has no 'zzz'; it has: flag, real, text, item, small, color, shade, "
                        "number, single, vector, triple, computed, transform"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; ++i) {
        thing parsed;
        aur_error error;
        assert_int_not_equal(read(wrong[i][0], &parsed, &error), AUR_OK);
        assert_string_equal(error.message, wrong[i][1]);
    }
}

/* Scenes have typed values: a string is no number. */
static void minds_the_types_of_scenes(void **state) {
    (void)state;
    static const struct {
        aur_parameter_kind kind;
        const char *name, *text;
        bool good;
    } cases[] = {{AUR_PARAMETER_STRING, "number", "3", false}, {AUR_PARAMETER_INTEGER, "number", "3", true},
                 {AUR_PARAMETER_FLOAT, "number", "3", false},  {AUR_PARAMETER_INTEGER, "real", "1", false},
                 {AUR_PARAMETER_FLOAT, "real", "1.5", true},   {AUR_PARAMETER_STRING, "color", "red", true},
                 {AUR_PARAMETER_FLOAT, "text", "1", false},    {AUR_PARAMETER_COLOR, "vector", "1 2 3", true},
                 {AUR_PARAMETER_STRING, "flag", "true", false}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
        aur_parameters parameters;
        aur_error error = {0};
        thing parsed;
        const aur_location location = {"scene.xml", 3, 4};
        assert_int_equal(aur_parameters_init(&parameters, "thing", "thing", location, &error), AUR_OK);
        assert_int_equal(aur_parameters_add_text(&parameters, cases[i].kind, cases[i].name, cases[i].text,
                                                 location, &error),
                         AUR_OK);
        assert_int_equal(aur_row_read(&row, &parameters, &parsed, &error) == AUR_OK, cases[i].good);
        if (!cases[i].good)
            assert_int_equal(error.line, 3);
        aur_parameters_release(&parameters);
    }
}

static void prints_ranges(void **state) {
    (void)state;
    static const char *const ranges[] = {"",           "-3 .. 1073741824", "0 ..",
                                         "> 1 .. < 2", "0 .. < 1",         "red, green, blue"};
    for (size_t i = 0; i < sizeof ranges / sizeof ranges[0]; ++i) {
        char text[64];
        assert_int_equal(aur_key_range(aur_row_key(&row, i), sizeof text, text), strlen(ranges[i]));
        assert_string_equal(text, ranges[i]);
    }
    assert_null(aur_row_key(&row, sizeof keys / sizeof keys[0]));
    assert_ptr_equal(aur_row_find_key(&row, "small"), &keys[2]);
    assert_null(aur_row_find_key(&row, "smaller"));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(takes_the_defaults), cmocka_unit_test(takes_what_is_given),
        cmocka_unit_test(says_what_is_wrong), cmocka_unit_test(minds_the_types_of_scenes),
        cmocka_unit_test(prints_ranges),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
