#include "render/sampling/stream_body.h"

const aur_stream_kernel_sets aur_stream_kernels_avx2 = AUR_STREAM_KERNELS;
