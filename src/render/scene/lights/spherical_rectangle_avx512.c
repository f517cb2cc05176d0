#include "render/scene/lights/spherical_rectangle_body.h"

const aur_rectangle_kernels aur_rectangle_kernels_avx512 = AUR_RECTANGLE_KERNELS;
