/* Films: the sums of an image's samples, during and after rendering. A film can be saved in a file, merged
 * from parts, and developed into an image at any time.
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

/* The image: the mean of each pixel's samples, weighted by the filter if pixels share samples; 0 without
 * samples. A new image, which the caller destroys. Errors: MEMORY. */
AUR_EXPERIMENTAL aur_result aur_film_develop(const aur_film *film, aur_image **image, aur_error *error)
    AUR_NONNULL(1, 2);

/* The standard error of each pixel's mean, in the image's units, in channels R, G, B. It is estimated from
 * the means of the film's steps (aur_render_step), s = sqrt(sum_b n_b (m_b - m)^2 / ((B - 1) N)) for B steps
 * of n_b samples with means m_b, N samples in all; where pixels share samples, likewise from their weighted
 * sums. It is the error of independent samples. Where later samples fill the gaps of earlier ones, as with
 * quasi-Monte Carlo samplers, the true error is usually smaller. An error common to all steps, such as a
 * photon map's, is not included. rmse[4] is the root mean square over the pixels for R, G, B and for all
 * three; it and `image` may be NULL. Errors: UNSUPPORTED if some pixel has fewer than two steps, MEMORY. */
AUR_EXPERIMENTAL aur_result aur_film_error(const aur_film *film, double rmse[4], aur_image **image,
                                           aur_error *error) AUR_NONNULL(1);

#ifdef __cplusplus
}
#endif

#endif
