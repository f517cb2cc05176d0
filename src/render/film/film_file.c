/* A film file: 64-bit little-endian words, the last one a hash of all others. */
#include <stdlib.h>
#include <string.h>

#include "points/base/error.h"
#include "points/base/file.h"
#include "points/base/words.h"
#include "render/film/film.h"

enum { LONGEST_SIDE = 1 << 24 };
enum { NAME_WORDS = AUR_CHANNEL_NAME_CAPACITY / 8, HEADER_WORDS = 13, COUNTER_WORDS = 5 + AUR_RENDER_LEVELS };

/* "AURFILM4" */
static const uint64_t magic = UINT64_C(0x344d4c4946525541);

static uint64_t word_of_floats(float a, float b) {
    uint32_t bits[2];
    memcpy(&bits[0], &a, sizeof a);
    memcpy(&bits[1], &b, sizeof b);
    return (uint64_t)bits[1] << 32 | bits[0];
}

static void floats_of_word(uint64_t word, float *a, float *b) {
    const uint32_t bits[2] = {(uint32_t)word, (uint32_t)(word >> 32)};
    memcpy(a, &bits[0], sizeof *a);
    memcpy(b, &bits[1], sizeof *b);
}

/* Doubles of a film's pixels, and of its cells where pixels share samples. */
typedef struct film_values {
    size_t pixel_sums, pixel_squares, cells, cell_sums, cell_moments;
} film_values;

static film_values values_of(const aur_film *film) {
    const aur_film_layout *const layout = &film->layout;
    const size_t pixels = aur_film_pixel_count(film);
    if (layout->cell == 0)
        return (film_values){.pixel_sums = pixels * layout->channel_count, .pixel_squares = 3 * pixels};
    aur_spread spread;
    aur_spread_measure(&layout->filter, layout->cell, layout->channel_count, &spread);
    const size_t cells = film->tile_count * spread.tile_cells;
    return (film_values){.cells = cells,
                         .cell_sums = cells * spread.cell_values,
                         .cell_moments = layout->cell == AUR_TILE_SIZE
                                             ? cells * spread.side * spread.side * AUR_SPREAD_MOMENTS
                                             : 0};
}

static void put_doubles(aur_word_writer *writer, size_t count, const double *values) {
    for (size_t i = 0; i < count; ++i)
        aur_word_put(writer, aur_word_of_double(values[i]));
}

static void get_doubles(aur_word_reader *reader, size_t count, double *values) {
    for (size_t i = 0; i < count; ++i)
        values[i] = aur_word_get_double(reader);
}

static void put_pixels(aur_word_writer *writer, const aur_film *film) {
    const aur_spread *const spread = film->spread;
    const film_values values = values_of(film);
    for (size_t i = 0; i < aur_film_pixel_count(film); ++i)
        aur_word_put(writer, film->given[i]);
    for (size_t i = 0; i < aur_film_pixel_count(film); ++i)
        aur_word_put(writer, (uint64_t)film->steps[i] << 32 | film->counts[i]);
    put_doubles(writer, values.pixel_squares, film->squares);
    put_doubles(writer, values.pixel_sums, film->sums);
    for (size_t i = 0; i < values.cells; ++i)
        aur_word_put(writer, (uint64_t)spread->steps[i] << 32 | spread->given[i]);
    if (spread != NULL)
        put_doubles(writer, values.cell_sums, spread->sums);
    if (spread != NULL)
        put_doubles(writer, values.cell_moments, spread->moments);
}

static void put_film(aur_word_writer *writer, const aur_film *film) {
    const aur_film_layout *const layout = &film->layout;
    const aur_filter *const filter = &layout->filter;
    const size_t channels = layout->channel_count;
    const uint64_t header[HEADER_WORDS] = {magic,
                                           layout->width,
                                           layout->height,
                                           layout->x0,
                                           layout->x1,
                                           layout->y0,
                                           layout->y1,
                                           channels,
                                           AUR_TILE_SIZE,
                                           layout->cell,
                                           (uint64_t)filter->lobes << 32 | (uint64_t)filter->kind,
                                           word_of_floats(filter->scale, 0.0f),
                                           word_of_floats(filter->b, filter->c)};
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
    put_pixels(writer, film);
    aur_word_put(writer, writer->hash);
}

void aur_film_write(const aur_film *film, FILE *stream) {
    aur_word_writer writer = {.stream = stream};
    pthread_mutex_lock(film->lock);
    put_film(&writer, film);
    pthread_mutex_unlock(film->lock);
}

size_t aur_film_file_size(const aur_film *film) {
    const film_values values = values_of(film);
    return 8 * (HEADER_WORDS + COUNTER_WORDS + film->layout.channel_count * (1 + NAME_WORDS) +
                2 * aur_film_pixel_count(film) + values.pixel_sums + values.pixel_squares + values.cells +
                values.cell_sums + values.cell_moments + 1);
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

/* False if a channel is not valid in a film. */
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
    const size_t pixels = aur_film_pixel_count(film);
    const film_values values = values_of(film);
    aur_spread *const spread = film->spread;
    for (size_t i = 0; i < pixels; ++i)
        film->given[i] = (uint32_t)aur_word_get(reader);
    for (size_t i = 0; i < pixels; ++i) {
        const uint64_t word = aur_word_get(reader);
        film->steps[i] = (uint32_t)(word >> 32);
        film->counts[i] = (uint32_t)word;
    }
    get_doubles(reader, values.pixel_squares, film->squares);
    get_doubles(reader, values.pixel_sums, film->sums);
    for (size_t i = 0; i < values.cells; ++i) {
        const uint64_t word = aur_word_get(reader);
        spread->steps[i] = (uint32_t)(word >> 32);
        spread->given[i] = (uint32_t)word;
    }
    if (spread != NULL)
        get_doubles(reader, values.cell_sums, spread->sums);
    if (spread != NULL)
        get_doubles(reader, values.cell_moments, spread->moments);
}

/* False if the filter or cells are not valid in a film. */
static bool get_filter(const uint64_t words[4], aur_film_layout *layout) {
    aur_filter *const filter = &layout->filter;
    const uint64_t kind = words[1] & UINT32_MAX;
    *filter = (aur_filter){.kind = (aur_filter_kind)kind, .lobes = (int64_t)(words[1] >> 32)};
    float unused;
    floats_of_word(words[2], &filter->scale, &unused);
    floats_of_word(words[3], &filter->b, &filter->c);
    layout->cell = words[0];
    if (kind > AUR_FILTER_LANCZOS || words[0] > AUR_TILE_SIZE)
        return false;
    const double radius = aur_filter_radius(filter);
    return layout->cell == 0 || (radius > 0.5 && radius <= AUR_FILTER_REACH_MAX + 0.5);
}

/* The number of words of a film after the header, or 0 if a file of `left` words is too short. Checked before
 * anything is allocated. */
static size_t words_of(const aur_film_layout *layout, size_t left) {
    if (layout->x0 >= layout->x1 || layout->y0 >= layout->y1 || layout->x1 > left || layout->y1 > left ||
        layout->x1 > layout->width || layout->y1 > layout->height || layout->width > LONGEST_SIDE ||
        layout->height > LONGEST_SIDE || layout->channel_count > left ||
        (double)(layout->x1 - layout->x0) * (double)(layout->y1 - layout->y0) > (double)left)
        return 0;
    aur_film film = {.layout = *layout};
    aur_film_compute_area(&film);
    const size_t bytes = aur_film_file_size(&film), words = bytes / 8 - HEADER_WORDS;
    return words <= left ? words : 0;
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
    aur_film_layout layout = {.width = header[0],
                              .height = header[1],
                              .x0 = header[2],
                              .x1 = header[3],
                              .y0 = header[4],
                              .y1 = header[5],
                              .channel_count = header[6]};
    if (header[7] != AUR_TILE_SIZE || size % 8 != 0 || !get_filter(&header[8], &layout) ||
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
