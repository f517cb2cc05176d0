#include "points/quadrature/exact/fast.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/parallel.h"
#include "points/base/vector.h"

enum { WIDTH = AUR_WINDOW_WIDTH, BAND = 64, LANE = 16 };

/* A point's place: its first cell, and the window at its cells, theta first. */
typedef struct spot {
    size_t index, row, column;
    double window[2][WIDTH];
} spot;

struct aur_fast_transform {
    const aur_basis *basis;
    size_t count, threads;
    aur_progress progress;
    aur_window shape;
    size_t side;            /* cells around the torus */
    size_t rows;            /* of the half torus and a window: row r is the angle (r - WIDTH) 2 pi / side */
    size_t stride;          /* of a row: side cells and, behind them, the first WIDTH once more */
    size_t rings;           /* theta = 0 to pi in steps of the grid, and zeros up to a multiple of LANE */
    spot *spots;            /* count, by rows */
    size_t *first;          /* rows + 1: the first spot of each row */
    double *grid;           /* rows * stride */
    double *re, *im;        /* (degree + 1) * side: order after order */
    double *turns, *window; /* of Fourier transforms; the window's own transform, degree + 1, inverted */
    double *z, *start;      /* rings; (degree + 1) * rings */
    double *storage;
    const double *from;
    double *to;
};

/* --- making it */

/* Spots in the order of their rows, and of points in a row. */
static void fill_spots(aur_fast_transform *f, const aur_polar_points *points, size_t *row_of) {
    const double cells = (double)f->side / (2.0 * AUR_PI);
    for (size_t i = 0; i < f->count; ++i) {
        const double cell = atan2(points->sine[i], points->z[i]) * cells;
        row_of[i] = (size_t)(ceil(cell - 0.5 * WIDTH) + WIDTH);
        ++f->first[row_of[i] + 1];
    }
    for (size_t r = 0; r < f->rows; ++r)
        f->first[r + 1] += f->first[r];
    for (size_t i = 0; i < f->count; ++i) {
        spot *const s = f->spots + f->first[row_of[i]]++;
        const double theta = atan2(points->sine[i], points->z[i]);
        const double phi = atan2(points->azimuth_sine[i], points->cosine[i]);
        s->index = i;
        s->row = row_of[i];
        aur_window_fill(&f->shape, theta * cells, s->window[0]);
        const double column =
            aur_window_fill(&f->shape, (phi < 0.0 ? phi + 2.0 * AUR_PI : phi) * cells, s->window[1]);
        s->column = (size_t)(column + (double)f->side) % f->side;
    }
    memmove(f->first + 1, f->first, f->rows * sizeof *f->first);
    f->first[0] = 0;
}

static void fill_rings(aur_fast_transform *f) {
    for (size_t j = 0; j < f->rings; ++j) {
        const double theta = 2.0 * AUR_PI * (double)j / (double)f->side;
        const bool there = j <= f->side / 2;
        const double sine = there && j > 0 && j < f->side / 2 ? sin(theta) : 0.0;
        f->z[j] = there ? cos(theta) : 0.0;
        double start = there ? 1.0 : 0.0;
        for (size_t m = 0; m <= f->basis->degree; ++m) {
            if (m > 0)
                start *= f->basis->start[m] * sine;
            start = start < 1e-280 ? 0.0 : start; /* as in transform_kernel.c */
            f->start[m * f->rings + j] = start;
        }
    }
}

static bool allocate(aur_fast_transform *f) {
    const size_t orders = f->basis->degree + 1;
    const size_t doubles =
        f->rows * f->stride + 2 * orders * f->side + 2 * f->side + orders + (orders + 1) * f->rings;
    f->storage = calloc(doubles, sizeof *f->storage);
    f->spots = malloc(f->count * sizeof *f->spots);
    f->first = calloc(f->rows + 2, sizeof *f->first);
    if (f->storage == NULL || f->spots == NULL || f->first == NULL)
        return false;
    f->grid = f->storage;
    f->re = f->grid + f->rows * f->stride;
    f->im = f->re + orders * f->side;
    f->turns = f->im + orders * f->side;
    f->window = f->turns + 2 * f->side;
    f->z = f->window + orders;
    f->start = f->z + f->rings;
    return true;
}

aur_result aur_fast_transform_create(const aur_basis *basis, const aur_polar_points *points, size_t threads,
                                     aur_progress progress, aur_fast_transform **fast, aur_error *error) {
    aur_fast_transform *const f = calloc(1, sizeof *f);
    *fast = f;
    if (f == NULL)
        return aur_fail_memory(error);
    f->basis = basis;
    f->count = points->count;
    f->threads = threads;
    f->progress = progress;
    f->shape = aur_window_make(basis->degree);
    f->side = f->shape.side;
    f->rows = f->side / 2 + 2 * WIDTH;
    f->stride = f->side + WIDTH;
    f->rings = (f->side / 2 + LANE) / LANE * LANE;
    size_t *const row_of = malloc(f->count * sizeof *row_of);
    if (row_of == NULL || !allocate(f)) {
        free(row_of);
        aur_fast_transform_destroy(f);
        *fast = NULL;
        return aur_fail_memory(error);
    }
    aur_fourier_prepare(f->side, f->turns);
    aur_window_invert(&f->shape, basis->degree, f->window);
    fill_spots(f, points, row_of);
    fill_rings(f);
    free(row_of);
    return AUR_OK;
}

void aur_fast_transform_destroy(aur_fast_transform *fast) {
    if (fast == NULL)
        return;
    free(fast->storage);
    free(fast->spots);
    free(fast->first);
    free(fast);
}

/* --- the steps, each of items that are independent */

static aur_result run(aur_fast_transform *f, size_t items, aur_parallel_function step, aur_error *error) {
    const aur_parallel_options options = {
        .threads = f->threads, .what = "transforming", .progress = f->progress};
    return aur_parallel_for(&options, items, step, f, error);
}

static size_t bands(const aur_fast_transform *f) {
    return (f->rows + BAND - 1) / BAND;
}

/* Weights to the rows of one band, spot after spot. */
static aur_result spread(void *context, size_t band) {
    aur_fast_transform *const f = context;
    const size_t from = band * BAND, to = from + BAND < f->rows ? from + BAND : f->rows;
    memset(f->grid + from * f->stride, 0, (to - from) * f->stride * sizeof *f->grid);
    const size_t lowest = from > WIDTH - 1 ? from - (WIDTH - 1) : 0;
    for (size_t i = f->first[lowest]; i < f->first[to]; ++i) {
        const spot *const s = f->spots + i;
        const double weight = f->from[s->index];
        for (size_t k = 0; k < WIDTH; ++k) {
            const size_t row = s->row + k;
            if (row < from || row >= to)
                continue;
            double *const cells = f->grid + row * f->stride + s->column;
            const double part = weight * s->window[0][k];
            for (size_t c = 0; c < WIDTH; ++c)
                cells[c] += part * s->window[1][c];
        }
    }
    for (size_t row = from; row < to; ++row)
        for (size_t c = 0; c < WIDTH; ++c)
            f->grid[row * f->stride + c] += f->grid[row * f->stride + f->side + c];
    return AUR_OK;
}

static aur_result gather(void *context, size_t band) {
    aur_fast_transform *const f = context;
    const size_t from = band * BAND, to = from + BAND < f->rows ? from + BAND : f->rows;
    for (size_t i = f->first[from]; i < f->first[to]; ++i) {
        const spot *const s = f->spots + i;
        double columns[WIDTH] = {0}, sum = 0.0;
        for (size_t k = 0; k < WIDTH; ++k) {
            const double *const cells = f->grid + (s->row + k) * f->stride + s->column;
            for (size_t c = 0; c < WIDTH; ++c)
                columns[c] += s->window[0][k] * cells[c];
        }
        for (size_t c = 0; c < WIDTH; ++c)
            sum += columns[c] * s->window[1][c];
        f->to[s->index] = sum;
    }
    return AUR_OK;
}

/* The place of a row on the torus. */
static size_t around(const aur_fast_transform *f, size_t row) {
    return (row + f->side - WIDTH) % f->side;
}

/* Two rows of the grid, as real and imaginary parts, to the sums over columns of e^{-i m phi}. */
static aur_result analyse_rows(void *context, size_t pair) {
    aur_fast_transform *const f = context;
    const size_t n = f->side;
    double *const work = malloc(4 * n * sizeof *work);
    if (work == NULL)
        return AUR_ERROR_MEMORY;
    double *const re = work + 2 * n, *const im = re + n;
    double *const first = f->grid + 2 * pair * f->stride, *const second = first + f->stride;
    memcpy(re, first, n * sizeof *re);
    memcpy(im, second, n * sizeof *im);
    aur_fourier(n, f->turns, im, re, work); /* exchanged: the other sign */
    for (size_t m = 0; m <= f->basis->degree; ++m) {
        const size_t other = (n - m) % n, a = around(f, 2 * pair), b = around(f, 2 * pair + 1);
        double *const to_re = f->re + m * n, *const to_im = f->im + m * n;
        to_re[a] = 0.5 * (re[m] + re[other]);
        to_im[a] = 0.5 * (im[m] - im[other]);
        to_re[b] = 0.5 * (im[m] + im[other]);
        to_im[b] = 0.5 * (re[other] - re[m]);
    }
    free(work);
    return AUR_OK;
}

/* From the real parts of sums over orders of e^{i m phi} to two rows of the grid. */
static aur_result synthesise_rows(void *context, size_t pair) {
    aur_fast_transform *const f = context;
    const size_t n = f->side;
    double *const work = calloc(4 * n, sizeof *work);
    if (work == NULL)
        return AUR_ERROR_MEMORY;
    double *const re = work + 2 * n, *const im = re + n;
    double *const first = f->grid + 2 * pair * f->stride, *const second = first + f->stride;
    const size_t a = around(f, 2 * pair), b = around(f, 2 * pair + 1);
    for (size_t m = 0; m <= f->basis->degree; ++m) {
        const double *const from_re = f->re + m * n, *const from_im = f->im + m * n;
        const size_t other = (n - m) % n;
        /* x + i y of two real rows; order 0 meets itself. */
        re[m] += 0.5 * (from_re[a] - from_im[b]);
        im[m] += 0.5 * (from_im[a] + from_re[b]);
        re[other] += 0.5 * (from_re[a] + from_im[b]);
        im[other] += 0.5 * (from_re[b] - from_im[a]);
    }
    aur_fourier(n, f->turns, re, im, work);
    memcpy(first, re, n * sizeof *re);
    memcpy(second, im, n * sizeof *im);
    memcpy(first + n, re, WIDTH * sizeof *re);
    memcpy(second + n, im, WIDTH * sizeof *im);
    free(work);
    return AUR_OK;
}

/* Divides the frequencies by those of the window, and ends them at the degree. */
static void filter(const aur_fast_transform *f, size_t m, double *re, double *im) {
    const size_t n = f->side, degree = f->basis->degree;
    for (size_t k = 0; k < n; ++k) {
        const size_t frequency = k < n - k ? k : n - k;
        const double factor = frequency <= degree ? f->window[frequency] * f->window[m] / (double)n : 0.0;
        re[k] *= factor;
        im[k] *= factor;
    }
}

static aur_transform_order order_of(const aur_fast_transform *f, size_t m, double *a, double *b) {
    return (aur_transform_order){f->basis->degree + 1 - m,
                                 f->basis->steps + aur_basis_at(f->basis->degree, m),
                                 f->rings,
                                 f->z,
                                 f->start + m * f->rings,
                                 a,
                                 b};
}

/* Room for a Fourier transform, a and b of the rings, and sums of one order. */
static double *order_room(const aur_fast_transform *f) {
    return calloc(2 * f->side + 2 * f->rings + 16 * (f->basis->degree + 1), sizeof(double));
}

static aur_result analyse_column(void *context, size_t m) {
    aur_fast_transform *const f = context;
    const size_t n = f->side, half = n / 2;
    double *const work = order_room(f);
    if (work == NULL)
        return AUR_ERROR_MEMORY;
    double *const re = f->re + m * n, *const im = f->im + m * n, *const a = work + 2 * n;
    double *const b = a + f->rings;
    aur_fourier(n, f->turns, im, re, work);
    filter(f, m, re, im);
    aur_fourier(n, f->turns, re, im, work);
    /* theta and 2 pi - theta have one ring, where the functions of odd order change sign. */
    const double sign = m % 2 == 0 ? 1.0 : -1.0;
    for (size_t j = 0; j <= half; ++j) {
        const bool alone = j == 0 || j == half;
        a[j] = re[j] + (alone ? 0.0 : sign * re[n - j]);
        b[j] = -(im[j] + (alone ? 0.0 : sign * im[n - j]));
    }
    const aur_transform_order order = order_of(f, m, a, b);
    double *const sums = f->to + 2 * aur_basis_at(f->basis->degree, m);
    memset(sums, 0, 2 * order.degrees * sizeof *sums);
    AUR_KERNEL_HERE(aur_transform_kernel).analyse_order(&order, sums, b + f->rings);
    free(work);
    return AUR_OK;
}

static aur_result synthesise_column(void *context, size_t m) {
    aur_fast_transform *const f = context;
    const size_t n = f->side, half = n / 2;
    double *const work = order_room(f);
    if (work == NULL)
        return AUR_ERROR_MEMORY;
    double *const re = f->re + m * n, *const im = f->im + m * n, *const a = work + 2 * n;
    double *const b = a + f->rings;
    const aur_transform_order order = order_of(f, m, a, b);
    AUR_KERNEL_HERE(aur_transform_kernel)
        .synthesise_order(&order, f->from + 2 * aur_basis_at(f->basis->degree, m));
    const double sign = m % 2 == 0 ? 1.0 : -1.0;
    for (size_t j = 0; j <= half; ++j) {
        re[j] = a[j];
        im[j] = -b[j];
        if (j > 0 && j < half) {
            re[n - j] = sign * a[j];
            im[n - j] = -sign * b[j];
        }
    }
    aur_fourier(n, f->turns, im, re, work);
    filter(f, m, re, im);
    aur_fourier(n, f->turns, re, im, work);
    free(work);
    return AUR_OK;
}

aur_result aur_fast_transform_analyse(aur_fast_transform *fast, const double *weights, double *coefficients,
                                      aur_error *error) {
    const size_t cells = (fast->basis->degree + 1) * fast->side;
    fast->from = weights;
    fast->to = coefficients;
    memset(fast->re, 0, 2 * cells * sizeof *fast->re);
    aur_result result = run(fast, bands(fast), spread, error);
    if (result == AUR_OK)
        result = run(fast, fast->rows / 2, analyse_rows, error);
    return result == AUR_OK ? run(fast, fast->basis->degree + 1, analyse_column, error) : result;
}

aur_result aur_fast_transform_synthesise(aur_fast_transform *fast, const double *coefficients, double *values,
                                         aur_error *error) {
    fast->from = coefficients;
    fast->to = values;
    aur_result result = run(fast, fast->basis->degree + 1, synthesise_column, error);
    if (result == AUR_OK)
        result = run(fast, fast->rows / 2, synthesise_rows, error);
    return result == AUR_OK ? run(fast, bands(fast), gather, error) : result;
}
