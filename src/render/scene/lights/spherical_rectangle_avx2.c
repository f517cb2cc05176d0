#include "render/scene/lights/spherical_rectangle_body.h"

const aur_rectangle_kernels aur_rectangle_kernels_avx2 = AUR_RECTANGLE_KERNELS;
