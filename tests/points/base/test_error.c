#include "check.h"

#include <stdio.h>
#include <string.h>

#include "points/base/error.h"

static void says_where_and_what(void **state) {
    (void)state;
    aur_error error;
    const aur_location where = {.file = "scene.xml", .line = 3, .column = 7};
    assert_int_equal(aur_fail_at(&error, where, AUR_ERROR_FORMAT, "wrong by %g", 0.5), AUR_ERROR_FORMAT);
    char text[64];
    assert_int_equal(aur_error_format(&error, sizeof text, text), 27);
    assert_string_equal(text, "scene.xml:3:7: wrong by 0.5");
    assert_int_equal(aur_error_format(&error, 0, NULL), 27);
    assert_int_equal(aur_fail_at(NULL, where, AUR_ERROR_FORMAT, "nobody reads this"), AUR_ERROR_FORMAT);
}

/* The new message contains the old one, and the new location the old one. */
static void may_be_made_from_itself(void **state) {
    (void)state;
    aur_error error;
    aur_fail_at(&error, (aur_location){.file = "a.obj", .line = 2}, AUR_ERROR_FORMAT, "no number");
    aur_fail_at(&error, (aur_location){.file = error.file, .line = error.line}, error.result, "shape 'x': %s",
                error.message);
    char text[64];
    aur_error_format(&error, sizeof text, text);
    assert_string_equal(text, "a.obj:2: shape 'x': no number");
}

static void long_texts_are_cut(void **state) {
    (void)state;
    char path[3000];
    memset(path, 'd', sizeof path);
    strcpy(path + sizeof path - 7, "/e.xml");
    aur_error error;
    aur_fail_at(&error, (aur_location){.file = path}, AUR_ERROR_OPEN, "%s", path);
    assert_int_equal(strlen(error.file), AUR_ERROR_FILE_CAPACITY - 1);
    assert_string_equal(error.file + AUR_ERROR_FILE_CAPACITY - 7, "/e.xml");
    assert_int_equal(strlen(error.message), AUR_ERROR_MESSAGE_CAPACITY - 1);
}

static void headers_and_library_have_one_version(void **state) {
    (void)state;
    char text[32];
    snprintf(text, sizeof text, "%d.%d.%d", AUREOLE_VERSION_MAJOR, AUREOLE_VERSION_MINOR,
             AUREOLE_VERSION_PATCH);
    assert_string_equal(aur_version(), text);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(says_where_and_what),
        cmocka_unit_test(may_be_made_from_itself),
        cmocka_unit_test(long_texts_are_cut),
        cmocka_unit_test(headers_and_library_have_one_version),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
