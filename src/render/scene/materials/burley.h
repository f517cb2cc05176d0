/* Terms that the two principled materials share (Burley 2012, Burley 2015), as Mitsuba 3 puts them together:
 * a diffuse base that darkens at its edge, light thrown back at grazing angles, sheen, facets. */
#pragma once

#include "render/scene/materials/microfacet.h"
#include "render/scene/materials/texture.h"

/* What both materials are told. */
typedef struct aur_burley {
    aur_color base_color, roughness, anisotropic, spec_trans, spec_tint, sheen, sheen_tint, flatness;
} aur_burley;

/* A number of a material between 0 and 1, or a texture of them. */
#define AUR_KEY_OF_SHARE(struct_, name_, field_, default_, help_)                                            \
    { AUR_KEY_OF_COLOR(struct_, name_, field_, 1.0, default_, help_) }

/* Rows for tables of keys; the struct has an aur_burley called burley. */
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

/* What they are at a point. */
typedef struct aur_burley_point {
    aur_vector base, tint, sheen; /* tint: the base's colour at luminance 1; sheen: weight times colour */
    float roughness, spec_trans, spec_tint, flatness;
    float anisotropic;
} aur_burley_point;

aur_burley_point aur_burley_at(const aur_burley *burley, aur_bsdf_point point);
/* Whether it is that number everywhere. */
static inline bool aur_burley_is_always(const aur_color *color, float number) {
    return color->texture == NULL && color->constant.x == number;
}
/* GGX facets for a roughness. */
aur_microfacet aur_burley_facets(const aur_burley_point *at, float roughness);
/* Whether highlights may be longer than wide anywhere. */
bool aur_burley_is_anisotropic(const aur_burley *burley);

/* (1 - cosine)^5 */
float aur_schlick_weight(float cosine);
/* Schlick's reflectance: `normal` straight on, 1 at grazing angles; of the refracted angle where ior < 1. */
aur_vector aur_schlick(aur_vector normal, float cosine, float ior);

/* The base is a Lambert lobe but for the edge, where it is half as bright: this times the same for the view.
 * A lobe's factor; `data` is of no use. */
float aur_burley_edge(const void *data, float cosine);
/* Integral of the edge's factor times cosine / pi over a hemisphere: 41/42. */
#define AUR_BURLEY_EDGE_MEAN (41.0f / 42.0f)
/* The lobe, with that factor; its coefficient is base_color / pi times the edge's factor for the view times
 * 1 - flatness, times what the material itself has. */
aur_bsdf_lobe aur_burley_lobe(unsigned sides);

/* What else the base scatters from `light` to `view` times light.z, both above: light thrown back, the flat
 * part of diffuse light, and sheen. For `weight` of base and `sheen` of sheen. */
aur_vector aur_burley_rest(const aur_burley_point *at, float weight, float sheen, aur_vector view,
                           aur_vector light);
/* About its share of light from everywhere, for drawing it in proportion. */
float aur_burley_rest_probability(const aur_burley_point *at, float weight, float sheen, float view_cosine);
