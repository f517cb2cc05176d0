#define SLICE_KERNEL aur_slice_kernel_avx2
#include "lighting/slice_body.h"
