/* Metals: a smooth mirror, and a microfacet surface. */
#include "render/scene/materials/fresnel.h"
#include "render/scene/materials/microfacet.h"
#include "render/scene/materials/sampling.h"
#include "render/scene/materials/texture.h"

typedef struct conductor {
    aur_color reflectance;
    aur_metal metal;
    aur_roughness microfacet;
} conductor;

#define CONDUCTOR_KEYS                                                                                       \
    AUR_METAL_KEYS(conductor), {                                                                             \
        AUR_KEY_OF_COLOR(conductor, "specular_reflectance", reflectance, 1.0, "1",                           \
                         "factor of the reflected light")                                                    \
    }

static const aur_key smooth_keys[] = {CONDUCTOR_KEYS};
static const aur_key rough_keys[] = {CONDUCTOR_KEYS, AUR_MICROFACET_KEYS(conductor)};

static aur_result create_rough(aur_parameters *parameters, aur_bsdf *bsdf, aur_error *error) {
    conductor *const self = bsdf->data;
    bsdf->anisotropic = aur_roughness_complete(&self->microfacet);
    const aur_bsdf_lobe lobe = {.shape = AUR_LOBE_SHAPE_SAMPLED,
                                .sides = AUR_SIDE_FRONT,
                                .ggx_alpha = aur_roughness_ggx_alpha(&self->microfacet)};
    aur_bsdf_add_lobe(bsdf, &lobe);
    return aur_metal_complete(parameters, &self->metal, error);
}

static aur_vector reflectance(const conductor *self, aur_bsdf_point point, float cosine) {
    const aur_vector color = aur_color_at(&self->reflectance, point);
    return self->metal.perfect
               ? color
               : aur_vector_multiply(color, aur_fresnel_conductor(cosine, self->metal.eta, self->metal.k));
}

/* --- smooth */

static aur_result create_smooth(aur_parameters *parameters, aur_bsdf *bsdf, aur_error *error) {
    const aur_bsdf_lobe lobe = {
        .shape = AUR_LOBE_SHAPE_SPECULAR, .way = AUR_LOBE_WAY_MIRROR, .sides = AUR_SIDE_FRONT};
    aur_bsdf_add_lobe(bsdf, &lobe);
    conductor *const self = bsdf->data;
    return aur_metal_complete(parameters, &self->metal, error);
}

static void weigh_smooth(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view, aur_bsdf_lobe *lobes) {
    if (view.z <= 0.0f)
        return;
    lobes[0].axis = aur_mirror(view);
    lobes[0].coefficient = reflectance(bsdf->data, point, view.z);
}

const aur_bsdf_descriptor aur_bsdf_conductor = {
    .row = {.name = "conductor",
            .summary = "a smooth metal mirror",
            .source = "Fresnel 1823",
            AUR_ROW_KEYS(smooth_keys)},
    .size = sizeof(conductor),
    .create = create_smooth,
    .weigh = weigh_smooth,
};

/* --- rough */

static aur_vector evaluate_rough(const aur_bsdf *bsdf, aur_bsdf_part part, aur_bsdf_point point,
                                 aur_vector view, aur_vector light, float *pdf) {
    (void)part;
    const conductor *const self = bsdf->data;
    float cosine;
    const aur_microfacet facets = aur_roughness_at(&self->microfacet, point);
    const float value = aur_microfacet_mirror(&facets, view, light, &cosine, pdf);
    return value > 0.0f ? aur_vector_scale(reflectance(self, point, cosine), value) : (aur_vector){0};
}

static bool sample_rough(const aur_bsdf *bsdf, aur_bsdf_part part, aur_bsdf_point point, aur_vector view,
                         const float u[3], aur_bsdf_sample *drawn) {
    (void)part;
    const conductor *const self = bsdf->data;
    if (view.z <= 0.0f)
        return false;
    const aur_microfacet facets = aur_roughness_at(&self->microfacet, point);
    aur_vector normal;
    const aur_vector light = aur_microfacet_draw_mirrored(&facets, view, u[1], u[2], &normal);
    const float cosine = aur_vector_dot(view, normal);
    if (!(cosine > 0.0f) || !(light.z > 0.0f))
        return false;
    *drawn = (aur_bsdf_sample){.light = light,
                               .weight = aur_vector_scale(reflectance(self, point, cosine),
                                                          aur_microfacet_masking(&facets, light, normal) *
                                                              aur_microfacet_weight(&facets, view, normal)),
                               .pdf = aur_microfacet_pdf(&facets, view, normal) / (4.0f * cosine)};
    return drawn->pdf > 0.0f;
}

static void weigh_rough(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view, aur_bsdf_lobe *lobes) {
    (void)bsdf;
    (void)point;
    if (view.z <= 0.0f)
        return;
    lobes[0].axis = aur_mirror(view);
    lobes[0].coefficient = (aur_vector){1.0f, 1.0f, 1.0f};
}

const aur_bsdf_descriptor aur_bsdf_roughconductor = {
    .row = {.name = "roughconductor",
            .summary = "a rough metal: Beckmann, GGX or Phong facets",
            .source = "Walter et al. 2007",
            AUR_ROW_KEYS(rough_keys)},
    .size = sizeof(conductor),
    .create = create_rough,
    .weigh = weigh_rough,
    .evaluate = evaluate_rough,
    .sample = sample_rough,
};
