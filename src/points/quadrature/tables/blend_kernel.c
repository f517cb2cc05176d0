/* Plain arithmetic without contraction, so that all instruction sets are bit-identical. The target overlaps
 * neither row. */
#include "points/quadrature/tables/weight_table.h"

void AUR_KERNEL(aur_weight_blend)(size_t count, const float *restrict below, const float *restrict above,
                                  float part, float *restrict target) {
    for (size_t i = 0; i < count; ++i)
        target[i] = below[i] + part * (above[i] - below[i]);
}
