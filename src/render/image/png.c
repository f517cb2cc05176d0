/* PNG through libpng: well compressed, and read with checksums, which reveal damaged files. */
#include <math.h>
#include <png.h>
#include <setjmp.h>
#include <stdlib.h>
#include <string.h>

#include "render/image/format.h"

/* What a read must free if libpng leaves it by longjmp. */
typedef struct png_reader {
    const unsigned char *at, *end;
    aur_image **image;
    char message[128];
} png_reader;

static void take_bytes(png_structp png, png_bytep bytes, size_t count) {
    png_reader *const reader = png_get_io_ptr(png);
    if (count > (size_t)(reader->end - reader->at))
        png_error(png, "it is cut short");
    memcpy(bytes, reader->at, count);
    reader->at += count;
}

static _Noreturn void leave(png_structp png, png_const_charp message) {
    png_reader *const reader = png_get_error_ptr(png);
    snprintf(reader->message, sizeof reader->message, "%s", message);
    png_longjmp(png, 1);
}

static void ignore_warning(png_structp png, png_const_charp message) {
    (void)png;
    (void)message;
}

/* Values of 16 bits, the high byte first, are stored in the second half of the image's memory: value i is
 * read before float i overwrites it. */
static aur_result decode_values(const aur_image *image, aur_error *error) {
    float *const table = malloc(65536 * sizeof *table);
    if (table == NULL)
        return aur_fail_memory(error);
    for (size_t i = 0; i < 65536; ++i)
        table[i] = (float)aur_srgb_decode((double)i / 65535.0);
    const size_t channel_count = image->channel_count;
    const size_t alpha = channel_count % 2 == 0 ? channel_count - 1 : SIZE_MAX;
    const size_t count = image->width * image->height * channel_count;
    const unsigned char *const values = (const unsigned char *)image->data + 2 * count;
    for (size_t i = 0; i < count; ++i) {
        const size_t value = (size_t)values[2 * i] * 256 + values[2 * i + 1];
        image->data[i] = i % channel_count == alpha ? (float)value / 65535.0f : table[value];
    }
    free(table);
    return AUR_OK;
}

/* Chunks that say how to interpret the values; sRGB's chunk overrides the others. */
static void add_notes(png_structp png, png_infop info, aur_image *image) {
    static const double usual[8] = {0.3127, 0.329, 0.64, 0.33, 0.3, 0.6, 0.15, 0.06};
    double gamma = 1.0 / 2.2, there[8];
    bool other = false;
    if (png_get_valid(png, info, PNG_INFO_sRGB) != 0)
        return;
    if (png_get_gAMA(png, info, &gamma) != 0 && !(fabs(gamma * 2.2 - 1.0) < 0.05))
        aur_image_note(image, "its gamma of %g is not applied: values are read as sRGB's", gamma);
    if (png_get_cHRM(png, info, &there[0], &there[1], &there[2], &there[3], &there[4], &there[5], &there[6],
                     &there[7]) == 0)
        return;
    for (size_t i = 0; i < 8; ++i)
        other = other || !(fabs(there[i] - usual[i]) < 2e-3);
    if (other)
        aur_image_note(image,
                       "its chromaticities are not those of Rec. 709: colours are read as if they were");
}

/* Converts any pixel format to 8 or 16 bits of grey or R, G, B, with alpha if present. */
static aur_result read_values(png_structp png, png_infop info, const aur_image_source *source,
                              png_reader *reader, aur_error *error) {
    /* One byte of deflate is at most 1032 bytes: 8 pixels each. */
    const size_t pixels_a_byte = 1032 * 8;
    png_set_user_limits(png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
    png_set_read_fn(png, reader, take_bytes);
    png_read_info(png, info);
    png_set_expand(png);
    const bool coded = png_get_bit_depth(png, info) <= 8;
    const int passes = png_set_interlace_handling(png);
    png_read_update_info(png, info);
    const size_t width = png_get_image_width(png, info), height = png_get_image_height(png, info);
    const size_t channel_count = png_get_channels(png, info), row = (coded ? 1 : 2) * width * channel_count;
    aur_result result = aur_image_check_size(width, height, channel_count, error);
    if (result == AUR_OK)
        result = aur_image_check_claim(source, "PNG", width * height, pixels_a_byte, error);
    if (result != AUR_OK)
        return result;
    result = coded ? aur_image_create_coded(width, height, channel_count, reader->image, error)
                   : aur_image_create(width, height, channel_count, reader->image, error);
    if (result != AUR_OK)
        return result;
    unsigned char *const values =
        coded ? (*reader->image)->codes : (unsigned char *)(*reader->image)->data + row * height;
    for (int pass = 0; pass < passes; ++pass)
        for (size_t y = 0; y < height; ++y)
            png_read_row(png, values + y * row, NULL);
    png_read_end(png, NULL);
    add_notes(png, info, *reader->image);
    return coded ? AUR_OK : decode_values(*reader->image, error);
}

static bool recognize(const aur_image_source *source) {
    return aur_image_begins(source, "\x89PNG\r\n\x1a\n", 8);
}

static aur_result read_guarded(png_structp png, png_infop info, const aur_image_source *source,
                               png_reader *reader, aur_error *error) {
    if (setjmp(png_jmpbuf(png)) != 0)
        return aur_fail(error, AUR_ERROR_FORMAT, "broken PNG: %s", reader->message);
    return read_values(png, info, source, reader, error);
}

static aur_result read_png(const aur_image_source *source, aur_image **image, aur_error *error) {
    png_reader reader = {.at = source->data, .end = source->data + source->size, .image = image};
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &reader, leave, ignore_warning);
    png_infop info = png != NULL ? png_create_info_struct(png) : NULL;
    const aur_result result =
        info != NULL ? read_guarded(png, info, source, &reader, error) : aur_fail_memory(error);
    png_destroy_read_struct(&png, &info, NULL);
    return result;
}

static aur_result write_png(const aur_image_target *target, const aur_image *image, aur_error *error) {
    size_t count;
    if (image->width > PNG_USER_WIDTH_MAX || image->height > PNG_USER_HEIGHT_MAX)
        return aur_fail(error, AUR_ERROR_UNSUPPORTED,
                        "a PNG of %zu x %zu pixels: it may have at most %d columns and %d rows", image->width,
                        image->height, PNG_USER_WIDTH_MAX, PNG_USER_HEIGHT_MAX);
    unsigned char *const bytes = aur_image_display(target, image, &count);
    if (bytes == NULL)
        return aur_image_fail_encode(error);
    png_image header = {.version = PNG_IMAGE_VERSION,
                        .width = (png_uint_32)image->width,
                        .height = (png_uint_32)image->height,
                        .format = count == 1 ? PNG_FORMAT_GRAY : PNG_FORMAT_RGB};
    const int written = png_image_write_to_stdio(&header, target->stream, 0, bytes, 0, NULL);
    free(bytes);
    return written != 0 || ferror(target->stream) ? AUR_OK : aur_image_fail_encode(error);
}

const aur_image_format aur_image_format_png = {
    .row = {.name = "png",
            .summary = "PNG: one to four channels of 8 or 16 bits, sRGB; written with 8, as grey or R, G, B",
            .source = "",
            .key_count = AUR_DISPLAY_KEY_COUNT,
            .keys = aur_display_keys},
    .name = "PNG",
    .recognize = recognize,
    .read = read_png,
    .write = write_png};
