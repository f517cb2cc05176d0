/* The error of a denoiser, from two independent halves of an image's samples. */
#pragma once

#include "render/image/error_interval.h"
#include "render/image/error_measure.h"

/* `made[h]` is the denoised image of halves[h]; its first channels are R, G and B. Each is compared with the
 * other half, whose independent noise averages out, so that no reference is needed. The interval is Student's
 * over blocks of 8 x 8 pixels; it is unbounded above with only one block. Errors: ARGUMENT for images of
 * different sizes, MEMORY. */
aur_result aur_error_of_halves(const aur_image *const halves[2], const aur_image *const processed[2],
                               aur_error_measure measure, double confidence, aur_error_interval *interval,
                               aur_error *error);
