/* The fast kernel is by hand: estimates of reciprocal roots take half the time of roots. */
#include "quality/pairs/distance_body.h"

#include <immintrin.h>

/* A distance is root + part * series. */
typedef struct estimate {
    __m512d root, part, series;
} estimate;

/* With y0 = rsqrt14(d2) and e = 1 - d2 y0^2, |e| <= 2^-13, sqrt(d2) = d2 y0 (1 + e/2 + 3/8 e^2 + 5/16 e^3 +
 * O(e^4)), and what is left out is below 1e-16. */
static inline estimate distances(__m512d x, __m512d y, __m512d z, __m512d xs, __m512d ys, __m512d zs) {
    const __m512d dx = _mm512_sub_pd(x, xs);
    const __m512d dy = _mm512_sub_pd(y, ys);
    const __m512d dz = _mm512_sub_pd(z, zs);
    const __m512d tiny = _mm512_set1_pd(0x1p-1000); /* coincident points must not make infinities */
    const __m512d square = _mm512_fmadd_pd(dx, dx, _mm512_fmadd_pd(dy, dy, _mm512_fmadd_pd(dz, dz, tiny)));
    const __m512d inverse = _mm512_rsqrt14_pd(square);
    const __m512d root = _mm512_mul_pd(square, inverse);
    const __m512d e = _mm512_fnmadd_pd(root, inverse, _mm512_set1_pd(1.0));
    const __m512d tail = _mm512_fmadd_pd(e, _mm512_set1_pd(0.3125), _mm512_set1_pd(0.375));
    return (estimate){root, _mm512_mul_pd(root, e), _mm512_fmadd_pd(e, tail, _mm512_set1_pd(0.5))};
}

enum { ROWS = 4 };

/* Four rows against all columns of a tile off the diagonal. */
static inline aur_twofold four_rows(const aur_axes *axes, size_t row, size_t first, size_t last) {
    __m512d x[ROWS], y[ROWS], z[ROWS], sum[ROWS], correction[ROWS];
    for (size_t r = 0; r < ROWS; ++r) {
        x[r] = _mm512_set1_pd(axes->x[row + r]);
        y[r] = _mm512_set1_pd(axes->y[row + r]);
        z[r] = _mm512_set1_pd(axes->z[row + r]);
        sum[r] = correction[r] = _mm512_setzero_pd();
    }
    size_t j = first;
    for (; j + 8 <= last; j += 8) {
        const __m512d xs = _mm512_load_pd(axes->x + j);
        const __m512d ys = _mm512_load_pd(axes->y + j);
        const __m512d zs = _mm512_load_pd(axes->z + j);
        for (size_t r = 0; r < ROWS; ++r) {
            const estimate d = distances(x[r], y[r], z[r], xs, ys, zs);
            sum[r] = _mm512_add_pd(sum[r], d.root);
            correction[r] = _mm512_fmadd_pd(d.part, d.series, correction[r]);
        }
    }
    if (j < last) {
        const __mmask8 mask = (__mmask8)((1u << (last - j)) - 1u);
        const __m512d xs = _mm512_load_pd(axes->x + j);
        const __m512d ys = _mm512_load_pd(axes->y + j);
        const __m512d zs = _mm512_load_pd(axes->z + j);
        for (size_t r = 0; r < ROWS; ++r) {
            const estimate d = distances(x[r], y[r], z[r], xs, ys, zs);
            sum[r] = _mm512_mask_add_pd(sum[r], mask, sum[r], d.root);
            correction[r] = _mm512_mask3_fmadd_pd(d.part, d.series, correction[r], mask);
        }
    }
    aur_twofold total = {0.0, 0.0};
    for (size_t r = 0; r < ROWS; ++r)
        total = aur_twofold_add(
            total, aur_two_sum(_mm512_reduce_add_pd(sum[r]), _mm512_reduce_add_pd(correction[r])));
    return total;
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

const aur_distance_kernels aur_distance_avx512 = {distance_tile, fast_tile};
