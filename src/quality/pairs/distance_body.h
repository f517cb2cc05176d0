/* The compensated kernel, compiled once for each instruction set: eight running sums, each with its own error
 * term, so that the bits do not depend on how wide the registers are. A file that includes this defines
 * LANES, the doubles of a register. */
#include <string.h>

#include "quality/pairs/pair_sum.h"

typedef double lanes __attribute__((vector_size(8 * LANES)));

enum { SUMS = 8, PARTS = SUMS / LANES };

static inline lanes load(const double *source) {
    lanes value;
    memcpy(&value, source, sizeof value);
    return value;
}

static inline lanes root_of(lanes square) {
    double root[LANES];
    memcpy(root, &square, sizeof root);
    for (int l = 0; l < LANES; ++l)
        root[l] = sqrt(root[l]);
    return load(root);
}

static aur_twofold distance_tile(const aur_axes *axes, aur_pair_tile tile, double parameter) {
    (void)parameter;
    const bool diagonal = tile.first_row == tile.first_column;
    lanes sums[PARTS] = {{0}}, errors[PARTS] = {{0}};
    for (size_t i = tile.first_row; i < tile.last_row; ++i) {
        const size_t last = diagonal ? i : tile.last_column;
        for (size_t first = tile.first_column; first < last; first += SUMS)
            for (size_t part = 0; part < PARTS; ++part) {
                const size_t j = first + part * LANES;
                const lanes x = axes->x[i] - load(axes->x + j);
                const lanes y = axes->y[i] - load(axes->y + j);
                const lanes z = axes->z[i] - load(axes->z + j);
                lanes distance = root_of(x * x + y * y + z * z);
                if (axes->weights != NULL)
                    distance *= axes->weights[i] * load(axes->weights + j);
                for (size_t l = 0; l < LANES && j + LANES > last; ++l)
                    distance[l] = j + l < last ? distance[l] : 0.0;
                const lanes next = sums[part] + distance, added = next - sums[part];
                errors[part] += (sums[part] - (next - added)) + (distance - added);
                sums[part] = next;
            }
    }
    aur_twofold total = {0.0, 0.0};
    for (int l = 0; l < SUMS; ++l)
        total = aur_twofold_add(total, aur_two_sum(sums[l / LANES][l % LANES], errors[l / LANES][l % LANES]));
    return total;
}
