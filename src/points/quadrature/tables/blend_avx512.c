#define BLEND aur_weight_blend_avx512
#include "points/quadrature/tables/blend_body.h"
