/* The distance kernels for AVX-512. */
#include "quality/distance_tile.h"

#if defined(__AVX512F__)
#include <immintrin.h>

aur_twofold aur_distance_tile_avx512(const aur_axes *axes, aur_tile tile, double parameter) {
    (void)parameter;
    return aur_distance_tile_body(axes, tile);
}

typedef struct estimate {
    __m512d root, correction;
} estimate;

/* |x_i - x_j| = root + correction for eight columns. With y0 = rsqrt14(d2) and e = 1 - d2 y0^2, |e| <= 2^-13,
 * sqrt(d2) = d2 y0 (1 + e/2 + 3/8 e^2 + 5/16 e^3 + O(e^4)), and what is left out is below 1e-16. */
static inline estimate distances(__m512d x, __m512d y, __m512d z, __m512d xs, __m512d ys, __m512d zs) {
    const __m512d dx = _mm512_sub_pd(x, xs);
    const __m512d dy = _mm512_sub_pd(y, ys);
    const __m512d dz = _mm512_sub_pd(z, zs);
    const __m512d square =
        _mm512_fmadd_pd(dx, dx, _mm512_fmadd_pd(dy, dy, _mm512_fmadd_pd(dz, dz, _mm512_set1_pd(0x1p-1000))));
    const __m512d inverse = _mm512_rsqrt14_pd(square);
    const __m512d root = _mm512_mul_pd(square, inverse);
    const __m512d e = _mm512_fnmadd_pd(root, inverse, _mm512_set1_pd(1.0));
    __m512d series = _mm512_fmadd_pd(e, _mm512_set1_pd(0.3125), _mm512_set1_pd(0.375));
    series = _mm512_fmadd_pd(e, series, _mm512_set1_pd(0.5));
    return (estimate){root, _mm512_mul_pd(_mm512_mul_pd(root, e), series)};
}

enum { ROWS = 4 };

/* Four rows against all columns of a tile off the diagonal. */
static inline aur_twofold four_rows(const aur_axes *axes, size_t row, size_t first, size_t last) {
    __m512d x[ROWS], y[ROWS], z[ROWS], sum[ROWS];
    __m512d correction = _mm512_setzero_pd();
    for (int r = 0; r < ROWS; ++r) {
        x[r] = _mm512_set1_pd(axes->x[row + (size_t)r]);
        y[r] = _mm512_set1_pd(axes->y[row + (size_t)r]);
        z[r] = _mm512_set1_pd(axes->z[row + (size_t)r]);
        sum[r] = _mm512_setzero_pd();
    }
    for (size_t j = first; j < last; j += 8) {
        const __mmask8 mask = (__mmask8)(last - j >= 8 ? 0xffu : (1u << (last - j)) - 1u);
        const __m512d xs = _mm512_load_pd(axes->x + j);
        const __m512d ys = _mm512_load_pd(axes->y + j);
        const __m512d zs = _mm512_load_pd(axes->z + j);
        for (int r = 0; r < ROWS; ++r) {
            const estimate d = distances(x[r], y[r], z[r], xs, ys, zs);
            sum[r] = _mm512_mask_add_pd(sum[r], mask, sum[r], d.root);
            correction = _mm512_mask_add_pd(correction, mask, correction, d.correction);
        }
    }
    aur_twofold total = {_mm512_reduce_add_pd(correction), 0.0};
    for (int r = 0; r < ROWS; ++r)
        total = aur_twofold_add(total, (aur_twofold){_mm512_reduce_add_pd(sum[r]), 0.0});
    return total;
}

aur_twofold aur_distance_tile_fast_avx512(const aur_axes *axes, aur_tile tile, double parameter) {
    (void)parameter;
    if (tile.first_row == tile.first_column)
        return aur_distance_tile_body(axes, tile);
    aur_twofold total = {0.0, 0.0};
    size_t i = tile.first_row;
    for (; i + ROWS <= tile.last_row; i += ROWS)
        total = aur_twofold_add(total, four_rows(axes, i, tile.first_column, tile.last_column));
    if (i < tile.last_row) {
        aur_lanes lanes = {{0}, {0}};
        for (; i < tile.last_row; ++i)
            aur_distance_row(axes, i, tile.first_column, tile.last_column, &lanes);
        total = aur_twofold_add(total, aur_lanes_total(&lanes));
    }
    return total;
}
#endif
