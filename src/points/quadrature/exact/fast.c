#include "points/quadrature/exact/fast.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/parallel.h"
#include "points/base/vector.h"

enum { WIDTH = AUR_WINDOW_WIDTH, BAND = 64, LANE = 16 };

struct aur_fast_transform {
    const aur_basis *basis;
    size_t count, threads;
    aur_progress progress;
    aur_window shape;
    size_t side;     /* cells around the torus */
    size_t rows;     /* of the half torus and a window: row r is the angle (r - WIDTH) 2 pi / side */
    size_t stride;   /* of a row: side cells, followed by a copy of the first WIDTH */
    size_t pitch;    /* of the sums of one order: not a multiple of a page */
    size_t turn;     /* rings around the torus, enough for the degree */
    size_t rings;    /* theta = 0 to pi / 2 in steps of 2 pi / turn, and zeros up to a multiple of LANE */
    aur_spot *spots; /* count, by rows */
    size_t *first;   /* rows + 1: the first spot of each row */
    double *grid;    /* rows * stride */
    double *re, *im; /* (degree + 1) * pitch: order after order */
    double *turns, *window; /* of Fourier transforms; the window's own transform, degree + 1, inverted */
    double *ring_turns;
    double *z, *start; /* rings; (degree + 1) * rings */
    double *storage;
    const double *from;
    double *to;
};

/* --- creation */

/* Sorts points by their keys below `keys`, stably; from[keys + 1] are the beginnings of each key. */
static void sort_by(size_t count, const uint32_t *key, const uint32_t *order, size_t keys, size_t *from,
                    uint32_t *sorted) {
    memset(from, 0, (keys + 2) * sizeof *from);
    for (size_t i = 0; i < count; ++i)
        ++from[key[i] + 2];
    for (size_t k = 0; k < keys; ++k)
        from[k + 2] += from[k + 1];
    for (size_t i = 0; i < count; ++i) {
        const uint32_t at = order != NULL ? order[i] : (uint32_t)i;
        sorted[from[key[at] + 1]++] = at;
    }
}

/* Spots in the order of their rows, and of columns in a row. */
static void fill_spots(aur_fast_transform *f, const aur_polar_points *points, size_t *starts, double *angles,
                       uint32_t *keys) {
    const double cells = (double)f->side / (2.0 * AUR_PI);
    uint32_t *const row = keys, *const column = keys + f->count, *const across = column + f->count;
    uint32_t *const sorted = across + f->count;
    for (size_t i = 0; i < f->count; ++i) {
        const double theta = atan2(points->sine[i], points->z[i]);
        const double phi = atan2(points->azimuth_sine[i], points->cosine[i]);
        angles[2 * i] = theta * cells;
        angles[2 * i + 1] = (phi < 0.0 ? phi + 2.0 * AUR_PI : phi) * cells;
        row[i] = (uint32_t)(ceil(angles[2 * i] - 0.5 * WIDTH) + WIDTH);
        column[i] = (uint32_t)((size_t)(ceil(angles[2 * i + 1] - 0.5 * WIDTH) + (double)f->side) % f->side);
    }
    sort_by(f->count, column, NULL, f->side, starts, across);
    sort_by(f->count, row, across, f->rows, f->first, sorted);
    for (size_t k = 0; k < f->count; ++k) {
        const size_t i = sorted[k];
        aur_spot *const s = f->spots + k;
        s->index = i;
        s->row = row[i];
        s->column = column[i];
        aur_window_fill(&f->shape, angles[2 * i], s->window[0]);
        aur_window_fill(&f->shape, angles[2 * i + 1], s->window[1]);
    }
}

static void fill_rings(aur_fast_transform *f) {
    for (size_t j = 0; j < f->rings; ++j) {
        const double theta = 2.0 * AUR_PI * (double)j / (double)f->turn;
        const bool there = j <= f->turn / 4;
        const double sine = there && j > 0 ? sin(theta) : 0.0;
        f->z[j] = there && j < f->turn / 4 ? cos(theta) : 0.0;
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
    const size_t doubles = f->rows * f->stride + 2 * orders * f->pitch + 2 * f->side + 2 * f->turn + orders +
                           (orders + 1) * f->rings;
    f->storage = calloc(doubles, sizeof *f->storage);
    f->spots = f->count < UINT32_MAX ? malloc(f->count * sizeof *f->spots) : NULL;
    f->first = calloc(f->rows + 2, sizeof *f->first);
    if (f->storage == NULL || f->spots == NULL || f->first == NULL)
        return false;
    f->grid = f->storage;
    f->re = f->grid + f->rows * f->stride;
    f->im = f->re + orders * f->pitch;
    f->turns = f->im + orders * f->pitch;
    f->ring_turns = f->turns + 2 * f->side;
    f->window = f->ring_turns + 2 * f->turn;
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
    f->pitch = f->side + 24;
    f->turn = aur_fourier_size(2 * basis->degree + 2);
    f->rings = (f->turn / 4 + LANE) / LANE * LANE;
    size_t *const starts = malloc((f->side + 2) * sizeof *starts + 4 * f->count * sizeof(double));
    if (starts == NULL || !allocate(f)) {
        free(starts);
        aur_fast_transform_destroy(f);
        *fast = NULL;
        return aur_fail_memory(error);
    }
    aur_fourier_prepare(f->side, f->turns);
    aur_fourier_prepare(f->turn, f->ring_turns);
    aur_window_invert(&f->shape, basis->degree, f->window);
    double *const angles = (double *)(void *)(starts + f->side + 2);
    fill_spots(f, points, starts, angles, (uint32_t *)(void *)(angles + 2 * f->count));
    fill_rings(f);
    free(starts);
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

/* Adds weights to the rows of one band, spot after spot. */
static aur_result spread(void *context, size_t band) {
    aur_fast_transform *const f = context;
    const size_t from = band * BAND, to = from + BAND < f->rows ? from + BAND : f->rows;
    memset(f->grid + from * f->stride, 0, (to - from) * f->stride * sizeof *f->grid);
    const size_t lowest = from > WIDTH - 1 ? from - (WIDTH - 1) : 0;
    AUR_KERNEL_HERE(aur_fast_kernel)
        .spread(f->first[to] - f->first[lowest], f->spots + f->first[lowest], f->from, from, to, f->stride,
                f->grid);
    for (size_t row = from; row < to; ++row)
        for (size_t c = 0; c < WIDTH; ++c)
            f->grid[row * f->stride + c] += f->grid[row * f->stride + f->side + c];
    return AUR_OK;
}

static aur_result gather(void *context, size_t band) {
    aur_fast_transform *const f = context;
    const size_t from = band * BAND, to = from + BAND < f->rows ? from + BAND : f->rows;
    AUR_KERNEL_HERE(aur_fast_kernel)
        .gather(f->first[to] - f->first[from], f->spots + f->first[from], f->stride, f->grid, f->to);
    return AUR_OK;
}

/* The position of a row on the torus. */
static size_t around(const aur_fast_transform *f, size_t row) {
    return (row + f->side - WIDTH) % f->side;
}

/* Transforms two rows of the grid, as real and imaginary parts, to sums over columns of e^{-i m phi}. */
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
        double *const to_re = f->re + m * f->pitch, *const to_im = f->im + m * f->pitch;
        to_re[a] = 0.5 * (re[m] + re[other]);
        to_im[a] = 0.5 * (im[m] - im[other]);
        to_re[b] = 0.5 * (im[m] + im[other]);
        to_im[b] = 0.5 * (re[other] - re[m]);
    }
    free(work);
    return AUR_OK;
}

/* Transforms the real parts of sums over orders of e^{i m phi} to two rows of the grid. */
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
        const double *const from_re = f->re + m * f->pitch, *const from_im = f->im + m * f->pitch;
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

/* Sums around the torus on two grids, of cells and of rings, each with scratch memory for a transform. */
typedef struct column {
    double *re, *im, *work; /* side */
    double *ring_re, *ring_im, *ring_work;
    double *room; /* of the sums of one order */
    aur_transform_order order;
} column;

/* Truncates the frequencies at the degree and divides them by those of the window. */
static void filter(const aur_fast_transform *f, size_t m, size_t from_size, const double *from,
                   size_t to_size, double *to) {
    const double scale = f->window[m] / (double)f->turn;
    memset(to, 0, to_size * sizeof *to);
    for (size_t k = 0; k <= f->basis->degree; ++k) {
        to[k] = from[k] * (f->window[k] * scale);
        if (k > 0)
            to[to_size - k] = from[from_size - k] * (f->window[k] * scale);
    }
}

/* In one allocation, which begins at c->work. */
static bool open_column(const aur_fast_transform *f, size_t m, column *c) {
    const size_t n = f->side, degree = f->basis->degree;
    double *const work = calloc(2 * n + 4 * f->turn + 4 * f->rings + 16 * (degree + 1), sizeof *work);
    double *const rings = work + 2 * n + 4 * f->turn;
    *c = (column){.work = work};
    if (work == NULL)
        return false;
    *c = (column){.re = f->re + m * f->pitch,
                  .im = f->im + m * f->pitch,
                  .work = work,
                  .ring_re = work + 2 * n,
                  .ring_im = work + 2 * n + f->turn,
                  .ring_work = work + 2 * n + 2 * f->turn,
                  .room = rings + 4 * f->rings,
                  .order = {.degrees = degree + 1 - m,
                            .steps = f->basis->steps + aur_basis_at(degree, m),
                            .count = f->rings,
                            .z = f->z,
                            .start = f->start + m * f->rings,
                            .a = {rings, rings + f->rings},
                            .b = {rings + 2 * f->rings, rings + 3 * f->rings}}};
    return true;
}

/* A ring's sums from both sides of the torus, where the functions of odd order change sign. */
static double both_sides(const aur_fast_transform *f, const double *around, size_t ring, size_t m) {
    const double other = ring == 0 || 2 * ring == f->turn ? 0.0 : around[f->turn - ring];
    return around[ring] + (m % 2 == 0 ? other : -other);
}

static aur_result analyse_column(void *context, size_t m) {
    aur_fast_transform *const f = context;
    const size_t n = f->side, turn = f->turn, half = turn / 2;
    column c;
    if (!open_column(f, m, &c))
        return AUR_ERROR_MEMORY;
    aur_fourier(n, f->turns, c.im, c.re, c.work);
    filter(f, m, n, c.re, turn, c.ring_re);
    filter(f, m, n, c.im, turn, c.ring_im);
    aur_fourier(turn, f->ring_turns, c.ring_re, c.ring_im, c.ring_work);
    /* A ring and its mirror image differ in the sign of every other degree. */
    for (size_t j = 0; j <= turn / 4; ++j) {
        const bool alone = 2 * j == half;
        const double a = both_sides(f, c.ring_re, j, m), b = -both_sides(f, c.ring_im, j, m);
        const double a_image = alone ? 0.0 : both_sides(f, c.ring_re, half - j, m);
        const double b_image = alone ? 0.0 : -both_sides(f, c.ring_im, half - j, m);
        c.order.a[0][j] = a + a_image;
        c.order.a[1][j] = a - a_image;
        c.order.b[0][j] = b + b_image;
        c.order.b[1][j] = b - b_image;
    }
    double *const sums = f->to + 2 * aur_basis_at(f->basis->degree, m);
    memset(sums, 0, 2 * c.order.degrees * sizeof *sums);
    AUR_KERNEL_HERE(aur_transform_kernel).analyse_order(&c.order, sums, c.room);
    free(c.work);
    return AUR_OK;
}

/* One of the two parts of a ring, of its mirror image and of both on the torus' other side. */
static void put_ring(const aur_fast_transform *f, size_t j, size_t m, double even, double odd,
                     double *around) {
    const size_t turn = f->turn, image = turn / 2 - j;
    const double sign = m % 2 == 0 ? 1.0 : -1.0;
    if (j > 0)
        around[turn - j] = sign * (even + odd);
    if (j > 0)
        around[turn - image] = sign * (even - odd);
    around[image] = even - odd;
    around[j] = even + odd;
}

static aur_result synthesise_column(void *context, size_t m) {
    aur_fast_transform *const f = context;
    const size_t n = f->side, turn = f->turn;
    column c;
    if (!open_column(f, m, &c))
        return AUR_ERROR_MEMORY;
    AUR_KERNEL_HERE(aur_transform_kernel)
        .synthesise_order(&c.order, f->from + 2 * aur_basis_at(f->basis->degree, m));
    for (size_t j = 0; j <= turn / 4; ++j) {
        put_ring(f, j, m, c.order.a[0][j], c.order.a[1][j], c.ring_re);
        put_ring(f, j, m, -c.order.b[0][j], -c.order.b[1][j], c.ring_im);
    }
    aur_fourier(turn, f->ring_turns, c.ring_im, c.ring_re, c.ring_work);
    filter(f, m, turn, c.ring_re, n, c.re);
    filter(f, m, turn, c.ring_im, n, c.im);
    aur_fourier(n, f->turns, c.re, c.im, c.work);
    free(c.work);
    return AUR_OK;
}

aur_result aur_fast_transform_analyse(aur_fast_transform *fast, const double *weights, double *coefficients,
                                      aur_error *error) {
    const size_t cells = (fast->basis->degree + 1) * fast->pitch;
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
