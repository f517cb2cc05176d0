/* The options of finalgather-lab. */
#pragma once

#include <aureole-render/gather.h>

/* Weights of samples: p/q or 1; optimal for one lobe; and for two lobes merged: optimal (OSWA), by the
 * balance heuristic, optimal as published with a system solved at every shading point. */
typedef enum lab_weights {
    LAB_WEIGHTS_RATIO,
    LAB_WEIGHTS_EQUAL,
    LAB_WEIGHTS_OSW,
    LAB_WEIGHTS_OSWA,
    LAB_WEIGHTS_MIS,
    LAB_WEIGHTS_SOLVE
} lab_weights;

/* Contrast measures of samples that decide on the next level. Marques 2019 names "color entropy" and cites
 * Rigau 2003; the three entropies are interpretations. */
typedef enum lab_criterion {
    LAB_CRITERION_ENTROPY, /* 1 - H / log n of the samples' shares, over channels by their shares */
    LAB_CRITERION_ENTROPY_BRIGHTNESS, /* the same times the mean of each channel, weighted .4, .3, .6 (Rigau)
                                       */
    LAB_CRITERION_ENTROPY_HISTOGRAM,  /* H of a histogram of displayed brightness, in nats */
    LAB_CRITERION_VARIANCE,
    LAB_CRITERION_DEFAULT /* variance */
} lab_criterion;

/* Unset ones are 0, negative, or DEFAULT. */
typedef struct lab_gather_settings {
    aur_gather_settings gather;
    lab_weights weights;
    double regularization; /* of optimal weights: .5 for SOLVE, else 1e-6 */
    bool adaptive;
    lab_criterion criterion;
    float threshold; /* contrast above which the next level is gathered: see docs/keys.md for those of each
                        criterion */
    size_t levels, level_factor; /* extensions, each by a factor of 2 or 4: 2, 4 */
} lab_gather_settings;

static inline const lab_gather_settings *lab_settings(const aur_gather_settings *options) {
    return (const lab_gather_settings *)options;
}

/* Whether the samples of two lobes serve both. */
static inline bool lab_merges(const lab_gather_settings *o) {
    return o->weights == LAB_WEIGHTS_OSWA || o->weights == LAB_WEIGHTS_MIS || o->weights == LAB_WEIGHTS_SOLVE;
}

static inline bool lab_is_optimal(const lab_gather_settings *o) {
    return o->weights == LAB_WEIGHTS_OSW || o->weights == LAB_WEIGHTS_OSWA || o->weights == LAB_WEIGHTS_SOLVE;
}
