/* Adaptive gathering (Marques 2019, section 6.2): adds levels of an extensible grid while the contrast of the
 * samples is above a threshold. */
#pragma once

#include <aureole-render/gather.h>

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

/* The options of finalgather-lab. Unset ones are 0, negative, or DEFAULT. */
typedef struct lab_gather_settings {
    aur_gather_settings gather;
    bool adaptive;
    lab_criterion criterion;
    float threshold; /* contrast above which the next level is gathered: see docs/keys.md for those of each
                        criterion */
    size_t levels, level_factor; /* extensions, each by a factor of 2 or 4: 2, 4 */
} lab_gather_settings;

enum { LAB_LEVEL_CAPACITY = 8 };

extern const aur_gather_method lab_gather_by_levels;
