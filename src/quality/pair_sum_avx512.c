/* The distance kernels for AVX-512. */
#include "quality/distance_tile.h"

#if defined(__AVX512F__)
#include <immintrin.h>

/* One row of the compensated kernel, in the order of operations of aur_distance_row: the same bits. */
static inline void compensated_row(const aur_axes *axes, size_t row, size_t first, size_t last, __m512d *sum,
                                   __m512d *error) {
    const __m512d x = _mm512_set1_pd(axes->x[row]);
    const __m512d y = _mm512_set1_pd(axes->y[row]);
    const __m512d z = _mm512_set1_pd(axes->z[row]);
    for (size_t j = first; j < last; j += 8) {
        const __mmask8 mask = (__mmask8)(last - j >= 8 ? 0xffu : (1u << (last - j)) - 1u);
        const __m512d dx = _mm512_sub_pd(x, _mm512_load_pd(axes->x + j));
        const __m512d dy = _mm512_sub_pd(y, _mm512_load_pd(axes->y + j));
        const __m512d dz = _mm512_sub_pd(z, _mm512_load_pd(axes->z + j));
        const __m512d plane = _mm512_add_pd(_mm512_mul_pd(dx, dx), _mm512_mul_pd(dy, dy));
        const __m512d square = _mm512_add_pd(plane, _mm512_mul_pd(dz, dz));
        __m512d distance = _mm512_maskz_sqrt_pd(mask, square);
        if (axes->weights != NULL) {
            const __m512d weight = _mm512_set1_pd(axes->weights[row]);
            distance = _mm512_mul_pd(distance, _mm512_mul_pd(weight, _mm512_load_pd(axes->weights + j)));
        }
        const __m512d next = _mm512_add_pd(*sum, distance);
        const __m512d part = _mm512_sub_pd(next, *sum);
        const __m512d lost =
            _mm512_add_pd(_mm512_sub_pd(*sum, _mm512_sub_pd(next, part)), _mm512_sub_pd(distance, part));
        *error = _mm512_add_pd(*error, lost);
        *sum = next;
    }
}

aur_twofold aur_distance_tile_avx512(const aur_axes *axes, aur_pair_tile tile, double parameter) {
    (void)parameter;
    const int diagonal = tile.first_row == tile.first_column;
    __m512d sum = _mm512_setzero_pd(), error = _mm512_setzero_pd();
    for (size_t i = tile.first_row; i < tile.last_row; ++i)
        compensated_row(axes, i, tile.first_column, diagonal ? i : tile.last_column, &sum, &error);
    aur_lanes lanes;
    _mm512_storeu_pd(lanes.sum, sum);
    _mm512_storeu_pd(lanes.error, error);
    return aur_lanes_total(&lanes);
}

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

aur_twofold aur_distance_tile_fast_avx512(const aur_axes *axes, aur_pair_tile tile, double parameter) {
    if (tile.first_row == tile.first_column)
        return aur_distance_tile_avx512(axes, tile, parameter);
    aur_twofold total = {0.0, 0.0};
    size_t i = tile.first_row;
    for (; i + ROWS <= tile.last_row; i += ROWS)
        total = aur_twofold_add(total, four_rows(axes, i, tile.first_column, tile.last_column));
    if (i < tile.last_row) {
        const aur_pair_tile rest = {i, tile.last_row, tile.first_column, tile.last_column};
        total = aur_twofold_add(total, aur_distance_tile_avx512(axes, rest, parameter));
    }
    return total;
}
#endif
