#define ROW aur_kernel_row_avx512
#include "quadrature/kernel_body.h"
