/* Creating objects by the name of their type: the order of steps, for a kind defined by this test. */
#include "check.h"

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "render/scene/plugin/plugin.h"

typedef struct thing_descriptor {
    aur_row row;
    size_t size;
    void (*release)(void *data);
} thing_descriptor;

typedef struct thing {
    const thing_descriptor *descriptor;
    double *data;
    char *more;
} thing;

static size_t released, data_released;

static void release_data(void *data) {
    assert_non_null(data);
    ++data_released;
}

static const thing_descriptor small = {{.name = "small"}, sizeof(double), release_data},
                              none = {{.name = "none"}, 0, NULL};
static const aur_row *const rows[] = {&small.row, &none.row};
static const aur_table table = {.kind = "thing", AUR_TABLE_ROWS(rows)};

/* Reads 'value', and fails where it is below 0. */
static aur_result fill(aur_parameters *parameters, void *object, const void *context, aur_error *error) {
    thing *const created = object;
    const aur_parameter *const item = aur_parameters_find(parameters, "value");
    created->more = strdup(context);
    assert_non_null(created->more);
    if (created->descriptor == &small)
        assert_true(*created->data == 0.0);
    if (item != NULL && item->text[0] == '-')
        return aur_parameters_fail_value(parameters, item, "positive", error);
    return AUR_OK;
}

static void release(void *object) {
    free(((thing *)object)->more);
    ++released;
}

static const aur_plugin_kind kind = {.table = &table,
                                     .size = sizeof(thing),
                                     .data = offsetof(thing, data),
                                     .data_size = offsetof(thing_descriptor, size),
                                     .data_release = offsetof(thing_descriptor, release),
                                     .fill = fill,
                                     .release = release};

/* An object of the type, with one parameter. */
static aur_result create(const char *type, const char *name, const char *value, thing **created,
                         aur_error *error) {
    const aur_location here = {"a.xml", 7, 3};
    aur_parameters parameters;
    assert_int_equal(aur_parameters_init(&parameters, "thing", type, here, error), AUR_OK);
    assert_int_equal(aur_parameters_add_text(&parameters, AUR_PARAMETER_FLOAT, name, value, here, error),
                     AUR_OK);
    const aur_result result = aur_plugin_create(&kind, &parameters, "context", created, error);
    aur_parameters_release(&parameters);
    return result;
}

static void creates_and_destroys(void **state) {
    (void)state;
    static const char *const types[] = {"small", "none"};
    for (size_t i = 0; i < 2; ++i) {
        thing *created = NULL;
        released = data_released = 0;
        assert_int_equal(create(types[i], "value", "1", &created, NULL), AUR_OK);
        assert_ptr_equal(&created->descriptor->row, rows[i]);
        assert_string_equal(created->more, "context");
        assert_int_equal(released, 0);
        aur_plugin_destroy(&kind, created);
        assert_int_equal(released, 1);
        assert_int_equal(data_released, i == 0);
    }
    aur_plugin_destroy(&kind, NULL);
    assert_int_equal(released, 1);
}

/* Created objects are released once; nothing is released if the type is unknown. */
static void failures_release(void **state) {
    (void)state;
    static const struct {
        const char *type, *name, *value, *message;
        aur_result result;
        size_t released;
    } cases[] = {{"smal", "value", "1", "small", AUR_ERROR_NAME, 0},
                 {"small", "value", "-1", "must be positive", AUR_ERROR_FORMAT, 1},
                 {"small", "valu", "1", "valu", AUR_ERROR_NAME, 1}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
        thing *created = (thing *)&released;
        aur_error error = {0};
        released = data_released = 0;
        assert_int_equal(create(cases[i].type, cases[i].name, cases[i].value, &created, &error),
                         cases[i].result);
        assert_null(created);
        assert_non_null(strstr(error.message, cases[i].message));
        assert_int_equal(error.line, 7);
        assert_int_equal(released, cases[i].released);
        assert_int_equal(data_released, cases[i].released);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(creates_and_destroys),
                                       cmocka_unit_test(failures_release)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
