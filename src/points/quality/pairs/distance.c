#include "points/quality/pairs/distance_body.h"

const aur_distance_kernels aur_distance_portable = {distance_tile, distance_tile};
