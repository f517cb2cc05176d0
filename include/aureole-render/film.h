/* Films: the sums of an image's samples while it is rendered, and after. A film can be kept in a file, put
 * together from parts, and made into an image at any time.
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

/* The image: the mean of each pixel's samples, weighed by the filter where pixels share samples; 0 where
 * there are none. A new image, which the caller destroys. Errors: MEMORY. */
AUR_EXPERIMENTAL aur_result aur_film_develop(const aur_film *film, aur_image **image, aur_error *error)
    AUR_NONNULL(1, 2);

/* The standard error of each pixel's mean, in the image's units, in channels R, G, B: what the means of the
 * film's steps (aur_render_step) say of it, s = sqrt(sum_b n_b (m_b - m)^2 / ((B - 1) N)) for B steps of n_b
 * samples with means m_b, N samples in all; where pixels share samples, the same of their weighed sums. It is
 * the error of independent samples; where later samples fill
 * the gaps of earlier ones, as those of quasi-Monte Carlo samplers do, the true error is usually smaller. An
 * error that is the same in all steps, such as a photon map's, is not seen. rmse[4] has the root mean square
 * over the pixels for R, G, B and for all three; it and `image` may be NULL. Errors: UNSUPPORTED when some
 * pixel has fewer than two steps, MEMORY. */
AUR_EXPERIMENTAL aur_result aur_film_error(const aur_film *film, double rmse[4], aur_image **image,
                                           aur_error *error) AUR_NONNULL(1);

#ifdef __cplusplus
}
#endif

#endif
