#include "points/base/simd.h"
#define SLICE_KERNEL aur_slice_kernel_portable
#include "lighting/viewfactors/slice_body.h"

aur_slice_kernel *aur_slice_kernel_here(void) {
    return &AUR_KERNEL_HERE(aur_slice_kernel);
}
