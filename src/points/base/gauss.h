/* Gauss-Legendre nodes. */
#pragma once

#include <stddef.h>

#include "points/base/error.h"

/* The rule with `count` nodes on [-1,1], exact for polynomials of degree 2 count - 1; nodes ascend. */
AUR_INTERNAL void aur_gauss_legendre(size_t count, double *nodes, double *weights);
