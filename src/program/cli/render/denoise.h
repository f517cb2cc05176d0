/* `aureole render --denoise`: Open Image Denoise (Intel), where its library is found when it is asked for. */
#pragma once

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

/* Takes the noise out of R, G and B of the picture that was rendered with `options`, by albedo and normals
 * that are rendered for it. What they were becomes noisy.R, noisy.G, noisy.B beside the albedo and normals.
 * Errors: INTERNAL with the library's words, and those of aur_renderer_render. */
aur_result cli_denoise_picture(const cli_denoise *denoise, aur_renderer *renderer,
                               const aur_render_options *options, aur_image **image, aur_error *error);

/* A format that has R, G and B alone leaves the noisy picture out: it goes beside, as OUT.noisy.exr. */
aur_result cli_denoise_keep(const cli_denoise *denoise, const char *output, const aur_image *image,
                            aur_error *error);
