/* A film in a file: 64-bit little-endian words, the last one a hash of all others. */
#include <stdlib.h>
#include <string.h>

#include "core/error.h"
#include "core/file.h"
#include "core/random.h"
#include "film/film.h"

enum { NAME_WORDS = AUR_CHANNEL_NAME_CAPACITY / 8, HEADER_WORDS = 9 };

/* "AURFILM1" */
static const uint64_t magic = UINT64_C(0x314d4c4946525541);

typedef struct word_writer {
    FILE *stream;
    uint64_t hash;
} word_writer;

static void put_word(word_writer *writer, uint64_t word) {
    unsigned char bytes[8];
    for (size_t i = 0; i < 8; ++i)
        bytes[i] = (unsigned char)(word >> 8 * i);
    writer->hash = aur_hash2(writer->hash, word);
    /* A failed write leaves its mark on the stream, which aur_file_commit looks at. */
    fwrite(bytes, sizeof bytes, 1, writer->stream);
}

static void put_double(word_writer *writer, double value) {
    uint64_t word;
    memcpy(&word, &value, sizeof word);
    put_word(writer, word);
}

static void put_film(word_writer *writer, const aur_film *film) {
    const aur_film_layout *const layout = &film->layout;
    const size_t pixels = aur_film_pixel_count(film), channels = layout->channel_count;
    const uint64_t header[HEADER_WORDS] = {magic,      layout->width, layout->height,
                                           layout->x0, layout->x1,    layout->y0,
                                           layout->y1, channels,      AUR_TILE_SIZE};
    for (size_t i = 0; i < HEADER_WORDS; ++i)
        put_word(writer, header[i]);
    for (size_t c = 0; c < channels; ++c) {
        put_word(writer, film->channels[c].kind);
        for (size_t i = 0; i < NAME_WORDS; ++i) {
            uint64_t word = 0;
            for (size_t k = 0; k < 8; ++k)
                word |= (uint64_t)(unsigned char)film->channels[c].name[8 * i + k] << 8 * k;
            put_word(writer, word);
        }
    }
    for (size_t i = 0; i < film->tile_count; ++i)
        put_word(writer, film->tile_samples[i]);
    for (size_t i = 0; i < pixels; ++i)
        put_word(writer, (uint64_t)film->steps[i] << 32 | film->counts[i]);
    for (size_t i = 0; i < 3 * pixels; ++i)
        put_double(writer, film->squares[i]);
    for (size_t i = 0; i < channels * pixels; ++i)
        put_double(writer, film->sums[i]);
    put_word(writer, writer->hash);
}

aur_result aur_film_save(const aur_film *film, const char *path, aur_error *error) {
    aur_file_writer file;
    const aur_result result = aur_file_open(path, &file, error);
    if (result != AUR_OK)
        return result;
    word_writer writer = {.stream = file.stream};
    put_film(&writer, film);
    return aur_file_commit(&file, error);
}

typedef struct word_reader {
    const unsigned char *data;
    size_t left; /* words */
    uint64_t hash;
} word_reader;

/* The reader's caller has checked that enough words are left. */
static uint64_t get_word(word_reader *reader) {
    uint64_t word = 0;
    for (size_t i = 0; i < 8; ++i)
        word |= (uint64_t)reader->data[i] << 8 * i;
    reader->data += 8;
    --reader->left;
    reader->hash = aur_hash2(reader->hash, word);
    return word;
}

static double get_double(word_reader *reader) {
    const uint64_t word = get_word(reader);
    double value;
    memcpy(&value, &word, sizeof value);
    return value;
}

static aur_result not_a_film(const char *name, const char *why, aur_error *error) {
    return aur_fail_at(error, (aur_location){.file = name}, AUR_ERROR_FORMAT, "%s", why);
}

/* False when a channel is none that a film has. */
static bool get_channels(word_reader *reader, aur_film *film) {
    for (size_t c = 0; c < film->layout.channel_count; ++c) {
        const uint64_t kind = get_word(reader);
        char *const name = film->channels[c].name;
        for (size_t i = 0; i < NAME_WORDS; ++i) {
            const uint64_t word = get_word(reader);
            for (size_t k = 0; k < 8; ++k)
                name[8 * i + k] = (char)(word >> 8 * k);
        }
        if (kind >= AUR_CHANNEL_KIND_COUNT || name[AUR_CHANNEL_NAME_CAPACITY - 1] != '\0')
            return false;
        film->channels[c].kind = (aur_channel_kind)kind;
    }
    return true;
}

static void get_pixels(word_reader *reader, aur_film *film) {
    const size_t pixels = aur_film_pixel_count(film), channels = film->layout.channel_count;
    for (size_t i = 0; i < film->tile_count; ++i)
        film->tile_samples[i] = (uint32_t)get_word(reader);
    for (size_t i = 0; i < pixels; ++i) {
        const uint64_t word = get_word(reader);
        film->steps[i] = (uint32_t)(word >> 32);
        film->counts[i] = (uint32_t)word;
    }
    for (size_t i = 0; i < 3 * pixels; ++i)
        film->squares[i] = get_double(reader);
    for (size_t i = 0; i < channels * pixels; ++i)
        film->sums[i] = get_double(reader);
}

/* The words of a film after the header, or 0 when a file of `left` words cannot hold so many. Nothing is
 * allocated before this is known. */
static size_t words_of(const aur_film_layout *layout, size_t left) {
    if (layout->x0 >= layout->x1 || layout->y0 >= layout->y1 || layout->x1 > left || layout->y1 > left ||
        layout->channel_count > left)
        return 0;
    const double pixels = (double)(layout->x1 - layout->x0) * (double)(layout->y1 - layout->y0);
    const size_t tiles = ((layout->x1 - 1) / AUR_TILE_SIZE - layout->x0 / AUR_TILE_SIZE + 1) *
                         ((layout->y1 - 1) / AUR_TILE_SIZE - layout->y0 / AUR_TILE_SIZE + 1);
    const double words =
        (double)layout->channel_count * (1 + NAME_WORDS + pixels) + (double)tiles + 4.0 * pixels + 1.0;
    return words <= (double)left ? (size_t)words : 0;
}

aur_result aur_film_load_memory(const char *name, size_t size, const void *data, aur_film **out,
                                aur_error *error) {
    *out = NULL;
    word_reader reader = {.data = data, .left = size / 8};
    if (reader.left < HEADER_WORDS || get_word(&reader) != magic)
        return not_a_film(name, "not a film, or one of another version of the program", error);
    uint64_t header[HEADER_WORDS - 1];
    for (size_t i = 0; i < HEADER_WORDS - 1; ++i)
        header[i] = get_word(&reader);
    const aur_film_layout layout = {header[0], header[1], header[2], header[3],
                                    header[4], header[5], header[6]};
    if (header[7] != AUR_TILE_SIZE || size % 8 != 0 || words_of(&layout, reader.left) != reader.left)
        return not_a_film(name, "a film that is cut short or damaged", error);
    aur_film *film;
    aur_result result = aur_film_create(&layout, &film, error);
    if (result != AUR_OK)
        return result == AUR_ERROR_ARGUMENT ? not_a_film(name, "a film of an impossible size", error)
                                            : result;
    const bool good = get_channels(&reader, film);
    if (good)
        get_pixels(&reader, film);
    const uint64_t hash = reader.hash;
    if (!good || get_word(&reader) != hash) {
        aur_film_destroy(film);
        return not_a_film(name, "a film that is damaged: its checksum is wrong", error);
    }
    *out = film;
    return AUR_OK;
}

aur_result aur_film_load(const char *path, aur_film **out, aur_error *error) {
    char *data = NULL;
    size_t size = 0;
    *out = NULL;
    aur_result result = aur_file_read(path, (size_t)1 << 40, &data, &size, error);
    if (result == AUR_OK)
        result = aur_film_load_memory(path, size, data, out, error);
    free(data);
    return result;
}
