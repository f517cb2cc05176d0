/* Random rotations by a hash of the seed, and frames. */
#include <math.h>

#include <aureole/rotations.h>

#include "points/base/random.h"
#include "points/sphere/map.h"
#include "points/sphere/phase.h"

/* Streams of the seed, so that no two uses of one seed share a number. */
enum { STREAM_AXIAL = 0x61786961, STREAM_UNIFORM = 0x756e6966 };

void aur_rotation_axial(uint64_t seed, aur_rotation *rotation) {
    double sine, cosine;
    aur_phase_sincos(aur_hash2(seed, STREAM_AXIAL), &sine, &cosine);
    *rotation = (aur_rotation){{cosine, -sine, 0.0, sine, cosine, 0.0, 0.0, 0.0, 1.0}};
}

void aur_quaternion_uniform(uint64_t seed, double wxyz[4]) {
    const double u = aur_unit_double(aur_hash3(seed, STREAM_UNIFORM, 0));
    double s1, c1, s2, c2;
    aur_phase_sincos(aur_hash3(seed, STREAM_UNIFORM, 1), &s1, &c1);
    aur_phase_sincos(aur_hash3(seed, STREAM_UNIFORM, 2), &s2, &c2);
    wxyz[0] = sqrt(u) * c2;
    wxyz[1] = sqrt(1.0 - u) * s1;
    wxyz[2] = sqrt(1.0 - u) * c1;
    wxyz[3] = sqrt(u) * s2;
}

void aur_rotation_from_quaternion(const double wxyz[4], aur_rotation *rotation) {
    const double w = wxyz[0], x = wxyz[1], y = wxyz[2], z = wxyz[3];
    *rotation = (aur_rotation){{1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - z * w), 2.0 * (x * z + y * w),
                                2.0 * (x * y + z * w), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - x * w),
                                2.0 * (x * z - y * w), 2.0 * (y * z + x * w), 1.0 - 2.0 * (x * x + y * y)}};
}

/* From the greatest of the four squares, which is at least 1/4 (Shepperd 1978). */
void aur_rotation_to_quaternion(const aur_rotation *rotation, double wxyz[4]) {
    const double *const m = rotation->m;
    const double trace = m[0] + m[4] + m[8];
    const double squares[4] = {trace, 2.0 * m[0] - trace, 2.0 * m[4] - trace, 2.0 * m[8] - trace};
    const double differences[3] = {m[7] - m[5], m[2] - m[6], m[3] - m[1]};
    const double sums[3] = {m[5] + m[7], m[2] + m[6], m[1] + m[3]};
    size_t greatest = 0;
    for (size_t k = 1; k < 4; ++k)
        greatest = squares[k] > squares[greatest] ? k : greatest;
    for (size_t k = 0; k < 4; ++k) {
        if (k == greatest)
            wxyz[k] = 1.0 + squares[k];
        else if (k == 0 || greatest == 0)
            wxyz[k] = differences[k + greatest - 1];
        else
            wxyz[k] = sums[5 - k - greatest]; /* of x,y the third, x,z the second, y,z the first */
    }
    const double length = sqrt(aur_dot4(wxyz, wxyz));
    for (size_t k = 0; k < 4; ++k)
        wxyz[k] /= length;
}

void aur_rotation_uniform(uint64_t seed, aur_rotation *rotation) {
    double wxyz[4];
    aur_quaternion_uniform(seed, wxyz);
    aur_rotation_from_quaternion(wxyz, rotation);
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
