/* Rough surfaces made of tiny mirrors: GGX (Walter 2007) and Beckmann distributions of their normals, Smith
 * shadowing, and drawing among the normals that are visible. Local frame, z up. */
#pragma once

#include "render/scene/materials/texture.h"

typedef struct aur_microfacet {
    enum { AUR_MICROFACET_BECKMANN, AUR_MICROFACET_GGX } distribution;
    float alpha_u, alpha_v;
    /* Beckmann's masking is the fit of Walter 2007, page 6, as in Mitsuba; facets are drawn as if it were
     * not. */
    bool fitted;
} aur_microfacet;

/* Facets over a surface: the same everywhere, or by textures. */
typedef struct aur_roughness {
    aur_microfacet constant; /* where nothing varies */
    aur_color alpha_u, alpha_v;
    bool varies;
    aur_color alpha; /* read, and of no use afterwards */
} aur_roughness;

#define AUR_LEAST_ALPHA 1e-4

/* Rows for tables of keys; the struct is zeroed and has an aur_roughness called microfacet. */
#define AUR_MICROFACET_KEYS(struct_)                                                                         \
    {AUR_KEY_OF_CHOICE(struct_, "distribution", microfacet.constant.distribution, "beckmann",                \
                       "distribution of facet normals", "beckmann", "ggx")},                                 \
        {AUR_KEY_OF_COLOR(struct_, "alpha", microfacet.alpha, 10.0, "0.1", "roughness"),                     \
         .minimum = AUR_LEAST_ALPHA},                                                                        \
        {AUR_KEY_OF_COLOR(struct_, "alpha_u", microfacet.alpha_u, 10.0, "alpha",                             \
                          "roughness along the first texture coordinate"),                                   \
         .minimum = AUR_LEAST_ALPHA, .computed = true},                                                      \
    {                                                                                                        \
        AUR_KEY_OF_COLOR(struct_, "alpha_v", microfacet.alpha_v, 10.0, "alpha",                              \
                         "roughness along the second"),                                                      \
            .minimum = AUR_LEAST_ALPHA, .computed = true                                                     \
    }

/* `alpha` stands for what was not given of alpha_u and alpha_v. Returns whether the two may differ. */
bool aur_roughness_complete(aur_roughness *roughness);

/* What such a lobe's `ggx_alpha` is. */
static inline float aur_roughness_ggx_alpha(const aur_roughness *roughness) {
    const aur_microfacet *const constant = &roughness->constant;
    const bool same = !roughness->varies && constant->alpha_u == constant->alpha_v;
    return same && constant->distribution == AUR_MICROFACET_GGX ? constant->alpha_u : 0.0f;
}

/* The facets at a point. */
static inline aur_microfacet aur_roughness_at(const aur_roughness *roughness, aur_bsdf_point point) {
    if (!roughness->varies)
        return roughness->constant;
    return (aur_microfacet){
        .distribution = roughness->constant.distribution,
        .alpha_u = fmaxf(aur_color_number_at(&roughness->alpha_u, point), (float)AUR_LEAST_ALPHA),
        .alpha_v = fmaxf(aur_color_number_at(&roughness->alpha_v, point), (float)AUR_LEAST_ALPHA)};
}

/* Density of normals: its integral against the cosine is 1. */
float aur_microfacet_density(const aur_microfacet *microfacet, aur_vector normal);
/* The visible share of normals facing `direction` (either side), 0 when `normal` shows its back. */
float aur_microfacet_masking(const aur_microfacet *microfacet, aur_vector direction, aur_vector normal);
/* The same, or its fit where the facets have one. */
float aur_microfacet_fitted_masking(const aur_microfacet *microfacet, aur_vector direction,
                                    aur_vector normal);
/* The density with which aur_microfacet_sample draws `normal`; view.z > 0. */
float aur_microfacet_pdf(const aur_microfacet *microfacet, aur_vector view, aur_vector normal);
aur_vector aur_microfacet_sample(const aur_microfacet *microfacet, aur_vector view, float u, float v);
/* The same for one u and many v: what of Beckmann facets depends on u alone, the slow part, is found once. */
void aur_microfacet_sample_row(const aur_microfacet *microfacet, aur_vector view, float u, size_t count,
                               const float *v, aur_vector *normals);

/* What facets that mirror all light scatter from `light` to `view`, times |light.z|; 0 unless both are above.
 * Their reflectance is left out: it is that at *cosine, of the angle between either direction and the facet.
 * *pdf is the density, a steradian, with which aur_microfacet_draw_mirrored draws `light`. */
float aur_microfacet_mirror(const aur_microfacet *microfacet, aur_vector view, aur_vector light,
                            float *cosine, float *pdf);
/* Where light comes from that a facet drawn by aur_microfacet_sample, its normal in *normal, mirrors to
 * `view`. */
aur_vector aur_microfacet_draw_mirrored(const aur_microfacet *microfacet, aur_vector view, float u, float v,
                                        aur_vector *normal);

/* A pair of directions as one facet of a boundary sees it, which mirrors or refracts light between them. */
typedef struct aur_facet {
    aur_vector normal; /* z > 0 */
    float view, light; /* cosines to the normal */
    float mirrored;    /* the share of light that is */
    float ratio;       /* index of the light's side over the view's; 1 when mirrored */
    float jacobian;    /* from normals to light directions */
} aur_facet;

/* False where no facet can be seen from both directions; `ior` is inside over outside. */
bool aur_facet_find(float ior, aur_vector view, aur_vector light, aur_facet *facet);
/* What facets scatter from `light` to `view` times |light.z|, were all light mirrored, or all refracted. */
float aur_facet_value(const aur_microfacet *microfacet, aur_vector view, aur_vector light,
                      const aur_facet *facet);
/* The density of `light` where normals are drawn by aur_microfacet_sample for aur_upright(view). */
float aur_facet_pdf(const aur_microfacet *microfacet, aur_vector view, const aur_facet *facet);
/* The directions that a facet takes light for `view` from. */
typedef struct aur_facet_ways {
    aur_vector mirrored, refracted; /* unit but for rounding */
    float reflectance;
} aur_facet_ways;
aur_facet_ways aur_facet_ways_of(float ior, aur_vector view, aur_vector normal);

/* The direction turned to the side above. */
static inline aur_vector aur_upright(aur_vector direction) {
    return direction.z > 0.0f ? direction : aur_vector_scale(direction, -1.0f);
}

/* What a rough coat of a dielectric mirrors and lets through, over all of its facets. */

enum { AUR_ROUGH_COAT_SIZE = 64 };

typedef struct aur_rough_coat {
    float transmittance[AUR_ROUGH_COAT_SIZE]; /* from outside, at cosines i / (AUR_ROUGH_COAT_SIZE - 1) */
    float outer_transmittance;                /* over diffuse light from outside */
    float inner_reflectance;                  /* over diffuse light from inside */
} aur_rough_coat;

/* The coat by sums that are as good as single precision; `ior` is inside over outside, above 1 or below. */
aur_rough_coat aur_rough_coat_of(const aur_microfacet *microfacet, float ior);

/* The coat that Mitsuba 3 has for such a material (roughplastic.cpp, microfacet.h there; version 3.9.1), to
 * about 1e-6: Gauss-Legendre rules over the draws of its own maps, which do not reach the integral where
 * total reflection cuts an edge into it, and the inner reflectance as a plain mean of the 64 cosines, both
 * ends in full. That is 1.5 % of it too little, and makes a base darker. */
aur_rough_coat aur_rough_coat_of_mitsuba(const aur_microfacet *microfacet, float ior);

/* The share of light that the coat lets through where it meets it at `cosine` from outside. */
float aur_rough_coat_transmittance(const aur_rough_coat *coat, float cosine);
