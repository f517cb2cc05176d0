/* A quadrature rule of the hemisphere: one pattern of directions for lobes cos^m about +z, and how it is
 * randomised. Pattern and weights are compiled once an image; at a shading point the pattern is only
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
    bool nested;       /* randomisations are those of aur_nested_shift; for spherical Fibonacci sets that are
                          rotated */
    size_t rotations;  /* so many randomisations, prepared once; 0: a new one at every shading point */
    uint64_t seed;     /* of the prepared randomisations */
    uint64_t set_seed; /* of sets that are random themselves */
    /* The weights of the directions, such as a file's, are factors of the rule's; without it they are
     * refused.
     */
    bool weighted;
    aur_warnings warnings;
} aur_gather_rule_options;

/* How a rule is randomised at one place. A pattern on the sphere is rotated about its axis; one of the square
 * that was scrambled beforehand is neither rotated nor scrambled again, but one of several copies; one that
 * is scrambled at the shading point uses the words alone. */
typedef struct aur_gather_rotation {
    float cosine, sine;      /* of the rotation about the axis */
    uint32_t word_u, word_v; /* of the scrambling of the square; word_v also shifts heights: see _square */
    size_t first;            /* of the copy's directions in the rule's arrays */
} aur_gather_rotation;

/* Immutable. */
typedef struct aur_gather_rule {
    size_t count;
    /* Of the pattern in the arrays: one for each prepared scrambling, else one; 0 where directions are made
     * at the shading point. */
    size_t copies;
    double exponent;       /* m of the lobe that is integrated */
    double drawn_exponent; /* of the density that the directions follow */
    aur_map map;
    aur_scramble scramble;
    float *x, *y, *z;      /* directions, of unit length */
    float *weights;        /* see aur_gather_rule_direction */
    float *densities;      /* with which directions are drawn, a steradian */
    uint32_t (*square)[2]; /* words of points of the square, scrambled at the shading point; else NULL */
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

/* The randomisation that a hash stands for: equal hashes, equal patterns. */
aur_gather_rotation aur_gather_rule_rotation(const aur_gather_rule *rule, uint64_t hash);

/* The rotation, and another one by the angle with this cosine and sine after it. */
aur_gather_rotation aur_gather_rotation_by(aur_gather_rotation rotation, float cosine, float sine);

/* The density of the rule's directions at the cosine about its axis, a steradian. */
float aur_gather_rule_density(const aur_gather_rule *rule, float cosine);

/* Direction `index` of the randomised rule in the lobe's frame. Returns the weight such that the mean over
 * all directions of weight * f estimates the integral of cos^exponent * f over the hemisphere (of solid
 * angle).
 */
float aur_gather_rule_direction(const aur_gather_rule *rule, const aur_gather_rotation *rotation,
                                size_t index, aur_vector *direction);

/* Direction `index` of a rule of exponent 0, which has them evenly over the hemisphere, as a point of the
 * unit square: its azimuth, and how far its height is from the pole. */
void aur_gather_rule_square(const aur_gather_rule *rule, const aur_gather_rotation *rotation, size_t index,
                            float point[2]);

/* From the part of a pattern that one sample has to that of the next one, modulo `parts` >= 1: a number
 * without a common divisor with them, near their golden section. However many samples there are, their parts
 * lie evenly among all. */
size_t aur_gather_part_stride(size_t parts);

/* Patterns of neighbouring pixels that complete each other.
 *
 * A spherical Fibonacci set is a lattice in azimuth and height. Its shifts by halves of two basis vectors
 * make four sets, together the lattice that is twice as fine; shifts by quarters and eighths, sixteen and
 * sixty-four. So the pixels of each 2 x 2 block have all halves, those of 4 x 4 all quarters, those of 8 x 8
 * all eighths: the larger the block, the finer the pattern that its pixels make together, as Ahmed and Wonka
 * 2020 ask of sequences in the order of a Morton curve. Directions of one number stay within a cell of the
 * pattern, so packets of them stay coherent. */

enum {
    AUR_NESTED_LEVELS = 3, /* 2 x 2, 4 x 4, 8 x 8 */
    AUR_NESTED_COUNT = 1 << 2 * AUR_NESTED_LEVELS
};

/* The number of the shift of the pixel at (x, y): two bits a level, those of the 2 x 2 block highest. Which
 * pixel has which is drawn again for each block of 4 x 4, and which block of 4 x 4 has which eighths for each
 * of 8 x 8: else pixels 4 apart would have nearly the same pattern, and those 8 apart the very same, and both
 * would be wrong alike. Blocks stay complete. */
static inline size_t aur_nested_number(uint64_t seed, size_t x, size_t y) {
    size_t number = 0;
    for (size_t level = 0; level < AUR_NESTED_LEVELS; ++level)
        number = number << 2 | (x >> level & 1u) << 1 | (y >> level & 1u);
    const size_t eighths = aur_hash3(seed, x / 8, y / 8) & 3u;
    const size_t others = aur_hash4(seed, x / 4, y / 4, 4) & 15u;
    return number ^ (others << 2 | eighths);
}

/* A point of a spherical Fibonacci set of `count` points on the hemisphere - azimuth in turns, and height -
 * where shift number `number` has it. What leaves the hemisphere at one end comes in at the other one, as the
 * lattice goes on there. Heights of all shifts together are the middles of equal steps. */
void aur_nested_shift(size_t count, size_t number, double point[2]);
