#include "points/pointset/runs_body.h"

const aur_run_kernels aur_runs_avx512 = AUR_RUN_KERNELS;
