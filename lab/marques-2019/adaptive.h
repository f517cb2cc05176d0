/* Adaptive gathers of the Cornell box: rendering, counting their levels, and their error. */
#pragma once

#include "program/lab/lab.h"

enum { ADAPTIVE_SEEDS = 8, ADAPTIVE_FIXED = 5 };

typedef struct adaptive_lobe {
    const char *name;
    size_t first;        /* directions of the first level */
    double published[3]; /* fractions of pixels that ended at each level */
} adaptive_lobe;

extern const adaptive_lobe adaptive_lobes[2];

typedef struct adaptive_way {
    const char *criterion; /* NULL: a pattern of constant size, the lobe's first one times `factor` */
    size_t factor, levels;
    double threshold;
    const char *pattern; /* NULL: spherical Fibonacci points if constant, E-SFG if adaptive */
} adaptive_way;

typedef struct adaptive_study {
    lab_run *run;
    bool quick;
    lab_stage stage;
    const adaptive_lobe *lobe;
    size_t side, image_side, photons, references, seeds;
    aur_image *reference_images[2];
    double fixed[ADAPTIVE_FIXED]; /* mean square errors of patterns of doubling constant size; 0: not measured
                                   * yet */
} adaptive_study;

/* Cost of a gather: mean number of directions, and the fractions of the first three levels. */
typedef struct adaptive_counts {
    double mean, shares[3];
} adaptive_counts;

/* The same with errors, for each seed. */
typedef struct adaptive_found {
    double mean[ADAPTIVE_SEEDS], shares[3][ADAPTIVE_SEEDS];
    double mse[ADAPTIVE_SEEDS];
    double log_rays[ADAPTIVE_SEEDS]; /* log of the directions relative to those of constant size with this
                                      * error */
} adaptive_found;

const char *adaptive_pattern(const adaptive_way *way); /* its name */
aur_result adaptive_render(const adaptive_study *study, const adaptive_way *way, size_t seed,
                           bool whole_image, aur_image **image, aur_error *error);
void adaptive_count(const adaptive_study *study, const adaptive_way *way, const aur_image *image,
                    adaptive_counts *counts);
aur_result adaptive_measure(adaptive_study *study, const adaptive_way *way, adaptive_found *found,
                            aur_error *error);
/* Writes the image, its sampling map in the colours of the levels, and for comparison the first level, the
 * last, and a reference. */
aur_result adaptive_draw(const adaptive_study *study, const adaptive_way *way, aur_error *error);
/* Data of one lobe. */
void adaptive_release(adaptive_study *study);
