#define ROW aur_kernel_row_avx512
#include "points/quadrature/kernel_body.h"
