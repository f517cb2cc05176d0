/* The angular power spectrum by spherical harmonics (Pilleboue, Singh, Coeurjolly, Kazhdan and Ostromoukhov
 * 2015): S_l = 4 pi / (2l+1) sum over m of |sum_i w_i Y_lm(x_i)|^2 / sum_i w_i^2. */
#include <math.h>
#include <stdlib.h>

#include "points/base/error.h"
#include "points/base/vector.h"
#include "points/quadrature/exact/transform.h"
#include "points/quality/spectrum/gridded.h"
#include "points/quality/split/split.h"

enum {
    BLOCK = 128,
    LARGEST_DEGREE = 1800 /* beyond, sin^m theta underflows where Y_lm does not vanish */
};

typedef struct harmonics {
    const aur_points_view *points;
    size_t limit;  /* L */
    double *power; /* (L+1) * (L+1): |sum_i w_i Y_lm|^2, both signs of m together, at [m * (L+1) + l] */
} harmonics;

typedef struct harmonic_block {
    double z[BLOCK], re[BLOCK], im[BLOCK]; /* w e^{i m phi} */
    double before[BLOCK], here[BLOCK];     /* the Legendre functions of two degrees */
} harmonic_block;

static void start_block(const aur_points_view *points, size_t first, size_t count, size_t m, double factor,
                        harmonic_block *b) {
    for (size_t i = 0; i < BLOCK; ++i) {
        b->z[i] = b->re[i] = b->im[i] = b->before[i] = b->here[i] = 0.0;
        if (i >= count)
            continue;
        const double *const x = points->coordinates + 3 * (first + i);
        const double weight = aur_weight_at(points, first + i);
        const double angle = (double)m * atan2(x[1], x[0]);
        b->z[i] = x[2];
        b->re[i] = weight * cos(angle);
        b->im[i] = weight * sin(angle);
        b->here[i] = factor * pow(hypot(x[0], x[1]), (double)m);
    }
}

/* To the next degree: P_l = a (z P_{l-1} - b P_{l-2}) with full normalisation. */
static void step_block(harmonic_block *block, double a, double b) {
    for (size_t i = 0; i < BLOCK; ++i) {
        const double next = a * (block->z[i] * block->here[i] - b * block->before[i]);
        block->before[i] = block->here[i];
        block->here[i] = next;
    }
}

static void add_block(const harmonic_block *b, double sum[2]) {
    double re = 0.0, im = 0.0;
    for (size_t i = 0; i < BLOCK; ++i) {
        re += b->here[i] * b->re[i];
        im += b->here[i] * b->im[i];
    }
    sum[0] += re;
    sum[1] += im;
}

static aur_result fill_order(void *context, size_t m) {
    const harmonics *const work = context;
    const size_t limit = work->limit, count = work->points->count;
    double *const sums = calloc(2 * (limit + 1), sizeof *sums);
    if (sums == NULL)
        return AUR_ERROR_MEMORY;
    double factor = 1.0 / (4.0 * AUR_PI);
    for (size_t k = 1; k <= m; ++k)
        factor *= (2.0 * (double)k + 1.0) / (2.0 * (double)k);
    factor = sqrt(factor);
    const double order = (double)m;
    harmonic_block block;
    for (size_t first = 0; first < count; first += BLOCK) {
        start_block(work->points, first, count - first < BLOCK ? count - first : BLOCK, m, factor, &block);
        add_block(&block, sums + 2 * m);
        for (size_t degree = m + 1; degree <= limit; ++degree) {
            const double l = (double)degree;
            const double a = sqrt((4.0 * l * l - 1.0) / (l * l - order * order));
            const double b =
                sqrt(((l - 1.0) * (l - 1.0) - order * order) / (4.0 * (l - 1.0) * (l - 1.0) - 1.0));
            step_block(&block, a, degree > m + 1 ? b : 0.0);
            add_block(&block, sums + 2 * degree);
        }
    }
    for (size_t l = m; l <= limit; ++l)
        work->power[m * (limit + 1) + l] =
            (m > 0 ? 2.0 : 1.0) * (sums[2 * l] * sums[2 * l] + sums[2 * l + 1] * sums[2 * l + 1]);
    free(sums);
    return AUR_OK;
}

/* powers[l], 1 <= l <= L: the sum over all pairs of w_i w_j P_l(x_i . x_j), times (2l+1) / (4 pi). */
static aur_result sum_directly(const aur_measure_request *request, size_t limit, double *powers,
                               aur_error *error) {
    harmonics work = {request->points, limit, NULL};
    const size_t side = limit + 1;
    work.power = aur_arena_allocate(request->arena, side * side * sizeof *work.power);
    if (work.power == NULL)
        return aur_fail_memory(error);
    const aur_result result = aur_measure_items(
        &request->options, "transforming", side, fill_order, &work,
        (aur_parallel_slice){work.power, side * sizeof *work.power, side * side * sizeof *work.power}, error);
    for (size_t l = 1; l <= limit && result == AUR_OK; ++l) {
        powers[l] = 0.0;
        for (size_t m = 0; m <= l; ++m)
            powers[l] += work.power[m * side + l];
    }
    return result;
}

aur_result aur_angular_spectrum(const aur_measure_request *request, aur_series *series, aur_error *error) {
    static const char *const columns[] = {"degree", "power"};
    const bool fast = aur_gridded_allowed(request);
    const double most = fast ? AUR_BASIS_DEGREE_MAX : LARGEST_DEGREE;
    const double target = fmin(ceil(4.0 * sqrt((double)request->points->count)), most);
    double number;
    aur_result result = aur_measure_number(request, 1.0, LARGEST_DEGREE, target, &number, error);
    if (result != AUR_OK)
        return result;
    const size_t limit = (size_t)number;
    double *const powers = aur_arena_allocate(request->arena, (limit + 1) * sizeof *powers);
    if (powers == NULL)
        return aur_fail_memory(error);
    const bool by_grid = fast && limit <= AUR_BASIS_DEGREE_MAX;
    result = by_grid ? aur_powers_find(request->points, limit, request->options.threads, powers, error)
                     : sum_directly(request, limit, powers, error);
    if (result == AUR_OK)
        result = aur_series_create(series, limit, 2, columns, error);
    /* The two ends of an axis add up for even l and cancel for odd l. */
    const double ends = request->points->domain == AUR_DOMAIN_AXES ? 2.0 : 1.0;
    const double scale = (by_grid ? 1.0 : 4.0 * AUR_PI) / (ends * aur_sum_of_squares(request->points));
    for (size_t l = 1; l <= limit && result == AUR_OK; ++l) {
        series->values[2 * (l - 1)] = (double)l;
        series->values[2 * (l - 1) + 1] =
            by_grid ? scale * powers[l] : scale * powers[l] / (2.0 * (double)l + 1.0);
    }
    return result;
}
