#include "points/quality/spectrum/gridded.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "points/quadrature/exact/fast.h"

enum { WIDTH = AUR_WINDOW_WIDTH, BAND = 64, FEWEST = 1024 };

bool aur_gridded_allowed(const aur_measure_request *request) {
    const aur_points_view *const points = request->points;
    double absolute = 0.0;
    for (size_t i = 0; i < points->count; ++i)
        absolute += fabs(aur_weight_at(points, i));
    /* The error e of a sum s in units of a random set; the error of its square is at most 2 s e + e^2. */
    const double error = AUR_WINDOW_ERROR * absolute / sqrt(aur_sum_of_squares(points));
    return points->count >= FEWEST && error * (2.0 + error) <= request->options.accuracy;
}

/* A grid of side * side cells; only one band of rows is stored at a time. */
typedef struct gridded {
    const aur_points_view *points;
    aur_window window;
    size_t limit;    /* F */
    size_t *order;   /* points by the first rows of their windows */
    size_t *first;   /* side + 1: the first point of each row */
    double *turns;   /* of Fourier transforms */
    double *factor;  /* limit + 1: of frequencies */
    double *re, *im; /* (limit + 1) * side: the rows' transforms, frequency after frequency */
    double *power;
} gridded;

static size_t around(const gridded *g, double cell) {
    const double side = (double)g->window.side;
    return (size_t)(cell - side * floor(cell / side));
}

static double cell_of(const gridded *g, size_t index, size_t axis) {
    const double x = aur_point_at(g->points, index)[axis];
    return (x - floor(x)) * (double)g->window.side;
}

static size_t row_of(const gridded *g, size_t index) {
    return around(g, ceil(cell_of(g, index, 1) - 0.5 * WIDTH));
}

/* Counts are shifted by two entries, so that filling leaves the start of each row in place. */
static void sort(gridded *g) {
    for (size_t i = 0; i < g->points->count; ++i)
        ++g->first[row_of(g, i) + 2];
    for (size_t r = 2; r < g->window.side + 2; ++r)
        g->first[r] += g->first[r - 1];
    for (size_t i = 0; i < g->points->count; ++i)
        g->order[g->first[row_of(g, i) + 1]++] = i;
}

/* Adds a point to the rows of the band that begins at `from`. */
static void spread(const gridded *g, size_t index, size_t from, double *band) {
    const size_t side = g->window.side;
    double rows[WIDTH], columns[WIDTH];
    const size_t row = around(g, aur_window_fill(&g->window, cell_of(g, index, 1), rows));
    const size_t column = around(g, aur_window_fill(&g->window, cell_of(g, index, 0), columns));
    const double weight = aur_weight_at(g->points, index);
    for (size_t k = 0; k < WIDTH; ++k) {
        const size_t there = (row + k + side - from) % side;
        if (there >= BAND)
            continue;
        double *const cells = band + there * (side + WIDTH) + column;
        for (size_t c = 0; c < WIDTH; ++c)
            cells[c] += weight * rows[k] * columns[c];
    }
}

/* Transforms two rows, as real and imaginary parts, and separates their frequencies 0 to F. */
static void transform_rows(const gridded *g, size_t row, double *re, double *im, double *work) {
    const size_t side = g->window.side;
    aur_fourier(side, g->turns, re, im, work);
    for (size_t k = 0; k <= g->limit; ++k) {
        const size_t other = (side - k) % side;
        double *const to_re = g->re + k * side + row, *const to_im = g->im + k * side + row;
        to_re[0] = 0.5 * (re[k] + re[other]);
        to_im[0] = 0.5 * (im[k] - im[other]);
        to_re[1] = 0.5 * (im[k] + im[other]);
        to_im[1] = 0.5 * (re[other] - re[k]);
    }
}

static aur_result fill_band(void *context, size_t item) {
    gridded *const g = context;
    const size_t side = g->window.side, stride = side + WIDTH, from = item * BAND;
    double *const band = calloc(BAND * stride + 2 * side, sizeof *band);
    if (band == NULL)
        return AUR_ERROR_MEMORY;
    for (size_t k = 0; k < BAND + WIDTH - 1; ++k) {
        const size_t row = (from + side + k - (WIDTH - 1)) % side;
        for (size_t i = g->first[row]; i < g->first[row + 1]; ++i)
            spread(g, g->order[i], from, band);
    }
    for (size_t row = 0; row < BAND; ++row)
        for (size_t c = 0; c < WIDTH; ++c)
            band[row * stride + c] += band[row * stride + side + c];
    for (size_t row = 0; row < BAND; row += 2)
        transform_rows(g, from + row, band + row * stride, band + (row + 1) * stride, band + BAND * stride);
    free(band);
    return AUR_OK;
}

static aur_result transform_column(void *context, size_t kx) {
    gridded *const g = context;
    const size_t side = g->window.side, limit = g->limit;
    double *const work = malloc(2 * side * sizeof *work);
    if (work == NULL)
        return AUR_ERROR_MEMORY;
    double *const re = g->re + kx * side, *const im = g->im + kx * side;
    aur_fourier(side, g->turns, re, im, work);
    for (size_t k = 0; k < 2 * limit + 1; ++k) {
        const size_t frequency = k < limit ? limit - k : k - limit;
        const size_t at = k < limit ? side - frequency : frequency;
        const double factor = g->factor[kx] * g->factor[frequency];
        g->power[kx * (2 * limit + 1) + k] = factor * factor * (re[at] * re[at] + im[at] * im[at]);
    }
    free(work);
    return AUR_OK;
}

aur_result aur_gridded_powers(const aur_measure_request *request, size_t limit, double *power,
                              aur_error *error) {
    gridded g = {.points = request->points, .window = aur_window_make(limit), .limit = limit, .power = power};
    const size_t side = g.window.side;
    double *const numbers = malloc((2 * side + limit + 1 + 2 * (limit + 1) * side) * sizeof *numbers);
    g.order = malloc(g.points->count * sizeof *g.order);
    g.first = calloc(side + 2, sizeof *g.first);
    aur_result result = AUR_OK;
    if (numbers == NULL || g.order == NULL || g.first == NULL) {
        result = aur_fail_memory(error);
    } else {
        g.turns = numbers;
        g.factor = g.turns + 2 * side;
        g.re = g.factor + limit + 1;
        g.im = g.re + (limit + 1) * side;
        aur_fourier_prepare(side, g.turns);
        aur_window_invert(&g.window, limit, g.factor);
        sort(&g);
        result = aur_measure_items(&request->options, "transforming rows", side / BAND, fill_band, &g,
                                   (aur_parallel_slice){0}, error);
    }
    if (result == AUR_OK)
        result = aur_measure_items(&request->options, "transforming columns", limit + 1, transform_column, &g,
                                   (aur_parallel_slice){0}, error);
    free(numbers);
    free(g.order);
    free(g.first);
    return result;
}
