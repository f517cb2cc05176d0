/* Writes a run's stored measurements, by randomisation, as NumPy arrays: a zip of uncompressed NPY files. */
#include <aureole/text.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

#include "program/lab/run.h"

enum { MOST_ENTRIES = 65535, LOCAL_SIZE = 30, CENTRAL_SIZE = 46 };

typedef struct archive {
    FILE *to, *directory; /* in memory */
    size_t count, offset;
} archive;

static void put(FILE *to, uint32_t value, int bytes) {
    for (int i = 0; i < bytes; ++i)
        fputc((int)(value >> 8 * i & 255), to);
}

/* The fields that an entry's header and its directory record share. */
static void put_common(FILE *to, uint32_t sum, size_t size, size_t name_length) {
    put(to, 20, 2);    /* version needed */
    put(to, 0x800, 2); /* UTF-8 names */
    put(to, 0, 2);     /* stored */
    put(to, 0, 2);     /* time */
    put(to, 0x21, 2);  /* 1 January 1980 */
    put(to, sum, 4);
    put(to, (uint32_t)size, 4);
    put(to, (uint32_t)size, 4);
    put(to, (uint32_t)name_length, 2);
    put(to, 0, 2); /* extra */
}

static void put_entry(archive *of, const char *name, const char *data, size_t size) {
    const uint32_t sum = (uint32_t)crc32(0, (const unsigned char *)data, (unsigned)size);
    const size_t length = strlen(name);
    put(of->to, 0x04034b50, 4);
    put_common(of->to, sum, size, length);
    fwrite(name, 1, length, of->to);
    fwrite(data, 1, size, of->to);
    put(of->directory, 0x02014b50, 4);
    put(of->directory, 20, 2);
    put_common(of->directory, sum, size, length);
    put(of->directory, 0, 4); /* comment, disk */
    put(of->directory, 0, 2);
    put(of->directory, 0, 4);
    put(of->directory, (uint32_t)of->offset, 4);
    fwrite(name, 1, length, of->directory);
    of->offset += LOCAL_SIZE + length + size;
    ++of->count;
}

/* Ends the archive: appends the directory to the entries. */
static bool finish(archive *of, char **directory, size_t *size) {
    if (fclose(of->directory) != 0)
        return false;
    fwrite(*directory, 1, *size, of->to);
    put(of->to, 0x06054b50, 4);
    put(of->to, 0, 4);
    put(of->to, (uint32_t)of->count, 2);
    put(of->to, (uint32_t)of->count, 2);
    put(of->to, (uint32_t)*size, 4);
    put(of->to, (uint32_t)of->offset, 4);
    put(of->to, 0, 2);
    return fclose(of->to) == 0;
}

/* Writes a line of the store, "SECONDS KEY: VALUE VALUE ...", as a one-dimensional array. */
static void put_line(archive *of, char *line) {
    char *const key = line + strcspn(line, " ") + (strchr(line, ' ') != NULL);
    char *colon = strrchr(key, ':'), *end, *data = NULL, name[512], shape[160];
    size_t count = 0, size = 0;
    if (colon == NULL || of->count == MOST_ENTRIES)
        return;
    *colon = '\0';
    const char *at = colon + 1;
    for (; strtod(at, &end), end != at; at = end)
        ++count;
    snprintf(name, sizeof name, "%s.npy", key);
    for (char *letter = name; *letter != '\0'; ++letter)
        *letter = *letter == '/' ? '_' : *letter;
    FILE *const to = open_memstream(&data, &size);
    if (to == NULL)
        return;
    snprintf(shape, sizeof shape, "{'descr': '<f8', 'fortran_order': False, 'shape': (%zu,), }", count);
    fwrite("\x93NUMPY\x01\x00\x76\x00", 1, 10, to); /* 118 bytes of header follow: 128 in all */
    fprintf(to, "%-117s\n", shape);
    at = colon + 1;
    for (size_t i = 0; i < count; ++i, at = end) {
        const double value = strtod(at, &end);
        uint64_t bits;
        memcpy(&bits, &value, sizeof bits);
        put(to, (uint32_t)bits, 4);
        put(to, (uint32_t)(bits >> 32), 4);
    }
    if (fclose(to) == 0)
        put_entry(of, name, data, size);
    free(data);
}

aur_result lab_store_export(const char *store, const char *path, bool *written, aur_error *error) {
    char *text = NULL, *directory = NULL, *line = NULL;
    size_t size = 0, directory_size = 0, capacity = 0;
    *written = false;
    FILE *const from = fopen(store, "r");
    if (from == NULL)
        return AUR_OK;
    archive of = {.to = open_memstream(&text, &size),
                  .directory = open_memstream(&directory, &directory_size)};
    bool good = of.to != NULL && of.directory != NULL;
    for (bool first = true; good && getline(&line, &capacity, from) > 0; first = false)
        if (!first) /* the first line is the identity */
            put_line(&of, line);
    fclose(from);
    good = good && finish(&of, &directory, &directory_size);
    aur_result result = good ? AUR_OK : aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    if (good && of.count > 0) {
        result = aur_file_write(path, size, text, error);
        *written = result == AUR_OK;
    }
    free(line);
    free(text);
    free(directory);
    return result;
}
