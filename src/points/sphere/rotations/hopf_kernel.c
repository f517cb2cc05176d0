/* Hopf coordinates to quaternions, compiled once for each instruction set. */
#include "points/sphere/phase_lanes.h"
#include "points/sphere/rotations/hopf.h"

/* w0, x0, y0, z0, w1, ... of `count` lanes. */
static inline void put(aur_reals w, aur_reals x, aur_reals y, aur_reals z, size_t count, double *to) {
    double all[4 * AUR_LANES];
    for (size_t l = 0; l < AUR_LANES; ++l) {
        all[4 * l] = w[l];
        all[4 * l + 1] = x[l];
        all[4 * l + 2] = y[l];
        all[4 * l + 3] = z[l];
    }
    memcpy(to, all, 4 * count * sizeof *to);
}

static inline __attribute__((always_inline)) void put_points(aur_reals u, aur_words a, aur_words b,
                                                             size_t count, double *to) {
    const aur_reals inner = aur_lanes_sqrt(u), outer = aur_lanes_sqrt(1.0 - u);
    aur_reals sine_a, cosine_a, sine_b, cosine_b;
    aur_phase_sincos_lanes(a, &sine_a, &cosine_a);
    aur_phase_sincos_lanes(b, &sine_b, &cosine_b);
    if (count == AUR_LANES)
        put(inner * sine_a, inner * cosine_a, outer * sine_b, outer * cosine_b, AUR_LANES, to);
    else
        put(inner * sine_a, inner * cosine_a, outer * sine_b, outer * cosine_b, count, to);
}

static void fill_line(const aur_hopf_line *line, uint64_t first, size_t count, double *wxyz) {
    for (size_t i = 0; i < count; i += AUR_LANES) {
        const aur_words index = aur_lanes_count() + (first + i);
        const aur_reals u = (aur_lanes_from_signed(index) + line->offset) * line->step;
        const size_t part = count - i < AUR_LANES ? count - i : AUR_LANES;
        put_points(u, line->phases[0] + index * line->turns[0], line->phases[1] + index * line->turns[1],
                   part, wxyz + 4 * i);
    }
}

static void lift_cube(size_t count, const double *cube, double *wxyz) {
    for (size_t i = 0; i < count; i += AUR_LANES) {
        const size_t part = count - i < AUR_LANES ? count - i : AUR_LANES;
        aur_reals u = {0.0};
        aur_words a = {0}, b = {0};
        for (size_t l = 0; l < part; ++l) {
            const double *const point = cube + 3 * (i + l);
            u[l] = point[0];
            a[l] = (uint64_t)(point[1] * 0x1p64);
            b[l] = (uint64_t)(point[2] * 0x1p64);
        }
        put_points(u, a, b, part, wxyz + 4 * i);
    }
}

const aur_hopf_kernels AUR_KERNEL(aur_hopf) = {fill_line, lift_cube};
