/* Shared by the tests of images: images with known pixels, and comparing two of them value by value. */
#pragma once

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "check.h"
#include "points/base/random.h"
#include "render/image/format.h"

static inline void assert_success(aur_result result, const aur_error *error) {
    if (result != AUR_OK)
        print_error("%s: %s: %s\n", aur_result_string(result), error->file, error->message);
    assert_int_equal(result, AUR_OK);
}

/* Values in [0, 4), hashed from their position. */
static inline aur_image *random_image(size_t width, size_t height, size_t channel_count) {
    aur_image *image;
    aur_error error;
    assert_success(aur_image_create(width, height, channel_count, &image, &error), &error);
    for (size_t i = 0; i < width * height * channel_count; ++i)
        image->data[i] = 4.0f * aur_unit_float((uint32_t)aur_hash2(i, channel_count));
    return image;
}

static inline aur_image *flat_image(size_t width, size_t height, float r, float g, float b) {
    aur_image *const image = random_image(width, height, 3);
    for (size_t i = 0; i < width * height; ++i) {
        image->data[3 * i] = r;
        image->data[3 * i + 1] = g;
        image->data[3 * i + 2] = b;
    }
    return image;
}

static inline aur_image *read_image(const char *path) {
    aur_image *image;
    aur_error error;
    assert_success(aur_image_read(path, &image, &error), &error);
    return image;
}

static inline void write_image(const char *path, const aur_image *image,
                               const aur_image_write_options *options) {
    aur_error error;
    assert_success(aur_image_write(path, image, options, &error), &error);
}

static inline void assert_same_image(const aur_image *a, const aur_image *b) {
    assert_int_equal(a->width, b->width);
    assert_int_equal(a->height, b->height);
    assert_int_equal(a->channel_count, b->channel_count);
    for (size_t c = 0; c < a->channel_count; ++c)
        assert_string_equal(a->channel_names[c], b->channel_names[c]);
    assert_memory_equal(a->data, b->data, a->width * a->height * a->channel_count * sizeof(float));
}

/* A path in a folder of this process alone; `slot` 0..3 may be in use at the same time. */
static inline const char *scratch(size_t slot, const char *name) {
    static char paths[4][128];
    snprintf(paths[slot], sizeof paths[slot], "aur-%ld-%zu-%s", (long)getpid(), slot, name);
    return paths[slot];
}

/* All bytes of a file; free them. */
static inline unsigned char *read_bytes(const char *path, size_t *size) {
    FILE *const file = fopen(path, "rb");
    assert_non_null(file);
    fseek(file, 0, SEEK_END);
    *size = (size_t)ftell(file);
    rewind(file);
    unsigned char *const bytes = malloc(*size + 1);
    assert_non_null(bytes);
    assert_int_equal(fread(bytes, 1, *size, file), *size);
    fclose(file);
    return bytes;
}
