/* The rest of the kernel at a row of points: eight running sums, so that results are bit-identical for all
 * register widths. */
#include "points/base/simd_lanes.h"
#include "points/quality/split/split.h"

enum { SUMS = 8, PARTS = SUMS / AUR_LANES };

static inline aur_reals load(const double *source) {
    aur_reals value;
    memcpy(&value, source, sizeof value);
    return value;
}

static inline aur_reals whole(double exponent, aur_reals square) {
    if (exponent == -1.0)
        return aur_lanes_sqrt(square);
    if (exponent == 1.0)
        return 1.0 / aur_lanes_sqrt(square);
    if (exponent == 2.0)
        return 1.0 / square;
    for (size_t l = 0; l < AUR_LANES; ++l)
        square[l] = aur_split_whole(exponent, square[l]);
    return square;
}

/* Clenshaw 1955. */
static inline aur_reals smooth(const aur_split_kernel *kernel, aur_reals x) {
    const aur_reals twice = x + x;
    aur_reals here = {0}, before = {0};
    for (size_t k = kernel->term_count - 1; k > 0; --k) {
        const aur_reals next = (twice * here - before) + kernel->terms[k];
        before = here;
        here = next;
    }
    return (x * here - before) + kernel->terms[0];
}

static double row(const aur_near_points *near, const aur_split_kernel *kernel, size_t i, size_t first,
                  size_t last) {
    const double limit = kernel->reach * kernel->reach, scale = 2.0 / limit;
    const aur_words count = aur_lanes_count();
    aur_reals sums[PARTS] = {{0}};
    for (size_t begin = first; begin < last; begin += SUMS)
        for (size_t part = 0; part < PARTS; ++part) {
            const size_t j = begin + part * AUR_LANES;
            const aur_reals x = near->x[i] - load(near->x + j);
            const aur_reals y = near->y[i] - load(near->y + j);
            const aur_reals z = near->z[i] - load(near->z + j);
            const aur_reals weight = load(near->w + j);
            const aur_reals square = x * x + y * y + z * z;
            const aur_words within =
                (aur_words)(count + j < last) & (aur_words)(square < limit) & (aur_words)(weight != 0.0);
            const aur_reals rest = whole(kernel->exponent, square) - smooth(kernel, square * scale - 1.0);
            sums[part] += aur_lanes_choose(within, weight * rest, (aur_reals){0});
        }
    double sum = 0.0;
    for (size_t l = 0; l < SUMS; ++l)
        sum += sums[l / AUR_LANES][l % AUR_LANES];
    return sum;
}

const aur_near_kernel AUR_KERNEL(aur_near) = {row};
