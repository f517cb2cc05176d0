/* A picture; (0, 0) is its top left corner and (1, 1) its bottom right one. */
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "image/image.h"
#include "material/texture.h"

typedef enum wrap_mode { WRAP_REPEAT, WRAP_MIRROR, WRAP_CLAMP } wrap_mode;

typedef struct bitmap {
    size_t width, height;
    float *rgb; /* 3 * width * height */
    aur_uv_map to_uv;
    enum { FILTER_BILINEAR, FILTER_NEAREST } filter;
    wrap_mode wrap;
    /* Read, and of no use afterwards: */
    bool raw, accelerated;
    int format;
    enum { CHANNEL_RGB, CHANNEL_RED, CHANNEL_GREEN, CHANNEL_BLUE, CHANNEL_ALPHA } channel;
    float factor[3], cutoff;
    const char *path;
    aur_uv_keys uv;
} bitmap;

/* What sRGB stores for a linear value: undoes the reader's decoding for `raw` pictures of 8 bits. */
static float encode(float linear) {
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * powf(linear, 1.0f / 2.4f) - 0.055f;
}

static bool has_8_bits(const char *path) {
    static const char *const endings[] = {".png", ".jpg", ".jpeg", ".bmp", ".tga"};
    const char *const dot = strrchr(path, '.');
    for (size_t i = 0; dot != NULL && i < sizeof endings / sizeof endings[0]; ++i)
        if (strcasecmp(dot, endings[i]) == 0)
            return true;
    return false;
}

static size_t find_channel(const aur_image *image, const char *name, size_t otherwise) {
    for (size_t i = 0; i < image->channel_count; ++i)
        if (strcmp(image->channel_names[i], name) == 0)
            return i;
    return otherwise;
}

/* The channels of red, green and blue (or grey three times), negative and infinite values as 0. */
static aur_result take_rgb(const aur_image *image, const size_t channel[3], float **rgb, aur_error *error) {
    const size_t count = image->width * image->height;
    *rgb = malloc((3 * count + 1) * sizeof **rgb);
    if (*rgb == NULL)
        return aur_fail_memory(error);
    for (size_t i = 0; i < count; ++i) {
        for (size_t k = 0; k < 3; ++k) {
            const float value = image->data[i * image->channel_count + channel[k]];
            (*rgb)[3 * i + k] = isfinite(value) && value > 0.0f ? value : 0.0f;
        }
    }
    return AUR_OK;
}

static void find_colors(const aur_image *image, size_t channel[3]) {
    const size_t grey = find_channel(image, "Y", 0);
    channel[0] = find_channel(image, "R", grey);
    channel[1] = find_channel(image, "G", grey);
    channel[2] = find_channel(image, "B", grey);
}

aur_result aur_read_rgb(const char *path, size_t *width, size_t *height, float **rgb, aur_error *error) {
    aur_image *image;
    aur_result result = aur_image_read(path, &image, error);
    if (result != AUR_OK)
        return result;
    size_t channel[3];
    find_colors(image, channel);
    *width = image->width;
    *height = image->height;
    result = take_rgb(image, channel, rgb, error);
    aur_image_destroy(image);
    return result;
}

/* What the keys make of the picture. */
static aur_result take_texels(bitmap *self, const aur_image *image, aur_error *error) {
    size_t channel[3];
    find_colors(image, channel);
    const size_t alpha = find_channel(image, "A", image->channel_count);
    if (self->channel == CHANNEL_ALPHA)
        channel[0] = channel[1] = channel[2] = alpha < image->channel_count ? alpha : channel[0];
    else if (self->channel != CHANNEL_RGB)
        channel[0] = channel[1] = channel[2] = channel[self->channel - CHANNEL_RED];
    self->width = image->width;
    self->height = image->height;
    const aur_result result = take_rgb(image, channel, &self->rgb, error);
    const bool encodes = self->raw && self->channel != CHANNEL_ALPHA && has_8_bits(self->path);
    const bool opaque = self->channel == CHANNEL_ALPHA && alpha == image->channel_count;
    for (size_t i = 0; result == AUR_OK && i < 3 * self->width * self->height; ++i) {
        float value = opaque ? 1.0f : encodes ? encode(self->rgb[i]) : self->rgb[i];
        value *= self->factor[i % 3];
        self->rgb[i] = !(self->cutoff > 0.0f) ? value : value < self->cutoff ? 0.0f : 1.0f;
    }
    return result;
}

static void note_range(aur_texture *texture, const bitmap *self) {
    double sum[3] = {0.0, 0.0, 0.0};
    const size_t count = self->width * self->height;
    for (size_t i = 0; i < 3 * count; ++i) {
        sum[i % 3] += (double)self->rgb[i];
        texture->maximum = fmaxf(texture->maximum, self->rgb[i]);
    }
    const double n = (double)count;
    texture->mean = (aur_vector){(float)(sum[0] / n), (float)(sum[1] / n), (float)(sum[2] / n)};
}

static const aur_key keys[] = {
    {AUR_KEY_OF_CHOICE(bitmap, "filter_type", filter, "bilinear", "between pixels", "bilinear", "nearest")},
    {AUR_KEY_OF_CHOICE(bitmap, "wrap_mode", wrap, "repeat", "beyond the picture", "repeat", "mirror",
                       "clamp")},
    {AUR_KEY_OF_BOOLEAN(bitmap, "raw", raw, "false", "8-bit values are taken as they are, not as sRGB")},
    {AUR_KEY_OF_TEXT(bitmap, "filename", path, NULL, "the picture, beside the scene; must be given")},
    {AUR_KEY_OF_CHOICE(bitmap, "format", format, "variant",
                       "of no effect: texels are kept in single precision", "variant", "fp16", "float16",
                       "uint8", "auto")},
    {AUR_KEY_OF_CHOICE(bitmap, "channel", channel, "rgb",
                       "what of the picture is used; alpha is 1 in a picture that has none", "rgb", "red",
                       "green", "blue", "alpha")},
    {AUR_KEY_OF_VECTOR(bitmap, "factor", factor, 0.0, 1e30, "1 1 1", "factors of red, green and blue")},
    {AUR_KEY_OF_REAL(bitmap, "cutoff", cutoff, 0.0, 1e30, "0",
                     "if above 0: texels become 1 from there on, after the factor, and 0 below")},
    {AUR_KEY_OF_BOOLEAN(bitmap, "accel", accelerated, "true", "of no effect")},
    AUR_UV_KEYS(bitmap),
};

static aur_result create(aur_parameters *parameters, aur_texture *texture, aur_error *error) {
    bitmap *const self = texture->data;
    /* A model's picture, which is in memory. */
    const aur_parameter *const held = aur_parameters_find(parameters, "bitmap");
    aur_image *image = NULL;
    if (held != NULL && (held->kind != AUR_PARAMETER_OBJECT || strcmp(held->object_kind, "image") != 0))
        return aur_fail_at(error, held->location, AUR_ERROR_FORMAT,
                           "texture 'bitmap': the picture is named by the string 'filename'");
    aur_result result = aur_row_read(&texture->descriptor->row, parameters, self, error);
    if (result == AUR_OK && self->path == NULL)
        result = aur_fail_at(error, parameters->location, AUR_ERROR_FORMAT,
                             "texture 'bitmap' needs the string 'filename'");
    if (result == AUR_OK && held == NULL)
        result = aur_image_read(self->path, &image, error);
    if (result == AUR_OK)
        result = take_texels(self, held != NULL ? held->object : image, error);
    aur_image_destroy(image);
    if (result != AUR_OK)
        return result;
    texture->aspect = (float)self->width / (float)self->height;
    self->to_uv = aur_uv_map_of(&self->uv);
    note_range(texture, self);
    return AUR_OK;
}

static void release(aur_texture *texture) {
    free(((bitmap *)texture->data)->rgb);
}

static size_t wrapped(int64_t index, size_t size, wrap_mode mode) {
    if ((uint64_t)index < size) /* no division where nothing is to be wrapped */
        return (size_t)index;
    const int64_t n = (int64_t)size;
    if (mode == WRAP_CLAMP)
        return (size_t)(index < 0 ? 0 : index < n ? index : n - 1);
    const int64_t period = mode == WRAP_MIRROR ? 2 * n : n;
    /* Division of 32 bits takes a third of the time. */
    int64_t rest = index == (int32_t)index && period == (int32_t)period ? (int32_t)index % (int32_t)period
                                                                        : index % period;
    if (rest < 0)
        rest += period;
    return (size_t)(rest < n ? rest : period - 1 - rest);
}

static aur_vector texel_at(const bitmap *self, size_t x, size_t y) {
    const float *const rgb = &self->rgb[3 * (y * self->width + x)];
    return (aur_vector){rgb[0], rgb[1], rgb[2]};
}

static aur_vector texel(const bitmap *self, int64_t x, int64_t y) {
    return texel_at(self, wrapped(x, self->width, self->wrap), wrapped(y, self->height, self->wrap));
}

/* The texel left above a point, and how far beyond the middle of it the point lies, in texels. */
typedef struct texel_place {
    int64_t i, j;
    float s, t;
} texel_place;

static bool place_of(const bitmap *self, aur_bsdf_point point, texel_place *place) {
    const aur_bsdf_point at = aur_uv_map_apply(&self->to_uv, point.u, point.v);
    const float offset = self->filter == FILTER_NEAREST ? 0.0f : 0.5f;
    const float x = at.u * (float)self->width - offset, y = at.v * (float)self->height - offset;
    if (!(fabsf(x) < 1e15f) || !(fabsf(y) < 1e15f))
        return false;
    const float left = floorf(x), top = floorf(y);
    *place = (texel_place){(int64_t)left, (int64_t)top, x - left, y - top};
    return true;
}

static aur_vector evaluate(const aur_texture *texture, aur_bsdf_point point) {
    const bitmap *const self = texture->data;
    texel_place at;
    if (!place_of(self, point, &at))
        return (aur_vector){0};
    if (self->filter == FILTER_NEAREST)
        return texel(self, at.i, at.j);
    const float s = at.s, t = at.t;
    const size_t x[2] = {wrapped(at.i, self->width, self->wrap), wrapped(at.i + 1, self->width, self->wrap)};
    const size_t y[2] = {wrapped(at.j, self->height, self->wrap),
                         wrapped(at.j + 1, self->height, self->wrap)};
    aur_vector sum = aur_vector_scale(texel_at(self, x[0], y[0]), (1.0f - s) * (1.0f - t));
    sum = aur_vector_add_scaled(sum, s * (1.0f - t), texel_at(self, x[1], y[0]));
    sum = aur_vector_add_scaled(sum, (1.0f - s) * t, texel_at(self, x[0], y[1]));
    return aur_vector_add_scaled(sum, s * t, texel_at(self, x[1], y[1]));
}

/* Of the bilinear patch that the point lies on. */
static void slope(const aur_texture *texture, aur_bsdf_point point, float result[2]) {
    const bitmap *const self = texture->data;
    texel_place at;
    result[0] = result[1] = 0.0f;
    if (self->filter == FILTER_NEAREST || !place_of(self, point, &at))
        return;
    float corner[2][2];
    for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 2; ++i)
            corner[j][i] = aur_luminance(texel(self, at.i + i, at.j + j));
    const float x = ((1.0f - at.t) * (corner[0][1] - corner[0][0]) + at.t * (corner[1][1] - corner[1][0])) *
                    (float)self->width;
    const float y = ((1.0f - at.s) * (corner[1][0] - corner[0][0]) + at.s * (corner[1][1] - corner[0][1])) *
                    (float)self->height;
    const float *const m = self->to_uv.m;
    result[0] = m[0] * x + m[3] * y;
    result[1] = m[1] * x + m[4] * y;
}

const aur_texture_descriptor aur_texture_bitmap = {
    .row = {.name = "bitmap",
            .summary = "a picture from an EXR, PFM, HDR, PNG, JPEG, BMP or TGA file",
            .source = "",
            AUR_ROW_KEYS(keys)},
    .size = sizeof(bitmap),
    .create = create,
    .release = release,
    .evaluate = evaluate,
    .slope = slope,
};
