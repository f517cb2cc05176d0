/* A film in a file: 64-bit little-endian words, the last one a hash of all others. */
#include <stdlib.h>

#include "points/base/error.h"
#include "points/base/file.h"
#include "points/base/words.h"
#include "render/film/film.h"

enum { NAME_WORDS = AUR_CHANNEL_NAME_CAPACITY / 8, HEADER_WORDS = 9, COUNTER_WORDS = 5 + AUR_RENDER_LEVELS };

/* "AURFILM3" */
static const uint64_t magic = UINT64_C(0x334d4c4946525541);

static void put_film(aur_word_writer *writer, const aur_film *film) {
    const aur_film_layout *const layout = &film->layout;
    const size_t pixels = aur_film_pixel_count(film), channels = layout->channel_count;
    const uint64_t header[HEADER_WORDS] = {magic,      layout->width, layout->height,
                                           layout->x0, layout->x1,    layout->y0,
                                           layout->y1, channels,      AUR_TILE_SIZE};
    for (size_t i = 0; i < HEADER_WORDS; ++i)
        aur_word_put(writer, header[i]);
    const aur_counters *const counted = &film->counters;
    const uint64_t counters[] = {counted->rays, counted->samples, counted->invalid, counted->cut,
                                 counted->unsolved};
    for (size_t i = 0; i < sizeof counters / sizeof counters[0]; ++i)
        aur_word_put(writer, counters[i]);
    for (size_t l = 0; l < AUR_RENDER_LEVELS; ++l)
        aur_word_put(writer, counted->levels[l]);
    for (size_t c = 0; c < channels; ++c) {
        aur_word_put(writer, film->channels[c].kind);
        for (size_t i = 0; i < NAME_WORDS; ++i) {
            uint64_t word = 0;
            for (size_t k = 0; k < 8; ++k)
                word |= (uint64_t)(unsigned char)film->channels[c].name[8 * i + k] << 8 * k;
            aur_word_put(writer, word);
        }
    }
    for (size_t i = 0; i < pixels; ++i)
        aur_word_put(writer, film->given[i]);
    for (size_t i = 0; i < pixels; ++i)
        aur_word_put(writer, (uint64_t)film->steps[i] << 32 | film->counts[i]);
    for (size_t i = 0; i < 3 * pixels; ++i)
        aur_word_put(writer, aur_word_of_double(film->squares[i]));
    for (size_t i = 0; i < channels * pixels; ++i)
        aur_word_put(writer, aur_word_of_double(film->sums[i]));
    aur_word_put(writer, writer->hash);
}

void aur_film_write(const aur_film *film, FILE *stream) {
    aur_word_writer writer = {.stream = stream};
    pthread_mutex_lock(film->lock);
    put_film(&writer, film);
    pthread_mutex_unlock(film->lock);
}

size_t aur_film_file_size(const aur_film *film) {
    const size_t channels = film->layout.channel_count, pixels = aur_film_pixel_count(film);
    return 8 * (HEADER_WORDS + COUNTER_WORDS + channels * (1 + NAME_WORDS + pixels) + 5 * pixels + 1);
}

aur_result aur_film_save(const aur_film *film, const char *path, aur_error *error) {
    aur_file_writer file;
    const aur_result result = aur_file_open(path, &file, error);
    if (result != AUR_OK)
        return result;
    aur_film_write(film, file.stream);
    return aur_file_commit(&file, error);
}

static aur_result not_a_film(const char *name, const char *why, aur_error *error) {
    return aur_fail_at(error, (aur_location){.file = name}, AUR_ERROR_FORMAT, "%s", why);
}

static void get_counters(aur_word_reader *reader, aur_counters *counted) {
    uint64_t *const counters[] = {&counted->rays, &counted->samples, &counted->invalid, &counted->cut,
                                  &counted->unsolved};
    for (size_t i = 0; i < sizeof counters / sizeof counters[0]; ++i)
        *counters[i] = aur_word_get(reader);
    for (size_t l = 0; l < AUR_RENDER_LEVELS; ++l)
        counted->levels[l] = aur_word_get(reader);
}

/* False when a channel is none that a film has. */
static bool get_channels(aur_word_reader *reader, aur_film *film) {
    for (size_t c = 0; c < film->layout.channel_count; ++c) {
        const uint64_t kind = aur_word_get(reader);
        char *const name = film->channels[c].name;
        for (size_t i = 0; i < NAME_WORDS; ++i) {
            const uint64_t word = aur_word_get(reader);
            for (size_t k = 0; k < 8; ++k)
                name[8 * i + k] = (char)(word >> 8 * k);
        }
        if (kind >= AUR_CHANNEL_KIND_COUNT || name[AUR_CHANNEL_NAME_CAPACITY - 1] != '\0')
            return false;
        film->channels[c].kind = (aur_channel_kind)kind;
    }
    return true;
}

static void get_pixels(aur_word_reader *reader, aur_film *film) {
    const size_t pixels = aur_film_pixel_count(film), channels = film->layout.channel_count;
    for (size_t i = 0; i < pixels; ++i)
        film->given[i] = (uint32_t)aur_word_get(reader);
    for (size_t i = 0; i < pixels; ++i) {
        const uint64_t word = aur_word_get(reader);
        film->steps[i] = (uint32_t)(word >> 32);
        film->counts[i] = (uint32_t)word;
    }
    for (size_t i = 0; i < 3 * pixels; ++i)
        film->squares[i] = aur_word_get_double(reader);
    for (size_t i = 0; i < channels * pixels; ++i)
        film->sums[i] = aur_word_get_double(reader);
}

/* The words of a film after the header, or 0 when a file of `left` words cannot hold so many. Nothing is
 * allocated before this is known. */
static size_t words_of(const aur_film_layout *layout, size_t left) {
    if (layout->x0 >= layout->x1 || layout->y0 >= layout->y1 || layout->x1 > left || layout->y1 > left ||
        layout->channel_count > left)
        return 0;
    const double pixels = (double)(layout->x1 - layout->x0) * (double)(layout->y1 - layout->y0);
    const double words =
        (double)layout->channel_count * (1 + NAME_WORDS + pixels) + 5.0 * pixels + COUNTER_WORDS + 1.0;
    return words <= (double)left ? (size_t)words : 0;
}

aur_result aur_film_load_memory(const char *name, size_t size, const void *data, aur_film **out,
                                aur_error *error) {
    *out = NULL;
    aur_word_reader reader = {.at = data, .end = (const unsigned char *)data + size};
    if (aur_words_left(&reader) < HEADER_WORDS || aur_word_get(&reader) != magic)
        return not_a_film(name, "not a film, or one of another version of the program", error);
    uint64_t header[HEADER_WORDS - 1];
    for (size_t i = 0; i < HEADER_WORDS - 1; ++i)
        header[i] = aur_word_get(&reader);
    const aur_film_layout layout = {header[0], header[1], header[2], header[3],
                                    header[4], header[5], header[6]};
    if (header[7] != AUR_TILE_SIZE || size % 8 != 0 ||
        words_of(&layout, aur_words_left(&reader)) != aur_words_left(&reader))
        return not_a_film(name, "a film that is cut short or damaged", error);
    aur_film *film;
    aur_result result = aur_film_create(&layout, &film, error);
    if (result != AUR_OK)
        return result == AUR_ERROR_ARGUMENT ? not_a_film(name, "a film of an impossible size", error)
                                            : result;
    get_counters(&reader, &film->counters);
    const bool good = get_channels(&reader, film);
    if (good)
        get_pixels(&reader, film);
    if (!good || !aur_word_check(&reader)) {
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
