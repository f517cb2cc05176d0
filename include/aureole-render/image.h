/* Images: reading, writing, comparing. Radiance is linear, Rec. 709 primaries. */
#ifndef AUREOLE_IMAGE_H
#define AUREOLE_IMAGE_H

#include <aureole/tables.h>
#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { AUR_CHANNEL_NAME_CAPACITY = 256 };

typedef struct aur_image aur_image;

/* Zero filled. One to four channels are named Y; Y, A; R, G, B; R, G, B, A. The caller names more channels.
 * Errors: ARGUMENT for a size of zero or beyond 2^30 values, MEMORY. */
AUR_API aur_result aur_image_create(size_t width, size_t height, size_t channel_count, aur_image **image,
                                    aur_error *error) AUR_NONNULL(4);
/* The same for the caller's values, in the layout of aur_image_data. They are not copied, and must outlive
 * the image. */
AUR_API aur_result aur_image_wrap(size_t width, size_t height, size_t channel_count, float *data,
                                  aur_image **image, aur_error *error) AUR_NONNULL(4, 5);
AUR_API void aur_image_destroy(aur_image *image); /* NULL is allowed */

AUR_API size_t aur_image_width(const aur_image *image) AUR_NONNULL(1);
AUR_API size_t aur_image_height(const aur_image *image) AUR_NONNULL(1);
AUR_API size_t aur_image_channel_count(const aur_image *image) AUR_NONNULL(1);
/* data[(y * width + x) * channel_count + c], the top row first. Readable and writable; valid until the image
 * is destroyed. */
AUR_API float *aur_image_data(const aur_image *image) AUR_NONNULL(1);
/* Remarks of the reader about the file, for a warning, such as "its PRIMARIES are not those of Rec. 709:
 * ..."; "" if there are none. Valid until the image is destroyed. */
AUR_API const char *aur_image_notes(const aur_image *image) AUR_NONNULL(1);
/* "R", "G", "B", "albedo.R", ...; NULL beyond the channels. */
AUR_API const char *aur_image_channel_name(const aur_image *image, size_t channel) AUR_NONNULL(1);
/* Errors: ARGUMENT for a channel out of range, or a name of AUR_CHANNEL_NAME_CAPACITY bytes or more. */
AUR_API aur_result aur_image_name_channel(aur_image *image, size_t channel, const char *name,
                                          aur_error *error) AUR_NONNULL(1, 3);

/* Detects the format by content: EXR (scan lines or tiles; half, float or uint; the full-size level of the
 * first part), PFM, HDR, PNG, JPEG. "-" is standard input. PNG and JPEG are decoded from sRGB to linear.
 * Channels are ordered R, G, B, A, then other layers, layer by layer. Y, RY, BY and X, Y, Z of an EXR are
 * converted to R, G, B. EXPOSURE and COLORCORR of an HDR are divided out. Errors: OPEN, FORMAT, UNSUPPORTED
 * (deep EXR), MEMORY. */
AUR_API aur_result aur_image_read(const char *path, aur_image **image, aur_error *error) AUR_NONNULL(1, 2);
/* The same from memory; `name` is for messages. */
AUR_API aur_result aur_image_read_memory(const char *name, size_t size, const void *data, aur_image **image,
                                         aur_error *error) AUR_NONNULL(1, 3, 4);

/* "EXR", "PFM", "HDR", "PNG" or "JPEG" by the first bytes of a file; NULL for other formats. */
AUR_API const char *aur_image_format_of(size_t size, const void *data) AUR_NONNULL(2);

/* Tone mapping of radiance to 8-bit values: exposure in stops, the tone curve, then the sRGB transfer
 * function.
 */
typedef enum aur_tone {
    AUR_TONE_SRGB,  /* no curve: radiance 1 is white */
    AUR_TONE_FILMIC /* Hable 2010, white at 11.2 after his exposure bias of 2 */
} aur_tone;

enum { AUR_TONE_COUNT = AUR_TONE_FILMIC + 1 };

/* Converts between value and name ("srgb", "filmic"). Errors: NAME, with *tone unchanged. The name of a value
 * out of range is NULL. */
AUR_API aur_result aur_tone_from_name(const char *name, aur_tone *tone, aur_error *error) AUR_NONNULL(1, 2);
AUR_API const char *aur_tone_name(aur_tone tone);

/* Defaults (aur_image_write_options_init: all zero but `size`) write radiance unchanged. */
typedef struct aur_image_write_options {
    size_t size;        /* of the caller's struct, so that it can grow */
    float exposure;     /* stops, finite; PNG only */
    aur_tone tone;      /* PNG only */
    bool half;          /* EXR: 16-bit floats; finite values are clamped to 65504 */
    const char *format; /* an extension: "exr", ...; NULL: the path's extension, exr for "-" */
} aur_image_write_options;

AUR_API aur_result aur_image_write_options_init(aur_image_write_options *options, aur_error *error)
    AUR_NONNULL(1);

/* The row, in the table "picture", of the format that aur_image_write uses for this path. Its name is the
 * extension, its keys are the options of the format. `format` as in the options, or NULL. Errors: NAME if the
 * format cannot be written; *row is NULL then. */
AUR_API aur_result aur_image_find_writer(const char *path, const char *format, const aur_row **row,
                                         aur_error *error) AUR_NONNULL(1, 3);

/* EXR stores every channel; other formats store R, G, B, or a single channel (PFM and PNG as grey, HDR as
 * three equal channels). The file is replaced atomically. "-" is standard output, as EXR by default. Output
 * is deterministic. `options` may be NULL. Errors: ARGUMENT (unnamed channels, no colour, options out of
 * range), NAME (unknown extension), WRITE, MEMORY. */
AUR_API aur_result aur_image_write(const char *path, const aur_image *image,
                                   const aur_image_write_options *options, aur_error *error)
    AUR_NONNULL(1, 2);

/* The index of a channel, or SIZE_MAX. */
AUR_API size_t aur_image_find_channel(const aur_image *image, const char *name) AUR_NONNULL(1, 2);
/* Finds the red, green and blue channels by name, ignoring case: R, G, B or red, green, blue; else Y or grey
 * for all three; else those of the only layer with such channels ("diffuse.R"), or of the layer Combined.
 * One or three channels from aur_image_select are colour under any name, and so is a single channel other
 * than A, Z or ZBack. False if no rule applies. */
AUR_API bool aur_image_color_channels(const aur_image *image, size_t channels[3]) AUR_NONNULL(1, 2);
/* Adds the numbers of infinite, NaN and negative values of a channel to found[0], found[1] and found[2]
 * (-infinity counts as negative). */
AUR_API void aur_image_count_odd(const aur_image *image, size_t channel, size_t found[3]) AUR_NONNULL(1, 3);
/* A new image with the named channels, in the order given. Errors: NAME, MEMORY. */
AUR_API aur_result aur_image_select(const aur_image *image, size_t count, const char *const *names,
                                    aur_image **selected, aur_error *error) AUR_NONNULL(1, 3, 4);
/* Means of block x block pixels; blocks at the right and lower edge average the pixels inside of the image.
 */
AUR_API aur_result aur_image_downsample(const aur_image *image, size_t block, aur_image **smaller,
                                        aur_error *error) AUR_NONNULL(1, 3);
/* The mean radiance of R, G, B, and of all three together. Errors: ARGUMENT if the image has no colour or a
 * pixel is not finite. */
AUR_API aur_result aur_image_mean(const aur_image *image, double mean[4], aur_error *error) AUR_NONNULL(1, 2);

/* Metrics of the difference between two images of equal size; a is the image, r the reference. */
typedef enum aur_image_metric {
    AUR_IMAGE_RMSE,
    AUR_IMAGE_MSE,
    AUR_IMAGE_MAE,
    AUR_IMAGE_RELMSE,        /* mean of (a-r)^2 / (r^2 + 0.01) */
    AUR_IMAGE_MRSE,          /* mean of (a-r)^2 / r^2 over non-zero r */
    AUR_IMAGE_RELATIVE_RMSE, /* RMSE / mean of r: 0 for equal images, infinite when only the mean is zero */
    AUR_IMAGE_FLIP           /* mean of aur_image_flip's map, the same value for all channels */
} aur_image_metric;

enum { AUR_IMAGE_METRIC_COUNT = AUR_IMAGE_FLIP + 1 };

AUR_API aur_result aur_image_metric_from_name(const char *name, aur_image_metric *metric, aur_error *error)
    AUR_NONNULL(1, 2);
AUR_API const char *aur_image_metric_name(aur_image_metric metric); /* NULL out of range */

/* value[0..2] for R, G, B; value[3] for all three together. Errors: ARGUMENT when sizes differ, there is no
 * colour, or a pixel is not finite (the message names the first one). */
AUR_API aur_result aur_image_compare(const aur_image *reference, const aur_image *image,
                                     aur_image_metric metric, double value[4], aur_error *error)
    AUR_NONNULL(1, 2, 4);

/* Error measures of an image, each a root mean square over pixels. Values and means are those of the
 * reference, averaged over 5 x 5 pixels. */
typedef enum aur_error_measure {
    AUR_ERROR_MEASURE_RELATIVE, /* error of luminance / (luminance + 1 % of the image's mean luminance) */
    AUR_ERROR_MEASURE_MEAN,     /* of R, G and B / the image's mean */
    /* Of displayed R, G and B, 0 to 1: exposed so that the geometric mean of luminance is .18, clipped, and
     * encoded by the sRGB curve. The peak signal-to-noise ratio is -20 log10 of it in dB. */
    AUR_ERROR_MEASURE_DISPLAY
} aur_error_measure;

enum { AUR_ERROR_MEASURE_COUNT = AUR_ERROR_MEASURE_DISPLAY + 1 };

AUR_API aur_result aur_error_measure_from_name(const char *name, aur_error_measure *measure, aur_error *error)
    AUR_NONNULL(1, 2);
AUR_API const char *aur_error_measure_name(aur_error_measure measure); /* NULL out of range */

/* The error of `image` by a measure; infinite if only the reference is black. Errors: as for
 * aur_image_compare; MEMORY. */
AUR_API aur_result aur_image_error(const aur_image *reference, const aur_image *image,
                                   aur_error_measure measure, double *value, aur_error *error)
    AUR_NONNULL(1, 2, 4);

/* LDR-FLIP (Andersson et al. 2020) of each pixel, in [0,1], in one channel: the visible difference when
 * flipping between the images on a screen with 67 pixels per degree. Radiance is clamped to [0,1]. Errors as
 * for aur_image_compare. */
AUR_API aur_result aur_image_flip(const aur_image *reference, const aur_image *image, aur_image **map,
                                  aur_error *error) AUR_NONNULL(1, 2, 3);

/* The first channel in false colour, from black at 0 and below over violet, red and yellow to white at
 * `scale` and above; 0: scale to the largest value. Meant for a PNG without tone curve. */
AUR_API aur_result aur_image_false_color(const aur_image *image, double scale, aur_image **colored,
                                         aur_error *error) AUR_NONNULL(1, 3);

/* The largest absolute difference among R, G and B of each pixel in the false colour of
 * aur_image_false_color. Errors as for aur_image_compare. */
AUR_API aur_result aur_image_difference(const aur_image *reference, const aur_image *image, double scale,
                                        aur_image **difference, aur_error *error) AUR_NONNULL(1, 2, 4);

#ifdef __cplusplus
}
#endif

#endif
