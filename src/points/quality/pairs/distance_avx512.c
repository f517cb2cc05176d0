#include "points/quality/pairs/distance_fast_body.h"

const aur_distance_kernels aur_distance_avx512 = {distance_tile, fast_tile};
