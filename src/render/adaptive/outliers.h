/* Pixels that have an error of their own beside all others. */
#pragma once

#include "render/adaptive/trial.h"

/* What they make of a trial: rounds give such pixels more samples, so that the directions of a pattern are
 * for the others. */
typedef struct aur_outliers {
    double rest;  /* of the trial's squared error, what the others have; 1 where no pixels stand out */
    double price; /* rays that the trial needs to bring them to the error of the others, over its own */
} aur_outliers;

/* The hundredth of all pixels in which samples of path tracing vary most, where they have most of the error
 * of a trial by another integrator: a lamp that is smaller than a pixel, or its image in a mirror. What an
 * integrator finds seldom lies anywhere, and hardly in the same pixels as what the other one does. Both
 * trials are of the same pixels and have had a round; `path` lends its scratch. */
aur_outliers aur_outliers_find(aur_trial *path, const aur_trial *trial);
