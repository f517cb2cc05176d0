/* Patterns that grow: the first `base` directions of an extensible grid, then `factor` times as many, and so
 * on, each level with weights of its own (Marques 2019, section 6.2). */
#pragma once

#include "transport/gather/rule.h"

enum { AUR_GATHER_LEVEL_CAPACITY = 8 };

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

typedef struct aur_gather_levels_options {
    size_t base, factor, extensions; /* base * factor^l directions for l = 0 .. extensions; factor 2 or 4 */
    bool optimal;                    /* weights that are best for each level; else p/q */
    double smoothness, regularization;
} aur_gather_levels_options;

/* The SET of a grid with these levels, for aur_gather_rule_options. */
aur_result aur_gather_levels_set(const aur_gather_levels_options *options, size_t capacity, char *set,
                                 size_t *count, aur_error *error);

/* `rule` has been made from that set. */
aur_result aur_gather_levels_create(const aur_gather_levels_options *options, const aur_gather_rule *rule,
                                    aur_gather_levels *levels, aur_error *error);
void aur_gather_levels_release(aur_gather_levels *levels);
