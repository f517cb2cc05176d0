#if defined(__linux__) && !defined(_GNU_SOURCE)
#define _GNU_SOURCE /* O_TMPFILE */
#endif
#include "points/base/file.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "points/base/array.h"
#include "points/base/io.h"

static aur_result fail_write(aur_error *error, const char *path, int code) {
    return aur_fail_at(error, (aur_location){.file = path}, AUR_ERROR_WRITE, "cannot write: %s",
                       strerror(code));
}

/* The length of the folder of `path` with the slash. */
static size_t folder_length(const char *path) {
    const char *const slash = strrchr(path, '/');
    return slash != NULL ? (size_t)(slash - path) + 1 : 0;
}

/* Gives the file a unique name in the folder of its destination: by `link` if it has none, otherwise by
 * open(2). The name does not contain the destination's, which may have the maximal length. Returns the result
 * of `link` or open, or -1 with errno. */
static int take_name(aur_file_writer *writer, int nameless) {
    const size_t folder = folder_length(writer->path);
    const size_t capacity = folder + sizeof ".aureole-12345678-123.tmp";
    writer->temporary = malloc(capacity);
    if (writer->temporary == NULL) {
        errno = ENOMEM;
        return -1;
    }
    memcpy(writer->temporary, writer->path, folder);
    for (unsigned attempt = 0; attempt < 1000; ++attempt) {
        snprintf(writer->temporary + folder, capacity - folder, ".aureole-%08x-%03u.tmp", (unsigned)getpid(),
                 attempt);
        char source[40];
        snprintf(source, sizeof source, "/proc/self/fd/%d", nameless);
        const int got =
            nameless < 0 ? open(writer->temporary, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666)
                         : linkat(AT_FDCWD, source, AT_FDCWD, writer->temporary, AT_SYMLINK_FOLLOW);
        if (got >= 0)
            return got;
        if (errno != EEXIST)
            break;
    }
    const int code = errno;
    free(writer->temporary);
    writer->temporary = NULL;
    errno = code;
    return -1;
}

/* Opens the folder of `path`; -1 with errno on failure. */
static int open_folder(const char *path, int flags) {
    const size_t length = folder_length(path);
    char *const folder = length > 0 ? strndup(path, length) : strdup(".");
    const int descriptor = folder != NULL ? open(folder, flags | O_CLOEXEC, 0666) : -1;
    free(folder);
    return descriptor;
}

/* Opens a file without a name (O_TMPFILE), so that nothing is left behind when the process is killed; -1 if
 * the system does not support it. */
static int open_nameless(const char *path) {
#if defined(O_TMPFILE)
    return access("/proc/self/fd", X_OK) == 0 ? open_folder(path, O_TMPFILE | O_WRONLY) : -1;
#else
    (void)path;
    return -1;
#endif
}

/* The new file gets the owner, the group and the mode of the replaced one, as far as permitted. If the group
 * cannot be set, the new group gets the permissions of others. */
static void copy_status(int descriptor, const struct stat *old) {
    mode_t mode = old->st_mode & 07777;
    if (fchown(descriptor, old->st_uid, old->st_gid) != 0 && fchown(descriptor, (uid_t)-1, old->st_gid) != 0)
        mode = (mode & 0707) | (mode & 07) << 3;
    (void)fchmod(descriptor, mode);
}

/* Resolves links at the end of the path, also if the last one points to a missing file; NULL: out of memory.
 */
static char *end_of_links(const char *path) {
    enum { MOST_LINKS = 40 }; /* as in Linux */
    char target[PATH_MAX];
    char *at = strdup(path);
    for (size_t i = 0; i < MOST_LINKS && at != NULL; ++i) {
        const ssize_t length = readlink(at, target, sizeof target);
        if (length <= 0 || (size_t)length == sizeof target)
            break;
        const size_t folder = target[0] == '/' ? 0 : folder_length(at);
        char *const next = malloc(folder + (size_t)length + 1);
        if (next != NULL) {
            memcpy(next, at, folder);
            memcpy(next + folder, target, (size_t)length);
            next[folder + (size_t)length] = '\0';
        }
        free(at);
        at = next;
    }
    return at;
}

aur_result aur_file_open(const char *path, aur_file_writer *writer, aur_error *error) {
    *writer = (aur_file_writer){0};
    if (!aur_io_leads()) {
        writer->path = strdup(path);
        writer->stream = writer->path != NULL ? fopen("/dev/null", "wb") : NULL;
        if (writer->stream != NULL)
            return AUR_OK;
        aur_file_abandon(writer);
        return aur_fail_memory(error);
    }
    if (strcmp(path, "-") == 0) {
        writer->path = strdup(path);
        writer->stream = stdout;
        return writer->path != NULL ? AUR_OK : aur_fail_memory(error);
    }
    struct stat status;
    const bool exists = stat(path, &status) == 0;
    const aur_result refused = exists ? aur_file_refuse_input(path, &status, error) : AUR_OK;
    if (refused != AUR_OK)
        return refused;
    /* The target of a link is replaced, and the link remains. */
    writer->path = end_of_links(path);
    if (writer->path == NULL)
        return aur_fail_memory(error);
    if (!exists || S_ISREG(status.st_mode)) {
        int descriptor = open_nameless(writer->path);
        writer->nameless = descriptor >= 0;
        if (descriptor < 0)
            descriptor = take_name(writer, -1);
        if (descriptor >= 0 && exists)
            copy_status(descriptor, &status);
        writer->stream = descriptor >= 0 ? fdopen(descriptor, "wb") : NULL;
        if (writer->stream == NULL && descriptor >= 0)
            close(descriptor);
    } else {
        /* A pipe or a device cannot be replaced by a rename: it is written in place. A folder fails here. */
        writer->stream = fopen(path, "wb");
    }
    if (writer->stream != NULL)
        return AUR_OK;
    const int code = errno;
    aur_file_abandon(writer);
    return fail_write(error, path, code);
}

/* The reason for an earlier failed write: errno is lost by now, so the write is repeated. */
static int reason_of_failure(FILE *stream) {
    clearerr(stream);
    errno = 0;
    if (fputc(0, stream) == EOF || fflush(stream) != 0)
        return errno != 0 ? errno : EIO;
    return EIO;
}

/* Makes the rename durable. Some file systems do not support this for folders; the file is complete anyway.
 */
static void sync_folder(const char *path) {
    const int descriptor = open_folder(path, O_RDONLY | O_DIRECTORY);
    if (descriptor >= 0) {
        (void)fsync(descriptor);
        close(descriptor);
    }
}

aur_result aur_file_commit(aur_file_writer *writer, aur_error *error) {
    int code = 0;
    errno = 0;
    if (ferror(writer->stream))
        code = reason_of_failure(writer->stream);
    else if (fflush(writer->stream) != 0)
        code = errno != 0 ? errno : EIO;
    const bool replaces = writer->nameless || writer->temporary != NULL;
    if (code == 0 && replaces && !writer->unsynced && fsync(fileno(writer->stream)) != 0)
        code = errno;
    if (code == 0 && writer->nameless && take_name(writer, fileno(writer->stream)) < 0)
        code = errno;
    if (writer->stream != stdout && fclose(writer->stream) != 0 && code == 0)
        code = errno;
    writer->stream = NULL;
    if (code == 0 && replaces) {
        if (rename(writer->temporary, writer->path) != 0) {
            code = errno;
        } else {
            free(writer->temporary);
            writer->temporary = NULL;
            if (!writer->unsynced)
                sync_folder(writer->path);
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
        fwrite(data, 1, size, writer.stream); /* the stream stores a failure until the commit */
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

static aur_result fail_read(aur_error *error, const char *path, const char *why) {
    return aur_fail_at(error, (aur_location){.file = path}, AUR_ERROR_OPEN, "cannot read: %s", why);
}

/* Why a file is not accepted as input, or NULL. /dev/fd/N of a shell is open already. */
static const char *refusal_of(const char *path, mode_t mode) {
    static const char *const handed[] = {"/dev/fd/", "/proc/self/fd/", "/dev/stdin"};
    for (size_t i = 0; i < sizeof handed / sizeof *handed; ++i)
        if (strncmp(path, handed[i], strlen(handed[i])) == 0)
            return NULL;
    return S_ISREG(mode)    ? NULL
           : S_ISDIR(mode)  ? strerror(EISDIR)
           : S_ISFIFO(mode) ? "it is a pipe, and a file is expected"
                            : "it is a device, and a file is expected";
}

/* NULL if it cannot be read or is not accepted. Opening never blocks on a pipe. */
static FILE *open_input(const char *path, aur_error *error) {
    const int descriptor = open(path, O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
    struct stat status;
    if (descriptor < 0 || fstat(descriptor, &status) != 0) {
        fail_read(error, path, strerror(errno));
        if (descriptor >= 0)
            close(descriptor);
        return NULL;
    }
    const char *const refusal = refusal_of(path, status.st_mode);
    if (refusal != NULL)
        fail_read(error, path, refusal);
    else
        (void)fcntl(descriptor, F_SETFL, fcntl(descriptor, F_GETFL) & ~O_NONBLOCK);
    FILE *const stream = refusal == NULL ? fdopen(descriptor, "rb") : NULL;
    if (stream == NULL && refusal == NULL)
        aur_fail_memory(error);
    if (stream == NULL)
        close(descriptor);
    return stream;
}

static aur_result read_here(const char *path, size_t limit, bool input, char **data, size_t *size,
                            aur_error *error) {
    const aur_location where = {.file = path};
    const bool standard = strcmp(path, "-") == 0;
    aur_error read_error = {.result = AUR_OK};
    if (error == NULL)
        error = &read_error;
    FILE *const stream = standard ? stdin : open_input(path, error);
    if (stream == NULL)
        return error->result;
    char *buffer = NULL;
    size_t capacity = 0, used = 0;
    /* A regular file is read into a buffer of its size and one byte, which detects the end. */
    struct stat status;
    const bool regular = fstat(fileno(stream), &status) == 0 && S_ISREG(status.st_mode);
    const bool sized = regular && status.st_size > 0;
    aur_result result = regular && input ? aur_file_note_input(path, &status, error) : AUR_OK;
    const size_t expected = sized && (uint64_t)status.st_size < limit ? (size_t)status.st_size : 1 << 16;
    bool room = aur_array_reserve(&buffer, &capacity, expected + 2, 1);
    while (room && used <= limit && result == AUR_OK) {
        const size_t count = fread(buffer + used, 1, capacity - 1 - used, stream);
        used += count;
        if (count == 0)
            break;
        room = used < capacity - 1 || aur_array_reserve(&buffer, &capacity, capacity + 1, 1);
    }
    if (result == AUR_OK && !room)
        result = aur_fail_memory(error);
    else if (result == AUR_OK && ferror(stream))
        result = fail_read(error, path, strerror(errno));
    else if (result == AUR_OK && used > limit)
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

static aur_result read_for_all(const char *path, size_t limit, bool input, char **data, size_t *size,
                               aur_error *error) {
    *data = NULL;
    *size = 0;
    const aur_io *const io = aur_io_here();
    if (io == NULL)
        return read_here(path, limit, input, data, size, error);
    aur_error said = {0};
    if (io->rank == 0)
        (void)read_here(path, limit, input, data, size, &said);
    (void)aur_io_agree(sizeof said, &said, NULL);
    if (said.result != AUR_OK) {
        if (error != NULL)
            *error = said;
        return said.result;
    }
    const aur_result result = io->share(io->user, data, size, error);
    if (result != AUR_OK && io->rank == 0) {
        free(*data);
        *data = NULL;
    }
    return result;
}

aur_result aur_file_read(const char *path, size_t limit, char **data, size_t *size, aur_error *error) {
    return read_for_all(path, limit, true, data, size, error);
}

aur_result aur_file_read_back(const char *path, size_t limit, char **data, size_t *size, aur_error *error) {
    return read_for_all(path, limit, false, data, size, error);
}

bool aur_file_status(const char *path, struct stat *status) {
    *status = (struct stat){0};
    bool exists = aur_io_leads() && stat(path, status) == 0;
    (void)aur_io_agree(sizeof exists, &exists, NULL);
    (void)aur_io_agree(sizeof *status, status, NULL);
    return exists;
}
