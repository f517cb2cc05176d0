/* Adaptive gathering (Marques 2019, section 6.2): as many directions as the light asks for, a level of an
 * extensible grid at a time, while the samples differ too much. */
#pragma once

#include <aureole-render/gather.h>

/* How the contrast of samples is measured that decides on the next level. */
typedef enum lab_criterion {
    LAB_CRITERION_ENTROPY,
    LAB_CRITERION_VARIANCE,
    LAB_CRITERION_DEFAULT /* variance */
} lab_criterion;

/* The options of finalgather-lab. What is not given is 0, or negative, or DEFAULT. */
typedef struct lab_gather_settings {
    aur_gather_settings gather;
    bool adaptive;
    lab_criterion criterion;
    float threshold; /* contrast above which the next level is gathered: 0.3 for entropy, else 0.03 */
    size_t levels, level_factor; /* extensions, each by 2 or 4 times: 2, 4 */
} lab_gather_settings;

enum { LAB_LEVEL_CAPACITY = 8 };

extern const aur_gather_method lab_gather_by_levels;
