/* What the measures of difference share. */
#pragma once

#include "points/base/error.h"
#include "render/image/image.h"

/* The places of red, green and blue in two pictures that can be compared. */
typedef struct aur_color_pair {
    size_t reference[3], image[3];
} aur_color_pair;

/* ARGUMENT with the place of the first value of the channels that is not finite; `what` is whose it is. */
aur_result aur_image_check_finite(const char *what, const aur_image *image, const size_t channels[3],
                                  aur_error *error);

/* ARGUMENT when sizes differ, there is no colour or a value is not finite. */
aur_result aur_image_check_pair(const aur_image *reference, const aur_image *image, aur_color_pair *pair,
                                aur_error *error);
