/* The compensated kernel: eight running sums, each with an error term, so that results are bit-identical for
 * all register widths. */
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

#if AUR_KERNEL_WIDE

/* Sums of estimated distances: estimating a reciprocal root takes half the time of a root, or runs in
 * parallel to it. */

enum { ROWS = 4 };

/* A distance is root + part * series. */
typedef struct estimate {
    aur_reals root, part, series;
} estimate;

static inline aur_reals fused(aur_reals a, aur_reals b, aur_reals c) {
#if defined(__AVX512F__)
    return (aur_reals)_mm512_fmadd_pd((__m512d)a, (__m512d)b, (__m512d)c);
#else
    return (aur_reals)_mm256_fmadd_pd((__m256d)a, (__m256d)b, (__m256d)c);
#endif
}

/* With an estimate y of 1/sqrt(d2) and e = 1 - d2 y^2, sqrt(d2) is d2 y times
 *     1 + e/2 + 3/8 e^2 + 5/16 e^3 + 35/128 e^4 + O(e^5).
 * AVX-512 estimates within |e| <= 2^-13, where the last term is below 1e-16. Estimates of AVX2 have single
 * precision, |e| <= 7.4e-4, and distances below 1e-19 are underestimated; every second row uses the unit for
 * roots, which works in parallel. */
static inline estimate root_of(size_t row, aur_reals square) {
    const aur_reals none = {0};
#if defined(__AVX512F__)
    (void)row;
    const aur_reals inverse = (aur_reals)_mm512_rsqrt14_pd((__m512d)square);
    const aur_reals last = none + 0.3125;
#else
    if (row % 2 == 0)
        return (estimate){aur_lanes_sqrt(square), none, none};
    const __m128 single = _mm_max_ps(_mm256_cvtpd_ps((__m256d)square), _mm_set1_ps(0x1p-126f));
    const aur_reals inverse = (aur_reals)_mm256_cvtps_pd(_mm_rsqrt_ps(single));
#endif
    const aur_reals root = square * inverse;
    const aur_reals e = fused(-root, inverse, none + 1.0);
#if !defined(__AVX512F__)
    const aur_reals last = fused(e, none + 0.2734375, none + 0.3125);
#endif
    return (estimate){root, root * e, fused(e, fused(e, last, none + 0.375), none + 0.5)};
}

typedef struct row_sums {
    aur_reals sums[ROWS], corrections[ROWS];
} row_sums;

/* Four rows against the columns j, j+1, ... that are `within`. */
static inline __attribute__((always_inline)) void add_columns(const aur_axes *axes, size_t row, size_t j,
                                                              aur_words within, row_sums *rows) {
    const aur_reals none = {0}, tiny = none + 0x1p-1000; /* coincident points must not give infinities */
    const aur_reals xs = load(axes->x + j), ys = load(axes->y + j), zs = load(axes->z + j);
    for (size_t r = 0; r < ROWS; ++r) {
        const aur_reals x = axes->x[row + r] - xs, y = axes->y[row + r] - ys, z = axes->z[row + r] - zs;
        const estimate d = root_of(r, fused(x, x, fused(y, y, fused(z, z, tiny))));
        rows->sums[r] += aur_lanes_choose(within, d.root, none);
        rows->corrections[r] = fused(aur_lanes_choose(within, d.part, none), d.series, rows->corrections[r]);
    }
}

/* Four rows against all columns of a tile off the diagonal. */
static inline aur_twofold four_rows(const aur_axes *axes, size_t row, size_t first, size_t last) {
    row_sums rows;
    for (size_t r = 0; r < ROWS; ++r)
        rows.sums[r] = rows.corrections[r] = (aur_reals){0};
    const aur_words count = aur_lanes_count();
    size_t j = first;
    for (; j + AUR_LANES <= last; j += AUR_LANES)
        add_columns(axes, row, j, ~(aur_words){0}, &rows);
    if (j < last)
        add_columns(axes, row, j, (aur_words)(count + j < last), &rows);
    const aur_reals sums = (rows.sums[0] + rows.sums[1]) + (rows.sums[2] + rows.sums[3]);
    const aur_reals corrections =
        (rows.corrections[0] + rows.corrections[1]) + (rows.corrections[2] + rows.corrections[3]);
    double sum = 0.0, correction = 0.0;
    for (size_t l = 0; l < AUR_LANES; ++l) {
        sum += sums[l];
        correction += corrections[l];
    }
    return aur_two_sum(sum, correction);
}

static aur_twofold fast_tile(const aur_axes *axes, aur_pair_tile tile, double parameter) {
    if (tile.first_row == tile.first_column)
        return distance_tile(axes, tile, parameter);
    aur_twofold total = {0.0, 0.0};
    size_t i = tile.first_row;
    for (; i + ROWS <= tile.last_row; i += ROWS)
        total = aur_twofold_add(total, four_rows(axes, i, tile.first_column, tile.last_column));
    if (i < tile.last_row) {
        const aur_pair_tile rest = {i, tile.last_row, tile.first_column, tile.last_column};
        total = aur_twofold_add(total, distance_tile(axes, rest, parameter));
    }
    return total;
}

const aur_distance_kernels AUR_KERNEL(aur_distance) = {distance_tile, fast_tile};

#else

const aur_distance_kernels AUR_KERNEL(aur_distance) = {distance_tile, distance_tile};

#endif
