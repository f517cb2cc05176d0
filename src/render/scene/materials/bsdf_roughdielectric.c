/* A rough boundary such as ground glass (Walter, Marschner, Li, Torrance 2007). */
#include "render/scene/materials/fresnel.h"
#include "render/scene/materials/microfacet.h"
#include "render/scene/materials/texture.h"

typedef struct rough {
    aur_color reflectance, transmittance;
    float ior;
    aur_roughness microfacet;
} rough;

static const aur_key keys[] = {
    AUR_IOR_KEYS("bk7"),
    {AUR_KEY_OF_COLOR(rough, "specular_reflectance", reflectance, 1.0, "1", "factor of the reflected light")},
    {AUR_KEY_OF_COLOR(rough, "specular_transmittance", transmittance, 1.0, "1",
                      "factor of the transmitted light")},
    AUR_MICROFACET_KEYS(rough),
};

static aur_result create(aur_parameters *parameters, aur_bsdf *bsdf, aur_error *error) {
    rough *const self = bsdf->data;
    const aur_bsdf_lobe lobe = {.shape = AUR_LOBE_SHAPE_SAMPLED, .transmits = true, .sides = AUR_SIDES_BOTH};
    aur_bsdf_add_lobe(bsdf, &lobe);
    bsdf->anisotropic = aur_roughness_complete(&self->microfacet);
    const aur_result result = aur_parameters_ior(parameters, "bk7", &self->ior, error);
    if (result == AUR_OK && fabsf(self->ior - 1.0f) < 1e-4f)
        return aur_fail_at(error, parameters->location, AUR_ERROR_FORMAT,
                           "bsdf 'roughdielectric': 'int_ior' and 'ext_ior' must differ");
    return result;
}

static float pdf_of(const aur_microfacet *facets, aur_vector view, const aur_facet *at) {
    const float share = at->ratio == 1.0f ? at->mirrored : 1.0f - at->mirrored;
    return aur_facet_pdf(facets, view, at) * share;
}

static aur_vector value_of(const rough *self, const aur_microfacet *facets, aur_bsdf_point point,
                           aur_vector view, aur_vector light, const aur_facet *at) {
    const float common = aur_facet_value(facets, view, light, at);
    if (at->ratio == 1.0f)
        return aur_vector_scale(aur_color_at(&self->reflectance, point), common * at->mirrored);
    /* radiance is smaller on the side of the smaller index */
    return aur_vector_scale(aur_color_at(&self->transmittance, point),
                            common * (1.0f - at->mirrored) / (at->ratio * at->ratio));
}

static aur_vector evaluate(const aur_bsdf *bsdf, aur_bsdf_part part, aur_bsdf_point point, aur_vector view,
                           aur_vector light, float *pdf) {
    (void)part;
    const rough *const self = bsdf->data;
    aur_facet at;
    *pdf = 0.0f;
    if (!aur_facet_find(self->ior, view, light, &at))
        return (aur_vector){0};
    const aur_microfacet facets = aur_roughness_at(&self->microfacet, point);
    *pdf = pdf_of(&facets, view, &at);
    return value_of(self, &facets, point, view, light, &at);
}

static bool sample(const aur_bsdf *bsdf, aur_bsdf_part part, aur_bsdf_point point, aur_vector view,
                   const float u[3], aur_bsdf_sample *drawn) {
    (void)part;
    const rough *const self = bsdf->data;
    if (view.z == 0.0f)
        return false;
    const aur_microfacet facets = aur_roughness_at(&self->microfacet, point);
    const aur_vector normal = aur_microfacet_sample(&facets, aur_upright(view), u[1], u[2]);
    const aur_facet_ways ways = aur_facet_ways_of(self->ior, view, normal);
    const bool mirrored = u[0] < ways.reflectance;
    aur_facet at;
    const aur_vector light = aur_vector_normalize(mirrored ? ways.mirrored : ways.refracted);
    if ((light.z * view.z > 0.0f) != mirrored || !aur_facet_find(self->ior, view, light, &at))
        return false;
    const float density = pdf_of(&facets, view, &at);
    if (!(density > 0.0f))
        return false;
    *drawn = (aur_bsdf_sample){
        .light = light,
        .weight = aur_vector_scale(value_of(self, &facets, point, view, light, &at), 1.0f / density),
        .pdf = density,
        .ior_squared = at.ratio == 1.0f ? 0.0f : at.ratio * at.ratio};
    return true;
}

static void weigh(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view, aur_bsdf_lobe *lobes) {
    (void)bsdf;
    (void)point;
    lobes[0].axis = aur_mirror(view);
    lobes[0].coefficient = (aur_vector){1.0f, 1.0f, 1.0f};
}

const aur_bsdf_descriptor aur_bsdf_roughdielectric = {
    .row = {.name = "roughdielectric",
            .summary = "a rough boundary such as ground glass",
            .source = "Walter et al. 2007",
            AUR_ROW_KEYS(keys)},
    .size = sizeof(rough),
    .create = create,
    .weigh = weigh,
    .evaluate = evaluate,
    .sample = sample,
};
