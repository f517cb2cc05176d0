/* Intervals after the correction: its linear map is applied to every randomisation. */
#include <stdlib.h>
#include <string.h>

#include "lighting/viewfactors/row_system.h"
#include "lighting/viewfactors/upper_walk.h"

/* Sufficient precision of an interval. */
static const double GOOD_ENOUGH = 1e-8;

static bool begin(const aur_exchange *g, aur_upper_walk *walk) {
    return aur_upper_walk_begin(g->rows, g->starts, g->columns, walk);
}

/* lacks[randomizations][rows]: residual of each row's sum in each randomisation, minus its mean over the
 * randomisations. Entries that were clamped at 0 are 0 in all randomisations. */
static bool find_deficits(const aur_row_system *s, double *deficits) {
    const aur_exchange *const g = s->exchange;
    const size_t width = g->randomizations, rows = g->rows;
    memset(deficits, 0, width * rows * sizeof *deficits);
    aur_upper_walk walk;
    if (!begin(g, &walk))
        return false;
    for (const float *from = g->deviations; aur_upper_walk_advance(&walk); from += width)
        for (size_t r = 0; r < width && s->weights[walk.entry] > 0.0; ++r) {
            deficits[rows * r + walk.row] -= (double)from[r];
            if (walk.row != walk.column)
                deficits[rows * r + walk.column] -= (double)from[r];
        }
    for (size_t a = 0; a < 2 * rows; ++a)
        for (size_t r = 0; r < width && s->losses[a] > 0.0; ++r)
            deficits[rows * r + a % rows] -= g->loss_deviations[width * a + r];
    return true;
}

static bool apply(const aur_row_system *s, const double *multipliers) {
    const aur_exchange *const g = s->exchange;
    const size_t width = g->randomizations, rows = g->rows;
    aur_upper_walk walk;
    if (!begin(g, &walk))
        return false;
    for (float *to = g->deviations; aur_upper_walk_advance(&walk); to += width)
        for (size_t r = 0; r < width; ++r) {
            const double *const m = &multipliers[rows * r];
            const double by = walk.row != walk.column ? m[walk.row] + m[walk.column] : m[walk.row];
            to[r] += (float)(s->weights[walk.entry] * by);
        }
    for (size_t a = 0; a < 2 * rows; ++a)
        for (size_t r = 0; r < width; ++r)
            g->loss_deviations[width * a + r] += s->losses[a] * multipliers[rows * r + a % rows];
    return true;
}

aur_result aur_row_system_settle(aur_row_system *s, aur_error *error) {
    const size_t width = s->exchange->randomizations, rows = s->exchange->rows;
    double *const numbers = malloc((width * rows + 1) * sizeof *numbers); /* residuals, then multipliers */
    aur_result result = numbers != NULL && find_deficits(s, numbers) ? AUR_OK : aur_fail_memory(error);
    aur_row_system_prepare(s);
    for (size_t r = 0; r < width && result == AUR_OK; ++r) {
        memcpy(s->deficit, &numbers[rows * r], rows * sizeof *s->deficit);
        result = aur_row_system_solve(s, GOOD_ENOUGH, error);
        memcpy(&numbers[rows * r], s->best, rows * sizeof *s->best);
    }
    if (result == AUR_OK && !apply(s, numbers))
        result = aur_fail_memory(error);
    free(numbers);
    return result;
}

aur_result aur_exchange_find_widths(aur_exchange *g, aur_error *error) {
    const size_t width = g->randomizations, rows = g->rows;
    const double scale = g->student / sqrt((double)width * (double)(width - 1));
    aur_upper_walk walk;
    if (!begin(g, &walk))
        return aur_fail_memory(error);
    for (const float *from = g->deviations; aur_upper_walk_advance(&walk); from += width) {
        double squares = 0.0;
        for (size_t r = 0; r < width; ++r)
            squares += (double)from[r] * (double)from[r];
        g->half_widths[walk.entry] = g->half_widths[walk.mirror] = scale * sqrt(squares);
    }
    for (size_t a = 0; a < 2 * rows; ++a) {
        double squares = 0.0;
        for (size_t r = 0; r < width; ++r)
            squares += g->loss_deviations[width * a + r] * g->loss_deviations[width * a + r];
        *(a < rows ? &g->sky_half_widths[a] : &g->back_half_widths[a - rows]) = scale * sqrt(squares);
    }
    return AUR_OK;
}
