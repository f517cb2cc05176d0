/* What a rough coat of a dielectric mirrors and lets through, over all of its facets. */
#pragma once

#include "render/scene/materials/microfacet.h"

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
