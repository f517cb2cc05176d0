/* Reconstruction filters; aur_filter_find and aur_filter_sample are in scene.h. */
#pragma once

#include "points/base/keys.h"
#include "render/scene/scene.h"

typedef enum aur_filter_kind {
    AUR_FILTER_BOX,
    AUR_FILTER_TENT,
    AUR_FILTER_GAUSSIAN,
    AUR_FILTER_MITCHELL
} aur_filter_kind;

struct aur_filter {
    aur_filter_kind kind;
    float scale; /* pixels: box and tent their radius, gaussian its standard deviation, mitchell half its
                    radius */
};

extern const aur_table aur_filter_table;

/* The filter that parameters->plugin names, with its parameters. */
aur_result aur_filter_create(aur_parameters *parameters, aur_filter *filter, aur_error *error);
