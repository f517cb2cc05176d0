#include "core/file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static aur_result fail_write(aur_error *error, const char *path, int code) {
    return aur_fail_at(error, (aur_location){.file = path}, AUR_ERROR_WRITE, "cannot write: %s",
                       strerror(code));
}

/* The permissions that open() with mode 0666 would give; mkstemp gives 0600. The umask can only be read by
 * setting it, which is process-wide state, so a file of our own is asked instead. */
static int create_beside(char *temporary) {
    const size_t length = strlen(temporary);
    for (unsigned attempt = 0; attempt < 1000; ++attempt) {
        snprintf(temporary + length - 9, 10, "%05x.%03u", (unsigned)getpid() & 0xfffffu, attempt);
        const int descriptor = open(temporary, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (descriptor >= 0 || errno != EEXIST)
            return descriptor;
    }
    return -1;
}

aur_result aur_file_open(const char *path, aur_file_writer *writer, aur_error *error) {
    *writer = (aur_file_writer){0};
    writer->path = strdup(path);
    if (writer->path == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    if (strcmp(path, "-") == 0) {
        writer->stream = stdout;
        return AUR_OK;
    }
    struct stat status;
    if (stat(path, &status) == 0 && !S_ISREG(status.st_mode)) {
        /* A pipe or a device cannot be replaced by a rename: write to it as it is. A folder fails here. */
        writer->stream = fopen(path, "wb");
        if (writer->stream == NULL) {
            const int code = errno;
            aur_file_abandon(writer);
            return fail_write(error, path, code);
        }
        return AUR_OK;
    }
    const size_t capacity = strlen(path) + sizeof ".tmp.12345.123";
    writer->temporary = malloc(capacity);
    if (writer->temporary == NULL) {
        aur_file_abandon(writer);
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    }
    snprintf(writer->temporary, capacity, "%s.tmp.12345.123", path);
    const int descriptor = create_beside(writer->temporary);
    writer->stream = descriptor >= 0 ? fdopen(descriptor, "wb") : NULL;
    if (writer->stream == NULL) {
        const int code = errno;
        if (descriptor >= 0) {
            close(descriptor);
            unlink(writer->temporary);
        }
        free(writer->temporary);
        writer->temporary = NULL;
        aur_file_abandon(writer);
        return fail_write(error, path, code);
    }
    return AUR_OK;
}

aur_result aur_file_commit(aur_file_writer *writer, aur_error *error) {
    int code = 0;
    errno = 0;
    if (fflush(writer->stream) != 0 || ferror(writer->stream))
        code = errno != 0 ? errno : EIO;
    if (code == 0 && writer->temporary != NULL && fsync(fileno(writer->stream)) != 0)
        code = errno;
    if (writer->stream != stdout && fclose(writer->stream) != 0 && code == 0)
        code = errno;
    writer->stream = NULL;
    if (code == 0 && writer->temporary != NULL) {
        if (rename(writer->temporary, writer->path) != 0) {
            code = errno;
        } else {
            free(writer->temporary);
            writer->temporary = NULL;
        }
    }
    const aur_result result = code == 0 ? AUR_OK : fail_write(error, writer->path, code);
    aur_file_abandon(writer);
    return result;
}

aur_result aur_file_write(const char *path, size_t size, const void *data, aur_error *error) {
    aur_file_writer writer;
    const aur_result result = aur_file_open(path, &writer, error);
    if (result != AUR_OK)
        return result;
    if (size > 0)
        fwrite(data, 1, size, writer.stream); /* the stream remembers a failure until the commit */
    return aur_file_commit(&writer, error);
}

void aur_file_abandon(aur_file_writer *writer) {
    if (writer->stream != NULL && writer->stream != stdout)
        fclose(writer->stream);
    if (writer->temporary != NULL)
        unlink(writer->temporary);
    free(writer->temporary);
    free(writer->path);
    *writer = (aur_file_writer){0};
}

aur_result aur_file_read(const char *path, size_t limit, char **data, size_t *size, aur_error *error) {
    *data = NULL;
    *size = 0;
    const aur_location where = {.file = path};
    const int standard = strcmp(path, "-") == 0;
    FILE *const stream = standard ? stdin : fopen(path, "rb");
    if (stream == NULL)
        return aur_fail_at(error, where, AUR_ERROR_OPEN, "cannot read: %s", strerror(errno));
    aur_result result = AUR_OK;
    size_t capacity = 1 << 16;
    size_t used = 0;
    char *buffer = malloc(capacity);
    while (buffer != NULL) {
        used += fread(buffer + used, 1, capacity - 1 - used, stream);
        if (used < capacity - 1)
            break;
        if (capacity > limit)
            break;
        char *const larger = realloc(buffer, capacity * 2);
        if (larger == NULL)
            free(buffer);
        buffer = larger;
        capacity *= 2;
    }
    if (buffer == NULL)
        result = aur_fail_at(error, where, AUR_ERROR_MEMORY, "out of memory");
    else if (ferror(stream))
        result = aur_fail_at(error, where, AUR_ERROR_OPEN, "cannot read: %s", strerror(errno));
    else if (used > limit)
        result = aur_fail_at(error, where, AUR_ERROR_FORMAT, "file is larger than %zu bytes", limit);
    if (!standard)
        fclose(stream);
    if (result != AUR_OK) {
        free(buffer);
        return result;
    }
    buffer[used] = '\0';
    *data = buffer;
    *size = used;
    return AUR_OK;
}
