/* The measures in the order of listings: one line for each aur_measure_<name>, defined in the file that
 * computes it. */
#pragma once

#include "points/quality/measure.h"

#define AUR_MEASURES(ROW)                                                                                    \
    ROW(energy)                                                                                              \
    ROW(scd)                                                                                                 \
    ROW(l2_cap)                                                                                              \
    ROW(l2_cap_mean)                                                                                         \
    ROW(riesz)                                                                                               \
    ROW(cap)                                                                                                 \
    ROW(cap_bound)                                                                                           \
    ROW(min_distance)                                                                                        \
    ROW(min_angle)                                                                                           \
    ROW(covering)                                                                                            \
    ROW(mesh_ratio)                                                                                          \
    ROW(voronoi_min)                                                                                         \
    ROW(voronoi_max)                                                                                         \
    ROW(voronoi_deviation)                                                                                   \
    ROW(voronoi)                                                                                             \
    ROW(voronoi_cells)                                                                                       \
    ROW(star)                                                                                                \
    ROW(star_bound)                                                                                          \
    ROW(l2_star)                                                                                             \
    ROW(centered)                                                                                            \
    ROW(wraparound)                                                                                          \
    ROW(net)                                                                                                 \
    ROW(wce)                                                                                                 \
    ROW(spectrum)                                                                                            \
    ROW(periodogram)

#define AUR_DECLARE_MEASURE(name) extern const aur_measure_row aur_measure_##name;
AUR_MEASURES(AUR_DECLARE_MEASURE)
#undef AUR_DECLARE_MEASURE
