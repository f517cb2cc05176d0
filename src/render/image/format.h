/* File formats, and their shared code. A format is one aur_image_format_<name>, defined in the file that
 * reads it, and one line in AUR_IMAGE_FORMATS. */
#pragma once

#include <aureole-render/image.h>
#include <stdbool.h>
#include <stdio.h>

#include "points/base/error.h"
#include "points/base/keys.h"

/* The inside of an image. */

enum { AUR_NOTES_CAPACITY = 512 };

struct aur_image {
    size_t width, height, channel_count;
    float *data;          /* data[(y * width + x) * channel_count + c]; the top row first */
    unsigned char *codes; /* of 8 bits, in the same order, instead of `data`; only of images that are coded */
    bool data_is_owned;   /* false: the caller's, see aur_image_wrap */
    char (*channel_names)[AUR_CHANNEL_NAME_CAPACITY];
    bool chosen; /* one or three channels chosen by the caller: they are the colour, whatever their names */
    char notes[AUR_NOTES_CAPACITY];
};

/* The most values (pixels times channels) of an image: 4 GiB of floats. A file that claims more is rejected.
 */
#define AUR_IMAGE_VALUES_MAX ((size_t)1 << 30)

/* A file in memory. */
typedef struct aur_image_source {
    const char *name; /* for messages */
    size_t size;
    const unsigned char *data;
} aur_image_source;

typedef struct aur_image_target {
    const char *name;
    FILE *stream;
    aur_image_write_options options;
    size_t channels[3]; /* red, green and blue; not for formats with every_channel */
} aur_image_target;

typedef struct aur_image_format {
    aur_row row;        /* its name is the extension, its keys are fields of aur_image_write_options */
    const char *name;   /* what aur_image_format_of returns */
    bool every_channel; /* all channels are written, not a colour */
    bool (*recognize)(const aur_image_source *source);
    /* Both leave it to the caller to add the file's name to errors, and to destroy an incomplete image. */
    aur_result (*read)(const aur_image_source *source, aur_image **image, aur_error *error);
    /* The caller that commits the file checks the stream for errors. NULL: read only. */
    aur_result (*write)(const aur_image_target *target, const aur_image *image, aur_error *error);
} aur_image_format;

#define AUR_IMAGE_FORMATS(ROW)                                                                               \
    ROW(exr)                                                                                                 \
    ROW(pfm)                                                                                                 \
    ROW(hdr)                                                                                                 \
    ROW(png)                                                                                                 \
    ROW(jpeg)                                                                                                \
    ROW(bmp)                                                                                                 \
    ROW(tga)

#define AUR_DECLARE_IMAGE_FORMAT(name) extern const aur_image_format aur_image_format_##name;
AUR_IMAGE_FORMATS(AUR_DECLARE_IMAGE_FORMAT)
#undef AUR_DECLARE_IMAGE_FORMAT

extern const aur_table aur_image_format_table;

aur_result aur_image_write_exr(const aur_image_target *target, const aur_image *image, aur_error *error);

/* For 8-bit formats: the displayed image, grey or R, G, B, after exposure and tone curve; NULL if out of
 * memory, else to be freed. The macro below has the keys for the rows of such formats. */
unsigned char *aur_image_display(const aur_image_target *target, const aur_image *image,
                                 size_t *channel_count);
enum { AUR_DISPLAY_KEY_COUNT = 2 };
extern const aur_key aur_display_keys[AUR_DISPLAY_KEY_COUNT];

/* FORMAT if a file claims a size beyond the limit of images. */
aur_result aur_image_check_size(size_t width, size_t height, size_t channel_count, aur_error *error);

/* FORMAT if a file of this length cannot contain that many pixels: decoders allocate before they read. */
aur_result aur_image_check_claim(const aur_image_source *source, const char *format, size_t pixel_count,
                                 size_t pixels_a_byte, aur_error *error);

/* Images of 8 bits are coded until somebody needs floats: a quarter of the memory, and no value is infinite,
 * NaN or negative. Errors are those of the public counterparts. */
aur_result aur_image_create_coded(size_t width, size_t height, size_t channel_count, aur_image **image,
                                  aur_error *error);
/* What the 256 codes of a channel stand for: sRGB, or alpha in equal steps. */
void aur_image_code_values(const aur_image *image, size_t channel, float values[256]);
/* Gives a coded image its floats; others stay as they are. MEMORY. */
aur_result aur_image_expand(aur_image *image, aur_error *error);
/* aur_image_read and aur_image_read_memory, whose image may be coded. */
aur_result aur_image_read_coded(const char *path, aur_image **image, aur_error *error);
aur_result aur_image_read_memory_coded(const char *name, size_t size, const void *data, aur_image **image,
                                       aur_error *error);

/* Does the source begin with these bytes? */
bool aur_image_begins(const aur_image_source *source, const char *bytes, size_t count);

/* For stb's writer: the context is a stream, whose errors are checked by the caller that commits the file. */
void aur_image_put_bytes(void *stream, void *bytes, int count);
aur_result aur_image_fail_encode(aur_error *error);

/* Adds to what aur_image_notes returns. */
void aur_image_note(aur_image *image, const char *format, ...) AUR_PRINTF(2, 3);

/* "R, G, depth": as much as fits. */
void aur_image_list_channels(const aur_image *image, size_t capacity, char *text);

/* Red, green and blue, or an ARGUMENT error that names the channels that there are. `name` may be NULL. */
aur_result aur_image_require_color(const char *name, const aur_image *image, size_t channels[3],
                                   aur_error *error);

/* The roles of channels, by the names that OpenEXR and other programs give them, in either case. */

typedef enum aur_channel_role {
    AUR_CHANNEL_RED, /* the order in which channels of a layer are sorted */
    AUR_CHANNEL_GREEN,
    AUR_CHANNEL_BLUE,
    AUR_CHANNEL_X,
    AUR_CHANNEL_Y, /* luminance, or the second of X, Y, Z */
    AUR_CHANNEL_ALPHA,
    AUR_CHANNEL_Z, /* depth, or the third of X, Y, Z */
    AUR_CHANNEL_OTHER,
    AUR_CHANNEL_RY, /* (R - Y) / Y */
    AUR_CHANNEL_BY,
    AUR_CHANNEL_DATA /* recognised, and not a colour */
} aur_channel_role;

/* The length of the layer prefix of a name, including its dot; 0 without one. */
size_t aur_channel_layer(const char *name);
aur_channel_role aur_channel_role_of(const char *name);
/* The first channel of a role in the layer of the name `layer`; SIZE_MAX if there is none. */
size_t aur_image_find_role(const aur_image *image, const char *layer, aur_channel_role role);

/* What the measures of difference share. */

/* The indices of red, green and blue in two images that can be compared. */
typedef struct aur_color_pair {
    size_t reference[3], image[3];
} aur_color_pair;

/* ARGUMENT with the position of the first value of the channels that is not finite; `what` names the image.
 */
aur_result aur_image_check_finite(const char *what, const aur_image *image, const size_t channels[3],
                                  aur_error *error);

/* ARGUMENT when sizes differ, there is no colour or a value is not finite. */
aur_result aur_image_check_pair(const aur_image *reference, const aur_image *image, aur_color_pair *pair,
                                aur_error *error);

/* Between radiance and what a screen is sent. */

/* The sRGB transfer function (IEC 61966-2-1) and its inverse; arguments and values in [0,1], arguments beyond
 * it are clamped, NaN is 0. */
AUR_INTERNAL double aur_srgb_encode(double linear);
double aur_srgb_decode(double encoded);

/* Radiance to [0,1] in linear light by a curve. */
double aur_tone_apply(aur_tone tone, double radiance);
