/* Luminances of images. */
#pragma once

#include <aureole-render/image.h>
#include <stdbool.h>

/* Weights of r, g, b and lm/W, as `aureole irradiance --illuminance` has them. */
typedef enum cli_luminance {
    CLI_LUMINANCE_NONE,
    CLI_LUMINANCE_RADIANCE,
    CLI_LUMINANCE_REC709,
    CLI_LUMINANCE_PHOTOPIC
} cli_luminance;

/* The image becomes one channel, Y, in cd/m2. Errors: FORMAT where it has no colours, MEMORY. */
aur_result cli_image_luminance(cli_luminance weights, aur_image **image, aur_error *error);
/* Draws the one channel in false colours with a scale up to `scale`; 0: to the largest value; with contours
 * at round values if `contours`. By the path's name: PNG, SVG, PDF or TeX. Errors: NAME, WRITE, MEMORY. */
aur_result cli_image_map(const char *path, const aur_image *image, double scale, bool contours,
                         aur_error *error);
