/* The file holds the identity, then a line per measurement: "SECONDS KEY: VALUE VALUE ...". A line truncated
 * by an interruption is ignored. */
#include "program/lab/run.h"

#include <aureole/ranks.h>
#include <aureole/text.h>
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

struct lab_store {
    FILE *file; /* NULL with several ranks: nothing is stored */
    size_t count;
    char **lines; /* of the earlier run, without the identity */
    double seconds;
    char path[AUR_ERROR_FILE_CAPACITY];
};

static aur_result fail(const lab_store *store, aur_result result, const char *what, aur_error *error) {
    aur_fail(error, result, "%s", what);
    if (error != NULL)
        snprintf(error->file, sizeof error->file, "%s", store->path);
    return result;
}

static bool add_line(lab_store *store, const char *line) {
    char **const larger = realloc(store->lines, (store->count + 1) * sizeof *larger);
    if (larger == NULL)
        return false;
    store->lines = larger;
    store->lines[store->count] = strdup(line);
    return store->lines[store->count++] != NULL;
}

/* Reads the measurements if the file's identity is `identity`, and positions the file at its end. */
static aur_result take_up(lab_store *store, const char *identity, aur_error *error) {
    char *line = NULL;
    size_t capacity = 0;
    ssize_t length;
    off_t good = 0;
    bool memory = true;
    for (size_t i = 0; memory && (length = getline(&line, &capacity, store->file)) > 0; ++i) {
        if (line[length - 1] != '\n')
            break;
        line[length - 1] = '\0';
        if (i == 0 && strcmp(line, identity) != 0)
            break;
        memory = i == 0 || add_line(store, line);
        good = ftello(store->file);
    }
    free(line);
    if (!memory)
        return fail(store, AUR_ERROR_MEMORY, "out of memory", error);
    if (store->count > 0)
        store->seconds = strtod(store->lines[store->count - 1], NULL);
    if (ftruncate(fileno(store->file), good) != 0 || fseeko(store->file, good, SEEK_SET) != 0)
        return fail(store, AUR_ERROR_WRITE, strerror(errno), error);
    if (good == 0)
        fprintf(store->file, "%s\n", identity);
    return fflush(store->file) == 0 ? AUR_OK : fail(store, AUR_ERROR_WRITE, strerror(errno), error);
}

/* Opens a file for appending, and truncates it if its identity differs. Rejects links, pipes, devices and
 * hard links to other names. NULL with errno. */
static FILE *open_folder(const char *path) {
    const int descriptor =
        open(path, O_RDWR | O_APPEND | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY | O_CLOEXEC, 0666);
    struct stat status;
    if (descriptor < 0)
        return NULL;
    if (fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode) && status.st_nlink == 1)
        return fdopen(descriptor, "a+");
    close(descriptor);
    errno = EEXIST;
    return NULL;
}

aur_result lab_store_open(const char *path, const char *identity, lab_store **store, aur_error *error) {
    *store = calloc(1, sizeof **store);
    if (*store == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    snprintf((*store)->path, sizeof(*store)->path, "%s", path);
    if (aur_ranks_count() > 1)
        return AUR_OK;
    (*store)->file = open_folder(path);
    aur_result result = AUR_OK;
    if ((*store)->file == NULL)
        result = fail(*store, AUR_ERROR_WRITE, strerror(errno), error);
    else if (fseeko((*store)->file, 0, SEEK_SET) == 0)
        result = take_up(*store, identity, error);
    if (result == AUR_OK)
        return AUR_OK;
    lab_store_close(*store);
    *store = NULL;
    return result;
}

void lab_store_close(lab_store *store) {
    if (store == NULL)
        return;
    if (store->file != NULL)
        fclose(store->file);
    for (size_t i = 0; i < store->count; ++i)
        free(store->lines[i]);
    free(store->lines);
    free(store);
}

bool lab_store_continues(const lab_store *store) {
    return store->count > 0;
}

double lab_store_seconds(const lab_store *store) {
    return store->seconds;
}

bool lab_store_find(const lab_store *store, const char *key, size_t count, double *values) {
    const size_t length = strlen(key);
    for (size_t i = 0; i < store->count; ++i) {
        const char *text = store->lines[i] + strcspn(store->lines[i], " ") + 1;
        if (strncmp(text, key, length) != 0 || text[length] != ':')
            continue;
        text += length + 1;
        size_t found = 0;
        char *end;
        for (; found < count; ++found, text = end) {
            values[found] = strtod(text, &end);
            if (end == text)
                break;
        }
        if (found == count)
            return true;
    }
    return false;
}

aur_result lab_store_add(lab_store *store, const char *key, size_t count, const double *values,
                         double seconds, aur_error *error) {
    if (store->file == NULL)
        return AUR_OK;
    /* Hexadecimal digits are read back exactly. */
    aur_print(store->file, "%.1f %s:", seconds, key);
    for (size_t i = 0; i < count; ++i)
        aur_print(store->file, " %a", values[i]);
    fputc('\n', store->file);
    return fflush(store->file) == 0 ? AUR_OK : fail(store, AUR_ERROR_WRITE, strerror(errno), error);
}
