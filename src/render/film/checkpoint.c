/* The file: 64-bit little-endian words with a hash of themselves - a magic number, the identity's size and
 * bytes, the words, the size of each film in bytes - and then the films as aur_film_save writes them. */
#include "render/film/film.h"

#include <stdlib.h>
#include <string.h>

#include "points/base/error.h"
#include "points/base/file.h"
#include "points/base/io.h"
#include "points/base/words.h"

/* "AURCHKP2" */
static const uint64_t magic = UINT64_C(0x32504b4843525541);
static const char any_version[] = "AURCHKP";

enum { MOST_FILMS = 64 };

static void put_identity(aur_word_writer *writer, const char *identity) {
    const size_t size = strlen(identity);
    aur_word_put(writer, size);
    for (size_t i = 0; i < size; i += 8) {
        uint64_t word = 0;
        for (size_t k = 0; k < 8 && i + k < size; ++k)
            word |= (uint64_t)(unsigned char)identity[i + k] << 8 * k;
        aur_word_put(writer, word);
    }
}

aur_result aur_checkpoint_save(const char *path, const char *identity, size_t word_count,
                               const uint64_t *words, size_t film_count, const aur_film *const *films,
                               aur_error *error) {
    aur_file_writer file;
    const aur_result result = aur_file_open(path, &file, error);
    if (result != AUR_OK)
        return result;
    aur_word_writer writer = {.stream = file.stream};
    aur_word_put(&writer, magic);
    put_identity(&writer, identity);
    aur_word_put(&writer, word_count);
    for (size_t i = 0; i < word_count; ++i)
        aur_word_put(&writer, words[i]);
    aur_word_put(&writer, film_count);
    for (size_t i = 0; i < film_count; ++i)
        aur_word_put(&writer, aur_film_file_size(films[i]));
    aur_word_put(&writer, writer.hash);
    for (size_t i = 0; i < film_count; ++i)
        aur_film_write(films[i], file.stream);
    return aur_file_commit(&file, error);
}

static aur_result damaged(const char *name, const char *why, aur_error *error) {
    return aur_fail_at(error, (aur_location){.file = name}, AUR_ERROR_FORMAT, "%s", why);
}

/* A count that is followed by at least that many words; otherwise 0, and the reader fails. */
static size_t get_count(aur_word_reader *reader, uint64_t bytes_each) {
    const uint64_t count = aur_word_get(reader);
    if (!reader->failed && count / 8 <= aur_words_left(reader) / bytes_each)
        return (size_t)count;
    reader->failed = true;
    return 0;
}

static aur_result get_identity(aur_word_reader *reader, char **identity, aur_error *error) {
    const size_t size = get_count(reader, 1);
    *identity = calloc(1, size + 9);
    if (*identity == NULL)
        return aur_fail_memory(error);
    for (size_t i = 0; i < size; i += 8) {
        const uint64_t word = aur_word_get(reader);
        for (size_t k = 0; k < 8; ++k)
            (*identity)[i + k] = (char)(word >> 8 * k);
    }
    (*identity)[size] = '\0';
    return AUR_OK;
}

static aur_result get_words(aur_word_reader *reader, aur_checkpoint *checkpoint, aur_error *error) {
    checkpoint->word_count = get_count(reader, 8);
    checkpoint->words = malloc((checkpoint->word_count + 1) * sizeof *checkpoint->words);
    if (checkpoint->words == NULL)
        return aur_fail_memory(error);
    for (size_t i = 0; i < checkpoint->word_count; ++i)
        checkpoint->words[i] = aur_word_get(reader);
    return AUR_OK;
}

aur_result aur_checkpoint_load_memory(const char *name, size_t size, const void *data,
                                      aur_checkpoint *checkpoint, aur_error *error) {
    *checkpoint = (aur_checkpoint){0};
    aur_word_reader reader = {.at = data, .end = (const unsigned char *)data + size};
    uint64_t sizes[MOST_FILMS];
    if (aur_word_get(&reader) != magic)
        return damaged(
            name,
            size >= sizeof magic && memcmp(data, any_version, sizeof any_version - 1) == 0
                ? "a checkpoint of another version of the program, which stores samples otherwise: "
                  "render again without --resume, or go on with that version"
                : "not a checkpoint",
            error);
    aur_result result = get_identity(&reader, &checkpoint->identity, error);
    if (result == AUR_OK)
        result = get_words(&reader, checkpoint, error);
    if (result != AUR_OK)
        return result;
    const uint64_t film_count = aur_word_get(&reader);
    for (size_t i = 0; i < film_count && film_count <= MOST_FILMS; ++i)
        sizes[i] = aur_word_get(&reader);
    if (film_count > MOST_FILMS || !aur_word_check(&reader))
        return damaged(name, "a checkpoint that is cut short or damaged", error);
    checkpoint->films = calloc((size_t)film_count + 1, sizeof(aur_film *));
    if (checkpoint->films == NULL)
        return aur_fail_memory(error);
    for (size_t i = 0; i < film_count; ++i) {
        if (sizes[i] > (size_t)(reader.end - reader.at))
            return damaged(name, "a checkpoint that is cut short", error);
        result = aur_film_load_memory(name, (size_t)sizes[i], reader.at, &checkpoint->films[i], error);
        if (result != AUR_OK)
            return result;
        ++checkpoint->film_count;
        reader.at += sizes[i];
    }
    return AUR_OK;
}

aur_result aur_checkpoint_load(const char *path, bool input, aur_checkpoint *checkpoint, aur_error *error) {
    char *data = NULL;
    size_t size = 0;
    *checkpoint = (aur_checkpoint){0};
    const size_t limit = (size_t)1 << 42;
    aur_result result = input ? aur_file_read(path, limit, &data, &size, error)
                              : aur_file_read_back(path, limit, &data, &size, error);
    if (result == AUR_OK)
        result = aur_checkpoint_load_memory(path, size, data, checkpoint, error);
    free(data);
    return result;
}

aur_result aur_render_check_checkpoint(const char *path, aur_error *error) {
    struct stat status;
    if (!aur_file_status(path, &status))
        return AUR_OK;
    bool good = S_ISREG(status.st_mode) && status.st_size == 0;
    if (S_ISREG(status.st_mode) && !good && aur_io_leads()) {
        char start[sizeof magic] = {0};
        FILE *const stream = fopen(path, "rb");
        good = stream != NULL && fread(start, sizeof start, 1, stream) == 1 &&
               memcmp(start, any_version, sizeof any_version - 1) == 0;
        if (stream != NULL)
            fclose(stream);
    }
    (void)aur_io_agree(sizeof good, &good, NULL);
    return good ? AUR_OK
                : aur_fail_at(error, (aur_location){.file = path}, AUR_ERROR_ARGUMENT,
                              "a checkpoint must not replace another kind of file: choose another name");
}

void aur_checkpoint_release(aur_checkpoint *checkpoint) {
    for (size_t i = 0; i < checkpoint->film_count; ++i)
        aur_film_destroy(checkpoint->films[i]);
    free(checkpoint->films);
    free(checkpoint->words);
    free(checkpoint->identity);
    *checkpoint = (aur_checkpoint){0};
}

/* --- identities */

typedef struct line {
    const char *text;
    size_t length;
} line;

static bool next_line(const char **at, line *found) {
    if (**at == '\0')
        return false;
    *found = (line){*at, strcspn(*at, "\n")};
    *at += found->length + ((*at)[found->length] == '\n');
    return true;
}

/* The next line that does not begin with `but`. */
static bool next_line_but(const char **at, const char *but, line *found) {
    bool good = next_line(at, found);
    while (good && but != NULL && strncmp(found->text, but, strlen(but)) == 0)
        good = next_line(at, found);
    return good;
}

const char *aur_identity_find(const char *identity, const char *key, size_t *length) {
    const size_t size = strlen(key);
    line at;
    while (next_line(&identity, &at))
        if (at.length > size && strncmp(at.text, key, size) == 0 && at.text[size] == ' ') {
            *length = at.length - size - 1;
            return at.text + size + 1;
        }
    return NULL;
}

/* "KIND NAME HASH" with 16 digits. */
static size_t name_length(line file) {
    enum { HASH = 17 };
    const size_t kind = strcspn(file.text, " ") + 1;
    return file.length > kind + HASH ? file.length - kind - HASH : 0;
}

static bool is_changed_file(line a, line b) {
    const bool is_file = strncmp(a.text, "scene ", 6) == 0 || strncmp(a.text, "file ", 5) == 0;
    const size_t name = strcspn(a.text, " ") + 1 + name_length(a);
    return is_file && a.length == b.length && name_length(a) > 0 && memcmp(a.text, b.text, name) == 0 &&
           memcmp(a.text, b.text, a.length) != 0;
}

aur_result aur_identity_compare(const char *path, const char *saved, const char *current, const char *but,
                                aur_error *error) {
    for (;;) {
        line a = {0}, b = {0};
        const bool has_a = next_line_but(&saved, but, &a), has_b = next_line_but(&current, but, &b);
        if (!has_a && !has_b)
            return AUR_OK;
        const aur_location where = {.file = path};
        if (!has_a || !has_b)
            return aur_fail_at(error, where, AUR_ERROR_ARGUMENT, "of another render: it was made %s '%.*s'",
                               has_a ? "with" : "without", (int)(has_a ? a.length : b.length),
                               has_a ? a.text : b.text);
        if (is_changed_file(a, b))
            return aur_fail_at(error, where, AUR_ERROR_ARGUMENT,
                               "of another render: '%.*s' has changed since", (int)name_length(b),
                               b.text + strcspn(b.text, " ") + 1);
        if (a.length != b.length || memcmp(a.text, b.text, a.length) != 0)
            return aur_fail_at(error, where, AUR_ERROR_ARGUMENT,
                               "of another render: it was made with '%.*s', this one is '%.*s'%s",
                               (int)a.length, a.text, (int)b.length, b.text,
                               strncmp(a.text, "rays ", 5) == 0 && strncmp(b.text, "rays ", 5) == 0
                                   ? "; AUREOLE_ISA=avx2 makes processors agree"
                                   : "");
    }
}
