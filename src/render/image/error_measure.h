/* Scalar error measures of an image, as a table. A measure is the root mean square over pixels of differences
 * that follow from a pixel's errors in R, G and B. */
#pragma once

#include <aureole-render/image.h>
#include <stddef.h>

/* Factors of a pixel's errors in R, G and B, or the exposure at which its values are displayed. A measure of
 * luminance has one difference per pixel, the others three; in both cases squares are averaged over 3 x
 * pixels. */
typedef struct aur_error_weight {
    double channel[3];
} aur_error_weight;

/* The weights of `count` values of R, G and B, such as the pixels of an image, and `smooth`, the same after
 * aur_error_smooth. All are zero where the values are black. */
void aur_error_weigh(aur_error_measure measure, size_t count, const double (*values)[3],
                     const double (*smooth)[3], aur_error_weight *weights);
/* Means of magnitudes over 5 x 5 pixels, fewer at the image's edges, to which errors are relative.
 * Magnitudes, because filters with negative lobes produce negative values next to bright light, whose plain
 * mean may be near zero. */
void aur_error_smooth(size_t width, size_t height, const double (*values)[3], double (*smooth)[3]);

/* The differences in a pixel whose values `from` change by `errors`, for each of `count` such changes. */
void aur_error_apply(aur_error_measure measure, const aur_error_weight *weight, const double from[3],
                     size_t count, const double (*errors)[3], double (*differences)[3]);
/* Light that a sample of a pixel hits with a small probability, `share`; each of `replicas` images has
 * `samples` samples of the pixel. */
typedef struct aur_rare_light {
    double variance; /* of the mean of the samples of one image in R, G and B together */
    double share, samples, replicas;
} aur_rare_light;

/* An upper bound of the variance that it causes in the differences of the mean of the images, times their
 * number. */
double aur_error_variance_bound(aur_error_measure measure, const aur_error_weight *weight,
                                const aur_rare_light *light);
