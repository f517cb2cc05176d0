/* JPEG, and BMP and TGA, which are read only, through stb. */
#include <stb_image.h>
#include <stb_image_write.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "render/image/format.h"

static aur_result fail_stb(const char *format, aur_error *error) {
    const char *const reason = stbi_failure_reason();
    return aur_fail(error, AUR_ERROR_FORMAT, "broken %s: %s", format,
                    reason != NULL ? reason : "cannot be decoded");
}

/* Size and channels. */
static aur_result read_header(const aur_image_source *source, const char *format, size_t pixels_a_byte,
                              size_t size[3], aur_error *error) {
    int width, height, channel_count;
    if (source->size > INT32_MAX)
        return aur_fail(error, AUR_ERROR_UNSUPPORTED, "a %s of more than 2 GiB", format);
    if (!stbi_info_from_memory(source->data, (int)source->size, &width, &height, &channel_count))
        return fail_stb(format, error);
    size[0] = width > 0 ? (size_t)width : 0;
    size[1] = height > 0 ? (size_t)height : 0;
    size[2] = channel_count > 0 ? (size_t)channel_count : 0;
    const aur_result result = aur_image_check_size(size[0], size[1], size[2], error);
    return result == AUR_OK ? aur_image_check_claim(source, format, size[0] * size[1], pixels_a_byte, error)
                            : result;
}

/* Does what the decoder gave agree with the header? If so an image of that size. */
static aur_result create_decoded(const char *format, const size_t size[3], const int decoded[3],
                                 aur_image **image, aur_error *error) {
    for (size_t i = 0; i < 3; ++i)
        if (decoded[i] < 0 || (size_t)decoded[i] != size[i])
            return aur_fail(error, AUR_ERROR_FORMAT, "broken %s: its header disagrees with its pixels",
                            format);
    return aur_image_create_coded(size[0], size[1], size[2], image, error);
}

static aur_result read_ldr(const aur_image_source *source, const char *format, size_t pixels_a_byte,
                           aur_image **image, aur_error *error) {
    size_t size[3];
    aur_result result = read_header(source, format, pixels_a_byte, size, error);
    if (result != AUR_OK)
        return result;
    int decoded[3];
    stbi_uc *const values = stbi_load_from_memory(source->data, (int)source->size, &decoded[0], &decoded[1],
                                                  &decoded[2], (int)size[2]);
    if (values == NULL)
        return fail_stb(format, error);
    decoded[2] = (int)size[2];
    result = create_decoded(format, size, decoded, image, error);
    if (result == AUR_OK)
        memcpy((*image)->codes, values, size[0] * size[1] * size[2]);
    stbi_image_free(values);
    return result;
}

static bool recognize_jpeg(const aur_image_source *source) {
    return aur_image_begins(source, "\xff\xd8\xff", 3);
}

/* The decoder fills missing data with grey, so the end marker must be checked here. */
static bool has_jpeg_end(const aur_image_source *source) {
    for (size_t i = source->size; i >= 2; --i)
        if (source->data[i - 2] == 0xff && source->data[i - 1] == 0xd9)
            return true;
    return false;
}

static aur_result read_jpeg(const aur_image_source *source, aur_image **image, aur_error *error) {
    const size_t block_pixels = 64, bits = 8; /* at least one bit per block */
    if (!has_jpeg_end(source))
        return aur_fail(error, AUR_ERROR_FORMAT, "broken JPEG: it is cut short");
    return read_ldr(source, "JPEG", block_pixels * bits, image, error);
}

static aur_result write_jpeg(const aur_image_target *target, const aur_image *image, aur_error *error) {
    enum { QUALITY = 90, LARGEST_SIDE = 65535 }; /* above 90, chroma is stored at full resolution */
    size_t count;
    if (image->width > LARGEST_SIDE || image->height > LARGEST_SIDE)
        return aur_fail(error, AUR_ERROR_UNSUPPORTED,
                        "a JPEG of %zu x %zu pixels: it may have at most %d columns and rows", image->width,
                        image->height, LARGEST_SIDE);
    unsigned char *const bytes = aur_image_display(target, image, &count);
    const int written = bytes != NULL
                            ? stbi_write_jpg_to_func(aur_image_put_bytes, target->stream, (int)image->width,
                                                     (int)image->height, (int)count, bytes, QUALITY)
                            : 0;
    free(bytes);
    return written != 0 ? AUR_OK : aur_image_fail_encode(error);
}

const aur_image_format aur_image_format_jpeg = {
    .row = {.name = "jpg",
            .summary = "JPEG: grey or R, G, B, 8 bits, sRGB; written with quality 90",
            .source = "",
            .key_count = AUR_DISPLAY_KEY_COUNT,
            .keys = aur_display_keys},
    .name = "JPEG",
    .recognize = recognize_jpeg,
    .read = read_jpeg,
    .write = write_jpeg};

static bool recognize_bmp(const aur_image_source *source) {
    return aur_image_begins(source, "BM", 2);
}

static aur_result read_bmp(const aur_image_source *source, aur_image **image, aur_error *error) {
    return read_ldr(source, "BMP", 8, image, error); /* at least one bit per pixel */
}

/* TGA files have no signature: they are recognised by their name. */
static bool recognize_tga(const aur_image_source *source) {
    const char *const dot = source->name != NULL ? strrchr(source->name, '.') : NULL;
    return dot != NULL && strcasecmp(dot, ".tga") == 0;
}

static aur_result read_tga(const aur_image_source *source, aur_image **image, aur_error *error) {
    return read_ldr(source, "TGA", 128, image, error); /* runs of at most 128 pixels */
}

const aur_image_format aur_image_format_bmp = {
    .row = {.name = "bmp", .summary = "BMP: R, G, B, 8 bits, sRGB; is read only", .source = ""},
    .name = "BMP",
    .recognize = recognize_bmp,
    .read = read_bmp};

const aur_image_format aur_image_format_tga = {
    .row = {.name = "tga", .summary = "TGA: grey or R, G, B, 8 bits, sRGB; is read only", .source = ""},
    .name = "TGA",
    .recognize = recognize_tga,
    .read = read_tga};
