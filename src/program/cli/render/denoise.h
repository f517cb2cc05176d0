/* `aureole render --denoise`: Open Image Denoise (Intel), if its library is found at run time. */
#pragma once

#include <aureole-render/adaptive.h>
#include <aureole-render/image.h>
#include <aureole-render/render.h>

#include "program/cli/options.h"

typedef struct cli_denoise {
    bool enabled;
    struct cli_oidn *library;
} cli_denoise;

extern const cli_option cli_denoise_options[]; /* cli_denoise */

/* Opens the library if requested, before the render. Errors: UNSUPPORTED, with the possible remedies. */
aur_result cli_denoise_begin(cli_denoise *denoise, aur_error *error);
void cli_denoise_end(cli_denoise *denoise);

/* Denoises R, G and B of the image that was rendered with `options`, using albedo and normals that it
 * renders. The noisy values become channels noisy.R, noisy.G, noisy.B, next to the albedo and normals.
 * `adaptive` is NULL without a target. If `bounds`, its halves are denoised too, and `figures` get their
 * error; otherwise zeros.
 * Errors: INTERNAL with the library's message, and those of aur_renderer_render. */
aur_result cli_denoise_image(const cli_denoise *denoise, aur_renderer *renderer,
                             const aur_render_options *options, aur_adaptive *adaptive, bool bounds,
                             aur_image **image, aur_error_figures *figures, aur_error *error);

/* Writes the noisy image to OUT.noisy.exr if the output format only has R, G and B. */
aur_result cli_denoise_write_noisy(const cli_denoise *denoise, const char *output, const aur_image *image,
                                   aur_error *error);

/* Parts of an image that are more accurate than a denoiser's output: directly visible light, and limits from
 * the standard errors of pixels. */

/* Subtracts bright directly visible light, the first three channels of `lights`, from the first three
 * channels of `image`: denoisers blur light sources beyond their edges. */
aur_result cli_direct_light_subtract(const aur_image *image, const aur_image *lights, aur_image **rest,
                                     aur_error *error);

/* In `out`, the denoised result: pixels with bright visible light get the values of `image` again. If `image`
 * has standard errors (channels error.R, error.G and error.B), the change of a pixel is limited: it is scaled
 * so that the root mean square change over 5 x 5 pixels is at most twice the standard errors there. The limit
 * uses neighborhoods because replicas may agree by chance in single pixels. All images have one size. */
aur_result cli_direct_light_restore(const aur_image *image, const aur_image *lights, aur_image *out,
                                    aur_error *error);

/* Open Image Denoise, loaded at run time: its C interface, version 1.4 or 2. */

typedef struct cli_oidn cli_oidn;

/* Loads the file that AUREOLE_OIDN names; otherwise from the system, or relative to oidnDenoise in PATH.
 * Errors: UNSUPPORTED. */
aur_result cli_oidn_open(cli_oidn **oidn, aur_error *error);
void cli_oidn_close(cli_oidn *oidn); /* NULL is allowed */

/* Denoises the first three channels of `image` into those of `out`, using channels 3 to 5 (albedo) and 6 to 8
 * (normals) of `features`; all of one size. Errors: INTERNAL with the library's message. */
aur_result cli_oidn_run(const cli_oidn *oidn, aur_image *image, aur_image *features, aur_image *out,
                        aur_error *error);
