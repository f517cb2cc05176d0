/* Images in a page: half floats, deflated, in base64. */
#include <aureole/text.h>
#include <math.h>
#include <stdlib.h>
#include <zlib.h>

#include "program/report/page/page.h"

/* The nearest 16-bit float, ties to even; finite values stay finite. */
static unsigned half_of(float value) {
    const unsigned sign = signbit(value) ? 0x8000 : 0;
    const double size = fabs((double)value);
    if (isnan(size))
        return sign | 0x7e00;
    if (isinf(size))
        return sign | 0x7c00;
    if (size < 0x1p-14)
        return sign | (unsigned)lrint(size * 0x1p24);
    if (size >= 65504.0)
        return sign | 0x7bff;
    const int exponent = ilogb(size);
    return sign | (unsigned)(((exponent + 15) << 10) + (lrint(ldexp(size, 10 - exponent)) - 1024));
}

/* Rounds off the last bits, ties to even: they are invisible and do not compress. */
static unsigned rounded(unsigned half, unsigned bits) {
    const unsigned unit = 1U << bits;
    if (bits == 0 || (half & 0x7fff) >= 0x7c00 - unit)
        return half;
    return (half + unit / 2 - 1 + (half >> bits & 1)) & ~(unit - 1);
}

static void put_base64(FILE *page, size_t size, const unsigned char *data) {
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < size; i += 3) {
        const size_t left = size - i;
        const unsigned bits = (unsigned)data[i] << 16 | (left > 1 ? (unsigned)data[i + 1] << 8 : 0) |
                              (left > 2 ? (unsigned)data[i + 2] : 0);
        fputc(digits[bits >> 18], page);
        fputc(digits[bits >> 12 & 63], page);
        fputc(left > 1 ? digits[bits >> 6 & 63] : '=', page);
        fputc(left > 2 ? digits[bits & 63] : '=', page);
    }
}

/* For each channel the high bytes, then the low bytes, each as the difference from the previous byte. */
static void lay_out(const report_image *viewed, const size_t *channels, size_t channel_count,
                    unsigned char *bytes) {
    const size_t pixels = aur_image_width(viewed->image) * aur_image_height(viewed->image);
    const size_t stride = aur_image_channel_count(viewed->image);
    const float *const data = aur_image_data(viewed->image);
    for (size_t c = 0; c < channel_count; ++c)
        for (size_t i = 0; i < pixels; ++i) {
            const unsigned half = rounded(half_of(data[i * stride + channels[c]]), viewed->dropped_bits);
            bytes[2 * c * pixels + i] = (unsigned char)(half >> 8);
            bytes[(2 * c + 1) * pixels + i] = (unsigned char)half;
        }
    for (size_t i = 2 * channel_count * pixels; i-- > 1;)
        bytes[i] = (unsigned char)(bytes[i] - bytes[i - 1]);
}

/* Whether the three channels are equal, so that one is stored. */
static bool is_grey(const aur_image *image, const size_t channels[3]) {
    const size_t pixels = aur_image_width(image) * aur_image_height(image);
    const size_t stride = aur_image_channel_count(image);
    const float *const data = aur_image_data(image);
    for (size_t i = 0; i < pixels; ++i)
        for (size_t c = 1; c < 3; ++c)
            if (!(data[i * stride + channels[c]] == data[i * stride + channels[0]]))
                return false;
    return true;
}

aur_result report_put_image(FILE *page, const report_image *viewed, aur_error *error) {
    const size_t width = aur_image_width(viewed->image), height = aur_image_height(viewed->image);
    size_t channels[3];
    if (!aur_image_color_channels(viewed->image, channels))
        return aur_fail(error, AUR_ERROR_ARGUMENT, "%s: an image without colour", viewed->name);
    const size_t channel_count = is_grey(viewed->image, channels) ? 1 : 3;
    const size_t size = 2 * channel_count * width * height;
    uLongf packed_size = compressBound(size);
    unsigned char *const bytes = malloc(size), *const packed = malloc(packed_size);
    const bool allocated = bytes != NULL && packed != NULL;
    if (allocated)
        lay_out(viewed, channels, channel_count, bytes);
    const int level = viewed->quick ? Z_BEST_SPEED : Z_BEST_COMPRESSION;
    const bool good = allocated && compress2(packed, &packed_size, bytes, size, level) == Z_OK;
    if (good) {
        aur_json json = {.stream = page};
        aur_json_open(&json, '{', false);
        aur_json_name(&json, "width");
        aur_json_integer(&json, width);
        aur_json_name(&json, "height");
        aur_json_integer(&json, height);
        aur_json_name(&json, "channels");
        aur_json_integer(&json, channel_count);
        aur_json_name(&json, "reference");
        aur_json_boolean(&json, viewed->reference);
        fputs(", \"name\": \"", page);
        for (const char *c = viewed->name; *c != '\0'; ++c)
            fprintf(page, *c == '"' || *c == '\\' || *c == '<' || (unsigned char)*c < ' ' ? "\\u%04x" : "%c",
                    (unsigned)(unsigned char)*c);
        fputs("\", \"data\": \"", page);
        put_base64(page, packed_size, packed);
        fputs("\"}", page);
    }
    free(bytes);
    free(packed);
    return good ? AUR_OK : aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
}

aur_result report_page_viewer(FILE *page, const char *title, double exposure, const char *unit, size_t count,
                              const report_image *images, aur_error *error) {
    const aur_image *const first = images[0].image;
    for (size_t i = 1; i < count; ++i)
        if (aur_image_width(images[i].image) != aur_image_width(first) ||
            aur_image_height(images[i].image) != aur_image_height(first))
            return aur_fail(error, AUR_ERROR_ARGUMENT,
                            "%s has %zu x %zu pixels, and %s %zu x %zu: a viewer shows images of one size",
                            images[i].name, aur_image_width(images[i].image),
                            aur_image_height(images[i].image), images[0].name, aur_image_width(first),
                            aur_image_height(first));
    aur_print(page, "<figure class=\"viewer\" data-exposure=\"%g\"", exposure);
    if (unit != NULL)
        aur_print(page, " data-unit=\"%s\"", unit);
    fputs("><figcaption>", page);
    report_escape(page, title);
    fputs("</figcaption>\n<script type=\"application/json\">[", page);
    aur_result result = AUR_OK;
    for (size_t i = 0; i < count && result == AUR_OK; ++i) {
        fputs(i > 0 ? ",\n" : "", page);
        result = report_put_image(page, &images[i], error);
    }
    fputs("]</script></figure>\n", page);
    return result;
}
