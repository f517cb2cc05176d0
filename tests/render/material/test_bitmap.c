/* Packed texels against the image that they come from, bit by bit, in memory and in pages. */
#include "check.h"

#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/random.h"
#include "render/scene/materials/bitmap.h"

/* The i-th number of `levels` different ones; 0: as many as there are floats. */
static float level(uint64_t i, size_t levels) {
    const uint64_t hash = aur_hash2(i, 0);
    return levels > 0 ? (float)(hash % levels) / 64.0f - 1.0f : (float)(hash >> 40) / 4096.0f - 8.0f;
}

static float times_channel(const void *context, size_t channel, float value) {
    const float *const factor = context;
    return factor[channel] * value;
}

typedef struct form {
    size_t width, height, levels;
    bool grey, same;
    size_t channels, value_bytes; /* expected */
} form;

static float *image_of(const form *image) {
    float *const data = malloc(4 * image->width * image->height * sizeof *data);
    for (size_t i = 0; i < 4 * image->width * image->height; ++i)
        data[i] = level(image->grey ? i / 4 : i, image->levels);
    return data;
}

static aur_texel_source source_of(const form *image, const float *data) {
    static const float factors[2][3] = {{1.0f, 0.5f, 3.0f}, {0.7f, 0.7f, 0.7f}};
    return (aur_texel_source){.width = image->width,
                              .height = image->height,
                              .stride = 4,
                              .data = data,
                              .channel = {0, 1, 2},
                              .map = times_channel,
                              .context = factors[image->same],
                              .same = image->same};
}

/* The number of texels that differ from those of the source, from one on in steps. */
static size_t count_wrong(const aur_texel_source *source, const aur_bitmap *texels, size_t first,
                          size_t step) {
    size_t wrong = 0;
    for (size_t i = first; i < source->width * source->height; i += step) {
        float rgb[3];
        aur_bitmap_at(texels, i % source->width, i / source->width, rgb);
        for (size_t c = 0; c < 3; ++c) {
            const float right = source->map(source->context, c, source->data[4 * i + source->channel[c]]);
            wrong += memcmp(&rgb[c], &right, sizeof right) != 0;
        }
    }
    return wrong;
}

static void preserves_every_bit(void **state) {
    (void)state;
    static const form forms[] = {
        {300, 200, 256, false, true, 3, 1}, {300, 200, 256, true, true, 1, 1},
        {300, 200, 256, true, false, 3, 1}, {300, 200, 200, false, false, 3, 1},
        {301, 203, 257, false, true, 3, 2}, {400, 200, 9000, true, true, 1, 2},
        {300, 200, 0, false, true, 3, 4},   {1, 1, 1, true, true, 1, 1},
        {70000, 1, 256, false, true, 3, 1}, {1, 5000, 0, true, true, 1, 4},
        {3, 70, 256, false, false, 3, 1},   {30, 7, 0, false, false, 3, 1},
        {65, 64, 300, false, false, 3, 2},  {16, 16, 300, false, false, 3, 4},
    };
    for (size_t i = 0; i < sizeof forms / sizeof forms[0]; ++i) {
        float *const data = image_of(&forms[i]);
        const aur_texel_source source = source_of(&forms[i], data);
        for (size_t paged = 0; paged < 2; ++paged) {
            aur_texel_pages *const pages = paged ? aur_texel_pages_create(1) : NULL;
            aur_bitmap texels;
            aur_texel_range range;
            aur_error error = {0};
            if (aur_bitmap_pack(&source, pages, &texels, &range, &error) != AUR_OK)
                fail_msg("%s", error.message);
            if (texels.channels != forms[i].channels ||
                (texels.value_bytes != forms[i].value_bytes && forms[i].width * forms[i].height > 256))
                fail_msg("form %zu: %zu channels of %zu bytes", i, texels.channels, texels.value_bytes);
            assert_int_equal(count_wrong(&source, &texels, 0, 1), 0);
            double sum = 0.0;
            float most = 0.0f;
            for (size_t k = 0; k < source.width * source.height; ++k) {
                sum += fmaxf(source.map(source.context, 1, data[4 * k + 1]), 0.0f);
                for (size_t c = 0; c < 3; ++c)
                    most = fmaxf(most, source.map(source.context, c, data[4 * k + c]));
            }
            assert_true(sum == range.sum[1] && most == range.maximum);
            aur_bitmap_release(&texels);
            aur_texel_pages_destroy(pages);
        }
        free(data);
    }
}

/* Codes of 8 bits give what their values give: the same form, texels and range. */
static void codes_pack_like_values(void **state) {
    (void)state;
    static const form forms[] = {{300, 200, 256, false, true, 0, 0}, {131, 70, 256, true, true, 0, 0},
                                 {64, 64, 7, true, false, 0, 0},     {3, 70, 9, false, false, 0, 0},
                                 {1, 1, 1, true, true, 0, 0},        {70000, 1, 256, false, true, 0, 0}};
    for (size_t i = 0; i < sizeof forms / sizeof forms[0]; ++i) {
        float *const data = image_of(&forms[i]);
        const size_t count = 4 * forms[i].width * forms[i].height;
        unsigned char *const codes = malloc(count);
        const aur_texel_source source = source_of(&forms[i], data);
        aur_texel_source coded = source;
        coded.data = NULL;
        coded.codes = codes;
        for (size_t k = 0; k < 256; ++k)
            coded.code_values[k] = (float)k / 64.0f - 1.0f;
        for (size_t k = 0; k < count; ++k)
            codes[k] = (unsigned char)((data[k] + 1.0f) * 64.0f);
        aur_bitmap texels[2];
        aur_texel_range ranges[2];
        assert_int_equal(aur_bitmap_pack(&source, NULL, &texels[0], &ranges[0], NULL), AUR_OK);
        assert_int_equal(aur_bitmap_pack(&coded, NULL, &texels[1], &ranges[1], NULL), AUR_OK);
        assert_int_equal(texels[1].channels, texels[0].channels);
        assert_int_equal(texels[1].value_bytes, 1);
        assert_int_equal(count_wrong(&source, &texels[1], 0, 1), 0);
        assert_memory_equal(&ranges[1].sum, &ranges[0].sum, sizeof ranges[0].sum);
        assert_true(ranges[1].maximum == ranges[0].maximum);
        for (size_t k = 0; k < 2; ++k)
            aur_bitmap_release(&texels[k]);
        free(codes);
        free(data);
    }
}

typedef struct reader {
    const aur_texel_source *source;
    const aur_bitmap *texels;
    size_t first, wrong;
} reader;

static void *read_some(void *argument) {
    reader *const self = argument;
    for (size_t round = 0; round < 3; ++round)
        self->wrong += count_wrong(self->source, self->texels, self->first + round, 977);
    return NULL;
}

static size_t resident_bytes(void) {
    size_t all = 0, resident = 0;
    FILE *const stream = fopen("/proc/self/statm", "r");
    assert_non_null(stream);
    assert_int_equal(fscanf(stream, "%zu %zu", &all, &resident), 2);
    fclose(stream);
    return 4096 * resident;
}

/* 12 MiB of texels; 4 may be in memory. */
static void bounds_memory(void **state) {
    (void)state;
    const form image = {1024, 1024, 0, false, true, 3, 4};
    float *const data = image_of(&image);
    const aur_texel_source source = source_of(&image, data);
    aur_texel_pages *const pages = aur_texel_pages_create((size_t)4 << 20);
    aur_bitmap texels;
    aur_texel_range range;
    assert_int_equal(aur_bitmap_pack(&source, pages, &texels, &range, NULL), AUR_OK);
    const size_t before = resident_bytes();
    enum { THREADS = 4 };
    pthread_t threads[THREADS];
    reader readers[THREADS];
    for (size_t i = 0; i < THREADS; ++i) {
        readers[i] = (reader){.source = &source, .texels = &texels, .first = 100 * i};
        assert_int_equal(pthread_create(&threads[i], NULL, read_some, &readers[i]), 0);
    }
    for (size_t i = 0; i < THREADS; ++i) {
        pthread_join(threads[i], NULL);
        assert_int_equal(readers[i].wrong, 0);
    }
    assert_int_equal(pages->count, 192);
    assert_int_equal(pages->limit, 64);
    assert_true(pages->resident <= pages->limit + THREADS);
    const size_t after = resident_bytes();
    if (after > before + ((size_t)6 << 20)) /* 12 MiB of texels; threads have some memory, too */
        fail_msg("%zu bytes more are in memory", after - before);
    aur_bitmap_release(&texels);
    aur_texel_pages_destroy(pages);
    free(data);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(preserves_every_bit),
        cmocka_unit_test(codes_pack_like_values),
        cmocka_unit_test(bounds_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
