/* Pictures: reading, writing, comparing. Radiance is linear, Rec. 709 primaries. */
#ifndef AUREOLE_IMAGE_H
#define AUREOLE_IMAGE_H

#include <aureole/core.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { AUR_CHANNEL_NAME_CAPACITY = 32 };

/* data[(y * width + x) * channel_count + c]; the top row first. Free with aur_image_destroy. */
typedef struct aur_image {
    size_t width, height, channel_count;
    float *data;
    char (*channel_names)[AUR_CHANNEL_NAME_CAPACITY]; /* "R", "G", "B", ... */
} aur_image;

/* Zero filled; three channels are named R, G, B, one is Y, others are to be named by the caller. */
AUR_API aur_result aur_image_create(size_t width, size_t height, size_t channel_count, aur_image **image,
                                    aur_error *error) AUR_NONNULL(4);
AUR_API void aur_image_destroy(aur_image *image); /* NULL is allowed */

/* By content and, failing that, by extension: EXR (scan lines or tiles, half or float), PFM, HDR, PNG, JPEG.
 * 8-bit pictures are decoded from sRGB to linear. */
AUR_API aur_result aur_image_read(const char *path, aur_image **image, aur_error *error) AUR_NONNULL(1, 2);

/* How radiance becomes an 8-bit value: exposure in stops, then the curve, then sRGB. */
typedef enum aur_tone { AUR_TONE_SRGB, AUR_TONE_FILMIC } aur_tone;

typedef struct aur_image_write_options {
    float exposure; /* stops; PNG only */
    aur_tone tone;  /* PNG only */
    int half;       /* EXR: 16-bit floats instead of 32-bit ones */
} aur_image_write_options;

/* By extension: .exr, .pfm, .hdr, .png. The file is replaced whole or not at all. `options` may be NULL. */
AUR_API aur_result aur_image_write(const char *path, const aur_image *image,
                                   const aur_image_write_options *options, aur_error *error)
    AUR_NONNULL(1, 2);

/* The R, G and B channels of two pictures of one size. */
typedef enum aur_image_metric {
    AUR_IMAGE_RMSE,
    AUR_IMAGE_MSE,
    AUR_IMAGE_MAE,
    AUR_IMAGE_RELMSE, /* mean of (a-r)^2 / (r^2 + 0.01) */
    AUR_IMAGE_MRSE    /* mean of (a-r)^2 / r^2 over non-zero r */
} aur_image_metric;

AUR_API aur_result aur_image_metric_from_name(const char *name, aur_image_metric *metric, aur_error *error)
    AUR_NONNULL(1, 2);
AUR_API const char *aur_image_metric_name(aur_image_metric metric);

/* value[0..2] for R, G, B; value[3] for all three together. Errors: ARGUMENT when sizes or channels differ.
 */
AUR_API aur_result aur_image_compare(const aur_image *reference, const aur_image *image,
                                     aur_image_metric metric, double value[4], aur_error *error)
    AUR_NONNULL(1, 2, 4);

/* A false-colour picture of the absolute difference; `scale` is the difference that is drawn brightest, 0
 * chooses the largest one. */
AUR_API aur_result aur_image_difference(const aur_image *reference, const aur_image *image, double scale,
                                        aur_image **difference, aur_error *error) AUR_NONNULL(1, 2, 4);

#ifdef __cplusplus
}
#endif

#endif
