/* The brightness of an image as a density for `aureole points --warp`. */
#include <aureole-render/image.h>
#include <stdlib.h>

#include "program/cli/cli.h"
#include "program/cli/points/point_source.h"

int cli_read_density(const char *path, aur_density_image **density) {
    aur_image *image;
    aur_error error;
    if (aur_image_read(path, &image, &error) != AUR_OK)
        return cli_fail(&error);
    size_t channels[3];
    if (!aur_image_color_channels(image, channels)) {
        aur_image_destroy(image);
        return cli_bad_usage("--warp: %s must have one channel (or Y), or R, G and B, to have a brightness",
                             path);
    }
    const size_t width = aur_image_width(image), height = aur_image_height(image);
    const size_t count = width * height, channel_count = aur_image_channel_count(image);
    float *const luminance = malloc(count * sizeof *luminance);
    error = (aur_error){.result = AUR_ERROR_MEMORY, .message = "out of memory"};
    for (size_t i = 0; i < count && luminance != NULL; ++i) {
        const float *const pixel = aur_image_data(image) + i * channel_count;
        luminance[i] =
            0.2126f * pixel[channels[0]] + 0.7152f * pixel[channels[1]] + 0.0722f * pixel[channels[2]];
    }
    const bool good =
        luminance != NULL && aur_density_image_create(width, height, luminance, density, &error) == AUR_OK;
    free(luminance);
    aur_image_destroy(image);
    snprintf(error.file, sizeof error.file, "%s", path);
    return good ? CLI_SUCCESS : cli_fail(&error);
}
