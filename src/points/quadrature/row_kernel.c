/* Plain arithmetic without contraction, so that all instruction sets are bit-identical. Differences, not the
 * dot product: distances of near samples stay accurate. */
#include <math.h>

#include "points/quadrature/kernel.h"

void AUR_KERNEL(aur_kernel_row)(double top, const double point[3], size_t count, aur_columns columns,
                                double *restrict row) {
    const double *restrict x = columns.x;
    const double *restrict y = columns.y;
    const double *restrict z = columns.z;
    const double px = point[0], py = point[1], pz = point[2];
    for (size_t j = 0; j < count; ++j) {
        const double dx = x[j] - px, dy = y[j] - py, dz = z[j] - pz;
        row[j] = top - sqrt(dx * dx + dy * dy + dz * dz);
    }
}
