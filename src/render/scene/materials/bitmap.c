#include "render/scene/materials/bitmap.h"

#include <math.h>
#include <stdlib.h>

enum { TILE_BITS = 6, BYTE_NUMBERS = 256, SHORT_NUMBERS = 65536 };

typedef struct slot {
    uint32_t bits;        /* of the value */
    uint32_t next_number; /* its number + 1; 0: free */
} slot;

/* The distinct values of an image, numbered in order of appearance. */
typedef struct numbering {
    size_t count, most;
    size_t slot_mask;
    slot *slots;
    float *values;
} numbering;

typedef struct packing {
    const aur_texel_source *source;
    aur_bitmap *texels;
    aur_texel_range *range;
    numbering numbers;
} packing;

static bool numbering_begin(numbering *self, size_t most) {
    const size_t slots = 4 * (most > BYTE_NUMBERS ? (size_t)SHORT_NUMBERS : (size_t)BYTE_NUMBERS);
    *self = (numbering){.most = most, .slot_mask = slots - 1};
    self->slots = calloc(slots, sizeof *self->slots);
    self->values = malloc((most + 1) * sizeof *self->values);
    return self->slots != NULL && self->values != NULL;
}

static void numbering_end(numbering *self) {
    free(self->slots);
    free(self->values);
    *self = (numbering){0};
}

/* `most` if there are more. */
static size_t number_of(numbering *self, float value) {
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    uint32_t hash = bits * UINT32_C(0x9e3779b1);
    hash ^= hash >> 15;
    for (size_t i = hash & self->slot_mask;; i = (i + 1) & self->slot_mask) {
        slot *const at = &self->slots[i];
        if (at->next_number > 0 && at->bits == bits)
            return at->next_number - 1;
        if (at->next_number > 0)
            continue;
        if (self->count == self->most)
            return self->most;
        self->values[self->count++] = value;
        *at = (slot){bits, (uint32_t)self->count};
        return self->count - 1;
    }
}

/* The layout for `channels` channels and `value_bytes` bytes per value; tiles are no larger than the image.
 */
static bool begin(packing *self, size_t channels, size_t value_bytes) {
    const aur_texel_source *const source = self->source;
    aur_bitmap *const texels = self->texels;
    *texels = (aur_bitmap){
        .width = source->width, .height = source->height, .channels = channels, .value_bytes = value_bytes};
    while (texels->tile_x < TILE_BITS && (size_t)1 << texels->tile_x < source->width)
        ++texels->tile_x;
    while (texels->tile_y < TILE_BITS && (size_t)1 << texels->tile_y < source->height)
        ++texels->tile_y;
    texels->tiles_across = ((source->width - 1) >> texels->tile_x) + 1;
    *self->range = (aur_texel_range){0};
    const size_t last = aur_bitmap_index(texels, source->width - 1, source->height - 1);
    texels->memory =
        calloc((last | ((1u << (texels->tile_x + texels->tile_y)) - 1)) + 1, channels * value_bytes);
    texels->values = texels->memory;
    const size_t count = source->width * source->height * channels;
    const size_t most = count / 8 < SHORT_NUMBERS ? count / 8 : SHORT_NUMBERS;
    return texels->memory != NULL &&
           (value_bytes == 4 || numbering_begin(&self->numbers, value_bytes == 1 ? BYTE_NUMBERS : most));
}

static void end(packing *self) {
    numbering_end(&self->numbers);
    aur_bitmap_release(self->texels);
}

/* False if the table of values is full. */
static bool put(packing *self, unsigned char *to, size_t channel, float value) {
    const aur_texel_source *const source = self->source;
    float mapped;
    if (self->texels->value_bytes == 4) {
        mapped = source->map(source->context, channel, value);
        memcpy(to + 4 * channel, &mapped, sizeof mapped);
        return true;
    }
    const size_t number = number_of(&self->numbers, value);
    if (self->texels->value_bytes == 1)
        to[channel] = (unsigned char)number;
    else
        memcpy(to + 2 * channel, &(uint16_t){(uint16_t)number}, sizeof(uint16_t));
    return number < self->numbers.most;
}

typedef enum attempt { FITS, HAS_COLORS, HAS_MORE_VALUES } attempt;

static attempt put_all(packing *self) {
    const aur_texel_source *const source = self->source;
    aur_bitmap *const texels = self->texels;
    for (size_t y = 0; y < texels->height; ++y) {
        for (size_t x = 0; x < texels->width; ++x) {
            const float *const pixel = &source->data[(y * texels->width + x) * source->stride];
            const float rgb[3] = {pixel[source->channel[0]], pixel[source->channel[1]],
                                  pixel[source->channel[2]]};
            unsigned char *const to =
                texels->memory + aur_bitmap_index(texels, x, y) * texels->channels * texels->value_bytes;
            /* Compares bits, so that NaN equals itself. */
            if (texels->channels == 1 && (memcmp(&rgb[0], &rgb[1], sizeof(float)) != 0 ||
                                          memcmp(&rgb[0], &rgb[2], sizeof(float)) != 0))
                return HAS_COLORS;
            for (size_t c = 0; c < texels->channels; ++c)
                if (!put(self, to, c, rgb[c]))
                    return HAS_MORE_VALUES;
        }
    }
    return FITS;
}

/* How many texels from column x on lie beside each other in a row of a tile. */
static size_t run_of(const aur_bitmap *texels, size_t x) {
    const size_t tile = (size_t)1 << texels->tile_x;
    return texels->width - x < tile ? texels->width - x : tile;
}

/* Codes are the indices. */
static attempt put_codes(packing *self) {
    const aur_texel_source *const source = self->source;
    const aur_bitmap *const texels = self->texels;
    const size_t stride = source->stride, r = source->channel[0], g = source->channel[1],
                 b = source->channel[2];
    self->numbers.count = BYTE_NUMBERS;
    memcpy(self->numbers.values, source->code_values, sizeof source->code_values);
    for (size_t y = 0; y < texels->height; ++y) {
        const unsigned char *from = source->codes + y * texels->width * stride;
        for (size_t x = 0, run; x < texels->width; x += run) {
            run = run_of(texels, x);
            unsigned char *to = texels->memory + aur_bitmap_index(texels, x, y) * texels->channels;
            for (size_t k = 0; texels->channels == 1 && k < run; ++k, from += stride) {
                if (from[r] != from[g] || from[r] != from[b])
                    return HAS_COLORS;
                *to++ = from[r];
            }
            for (size_t k = 0; texels->channels == 3 && k < run; ++k, from += stride, to += 3) {
                to[0] = from[r];
                to[1] = from[g];
                to[2] = from[b];
            }
        }
    }
    return FITS;
}

/* The table from indices to values. */
static bool finish(packing *self) {
    const aur_texel_source *const source = self->source;
    aur_bitmap *const texels = self->texels;
    const numbering *const numbers = &self->numbers;
    const size_t parts = source->same ? 1 : 3;
    texels->table_step = source->same ? 0 : numbers->count;
    texels->table = malloc((parts * numbers->count + 1) * sizeof *texels->table);
    if (texels->table == NULL)
        return false;
    for (size_t c = 0; c < parts; ++c)
        for (size_t i = 0; i < numbers->count; ++i)
            texels->table[c * numbers->count + i] = source->map(source->context, c, numbers->values[i]);
    return true;
}

/* Inlined with a constant `value_bytes`. */
static inline void measure_values(const packing *self, size_t value_bytes) {
    const aur_bitmap *const texels = self->texels;
    const size_t second = texels->channels == 3 ? value_bytes : 0, step = texels->channels * value_bytes;
    double sum[3] = {0};
    float most = 0.0f;
    for (size_t y = 0; y < texels->height; ++y)
        for (size_t x = 0, run; x < texels->width; x += run) {
            run = run_of(texels, x);
            const unsigned char *at = texels->memory + aur_bitmap_index(texels, x, y) * step;
            for (size_t k = 0; k < run; ++k, at += step)
                for (size_t c = 0; c < 3; ++c) {
                    float value = aur_bitmap_value(texels, value_bytes, c, at + c * second);
                    value = value > 0.0f ? value : 0.0f;
                    sum[c] += (double)value;
                    most = value > most ? value : most;
                }
        }
    memcpy(self->range->sum, sum, sizeof sum);
    self->range->maximum = most;
}

static void measure(const packing *self) {
    switch (self->texels->value_bytes) {
    case 1:
        measure_values(self, 1);
        break;
    case 2:
        measure_values(self, 2);
        break;
    default:
        measure_values(self, 4);
    }
}

static aur_result move_to_pages(aur_bitmap *texels, aur_texel_pages *pages, aur_error *error) {
    const size_t last = aur_bitmap_index(texels, texels->width - 1, texels->height - 1);
    const size_t size = (last + 1) * texels->channels * texels->value_bytes;
    if (pages == NULL || size < AUR_TEXEL_BLOCK)
        return AUR_OK;
    const aur_result result =
        aur_texel_pages_add(pages, size, texels->memory, &texels->values, &texels->first_block, error);
    if (result != AUR_OK)
        return result;
    free(texels->memory);
    texels->memory = NULL;
    texels->pages = pages;
    return AUR_OK;
}

aur_result aur_bitmap_pack(const aur_texel_source *source, aur_texel_pages *pages, aur_bitmap *texels,
                           aur_texel_range *range, aur_error *error) {
    packing self = {.source = source, .texels = texels, .range = range};
    size_t channels = source->same ? 1 : 3, value_bytes = 1;
    bool good = begin(&self, channels, value_bytes);
    /* Tries small formats first: an image that does not fit one usually shows it early. */
    for (attempt last = FITS;
         good && (last = source->codes != NULL ? put_codes(&self) : put_all(&self)) != FITS;) {
        channels = last == HAS_COLORS ? 3 : channels;
        value_bytes *= last == HAS_MORE_VALUES ? 2 : 1;
        end(&self);
        good = begin(&self, channels, value_bytes);
    }
    good = good && finish(&self);
    aur_result result = good ? AUR_OK : aur_fail_memory(error);
    if (good) {
        measure(&self);
        result = move_to_pages(texels, pages, error);
    }
    numbering_end(&self.numbers);
    if (result != AUR_OK)
        aur_bitmap_release(texels);
    return result;
}

void aur_bitmap_release(aur_bitmap *texels) {
    free(texels->memory);
    free(texels->table);
    *texels = (aur_bitmap){0};
}
