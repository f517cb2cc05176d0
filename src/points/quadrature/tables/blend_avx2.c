#define BLEND aur_weight_blend_avx2
#include "points/quadrature/tables/blend_body.h"
