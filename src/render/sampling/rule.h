/* A quadrature rule of the hemisphere: one pattern of directions for lobes cos^m about +z, and its
 * randomisation. Pattern and weights are computed once per image; at a shading point the pattern is only
 * rotated, or, for nets, its digits are scrambled. */
#pragma once

#include <aureole/sphere.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "points/base/random.h"
#include "points/base/vector.h"

typedef struct aur_gather_rule_options {
    const char *set; /* SET syntax */
    size_t count;    /* directions */
    aur_map map;     /* of sets of the square */
    /* NONE, ROTATE, DIGIT, OWEN or SHIFT; the last three for sets of the square only. */
    aur_scramble scramble;
    bool optimal_density; /* directions follow lobe^{2/(s+1)} and carry the weights p/q */
    double smoothness;    /* s, in (1, 2) */
    bool nested;          /* randomised by aur_nested_shift; for rotated spherical Fibonacci sets */
    size_t rotations;     /* randomisations prepared in advance; 0: a new one at every shading point */
    uint64_t seed;        /* of the prepared randomisations */
    uint64_t set_seed;    /* of sets that are random themselves */
    /* The set's weights, such as a file's, multiply the rule's; otherwise they are refused. */
    bool weighted;
    aur_warnings warnings;
} aur_gather_rule_options;

/* The randomisation of a rule at one shading point. A pattern on the sphere is rotated about its axis. For a
 * pattern of the square scrambled in advance, one of several copies is selected, without further rotation or
 * scrambling. One that is scrambled at the shading point uses only the words. */
typedef struct aur_gather_rotation {
    float cosine, sine;      /* of the rotation about the axis */
    uint32_t word_u, word_v; /* of the scrambling of the square; word_v also shifts heights: see _square */
    size_t first;            /* of the copy's directions in the rule's arrays */
} aur_gather_rotation;

/* Immutable. */
typedef struct aur_gather_rule {
    size_t count;
    /* Copies of the pattern in the arrays: one for each prepared scrambling, else one; 0 if directions are
     * computed at the shading point. */
    size_t copies;
    double exponent;       /* m of the lobe that is integrated */
    double drawn_exponent; /* of the density that the directions follow */
    aur_map map;
    aur_scramble scramble;
    float *x, *y, *z; /* directions, of unit length */
    float *weights;   /* see aur_gather_rule_direction */
    float *densities; /* with which directions are drawn, a steradian */
    uint32_t (
        *square)[2]; /* words of points of the square, to be scrambled at the shading point; else NULL */
    bool nested;
    size_t rotation_count; /* prepared ones; 0: a new one at every shading point */
    aur_gather_rotation *rotations;
} aur_gather_rule;

/* Sets map and scrambling by name. When `scramble` is NULL, digits of nets are scrambled, and every other
 * pattern is turned about its axis (Marques 2013, section 6.1). Errors, NAME and UNSUPPORTED, begin with the
 * integrator's name. */
aur_result aur_gather_rule_options_name(aur_gather_rule_options *options, const char *integrator,
                                        const char *map, const char *scramble, aur_error *error);

aur_result aur_gather_rule_create(const aur_gather_rule_options *options, double exponent,
                                  aur_gather_rule *rule, aur_error *error);
void aur_gather_rule_release(aur_gather_rule *rule);

/* The randomisation determined by a hash: equal hashes, equal patterns. */
aur_gather_rotation aur_gather_rule_rotation(const aur_gather_rule *rule, uint64_t hash);

/* The rotation followed by another one by the angle with this cosine and sine. */
aur_gather_rotation aur_gather_rotation_by(aur_gather_rotation rotation, float cosine, float sine);

/* The density of the rule's directions at the cosine about its axis, a steradian. */
float aur_gather_rule_density(const aur_gather_rule *rule, float cosine);

/* Direction `index` of the randomised rule in the lobe's frame. Returns the weight such that the mean over
 * all directions of weight * f estimates the integral of cos^exponent * f over the hemisphere (of solid
 * angle).
 */
float aur_gather_rule_direction(const aur_gather_rule *rule, const aur_gather_rotation *rotation,
                                size_t index, aur_vector *direction);

/* The same of a rule whose directions are in its arrays: `square` is NULL. */
static inline float aur_gather_rule_stored(const aur_gather_rule *rule, const aur_gather_rotation *rotation,
                                           size_t index, aur_vector *direction) {
    const size_t at = rotation->first + index;
    const float x = rule->x[at], y = rule->y[at];
    *direction = (aur_vector){rotation->cosine * x - rotation->sine * y,
                              rotation->sine * x + rotation->cosine * y, rule->z[at]};
    return rule->weights[at];
}

/* Direction `index` of a rule of exponent 0 (uniform over the hemisphere) as a point of the unit square: its
 * azimuth, and the distance of its height from the pole. */
void aur_gather_rule_square(const aur_gather_rule *rule, const aur_gather_rotation *rotation, size_t index,
                            float point[2]);

/* The step from the part of a pattern that one sample uses to the next sample's, modulo `parts` >= 1: coprime
 * with `parts` and near its golden section. So the parts of any number of samples are spread evenly. */
size_t aur_gather_part_stride(size_t parts);

/* Complementary patterns of neighbouring pixels.
 *
 * A spherical Fibonacci set is a lattice in azimuth and height. Its shifts by halves of two basis vectors
 * make four sets, together a lattice twice as fine; shifts by quarters and eighths make sixteen and
 * sixty-four. The pixels of each 2 x 2 block have all halves, those of 4 x 4 all quarters, those of 8 x 8 all
 * eighths. So the larger the block, the finer the union of its patterns, as Ahmed and Wonka 2020 require of
 * sequences in the order of a Morton curve. Directions of one index stay within a cell of the pattern, so
 * their packets are coherent. */

enum {
    AUR_NESTED_LEVELS = 3, /* 2 x 2, 4 x 4, 8 x 8 */
    AUR_NESTED_COUNT = 1 << 2 * AUR_NESTED_LEVELS
};

/* The index of the shift of the pixel at (x, y): two bits per level, those of the 2 x 2 block highest. The
 * assignment within each block of 4 x 4 is random, and so is that of the eighths to the blocks within 8 x 8.
 * Otherwise pixels 4 apart would have nearly the same pattern, and those 8 apart the same, with correlated
 * errors. Blocks remain complete. */
static inline size_t aur_nested_number(uint64_t seed, size_t x, size_t y) {
    size_t number = 0;
    for (size_t level = 0; level < AUR_NESTED_LEVELS; ++level)
        number = number << 2 | (x >> level & 1u) << 1 | (y >> level & 1u);
    const size_t eighths = aur_hash3(seed, x / 8, y / 8) & 3u;
    const size_t others = aur_hash4(seed, x / 4, y / 4, 4) & 15u;
    return number ^ (others << 2 | eighths);
}

/* Moves a point of a spherical Fibonacci set of `count` points on the hemisphere (azimuth in turns, and
 * height) by shift `number`. Points that leave the hemisphere at one end enter at the other, as the lattice
 * continues there. Heights of all shifts together are the midpoints of equal steps. */
void aur_nested_shift(size_t count, size_t number, double point[2]);
