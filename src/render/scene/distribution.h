/* Choosing among things in proportion to their weights. */
#pragma once

#include "points/base/error.h"

typedef struct aur_distribution {
    size_t count;
    double total;
    double *sums; /* count + 1: running sums, the last one `total`; behind them the guide of distribution.c */
} aur_distribution;

/* Copies the weights (>= 0, finite); a total of 0 is allowed. */
aur_result aur_distribution_create(aur_distribution *distribution, size_t count, const double *weights,
                                   aur_error *error);
void aur_distribution_release(aur_distribution *distribution);

/* The item that u in [0,1) falls on, never one of weight 0; *u becomes what is left, again in [0,1). The
 * total must not be 0. */
size_t aur_distribution_choose(const aur_distribution *distribution, float *u);
/* The same where 24 binary digits are too few for a choice and two coordinates of a point. */
size_t aur_distribution_choose_double(const aur_distribution *distribution, double *u);

/* Ask the memory for what the choice by u will read: first for the place where its search begins, then, by
 * that, for the items there. */
void aur_distribution_prefetch_guide(const aur_distribution *distribution, double u);
void aur_distribution_prefetch_items(const aur_distribution *distribution, double u);

static inline double aur_distribution_probability(const aur_distribution *distribution, size_t index) {
    return (distribution->sums[index + 1] - distribution->sums[index]) / distribution->total;
}
