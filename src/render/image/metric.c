#include "render/image/format.h"

#include <math.h>

aur_result aur_image_check_finite(const char *what, const aur_image *image, const size_t channels[3],
                                  aur_error *error) {
    for (size_t i = 0; i < image->width * image->height; ++i) {
        for (size_t c = 0; c < 3; ++c) {
            const float value = image->data[i * image->channel_count + channels[c]];
            if (!isfinite(value))
                return aur_fail(error, AUR_ERROR_ARGUMENT,
                                "%s has the value %g at column %zu of row %zu, channel %s: "
                                "only finite values can be compared",
                                what, (double)value, i % image->width, i / image->width,
                                image->channel_names[channels[c]]);
        }
    }
    return AUR_OK;
}

aur_result aur_image_check_pair(const aur_image *reference, const aur_image *image, aur_color_pair *pair,
                                aur_error *error) {
    if (reference->width != image->width || reference->height != image->height)
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "the sizes differ: the reference has %zu x %zu pixels, the image %zu x %zu",
                        reference->width, reference->height, image->width, image->height);
    aur_result result = aur_image_require_color("the reference", reference, pair->reference, error);
    if (result == AUR_OK)
        result = aur_image_require_color("the image", image, pair->image, error);
    if (result == AUR_OK)
        result = aur_image_check_finite("the reference", reference, pair->reference, error);
    if (result == AUR_OK)
        result = aur_image_check_finite("the image", image, pair->image, error);
    return result;
}
