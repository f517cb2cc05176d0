/* Films: the sums of a picture's samples while it is rendered, and after. A film can be kept in a file, put
 * together from parts, and made into a picture at any time.
 *
 * Experimental: all of this header may change in any version. */
#ifndef AUREOLE_FILM_H
#define AUREOLE_FILM_H

#include <aureole-render/image.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Not for two threads at once, unless both only read. */
typedef struct aur_film aur_film;

AUR_EXPERIMENTAL void aur_film_destroy(aur_film *film); /* NULL is allowed */

/* `size` is set by the caller to the size of his struct. */
typedef struct aur_film_description {
    size_t size;
    /* Of the whole picture, in pixels. */
    size_t width, height;
    /* The pixels that the film has: x0 <= x < x1, y0 <= y < y1. */
    size_t x0, x1, y0, y1;
    size_t channel_count;
    /* Camera samples of a pixel: every pixel has the least, some pixel the most. */
    uint64_t least_samples, most_samples;
} aur_film_description;

/* Errors: ARGUMENT when `size` is not set. */
AUR_EXPERIMENTAL aur_result aur_film_describe(const aur_film *film, aur_film_description *description,
                                              aur_error *error) AUR_NONNULL(1, 2);
/* The name of a channel as in the picture; NULL beyond channel_count. The film owns it. */
AUR_EXPERIMENTAL const char *aur_film_channel_name(const aur_film *film, size_t channel) AUR_NONNULL(1);

/* Adds the samples of `part`, whose picture has the same size and channels and whose pixels are the film's
 * own or whole tiles of them (16 x 16 pixels on a grid over the whole picture). Pixels that have samples from
 * only one of the two keep every bit; where both have some, the sums are added in double precision. The
 * parts' samples must be different ones: nothing can tell. Errors: ARGUMENT for another size, other channels,
 * or pixels that do not fit. */
AUR_EXPERIMENTAL aur_result aur_film_merge(aur_film *film, const aur_film *part, aur_error *error)
    AUR_NONNULL(1, 2);

/* The picture: the mean of each pixel's samples; 0 where there are none. A new image, which the caller
 * destroys. Errors: MEMORY. */
AUR_EXPERIMENTAL aur_result aur_film_develop(const aur_film *film, aur_image **image, aur_error *error)
    AUR_NONNULL(1, 2);

/* The standard error of each pixel's mean, in the picture's units, in channels R, G, B: what the means of the
 * film's steps (aur_render_step) say of it, s = sqrt(sum_b n_b (m_b - m)^2 / ((B - 1) N)) for B steps of n_b
 * samples with means m_b, N samples in all. It is the error of independent samples; where later samples fill
 * the gaps of earlier ones, as those of quasi-Monte Carlo samplers do, the true error is usually smaller. An
 * error that is the same in all steps, such as a photon map's, is not seen. rmse[4] has the root mean square
 * over the pixels for R, G, B and for all three; it and `image` may be NULL. Errors: UNSUPPORTED when some
 * pixel has fewer than two steps, MEMORY. */
AUR_EXPERIMENTAL aur_result aur_film_error(const aur_film *film, double rmse[4], aur_image **image,
                                           aur_error *error) AUR_NONNULL(1);

/* Writes all that the film holds, little-endian, with a checksum; the file is replaced whole or not at all.
 * Errors: WRITE, MEMORY. */
AUR_EXPERIMENTAL aur_result aur_film_save(const aur_film *film, const char *path, aur_error *error)
    AUR_NONNULL(1, 2);
/* Errors: OPEN, FORMAT (no film, a damaged one, or one of another version), MEMORY. */
AUR_EXPERIMENTAL aur_result aur_film_load(const char *path, aur_film **film, aur_error *error)
    AUR_NONNULL(1, 2);
/* The same from memory; `name` stands in messages. */
AUR_EXPERIMENTAL aur_result aur_film_load_memory(const char *name, size_t size, const void *data,
                                                 aur_film **film, aur_error *error) AUR_NONNULL(1, 3, 4);

#ifdef __cplusplus
}
#endif

#endif
