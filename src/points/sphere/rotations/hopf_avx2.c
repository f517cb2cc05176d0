#include "points/sphere/rotations/hopf_body.h"

const aur_hopf_kernels aur_hopf_avx2 = {fill_line, lift_cube};
