/* The compensated kernel, compiled once for each instruction set: eight lanes, each with its own error term,
 * so that the bits do not depend on how wide the registers are. */
#ifndef AUR_QUALITY_DISTANCE_TILE_H
#define AUR_QUALITY_DISTANCE_TILE_H

#include "quality/pair_sum.h"

enum { AUR_LANES = 8 };

typedef struct aur_lanes {
    double sum[AUR_LANES];
    double error[AUR_LANES];
} aur_lanes;

static inline aur_twofold aur_lanes_total(const aur_lanes *lanes) {
    aur_twofold total = {0.0, 0.0};
    for (int l = 0; l < AUR_LANES; ++l)
        total = aur_twofold_add(total, aur_two_sum(lanes->sum[l], lanes->error[l]));
    return total;
}

static inline double aur_distance_between(const aur_axes *axes, size_t i, size_t j) {
    const double dx = axes->x[i] - axes->x[j];
    const double dy = axes->y[i] - axes->y[j];
    const double dz = axes->z[i] - axes->z[j];
    return sqrt(dx * dx + dy * dy + dz * dz);
}

/* One row against columns [first, last): whole groups of eight in lanes, the rest in the first lanes. */
static inline void aur_distance_row(const aur_axes *axes, size_t row, size_t first, size_t last,
                                    aur_lanes *lanes) {
    const double x = axes->x[row], y = axes->y[row], z = axes->z[row];
    const double weight = axes->weights != NULL ? axes->weights[row] : 1.0;
    size_t j = first;
    for (; j + AUR_LANES <= last; j += AUR_LANES) {
        double distance[AUR_LANES];
        for (int l = 0; l < AUR_LANES; ++l) {
            const double dx = x - axes->x[j + (size_t)l];
            const double dy = y - axes->y[j + (size_t)l];
            const double dz = z - axes->z[j + (size_t)l];
            distance[l] = sqrt(dx * dx + dy * dy + dz * dz);
        }
        if (axes->weights != NULL)
            for (int l = 0; l < AUR_LANES; ++l)
                distance[l] *= weight * axes->weights[j + (size_t)l];
        for (int l = 0; l < AUR_LANES; ++l) {
            const double sum = lanes->sum[l] + distance[l];
            const double part = sum - lanes->sum[l];
            lanes->error[l] += (lanes->sum[l] - (sum - part)) + (distance[l] - part);
            lanes->sum[l] = sum;
        }
    }
    for (int l = 0; j < last; ++j, ++l) {
        double distance = aur_distance_between(axes, row, j);
        if (axes->weights != NULL)
            distance *= weight * axes->weights[j];
        const aur_twofold sum = aur_two_sum(lanes->sum[l], distance);
        lanes->sum[l] = sum.high;
        lanes->error[l] += sum.low;
    }
}

static inline aur_twofold aur_distance_tile_body(const aur_axes *axes, aur_pair_tile tile) {
    aur_lanes lanes = {{0}, {0}};
    const int diagonal = tile.first_row == tile.first_column;
    for (size_t i = tile.first_row; i < tile.last_row; ++i)
        aur_distance_row(axes, i, tile.first_column, diagonal ? i : tile.last_column, &lanes);
    return aur_lanes_total(&lanes);
}

#endif
