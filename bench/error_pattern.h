/* Spatial patterns in the error of an image, measured on the difference of two images with different seeds.
 * Errors common to both cancel. */
#pragma once

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdlib.h>

typedef struct error_pattern {
    size_t width, height;
    double *differences; /* [3 * width * height] */
} error_pattern;

/* The difference of two images whose first three channels are colors. False when out of memory. */
static inline bool error_pattern_open(size_t width, size_t height, size_t channels, const float *a,
                                      const float *b, error_pattern *pattern) {
    *pattern = (error_pattern){width, height, malloc(3 * width * height * sizeof *pattern->differences)};
    for (size_t i = 0; i < width * height && pattern->differences != NULL; ++i)
        for (size_t c = 0; c < 3; ++c)
            pattern->differences[3 * i + c] = (double)a[i * channels + c] - (double)b[i * channels + c];
    return pattern->differences != NULL;
}

static inline void error_pattern_close(error_pattern *pattern) {
    free(pattern->differences);
    pattern->differences = NULL;
}

/* Sums over blocks of side x side pixels: of squared block sums, and of squared differences. */
typedef struct error_blocks {
    double of_sums, of_each;
} error_blocks;

static inline error_blocks error_pattern_blocks(const error_pattern *pattern, size_t side) {
    const size_t across = pattern->width / side, down = pattern->height / side;
    error_blocks squares = {.of_sums = 0.0};
    for (size_t block = 0; block < across * down; ++block)
        for (size_t c = 0; c < 3; ++c) {
            const size_t corner = block / across * side * pattern->width + block % across * side;
            double sum = 0.0;
            for (size_t i = 0; i < side * side; ++i) {
                const double d =
                    pattern->differences[3 * (corner + i / side * pattern->width + i % side) + c];
                sum += d;
                squares.of_each += d * d;
            }
            squares.of_sums += sum * sum;
        }
    return squares;
}

/* The root mean square of means over side x side pixels, relative to independent errors with the same root
 * mean square. */
static inline double error_pattern_clumps(const error_pattern *pattern, size_t side) {
    const error_blocks squares = error_pattern_blocks(pattern, side);
    return squares.of_each > 0.0 ? sqrt(squares.of_sums / squares.of_each) : 0.0;
}

/* The mean product of differences `lag` pixels apart, along rows or columns. */
static inline double error_pattern_product(const error_pattern *pattern, size_t lag, bool down) {
    const size_t step = 3 * lag * (down ? pattern->width : 1);
    const size_t width = pattern->width - (down ? 0 : lag), height = pattern->height - (down ? lag : 0);
    double sum = 0.0;
    for (size_t i = 0; i < 3 * width * height; ++i) {
        const double *const at =
            &pattern->differences[i / (3 * width) * 3 * pattern->width + i % (3 * width)];
        sum += at[0] * at[step];
    }
    return sum / (3.0 * (double)(width * height));
}

/* The excess correlation of errors `lag` pixels apart, along rows or columns, over lags one smaller and one
 * larger, in standard errors. Differences of two images are symmetric about 0, so without a peak the value is
 * approximately standard normal. */
static inline double error_pattern_peak(const error_pattern *pattern, size_t lag, bool down) {
    const size_t step = down ? pattern->width : 1;
    const size_t width = pattern->width - (down ? 0 : lag + 1);
    const size_t height = pattern->height - (down ? lag + 1 : 0);
    double sum = 0.0, squares = 0.0;
    for (size_t i = 0; i < width * height; ++i) {
        const double *const at = &pattern->differences[3 * (i / width * pattern->width + i % width)];
        double product = 0.0;
        for (size_t c = 0; c < 3; ++c)
            product += at[c] * (at[3 * step * lag + c] -
                                0.5 * (at[3 * step * (lag - 1) + c] + at[3 * step * (lag + 1) + c]));
        sum += product;
        squares += product * product;
    }
    return squares > 0.0 ? sum / sqrt(squares) : 0.0;
}
