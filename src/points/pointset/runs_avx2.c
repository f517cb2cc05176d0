#include "points/pointset/runs_body.h"

const aur_run_kernels aur_runs_avx2 = AUR_RUN_KERNELS;
