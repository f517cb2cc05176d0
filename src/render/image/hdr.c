/* Radiance's RGBE images (Ward 1991, "Real Pixels"; the format of Radiance 3). Written by stb, read here:
 * stb's reader never ends on files that are cut short. */
#include <math.h>
#include <stb_image_write.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/text.h"
#include "render/image/format.h"

static bool recognize(const aur_image_source *source) {
    return aur_image_begins(source, "#?RADIANCE", 10) || aur_image_begins(source, "#?RGBE", 6);
}

static aur_result fail_broken(const char *what, aur_error *error) {
    return aur_fail(error, AUR_ERROR_FORMAT, "broken HDR: %s", what);
}

/* What is left of a file. */
typedef struct hdr_input {
    const unsigned char *at, *end;
} hdr_input;

/* The values of the header. */
typedef struct hdr_header {
    bool xyz;          /* X, Y, Z instead of R, G, B */
    double divisor[3]; /* of the values: EXPOSURE and COLORCORR multiplied */
    bool primaries;    /* of other colours than ours */
    /* Scan lines follow each other along `slow`, from its end where `backward[0]`, and so do pixels in them.
     */
    bool columns, backward[2]; /* columns: scan lines are columns, and begin at the top unless backward[1] */
    size_t lines, length;
} hdr_header;

/* The next line without its end, cut where it is too long; false at the end of the file. */
static bool next_line(hdr_input *input, char line[256]) {
    for (size_t length = 0; input->at < input->end;) {
        const unsigned char byte = *input->at++;
        if (byte == '\n') {
            line[length > 0 && line[length - 1] == '\r' ? length - 1 : length] = '\0';
            return true;
        }
        if (length < 255)
            line[length++] = (char)byte;
    }
    return false;
}

/* The numbers of a line that begins with "NAME=". */
static bool read_values(const char *line, const char *name, size_t count, double *values) {
    const size_t length = strlen(name);
    return strncmp(line, name, length) == 0 && line[length] == '=' &&
           aur_parse_doubles(line + length + 1, values, count) == count;
}

/* Whether chromaticities are Rec. 709's, or Radiance's default for files without any, which other renderers
 * read as Rec. 709, too. */
static bool is_usual(const double chromaticities[8]) {
    static const double usual[2][8] = {{0.64, 0.33, 0.29, 0.6, 0.15, 0.06, 0.3333, 0.3333},
                                       {0.64, 0.33, 0.3, 0.6, 0.15, 0.06, 0.3127, 0.329}};
    double distance[2] = {0.0, 0.0};
    for (size_t i = 0; i < 16; ++i)
        distance[i / 8] = fmax(distance[i / 8], fabs(chromaticities[i % 8] - usual[i / 8][i % 8]));
    return fmin(distance[0], distance[1]) < 2e-3;
}

static aur_result read_setting(const char *line, hdr_header *header, bool *format, aur_error *error) {
    double values[8];
    const bool exposure = read_values(line, "EXPOSURE", 1, values);
    if (exposure)
        values[2] = values[1] = values[0];
    if (exposure || read_values(line, "COLORCORR", 3, values)) {
        for (size_t c = 0; c < 3; ++c) {
            header->divisor[c] *= values[c];
            if (!(header->divisor[c] > 0.0) || !isfinite(header->divisor[c]))
                return fail_broken("EXPOSURE and COLORCORR must be positive", error);
        }
    } else if (read_values(line, "PRIMARIES", 8, values)) {
        header->primaries = !is_usual(values);
    } else if (strncmp(line, "FORMAT=", 7) == 0) {
        const char *const name = aur_skip_spaces(line + 7);
        header->xyz = strncmp(name, "32-bit_rle_xyze", 15) == 0;
        *format = header->xyz || strncmp(name, "32-bit_rle_rgbe", 15) == 0;
    }
    return AUR_OK;
}

/* "-Y 480 +X 640": the axis of the scan lines first. -Y goes down, +X to the right. */
static bool read_size(const char *line, hdr_header *header) {
    char axes[2];
    for (size_t i = 0; i < 2; ++i) {
        uint64_t size = 0;
        line = aur_skip_spaces(line);
        const bool minus = *line == '-';
        if (!minus && *line != '+')
            return false;
        axes[i] = line[1];
        if (axes[i] != 'X' && axes[i] != 'Y')
            return false;
        header->backward[i] = minus == (axes[i] == 'X');
        line = aur_read_integer(aur_skip_spaces(line + 2), UINT32_MAX, &size);
        if (line == NULL)
            return false;
        *(i == 0 ? &header->lines : &header->length) = (size_t)size;
    }
    header->columns = axes[0] == 'X';
    return axes[0] != axes[1] && *aur_skip_spaces(line) == '\0';
}

/* Reads the header: its lines, an empty one, the size. */
static aur_result read_header(hdr_input *input, hdr_header *header, aur_error *error) {
    char line[256];
    bool format = false;
    do {
        if (!next_line(input, line))
            return fail_broken("its header does not end", error);
        const aur_result result = read_setting(line, header, &format, error);
        if (result != AUR_OK)
            return result;
    } while (line[0] != '\0');
    if (!format)
        return fail_broken("its header has no FORMAT=32-bit_rle_rgbe", error);
    if (!next_line(input, line))
        return fail_broken("it has no size", error);
    if (!read_size(line, header))
        return fail_broken("its size is not of the form '-Y height +X width'", error);
    return aur_image_check_size(header->columns ? header->lines : header->length,
                                header->columns ? header->length : header->lines, 3, error);
}

/* Decodes one component of a row: a run for lengths above 128, else literal bytes. */
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

/* Decodes pixels that are uncompressed or in the old run lengths: 1, 1, 1 and n repeats the previous pixel n
 * times; the next such pixel directly after it, 256 n times. */
static bool decode_old(hdr_input *input, size_t width, unsigned char *planes) {
    size_t shift = 0;
    for (size_t x = 0; x < width;) {
        if (input->end - input->at < 4)
            return false;
        const unsigned char *const pixel = input->at;
        input->at += 4;
        const bool run = pixel[0] == 1 && pixel[1] == 1 && pixel[2] == 1;
        if (run && (x == 0 || shift > 24))
            return false;
        const size_t count = run ? (size_t)pixel[3] << shift : 1;
        if (count > width - x)
            return false;
        shift = run ? shift + 8 : 0;
        for (size_t plane = 0; plane < 4; ++plane)
            memset(planes + plane * width + x, run ? planes[plane * width + x - 1] : pixel[plane], count);
        x += count;
    }
    return true;
}

/* A scan line as four planes of `width` bytes. */
static bool decode_line(hdr_input *input, size_t width, unsigned char *planes) {
    const unsigned char *const start = input->at;
    const bool runs = width >= 8 && width < 32768 && input->end - start >= 4 && start[0] == 2 &&
                      start[1] == 2 && start[2] < 128;
    if (!runs)
        return decode_old(input, width, planes);
    if ((size_t)start[2] * 256 + start[3] != width)
        return false;
    input->at += 4;
    for (size_t plane = 0; plane < 4; ++plane)
        if (!decode_runs(input, width, planes + plane * width))
            return false;
    return true;
}

/* Converts a pixel of four bytes to radiance. XYZE is in lumens (179 lm/W for Radiance's white), and is
 * converted to the primaries .64 .33, .29 .6, .15 .06 and the white of equal energy, as in `ra_xyze -r`. */
static void decode_pixel(const hdr_header *header, const unsigned char *mantissa, size_t step, float rgb[3]) {
    static const double to_rgb[3][3] = {{2.56531284, -1.16684962, -0.39846323},
                                        {-1.02210817, 1.97828662, 0.04382156},
                                        {0.07472438, -0.25193957, 1.17721519}};
    const int exponent = mantissa[3 * step];
    const double factor = exponent > 0 ? ldexp(1.0, exponent - 136) : 0.0;
    double value[3];
    for (size_t c = 0; c < 3; ++c)
        value[c] = factor * (double)mantissa[c * step] / header->divisor[c];
    for (size_t c = 0; c < 3; ++c)
        rgb[c] = (float)(header->xyz ? fmax(0.0, (to_rgb[c][0] * value[0] + to_rgb[c][1] * value[1] +
                                                  to_rgb[c][2] * value[2]) /
                                                     179.0)
                                     : value[c]);
}

static aur_result decode_lines(hdr_input *input, const hdr_header *header, const aur_image *image,
                               aur_error *error) {
    const size_t length = header->length;
    unsigned char *const planes = malloc(4 * length);
    if (planes == NULL)
        return aur_fail_memory(error);
    aur_result result = AUR_OK;
    for (size_t i = 0; i < header->lines && result == AUR_OK; ++i) {
        if (!decode_line(input, length, planes)) {
            result = fail_broken("its pixels are damaged or cut short", error);
            break;
        }
        const size_t line = header->backward[0] ? header->lines - 1 - i : i;
        for (size_t k = 0; k < length; ++k) {
            const size_t column = header->backward[1] ? length - 1 - k : k;
            const size_t pixel =
                header->columns ? column * image->width + line : line * image->width + column;
            decode_pixel(header, planes + k, length, image->data + 3 * pixel);
        }
    }
    free(planes);
    return result;
}

static aur_result read_hdr(const aur_image_source *source, aur_image **image, aur_error *error) {
    hdr_input input = {source->data, source->data + source->size};
    hdr_header header = {.divisor = {1.0, 1.0, 1.0}};
    aur_result result = read_header(&input, &header, error);
    if (result != AUR_OK)
        return result;
    /* Twelve bytes make a scan line of 65536 pixels in the old run lengths; longer ones are rare. */
    if (header.lines * header.length / 8192 > source->size)
        return fail_broken("it claims more pixels than it can hold", error);
    result = header.columns ? aur_image_create(header.lines, header.length, 3, image, error)
                            : aur_image_create(header.length, header.lines, 3, image, error);
    if (result == AUR_OK)
        result = decode_lines(&input, &header, *image, error);
    if (result == AUR_OK && header.primaries)
        aur_image_note(*image, "its PRIMARIES are not those of Rec. 709: colours are read as if they were");
    return result;
}

/* The largest radiance of RGBE: mantissa 255/256, exponent 127. */
static float hdr_value(float radiance) {
    const float largest = 255.0f / 256.0f * 0x1p127f;
    return radiance > 0.0f ? fminf(radiance, largest) : 0.0f;
}

/* The encoder cuts mantissas off, which would darken the image: round them before. */
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
