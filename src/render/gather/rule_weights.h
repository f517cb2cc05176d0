/* Weights of one rule in the place of p/q: optimal ones for its own lobe (Marques 2018, section 5.2), those
 * of the levels of a pattern that grows (Marques 2019, section 6.2), and weights mended where a lobe dips
 * below the surface. */
#pragma once

#include "render/gather/options.h"
#include "render/sampling/rule.h"

/* Replaces the weights of a rule whose directions are prepared by the optimal ones for its lobe, their sum
 * held. Rotating a pattern about its axis changes none. Errors: UNSUPPORTED for directions that are made at
 * the shading point. */
aur_result aur_gather_rule_optimise(aur_gather_rule *rule, double smoothness, double regularization,
                                    aur_error *error);

/* --- levels */

enum { AUR_GATHER_LEVEL_CAPACITY = 8 };

/* Patterns that grow: the first directions of an extensible grid, then `level_factor` times as many, and so
 * on, each level with weights of its own. */
typedef struct aur_gather_levels {
    size_t count;                           /* levels; 0: the rule is used whole */
    size_t ends[AUR_GATHER_LEVEL_CAPACITY]; /* directions of level l and those before it */
    /* weights[l] + i: of direction i when level l is the last one; the sum of weight * f estimates the
     * integral. */
    float *weights[AUR_GATHER_LEVEL_CAPACITY];
    /* The worst-case error of each level over that of one random direction: what the spread of the samples is
     * to be multiplied by for an estimate of the error. */
    float errors[AUR_GATHER_LEVEL_CAPACITY];
} aur_gather_levels;

/* The SET of a grid whose first level has `base` directions, and how many they are in all. Errors: ARGUMENT
 * for too many. */
aur_result aur_gather_levels_set(const aur_gather_options *p, size_t base, size_t capacity, char *set,
                                 size_t *count, aur_error *error);

/* `rule` has been made from that set. */
aur_result aur_gather_levels_create(const aur_gather_options *p, size_t base, const aur_gather_rule *rule,
                                    aur_gather_levels *levels, aur_error *error);
void aur_gather_levels_release(aur_gather_levels *levels);

/* --- lobes that dip below the surface */

enum { AUR_HORIZON_STEPS = 256 };

/* For one exponent: the part of a lobe cos^exponent that is above the surface when its axis is tilted from
 * the normal by i steps of 90 degrees / AUR_HORIZON_STEPS. */
typedef struct aur_gather_horizon {
    float visible[AUR_HORIZON_STEPS + 1];
} aur_gather_horizon;

void aur_gather_horizon_fill(double exponent, aur_gather_horizon *horizon);

/* What the weights of the samples that are left above the surface are to be multiplied by, so that their sum
 * is the integral of the lobe's visible part (a ratio estimate: constants are exact). `normal` is the
 * surface's in the frame of the lobe. 1 where the whole lobe is visible, 0 where no sample is. */
float aur_gather_horizon_factor(const aur_gather_rule *rule, const aur_gather_horizon *horizon,
                                const aur_gather_rotation *rotation, aur_vector normal);
