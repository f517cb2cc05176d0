#include "points/base/simd.h"
#include "render/path/path_lanes_body.h"

static const aur_path_kernels aur_path_kernels_portable = AUR_PATH_KERNELS;

const aur_path_kernels *aur_path_kernels_here(void) {
    return &AUR_KERNEL_HERE(aur_path_kernels);
}
