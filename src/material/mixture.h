/* Materials made of two others: one for each side of a surface, or both by a weight at each point. A BSDF of
 * this kind has an aur_mixture as its data, fills the public part of it in `create`, calls aur_mixture_join,
 * and names the functions below in its descriptor. */
#pragma once

#include "material/texture.h"

typedef struct aur_mixture {
    const aur_bsdf *part[2]; /* part[1] may be NULL where it has no weight anywhere */
    bool by_side;            /* part[0] is seen from the front, part[1], turned round, from behind; else: */
    aur_color weight;        /* of part[0], by the mean of the channels; part[1] has the rest */
    /* Set by aur_mixture_join: the numbers that the parts' lobes have in the mixture. */
    size_t number[2][AUR_BSDF_LOBE_CAPACITY];
} aur_mixture;

/* The lobes of the parts become the mixture's; those that differ in nothing but coefficient and side become
 * one. */
void aur_mixture_join(aur_bsdf *bsdf);

void aur_mixture_weigh(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view, aur_bsdf_lobe *lobes);
aur_vector aur_mixture_evaluate(const aur_bsdf *bsdf, aur_bsdf_part part, aur_bsdf_point point,
                                aur_vector view, aur_vector light);
float aur_mixture_pdf(const aur_bsdf *bsdf, aur_bsdf_part part, aur_bsdf_point point, aur_vector view,
                      aur_vector light);
aur_vector aur_mixture_evaluate_with_pdf(const aur_bsdf *bsdf, aur_bsdf_part part, aur_bsdf_point point,
                                         aur_vector view, aur_vector light, float *pdf);
bool aur_mixture_sample(const aur_bsdf *bsdf, aur_bsdf_part part, aur_bsdf_point point, aur_vector view,
                        const float u[3], aur_bsdf_sample *drawn);
aur_vector aur_mixture_diffuse_albedo(const aur_bsdf *bsdf, aur_bsdf_point point, float side);
