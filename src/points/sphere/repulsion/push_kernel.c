/* The sum over charges: eight running sums, so that results are bit-identical for all register widths. */
#include "points/base/simd_lanes.h"
#include "points/sphere/repulsion/repulsion.h"

enum { SUMS = 8, PARTS = SUMS / AUR_LANES };

/* 1/d and 1/d^3 of the squared distances a to a charge and b to its opposite. With 1/(a b) both need one
 * division: 1/a is b/(a b). A `missing` lane contributes 0. */
static inline __attribute__((always_inline)) void add_lanes(const aur_charges *charges, size_t j,
                                                            const double at[3], aur_words missing, bool axes,
                                                            aur_reals sums[4]) {
    aur_reals x, y, z;
    memcpy(&x, charges->x + j, sizeof x);
    memcpy(&y, charges->y + j, sizeof y);
    memcpy(&z, charges->z + j, sizeof z);
    const aur_reals zero = {0.0};
    const aur_reals dx = at[0] - x, dy = at[1] - y, dz = at[2] - z;
    const aur_reals a = dx * dx + dy * dy + dz * dz;
    if (!axes) {
        const aur_reals inverse = aur_lanes_choose(missing, zero, 1.0 / a);
        const aur_reals near = aur_lanes_choose(missing, zero, aur_lanes_sqrt(a) * inverse);
        const aur_reals push = near * inverse;
        sums[0] += near;
        sums[1] += x * push;
        sums[2] += y * push;
        sums[3] += z * push;
        return;
    }
    const aur_reals b = 4.0 - a;
    const aur_reals product = aur_lanes_choose(missing, zero, 1.0 / (a * b));
    const aur_reals inverse_a = product * b, inverse_b = product * a;
    const aur_reals near = aur_lanes_choose(missing, zero, aur_lanes_sqrt(a) * inverse_a);
    const aur_reals far = aur_lanes_choose(missing, zero, aur_lanes_sqrt(b) * inverse_b);
    const aur_reals push = near * inverse_a - far * inverse_b;
    sums[0] += near + far;
    sums[1] += x * push;
    sums[2] += y * push;
    sums[3] += z * push;
}

/* Blocks of eight begin at `first`; the last one may read beyond `last`, within the padding of the arrays. */
static inline __attribute__((always_inline)) aur_push sum_charges(const aur_charges *charges, size_t index,
                                                                  size_t first, size_t last, bool axes) {
    const double at[3] = {charges->x[index], charges->y[index], charges->z[index]};
    const aur_words lanes = aur_lanes_count();
    aur_reals sums[PARTS][4] = {{{0.0}}};
    for (size_t block = first; block < last; block += SUMS)
        for (size_t part = 0; part < PARTS; ++part) {
            const size_t j = block + part * AUR_LANES;
            const aur_words number = lanes + j;
            const aur_words missing = (aur_words)(number == index) | (aur_words)(number >= last);
            add_lanes(charges, j, at, missing, axes, sums[part]);
        }
    double totals[4] = {0.0};
    for (size_t l = 0; l < SUMS; ++l)
        for (size_t d = 0; d < 4; ++d)
            totals[d] += sums[l / AUR_LANES][d][l % AUR_LANES];
    return (aur_push){totals[0], {totals[1], totals[2], totals[3]}};
}

aur_push AUR_KERNEL(aur_push)(const aur_charges *charges, size_t index, size_t first, size_t last) {
    return charges->axes ? sum_charges(charges, index, first, last, true)
                         : sum_charges(charges, index, first, last, false);
}
