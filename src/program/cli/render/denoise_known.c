#include "program/cli/render/denoise.h"

#include <math.h>

/* Light is bright from so many times the picture's mean on. Chosen: reflected light is rarely brighter, and
 * what is less bright denoisers keep well. */
static const double BRIGHT = 4.0;
static const float STANDARD_ERRORS = 2.0f;

static const float *pixel_of(const aur_image *image, size_t pixel) {
    return aur_image_data(image) + pixel * aur_image_channel_count(image);
}

static size_t pixel_count(const aur_image *image) {
    return aur_image_width(image) * aur_image_height(image);
}

/* The largest of red, green and blue. */
static float largest(const float *rgb) {
    return fmaxf(fmaxf(rgb[0], rgb[1]), rgb[2]);
}

static float bright_from(const aur_image *image) {
    double sum = 0.0;
    for (size_t i = 0; i < pixel_count(image); ++i)
        sum += (double)largest(pixel_of(image, i));
    return (float)(BRIGHT * sum / (double)pixel_count(image));
}

static float largest_around(const aur_image *image, size_t pixel) {
    const size_t width = aur_image_width(image), height = aur_image_height(image);
    const size_t x = pixel % width, y = pixel / width;
    float most = 0.0f;
    for (size_t v = y > 0 ? y - 1 : 0; v < height && v <= y + 1; ++v)
        for (size_t u = x > 0 ? x - 1 : 0; u < width && u <= x + 1; ++u)
            most = fmaxf(most, largest(pixel_of(image, v * width + u)));
    return most;
}

/* The few samples of `lights` may have missed a lamp that fills a small part of the pixel. */
static bool sees_bright_light(const aur_image *image, const aur_image *lights, size_t pixel, float bright) {
    return largest(pixel_of(lights, pixel)) > bright ||
           (largest(pixel_of(image, pixel)) > bright && largest_around(lights, pixel) > bright);
}

aur_result cli_known_take(const aur_image *image, const aur_image *lights, aur_image **rest,
                          aur_error *error) {
    const aur_result result =
        aur_image_create(aur_image_width(image), aur_image_height(image), 3, rest, error);
    if (result != AUR_OK)
        return result;
    const float bright = bright_from(image);
    for (size_t i = 0; i < pixel_count(image); ++i) {
        const bool sees = sees_bright_light(image, lights, i, bright);
        const float *const all = pixel_of(image, i), *const light = pixel_of(lights, i);
        for (size_t c = 0; c < 3; ++c)
            aur_image_data(*rest)[3 * i + c] = sees ? fmaxf(all[c] - light[c], 0.0f) : all[c];
    }
    return AUR_OK;
}

void cli_known_restore(const aur_image *image, const aur_image *lights, aur_image *out) {
    const size_t errors = aur_image_find_channel(image, "error.R");
    const float bright = bright_from(image);
    for (size_t i = 0; i < pixel_count(image); ++i) {
        const bool sees = sees_bright_light(image, lights, i, bright);
        const float *const was = pixel_of(image, i);
        float *const is = aur_image_data(out) + i * aur_image_channel_count(out);
        for (size_t c = 0; c < 3; ++c) {
            const float most = sees                 ? 0.0f
                               : errors != SIZE_MAX ? STANDARD_ERRORS * was[errors + c]
                                                    : INFINITY;
            is[c] = fminf(fmaxf(is[c], was[c] - most), was[c] + most);
        }
    }
}
