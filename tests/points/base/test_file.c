#define _GNU_SOURCE /* O_TMPFILE */
#include "check.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "points/base/file.h"
#include "points/base/io.h"

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
    assert_int_equal(rmdir(folder), 0); /* no other file is left */
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

static char folder[] = "/tmp/aureole-test-XXXXXX";

static int enter(void **state) {
    (void)state;
    return mkdtemp(folder) == NULL || chdir(folder) != 0;
}

static int leave(void **state) {
    (void)state;
    return chdir("/") != 0 || rmdir(folder) != 0; /* every test has removed its files */
}

static void write_text(const char *path, const char *text) {
    aur_error error = {0};
    if (aur_file_write(path, strlen(text), text, &error) != AUR_OK)
        fail_msg("%s: %s", path, error.message);
}

static mode_t mode_of(const char *path) {
    struct stat status;
    assert_int_equal(stat(path, &status), 0);
    return status.st_mode & 07777;
}

/* A private file was readable by everybody after it had been written again. */
static void preserves_the_mode(void **state) {
    (void)state;
    const mode_t before = umask(022);
    write_text("new", "1");
    assert_int_equal(mode_of("new"), 0644);
    static const mode_t modes[] = {0600, 0640, 0755};
    for (size_t i = 0; i < 3; ++i) {
        assert_int_equal(chmod("new", modes[i]), 0);
        write_text("new", "2");
        assert_int_equal(mode_of("new"), modes[i]);
    }
    if (geteuid() == 0) {
        struct stat status;
        assert_int_equal(chown("new", 12, 34), 0);
        write_text("new", "3");
        assert_int_equal(stat("new", &status), 0);
        assert_int_equal(status.st_uid, 12);
        assert_int_equal(status.st_gid, 34);
    }
    umask(before);
    assert_int_equal(unlink("new"), 0);
}

/* Writing through a link replaced the link. */
static void follows_links(void **state) {
    (void)state;
    assert_int_equal(mkdir("deep", 0700), 0);
    assert_int_equal(symlink("deep/target", "first"), 0);
    assert_int_equal(symlink("first", "second"), 0);
    write_text("second", "through a link to nothing");
    write_text("second", "through two links");
    struct stat status;
    assert_int_equal(lstat("second", &status), 0);
    assert_true(S_ISLNK(status.st_mode));
    char *data;
    size_t size;
    assert_int_equal(aur_file_read("deep/target", 100, &data, &size, NULL), AUR_OK);
    assert_string_equal(data, "through two links");
    free(data);
    assert_int_equal(unlink("deep/target") | rmdir("deep") | unlink("first") | unlink("second"), 0);
}

static void writes_the_longest_names(void **state) {
    (void)state;
    char name[256];
    memset(name, 'n', 255);
    name[255] = '\0';
    write_text(name, "text");
    assert_int_equal(unlink(name), 0);
}

/* A process that ends in the middle of writing leaves nothing behind; `leave` would fail. */
static void a_killed_process_leaves_nothing(void **state) {
    (void)state;
    const int descriptor = open(".", O_TMPFILE | O_WRONLY, 0600);
    if (descriptor < 0)
        skip(); /* no such files here */
    close(descriptor);
    const pid_t child = fork();
    if (child == 0) {
        aur_file_writer writer;
        if (aur_file_open("killed", &writer, NULL) == AUR_OK) {
            fputs("text", writer.stream);
            fflush(writer.stream);
        }
        raise(SIGKILL);
    }
    int status;
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFSIGNALED(status));
    assert_int_not_equal(access("killed", F_OK), 0);
}

/* Reads of every size about the limit: one of 2^k - 1 once cut the file short without a word. */
static void heeds_the_limit(void **state) {
    (void)state;
    for (size_t limit = 1; limit <= 1 << 17; limit = 2 * limit + 1) {
        for (size_t size = limit - 1; size <= limit + 1; ++size) {
            char *const text = calloc(1, size + 1);
            assert_non_null(text);
            assert_int_equal(aur_file_write("sized", size, text, NULL), AUR_OK);
            free(text);
            char *data = NULL;
            size_t got = 0;
            const aur_result result = aur_file_read("sized", limit, &data, &got, NULL);
            assert_int_equal(result, size <= limit ? AUR_OK : AUR_ERROR_FORMAT);
            assert_int_equal(got, size <= limit ? size : 0);
            free(data);
        }
    }
    assert_int_equal(unlink("sized"), 0);
}

/* A full disk is reported, also if a write failed long before the commit. */
static void says_why_it_failed(void **state) {
    (void)state;
    if (access("/dev/full", W_OK) != 0)
        skip();
    aur_error error = {0};
    aur_file_writer writer;
    assert_int_equal(aur_file_open("/dev/full", &writer, &error), AUR_OK);
    for (size_t i = 0; i < 100000; ++i)
        fputs("text", writer.stream);
    assert_int_equal(aur_file_commit(&writer, &error), AUR_ERROR_WRITE);
    assert_non_null(strstr(error.message, strerror(ENOSPC)));
}

static int reads(const char *path) {
    char *data = NULL;
    size_t size;
    aur_error error = {0};
    const aur_result result = aur_file_read(path, 100, &data, &size, &error);
    if (result == AUR_OK)
        free(data);
    return (int)result;
}

/* Opening a pipe that nobody writes to would block, and a device might never end. */
static void reads_files_only(void **state) {
    (void)state;
    assert_int_equal(mkfifo("fifo", 0600), 0);
    assert_int_equal(reads("fifo"), AUR_ERROR_OPEN);
    assert_int_equal(reads("/dev/zero"), AUR_ERROR_OPEN);
    assert_int_equal(reads("."), AUR_ERROR_OPEN);
    int ends[2];
    char handed[32];
    assert_int_equal(pipe(ends), 0);
    snprintf(handed, sizeof handed, "/dev/fd/%d", ends[0]);
    assert_int_equal(write(ends[1], "text", 4), 4);
    close(ends[1]);
    assert_int_equal(reads(handed), AUR_OK);
    close(ends[0]);
    assert_int_equal(unlink("fifo"), 0);
}

/* A link to nothing is no excuse for half a file; a file of before stays in every case. */
static void makes_what_links_point_to(void **state) {
    (void)state;
    assert_int_equal(mkdir("deep", 0700), 0);
    assert_int_equal(symlink("deep/second", "first"), 0);
    assert_int_equal(symlink("target", "deep/second"), 0);
    aur_file_writer writer;
    aur_error error = {0};
    assert_int_equal(aur_file_open("first", &writer, &error), AUR_OK);
    fputs("half", writer.stream);
    fflush(writer.stream);
    assert_int_not_equal(access("deep/target", F_OK), 0);
    aur_file_abandon(&writer);
    assert_int_not_equal(access("deep/target", F_OK), 0);
    write_text("first", "whole");
    struct stat status;
    assert_int_equal(lstat("first", &status), 0);
    assert_true(S_ISLNK(status.st_mode));
    assert_int_equal(reads("deep/target"), AUR_OK);
    assert_int_equal(unlink("deep/target") | unlink("deep/second") | unlink("first") | rmdir("deep"), 0);
}

/* The last test: from the first announcement on this process has inputs and outputs. */
static void distinguishes_inputs_and_outputs(void **state) {
    (void)state;
    aur_error error = {0};
    write_text("in", "1");
    write_text("out", "2");
    assert_int_equal(reads("in"), AUR_OK);
    assert_int_equal(aur_file_write("in", 1, "3", &error), AUR_OK); /* nothing has been announced */
    assert_int_equal(aur_file_announce_output("-", &error), AUR_OK);
    assert_int_equal(aur_file_announce_output("out", &error), AUR_OK);
    assert_int_equal(aur_file_announce_output("./out", &error), AUR_ERROR_ARGUMENT);
    assert_int_equal(aur_file_announce_output("new", &error), AUR_OK);
    assert_int_equal(aur_file_announce_output("./new", &error), AUR_ERROR_ARGUMENT);
    assert_int_equal(link("out", "hard") | symlink("hard", "soft"), 0);
    assert_int_equal(reads("soft"), AUR_ERROR_ARGUMENT);
    char *data;
    size_t size;
    assert_int_equal(aur_file_read_back("soft", 100, &data, &size, &error), AUR_OK);
    free(data);
    assert_int_equal(reads("in"), AUR_OK);
    assert_int_equal(link("in", "hard-in"), 0);
    assert_int_equal(aur_file_write("hard-in", 1, "4", &error), AUR_ERROR_ARGUMENT);
    assert_int_equal(aur_file_announce_output("in", &error), AUR_ERROR_ARGUMENT);
    assert_int_equal(aur_file_write("out", 1, "5", &error), AUR_OK);
    assert_int_equal(aur_file_write("new", 1, "6", &error), AUR_OK);
    assert_int_equal(unlink("in") | unlink("out") | unlink("new") | unlink("hard") | unlink("soft") |
                         unlink("hard-in"),
                     0);
}

/* The second process of two receives the leader's results. */
static aur_result give_nothing_bad(void *user, size_t size, void *data, aur_error *error) {
    (void)user;
    (void)error;
    memset(data, 0, size); /* an aur_error without an error */
    return AUR_OK;
}

static aur_result give_text(void *user, char **data, size_t *size, aur_error *error) {
    (void)error;
    *data = strdup(user);
    *size = strlen(user);
    return AUR_OK;
}

static void one_process_reads_and_writes_for_all(void **state) {
    (void)state;
    char text[] = "of the leader", shared[] = "/tmp/aureole-test-XXXXXX", path[64];
    const aur_io io = {.user = text, .rank = 1, .count = 2, .agree = give_nothing_bad, .share = give_text};
    assert_non_null(mkdtemp(shared));
    snprintf(path, sizeof path, "%s/out.txt", shared);
    assert_null(aur_io_use(&io));
    char *data;
    size_t size;
    assert_int_equal(aur_file_read("/nowhere", 100, &data, &size, NULL), AUR_OK);
    assert_string_equal(data, text);
    free(data);
    struct stat status;
    assert_false(aur_file_status(shared, &status));
    assert_int_equal(aur_file_write(path, 1, "x", NULL), AUR_OK);
    assert_ptr_equal(aur_io_use(NULL), &io);
    assert_int_not_equal(access(path, F_OK), 0);
    assert_true(aur_file_status(shared, &status));
    assert_int_equal(rmdir(shared), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(replaces_whole_or_not_at_all),
        cmocka_unit_test(reports_what_cannot_be_written),
        cmocka_unit_test(preserves_the_mode),
        cmocka_unit_test(follows_links),
        cmocka_unit_test(writes_the_longest_names),
        cmocka_unit_test(a_killed_process_leaves_nothing),
        cmocka_unit_test(heeds_the_limit),
        cmocka_unit_test(says_why_it_failed),
        cmocka_unit_test(reads_files_only),
        cmocka_unit_test(makes_what_links_point_to),
        cmocka_unit_test(distinguishes_inputs_and_outputs),
        cmocka_unit_test(one_process_reads_and_writes_for_all),
    };
    return cmocka_run_group_tests(tests, enter, leave);
}
