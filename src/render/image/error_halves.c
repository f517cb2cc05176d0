#include "render/image/error_halves.h"

#include <aureole/statistics.h>
#include <math.h>
#include <stdlib.h>

#include "points/base/error.h"

enum { BLOCK = 8 };

static double square_of(aur_error_measure measure, const aur_error_weight *weight, const float *from,
                        const float *to) {
    const double start[3] = {(double)from[0], (double)from[1], (double)from[2]};
    double errors[3], d[3];
    for (size_t c = 0; c < 3; ++c)
        errors[c] = (double)to[c] - start[c];
    aur_error_apply(measure, weight, start, 1, (const double(*)[3])errors, &d);
    return d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
}

/* With halves a and b and their denoised versions A and B: the expectation of (A - b)^2 + (B - a)^2 - (a -
 * b)^2 is the sum of the square errors of A and B, because a and b are independent and their errors average
 * out. */
static double square_in_block(const aur_image *const halves[2], const aur_image *const processed[2],
                              aur_error_measure measure, const aur_error_weight *weights, size_t x0,
                              size_t y0) {
    const size_t width = aur_image_width(halves[0]), height = aur_image_height(halves[0]);
    double sum = 0.0;
    for (size_t y = y0; y < y0 + BLOCK && y < height; ++y)
        for (size_t x = x0; x < x0 + BLOCK && x < width; ++x) {
            const size_t pixel = y * width + x;
            const float *noisy[2], *clean[2];
            for (size_t h = 0; h < 2; ++h) {
                noisy[h] = aur_image_data(halves[h]) + pixel * aur_image_channel_count(halves[h]);
                clean[h] = aur_image_data(processed[h]) + pixel * aur_image_channel_count(processed[h]);
            }
            sum += 0.5 * square_of(measure, &weights[pixel], noisy[1], clean[0]);
            sum += 0.5 * square_of(measure, &weights[pixel], noisy[0], clean[1]);
            sum -= 0.5 * square_of(measure, &weights[pixel], noisy[0], noisy[1]);
        }
    return sum;
}

/* By the mean of the halves. */
static aur_result weigh(const aur_image *const halves[2], aur_error_measure measure,
                        aur_error_weight **weights, aur_error *error) {
    const size_t width = aur_image_width(halves[0]), count = width * aur_image_height(halves[0]);
    double(*const values)[3] = calloc(2 * count, sizeof *values);
    *weights = malloc(count * sizeof **weights);
    if (values != NULL && *weights != NULL) {
        for (size_t i = 0; i < count; ++i)
            for (size_t h = 0; h < 2; ++h)
                for (size_t c = 0; c < 3; ++c)
                    values[i][c] +=
                        0.5 * (double)aur_image_data(halves[h])[i * aur_image_channel_count(halves[h]) + c];
        aur_error_smooth(width, count / width, (const double(*)[3])values, values + count);
        aur_error_weigh(measure, count, (const double(*)[3])values, (const double(*)[3])(values + count),
                        *weights);
    }
    const bool processed = values != NULL && *weights != NULL;
    free(values);
    return processed ? AUR_OK : aur_fail_memory(error);
}

aur_result aur_error_of_halves(const aur_image *const halves[2], const aur_image *const processed[2],
                               aur_error_measure measure, double confidence, aur_error_interval *interval,
                               aur_error *error) {
    const size_t width = aur_image_width(halves[0]), height = aur_image_height(halves[0]);
    for (size_t h = 0; h < 2; ++h)
        if (aur_image_width(processed[h]) != width || aur_image_height(processed[h]) != height ||
            aur_image_channel_count(processed[h]) < 3)
            return aur_fail(error, AUR_ERROR_ARGUMENT, "expected images with R, G and B of %zu x %zu pixels",
                            width, height);
    aur_error_weight *weights;
    const aur_result result = weigh(halves, measure, &weights, error);
    aur_moments blocks = {0};
    for (size_t y = 0; y < height && result == AUR_OK; y += BLOCK)
        for (size_t x = 0; x < width; x += BLOCK)
            aur_moments_add(&blocks, square_in_block(halves, processed, measure, weights, x, y));
    free(weights);
    if (result != AUR_OK)
        return result;
    const double part = (double)blocks.count / (3.0 * (double)(width * height));
    const double square = part * blocks.mean;
    const double half = blocks.count > 1 ? part * aur_moments_interval(&blocks, confidence) : INFINITY;
    *interval = (aur_error_interval){.estimate = sqrt(fmax(square, 0.0)),
                                     .low = sqrt(fmax(square - half, 0.0)),
                                     .high = sqrt(fmax(square, 0.0) + half)};
    return AUR_OK;
}
