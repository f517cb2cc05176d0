#include "points/base/file.h"

#include <libgen.h>
#include <limits.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/array.h"

/* Identifies an existing file by its inode, also through links; a missing one by its folder and name. */
typedef struct file_identity {
    bool exists;
    dev_t device; /* of the file or its folder */
    ino_t inode;
    struct timespec changed; /* of an input: an inode may be reused after the file is deleted */
    char name[NAME_MAX + 1]; /* if it does not exist */
} file_identity;

typedef struct file_set {
    size_t count, capacity;
    file_identity *files;
} file_set;

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static file_set outputs, inputs;

static file_identity of_status(const struct stat *status) {
    return (file_identity){
        .exists = true, .device = status->st_dev, .inode = status->st_ino, .changed = status->st_mtim};
}

/* False for a path that cannot be replaced: a pipe, a device, or a missing folder. */
static bool identify(const char *path, file_identity *identity) {
    struct stat status;
    char folder[PATH_MAX], name[PATH_MAX];
    if (stat(path, &status) == 0) {
        *identity = of_status(&status);
        return S_ISREG(status.st_mode);
    }
    if (snprintf(folder, sizeof folder, "%s", path) >= PATH_MAX || stat(dirname(folder), &status) != 0)
        return false;
    snprintf(name, sizeof name, "%s", path);
    *identity = (file_identity){.device = status.st_dev, .inode = status.st_ino};
    const char *const last = basename(name);
    memcpy(identity->name, last, strnlen(last, NAME_MAX));
    return true;
}

static bool is_in(const file_set *set, const file_identity *file) {
    for (size_t i = 0; i < set->count; ++i) {
        const file_identity *const entry = &set->files[i];
        if (entry->exists == file->exists && entry->device == file->device && entry->inode == file->inode &&
            strcmp(entry->name, file->name) == 0)
            return true;
    }
    return false;
}

static bool add(file_set *set, const file_identity *file) {
    if (is_in(set, file))
        return true;
    if (!aur_array_reserve(&set->files, &set->capacity, set->count + 1, sizeof *set->files))
        return false;
    set->files[set->count++] = *file;
    return true;
}

aur_result aur_file_announce_output(const char *path, aur_error *error) {
    file_identity file;
    if (strcmp(path, "-") == 0 || !identify(path, &file))
        return AUR_OK;
    const aur_location where = {.file = path};
    pthread_mutex_lock(&lock);
    const bool twice = is_in(&outputs, &file), read = is_in(&inputs, &file);
    const bool recorded = twice || read || add(&outputs, &file);
    pthread_mutex_unlock(&lock);
    if (twice)
        return aur_fail_at(error, where, AUR_ERROR_ARGUMENT,
                           "two outputs must not be the same file: the second would replace the first");
    if (read)
        return aur_fail_at(error, where, AUR_ERROR_ARGUMENT,
                           "an input of this command must not be its output: choose another file");
    return recorded ? AUR_OK : aur_fail_memory(error);
}

aur_result aur_file_note_input(const char *path, const struct stat *status, aur_error *error) {
    const file_identity file = of_status(status);
    pthread_mutex_lock(&lock);
    const bool guarded = outputs.count > 0, written = guarded && is_in(&outputs, &file);
    const bool recorded = !guarded || written || add(&inputs, &file);
    pthread_mutex_unlock(&lock);
    if (written)
        return aur_fail_at(error, (aur_location){.file = path}, AUR_ERROR_ARGUMENT,
                           "an output of this command must not be its input: choose another file");
    return recorded ? AUR_OK : aur_fail_memory(error);
}

aur_result aur_file_refuse_input(const char *path, const struct stat *status, aur_error *error) {
    const file_identity file = of_status(status);
    bool read = false;
    pthread_mutex_lock(&lock);
    for (size_t i = 0; i < inputs.count; ++i) {
        const file_identity *const entry = &inputs.files[i];
        read = read || (entry->device == file.device && entry->inode == file.inode &&
                        entry->changed.tv_sec == file.changed.tv_sec &&
                        entry->changed.tv_nsec == file.changed.tv_nsec);
    }
    pthread_mutex_unlock(&lock);
    return read ? aur_fail_at(error, (aur_location){.file = path}, AUR_ERROR_ARGUMENT,
                              "an input of this command must not be its output: choose another file")
                : AUR_OK;
}
