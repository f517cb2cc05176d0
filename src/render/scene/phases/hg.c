/* The phase function of Henyey and Greenstein (1941). */
#include <float.h>

#include "render/scene/phase.h"

typedef struct henyey_greenstein {
    float g;
} henyey_greenstein;

static const aur_key keys[] = {
    {AUR_KEY_OF_REAL(henyey_greenstein, "g", g, -1.0, 1.0, "0.8",
                     "mean cosine: above 0 forward, below 0 backward scattering"),
     .minimum_open = true, .maximum_open = true},
};

/* A number just inside the range may have become 1 as a float. */
static aur_result create(aur_parameters *parameters, aur_phase *phase, aur_error *error) {
    (void)parameters, (void)error;
    henyey_greenstein *const self = phase->data;
    self->g = aur_smaller(aur_larger(self->g, FLT_EPSILON - 1.0f), 1.0f - FLT_EPSILON);
    return AUR_OK;
}

/* (1 - g)^2 + 2 g (1 - c) equals 1 + g^2 - 2 g c without its cancellation for g and c near 1; likewise for
 * both near -1. */
static float evaluate(const aur_phase *phase, aur_vector position, float cosine) {
    (void)position;
    const float g = ((const henyey_greenstein *)phase->data)->g;
    const float size = fabsf(g), less = 1.0f - size;
    const float squared = less * less + 2.0f * size * (1.0f - (g < 0.0f ? -cosine : cosine));
    return less * (1.0f + size) / (4.0f * AUR_PI_F * squared * sqrtf(squared));
}

/* The inverse of the distribution for 1 - c, which stays accurate for g near 1: backward scattering is
 * forward scattering mirrored. */
static float draw(const aur_phase *phase, aur_vector position, float u) {
    (void)position;
    const float g = ((const henyey_greenstein *)phase->data)->g;
    const float size = fabsf(g), from = g < 0.0f ? 1.0f - u : u;
    const float quotient = (1.0f - size) / (1.0f - size + 2.0f * size * from);
    const float short_of_one = 2.0f * quotient * quotient * (1.0f - from) * (1.0f + size * from);
    const float cosine = aur_larger(1.0f - short_of_one, -1.0f);
    return g < 0.0f ? -cosine : cosine;
}

const aur_phase_descriptor aur_phase_hg = {
    .row = {.name = "hg",
            .summary = "from backward to forward scattering by one number",
            .source = "Henyey and Greenstein 1941",
            AUR_ROW_KEYS(keys)},
    .size = sizeof(henyey_greenstein),
    .create = create,
    .evaluate = evaluate,
    .draw = draw,
};
