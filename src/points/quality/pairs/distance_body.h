/* The compensated kernel, compiled once for each instruction set: eight running sums, each with its own error
 * term, so that the bits do not depend on how wide the registers are. */
#include "points/base/simd_lanes.h"
#include "points/quality/pairs/pair_sum.h"

enum { SUMS = 8, PARTS = SUMS / AUR_LANES };

static inline aur_reals load(const double *source) {
    aur_reals value;
    memcpy(&value, source, sizeof value);
    return value;
}

static aur_twofold distance_tile(const aur_axes *axes, aur_pair_tile tile, double parameter) {
    (void)parameter;
    const bool diagonal = tile.first_row == tile.first_column;
    aur_reals sums[PARTS] = {{0}}, errors[PARTS] = {{0}};
    for (size_t i = tile.first_row; i < tile.last_row; ++i) {
        const size_t last = diagonal ? i : tile.last_column;
        for (size_t first = tile.first_column; first < last; first += SUMS)
            for (size_t part = 0; part < PARTS; ++part) {
                const size_t j = first + part * AUR_LANES;
                const aur_reals x = axes->x[i] - load(axes->x + j);
                const aur_reals y = axes->y[i] - load(axes->y + j);
                const aur_reals z = axes->z[i] - load(axes->z + j);
                aur_reals distance = aur_lanes_sqrt(x * x + y * y + z * z);
                if (axes->weights != NULL)
                    distance *= axes->weights[i] * load(axes->weights + j);
                for (size_t l = 0; l < AUR_LANES && j + AUR_LANES > last; ++l)
                    distance[l] = j + l < last ? distance[l] : 0.0;
                const aur_reals next = sums[part] + distance, added = next - sums[part];
                errors[part] += (sums[part] - (next - added)) + (distance - added);
                sums[part] = next;
            }
    }
    aur_twofold total = {0.0, 0.0};
    for (int l = 0; l < SUMS; ++l)
        total = aur_twofold_add(
            total, aur_two_sum(sums[l / AUR_LANES][l % AUR_LANES], errors[l / AUR_LANES][l % AUR_LANES]));
    return total;
}
