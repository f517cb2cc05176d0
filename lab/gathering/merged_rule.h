/* A rule of two patterns, one about the normal for the diffuse lobe and one about the mirror direction for a
 * glossy lobe, in which every ray counts for both lobes (Marques 2018 section 5.3).
 *
 * Both patterns are fixed relative to the normal and the plane of reflection, in one of K prepared rotations
 * and its mirror image. So a sample's weight depends only on the angle of reflection and is looked up in a
 * table, computed once per image. The directions of a pattern are split among the samples of a pixel: subset
 * s of S has every S-th. */
#pragma once

#include <aureole/quadrature.h>

#include "settings.h"
#include "vectors.h"

typedef struct lab_merged_options {
    const lab_gather_settings
        *settings;                   /* weights OSWA, MIS or SOLVE; at least one rotation; density is set */
    const aur_gather_common *common; /* both counts are multiples of its subsets */
    size_t count[2];                 /* directions of the diffuse and of the glossy pattern */
    double exponent;                 /* of the glossy lobe */
} lab_merged_options;

enum { LAB_MERGED_DENSITY_STEPS = 1024 };

/* Immutable. Patterns are numbered 0 (diffuse) and 1 (glossy). Their directions are stored by subset: those
 * of subset s begin at s * count / subsets. */
typedef struct lab_merged_rule {
    lab_weights method;
    size_t subsets, rotations;
    size_t count[2], subset_count[2]; /* directions per pattern, and per pattern in one subset */
    double exponent;
    float *direction[2][3]; /* x, y, z: rotation after rotation, about the pattern's axis */
    /* Directions per steradian in one subset, by the cosine to the pattern's axis: the pdf for MIS against
     * light sampling. */
    float density[2][LAB_MERGED_DENSITY_STEPS + 1];
    double drawn_exponent[2];
    aur_oswa *oswa; /* SOLVE */
    uint64_t seed;
    aur_weight_table *table; /* OSWA: where angles lie */
    /* OSWA: for each row of the table and each subset, the weights of its samples for one lobe, then for the
     * other. */
    float *rows;
} lab_merged_rule;

aur_result lab_merged_rule_create(const lab_merged_options *options, lab_merged_rule **rule,
                                  aur_error *error);
void lab_merged_rule_destroy(lab_merged_rule *rule); /* NULL is allowed */

/* The samples of both patterns in one subset. */
static inline size_t lab_merged_rule_samples(const lab_merged_rule *rule) {
    return rule->subset_count[0] + rule->subset_count[1];
}

/* Weights of a subset's samples, the diffuse pattern's first: for the diffuse lobe, then for the glossy one,
 * weights[2 * samples]. `cosine` is the cosine of the angle between normal and mirror direction. The mean
 * over the subsets of the sum of weight * f estimates the integral over the hemisphere (solid angle) of cos *
 * f, and of cos^exponent * f. False if a system could not be solved: the weights are NaN. */
bool lab_merged_rule_weights(const lab_merged_rule *rule, size_t rotation, size_t subset, float cosine,
                             float *weights);

/* The sum of both patterns' densities in a direction, given its cosines to the normal and to the mirror
 * direction. */
static inline float lab_merged_rule_density(const lab_merged_rule *rule, float normal_cosine,
                                            float mirror_cosine) {
    const float steps = (float)LAB_MERGED_DENSITY_STEPS;
    const float a = normal_cosine > 0.0f ? (normal_cosine < 1.0f ? normal_cosine : 1.0f) : 0.0f;
    const float b = mirror_cosine > 0.0f ? (mirror_cosine < 1.0f ? mirror_cosine : 1.0f) : 0.0f;
    return rule->density[0][(int)(a * steps)] + rule->density[1][(int)(b * steps)];
}

/* The frames of the two patterns. `normal` is on the viewer's side, `mirror` the axis of the glossy lobe. */
void lab_merged_rule_frames(lab_vector normal, lab_vector mirror, bool mirrored, lab_frame frames[2]);
