#include "points/sphere/rotations/hopf_body.h"

const aur_hopf_kernels aur_hopf_portable = {fill_line, lift_cube};
