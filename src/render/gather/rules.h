/* What gathers each kind of lobe in the scene: one rule for diffuse lobes, one for each exponent of glossy
 * ones. */
#pragma once

#include "render/film/integrator.h"
#include "render/gather/rule_ggx.h"
#include "render/gather/rule_merged.h"
#include "render/gather/rule_weights.h"

typedef struct aur_gather_lobe_rule {
    aur_gather_rule rule;
    float
        directions; /* that one sample of a pixel sends; with a caller's method, those that were asked for */
    bool clipped;   /* the lobe ends at the horizon, and has a table of how much of it is left */
    aur_gather_horizon horizon;
    void *state;             /* of the caller's method, which gathers by the rule; NULL: it is used whole */
    aur_merged_rule *merged; /* of glossy rules: serves the lobe together with a diffuse one; or NULL */
} aur_gather_lobe_rule;

typedef struct aur_gather_rules {
    const aur_gather_method *method; /* of all lobes with a formula; or NULL */
    size_t count;                    /* at least 1 */
    /* lobes[0] is for diffuse lobes; the exponents of the others differ. */
    aur_gather_lobe_rule *lobes;
    /* Evenly over the hemisphere, for lobes without a formula: see aur_gather_rule_square. Empty where no
     * material has one. */
    aur_gather_lobe_rule sampled;
    /* With optimal weights, what gathers the lobes that are GGX instead: one for each roughness, and the one
     * of each shape's material or NULL. */
    size_t ggx_count;
    aur_ggx_rule *ggx;
    const aur_ggx_rule **ggx_of_shape;
    /* Diffuse pattern of all merged rules, which differ in the glossy one; NULL when none are merged. */
    const aur_merged_rule *merged;
    /* What gathers each lobe of each shape's material; NULL for lobes without a formula. */
    const aur_gather_lobe_rule *(*of_shape)[AUR_BSDF_LOBE_CAPACITY];
    unsigned scatters; /* the kinds of all surfaces' lobes, AUR_SCATTERS_* */
} aur_gather_rules;

/* Errors: MEMORY, and what the patterns and weights say. The rules are to be released in every case. */
aur_result aur_gather_rules_create(const aur_gather_settings *p, const aur_gather_method *method,
                                   const aur_integrator_context *context, aur_gather_rules *rules,
                                   aur_error *error);
void aur_gather_rules_release(aur_gather_rules *rules);

/* A count of directions or draws made one that the samples of a pixel split evenly: at least one each. */
size_t aur_gather_split_count(size_t wanted, size_t samples_per_pixel);
