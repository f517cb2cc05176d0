#define SLICE_KERNEL aur_slice_kernel_avx2
#include "lighting/viewfactors/slice_body.h"
