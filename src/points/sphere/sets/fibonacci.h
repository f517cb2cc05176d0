/* Spherical Fibonacci points by index. */
#pragma once

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "points/base/simd.h"
#include "points/sphere/phase.h"

/* Point j has 1 - z = (j + offset) * step and the azimuth phase + j/Phi. */
typedef struct aur_fibonacci {
    double step, offset;
    uint64_t phase;
} aur_fibonacci;

/* Azimuths are added by one complex product: point j is point j - (j mod 64) turned by (j mod 64)/Phi, from a
 * table. Any point is computed from its index to 4.5e-16, and a sine costs a product. */
enum { AUR_FIBONACCI_BLOCK = 64, AUR_FIBONACCI_WRAPPED = 7 };
extern const double aur_golden_cosines[AUR_FIBONACCI_BLOCK + AUR_FIBONACCI_WRAPPED];
extern const double aur_golden_sines[AUR_FIBONACCI_BLOCK + AUR_FIBONACCI_WRAPPED];

/* One point, bit-identical to the kernels. */
static inline void aur_fibonacci_point(const aur_fibonacci *set, uint64_t index, double xyz[3]) {
    const uint64_t k = index % AUR_FIBONACCI_BLOCK;
    double sine, cosine;
    aur_phase_sincos(set->phase + (index - k) * AUR_GOLDEN_PHASE, &sine, &cosine);
    const double turn_cosine = aur_golden_cosines[k], turn_sine = aur_golden_sines[k];
    const double depth = ((double)index + set->offset) * set->step;
    const double radius = sqrt(depth * (2.0 - depth));
    xyz[0] = radius * (cosine * turn_cosine - sine * turn_sine);
    xyz[1] = radius * (sine * turn_cosine + cosine * turn_sine);
    xyz[2] = 1.0 - depth;
}

/* Points first .. first+count-1 as x,y,z triples; `stream` bypasses the caches; call aur_lanes_end_stream
 * afterwards. */
typedef void aur_fibonacci_kernel(const aur_fibonacci *set, uint64_t first, size_t count, bool stream,
                                  double *xyz);

/* No kernel fuses a multiplication and an addition: all are bit-identical. */
AUR_KERNELS(aur_fibonacci_kernel, aur_fibonacci_points);

/* Whether `count` points exceed the caches, so that streaming stores are faster. */
static inline bool aur_fibonacci_streams(size_t count) {
    return count >= (8 << 20) / (3 * sizeof(double));
}
