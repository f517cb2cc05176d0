/* `aureole render --denoise`: Open Image Denoise (Intel), where its library is found when it is asked for. */
#pragma once

#include <aureole-render/adaptive.h>
#include <aureole-render/image.h>
#include <aureole-render/render.h>

#include "program/cli/options.h"

typedef struct cli_denoise {
    bool wanted;
    struct cli_oidn *library;
} cli_denoise;

extern const cli_option cli_denoise_options[]; /* cli_denoise */

/* Finds the library where it is wanted, before an hour is spent. Errors: UNSUPPORTED, which says what would
 * be right. */
aur_result cli_denoise_begin(cli_denoise *denoise, aur_error *error);
void cli_denoise_end(cli_denoise *denoise);

/* Takes the noise out of R, G and B of the image that was rendered with `options`, by albedo and normals that
 * are rendered for it. What they were becomes noisy.R, noisy.G, noisy.B next to the albedo and normals. The
 * halves of `adaptive`, which may be NULL, are denoised too, and `figures` get their error; they are zero
 * without. Errors: INTERNAL with the library's words, and those of aur_renderer_render. */
aur_result cli_denoise_picture(const cli_denoise *denoise, aur_renderer *renderer,
                               const aur_render_options *options, const aur_adaptive *adaptive,
                               aur_image **image, aur_error_figures *figures, aur_error *error);

/* A format that has R, G and B alone leaves the noisy image out: it goes beside, as OUT.noisy.exr. */
aur_result cli_denoise_keep(const cli_denoise *denoise, const char *output, const aur_image *image,
                            aur_error *error);

/* What is known of an image better than by any denoiser: light that the camera sees directly, and how far
 * the values of pixels may be from the truth. */

/* The first three channels of `image` less bright light that is seen directly, of which the first three
 * channels of `lights` tell: denoisers spread a lamp beyond its rim. */
aur_result cli_known_take(const aur_image *image, const aur_image *lights, aur_image **rest,
                          aur_error *error);

/* In `out`, what the denoiser made of that: pixels that see bright light are those of `image` again. Where
 * this has standard errors (channels error.R, error.G and error.B), the change of a pixel is scaled down by
 * what the changes in the 5 x 5 pixels around it are, as a root mean square, over twice the standard errors
 * there. The limit is of neighbourhoods, because replicas may agree by chance in single pixels. All images
 * are of one size. */
aur_result cli_known_restore(const aur_image *image, const aur_image *lights, aur_image *out,
                             aur_error *error);

/* Open Image Denoise, loaded while the program runs: its C interface, version 1.4 or 2. */

typedef struct cli_oidn cli_oidn;

/* From the file that AUREOLE_OIDN names; else as the system finds it, or beside oidnDenoise in PATH. Errors:
 * UNSUPPORTED. */
aur_result cli_oidn_open(cli_oidn **oidn, aur_error *error);
void cli_oidn_close(cli_oidn *oidn); /* NULL is allowed */

/* The first three channels of `image` without noise into those of `out`, by channels 3 to 5 (albedo) and 6 to
 * 8 (normals) of `features`; all of one size. Errors: INTERNAL with the library's words. */
aur_result cli_oidn_run(const cli_oidn *oidn, aur_image *image, aur_image *features, aur_image *out,
                        aur_error *error);
