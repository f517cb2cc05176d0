/* Directions for gathering over a hemisphere: one pattern an image, randomised at every shading point.
 *
 * The line between what is done once and what is done at each ray runs through this file: a pattern and its
 * rules are compiled once; at a shading point they are only rotated (or, for nets, their digits scrambled).
 */
#ifndef AUR_TRANSPORT_GATHER_RULE_H
#define AUR_TRANSPORT_GATHER_RULE_H

#include <aureole/sphere.h>
#include <stdbool.h>

#include "core/vector.h"

typedef struct aur_gather_options {
    const char *set; /* SET syntax */
    size_t count;    /* directions */
    aur_map map;     /* of sets of the square */
    aur_scramble
        scramble;         /* NONE, ROTATE, DIGIT, OWEN or SHIFT; the last three for sets of the square only */
    bool optimal_density; /* directions follow lobe^{2/(s+1)} and carry the weights p/q */
    double smoothness;    /* s, in (1, 2) */
    size_t rotations;     /* so many randomisations, prepared once; 0: a new one at every shading point */
    uint64_t seed;        /* of the prepared randomisations */
    uint64_t set_seed;    /* of sets that are random themselves */
    aur_warnings warnings;
} aur_gather_options;

/* How a pattern is randomised at one place. */
typedef struct aur_gather_turn {
    float cosine, sine;      /* of the rotation about the axis */
    uint32_t word_u, word_v; /* of the scrambling of the square */
    size_t first;            /* of the prepared directions */
} aur_gather_turn;

/* A pattern of the unit hemisphere for lobes cos^exponent about +z. Immutable. */
typedef struct aur_gather_rule {
    size_t count;
    double exponent;       /* of the lobe that is integrated */
    double drawn_exponent; /* of the density that the directions follow */
    aur_map map;
    aur_scramble scramble;
    float *x, *y, *z;      /* directions: one pattern, or one for each prepared scrambling */
    float *weights;        /* of the directions: see aur_gather_direction */
    float *densities;      /* with which directions are drawn, a steradian */
    uint32_t (*square)[2]; /* words of points of the square, scrambled at the shading point; else NULL */
    size_t rotations;
    aur_gather_turn *turns; /* rotations of them */
} aur_gather_rule;

aur_result aur_gather_rule_create(const aur_gather_options *options, double exponent, aur_gather_rule *rule,
                                  aur_error *error);
void aur_gather_rule_release(aur_gather_rule *rule);

/* The randomisation that a hash stands for: equal hashes, equal patterns. */
aur_gather_turn aur_gather_rule_turn(const aur_gather_rule *rule, uint64_t hash);

/* Two turns, one after the other. */
aur_gather_turn aur_gather_turn_by(aur_gather_turn turn, float cosine, float sine);

/* The density of the rule's directions at the cosine about its axis, a steradian. */
float aur_gather_density(const aur_gather_rule *rule, float cosine);

/* Direction `index` of the turned rule in the lobe's frame. Returns the weight such that the mean over all
 * directions of weight * f estimates the integral of cos^exponent * f over the hemisphere (of solid angle).
 */
float aur_gather_direction(const aur_gather_rule *rule, const aur_gather_turn *turn, size_t index,
                           aur_vector *direction);

/* Direction `index` of a rule of exponent 0, which has them evenly over the hemisphere, as a point of the
 * unit square: its azimuth, and how far its height is from the pole. */
void aur_gather_square(const aur_gather_rule *rule, const aur_gather_turn *turn, size_t index,
                       float point[2]);

#endif
