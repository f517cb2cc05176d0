/* Scattering of unpolarised light by particles much smaller than the wavelength (Rayleigh 1871). */
#include "render/scene/phase.h"

static float evaluate(const aur_phase *phase, aur_vector position, float cosine) {
    (void)phase, (void)position;
    return 3.0f / (16.0f * AUR_PI_F) * (1.0f + cosine * cosine);
}

/* The root of c^3 + 3 c = 8 u - 4, by Cardano's formula (Frisvad 2011). The smaller of the two cube roots is
 * computed from the larger one, to avoid cancellation. */
static float draw(const aur_phase *phase, aur_vector position, float u) {
    (void)phase, (void)position;
    const float half = 4.0f * u - 2.0f, size = fabsf(half);
    const float root = cbrtf(size + sqrtf(size * size + 1.0f));
    return copysignf(aur_smaller(root - 1.0f / root, 1.0f), half);
}

const aur_phase_descriptor aur_phase_rayleigh = {
    .row = {.name = "rayleigh",
            .summary = "particles much smaller than the wavelength",
            .source = "Rayleigh 1871"},
    .evaluate = evaluate,
    .draw = draw,
};
