/* Microfacet surfaces: GGX, Beckmann and Phong distributions (Walter 2007; Ashikhmin and Shirley 2000), Smith
 * masking and shadowing, and sampling of visible normals. Local frame, z up. */
#pragma once

#include "render/scene/materials/texture.h"

typedef struct aur_microfacet {
    /* Phong facets have the exponent 2 / alpha^2 - 2 and Beckmann's masking (Walter 2007, section 5.2). Their
     * normals are sampled as visible GGX normals. The last is Phong's other name, in Mitsuba 0.5. */
    enum {
        AUR_MICROFACET_BECKMANN,
        AUR_MICROFACET_GGX,
        AUR_MICROFACET_PHONG,
        AUR_MICROFACET_AS
    } distribution;
    float alpha_u, alpha_v;
    /* Beckmann masking uses the fit of Walter 2007, page 6, as in Mitsuba; normals are sampled with the exact
     * masking. */
    bool fitted;
} aur_microfacet;

/* Microfacet parameters over a surface: constant or textured. */
typedef struct aur_roughness {
    aur_microfacet constant; /* if nothing varies */
    aur_color alpha_u, alpha_v;
    bool varies;
    aur_color alpha; /* read, not used afterwards */
} aur_roughness;

#define AUR_LEAST_ALPHA 1e-4

/* Rows for tables of parameters; the struct is zeroed and has a member `aur_roughness microfacet`. */
#define AUR_MICROFACET_KEYS(struct_)                                                                         \
    {AUR_KEY_OF_CHOICE(struct_, "distribution", microfacet.constant.distribution, "beckmann",                \
                       "distribution of facet normals", "beckmann", "ggx", "phong", "as")},                  \
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

/* `alpha` is the default of alpha_u and alpha_v. Returns whether the two may differ. */
bool aur_roughness_complete(aur_roughness *roughness);

/* Value of `ggx_alpha` for such a lobe. */
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
/* The masking of facets with `normal` in a `direction` of either side; 0 for back-facing facets. */
float aur_microfacet_masking(const aur_microfacet *microfacet, aur_vector direction, aur_vector normal);
/* The same, or its fit for distributions that use one. */
float aur_microfacet_fitted_masking(const aur_microfacet *microfacet, aur_vector direction,
                                    aur_vector normal);
/* The density of visible normals over the pdf below: 1 for all but Phong facets. */
float aur_microfacet_weight(const aur_microfacet *microfacet, aur_vector view, aur_vector normal);
/* The pdf with which aur_microfacet_sample draws `normal`; view.z > 0. */
float aur_microfacet_pdf(const aur_microfacet *microfacet, aur_vector view, aur_vector normal);
aur_vector aur_microfacet_sample(const aur_microfacet *microfacet, aur_vector view, float u, float v);
/* The same for one u and many v: the slow part, which for Beckmann facets depends only on u, is computed
 * once. */
void aur_microfacet_sample_row(const aur_microfacet *microfacet, aur_vector view, float u, size_t count,
                               const float *v, aur_vector *normals);

/* Scattering of perfectly reflecting facets from `light` to `view`, times |light.z|; 0 unless both are above.
 * The caller multiplies by the reflectance at *cosine, of the angle between either direction and the facet.
 * *pdf is the pdf by solid angle with which aur_microfacet_draw_mirrored samples `light`. */
float aur_microfacet_mirror(const aur_microfacet *microfacet, aur_vector view, aur_vector light,
                            float *cosine, float *pdf);
/* The incident direction reflected to `view` by a facet sampled by aur_microfacet_sample; its normal is
 * *normal. */
aur_vector aur_microfacet_draw_mirrored(const aur_microfacet *microfacet, aur_vector view, float u, float v,
                                        aur_vector *normal);

/* A pair of directions and the facet that reflects or refracts light between them. */
typedef struct aur_facet {
    aur_vector normal; /* z > 0 */
    float view, light; /* cosines to the normal */
    float mirrored;    /* the fraction of light reflected or refracted */
    float ratio;       /* index on the light's side over the view's; 1 for reflection */
    float jacobian;    /* Jacobian from normals to light directions */
} aur_facet;

/* False if no facet is visible from both directions; `ior` is inside over outside. */
bool aur_facet_find(float ior, aur_vector view, aur_vector light, aur_facet *facet);
/* Scattering of facets from `light` to `view` times |light.z|, if all light were reflected, or all refracted.
 */
float aur_facet_value(const aur_microfacet *microfacet, aur_vector view, aur_vector light,
                      const aur_facet *facet);
/* The pdf of `light` with normals sampled by aur_microfacet_sample for aur_upright(view). */
float aur_facet_pdf(const aur_microfacet *microfacet, aur_vector view, const aur_facet *facet);
/* The incident directions that a facet reflects or refracts to `view`. */
typedef struct aur_facet_ways {
    aur_vector mirrored, refracted; /* unit up to rounding */
    float reflectance;
} aur_facet_ways;
aur_facet_ways aur_facet_ways_of(float ior, aur_vector view, aur_vector normal);

/* The direction mirrored to the upper side. */
static inline aur_vector aur_upright(aur_vector direction) {
    return direction.z > 0.0f ? direction : aur_vector_scale(direction, -1.0f);
}

/* Reflection and transmission of a rough dielectric coat, integrated over its facets. */

enum { AUR_ROUGH_COAT_SIZE = 64 };

typedef struct aur_rough_coat {
    float transmittance[AUR_ROUGH_COAT_SIZE]; /* transmittance from outside, at cosines i /
                                                 (AUR_ROUGH_COAT_SIZE - 1) */
    float outer_transmittance;                /* reflectance for diffuse light from outside */
    float inner_reflectance;                  /* reflectance for diffuse light from inside */
} aur_rough_coat;

/* Computes the coat to single precision; `ior` is inside over outside, above or below 1. */
aur_rough_coat aur_rough_coat_of(const aur_microfacet *microfacet, float ior);

/* The coat as Mitsuba 3 computes it (roughplastic.cpp, microfacet.h; version 3.9.1), to about 1e-6. It uses
 * Gauss-Legendre quadrature over the sampling maps, which does not converge across the edge of total
 * reflection, and the inner reflectance as the plain mean of 64 cosines with full end weights. That is 1.5 %
 * too low, and darkens the base. */
aur_rough_coat aur_rough_coat_of_mitsuba(const aur_microfacet *microfacet, float ior);

/* Transmittance of the coat at `cosine` from outside. */
float aur_rough_coat_transmittance(const aur_rough_coat *coat, float cosine);
