/* Joe and Kuo's direction numbers for the dimensions after the first, which has none. */
#pragma once

#include <stdint.h>

enum { AUR_SOBOL_DIMENSIONS = 1024 };

/* Primitive polynomials over GF(2): bit k is the coefficient of x^k. */
extern const uint16_t aur_sobol_polynomials[AUR_SOBOL_DIMENSIONS - 1];
/* As many odd numbers m_1, m_2, ... a polynomial as its degree, one polynomial after another. */
extern const uint16_t aur_sobol_numbers[];
