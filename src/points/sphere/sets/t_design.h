/* The table of symmetric spherical designs: each of its points and the opposite. */
#pragma once

#include "points/sphere/sets/reference.h"

enum { AUR_T_DESIGN_COUNT = 13 };

extern const aur_reference aur_t_designs[AUR_T_DESIGN_COUNT];
