/* The table of Lebedev's rules by their orbits. */
#pragma once

#include "points/sphere/sets/reference.h"

enum { AUR_LEBEDEV_COUNT = 10 };

/* Their rows are orbits. */
extern const aur_reference aur_lebedev_rules[AUR_LEBEDEV_COUNT];
