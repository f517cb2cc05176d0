/* Terms shared by the two principled materials (Burley 2012, Burley 2015), as combined in Mitsuba 3: a
 * diffuse base darker at grazing angles, retroreflection, sheen, facets. */
#pragma once

#include "render/scene/materials/microfacet.h"
#include "render/scene/materials/texture.h"

/* Parameters of both materials. */
typedef struct aur_burley {
    aur_color base_color, roughness, anisotropic, spec_trans, spec_tint, sheen, sheen_tint, flatness;
} aur_burley;

/* A material parameter in [0, 1], constant or textured. */
#define AUR_KEY_OF_SHARE(struct_, name_, field_, default_, help_)                                            \
    { AUR_KEY_OF_COLOR(struct_, name_, field_, 1.0, default_, help_) }

/* Rows for tables of parameters; the struct has a member `aur_burley burley`. */
#define AUR_BURLEY_KEYS(struct_)                                                                             \
    AUR_KEY_OF_SHARE(struct_, "base_color", burley.base_color, "0.5", "of the material"),                    \
        AUR_KEY_OF_SHARE(struct_, "roughness", burley.roughness, "0.5",                                      \
                         "roughness: the GGX alpha is its square"),                                          \
        AUR_KEY_OF_SHARE(struct_, "anisotropic", burley.anisotropic, "0",                                    \
                         "anisotropy of highlights: 1 stretches them 10 to 1"),                              \
        AUR_KEY_OF_SHARE(struct_, "spec_trans", burley.spec_trans, "0",                                      \
                         "share of glass in the non-metallic part"),                                         \
        AUR_KEY_OF_SHARE(struct_, "spec_tint", burley.spec_tint, "0",                                        \
                         "tint of non-metallic highlights by the base colour"),                              \
        AUR_KEY_OF_SHARE(struct_, "sheen", burley.sheen, "0", "sheen at grazing angles, as of cloth"),       \
        AUR_KEY_OF_SHARE(struct_, "sheen_tint", burley.sheen_tint, "0",                                      \
                         "how much of the base's colour that has"),                                          \
        AUR_KEY_OF_SHARE(struct_, "flatness", burley.flatness, "0",                                          \
                         "share of subsurface-like reflection in diffuse light")

/* Parameter values at a point. */
typedef struct aur_burley_point {
    aur_vector base, tint, sheen; /* tint: the base's colour at luminance 1; sheen: weight times colour */
    float roughness, spec_trans, spec_tint, flatness;
    float anisotropic;
} aur_burley_point;

aur_burley_point aur_burley_at(const aur_burley *burley, aur_bsdf_point point);
/* Whether the parameter is that number everywhere. */
static inline bool aur_burley_is_always(const aur_color *color, float number) {
    return color->texture == NULL && color->constant.x == number;
}
/* GGX facets for a roughness. */
aur_microfacet aur_burley_facets(const aur_burley_point *at, float roughness);
/* Whether highlights may be anisotropic anywhere. */
bool aur_burley_is_anisotropic(const aur_burley *burley);

/* (1 - cosine)^5 */
float aur_schlick_weight(float cosine);
/* Schlick's reflectance: `normal` at normal incidence, 1 at grazing angles; uses the refracted angle for ior
 * < 1. */
aur_vector aur_schlick(aur_vector normal, float cosine, float ior);

/* The base is Lambertian times edge factors for light and view, each 1/2 at grazing angles. This is the
 * factor of a lobe; `data` is unused. */
float aur_burley_edge(const void *data, float cosine);
/* Integral of the edge's factor times cosine / pi over a hemisphere: 41/42. */
#define AUR_BURLEY_EDGE_MEAN (41.0f / 42.0f)
/* The lobe with that factor. Its coefficient is base_color / pi times the edge factor for the view times 1 -
 * flatness, times the material's own factors. */
aur_bsdf_lobe aur_burley_lobe(unsigned sides);

/* The rest of the base's scattering from `light` to `view` times light.z, both above: retroreflection, the
 * flat part of diffuse light, and sheen. `weight` is that of the base, `sheen` that of sheen. */
aur_vector aur_burley_rest(const aur_burley_point *at, float weight, float sheen, aur_vector view,
                           aur_vector light);
/* Its approximate albedo, used as sampling weight. */
float aur_burley_rest_probability(const aur_burley_point *at, float weight, float sheen, float view_cosine);
