#include "core/simd.h"
#include "transport/paths/path_lanes_body.h"

static const aur_path_kernels portable = AUR_PATH_KERNELS;

const aur_path_kernels *aur_path_kernels_here(void) {
#if defined(__x86_64__)
    const aur_isa isa = aur_isa_available();
    if (isa == AUR_ISA_AVX512)
        return &aur_path_kernels_avx512;
    if (isa == AUR_ISA_AVX2)
        return &aur_path_kernels_avx2;
#endif
    return &portable;
}
