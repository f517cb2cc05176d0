/* Random rotations by a hash of the seed. */
#include <math.h>

#include <aureole/sphere.h>

#include "core/random.h"
#include "sphere/phase.h"

/* Streams of the seed, so that no two uses of one seed share a number. */
enum { STREAM_AXIAL = 0x61786961, STREAM_UNIFORM = 0x756e6966 };

void aur_rotation_axial(uint64_t seed, aur_rotation *rotation) {
    double sine, cosine;
    aur_phase_sincos(aur_hash2(seed, STREAM_AXIAL), &sine, &cosine);
    *rotation = (aur_rotation){{cosine, -sine, 0.0, sine, cosine, 0.0, 0.0, 0.0, 1.0}};
}

void aur_rotation_uniform(uint64_t seed, aur_rotation *rotation) {
    const double u = aur_unit_double(aur_hash3(seed, STREAM_UNIFORM, 0));
    double s1, c1, s2, c2;
    aur_phase_sincos(aur_hash3(seed, STREAM_UNIFORM, 1), &s1, &c1);
    aur_phase_sincos(aur_hash3(seed, STREAM_UNIFORM, 2), &s2, &c2);
    const double x = sqrt(1.0 - u) * s1;
    const double y = sqrt(1.0 - u) * c1;
    const double z = sqrt(u) * s2;
    const double w = sqrt(u) * c2;
    *rotation = (aur_rotation){{1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - z * w), 2.0 * (x * z + y * w),
                                2.0 * (x * y + z * w), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - x * w),
                                2.0 * (x * z - y * w), 2.0 * (y * z + x * w), 1.0 - 2.0 * (x * x + y * y)}};
}

void aur_rotation_apply(const aur_rotation *rotation, size_t count, double *xyz) {
    const double *const m = rotation->m;
    for (size_t i = 0; i < count; ++i) {
        double *const v = xyz + 3 * i;
        const double x = v[0];
        const double y = v[1];
        const double z = v[2];
        v[0] = m[0] * x + m[1] * y + m[2] * z;
        v[1] = m[3] * x + m[4] * y + m[5] * z;
        v[2] = m[6] * x + m[7] * y + m[8] * z;
    }
}
