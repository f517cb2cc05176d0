/* The nearest spherical Fibonacci point, eight directions at a time: the operations of nearest_index in
 * inverse.c, one for one. */
#if defined(__x86_64__)

#include "sphere/nearest/inverse.h"
#include "sphere/phase_avx512.h"

static inline __m512d set(double value) {
    return _mm512_set1_pd(value);
}

static inline __m512d absolute(__m512d value) {
    return _mm512_abs_pd(value);
}

static inline __m512d azimuth8(__m512d x, __m512d y) {
    const __m512d a = absolute(x);
    const __m512d b = absolute(y);
    const __mmask8 wide = _mm512_cmp_pd_mask(a, b, _CMP_GT_OQ);
    const __m512d longer = _mm512_mask_blend_pd(wide, b, a);
    const __m512d shorter = _mm512_mask_blend_pd(wide, a, b);
    const __mmask8 steep =
        _mm512_cmp_pd_mask(shorter, _mm512_mul_pd(set(0.41421356237309503), longer), _CMP_GT_OQ);
    const __m512d above = _mm512_mask_sub_pd(shorter, steep, shorter, longer);
    const __m512d below = _mm512_mask_add_pd(longer, steep, shorter, longer);
    const __mmask8 regular = _mm512_cmp_pd_mask(below, set(0.0), _CMP_GT_OQ);
    const __m512d t = _mm512_div_pd(above, _mm512_mask_blend_pd(regular, set(1.0), below));
    const __m512d q = _mm512_mul_pd(t, t);
    static const double coefficients[] = {AUR_AZIMUTH_COEFFICIENTS};
    __m512d p = set(coefficients[0]);
    for (size_t i = 1; i < sizeof coefficients / sizeof coefficients[0]; ++i)
        p = aur_phase_step8(p, q, set(coefficients[i]));
    p = aur_phase_step8(p, t, _mm512_maskz_mov_pd(steep, set(0.125)));
    p = _mm512_mask_sub_pd(p, (__mmask8)~wide, set(0.25), p);
    p = _mm512_mask_sub_pd(p, _mm512_cmp_pd_mask(x, set(0.0), _CMP_LT_OQ), set(0.5), p);
    return _mm512_mask_sub_pd(p, _mm512_cmp_pd_mask(y, set(0.0), _CMP_LT_OQ), set(0.0), p);
}

static inline __m512i zone8(double whole, __m512d sine_squared) {
    const __m512d v = _mm512_add_pd(_mm512_mul_pd(set(AUR_ZONE_SCALE * whole), sine_squared), set(1.0));
    const __m512d m = _mm512_sub_pd(_mm512_getmant_pd(v, _MM_MANT_NORM_1_2, _MM_MANT_SIGN_src), set(1.0));
    static const double coefficients[] = {AUR_ZONE_COEFFICIENTS};
    __m512d fraction = set(coefficients[0]);
    for (size_t i = 1; i < sizeof coefficients / sizeof coefficients[0]; ++i)
        fraction = aur_phase_step8(fraction, m, set(coefficients[i]));
    const __m512d k = _mm512_mul_pd(_mm512_add_pd(_mm512_getexp_pd(v), fraction), set(AUR_ZONE_PACE));
    return _mm512_max_epi64(_mm512_cvttpd_epi64(k), _mm512_set1_epi64(2));
}

typedef struct triple8 {
    __m512d x, y, z;
} triple8;

/* Eight triples to eight x, y and z. */
static inline triple8 load(const double *xyz) {
    const __m512i at = _mm512_setr_epi64(0, 3, 6, 9, 12, 15, 18, 21);
    return (triple8){_mm512_i64gather_pd(at, xyz, 8), _mm512_i64gather_pd(at, xyz + 1, 8),
                     _mm512_i64gather_pd(at, xyz + 2, 8)};
}

static inline __m512d nearest8(const aur_sphere_lattice *lattice, triple8 q) {
    const __m512d step = set(lattice->step);
    const __m512d across = aur_phase_step8(q.x, q.x, _mm512_mul_pd(q.y, q.y));
    const __mmask8 upper = _mm512_cmp_pd_mask(q.z, set(0.0), _CMP_GT_OQ);
    const __m512d depth =
        _mm512_mask_div_pd(_mm512_sub_pd(set(1.0), q.z), upper, across, _mm512_add_pd(set(1.0), q.z));
    const __m512d index = _mm512_sub_pd(_mm512_div_pd(depth, step), set(0.5));
    const __m512d turns = azimuth8(q.x, q.y);
    const __m512i k = zone8(lattice->whole, across);
    const __m512d f0 = _mm512_i64gather_pd(k, aur_sphere_lattice_fibonacci, 8);
    const __m512d f1 = _mm512_i64gather_pd(k, aur_sphere_lattice_fibonacci + 1, 8);
    const __m512d e0 = _mm512_i64gather_pd(k, aur_sphere_lattice_turns, 8);
    const __m512d e1 = _mm512_i64gather_pd(k, aur_sphere_lattice_turns + 1, 8);
    const __m512d sign =
        _mm512_mask_blend_pd(_mm512_cmp_pd_mask(e0, set(0.0), _CMP_GT_OQ), set(1.0), set(-1.0));
    const __m512d r0 = _mm512_sub_pd(_mm512_mul_pd(index, e1), _mm512_mul_pd(f1, turns));
    const __m512d r1 = _mm512_sub_pd(_mm512_mul_pd(f0, turns), _mm512_mul_pd(e0, index));
    const __m512d c0 = _mm512_floor_pd(_mm512_mul_pd(r0, sign));
    const __m512d c1 = _mm512_floor_pd(_mm512_mul_pd(r1, sign));
    const __m512d corner = aur_phase_step8(c0, f0, _mm512_mul_pd(c1, f1));
    const __m512d far = set(1e300);
    __m512d best = far;
    __m512d nearest = set(-1.0);
    __m512d highest = set(-1.0);
    for (int i = 0; i < 4; ++i) {
        const __m512d along = (i & 1) != 0 ? _mm512_add_pd(corner, f0) : corner;
        const __m512d j = (i & 2) != 0 ? _mm512_add_pd(along, f1) : along;
        const __mmask8 inside = _mm512_cmp_pd_mask(j, set(0.0), _CMP_GE_OQ) &
                                _mm512_cmp_pd_mask(j, set(lattice->whole), _CMP_LT_OQ);
        const __m512d clamped = _mm512_maskz_mov_pd(inside, j);
        const __m512d down = _mm512_mul_pd(_mm512_add_pd(clamped, set(0.5)), step);
        const __m512d radius = _mm512_sqrt_pd(_mm512_mul_pd(down, _mm512_sub_pd(set(2.0), down)));
        __m512d sine, cosine;
        aur_phase_sincos8(
            _mm512_mullo_epi64(_mm512_cvttpd_epi64(clamped), _mm512_set1_epi64((int64_t)AUR_GOLDEN_PHASE)),
            &sine, &cosine);
        const __m512d x = _mm512_sub_pd(_mm512_mul_pd(radius, cosine), q.x);
        const __m512d y = _mm512_sub_pd(_mm512_mul_pd(radius, sine), q.y);
        const __m512d z = _mm512_sub_pd(_mm512_sub_pd(set(1.0), down), q.z);
        const __m512d square = _mm512_add_pd(aur_phase_step8(x, x, _mm512_mul_pd(y, y)), _mm512_mul_pd(z, z));
        const __m512d distance = _mm512_mask_blend_pd(inside, far, square);
        const __mmask8 closer =
            _mm512_cmp_pd_mask(distance, best, _CMP_LT_OQ) |
            (_mm512_cmp_pd_mask(distance, best, _CMP_EQ_OQ) & _mm512_cmp_pd_mask(j, nearest, _CMP_LT_OQ));
        best = _mm512_mask_blend_pd(closer, best, distance);
        nearest = _mm512_mask_blend_pd(closer, nearest, j);
        highest = _mm512_max_pd(j, highest);
    }
    if (lattice->limit == lattice->whole)
        return nearest;
    const __mmask8 undecided = _mm512_cmp_pd_mask(highest, set(lattice->limit), _CMP_GE_OQ);
    return _mm512_mask_blend_pd(undecided, nearest, set(-1.0));
}

void aur_sphere_lattice_nearest_avx512(const aur_sphere_lattice *lattice, size_t count, const double *xyz,
                                       double *indices) {
    size_t i = 0;
    for (; i + 8 <= count; i += 8)
        _mm512_storeu_pd(indices + i, nearest8(lattice, load(xyz + 3 * i)));
    aur_sphere_lattice_nearest_portable(lattice, count - i, xyz + 3 * i, indices + i);
}

#else

#include "sphere/nearest/inverse.h"

/* Never chosen on other processors. */
void aur_sphere_lattice_nearest_avx512(const aur_sphere_lattice *lattice, size_t count, const double *xyz,
                                       double *indices) {
    aur_sphere_lattice_nearest_portable(lattice, count, xyz, indices);
}

#endif
