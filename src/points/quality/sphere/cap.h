/* Suprema over spherical caps of |mass inside - area|. */
#pragma once

#include "points/quality/pairs/pair_sum.h"

typedef struct aur_height {
    double height, mass;
} aur_height;

/* The best value of closed caps about one centre: the greatest mass inside less area, over all heights.
 * `room` has space for count of them. */
double aur_cap_best_about(const aur_axes *axes, const double centre[3], aur_height *room);
