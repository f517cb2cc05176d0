/* Between points and cells: the inner loops of fast.c. */
#include "points/base/simd_lanes.h"
#include "points/quadrature/exact/fast.h"

enum { WIDTH = AUR_WINDOW_WIDTH, VECTORS = WIDTH / AUR_LANES };

static inline aur_reals load(const double *source) {
    aur_reals value;
    memcpy(&value, source, sizeof value);
    return value;
}

static void spread(size_t count, const aur_spot *spots, const double *weights, size_t from, size_t to,
                   size_t stride, double *grid) {
    for (const aur_spot *s = spots; s < spots + count; ++s) {
        const double weight = weights[s->index];
        aur_reals columns[VECTORS];
        for (size_t v = 0; v < VECTORS; ++v)
            columns[v] = load(s->window[1] + v * AUR_LANES);
        const size_t first = s->row < from ? from - s->row : 0;
        const size_t last = s->row + WIDTH > to ? to - s->row : WIDTH;
        for (size_t k = first; k < last; ++k) {
            double *const cells = grid + (s->row + k) * stride + s->column;
            const double part = weight * s->window[0][k];
            for (size_t v = 0; v < VECTORS; ++v) {
                const aur_reals sum = load(cells + v * AUR_LANES) + part * columns[v];
                memcpy(cells + v * AUR_LANES, &sum, sizeof sum);
            }
        }
    }
}

static void gather(size_t count, const aur_spot *spots, size_t stride, const double *grid, double *values) {
    for (const aur_spot *s = spots; s < spots + count; ++s) {
        aur_reals columns[VECTORS];
        for (size_t v = 0; v < VECTORS; ++v)
            columns[v] = (aur_reals){0};
        for (size_t k = 0; k < WIDTH; ++k) {
            const double *const cells = grid + (s->row + k) * stride + s->column;
            for (size_t v = 0; v < VECTORS; ++v)
                columns[v] += s->window[0][k] * load(cells + v * AUR_LANES);
        }
        double parts[WIDTH];
        for (size_t v = 0; v < VECTORS; ++v) {
            columns[v] *= load(s->window[1] + v * AUR_LANES);
            memcpy(parts + v * AUR_LANES, &columns[v], sizeof columns[v]);
        }
        for (size_t half = WIDTH / 2; half > 0; half /= 2)
            for (size_t c = 0; c < half; ++c)
                parts[c] += parts[c + half];
        values[s->index] = parts[0];
    }
}

const aur_fast_kernel AUR_KERNEL(aur_fast_kernel) = {spread, gather};
