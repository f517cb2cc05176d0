#define ROW aur_kernel_row_avx2
#include "points/quadrature/kernel_body.h"
