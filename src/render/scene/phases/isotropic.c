/* Isotropic scattering. */
#include "render/scene/phase.h"

static float evaluate(const aur_phase *phase, aur_vector position, float cosine) {
    (void)phase, (void)position, (void)cosine;
    return 1.0f / (4.0f * AUR_PI_F);
}

static float draw(const aur_phase *phase, aur_vector position, float u) {
    (void)phase, (void)position;
    return 1.0f - 2.0f * u;
}

const aur_phase_descriptor aur_phase_isotropic = {
    .row = {.name = "isotropic", .summary = "the same in all directions", .source = "Mitsuba 3"},
    .evaluate = evaluate,
    .draw = draw,
};

const aur_phase aur_phase_uniform = {.descriptor = &aur_phase_isotropic};
