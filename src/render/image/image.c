#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/text.h"
#include "render/image/format.h"

static const char *default_name(size_t channel_count, size_t channel) {
    static const char *const names[5][4] = {{""}, {"Y"}, {"Y", "A"}, {"R", "G", "B"}, {"R", "G", "B", "A"}};
    return channel_count <= 4 ? names[channel_count][channel] : "";
}

/* No overflow whatever the arguments are. */
static bool size_is_allowed(size_t width, size_t height, size_t channel_count) {
    if (width == 0 || height == 0 || channel_count == 0)
        return false;
    if (width > AUR_IMAGE_VALUES_MAX || height > AUR_IMAGE_VALUES_MAX / width)
        return false;
    return channel_count <= AUR_IMAGE_VALUES_MAX / (width * height);
}

typedef enum storage { FLOATS, CODES } storage;

/* `data` NULL: allocated by the image and zeroed. */
static aur_result create(size_t width, size_t height, size_t channel_count, float *data, storage kind,
                         aur_image **image, aur_error *error) {
    *image = NULL;
    if (!size_is_allowed(width, height, channel_count))
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "an image of %zu x %zu pixels with %zu channels: there must be 1 to 2^30 values",
                        width, height, channel_count);
    aur_image *const created = calloc(1, sizeof *created);
    if (created == NULL)
        return aur_fail_memory(error);
    created->width = width;
    created->height = height;
    created->channel_count = channel_count;
    created->data_is_owned = data == NULL;
    const size_t count = width * height * channel_count;
    created->data = data;
    if (kind == CODES)
        created->codes = calloc(count, 1);
    else if (data == NULL)
        created->data = calloc(count, sizeof *created->data);
    created->channel_names = calloc(channel_count, sizeof *created->channel_names);
    if ((created->data == NULL && created->codes == NULL) || created->channel_names == NULL) {
        aur_image_destroy(created);
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory for %zu x %zu pixels with %zu channels",
                        width, height, channel_count);
    }
    for (size_t c = 0; c < channel_count; ++c)
        strcpy(created->channel_names[c], default_name(channel_count, c));
    *image = created;
    return AUR_OK;
}

aur_result aur_image_create(size_t width, size_t height, size_t channel_count, aur_image **image,
                            aur_error *error) {
    return create(width, height, channel_count, NULL, FLOATS, image, error);
}

aur_result aur_image_create_coded(size_t width, size_t height, size_t channel_count, aur_image **image,
                                  aur_error *error) {
    return create(width, height, channel_count, NULL, CODES, image, error);
}

void aur_image_code_values(const aur_image *image, size_t channel, float values[256]) {
    const bool alpha = image->channel_count % 2 == 0 && channel + 1 == image->channel_count;
    for (size_t i = 0; i < 256; ++i)
        values[i] = alpha ? (float)i / 255.0f : (float)aur_srgb_decode((double)i / 255.0);
}

/* Codes are moved to the last quarter of the memory: code i is read before float i overwrites it. */
aur_result aur_image_expand(aur_image *image, aur_error *error) {
    if (image->codes == NULL)
        return AUR_OK;
    const size_t channels = image->channel_count, count = image->width * image->height * channels;
    float *const data = realloc(image->codes, count * sizeof *data);
    if (data == NULL)
        return aur_fail_memory(error);
    unsigned char *const codes = (unsigned char *)data + 3 * count;
    memmove(codes, data, count);
    float color[256], last[256];
    aur_image_code_values(image, 0, color);
    aur_image_code_values(image, channels - 1, last);
    for (size_t i = 0; i < count; i += channels)
        for (size_t c = 0; c < channels; ++c)
            data[i + c] = (c + 1 == channels ? last : color)[codes[i + c]];
    image->codes = NULL;
    image->data = data;
    return AUR_OK;
}

aur_result aur_image_wrap(size_t width, size_t height, size_t channel_count, float *data, aur_image **image,
                          aur_error *error) {
    return create(width, height, channel_count, data, FLOATS, image, error);
}

void aur_image_destroy(aur_image *image) {
    if (image == NULL)
        return;
    if (image->data_is_owned)
        free(image->data);
    free(image->codes);
    free(image->channel_names);
    free(image);
}

size_t aur_image_width(const aur_image *image) {
    return image->width;
}

size_t aur_image_height(const aur_image *image) {
    return image->height;
}

size_t aur_image_channel_count(const aur_image *image) {
    return image->channel_count;
}

float *aur_image_data(const aur_image *image) {
    return image->data;
}

const char *aur_image_channel_name(const aur_image *image, size_t channel) {
    return channel < image->channel_count ? image->channel_names[channel] : NULL;
}

aur_result aur_image_name_channel(aur_image *image, size_t channel, const char *name, aur_error *error) {
    if (channel >= image->channel_count || strlen(name) >= AUR_CHANNEL_NAME_CAPACITY)
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "channel %zu of %zu cannot be named '%s': names have at most %d bytes", channel,
                        image->channel_count, name, AUR_CHANNEL_NAME_CAPACITY - 1);
    strcpy(image->channel_names[channel], name);
    return AUR_OK;
}

const char *aur_image_notes(const aur_image *image) {
    return image->notes;
}

void aur_image_note(aur_image *image, const char *format, ...) {
    const size_t used = strlen(image->notes);
    const char *const between = used > 0 ? "; " : "";
    va_list arguments;
    va_start(arguments, format);
    char text[AUR_NOTES_CAPACITY];
    aur_format_list(text, sizeof text, format, arguments);
    va_end(arguments);
    aur_format(image->notes + used, sizeof image->notes - used, "%s%s", between, text);
}

bool aur_image_begins(const aur_image_source *source, const char *bytes, size_t count) {
    return source->size >= count && memcmp(source->data, bytes, count) == 0;
}

void aur_image_put_bytes(void *stream, void *bytes, int count) {
    fwrite(bytes, 1, (size_t)count, stream);
}

aur_result aur_image_fail_encode(aur_error *error) {
    return aur_fail(error, AUR_ERROR_MEMORY, "cannot encode the image: out of memory");
}

aur_result aur_image_check_size(size_t width, size_t height, size_t channel_count, aur_error *error) {
    if (size_is_allowed(width, height, channel_count))
        return AUR_OK;
    return aur_fail(error, AUR_ERROR_FORMAT,
                    "claims %zu x %zu pixels with %zu channels: there must be 1 to 2^30 values", width,
                    height, channel_count);
}

aur_result aur_image_check_claim(const aur_image_source *source, const char *format, size_t pixel_count,
                                 size_t pixels_a_byte, aur_error *error) {
    if (pixel_count / pixels_a_byte <= source->size)
        return AUR_OK;
    return aur_fail(error, AUR_ERROR_FORMAT, "claims %zu pixels, which %zu bytes of %s cannot hold",
                    pixel_count, source->size, format);
}

aur_result aur_image_select(const aur_image *image, size_t count, const char *const *names,
                            aur_image **selected, aur_error *error) {
    *selected = NULL;
    aur_image *created;
    aur_result result = aur_image_create(image->width, image->height, count, &created, error);
    if (result != AUR_OK)
        return result;
    const size_t pixels = image->width * image->height;
    for (size_t i = 0; i < count; ++i) {
        const size_t c = aur_image_find_channel(image, names[i]);
        if (c == SIZE_MAX) {
            char list[512];
            aur_image_list_channels(image, sizeof list, list);
            result = aur_fail(error, AUR_ERROR_NAME, "unknown channel '%s': expected %s", names[i], list);
            aur_image_destroy(created);
            return result;
        }
        memcpy(created->channel_names[i], image->channel_names[c], AUR_CHANNEL_NAME_CAPACITY);
        for (size_t p = 0; p < pixels; ++p)
            created->data[p * count + i] = image->data[p * image->channel_count + c];
    }
    created->chosen = count == 1 || count == 3;
    *selected = created;
    return AUR_OK;
}

static float block_mean(const aur_image *image, size_t block, size_t left, size_t top, size_t channel) {
    const size_t right = image->width - left > block ? left + block : image->width;
    const size_t bottom = image->height - top > block ? top + block : image->height;
    double sum = 0.0;
    for (size_t y = top; y < bottom; ++y)
        for (size_t x = left; x < right; ++x)
            sum += image->data[(y * image->width + x) * image->channel_count + channel];
    return (float)(sum / (double)((right - left) * (bottom - top)));
}

aur_result aur_image_downsample(const aur_image *image, size_t block, aur_image **smaller, aur_error *error) {
    *smaller = NULL;
    if (block == 0)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "downsampling: blocks must have at least one pixel");
    const size_t width = (image->width - 1) / block + 1;
    const size_t height = (image->height - 1) / block + 1;
    const aur_result result = aur_image_create(width, height, image->channel_count, smaller, error);
    if (result != AUR_OK)
        return result;
    (*smaller)->chosen = image->chosen;
    memcpy((*smaller)->channel_names, image->channel_names,
           image->channel_count * sizeof *image->channel_names);
    float *out = (*smaller)->data;
    for (size_t y = 0; y < height; ++y)
        for (size_t x = 0; x < width; ++x)
            for (size_t c = 0; c < image->channel_count; ++c)
                *out++ = block_mean(image, block, x * block, y * block, c);
    return AUR_OK;
}
