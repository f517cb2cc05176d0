/* The two materials named after Phong: a diffuse lobe and one of cos^m about the mirror direction u_r, with
 * the reflectances k_d and k_s.
 *
 * phong: BSDF = k_d / pi + (m + 2) / (2 pi) k_s (u . u_r)^m, Mitsuba 0.6's modified model (Lafortune and
 * Willems 1994), reciprocal. phong_lobe: BSDF * cos = k_d / pi (u . n) + k_s (m + 1) / (2 pi) (u . u_r)^m, so
 * that k_s is the reflectance of the whole lobe (Marques 2013, section 5). Not reciprocal. */
#include "render/scene/materials/sampling.h"
#include "render/scene/materials/texture.h"

typedef struct phong {
    aur_color diffuse, specular;
    float exponent;
    float scale; /* of k_s (u . u_r)^m */
} phong;

static const aur_key keys[] = {
    {AUR_KEY_OF_COLOR(phong, "diffuse_reflectance", diffuse, 1.0, "0.5", "of the diffuse part")},
    {AUR_KEY_OF_COLOR(phong, "specular_reflectance", specular, 1.0, "0.2",
                      "of the lobe; the two add to at most 1")},
    {AUR_KEY_OF_REAL(phong, "exponent", exponent, 0.0, 1e6, "30", "m: the higher, the narrower the lobe")},
};

static bool may_reflect(const aur_color *color) {
    return color->texture != NULL || aur_vector_max(color->constant) > 0.0f;
}

static aur_result create_with(aur_parameters *parameters, aur_bsdf *bsdf, bool times_cosine,
                              aur_error *error) {
    phong *const self = bsdf->data;
    self->scale = (self->exponent + (times_cosine ? 2.0f : 1.0f)) / (2.0f * AUR_PI_F);
    const aur_bsdf_lobe diffuse = aur_diffuse_lobe();
    const aur_bsdf_lobe specular = {.shape = AUR_LOBE_SHAPE_COSINE_POWER,
                                    .times_cosine = times_cosine,
                                    .sides = AUR_SIDE_FRONT,
                                    .exponent = self->exponent};
    if (may_reflect(&self->diffuse))
        aur_bsdf_add_lobe(bsdf, &diffuse);
    if (may_reflect(&self->specular))
        aur_bsdf_add_lobe(bsdf, &specular);
    const float most = aur_vector_max(aur_vector_add(self->diffuse.constant, self->specular.constant));
    if (self->diffuse.texture == NULL && self->specular.texture == NULL && most > 1.0f + 1e-5f)
        return aur_fail_at(
            error, parameters->location, AUR_ERROR_FORMAT,
            "bsdf '%s': diffuse_reflectance + specular_reflectance must not exceed 1, but adds to %g",
            parameters->plugin, (double)most);
    return AUR_OK;
}

static aur_result create(aur_parameters *parameters, aur_bsdf *bsdf, aur_error *error) {
    return create_with(parameters, bsdf, true, error);
}

static aur_result create_lobe(aur_parameters *parameters, aur_bsdf *bsdf, aur_error *error) {
    return create_with(parameters, bsdf, false, error);
}

static void weigh(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view, aur_bsdf_lobe *lobes) {
    const phong *const self = bsdf->data;
    if (view.z <= 0.0f)
        return;
    for (size_t i = 0; i < bsdf->lobe_count; ++i) {
        if (lobes[i].diffuse) {
            lobes[i].coefficient = aur_vector_scale(aur_color_at(&self->diffuse, point), 1.0f / AUR_PI_F);
            continue;
        }
        lobes[i].axis = aur_mirror(view);
        lobes[i].coefficient = aur_vector_scale(aur_color_at(&self->specular, point), self->scale);
    }
}

const aur_bsdf_descriptor aur_bsdf_phong = {
    .row = {.name = "phong",
            .summary = "modified Phong model: (m+2)/(2 pi) cos^m times the cosine",
            .source = "Lafortune Willems 1994",
            AUR_ROW_KEYS(keys)},
    .size = sizeof(phong),
    .create = create,
    .weigh = weigh,
};

const aur_bsdf_descriptor aur_bsdf_phong_lobe = {
    .row = {.name = "phong_lobe",
            .summary = "diffuse part and a pure cos^m lobe about the mirror direction; not reciprocal",
            .source = "Marques 2013",
            AUR_ROW_KEYS(keys)},
    .size = sizeof(phong),
    .create = create_lobe,
    .weigh = weigh,
};
