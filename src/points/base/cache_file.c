
#include <dirent.h>
#include <fcntl.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "points/base/array.h"
#include "points/base/file.h"
#include "points/base/io.h"
#include "points/base/text.h"
#include "points/base/words.h"

/* A file is the data, the key, and three words of 8 bytes in the machine's own order: the key's length, a
 * hash of both, and a magic number, which also detects files of the other byte order.
 */
enum { PATH_CAPACITY = 4096, WORDS = 3, DEFAULT_MEBIBYTES = 1024 };

static const uint64_t mark = UINT64_C(0x6175726b65707431);
static const char suffix[] = ".aureole",
                  unfinished[] = ".aureole-"; /* the latter: names of points/base/file.c */

/* False if there is no such folder. */
static bool find_folder(char folder[PATH_CAPACITY]) {
    const char *const chosen = getenv("AUREOLE_CACHE");
    const char *const shared = getenv("XDG_CACHE_HOME");
    const char *const home = getenv("HOME");
    int length = -1;
    if (chosen != NULL)
        length = snprintf(folder, PATH_CAPACITY, "%s", chosen);
    else if (shared != NULL && shared[0] == '/')
        length = snprintf(folder, PATH_CAPACITY, "%s/aureole", shared);
    else if (home != NULL && home[0] == '/')
        length = snprintf(folder, PATH_CAPACITY, "%s/.cache/aureole", home);
    return length > 0 && length < PATH_CAPACITY;
}

static bool find_path(const char *folder, const char *kind, const char *key, char path[PATH_CAPACITY]) {
    const int length = snprintf(path, PATH_CAPACITY, "%s/%s-%016" PRIx64 "%s", folder, kind,
                                aur_hash_bytes(strlen(key), key), suffix);
    return length > 0 && length < PATH_CAPACITY;
}

static uint64_t limit_in_bytes(void) {
    const char *const text = getenv("AUREOLE_CACHE_MIB");
    uint64_t mebibytes = DEFAULT_MEBIBYTES;
    if (text != NULL && !aur_parse_integer(text, (uint64_t)1 << 40, &mebibytes))
        mebibytes = DEFAULT_MEBIBYTES;
    return mebibytes << 20;
}

static uint64_t hash_of(size_t size, const void *data, const char *key) {
    return aur_hash2(aur_hash_bytes(size, data), aur_hash_bytes(strlen(key), key));
}

/* --- reading */

static char *read_here(const char *kind, const char *key, size_t *size) {
    char folder[PATH_CAPACITY], path[PATH_CAPACITY];
    char *data = NULL;
    size_t whole = 0;
    *size = 0;
    if (!find_folder(folder) || !find_path(folder, kind, key, path) ||
        aur_file_read_back(path, SIZE_MAX / 2, &data, &whole, NULL) != AUR_OK)
        return NULL;
    const size_t length = strlen(key), least = length + WORDS * sizeof(uint64_t);
    uint64_t words[WORDS] = {0};
    if (whole >= least) {
        *size = whole - least;
        memcpy(words, data + *size + length, sizeof words);
    }
    if (words[2] != mark || words[0] != length || memcmp(data + *size, key, length) != 0 ||
        words[1] != hash_of(*size, data, key)) {
        free(data);
        return NULL;
    }
    (void)utimensat(AT_FDCWD, path, NULL, 0); /* mark as used */
    data[*size] = '\0';
    return data;
}

/* One of several processes reads for all. */
char *aur_cache_file_read(const char *kind, const char *key, size_t *size) {
    const bool reads = aur_io_leads();
    const aur_io *const io = aur_io_use(NULL);
    char *data = reads ? read_here(kind, key, size) : NULL;
    aur_io_use(io);
    bool found = data != NULL;
    (void)aur_io_agree(sizeof found, &found, NULL);
    if (io == NULL || !found)
        return data;
    char *const local = data;
    if (io->share(io->user, &data, size, NULL) == AUR_OK)
        return data;
    free(local);
    return NULL;
}

/* --- writing */

static void make_folders(const char *folder) {
    char part[PATH_CAPACITY];
    for (size_t i = 1; folder[i - 1] != '\0'; ++i) {
        if (folder[i] != '/' && folder[i] != '\0')
            continue;
        memcpy(part, folder, i);
        part[i] = '\0';
        /* Errors here show again when the file is opened. */
        (void)mkdir(part, 0700);
    }
}

typedef struct cached_file {
    char name[256];
    uint64_t size;
    struct timespec used;
} cached_file;

static int by_use(const void *a, const void *b) {
    const cached_file *const x = a, *const y = b;
    if (x->used.tv_sec != y->used.tv_sec)
        return x->used.tv_sec < y->used.tv_sec ? -1 : 1;
    if (x->used.tv_nsec != y->used.tv_nsec)
        return x->used.tv_nsec < y->used.tv_nsec ? -1 : 1;
    return strcmp(x->name, y->name);
}

/* Other files in the folder are not touched; unfinished files of killed processes count. */
static bool is_ours(const char *name) {
    const size_t length = strlen(name), end = sizeof suffix - 1;
    return (length > end && strcmp(name + length - end, suffix) == 0) ||
           strncmp(name, unfinished, sizeof unfinished - 1) == 0;
}

static void remove_oldest(const char *path, uint64_t limit) {
    DIR *const folder = opendir(path);
    cached_file *files = NULL;
    size_t count = 0, capacity = 0;
    uint64_t sum = 0;
    for (struct dirent *entry; folder != NULL && (entry = readdir(folder)) != NULL;) {
        struct stat status;
        if (!is_ours(entry->d_name) || strlen(entry->d_name) >= sizeof files->name ||
            fstatat(dirfd(folder), entry->d_name, &status, AT_SYMLINK_NOFOLLOW) != 0 ||
            !S_ISREG(status.st_mode) || !aur_array_reserve(&files, &capacity, count + 1, sizeof *files))
            continue;
        cached_file *const file = &files[count++];
        *file = (cached_file){.size = (uint64_t)status.st_size, .used = status.st_mtim};
        memcpy(file->name, entry->d_name, strlen(entry->d_name) + 1);
        sum += file->size;
    }
    if (files != NULL && sum > limit)
        qsort(files, count, sizeof *files, by_use);
    for (size_t i = 0; i < count && sum > limit; ++i) {
        /* Another process may have removed it. */
        (void)unlinkat(dirfd(folder), files[i].name, 0);
        sum -= files[i].size;
    }
    free(files);
    if (folder != NULL)
        closedir(folder);
}

void aur_cache_file_write(const char *kind, const char *key, size_t size, const void *data) {
    char folder[PATH_CAPACITY], path[PATH_CAPACITY];
    const uint64_t limit = limit_in_bytes();
    if (!aur_io_leads() || size > limit / 4 || !find_folder(folder) || !find_path(folder, kind, key, path))
        return;
    struct stat status;
    if (stat(path, &status) == 0 &&
        !S_ISREG(status.st_mode)) /* it would be written in place: a pipe blocks */
        return;
    const uint64_t words[WORDS] = {strlen(key), hash_of(size, data, key), mark};
    make_folders(folder);
    aur_file_writer writer;
    if (aur_file_open(path, &writer, NULL) != AUR_OK)
        return;
    writer.unsynced = true; /* the hash detects damage by a loss of power */
    fwrite(data, 1, size, writer.stream);
    fwrite(key, 1, strlen(key), writer.stream);
    fwrite(words, sizeof words, 1, writer.stream);
    if (aur_file_commit(&writer, NULL) == AUR_OK)
        remove_oldest(folder, limit);
}
