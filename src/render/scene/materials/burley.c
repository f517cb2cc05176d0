#include "render/scene/materials/burley.h"

#include "render/scene/materials/fresnel.h"
#include "render/scene/materials/sampling.h"

static const aur_vector white = {1.0f, 1.0f, 1.0f};

static aur_vector mix(aur_vector a, aur_vector b, float share) {
    return aur_vector_add_scaled(aur_vector_scale(a, 1.0f - share), share, b);
}

aur_burley_point aur_burley_at(const aur_burley *burley, aur_bsdf_point point) {
    aur_burley_point at = {.base = aur_color_at(&burley->base_color, point),
                           .roughness = aur_color_number_at(&burley->roughness, point),
                           .anisotropic = aur_color_number_at(&burley->anisotropic, point),
                           .spec_trans = aur_color_number_at(&burley->spec_trans, point),
                           .spec_tint = aur_color_number_at(&burley->spec_tint, point),
                           .flatness = aur_color_number_at(&burley->flatness, point)};
    const float luminance = aur_luminance(at.base);
    at.tint = luminance > 0.0f ? aur_vector_scale(at.base, 1.0f / luminance) : white;
    at.sheen = aur_vector_scale(mix(white, at.tint, aur_color_number_at(&burley->sheen_tint, point)),
                                aur_color_number_at(&burley->sheen, point));
    return at;
}

aur_microfacet aur_burley_facets(const aur_burley_point *at, float roughness) {
    const float alpha = roughness * roughness, aspect = sqrtf(1.0f - 0.9f * at->anisotropic);
    return (aur_microfacet){.distribution = AUR_MICROFACET_GGX,
                            .alpha_u = fmaxf(alpha / aspect, 1e-3f),
                            .alpha_v = fmaxf(alpha * aspect, 1e-3f)};
}

bool aur_burley_is_anisotropic(const aur_burley *burley) {
    return burley->anisotropic.texture != NULL || burley->anisotropic.constant.x > 0.0f;
}

float aur_schlick_weight(float cosine) {
    const float rest = fminf(fmaxf(1.0f - cosine, 0.0f), 1.0f), squared = rest * rest;
    return squared * squared * rest;
}

aur_vector aur_schlick(aur_vector normal, float cosine, float ior) {
    if (ior < 1.0f) {
        aur_fresnel_dielectric(cosine, ior, &cosine);
        cosine = -cosine;
    }
    return mix(normal, white, aur_schlick_weight(cosine));
}

float aur_burley_edge(const void *data, float cosine) {
    (void)data;
    return 1.0f - 0.5f * aur_schlick_weight(cosine);
}

aur_bsdf_lobe aur_burley_lobe(unsigned sides) {
    aur_bsdf_lobe lobe = aur_diffuse_lobe();
    lobe.sides = sides;
    lobe.factor = aur_burley_edge;
    return lobe;
}

aur_vector aur_burley_rest(const aur_burley_point *at, float weight, float sheen, aur_vector view,
                           aur_vector light) {
    const aur_vector half = aur_vector_normalize(aur_vector_add(view, light));
    const float cosine = aur_vector_dot(half, light);
    const float by_view = aur_schlick_weight(view.z), by_light = aur_schlick_weight(light.z);
    const float back = 2.0f * at->roughness * cosine * cosine;
    const float thrown_back = back * (by_view + by_light + by_view * by_light * (back - 1.0f));
    /* Hanrahan and Krueger 1993, as Burley has it. */
    const float edge = 0.5f * back;
    const float both = (1.0f + (edge - 1.0f) * by_view) * (1.0f + (edge - 1.0f) * by_light);
    const float flat = 1.25f * (both * (1.0f / (view.z + light.z) - 0.5f) + 0.5f);
    const float base = ((1.0f - at->flatness) * thrown_back + at->flatness * flat) / AUR_PI_F;
    const aur_vector sum = aur_vector_add_scaled(aur_vector_scale(at->base, weight * base),
                                                 sheen * aur_schlick_weight(cosine), at->sheen);
    return aur_vector_scale(sum, light.z);
}

float aur_burley_rest_probability(const aur_burley_point *at, float weight, float sheen, float view_cosine) {
    const float edge = 0.1f + aur_schlick_weight(view_cosine);
    return weight * aur_luminance(at->base) *
               (at->flatness + (1.0f - at->flatness) * 2.0f * at->roughness * edge) +
           sheen * aur_luminance(at->sheen) * edge;
}
