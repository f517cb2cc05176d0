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

/* Zero filled. The channels are named Y; Y, A; R, G, B; R, G, B, A when there are one to four; more are to be
 * named by the caller. Errors: ARGUMENT for a size of zero or beyond 2^30 values, MEMORY. */
AUR_API aur_result aur_image_create(size_t width, size_t height, size_t channel_count, aur_image **image,
                                    aur_error *error) AUR_NONNULL(4);
/* The same about the caller's values, which are not copied, lie as aur_image_data says, and must outlive the
 * image. */
AUR_API aur_result aur_image_wrap(size_t width, size_t height, size_t channel_count, float *data,
                                  aur_image **image, aur_error *error) AUR_NONNULL(4, 5);
AUR_API void aur_image_destroy(aur_image *image); /* NULL is allowed */

AUR_API size_t aur_image_width(const aur_image *image) AUR_NONNULL(1);
AUR_API size_t aur_image_height(const aur_image *image) AUR_NONNULL(1);
AUR_API size_t aur_image_channel_count(const aur_image *image) AUR_NONNULL(1);
/* data[(y * width + x) * channel_count + c], the top row first: for reading and writing, as long as the image
 * is there. */
AUR_API float *aur_image_data(const aur_image *image) AUR_NONNULL(1);
/* What the reader made of the file and the values do not show ("its PRIMARIES are not those of Rec. 709:
 * ..."), for a warning; "" when there is nothing to say. As long as the image is there. */
AUR_API const char *aur_image_notes(const aur_image *image) AUR_NONNULL(1);
/* "R", "G", "B", "albedo.R", ...; NULL beyond the channels. */
AUR_API const char *aur_image_channel_name(const aur_image *image, size_t channel) AUR_NONNULL(1);
/* Errors: ARGUMENT for a channel that is not there or a name of AUR_CHANNEL_NAME_CAPACITY bytes or more. */
AUR_API aur_result aur_image_name_channel(aur_image *image, size_t channel, const char *name,
                                          aur_error *error) AUR_NONNULL(1, 3);

/* By content: EXR (scan lines or tiles; half, float or uint; the full-size level of the first part), PFM,
 * HDR, PNG, JPEG. "-" is standard input. PNG and JPEG are decoded from sRGB to linear. Colour comes as
 * R, G, B, A, then the channels of other layers, layer by layer. Y, RY, BY and X, Y, Z of an EXR become R, G,
 * B, and EXPOSURE and COLORCORR of an HDR are divided out. Errors: OPEN, FORMAT, UNSUPPORTED (deep EXR),
 * MEMORY. */
AUR_API aur_result aur_image_read(const char *path, aur_image **image, aur_error *error) AUR_NONNULL(1, 2);
/* The same from memory; `name` stands in messages. */
AUR_API aur_result aur_image_read_memory(const char *name, size_t size, const void *data, aur_image **image,
                                         aur_error *error) AUR_NONNULL(1, 3, 4);

/* "EXR", "PFM", "HDR", "PNG" or "JPEG" by the first bytes of a file, NULL when it is none of them. */
AUR_API const char *aur_image_format_of(size_t size, const void *data) AUR_NONNULL(2);

/* How radiance becomes an 8-bit value: exposure in stops, then the curve, then the sRGB transfer function. */
typedef enum aur_tone {
    AUR_TONE_SRGB,  /* no curve: radiance 1 is white */
    AUR_TONE_FILMIC /* Hable 2010, white at 11.2 after his exposure bias of 2 */
} aur_tone;

enum { AUR_TONE_COUNT = AUR_TONE_FILMIC + 1 };

/* "srgb", "filmic" to the value and back. Errors: NAME, *tone untouched; the name of a value out of range is
 * NULL. */
AUR_API aur_result aur_tone_from_name(const char *name, aur_tone *tone, aur_error *error) AUR_NONNULL(1, 2);
AUR_API const char *aur_tone_name(aur_tone tone);

/* All zero but `size`, as aur_image_write_options_init fills it, writes radiance as it is. */
typedef struct aur_image_write_options {
    size_t size;        /* of the caller's struct, so that it can grow */
    float exposure;     /* stops, finite; PNG only */
    aur_tone tone;      /* PNG only */
    bool half;          /* EXR: 16-bit floats; finite values are kept finite (at most 65504) */
    const char *format; /* an extension: "exr", ...; NULL: that of the path, and exr for "-" */
} aur_image_write_options;

AUR_API aur_result aur_image_write_options_init(aur_image_write_options *options, aur_error *error)
    AUR_NONNULL(1);

/* The row, of the table "picture", of the format that aur_image_write writes to this path: its name is the
 * extension, its keys the options that it takes. `format` as in the options, or NULL. NAME when there is none
 * that can be written; *row is NULL then. */
AUR_API aur_result aur_image_find_writer(const char *path, const char *format, const aur_row **row,
                                         aur_error *error) AUR_NONNULL(1, 3);

/* EXR holds every channel; the others R, G, B (or a single channel: PFM and PNG as grey, HDR as three equal
 * ones). The file is replaced whole or not at all; "-" is standard output, as EXR unless the options say
 * otherwise. The same image gives the same bytes. `options` may be NULL. Errors: ARGUMENT (unnamed channels,
 * no colour, options out of range), NAME (unknown extension), WRITE, MEMORY. */
AUR_API aur_result aur_image_write(const char *path, const aur_image *image,
                                   const aur_image_write_options *options, aur_error *error)
    AUR_NONNULL(1, 2);

/* The index of a channel, or SIZE_MAX. */
AUR_API size_t aur_image_find_channel(const aur_image *image, const char *name) AUR_NONNULL(1, 2);
/* Which channels are red, green and blue, by names of either case: R, G, B or red, green, blue; else Y or
 * grey for all three; else those of the one layer ("diffuse.R") that has such channels, or of the one called
 * Combined among several. The one or three channels of aur_image_select are the colour whatever they are
 * called, and so is a single channel that is no A, Z or ZBack. False when there is no such choice: roles are
 * never guessed. */
AUR_API bool aur_image_color_channels(const aur_image *image, size_t channels[3]) AUR_NONNULL(1, 2);
/* Adds to found[0], found[1] and found[2] how many values of a channel are infinite, NaN and negative
 * (-infinity counts as negative). */
AUR_API void aur_image_count_odd(const aur_image *image, size_t channel, size_t found[3]) AUR_NONNULL(1, 3);
/* An image of some of the channels, in the order given. Errors: NAME, MEMORY. */
AUR_API aur_result aur_image_select(const aur_image *image, size_t count, const char *const *names,
                                    aur_image **selected, aur_error *error) AUR_NONNULL(1, 3, 4);
/* Means of block x block pixels; blocks at the right and lower edge are averaged over what they have. */
AUR_API aur_result aur_image_downsample(const aur_image *image, size_t block, aur_image **smaller,
                                        aur_error *error) AUR_NONNULL(1, 3);
/* The mean radiance of R, G, B, and of the three together. Errors: ARGUMENT without colour or when a pixel is
 * not finite. */
AUR_API aur_result aur_image_mean(const aur_image *image, double mean[4], aur_error *error) AUR_NONNULL(1, 2);

/* Figures of the difference of two images of one size; a is the image, r the reference. */
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

/* What one number says of the error of an image. Each is a root mean square over pixels; values and means are
 * the reference's, averaged over 5 x 5 pixels. */
typedef enum aur_error_measure {
    AUR_ERROR_MEASURE_RELATIVE, /* error of luminance / (luminance + 1 % of the image's mean luminance) */
    AUR_ERROR_MEASURE_MEAN,     /* of R, G and B / the image's mean */
    /* Of R, G and B as a screen shows them, from 0 to 1: by the sRGB curve, exposed so that the geometric
     * mean of luminance is .18, and clipped. The peak signal-to-noise ratio is -20 log10 of it in dB. */
    AUR_ERROR_MEASURE_DISPLAY
} aur_error_measure;

enum { AUR_ERROR_MEASURE_COUNT = AUR_ERROR_MEASURE_DISPLAY + 1 };

AUR_API aur_result aur_error_measure_from_name(const char *name, aur_error_measure *measure, aur_error *error)
    AUR_NONNULL(1, 2);
AUR_API const char *aur_error_measure_name(aur_error_measure measure); /* NULL out of range */

/* The error of `image` by a measure; infinite for a black reference and an image that is not. Errors as for
 * aur_image_compare, MEMORY. */
AUR_API aur_result aur_image_error(const aur_image *reference, const aur_image *image,
                                   aur_error_measure measure, double *value, aur_error *error)
    AUR_NONNULL(1, 2, 4);

/* LDR-FLIP (Andersson et al. 2020) of each pixel, in [0,1], in one channel: how much a person sees who flips
 * between the images on a screen of 67 pixels a degree. Radiance is clamped to [0,1]. Errors as for
 * aur_image_compare. */
AUR_API aur_result aur_image_flip(const aur_image *reference, const aur_image *image, aur_image **map,
                                  aur_error *error) AUR_NONNULL(1, 2, 3);

/* The first channel in false colour, from black at 0 and below over violet, red and yellow to white at
 * `scale` and beyond; 0 chooses the largest value. Shows as intended in a PNG without tone curve. */
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
