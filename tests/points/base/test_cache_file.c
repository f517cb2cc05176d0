#include "check.h"

#include <dirent.h>
#include <fcntl.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "points/base/file.h"

enum { MANY = 1 << 18 };

typedef struct folder {
    char path[64], cache[96];
} folder;

static int make_folder(void **state) {
    folder *const f = calloc(1, sizeof *f);
    snprintf(f->path, sizeof f->path, "/tmp/aureole-test-XXXXXX");
    if (mkdtemp(f->path) == NULL)
        return 1;
    /* Two folders that are not there yet. */
    snprintf(f->cache, sizeof f->cache, "%s/deep/cache", f->path);
    setenv("AUREOLE_CACHE", f->cache, 1);
    unsetenv("AUREOLE_CACHE_MIB");
    *state = f;
    return 0;
}

/* Calls `use` with every file of the folder; returns their number. */
static size_t each_file(const char *path, void (*use)(const char *file)) {
    DIR *const folder_of = opendir(path);
    size_t count = 0;
    for (struct dirent *entry; folder_of != NULL && (entry = readdir(folder_of)) != NULL;) {
        if (entry->d_name[0] == '.' && strchr("./", entry->d_name[1]) != NULL)
            continue;
        char file[512];
        snprintf(file, sizeof file, "%s/%s", path, entry->d_name);
        if (use != NULL)
            use(file);
        ++count;
    }
    if (folder_of != NULL)
        closedir(folder_of);
    return count;
}

static void remove_file(const char *file) {
    assert_int_equal(unlink(file), 0);
}

static int remove_folder(void **state) {
    folder *const f = *state;
    char deep[96];
    snprintf(deep, sizeof deep, "%s/deep", f->path);
    each_file(f->cache, remove_file);
    (void)rmdir(f->cache); /* not every test has it */
    (void)rmdir(deep);
    const int failed = rmdir(f->path);
    free(f);
    return failed;
}

static bool is_stored(const char *key, const char *expected) {
    size_t size;
    char *const data = aur_cache_file_read("kind", key, &size);
    const bool same = data != NULL && size == strlen(expected) && strcmp(data, expected) == 0;
    free(data);
    return same;
}

static void stores_by_key(void **state) {
    (void)state;
    size_t size = 1;
    assert_null(aur_cache_file_read("kind", "a", &size));
    aur_cache_file_write("kind", "a", 5, "first");
    aur_cache_file_write("kind", "b", 0, "");
    assert_true(is_stored("a", "first"));
    assert_true(is_stored("b", ""));
    assert_false(is_stored("c", ""));
    assert_null(aur_cache_file_read("other", "a", &size));
    aur_cache_file_write("kind", "a", 6, "second");
    assert_true(is_stored("a", "second"));
}

static char found[512];
static size_t damage_at;

static void find(const char *file) {
    snprintf(found, sizeof found, "%s", file);
}

static void damage(const char *file) {
    struct stat status;
    assert_int_equal(stat(file, &status), 0);
    const int descriptor = open(file, O_RDWR);
    char byte;
    assert_int_equal(pread(descriptor, &byte, 1, (off_t)damage_at), 1);
    byte ^= 4;
    assert_int_equal(pwrite(descriptor, &byte, 1, (off_t)damage_at), 1);
    close(descriptor);
}

static void cut(const char *file) {
    assert_int_equal(truncate(file, (off_t)damage_at), 0);
}

/* Each byte changed, and each truncation: treated as missing, and can be stored again. */
static void damaged_files_are_not_there(void **state) {
    const folder *const f = *state;
    aur_cache_file_write("kind", "key", 9, "some data");
    each_file(f->cache, find);
    struct stat status;
    assert_int_equal(stat(found, &status), 0);
    for (size_t i = 0; i < (size_t)status.st_size; ++i) {
        damage_at = i;
        damage(found);
        assert_false(is_stored("key", "some data"));
        damage(found); /* as it was */
        assert_true(is_stored("key", "some data"));
        cut(found);
        assert_false(is_stored("key", "some data"));
        aur_cache_file_write("kind", "key", 9, "some data");
        assert_true(is_stored("key", "some data"));
    }
    /* A file stored under the name of another key is rejected. */
    char name[512];
    snprintf(name, sizeof name, "%s", found);
    remove_file(name);
    aur_cache_file_write("kind", "other", 9, "some data");
    each_file(f->cache, find);
    assert_int_equal(rename(found, name), 0);
    assert_false(is_stored("key", "some data"));
}

static void nothing_where_nothing_can_be(void **state) {
    (void)state;
    static const char *const folders[] = {"", "/dev/null/cache", "/proc/cache"};
    for (size_t i = 0; i < sizeof folders / sizeof folders[0]; ++i) {
        setenv("AUREOLE_CACHE", folders[i], 1);
        aur_cache_file_write("kind", "a", 5, "first");
        assert_false(is_stored("a", "first"));
    }
}

static void folders_are_found(void **state) {
    const folder *const f = *state;
    char path[128];
    unsetenv("AUREOLE_CACHE");
    setenv("XDG_CACHE_HOME", f->path, 1);
    aur_cache_file_write("kind", "a", 5, "first");
    snprintf(path, sizeof path, "%s/aureole", f->path);
    assert_int_equal(each_file(path, remove_file), 1);
    struct stat status;
    assert_int_equal(stat(path, &status), 0);
    assert_int_equal(status.st_mode & 077, 0); /* XDG: for its owner alone */
    assert_int_equal(rmdir(path), 0);
    setenv("XDG_CACHE_HOME", "not/absolute", 1);
    setenv("HOME", f->path, 1);
    aur_cache_file_write("kind", "a", 5, "first");
    snprintf(path, sizeof path, "%s/.cache/aureole", f->path);
    assert_int_equal(each_file(path, remove_file), 1);
    assert_int_equal(rmdir(path), 0);
    snprintf(path, sizeof path, "%s/.cache", f->path);
    assert_int_equal(rmdir(path), 0);
}

/* With room for four of them, the ones that were not used for the longest time go, and nothing else. */
static void oldest_go_first(void **state) {
    const folder *const f = *state;
    setenv("AUREOLE_CACHE_MIB", "1", 1);
    char *const data = malloc(MANY);
    memset(data, 'x', MANY);
    aur_cache_file_write("kind", "larger than a quarter", MANY + 1, data);
    assert_int_equal(each_file(f->cache, NULL), 0);
    char key[2] = "a", path[128];
    aur_cache_file_write("kind", key, 1, data);
    snprintf(path, sizeof path, "%s/of-others", f->cache);
    FILE *const other = fopen(path, "w");
    assert_non_null(other);
    assert_int_equal(fclose(other), 0);
    const struct timespec tick = {.tv_nsec = 20000000}; /* longer than one of the file system's clock */
    for (char c = 'b'; c <= 'e'; ++c) {
        nanosleep(&tick, NULL);
        key[0] = c;
        aur_cache_file_write("kind", key, MANY - 100, data);
    }
    nanosleep(&tick, NULL);
    assert_true(is_stored("a", "x")); /* and so it is the newest */
    nanosleep(&tick, NULL);
    aur_cache_file_write("kind", "f", MANY - 100, data);
    size_t size;
    assert_null(aur_cache_file_read("kind", "b", &size));
    for (const char *c = "cdef"; *c != '\0'; ++c) {
        key[0] = *c;
        char *const stored = aur_cache_file_read("kind", key, &size);
        assert_true(stored != NULL && size == MANY - 100 && memcmp(stored, data, size) == 0);
        free(stored);
    }
    assert_true(is_stored("a", "x"));
    assert_int_equal(access(path, F_OK), 0);
    free(data);
}

/* Processes that write and read one file: it is never anything but whole. */
static void processes_at_once(void **state) {
    (void)state;
    enum { PROCESSES = 4, ROUNDS = 200, BYTES = 50000 };
    for (size_t p = 0; p < PROCESSES; ++p)
        if (fork() == 0) {
            char *const data = malloc(BYTES);
            memset(data, 'a' + (int)p, BYTES);
            bool good = true;
            for (size_t i = 0; i < ROUNDS; ++i) {
                aur_cache_file_write("kind", "shared", BYTES, data);
                size_t size;
                char *const stored = aur_cache_file_read("kind", "shared", &size);
                good = good && stored != NULL && size == BYTES && stored[0] == stored[BYTES - 1];
                free(stored);
            }
            free(data);
            _exit(good ? 0 : 1);
        }
    for (size_t p = 0; p < PROCESSES; ++p) {
        int status = 1;
        assert_true(wait(&status) > 0);
        assert_int_equal(status, 0);
    }
}

static void builds_have_an_identity(void **state) {
    (void)state;
    assert_true(aur_build_identity() != 0);
    assert_true(aur_build_identity() == aur_build_identity());
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, make_folder, remove_folder)

int main(void) {
    const struct CMUnitTest tests[] = {
        IN_FOLDER(stores_by_key),
        IN_FOLDER(damaged_files_are_not_there),
        IN_FOLDER(nothing_where_nothing_can_be),
        IN_FOLDER(folders_are_found),
        IN_FOLDER(oldest_go_first),
        IN_FOLDER(processes_at_once),
        cmocka_unit_test(builds_have_an_identity),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
