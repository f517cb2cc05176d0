/* The rules of all lobes in the scene: one rule for diffuse lobes, one for each exponent of glossy ones. */
#pragma once

#include "render/film/integrator.h"
#include "render/gather/settings.h"
#include "render/sampling/rule.h"

/* --- lobes that dip below the surface */

enum { AUR_HORIZON_STEPS = 256 };

/* For one exponent: the part of a lobe cos^exponent above the surface when its axis is tilted from the normal
 * by i steps of 90 degrees / AUR_HORIZON_STEPS. */
typedef struct aur_gather_horizon {
    float visible[AUR_HORIZON_STEPS + 1];
} aur_gather_horizon;

void aur_gather_horizon_fill(double exponent, aur_gather_horizon *horizon);

/* The factor for the weights of the samples above the surface with which their sum is the integral of the
 * lobe's visible part (a ratio estimate: exact for constants). `normal` is the surface's in the frame of the
 * lobe. 1 if the whole lobe is visible, 0 if no sample is. */
float aur_gather_horizon_factor(const aur_gather_rule *rule, const aur_gather_horizon *horizon,
                                const aur_gather_rotation *rotation, aur_vector normal);

typedef struct aur_gather_lobe_rule {
    aur_gather_rule rule;
    float directions; /* per sample of a pixel; if a method uses whole patterns, the requested number */
    bool clipped;     /* the lobe ends at the horizon, with a table of its visible part */
    aur_gather_horizon horizon;
    void *state; /* of the caller's method */
} aur_gather_lobe_rule;

/* The state of the caller's method for GGX lobes of one roughness. */
typedef struct aur_gather_ggx {
    float alpha;
    void *state;
} aur_gather_ggx;

typedef struct aur_gather_rules {
    const aur_gather_method *method; /* the caller's; or NULL */
    bool whole;   /* the method gathers each lobe by whole patterns; else samples of a pixel split them */
    bool pairs;   /* the method gathers a diffuse and a glossy lobe together */
    size_t count; /* at least 1 */
    /* lobes[0] is for diffuse lobes; the exponents of the others differ. */
    aur_gather_lobe_rule *lobes;
    /* Uniform over the hemisphere, for lobes without a formula: see aur_gather_rule_square. Empty if no
     * material has one. */
    aur_gather_lobe_rule sampled;
    /* If a method gathers GGX lobes: one for each roughness; and the state of each shape's material, or NULL.
     */
    size_t ggx_count;
    aur_gather_ggx *ggx;
    const void **ggx_of_shape;
    /* What gathers each lobe of each shape's material; NULL for lobes without a formula. */
    const aur_gather_lobe_rule *(*of_shape)[AUR_BSDF_LOBE_CAPACITY];
    unsigned scatters; /* the kinds of all surfaces' lobes, AUR_SCATTERS_* */
} aur_gather_rules;

/* Errors: MEMORY, and those of patterns and weights. The rules must be released in every case. */
aur_result aur_gather_rules_create(const aur_gather_settings *p, const aur_gather_method *method,
                                   const aur_integrator_context *context, aur_gather_rules *rules,
                                   aur_error *error);
void aur_gather_rules_release(aur_gather_rules *rules);

/* Rounds a count of directions or draws to one that the samples of a pixel split evenly: at least one each.
 */
size_t aur_gather_split_count(size_t count, size_t samples_per_pixel);
