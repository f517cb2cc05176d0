#include "lighting/viewfactors/row_system.h"

#include <string.h>

enum { BLOCK = 512, MOST_STEPS = 300 };

typedef struct product {
    const aur_row_system *s;
    const double *x;
    double *y;
} product;

static aur_result multiply_block(void *context, size_t index) {
    const product *const p = context;
    const aur_exchange *const g = p->s->exchange;
    for (size_t a = BLOCK * index; a < g->rows && a < BLOCK * (index + 1); ++a) {
        double sum = p->s->diagonal[a] * p->x[a];
        for (uint64_t e = g->starts[a]; e < g->starts[a + 1]; ++e)
            if (g->columns[e] != a)
                sum += p->s->weights[e] * p->x[g->columns[e]];
        p->y[a] = sum;
    }
    return AUR_OK;
}

static aur_result multiply(const aur_row_system *s, const double *x, double *y, aur_error *error) {
    product work = {s, x, y};
    aur_parallel_options options = *s->parallel;
    options.what = "balancing rows";
    options.progress = (aur_progress){0};
    return aur_parallel_for(&options, (s->exchange->rows + BLOCK - 1) / BLOCK, multiply_block, &work, error);
}

void aur_row_system_prepare(aur_row_system *s) {
    const aur_exchange *const g = s->exchange;
    for (size_t a = 0; a < g->rows; ++a) {
        double sum = s->losses[a] + s->losses[g->rows + a];
        for (uint64_t e = g->starts[a]; e < g->starts[a + 1]; ++e)
            sum += s->weights[e];
        s->diagonal[a] = sum;
    }
}

static double scaled_dot(const aur_row_system *s, const double *x, const double *y) {
    double sum = 0.0;
    for (size_t a = 0; a < s->exchange->rows; ++a)
        if (s->diagonal[a] > 0.0)
            sum += x[a] * y[a] / s->diagonal[a];
    return sum;
}

static double dot(size_t count, const double *x, const double *y) {
    double sum = 0.0;
    for (size_t a = 0; a < count; ++a)
        sum += x[a] * y[a];
    return sum;
}

/* Conjugate gradients with Jacobi preconditioner. If there is no solution, the residual stagnates: the
 * multipliers of the smallest residual are stored. */
aur_result aur_row_system_solve(aur_row_system *s, double reduction, aur_error *error) {
    const size_t rows = s->exchange->rows;
    memset(s->multipliers, 0, rows * sizeof *s->multipliers);
    memset(s->best, 0, rows * sizeof *s->best);
    for (size_t a = 0; a < rows; ++a) {
        s->residual[a] = s->diagonal[a] > 0.0 ? s->deficit[a] : 0.0;
        s->direction[a] = s->diagonal[a] > 0.0 ? s->residual[a] / s->diagonal[a] : 0.0;
    }
    double square = scaled_dot(s, s->residual, s->residual), least = square;
    const double goal = reduction * square;
    size_t stale = 0;
    for (size_t step = 0; step < MOST_STEPS && square > goal && stale < 30; ++step) {
        const aur_result result = multiply(s, s->direction, s->image, error);
        if (result != AUR_OK)
            return result;
        const double curvature = dot(rows, s->direction, s->image);
        if (!(curvature > 0.0))
            break;
        const double length = square / curvature;
        for (size_t a = 0; a < rows; ++a) {
            s->multipliers[a] += length * s->direction[a];
            s->residual[a] -= length * s->image[a];
        }
        const double next = scaled_dot(s, s->residual, s->residual);
        stale = next < 0.999 * least ? 0 : stale + 1;
        if (next < least) {
            least = next;
            memcpy(s->best, s->multipliers, rows * sizeof *s->best);
        }
        for (size_t a = 0; a < rows; ++a)
            s->direction[a] = (s->diagonal[a] > 0.0 ? s->residual[a] / s->diagonal[a] : 0.0) +
                              next / square * s->direction[a];
        square = next;
    }
    return AUR_OK;
}
