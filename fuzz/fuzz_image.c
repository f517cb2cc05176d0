/* Images of all formats. One in eight is named .tga, because TGA has no signature. */
#include <aureole-render/image.h>
#include <openexr.h>
#include <stb_image_write.h>
#include <string.h>
#include <unistd.h>

#include "fuzz.h"
#include "render/image/foreign.h"
#include "render/image/format.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    aur_image *image;
    aur_error error = {0};
    const aur_result result =
        aur_image_read_memory(size % 8 == 0 ? "input.tga" : "input", size, data, &image, &error);
    if (result != AUR_OK) {
        fuzz_require(image == NULL, "a failed read left an image");
        fuzz_require(error.result == result && error.message[0] != '\0', "a failure without a message");
        fuzz_require(result != AUR_ERROR_INTERNAL && result != AUR_ERROR_ARGUMENT,
                     "a failure of the wrong kind");
        return 0;
    }
    fuzz_require(aur_image_width(image) > 0 && aur_image_height(image) > 0 &&
                     aur_image_channel_count(image) > 0,
                 "an empty image");
    double value[4];
    const aur_result compared = aur_image_compare(image, image, AUR_IMAGE_RELMSE, value, &error);
    fuzz_require(compared == AUR_ERROR_ARGUMENT || (compared == AUR_OK && value[3] == 0.0),
                 "an image differs from itself");
    aur_image_destroy(image);
    return 0;
}

static void put(void *stream, void *bytes, int count) {
    fwrite(bytes, 1, (size_t)count, stream);
}

/* A smooth image with some noise, so that every kind of compression code occurs. */
static aur_image *make_image(size_t channel_count) {
    aur_image *image;
    fuzz_require(aur_image_create(19, 18, channel_count, &image, NULL) == AUR_OK, "no image");
    for (size_t i = 0; i < 19 * 18 * channel_count; ++i)
        aur_image_data(image)[i] = (float)(i % 57) / 40.0f + (i % 11 == 0 ? 0.3f : 0.0f);
    return image;
}

static void write_seed(const aur_image_format *format, size_t channel_count, int half, FILE *stream) {
    aur_image *const image = make_image(channel_count);
    aur_image_target target = {.name = "seed", .stream = stream, .options = {.half = half}};
    fuzz_require(aur_image_color_channels(image, target.channels), "a seed has no colour");
    fuzz_require(format->write(&target, image, NULL) == AUR_OK, "a seed cannot be written");
    aur_image_destroy(image);
}

static void write_jpeg(int channel_count, FILE *stream) {
    unsigned char bytes[19 * 18 * 3];
    for (size_t i = 0; i < sizeof bytes; ++i)
        bytes[i] = (unsigned char)(i % 251);
    stbi_write_jpg_to_func(put, stream, 19, 18, channel_count, bytes, 80);
}

static size_t read_and_remove(const char *path, size_t capacity, uint8_t *data) {
    FILE *const file = fopen(path, "rb");
    fuzz_require(file != NULL, "a seed cannot be read");
    const size_t size = fread(data, 1, capacity, file);
    fclose(file);
    unlink(path);
    return size;
}

enum { FORMAT_SEEDS = 9, COMPRESSIONS = EXR_COMPRESSION_B44A + 1 };

size_t aur_fuzz_seed(size_t index, size_t capacity, uint8_t *data) {
    if (index >= FORMAT_SEEDS + 2 * COMPRESSIONS)
        return 0;
    if (index >= FORMAT_SEEDS) {
        const size_t kind = index - FORMAT_SEEDS;
        const foreign_file file = {.storage = kind % 2 == 0 ? EXR_STORAGE_SCANLINE : EXR_STORAGE_TILED,
                                   .compression = (exr_compression_t)(kind / 2),
                                   .width = 37,
                                   .height = 34,
                                   .tile = 16};
        char path[64];
        snprintf(path, sizeof path, "fuzz-seed-%ld.exr", (long)getpid());
        write_foreign(path, &file);
        return read_and_remove(path, capacity, data);
    }
    FILE *const stream = fmemopen(data, capacity, "wb");
    fuzz_require(stream != NULL, "no stream");
    switch (index) {
    case 0:
        write_seed(&aur_image_format_exr, 3, 0, stream);
        break;
    case 1:
        write_seed(&aur_image_format_exr, 4, 1, stream);
        break;
    case 2:
        write_seed(&aur_image_format_pfm, 3, 0, stream);
        break;
    case 3:
        write_seed(&aur_image_format_pfm, 1, 0, stream);
        break;
    case 4:
        write_seed(&aur_image_format_hdr, 3, 0, stream);
        break;
    case 5:
        write_seed(&aur_image_format_png, 3, 0, stream);
        break;
    case 6:
        write_seed(&aur_image_format_png, 1, 0, stream);
        break;
    default:
        write_jpeg(index == 7 ? 1 : 3, stream);
    }
    const long size = ftell(stream);
    fclose(stream);
    return (size_t)size;
}
