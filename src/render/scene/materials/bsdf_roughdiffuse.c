/* A rough diffuse surface of Lambertian facets (Oren and Nayar 1994, "Generalization of Lambert's reflectance
 * model", equations 27 to 29; `use_fast_approx`: equation 30). The standard deviation of facet angles is
 * alpha over the square root of 2, as in Mitsuba 0.6. */
#include "render/scene/materials/sampling.h"
#include "render/scene/materials/texture.h"

typedef struct roughdiffuse {
    aur_color reflectance, alpha;
    bool approximate;
} roughdiffuse;

static const aur_key keys[] = {
    {AUR_KEY_OF_COLOR(roughdiffuse, "reflectance", reflectance, 1.0, "0.5",
                      "share of the light that facets reflect")},
    {AUR_KEY_OF_COLOR(roughdiffuse, "alpha", alpha, 1.0, "0.2", "roughness")},
    {AUR_KEY_OF_BOOLEAN(roughdiffuse, "use_fast_approx", approximate, "false",
                        "leave out light that facets reflect to each other")},
};

static aur_result create(aur_parameters *parameters, aur_bsdf *bsdf, aur_error *error) {
    (void)parameters, (void)error;
    const aur_bsdf_lobe lobe = {.shape = AUR_LOBE_SHAPE_SAMPLED, .sides = AUR_SIDE_FRONT};
    aur_bsdf_add_lobe(bsdf, &lobe);
    return AUR_OK;
}

/* For a pair of directions: alpha is the larger angle from the normal, beta the smaller. */
typedef struct angles {
    float alpha, beta, sin_alpha, sin_beta, cos_alpha, cos_beta;
    float turn; /* the cosine of the difference of azimuths */
} angles;

static angles angles_of(aur_vector view, aur_vector light) {
    const bool first = view.z < light.z;
    const aur_vector low = first ? view : light, high = first ? light : view;
    angles at = {.cos_alpha = fminf(low.z, 1.0f), .cos_beta = fminf(high.z, 1.0f)};
    at.sin_alpha = sqrtf(1.0f - at.cos_alpha * at.cos_alpha);
    at.sin_beta = sqrtf(1.0f - at.cos_beta * at.cos_beta);
    at.alpha = acosf(at.cos_alpha);
    at.beta = acosf(at.cos_beta);
    const float both = at.sin_alpha * at.sin_beta;
    if (both > 1e-8f)
        at.turn = fmaxf(-1.0f, fminf((view.x * light.x + view.y * light.y) / both, 1.0f));
    return at;
}

/* pi times the BSDF for a reflectance. */
static float single_scattering(const roughdiffuse *self, const angles *at, float variance) {
    const float a = 1.0f - 0.5f * variance / (variance + 0.33f), b = 0.45f * variance / (variance + 0.09f);
    const float tan_beta = at->sin_beta / at->cos_beta;
    if (self->approximate)
        return a + b * fmaxf(at->turn, 0.0f) * at->sin_alpha * tan_beta;
    const float flat = 2.0f * at->beta / AUR_PI_F;
    const float product = 4.0f * at->alpha * at->beta / (AUR_PI_F * AUR_PI_F);
    const float c = 0.125f * variance / (variance + 0.09f) * product * product;
    const float rise = at->turn >= 0.0f ? at->sin_alpha : at->sin_alpha - flat * flat * flat;
    return a + b * rise * at->turn * tan_beta +
           c * (1.0f - fabsf(at->turn)) * tanf(0.5f * (at->alpha + at->beta));
}

/* BSDF times the cosine. */
static aur_vector value_of(const roughdiffuse *self, aur_bsdf_point point, aur_vector view,
                           aur_vector light) {
    const angles at = angles_of(view, light);
    const float alpha = aur_color_number_at(&self->alpha, point), variance = 0.5f * alpha * alpha;
    const aur_vector rho = aur_color_at(&self->reflectance, point);
    const float flat = 2.0f * at.beta / AUR_PI_F;
    const float once = single_scattering(self, &at, variance);
    const float twice =
        self->approximate ? 0.0f : 0.17f * variance / (variance + 0.13f) * (1.0f - at.turn * flat * flat);
    const aur_vector sum =
        aur_vector_add_scaled(aur_vector_scale(rho, once), twice, aur_vector_multiply(rho, rho));
    return aur_vector_scale(sum, light.z / AUR_PI_F);
}

static aur_vector evaluate(const aur_bsdf *bsdf, aur_bsdf_part part, aur_bsdf_point point, aur_vector view,
                           aur_vector light, float *pdf) {
    (void)part;
    *pdf = view.z > 0.0f && light.z > 0.0f ? light.z / AUR_PI_F : 0.0f;
    return *pdf > 0.0f ? value_of(bsdf->data, point, view, light) : (aur_vector){0};
}

static bool sample(const aur_bsdf *bsdf, aur_bsdf_part part, aur_bsdf_point point, aur_vector view,
                   const float u[3], aur_bsdf_sample *drawn) {
    (void)part;
    const aur_vector light = aur_sample_cosine(u[1], u[2]);
    if (!(view.z > 0.0f) || !(light.z > 0.0f))
        return false;
    const float pdf = light.z / AUR_PI_F;
    *drawn =
        (aur_bsdf_sample){.light = light,
                          .weight = aur_vector_scale(value_of(bsdf->data, point, view, light), 1.0f / pdf),
                          .pdf = pdf};
    return true;
}

static void weigh(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view, aur_bsdf_lobe *lobes) {
    const roughdiffuse *const self = bsdf->data;
    lobes[0].axis = (aur_vector){0.0f, 0.0f, 1.0f};
    if (view.z > 0.0f)
        lobes[0].coefficient = aur_vector_scale(aur_color_at(&self->reflectance, point), 1.0f / AUR_PI_F);
}

const aur_bsdf_descriptor aur_bsdf_roughdiffuse = {
    .row = {.name = "roughdiffuse",
            .summary = "a diffuse surface of facets, such as clay or plaster",
            .source = "Oren and Nayar 1994",
            AUR_ROW_KEYS(keys)},
    .size = sizeof(roughdiffuse),
    .create = create,
    .weigh = weigh,
    .evaluate = evaluate,
    .sample = sample,
};
