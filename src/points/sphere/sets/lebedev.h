/* The table of Lebedev's rules by their orbits. */
#pragma once

#include "points/sphere/sets/reference.h"

enum { AUR_LEBEDEV_COUNT = 10 };

/* All images of a corner x >= y >= z >= 0 under changes of sign and order have the same weight. Coordinates
 * that are equal have the same bits. */
typedef struct aur_lebedev_orbit {
    double corner[3], weight;
} aur_lebedev_orbit;

extern const aur_lebedev_orbit aur_lebedev_orbits[];
/* Their rows are orbits. */
extern const aur_reference aur_lebedev_rules[AUR_LEBEDEV_COUNT];
