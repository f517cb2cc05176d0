/* An ideally diffuse transmitting sheet: light incident on one side leaves uniformly on the other. */
#include "render/scene/materials/sampling.h"
#include "render/scene/materials/texture.h"

typedef struct difftrans {
    aur_color transmittance;
} difftrans;

static const aur_key keys[] = {
    {AUR_KEY_OF_COLOR(difftrans, "transmittance", transmittance, 1.0, "0.5", "of the sheet")},
};

static aur_result create(aur_parameters *parameters, aur_bsdf *bsdf, aur_error *error) {
    (void)parameters, (void)error;
    const aur_bsdf_lobe lobe = {.shape = AUR_LOBE_SHAPE_SAMPLED, .transmits = true, .sides = AUR_SIDES_BOTH};
    aur_bsdf_add_lobe(bsdf, &lobe);
    return AUR_OK;
}

static aur_vector evaluate(const aur_bsdf *bsdf, aur_bsdf_part part, aur_bsdf_point point, aur_vector view,
                           aur_vector light, float *pdf) {
    (void)part;
    const difftrans *const self = bsdf->data;
    *pdf = 0.0f;
    if (!(view.z * light.z < 0.0f))
        return (aur_vector){0};
    *pdf = fabsf(light.z) / AUR_PI_F;
    return aur_vector_scale(aur_color_at(&self->transmittance, point), *pdf);
}

static bool sample(const aur_bsdf *bsdf, aur_bsdf_part part, aur_bsdf_point point, aur_vector view,
                   const float u[3], aur_bsdf_sample *drawn) {
    (void)part;
    const difftrans *const self = bsdf->data;
    aur_vector light = aur_sample_cosine(u[1], u[2]);
    if (view.z == 0.0f || !(light.z > 0.0f))
        return false;
    if (view.z > 0.0f)
        light.z = -light.z;
    *drawn = (aur_bsdf_sample){.light = light,
                               .weight = aur_color_at(&self->transmittance, point),
                               .pdf = fabsf(light.z) / AUR_PI_F};
    return true;
}

static void weigh(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view, aur_bsdf_lobe *lobes) {
    const difftrans *const self = bsdf->data;
    lobes[0].axis = (aur_vector){0.0f, 0.0f, view.z < 0.0f ? 1.0f : -1.0f};
    lobes[0].coefficient = aur_vector_scale(aur_color_at(&self->transmittance, point), 1.0f / AUR_PI_F);
}

const aur_bsdf_descriptor aur_bsdf_difftrans = {
    .row = {.name = "difftrans",
            .summary = "a sheet that transmits light diffusely",
            .source = "Jakob 2010 (Mitsuba)",
            AUR_ROW_KEYS(keys)},
    .size = sizeof(difftrans),
    .create = create,
    .weigh = weigh,
    .evaluate = evaluate,
    .sample = sample,
};
