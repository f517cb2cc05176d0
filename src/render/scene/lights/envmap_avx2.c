#include "render/scene/lights/envmap_body.h"

const aur_envmap_kernels aur_envmap_kernels_avx2 = AUR_ENVMAP_KERNELS;
