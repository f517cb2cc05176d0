#include "quadrature/kernel_row.h"

void aur_kernel_row_avx512(double top, const double point[3], size_t count, aur_columns columns,
                           double *row) {
    kernel_row(top, point, count, columns, row);
}
