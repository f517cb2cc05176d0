/* Two halves of the replicas: what a denoiser makes of one is compared with the other, which has not seen it.
 */
#include <aureole/statistics.h>
#include <math.h>
#include <stdlib.h>

#include "points/base/error.h"
#include "render/adaptive/adaptive.h"
#include "render/film/film.h"

enum { BLOCK = 8 };

aur_result aur_adaptive_develop_half(const aur_adaptive *adaptive, size_t half, aur_image **image,
                                     aur_error *error) {
    const aur_replicas *const replicas = &adaptive->candidate.replicas;
    if (half > 1)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "there is no half %zu: 0 and 1 are the halves", half);
    const aur_result result = aur_replicas_develop(replicas, true, image, error);
    if (result != AUR_OK)
        return result;
    float *value = aur_image_data(*image);
    const double count = (double)((replicas->count + 1 - half) / 2);
    for (size_t pixel = 0; pixel < replicas->pixel_count; ++pixel, value += 6)
        for (size_t c = 0; c < 3; ++c) {
            double sum = 0.0;
            for (size_t r = half; r < replicas->count; r += 2)
                sum += aur_replicas_value(replicas, r, pixel, c);
            value[c] = (float)(sum / count);
            value[3 + c] *= (float)sqrt((double)replicas->count / count);
        }
    return AUR_OK;
}

/* The mean square over blocks of pixels, and its variance. */
typedef struct block_sums {
    double sum, squares;
    size_t count;
} block_sums;

static double square_of(aur_error_measure measure, const aur_error_weight *weight, const float *from,
                        const float *to) {
    const double start[3] = {(double)from[0], (double)from[1], (double)from[2]};
    double errors[3], d[3];
    for (size_t c = 0; c < 3; ++c)
        errors[c] = (double)to[c] - start[c];
    aur_error_apply(measure, weight, start, errors, d);
    return d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
}

/* With halves a and b and what was made of each, A and B: the expectation of (A - b)^2 + (B - a)^2 - (a -
 * b)^2 is the sum of the square errors of A and B, because a and b are independent and their errors average
 * out. */
static void add_block(const aur_film_layout *layout, size_t column, size_t row, aur_error_measure measure,
                      const aur_error_weight *weights, const aur_image *const halves[2],
                      const aur_image *const made[2], block_sums *sums) {
    const size_t width = layout->x1 - layout->x0, height = layout->y1 - layout->y0;
    double sum = 0.0;
    for (size_t y = row * BLOCK; y < (row + 1) * BLOCK && y < height; ++y)
        for (size_t x = column * BLOCK; x < (column + 1) * BLOCK && x < width; ++x) {
            const size_t pixel = y * width + x;
            const float *noisy[2], *clean[2];
            for (size_t h = 0; h < 2; ++h) {
                noisy[h] = aur_image_data(halves[h]) + pixel * aur_image_channel_count(halves[h]);
                clean[h] = aur_image_data(made[h]) + pixel * aur_image_channel_count(made[h]);
            }
            sum += 0.5 * square_of(measure, &weights[pixel], noisy[1], clean[0]);
            sum += 0.5 * square_of(measure, &weights[pixel], noisy[0], clean[1]);
            sum -= 0.5 * square_of(measure, &weights[pixel], noisy[0], noisy[1]);
        }
    sums->sum += sum;
    sums->squares += sum * sum;
    ++sums->count;
}

static aur_error_figures finish(const aur_adaptive *adaptive, const block_sums *sums) {
    const double blocks = (double)sums->count,
                 values = 3.0 * (double)adaptive->candidate.replicas.pixel_count;
    const double square = sums->sum / values, spread = sums->squares - sums->sum * sums->sum / blocks;
    double half = INFINITY; /* one block does not tell how blocks vary */
    if (sums->count > 1)
        half = aur_student_quantile(sums->count - 1, 0.5 * (1.0 + adaptive->target.confidence)) *
               sqrt(fmax(spread, 0.0) * blocks / (blocks - 1.0)) / values;
    return (aur_error_figures){.error = sqrt(fmax(square, 0.0)),
                               .low = sqrt(fmax(square - half, 0.0)),
                               .high = sqrt(fmax(square, 0.0) + half)};
}

aur_result aur_adaptive_compare_halves(const aur_adaptive *adaptive, const aur_image *const made[2],
                                       aur_error_figures *figures, aur_error *error) {
    const aur_replicas *const replicas = &adaptive->candidate.replicas;
    const size_t count = replicas->pixel_count;
    aur_image *halves[2] = {NULL, NULL};
    aur_result result = aur_adaptive_develop_half(adaptive, 0, &halves[0], error);
    if (result == AUR_OK)
        result = aur_adaptive_develop_half(adaptive, 1, &halves[1], error);
    for (size_t h = 0; h < 2 && result == AUR_OK; ++h)
        if (aur_image_width(made[h]) != aur_image_width(halves[h]) ||
            aur_image_height(made[h]) != aur_image_height(halves[h]) || aur_image_channel_count(made[h]) < 3)
            result =
                aur_fail(error, AUR_ERROR_ARGUMENT, "expected images with R, G and B of %zu x %zu pixels",
                         aur_image_width(halves[h]), aur_image_height(halves[h]));
    double(*const values)[3] = malloc(2 * count * sizeof *values);
    aur_error_weight *const weights = malloc(count * sizeof *weights);
    if (result == AUR_OK && (values == NULL || weights == NULL))
        result = aur_fail_memory(error);
    if (result == AUR_OK) {
        const aur_film_layout *const layout = &aur_render_film(replicas->renders[0])->layout;
        const size_t width = layout->x1 - layout->x0, height = layout->y1 - layout->y0;
        block_sums sums = {.count = 0};
        aur_replicas_mean(replicas, values);
        aur_error_smooth(width, height, (const double(*)[3])values, values + count);
        aur_error_weigh(adaptive->target.measure, count, (const double(*)[3])values,
                        (const double(*)[3])(values + count), weights);
        for (size_t row = 0; row * BLOCK < height; ++row)
            for (size_t column = 0; column * BLOCK < width; ++column)
                add_block(layout, column, row, adaptive->target.measure, weights,
                          (const aur_image *const *)halves, made, &sums);
        *figures = finish(adaptive, &sums);
    }
    free(values);
    free(weights);
    aur_image_destroy(halves[0]);
    aur_image_destroy(halves[1]);
    return result;
}
