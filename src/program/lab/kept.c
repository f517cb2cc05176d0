/* The file is the identity, then a line for each measurement: "SECONDS KEY: VALUE VALUE ...", where a line
 * that an interruption cut off is dropped. */
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

struct lab_kept {
    FILE *file; /* NULL where there are several ranks: they keep nothing */
    size_t count;
    char **lines; /* of the earlier run, without the identity */
    double seconds;
    char path[AUR_ERROR_FILE_CAPACITY];
};

static aur_result fail(const lab_kept *kept, aur_result result, const char *what, aur_error *error) {
    aur_fail(error, result, "%s", what);
    if (error != NULL)
        snprintf(error->file, sizeof error->file, "%s", kept->path);
    return result;
}

static bool add_line(lab_kept *kept, const char *line) {
    char **const larger = realloc(kept->lines, (kept->count + 1) * sizeof *larger);
    if (larger == NULL)
        return false;
    kept->lines = larger;
    kept->lines[kept->count] = strdup(line);
    return kept->lines[kept->count++] != NULL;
}

/* Reads what belongs to `identity` and leaves the file at its end. */
static aur_result take_up(lab_kept *kept, const char *identity, aur_error *error) {
    char *line = NULL;
    size_t capacity = 0;
    ssize_t length;
    off_t good = 0;
    bool memory = true;
    for (size_t i = 0; memory && (length = getline(&line, &capacity, kept->file)) > 0; ++i) {
        if (line[length - 1] != '\n')
            break;
        line[length - 1] = '\0';
        if (i == 0 && strcmp(line, identity) != 0)
            break;
        memory = i == 0 || add_line(kept, line);
        good = ftello(kept->file);
    }
    free(line);
    if (!memory)
        return fail(kept, AUR_ERROR_MEMORY, "out of memory", error);
    if (kept->count > 0)
        kept->seconds = strtod(kept->lines[kept->count - 1], NULL);
    if (ftruncate(fileno(kept->file), good) != 0 || fseeko(kept->file, good, SEEK_SET) != 0)
        return fail(kept, AUR_ERROR_WRITE, strerror(errno), error);
    if (good == 0)
        fprintf(kept->file, "%s\n", identity);
    return fflush(kept->file) == 0 ? AUR_OK : fail(kept, AUR_ERROR_WRITE, strerror(errno), error);
}

/* A file that this program appends to, and empties where it is of something else: no link, pipe or device,
 * and under no other name. NULL with errno. */
static FILE *open_own(const char *path) {
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

aur_result lab_kept_open(const char *path, const char *identity, lab_kept **kept, aur_error *error) {
    *kept = calloc(1, sizeof **kept);
    if (*kept == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    snprintf((*kept)->path, sizeof(*kept)->path, "%s", path);
    if (aur_ranks_count() > 1)
        return AUR_OK;
    (*kept)->file = open_own(path);
    aur_result result = AUR_OK;
    if ((*kept)->file == NULL)
        result = fail(*kept, AUR_ERROR_WRITE, strerror(errno), error);
    else if (fseeko((*kept)->file, 0, SEEK_SET) == 0)
        result = take_up(*kept, identity, error);
    if (result == AUR_OK)
        return AUR_OK;
    lab_kept_close(*kept);
    *kept = NULL;
    return result;
}

void lab_kept_close(lab_kept *kept) {
    if (kept == NULL)
        return;
    if (kept->file != NULL)
        fclose(kept->file);
    for (size_t i = 0; i < kept->count; ++i)
        free(kept->lines[i]);
    free(kept->lines);
    free(kept);
}

bool lab_kept_continues(const lab_kept *kept) {
    return kept->count > 0;
}

double lab_kept_seconds(const lab_kept *kept) {
    return kept->seconds;
}

bool lab_kept_find(const lab_kept *kept, const char *key, size_t count, double *values) {
    const size_t length = strlen(key);
    for (size_t i = 0; i < kept->count; ++i) {
        const char *text = kept->lines[i] + strcspn(kept->lines[i], " ") + 1;
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

aur_result lab_kept_add(lab_kept *kept, const char *key, size_t count, const double *values, double seconds,
                        aur_error *error) {
    if (kept->file == NULL)
        return AUR_OK;
    /* Hexadecimal digits are read as the same number. */
    aur_print(kept->file, "%.1f %s:", seconds, key);
    for (size_t i = 0; i < count; ++i)
        aur_print(kept->file, " %a", values[i]);
    fputc('\n', kept->file);
    return fflush(kept->file) == 0 ? AUR_OK : fail(kept, AUR_ERROR_WRITE, strerror(errno), error);
}
