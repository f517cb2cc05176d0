/* An image texture; (0, 0) is its top left corner and (1, 1) its bottom right one. */
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "render/image/format.h"
#include "render/scene/materials/bitmap.h"
#include "render/scene/materials/texture.h"

typedef enum wrap_mode { WRAP_REPEAT, WRAP_MIRROR, WRAP_CLAMP, WRAP_SAME } wrap_mode;

typedef struct bitmap {
    aur_bitmap texels; /* colours are not negative, heights may be */
    aur_uv_map to_uv;
    enum { FILTER_BILINEAR, FILTER_NEAREST } filter;
    wrap_mode wrap, wrap_v; /* along u and v */
    /* Read, not used afterwards: */
    bool raw;
    enum { CHANNEL_RGB, CHANNEL_RED, CHANNEL_GREEN, CHANNEL_BLUE, CHANNEL_ALPHA } channel;
    float factor[3], cutoff;
    const char *path;
    aur_uv_keys uv;
    bool encodes, opaque;
} bitmap;

/* The sRGB encoding of a linear value: undoes the reader's decoding for `raw` 8-bit images. */
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

/* Infinite values become the largest half, as in other renderers, and NaN 0. */
static float finite_value(float value) {
    const float largest = 65504.0f;
    return isfinite(value) ? value : isnan(value) ? 0.0f : copysignf(largest, value);
}

aur_result aur_image_radiance(const char *name, const aur_image *image, float **rgb, aur_error *error) {
    const size_t count = image->width * image->height;
    size_t channel[3];
    *rgb = NULL;
    const aur_result result = aur_image_require_color(name, image, channel, error);
    if (result != AUR_OK)
        return result;
    *rgb = malloc((3 * count + 1) * sizeof **rgb);
    if (*rgb == NULL)
        return aur_fail_memory(error);
    for (size_t i = 0; i < count; ++i)
        for (size_t k = 0; k < 3; ++k)
            (*rgb)[3 * i + k] = fmaxf(finite_value(image->data[i * image->channel_count + channel[k]]), 0.0f);
    return AUR_OK;
}

/* The channels selected by the parameter `channel`; none if alpha is selected but absent. */
static aur_result choose_channels(const bitmap *self, const aur_image *image, size_t channel[3],
                                  aur_error *error) {
    if (self->channel == CHANNEL_ALPHA) {
        const char *const layer =
            aur_image_color_channels(image, channel) ? image->channel_names[channel[0]] : "";
        channel[0] = channel[1] = channel[2] = aur_image_find_role(image, layer, AUR_CHANNEL_ALPHA);
        return AUR_OK;
    }
    const aur_result result = aur_image_require_color(self->path, image, channel, error);
    if (result == AUR_OK && self->channel != CHANNEL_RGB)
        channel[0] = channel[1] = channel[2] = channel[self->channel - CHANNEL_RED];
    return result;
}

/* The value stored for an image value, given the parameters. */
static float map_value(const void *context, size_t channel, float value) {
    const bitmap *const self = context;
    value = self->opaque ? 1.0f : finite_value(value);
    value = (self->encodes ? encode(value) : value) * self->factor[channel];
    return !(self->cutoff > 0.0f) ? value : value < self->cutoff ? 0.0f : 1.0f;
}

static aur_result take_texels(aur_texture *texture, const aur_image *image, aur_error *error) {
    bitmap *const self = texture->data;
    aur_texel_source source = {.width = image->width,
                               .height = image->height,
                               .stride = image->channel_count,
                               .data = image->data,
                               .codes = image->codes,
                               .map = map_value,
                               .context = self,
                               .same =
                                   self->factor[0] == self->factor[1] && self->factor[0] == self->factor[2]};
    aur_texel_range range;
    aur_result result = choose_channels(self, image, source.channel, error);
    if (result != AUR_OK)
        return result;
    self->opaque = source.channel[0] == SIZE_MAX;
    if (self->opaque)
        source.channel[0] = source.channel[1] = source.channel[2] = 0;
    if (image->codes != NULL)
        aur_image_code_values(image, source.channel[0], source.code_values);
    self->encodes = self->raw && self->channel != CHANNEL_ALPHA && has_8_bits(self->path);
    result = aur_bitmap_pack(&source, texture->pages, &self->texels, &range, error);
    if (result != AUR_OK)
        return result;
    const double count = (double)(image->width * image->height);
    texture->mean = (aur_vector){(float)(range.sum[0] / count), (float)(range.sum[1] / count),
                                 (float)(range.sum[2] / count)};
    texture->maximum = range.maximum;
    texture->aspect = (float)image->width / (float)image->height;
    return AUR_OK;
}

static const aur_key keys[] = {
    {AUR_KEY_OF_CHOICE(bitmap, "filter_type", filter, "bilinear",
                       "between pixels; trilinear and ewa of Mitsuba 0.6 are read as bilinear", "bilinear",
                       "nearest", "trilinear", "ewa")},
    {AUR_KEY_OF_CHOICE(bitmap, "wrap_mode", wrap, "repeat", "texture coordinates outside of the image",
                       "repeat", "mirror", "clamp")},
    {AUR_KEY_OF_CHOICE(bitmap, "wrap_mode_v", wrap_v, "same", "the same along v; same: as wrap_mode",
                       "repeat", "mirror", "clamp", "same")},
    {AUR_KEY_OF_BOOLEAN(bitmap, "raw", raw, "false", "8-bit values are taken as they are, not as sRGB")},
    {AUR_KEY_OF_TEXT(bitmap, "filename", path, NULL, "image file, relative to the scene; required")},
    {AUR_KEY_OF_CHOICE(bitmap, "channel", channel, "rgb",
                       "channels to use; alpha is 1 in an image without it", "rgb", "red", "green", "blue",
                       "alpha")},
    {AUR_KEY_OF_VECTOR(bitmap, "factor", factor, 0.0, 1e30, "1 1 1", "factors of red, green and blue")},
    {AUR_KEY_OF_REAL(bitmap, "cutoff", cutoff, 0.0, 1e30, "0",
                     "if above 0: texels become 1 from there on, after the factor, and 0 below")},
    AUR_UV_KEYS(bitmap),
};

static aur_result create(aur_parameters *parameters, aur_texture *texture, aur_error *error) {
    bitmap *const self = texture->data;
    /* A model's image in memory. */
    const aur_parameter *const held = aur_parameters_find(parameters, "bitmap");
    aur_image *image = NULL;
    if (held != NULL && (held->kind != AUR_PARAMETER_OBJECT || strcmp(held->object_kind, "image") != 0))
        return aur_fail_at(error, held->location, AUR_ERROR_FORMAT,
                           "texture 'bitmap': the image is named by the string 'filename'");
    aur_result result = aur_row_read(&texture->descriptor->row, parameters, self, error);
    if (result == AUR_OK && self->path == NULL)
        result = aur_fail_at(error, parameters->location, AUR_ERROR_FORMAT,
                             "texture 'bitmap' needs the string 'filename'");
    if (result == AUR_OK && held == NULL)
        result = aur_image_read(self->path, &image, error);
    if (result == AUR_OK)
        result = take_texels(texture, held != NULL ? held->object : image, error);
    aur_image_destroy(image);
    if (result != AUR_OK)
        return result;
    self->to_uv = aur_uv_map_of(&self->uv);
    if (self->wrap_v == WRAP_SAME)
        self->wrap_v = self->wrap;
    return AUR_OK;
}

static void release(void *data) {
    aur_bitmap_release(&((bitmap *)data)->texels);
}

static size_t wrapped(int64_t index, size_t size, wrap_mode mode) {
    if ((uint64_t)index < size) /* avoids the division if no wrapping is needed */
        return (size_t)index;
    const int64_t n = (int64_t)size;
    if (mode == WRAP_CLAMP)
        return (size_t)(index < 0 ? 0 : index < n ? index : n - 1);
    const int64_t period = mode == WRAP_MIRROR ? 2 * n : n;
    /* 32-bit division takes a third of the time. */
    int64_t rest = index == (int32_t)index && period == (int32_t)period ? (int32_t)index % (int32_t)period
                                                                        : index % period;
    if (rest < 0)
        rest += period;
    return (size_t)(rest < n ? rest : period - 1 - rest);
}

static aur_vector texel_at(const bitmap *self, size_t x, size_t y) {
    float rgb[3];
    aur_bitmap_at(&self->texels, x, y, rgb);
    return (aur_vector){rgb[0] > 0.0f ? rgb[0] : 0.0f, rgb[1] > 0.0f ? rgb[1] : 0.0f,
                        rgb[2] > 0.0f ? rgb[2] : 0.0f};
}

static aur_vector texel(const bitmap *self, int64_t x, int64_t y) {
    return texel_at(self, wrapped(x, self->texels.width, self->wrap),
                    wrapped(y, self->texels.height, self->wrap_v));
}

static float height_at(const bitmap *self, int64_t x, int64_t y) {
    float rgb[3];
    aur_bitmap_at(&self->texels, wrapped(x, self->texels.width, self->wrap),
                  wrapped(y, self->texels.height, self->wrap_v), rgb);
    return aur_luminance((aur_vector){rgb[0], rgb[1], rgb[2]});
}

/* The texel to the upper left of a point, and the point's offset from its centre, in texels. */
typedef struct texel_position {
    int64_t i, j;
    float s, t;
} texel_position;

/* floorf without a call. */
static int64_t floor_of(float x) {
    const int64_t whole = (int64_t)x;
    return whole - (x < (float)whole);
}

static bool find_texel(const bitmap *self, aur_bsdf_point point, texel_position *position) {
    const aur_bsdf_point at = aur_uv_map_apply(&self->to_uv, point.u, point.v);
    const float offset = self->filter == FILTER_NEAREST ? 0.0f : 0.5f;
    const float x = at.u * (float)self->texels.width - offset, y = at.v * (float)self->texels.height - offset;
    if (!(fabsf(x) < 1e15f) || !(fabsf(y) < 1e15f))
        return false;
    const int64_t left = floor_of(x), top = floor_of(y);
    *position = (texel_position){left, top, x - (float)left, y - (float)top};
    return true;
}

static void prefetch(const aur_texture *texture, aur_bsdf_point point) {
    const bitmap *const self = texture->data;
    texel_position at;
    if (!find_texel(self, point, &at))
        return;
    const size_t bytes = self->texels.channels * self->texels.value_bytes;
    const size_t x = wrapped(at.i, self->texels.width, self->wrap);
    for (int64_t row = 0; row < 2; ++row) {
        const size_t y = wrapped(at.j + row, self->texels.height, self->wrap_v);
        __builtin_prefetch(self->texels.values + aur_bitmap_index(&self->texels, x, y) * bytes);
    }
}

/* Texels of one byte in memory. */
static inline const unsigned char *byte_at(const aur_bitmap *texels, size_t x, size_t y) {
    return texels->values + aur_bitmap_index(texels, x, y) * texels->channels;
}

/* The same sum as in `evaluate` for texels of one byte in memory, which most images have: without branches
 * for each value, and once for grey. */
static aur_vector byte_texels(const bitmap *self, const size_t x[2], const size_t y[2], float s, float t) {
    const aur_bitmap *const texels = &self->texels;
    const unsigned char *const texel[4] = {byte_at(texels, x[0], y[0]), byte_at(texels, x[1], y[0]),
                                           byte_at(texels, x[0], y[1]), byte_at(texels, x[1], y[1])};
    const float weight[4] = {(1.0f - s) * (1.0f - t), s * (1.0f - t), (1.0f - s) * t, s * t};
    const bool grey = texels->channels == 1, same = texels->table_step == 0;
    float rgb[3];
    for (size_t c = 0; c < (grey && same ? 1 : 3); ++c) {
        const float *const table = texels->table + c * texels->table_step;
        const size_t at = grey ? 0 : c;
        float sum = 0.0f;
        for (size_t i = 0; i < 4; ++i) {
            const float value = table[texel[i][at]], term = (value > 0.0f ? value : 0.0f) * weight[i];
            sum = i == 0 ? term : sum + term;
        }
        rgb[c] = sum;
    }
    return grey && same ? (aur_vector){rgb[0], rgb[0], rgb[0]} : (aur_vector){rgb[0], rgb[1], rgb[2]};
}

static aur_vector evaluate(const aur_texture *texture, aur_bsdf_point point) {
    const bitmap *const self = texture->data;
    texel_position at;
    if (!find_texel(self, point, &at))
        return (aur_vector){0};
    if (self->filter == FILTER_NEAREST)
        return texel(self, at.i, at.j);
    const float s = at.s, t = at.t;
    const size_t x[2] = {wrapped(at.i, self->texels.width, self->wrap),
                         wrapped(at.i + 1, self->texels.width, self->wrap)};
    const size_t y[2] = {wrapped(at.j, self->texels.height, self->wrap_v),
                         wrapped(at.j + 1, self->texels.height, self->wrap_v)};
    if (self->texels.value_bytes == 1 && self->texels.pages == NULL)
        return byte_texels(self, x, y, s, t);
    aur_vector sum = aur_vector_scale(texel_at(self, x[0], y[0]), (1.0f - s) * (1.0f - t));
    sum = aur_vector_add_scaled(sum, s * (1.0f - t), texel_at(self, x[1], y[0]));
    sum = aur_vector_add_scaled(sum, (1.0f - s) * t, texel_at(self, x[0], y[1]));
    return aur_vector_add_scaled(sum, s * t, texel_at(self, x[1], y[1]));
}

/* Derivatives of the bilinear patch at the point. */
static void slope(const aur_texture *texture, aur_bsdf_point point, float result[2]) {
    const bitmap *const self = texture->data;
    texel_position at;
    result[0] = result[1] = 0.0f;
    if (self->filter == FILTER_NEAREST || !find_texel(self, point, &at))
        return;
    float corner[2][2];
    for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 2; ++i)
            corner[j][i] = height_at(self, at.i + i, at.j + j);
    const float x = ((1.0f - at.t) * (corner[0][1] - corner[0][0]) + at.t * (corner[1][1] - corner[1][0])) *
                    (float)self->texels.width;
    const float y = ((1.0f - at.s) * (corner[1][0] - corner[0][0]) + at.s * (corner[1][1] - corner[0][1])) *
                    (float)self->texels.height;
    const float *const m = self->to_uv.m;
    result[0] = m[0] * x + m[3] * y;
    result[1] = m[1] * x + m[4] * y;
}

const aur_texture_descriptor aur_texture_bitmap = {
    .row = {.name = "bitmap",
            .summary = "an image from an EXR, PFM, HDR, PNG, JPEG, BMP or TGA file",
            .source = "",
            AUR_ROW_KEYS(keys)},
    .size = sizeof(bitmap),
    .create = create,
    .release = release,
    .evaluate = evaluate,
    .prefetch = prefetch,
    .slope = slope,
};
