#define ROW aur_kernel_row_avx2
#include "quadrature/kernel_body.h"
