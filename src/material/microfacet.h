/* Rough surfaces made of tiny mirrors: GGX (Walter 2007) and Beckmann distributions of their normals, Smith
 * shadowing, and drawing among the normals that are visible. Local frame, z up. */
#ifndef AUR_MATERIAL_MICROFACET_H
#define AUR_MATERIAL_MICROFACET_H

#include "core/parameters.h"
#include "core/vector.h"

typedef struct aur_microfacet {
    bool beckmann; /* else GGX */
    float alpha_u, alpha_v;
} aur_microfacet;

/* Reads `distribution` (beckmann, ggx), `alpha`, or `alpha_u` and `alpha_v`; `sample_visible` is always so.
 */
aur_result aur_parameters_microfacet(aur_parameters *parameters, aur_microfacet *microfacet,
                                     aur_error *error);

/* Density of normals: its integral against the cosine is 1. */
float aur_microfacet_density(const aur_microfacet *microfacet, aur_vector normal);
/* The visible share of normals facing `direction` (either side), 0 when `normal` shows its back. */
float aur_microfacet_masking(const aur_microfacet *microfacet, aur_vector direction, aur_vector normal);
/* The density with which aur_microfacet_sample draws `normal`; view.z > 0. */
float aur_microfacet_pdf(const aur_microfacet *microfacet, aur_vector view, aur_vector normal);
aur_vector aur_microfacet_sample(const aur_microfacet *microfacet, aur_vector view, float u, float v);

/* What facets that mirror all light scatter from `light` to `view`, times |light.z|; 0 unless both are above.
 * Their reflectance at *cosine, the angle between either direction and the facet, is left out. */
float aur_microfacet_mirror(const aur_microfacet *microfacet, aur_vector view, aur_vector light,
                            float *cosine);
/* The density, a steradian, with which aur_microfacet_draw_mirrored draws `light`; 0 unless both are above.
 */
float aur_microfacet_mirror_pdf(const aur_microfacet *microfacet, aur_vector view, aur_vector light);
/* Where light comes from that a facet drawn by aur_microfacet_sample, its normal in *normal, mirrors to
 * `view`. */
aur_vector aur_microfacet_draw_mirrored(const aur_microfacet *microfacet, aur_vector view, float u, float v,
                                        aur_vector *normal);

#endif
