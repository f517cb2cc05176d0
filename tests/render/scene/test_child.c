/* A child process that hangs is given up after the time that its input allows, and one that is cancelled at
 * once. */
#include "check.h"

#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "render/scene/importers/model/child.h"

static char path[64];

static void write_program(const char *text) {
    snprintf(path, sizeof path, "/tmp/aureole-child-%ld.sh", (long)getpid());
    FILE *const file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file, "#!/bin/sh\n%s\n", text);
    assert_int_equal(fclose(file), 0);
    assert_int_equal(chmod(path, 0700), 0);
}

static int stop_at_third(void *user, const char *what, uint64_t done, uint64_t total) {
    assert_string_equal(what, "reading the model");
    assert_true(done <= total);
    return ++*(int *)user == 3;
}

/* The result of waiting for a byte that never arrives. */
static aur_result wait_for(const char *text, double seconds, double patience, const aur_progress *progress,
                           aur_error *error) {
    aur_child child;
    write_program(text);
    assert_int_equal(aur_child_start(&child, path, progress, error), AUR_OK);
    child.seconds = seconds;
    child.patience = patience;
    char byte;
    assert_false(aur_child_receive(&child, 1, &byte));
    const aur_result result = aur_child_fail(&child, (aur_location){.file = "a.fbx"}, error);
    assert_int_equal(child.pid, 0);
    assert_int_equal(child.socket, -1);
    assert_string_equal(error->file, "a.fbx");
    unlink(path);
    return result;
}

static void test_hangs(void **state) {
    (void)state;
    const aur_progress none = {0};
    aur_error error = {0};
    assert_int_equal(wait_for("while :; do :; done", 0.2, 1e6, &none, &error), AUR_ERROR_FORMAT);
    assert_non_null(strstr(error.message, "of processor time"));
    assert_int_equal(wait_for("exec sleep 1000", 0.1, 6.0, &none, &error), AUR_ERROR_FORMAT);
    assert_non_null(strstr(error.message, "did not end within"));
    assert_null(strstr(error.message, "processor"));
}

static void test_cancel(void **state) {
    (void)state;
    int calls = 0;
    aur_error error = {0};
    const aur_progress progress = {stop_at_third, &calls};
    assert_int_equal(wait_for("exec sleep 1000", 100.0, 6.0, &progress, &error), AUR_ERROR_CANCELLED);
    assert_int_equal(calls, 3);
}

static void test_limits_grow(void **state) {
    (void)state;
    aur_child child = {0};
    const uint64_t before = aur_child_memory(&child);
    aur_child_grant(&child, 1 << 20);
    assert_true(aur_child_memory(&child) > before);
    aur_child_grant(&child, UINT64_MAX);
    aur_child_grant(&child, UINT64_MAX);
    assert_true(aur_child_memory(&child) >= UINT64_C(1) << 50);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_hangs), cmocka_unit_test(test_cancel),
                                       cmocka_unit_test(test_limits_grow)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
