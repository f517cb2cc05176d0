#include "check.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/file.h"

static void replaces_whole_or_not_at_all(void **state) {
    (void)state;
    char folder[] = "/tmp/aureole-test-XXXXXX";
    assert_non_null(mkdtemp(folder));
    char path[64];
    snprintf(path, sizeof path, "%s/out.txt", folder);
    aur_error error = {0};
    aur_file_writer writer;
    assert_int_equal(aur_file_open(path, &writer, &error), AUR_OK);
    fputs("first", writer.stream);
    assert_int_not_equal(access(path, F_OK), 0);
    assert_int_equal(aur_file_commit(&writer, &error), AUR_OK);

    assert_int_equal(aur_file_open(path, &writer, &error), AUR_OK);
    fputs("second", writer.stream);
    aur_file_abandon(&writer);

    char *data;
    size_t size;
    assert_int_equal(aur_file_read(path, 100, &data, &size, &error), AUR_OK);
    assert_string_equal(data, "first");
    free(data);
    assert_int_equal(aur_file_read(path, 3, &data, &size, &error), AUR_ERROR_FORMAT);
    assert_int_equal(unlink(path), 0);
    assert_int_equal(rmdir(folder), 0); /* nothing is left beside it */
}

static void reports_what_cannot_be_written(void **state) {
    (void)state;
    aur_error error = {0};
    aur_file_writer writer;
    assert_int_equal(aur_file_open("/nowhere/out.txt", &writer, &error), AUR_ERROR_WRITE);
    assert_string_equal(error.file, "/nowhere/out.txt");
    if (access("/dev/full", W_OK) == 0) {
        assert_int_equal(aur_file_open("/dev/full", &writer, &error), AUR_OK);
        fputs("text", writer.stream);
        assert_int_equal(aur_file_commit(&writer, &error), AUR_ERROR_WRITE);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(replaces_whole_or_not_at_all),
        cmocka_unit_test(reports_what_cannot_be_written),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
