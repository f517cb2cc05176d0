/* Lamps that the camera sees straight. Where the edge of a bright one crosses a pixel, how much of it is seen
 * may be nearly all of the pixel's error, and a camera ray tells it without the path that follows. So in such
 * pixels a sample has many camera rays for the lamps alone: their mean takes the place of what the sample's
 * own ray meets. The rays of all samples are one sequence of Sobol's, which the pixel's error follows. Which
 * pixels have how many is known before any sample is drawn, so that pictures stay without bias. */
#pragma once

#include "render/film/integrator.h"

typedef struct aur_lamp_looks {
    uint16_t *counts; /* of each pixel of the whole picture: rays a sample, powers of two; 0: none */
    aur_sampler *sampler;
} aur_lamp_looks;

/* So many rays a sample in the picture's mean at most, shared out over the pixels in proportion to the
 * standard deviation of what lamps send there, to the power 4/5: errors fall as rays^-3/2 (Owen 1997), and so
 * their sum is least. *looks belongs to the context's cache; NULL where no pixel has any, or the camera is no
 * pinhole. Errors: MEMORY, CANCELLED. */
aur_result aur_lamp_looks_find(const aur_view *view, double rays, const aur_integrator_context *context,
                               const aur_lamp_looks **looks, aur_error *error);

/* What lamps send straight to sample `index` of a pixel. False where its own ray is to tell. */
bool aur_lamp_look(const aur_lamp_looks *looks, const aur_view *view, size_t x, size_t y, uint32_t index,
                   aur_vector *seen);
