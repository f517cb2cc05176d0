/* Power spectra of point sets. A random set has the mean power 1 at all frequencies. The angular spectrum is
 * in spectrum_sphere.c. */

#include <math.h>
#include <stdlib.h>

#include "points/base/error.h"
#include "points/base/vector.h"
#include "points/quality/spectrum/gridded.h"

enum { BLOCK = 256, LANES = 8 };

/* Powers at the frequencies (kx, ky), 0 <= kx <= F, -F <= ky <= F, row by row: the others are mirror images.
 */
typedef struct periodogram {
    const aur_points_view *points;
    size_t limit; /* F */
    double *power;
} periodogram;

/* One block of points: e^{-2 pi i (kx x + ky y)} for growing ky and for falling ky, and the factors between
 * steps. */
typedef struct wave_block {
    double up_re[BLOCK], up_im[BLOCK], down_re[BLOCK], down_im[BLOCK], step_re[BLOCK], step_im[BLOCK];
} wave_block;

static void start_block(const aur_points_view *points, size_t first, size_t count, double kx,
                        wave_block *block) {
    for (size_t i = 0; i < BLOCK; ++i) {
        block->up_re[i] = block->up_im[i] = block->step_re[i] = block->step_im[i] = 0.0;
        if (i < count) {
            const double *const x = aur_point_at(points, first + i);
            const double weight = aur_weight_at(points, first + i);
            const double phase = kx * x[0];
            const double angle = -2.0 * AUR_PI * (phase - floor(phase));
            block->up_re[i] = weight * cos(angle);
            block->up_im[i] = weight * sin(angle);
            block->step_re[i] = cos(-2.0 * AUR_PI * x[1]);
            block->step_im[i] = sin(-2.0 * AUR_PI * x[1]);
        }
        block->down_re[i] = block->up_re[i];
        block->down_im[i] = block->up_im[i];
    }
}

static void add_block(const double *re, const double *im, double sum[2]) {
    double lanes_re[LANES] = {0}, lanes_im[LANES] = {0};
    for (size_t i = 0; i < BLOCK; i += LANES)
        for (size_t l = 0; l < LANES; ++l) {
            lanes_re[l] += re[i + l];
            lanes_im[l] += im[i + l];
        }
    for (size_t l = 0; l < LANES; ++l) {
        sum[0] += lanes_re[l];
        sum[1] += lanes_im[l];
    }
}

static void step_block(wave_block *block) {
    for (size_t i = 0; i < BLOCK; ++i) {
        const double a = block->up_re[i], b = block->up_im[i];
        block->up_re[i] = a * block->step_re[i] - b * block->step_im[i];
        block->up_im[i] = a * block->step_im[i] + b * block->step_re[i];
        const double c = block->down_re[i], d = block->down_im[i];
        block->down_re[i] = c * block->step_re[i] + d * block->step_im[i];
        block->down_im[i] = d * block->step_re[i] - c * block->step_im[i];
    }
}

static aur_result fill_row(void *context, size_t kx) {
    const periodogram *const work = context;
    const size_t limit = work->limit, count = work->points->count;
    double *const sums = calloc(2 * (2 * limit + 1), sizeof *sums);
    wave_block *const block = malloc(sizeof *block);
    const aur_result result = sums != NULL && block != NULL ? AUR_OK : AUR_ERROR_MEMORY;
    for (size_t first = 0; first < count && result == AUR_OK; first += BLOCK) {
        start_block(work->points, first, count - first < BLOCK ? count - first : BLOCK, (double)kx, block);
        add_block(block->up_re, block->up_im, sums + 2 * limit);
        for (size_t k = 1; k <= limit; ++k) {
            step_block(block);
            add_block(block->up_re, block->up_im, sums + 2 * (limit + k));
            add_block(block->down_re, block->down_im, sums + 2 * (limit - k));
        }
    }
    for (size_t k = 0; k < 2 * limit + 1 && result == AUR_OK; ++k)
        work->power[kx * (2 * limit + 1) + k] = sums[2 * k] * sums[2 * k] + sums[2 * k + 1] * sums[2 * k + 1];
    free(sums);
    free(block);
    return result;
}

static aur_result make_periodogram(const aur_measure_request *request, periodogram *p, aur_error *error) {
    const double target = ceil(2.0 * sqrt((double)request->points->count));
    double limit;
    aur_result result = aur_measure_number(request, 1.0, 16384.0, fmin(target, 16384.0), &limit, error);
    if (result != AUR_OK)
        return result;
    *p = (periodogram){request->points, (size_t)limit, NULL};
    const size_t count = (p->limit + 1) * (2 * p->limit + 1);
    p->power = aur_arena_allocate(request->arena, count * sizeof *p->power);
    if (p->power == NULL)
        return aur_fail_memory(error);
    result = aur_gridded_allowed(request)
                 ? aur_gridded_powers(request, p->limit, p->power, error)
                 : aur_measure_items(&request->options, "transforming", p->limit + 1, fill_row, p,
                                     (aur_parallel_slice){p->power, (2 * p->limit + 1) * sizeof *p->power,
                                                          count * sizeof *p->power},
                                     error);
    const double scale = 1.0 / aur_sum_of_squares(request->points);
    for (size_t i = 0; i < count && result == AUR_OK; ++i)
        p->power[i] *= scale;
    return result;
}

/* The ring of width 1 about an integer, or 0 when there is none. */
static size_t ring_of(const periodogram *p, size_t kx, size_t column) {
    const double ky = (double)column - (double)p->limit;
    const size_t ring = (size_t)floor(hypot((double)kx, ky) + 0.5);
    /* Half of the row kx = 0 is the mirror image of the other half. */
    return ring > p->limit || (kx == 0 && column <= p->limit) ? 0 : ring;
}

/* Adds up over each ring: the power (NULL), or its squared distance from the ring's mean; then divides by the
 * count. */
static void sum_rings(const periodogram *p, const double *means, double *sums, double *counts) {
    const size_t side = 2 * p->limit + 1;
    for (size_t kx = 0; kx <= p->limit; ++kx)
        for (size_t column = 0; column < side; ++column) {
            const size_t ring = ring_of(p, kx, column);
            const double power = p->power[kx * side + column];
            const double off = means != NULL ? power - means[ring] : 0.0;
            sums[ring] += means != NULL ? off * off : power;
            counts[ring] += 1.0;
        }
    for (size_t ring = 1; ring <= p->limit; ++ring)
        sums[ring] /= counts[ring];
}

/* Mean power of each ring, and the variance over the ring in squares of the mean. */
static aur_result radial(const aur_measure_request *request, aur_series *series, aur_error *error) {
    static const char *const columns[] = {"frequency", "power", "anisotropy"};
    periodogram p;
    aur_result result = make_periodogram(request, &p, error);
    if (result != AUR_OK)
        return result;
    const size_t rings = p.limit + 1;
    double *const sums = aur_arena_allocate(request->arena, 4 * rings * sizeof *sums);
    result = sums != NULL ? aur_series_create(series, p.limit, 3, columns, error) : aur_fail_memory(error);
    if (result == AUR_OK) {
        sum_rings(&p, NULL, sums, sums + 2 * rings);
        sum_rings(&p, sums, sums + rings, sums + 3 * rings);
    }
    for (size_t ring = 1; ring <= p.limit && result == AUR_OK; ++ring) {
        const double mean = sums[ring];
        double *const row = series->values + 3 * (ring - 1);
        row[0] = (double)ring;
        row[1] = mean;
        row[2] = mean > 0.0 ? sums[rings + ring] / (mean * mean) : 0.0;
    }
    return result;
}

static aur_result spectrum(const aur_measure_request *request, aur_series *series, aur_error *error) {
    return request->points->domain == AUR_DOMAIN_SQUARE ? radial(request, series, error)
                                                        : aur_angular_spectrum(request, series, error);
}

static aur_result full_periodogram(const aur_measure_request *request, aur_series *series, aur_error *error) {
    static const char *const columns[] = {"kx", "ky", "power"};
    periodogram p;
    aur_result result = make_periodogram(request, &p, error);
    if (result != AUR_OK)
        return result;
    const size_t side = 2 * p.limit + 1;
    result = aur_series_create(series, side * side, 3, columns, error);
    for (size_t i = 0; i < series->row_count && result == AUR_OK; ++i) {
        const size_t row = i / side, column = i % side;
        const size_t mirrored = row < p.limit;
        const size_t kx = mirrored ? p.limit - row : row - p.limit;
        series->values[3 * i] = (double)row - (double)p.limit;
        series->values[3 * i + 1] = (double)column - (double)p.limit;
        series->values[3 * i + 2] = p.power[kx * side + (mirrored ? side - 1 - column : column)];
    }
    return result;
}

const aur_measure_row aur_measure_spectrum = {
    {.row = {.name = "spectrum",
             .summary = "table of the power at frequencies up to F (2 sqrt N; 4 sqrt "
                        "N): radial mean on the square, by degree on the sphere",
             .source = "Ulichney 1988; Pilleboue 2015"},
     .parameter = "[:F]",
     .domains = "square, sphere, axes",
     .series = true},
    .tabulate = spectrum};

const aur_measure_row aur_measure_periodogram = {
    {.row = {.name = "periodogram",
             .summary = "table of the power at each frequency (kx, ky) up to F (2 sqrt N)",
             .source = "Ulichney 1988"},
     .parameter = "[:F]",
     .domains = "square",
     .series = true},
    .tabulate = full_periodogram};
