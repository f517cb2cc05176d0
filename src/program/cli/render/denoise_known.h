/* What is known of a picture better than by any denoiser: light that the camera sees directly, and how far
 * the values of pixels may be from the truth. */
#pragma once

#include <aureole-render/image.h>

/* The first three channels of `image` less bright light that is seen directly, of which the first three
 * channels of `lights` tell: denoisers spread a lamp beyond its rim. */
aur_result cli_known_take(const aur_image *image, const aur_image *lights, aur_image **rest,
                          aur_error *error);

/* In `out`, what the denoiser made of that: pixels that see bright light are those of `image` again, and
 * where this has standard errors (channels error.R, error.G and error.B) no value is further than twice its
 * own from where it was. All pictures are of one size. */
void cli_known_restore(const aur_image *image, const aur_image *lights, aur_image *out);
