#include "render/path/path_lanes_body.h"

const aur_path_kernels aur_path_kernels_avx2 = AUR_PATH_KERNELS;
