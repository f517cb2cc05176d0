/* The weights between two rows of a table, compiled once for each instruction set: a file that includes this
 * defines BLEND, the function's name. It is plain arithmetic without contraction, so every set gives the same
 * bits. The target overlaps neither row. */
#include "points/quadrature/tables/weight_table.h"

void BLEND(size_t count, const float *restrict below, const float *restrict above, float part,
           float *restrict target) {
    for (size_t i = 0; i < count; ++i)
        target[i] = below[i] + part * (above[i] - below[i]);
}
