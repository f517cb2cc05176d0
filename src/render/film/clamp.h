/* Limits the indirect light of samples, for images without fireflies. The light removed by a limit is
 * unbiased and is stored in separate channels: their mean estimates the bias. */
#pragma once

#include "points/base/error.h"
#include "render/film/integrator.h"

/* A key for such limits; the field is a float, 0: none. */
#define AUR_CLAMP_KEY(struct_)                                                                               \
    {                                                                                                        \
        AUR_KEY_OF_REAL(struct_, "clamp", clamp, 0.0, 1e30, "0",                                             \
                        "limit of the light after the first surface in each sample, by the largest of R, "   \
                        "G, B; 0: none. Channels clamped.R, .G, .B have the removed light")                  \
    }

/* The first of the channels of removed light. */
#define AUR_CLAMPED_CHANNEL "clamped.R"

/* Adds the channels where there is a limit. */
static inline void aur_clamp_prepare(float clamp, aur_integrator *integrator) {
    static const char *const names[] = {AUR_CLAMPED_CHANNEL, "clamped.G", "clamped.B"};
    if (!(clamp > 0.0f))
        return;
    integrator->extra_count = 3;
    integrator->extra_names = names;
}

/* The limited radiance of a sample; `unscattered` is the part from the first surface, which is not limited.
 */
static inline aur_vector aur_clamped(aur_vector radiance, aur_vector unscattered, float clamp) {
    const aur_vector rest = aur_vector_subtract(radiance, unscattered);
    const float most = aur_vector_max(rest);
    return clamp > 0.0f && most > clamp ? aur_vector_add_scaled(unscattered, clamp / most, rest) : radiance;
}

/* Adds a limited sample to a pixel, and the removed light to its channels. */
static inline void aur_tile_add_clamped(aur_tile *tile, size_t x, size_t y, uint32_t index,
                                        const float offset[2], aur_vector radiance, aur_vector unscattered,
                                        float clamp) {
    if (!(clamp > 0.0f) || !aur_is_radiance(radiance)) {
        aur_tile_add(tile, x, y, index, offset, radiance);
        return;
    }
    const aur_vector limited = aur_clamped(radiance, unscattered, clamp);
    const aur_vector left = aur_tile_measured(tile, limited);
    const aur_vector taken = aur_tile_measured(tile, aur_vector_subtract(radiance, limited));
    const float values[] = {left.x, left.y, left.z, taken.x, taken.y, taken.z};
    aur_tile_add_channels(tile, x, y, index, offset, values);
}
