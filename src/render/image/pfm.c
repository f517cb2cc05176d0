/* Portable float maps: "PF" (colour) or "Pf" (grey), width, height, a scale whose sign gives the byte order,
 * then rows from the bottom (Debevec 2001). */
#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/text.h"
#include "render/image/format.h"

static bool recognize(const aur_image_source *source) {
    return source->size >= 3 && source->data[0] == 'P' &&
           (source->data[1] == 'F' || source->data[1] == 'f') && isspace(source->data[2]);
}

typedef struct pfm_cursor {
    const aur_image_source *source;
    size_t at;
} pfm_cursor;

/* Reads the next word of the header, and the one white space after it. */
static bool next_word(pfm_cursor *cursor, char word[32]) {
    const aur_image_source *const source = cursor->source;
    while (cursor->at < source->size && isspace(source->data[cursor->at]))
        ++cursor->at;
    size_t length = 0;
    while (cursor->at < source->size && !isspace(source->data[cursor->at])) {
        if (length == 31)
            return false;
        word[length++] = (char)source->data[cursor->at++];
    }
    word[length] = '\0';
    ++cursor->at;
    return length > 0 && cursor->at <= source->size;
}

static bool next_size(pfm_cursor *cursor, size_t *value) {
    char word[32];
    uint64_t size;
    if (!next_word(cursor, word) || !aur_parse_integer(word, UINT32_MAX, &size))
        return false;
    *value = (size_t)size;
    return true;
}

static bool next_scale(pfm_cursor *cursor, double *value) {
    char word[32];
    if (!next_word(cursor, word))
        return false;
    const char *const end = aur_read_double(word, AUR_NUMBER_FINITE, value);
    return end != NULL && *end == '\0' && *value != 0.0;
}

static float float_at(const unsigned char *bytes, bool big_endian) {
    const uint32_t b0 = bytes[0], b1 = bytes[1], b2 = bytes[2], b3 = bytes[3];
    const uint32_t bits =
        big_endian ? b0 << 24 | b1 << 16 | b2 << 8 | b3 : b3 << 24 | b2 << 16 | b1 << 8 | b0;
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static aur_result read_pfm(const aur_image_source *source, aur_image **image, aur_error *error) {
    const size_t channel_count = source->data[1] == 'F' ? 3 : 1;
    pfm_cursor cursor = {.source = source, .at = 2};
    size_t width, height;
    double scale;
    if (!next_size(&cursor, &width) || !next_size(&cursor, &height) || !next_scale(&cursor, &scale))
        return aur_fail(error, AUR_ERROR_FORMAT,
                        "broken PFM header: there must be width, height and a scale that is not zero");
    aur_result result = aur_image_check_size(width, height, channel_count, error);
    if (result != AUR_OK)
        return result;
    const size_t row_values = width * channel_count;
    if (source->size - cursor.at < row_values * height * sizeof(float))
        return aur_fail(error, AUR_ERROR_FORMAT,
                        "is cut short: %zu x %zu pixels need %zu bytes, there are %zu", width, height,
                        row_values * height * sizeof(float), source->size - cursor.at);
    result = aur_image_create(width, height, channel_count, image, error);
    if (result != AUR_OK)
        return result;
    const unsigned char *bytes = source->data + cursor.at;
    for (size_t y = height; y-- > 0;)
        for (size_t i = 0; i < row_values; ++i, bytes += sizeof(float))
            (*image)->data[y * row_values + i] = float_at(bytes, scale > 0.0);
    if (fabs(scale) != 1.0)
        aur_image_note(*image, "its scale of %g is not applied", fabs(scale));
    return AUR_OK;
}

static void put_float(float value, unsigned char *bytes) {
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    for (size_t i = 0; i < sizeof bits; ++i)
        bytes[i] = (unsigned char)(bits >> (8 * i));
}

static aur_result write_pfm(const aur_image_target *target, const aur_image *image, aur_error *error) {
    const size_t *const channels = target->channels;
    const size_t count = channels[0] == channels[1] ? 1 : 3;
    fprintf(target->stream, "%s\n%zu %zu\n-1.0\n", count == 3 ? "PF" : "Pf", image->width, image->height);
    const size_t row_size = image->width * count * sizeof(float);
    unsigned char *const row = malloc(row_size);
    if (row == NULL)
        return aur_fail_memory(error);
    for (size_t y = image->height; y-- > 0;) {
        for (size_t i = 0; i < image->width * count; ++i)
            put_float(
                image->data[(y * image->width + i / count) * image->channel_count + channels[i % count]],
                row + sizeof(float) * i);
        fwrite(row, 1, row_size, target->stream);
    }
    free(row);
    return AUR_OK;
}

const aur_image_format aur_image_format_pfm = {
    .row = {.name = "pfm",
            .summary = "portable float map: one channel or R, G, B, floats of 32 bits",
            .source = "Debevec 2001"},
    .name = "PFM",
    .recognize = recognize,
    .read = read_pfm,
    .write = write_pfm};
