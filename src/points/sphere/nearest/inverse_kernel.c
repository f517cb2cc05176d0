#include "points/sphere/nearest/inverse.h"
#include "points/sphere/phase_lanes.h"

#if !AUR_KERNEL_WIDE
const double aur_sphere_lattice_vectors[2][AUR_SPHERE_LATTICE_VECTORS] = {
#include "data/lattice_vectors.inc"
};
#endif

/* The azimuth in turns, within 1e-12: enough to find the cell. atan t / (2 pi t) is a polynomial of t^2
 * within 1.2e-13 up to tan(pi/8); above it atan t = pi/4 + atan((t - 1)/(t + 1)). */
static inline aur_reals azimuth(aur_reals x, aur_reals y) {
    const aur_reals none = {0};
    const aur_reals a = aur_lanes_absolute(x), b = aur_lanes_absolute(y);
    const aur_words flat = (aur_words)(a > b);
    const aur_reals longer = aur_lanes_choose(flat, a, b), shorter = aur_lanes_choose(flat, b, a);
    const aur_words steep = (aur_words)(shorter > 0.41421356237309503 * longer);
    const aur_reals above = aur_lanes_choose(steep, shorter - longer, shorter);
    const aur_reals below = aur_lanes_choose(steep, shorter + longer, longer);
    const aur_reals t = above / aur_lanes_choose((aur_words)(below > 0.0), below, none + 1.0);
    const aur_reals q = t * t;
    const aur_reals q2 = q * q;
    const aur_reals p67 = -0x1.88c1caeb27e21p-8 * q + 0x1.6bb7b4d15bff6p-7;
    const aur_reals p45 = -0x1.d4fa8886f2df6p-7 * q + 0x1.21887bf45caf7p-6;
    const aur_reals p23 = -0x1.7481457da6f11p-6 * q + 0x1.04c265f437c13p-5;
    const aur_reals p01 = -0x1.b2995e6f24801p-5 * q + 0x1.45f306dc9b798p-3;
    aur_reals p = (p67 * q2 + p45) * (q2 * q2) + (p23 * q2 + p01);
    p = p * t + aur_lanes_choose(steep, none + 0.125, none);
    p = aur_lanes_choose(flat, p, 0.25 - p);
    p = aur_lanes_choose((aur_words)(x < 0.0), 0.5 - p, p);
    return aur_lanes_choose((aur_words)(y < 0.0), -p, p);
}

/* AUR_LANES directions. */
static inline void nearest_lanes(const aur_sphere_lattice *lattice, const double *xyz, double *indices) {
    aur_reals px, py, pz;
    aur_lanes_load3(xyz, &px, &py, &pz);
    const aur_reals across = px * px + py * py;
    /* 1 - z without cancellation near the pole */
    const aur_words up = (aur_words)(pz > 0.0);
    const aur_reals depth = aur_lanes_choose(up, across / (1.0 + aur_lanes_choose(up, pz, across)), 1.0 - pz);
    const aur_reals index = depth * (1.0 / lattice->step) - 0.5;
    const aur_reals turns = azimuth(px, py);
    const aur_words k = aur_sphere_lattice_zone(lattice->whole, across);
    const aur_reals f0 = aur_lanes_look_up(aur_sphere_lattice_vectors[0], k);
    const aur_reals f1 = aur_lanes_look_up(aur_sphere_lattice_vectors[0] + 1, k);
    const aur_reals e0 = aur_lanes_look_up(aur_sphere_lattice_vectors[1], k);
    const aur_reals e1 = aur_lanes_look_up(aur_sphere_lattice_vectors[1] + 1, k);
    /* coordinates in the basis, whose determinant is (-1)^k */
    const aur_words sign = k << 63;
    const aur_reals c0 = aur_lanes_floor((aur_reals)((aur_words)(index * e1 - f1 * turns) ^ sign));
    const aur_reals c1 = aur_lanes_floor((aur_reals)((aur_words)(f0 * turns - e0 * index) ^ sign));
    const aur_reals corner = c0 * f0 + c1 * f1;
    const aur_reals none = {0};
    aur_reals best = none + 1e300, nearest = none - 1.0;
    /* Unrolled, the corners have shorter dependency chains: 10 % faster with AVX-512. */
#pragma GCC unroll 4
    for (size_t i = 0; i < 4; ++i) {
        const aur_reals j = corner + ((i & 1) != 0 ? f0 : none) + ((i & 2) != 0 ? f1 : none);
        const aur_words inside = (aur_words)(j >= 0.0) & (aur_words)(j < lattice->whole);
        const aur_reals clamped = aur_lanes_choose(inside, j, none);
        const aur_reals down = (clamped + 0.5) * lattice->step;
        const aur_reals radius = aur_lanes_sqrt(down * (2.0 - down));
        aur_reals sine, cosine;
        aur_phase_sincos_lanes(aur_lanes_from_whole(clamped) * AUR_GOLDEN_PHASE, &sine, &cosine);
        const aur_reals x = radius * cosine - px;
        const aur_reals y = radius * sine - py;
        const aur_reals z = (1.0 - down) - pz;
        const aur_reals distance = x * x + y * y + z * z;
        const aur_words tied = (aur_words)(distance == best) & (aur_words)(j < nearest);
        const aur_words closer = ((aur_words)(distance < best) | tied) & inside;
        best = aur_lanes_choose(closer, distance, best);
        nearest = aur_lanes_choose(closer, j, nearest);
    }
    if (lattice->limit < lattice->whole)
        nearest = aur_lanes_choose((aur_words)(corner + f0 + f1 >= lattice->limit), none - 1.0, nearest);
    memcpy(indices, &nearest, sizeof nearest);
}

void AUR_KERNEL(aur_sphere_lattice_nearest)(const aur_sphere_lattice *lattice, size_t count,
                                            const double *xyz, double *indices) {
    size_t i = 0;
    for (; i + AUR_LANES <= count; i += AUR_LANES)
        nearest_lanes(lattice, xyz + 3 * i, indices + i);
    if (i == count)
        return;
    double rest_xyz[3 * AUR_LANES] = {0}, rest[AUR_LANES];
    memcpy(rest_xyz, xyz + 3 * i, 3 * (count - i) * sizeof *xyz);
    nearest_lanes(lattice, rest_xyz, rest);
    memcpy(indices + i, rest, (count - i) * sizeof *rest);
}
