/* Radiance's RGBE pictures (Ward 1991, "Real Pixels"; the format of Radiance 3). Written by stb, read here:
 * stb's reader never ends on files that are cut short. An EXPOSURE in the header is not applied, as in other
 * renderers. */
#include <math.h>
#include <stb_image_write.h>
#include <stdlib.h>
#include <string.h>

#include "core/text.h"
#include "image/format.h"

static bool recognize(const aur_image_source *source) {
    return aur_image_begins(source, "#?RADIANCE\n", 11) || aur_image_begins(source, "#?RGBE\n", 7);
}

static aur_result fail_broken(const char *what, aur_error *error) {
    return aur_fail(error, AUR_ERROR_FORMAT, "broken HDR: %s", what);
}

/* What is left of a file. */
typedef struct hdr_input {
    const unsigned char *at, *end;
} hdr_input;

/* The next line without its end; false at the end of the file or for a line that is too long. */
static bool next_line(hdr_input *input, char line[256]) {
    for (size_t length = 0; length < 256 && input->at < input->end; ++length) {
        const unsigned char byte = *input->at++;
        line[length] = byte == '\n' ? '\0' : (char)byte;
        if (byte == '\n')
            return true;
    }
    return false;
}

/* Past the header: its lines, an empty one, "-Y height +X width". */
static aur_result read_header(hdr_input *input, size_t size[2], aur_error *error) {
    char line[256];
    bool format = false;
    do {
        if (!next_line(input, line))
            return fail_broken("its header does not end", error);
        format = format || strcmp(line, "FORMAT=32-bit_rle_rgbe") == 0;
    } while (line[0] != '\0');
    if (!format)
        return fail_broken("its header has no FORMAT=32-bit_rle_rgbe", error);
    if (!next_line(input, line))
        return fail_broken("it has no size", error);
    uint64_t height = 0, width = 0;
    const char *end = strncmp(line, "-Y ", 3) == 0 ? aur_read_integer(line + 3, UINT32_MAX, &height) : NULL;
    end = end != NULL && strncmp(end, " +X ", 4) == 0 ? aur_read_integer(end + 4, UINT32_MAX, &width) : NULL;
    if (end == NULL)
        return fail_broken("its size is not of the form '-Y height +X width'", error);
    size[0] = (size_t)width;
    size[1] = (size_t)height;
    return aur_image_check_size(size[0], size[1], 3, error);
}

/* One component of a row in run lengths: above 128 a run, else bytes as they are. */
static bool decode_runs(hdr_input *input, size_t width, unsigned char *row) {
    for (size_t x = 0; x < width;) {
        if (input->end - input->at < 2)
            return false;
        const bool run = *input->at > 128;
        const size_t count = run ? *input->at - 128u : *input->at;
        ++input->at;
        if (count == 0 || count > width - x || (!run && count > (size_t)(input->end - input->at)))
            return false;
        if (run)
            memset(row + x, *input->at, count);
        else
            memcpy(row + x, input->at, count);
        input->at += run ? 1 : count;
        x += count;
    }
    return true;
}

/* A row as four planes of width bytes. */
static bool decode_row(hdr_input *input, size_t width, unsigned char *planes) {
    const size_t left = (size_t)(input->end - input->at);
    if (left < 4)
        return false;
    const unsigned char *const start = input->at;
    if (start[0] == 2 && start[1] == 2 && start[2] < 128) {
        if ((size_t)start[2] * 256 + start[3] != width)
            return false;
        input->at += 4;
        for (size_t plane = 0; plane < 4; ++plane)
            if (!decode_runs(input, width, planes + plane * width))
                return false;
        return true;
    }
    if (left / 4 < width)
        return false;
    for (size_t x = 0; x < width; ++x)
        for (size_t plane = 0; plane < 4; ++plane)
            planes[plane * width + x] = *input->at++;
    return true;
}

static aur_result decode_rows(hdr_input *input, const aur_image *image, aur_error *error) {
    const size_t width = image->width;
    unsigned char *const planes = malloc(4 * width);
    if (planes == NULL)
        return aur_fail_memory(error);
    aur_result result = AUR_OK;
    for (size_t y = 0; y < image->height && result == AUR_OK; ++y) {
        if (!decode_row(input, width, planes)) {
            result = fail_broken("its pixels are damaged or cut short", error);
            break;
        }
        for (size_t x = 0; x < width; ++x) {
            const int exponent = planes[3 * width + x];
            const float factor = exponent > 0 ? ldexpf(1.0f, exponent - 136) : 0.0f;
            for (size_t c = 0; c < 3; ++c)
                image->data[(y * width + x) * 3 + c] = factor * (float)planes[c * width + x];
        }
    }
    free(planes);
    return result;
}

static aur_result read_hdr(const aur_image_source *source, aur_image **image, aur_error *error) {
    hdr_input input = {source->data, source->data + source->size};
    size_t size[2] = {0, 0};
    aur_result result = read_header(&input, size, error);
    if (result != AUR_OK)
        return result;
    /* Two bytes make 127 bytes of a row at most, and four bytes are a pixel. */
    if (size[0] * size[1] / 16 > source->size)
        return fail_broken("it claims more pixels than it can hold", error);
    result = aur_image_create(size[0], size[1], 3, image, error);
    return result == AUR_OK ? decode_rows(&input, *image, error) : result;
}

/* The largest radiance that RGBE holds: mantissa 255/256, exponent 127. */
static float hdr_value(float radiance) {
    const float largest = 255.0f / 256.0f * 0x1p127f;
    return radiance > 0.0f ? fminf(radiance, largest) : 0.0f;
}

/* The encoder cuts mantissas off, which would darken the picture: round them before. */
static void round_to_rgbe(float rgb[3]) {
    const float brightest = fmaxf(rgb[0], fmaxf(rgb[1], rgb[2]));
    if (brightest < 1e-32f)
        return;
    int exponent;
    const float mantissa = frexpf(brightest, &exponent);
    if (mantissa > 255.5f / 256.0f && exponent < 127)
        ++exponent;
    const float quantum = ldexpf(1.0f, exponent - 8);
    for (size_t c = 0; c < 3; ++c)
        rgb[c] = fminf(floorf(rgb[c] / quantum + 0.5f), 255.0f) * quantum;
}

static aur_result write_hdr(const aur_image_target *target, const aur_image *image, aur_error *error) {
    const size_t pixels = image->width * image->height;
    float *const values = malloc(pixels * 3 * sizeof *values);
    if (values == NULL)
        return aur_image_fail_encode(error);
    for (size_t i = 0; i < pixels; ++i) {
        for (size_t c = 0; c < 3; ++c)
            values[3 * i + c] = hdr_value(image->data[i * image->channel_count + target->channels[c]]);
        round_to_rgbe(values + 3 * i);
    }
    const int written = stbi_write_hdr_to_func(aur_image_put_bytes, target->stream, (int)image->width,
                                               (int)image->height, 3, values);
    free(values);
    return written != 0 ? AUR_OK : aur_image_fail_encode(error);
}

const aur_image_format aur_image_format_hdr = {
    .row = {.name = "hdr",
            .summary = "Radiance's RGBE: R, G, B, 8 bits each and a common exponent",
            .source = "Ward 1991"},
    .name = "HDR",
    .recognize = recognize,
    .read = read_hdr,
    .write = write_hdr};
