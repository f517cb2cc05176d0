#include "program/cli/render/denoise.h"

#include <math.h>
#include <stdlib.h>

/* Light counts as bright from this multiple of the image's mean. Empirical: reflected light is rarely
 * brighter, and denoisers preserve darker features well. */
static const double BRIGHT = 4.0;
static const double STANDARD_ERRORS = 2.0;

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

/* The few samples of `lights` may have missed a light source that covers a small part of the pixel. */
static bool sees_bright_light(const aur_image *image, const aur_image *lights, size_t pixel, float bright) {
    return largest(pixel_of(lights, pixel)) > bright ||
           (largest(pixel_of(image, pixel)) > bright && largest_around(lights, pixel) > bright);
}

aur_result cli_direct_light_subtract(const aur_image *image, const aur_image *lights, aur_image **rest,
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

/* The sum of `values` over the pixels within REACH. */
static double sum_around(const double *values, size_t width, size_t height, size_t pixel) {
    enum { REACH = 2 };
    const size_t x = pixel % width, y = pixel / width;
    double sum = 0.0;
    for (size_t v = y > REACH ? y - REACH : 0; v < height && v <= y + REACH; ++v)
        for (size_t u = x > REACH ? x - REACH : 0; u < width && u <= x + REACH; ++u)
            sum += values[v * width + u];
    return sum;
}

/* Squares of the denoiser's changes and of the standard errors; both zero where light is directly visible. */
static void measure_changes(const aur_image *image, const aur_image *out, const bool *sees, double *changes,
                            double *errors) {
    const size_t first = aur_image_find_channel(image, "error.R");
    for (size_t i = 0; i < pixel_count(image); ++i) {
        changes[i] = errors[i] = 0.0;
        for (size_t c = 0; c < 3 && !sees[i]; ++c) {
            const double change = (double)pixel_of(out, i)[c] - (double)pixel_of(image, i)[c];
            const double error = first != SIZE_MAX ? (double)pixel_of(image, i)[first + c] : INFINITY;
            changes[i] += change * change;
            errors[i] += error * error;
        }
    }
}

aur_result cli_direct_light_restore(const aur_image *image, const aur_image *lights, aur_image *out,
                                    aur_error *error) {
    const size_t width = aur_image_width(image), height = aur_image_height(image), count = width * height;
    const float bright = bright_from(image);
    double *const changes = malloc(2 * count * sizeof *changes), *const errors = changes + count;
    bool *const sees = malloc(count * sizeof *sees);
    if (changes == NULL || sees == NULL) {
        free(changes);
        free(sees);
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    }
    for (size_t i = 0; i < count; ++i)
        sees[i] = sees_bright_light(image, lights, i, bright);
    measure_changes(image, out, sees, changes, errors);
    for (size_t i = 0; i < count; ++i) {
        const double change = sqrt(sum_around(changes, width, height, i));
        const double most = STANDARD_ERRORS * sqrt(sum_around(errors, width, height, i));
        const double part = sees[i] ? 0.0 : change > most ? most / change : 1.0;
        const float *const was = pixel_of(image, i);
        float *const is = aur_image_data(out) + i * aur_image_channel_count(out);
        for (size_t c = 0; c < 3; ++c)
            is[c] = part < 1.0 ? was[c] + (float)part * (is[c] - was[c]) : is[c];
    }
    free(changes);
    free(sees);
    return AUR_OK;
}
