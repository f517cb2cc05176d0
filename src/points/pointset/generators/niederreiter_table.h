/* The polynomials of Niederreiter's sequence: x, x + 1, x^2 + x + 1, ... */
#pragma once

#include <stdint.h>

enum { AUR_NIEDERREITER_DIMENSIONS = 1024 };

extern const uint16_t aur_irreducible_polynomials[AUR_NIEDERREITER_DIMENSIONS];
