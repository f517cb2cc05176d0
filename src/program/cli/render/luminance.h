/* Luminances of images. */
#pragma once

#include <aureole-render/image.h>
#include <stdbool.h>

/* Weights of r, g, b and lm/W, the same as for `aureole irradiance --illuminance`. */
typedef enum cli_luminance {
    CLI_LUMINANCE_NONE,
    CLI_LUMINANCE_RADIANCE,
    CLI_LUMINANCE_REC709,
    CLI_LUMINANCE_PHOTOPIC
} cli_luminance;

/* Converts the image to one channel, Y, in cd/m2. Errors: FORMAT without colors, MEMORY. */
aur_result cli_image_luminance(cli_luminance weights, aur_image **image, aur_error *error);
/* Draws the single channel in false colors with a scale up to `scale` (0: the largest value), and with
 * contours at round values if `contours`. The format follows from the path: PNG, SVG, PDF or TeX. Errors:
 * NAME, WRITE, MEMORY. */
aur_result cli_image_map(const char *path, const aur_image *image, double scale, bool contours,
                         aur_error *error);
