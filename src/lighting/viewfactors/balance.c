#include <stdlib.h>
#include <string.h>

#include "lighting/viewfactors/row_system.h"

enum { MOST_ROUNDS = 40 };

static const double GOAL = 2e-15, BALANCED = 1e-12, EXACT = 1e-24;

/* Residuals of the row sums relative to the areas: the maximum, and the area-weighted mean square. */
static void find_deficit(aur_row_system *s, double *largest, double *mean_square) {
    const aur_exchange *const g = s->exchange;
    double squares = 0.0, area = 0.0;
    *largest = 0.0;
    for (size_t a = 0; a < g->rows; ++a) {
        double sum = 0.0;
        for (uint64_t e = g->starts[a]; e < g->starts[a + 1]; ++e)
            sum += g->values[e];
        s->deficit[a] = g->areas[a] - (sum + g->sky[a] + g->back[a]);
        if (g->areas[a] == 0.0)
            continue;
        const double part = s->deficit[a] / g->areas[a];
        *largest = fmax(*largest, fabs(part));
        squares += g->areas[a] * part * part;
        area += g->areas[a];
    }
    *mean_square = area > 0.0 ? squares / area : 0.0;
}

/* Adds a change; a value that would become negative is set to 0 for good. */
static bool change(double *value, double *weight, double by) {
    *value += *weight * by;
    if (*value >= 0.0)
        return false;
    *value = 0.0;
    *weight = 0.0;
    return true;
}

/* Returns true if an entry was clamped at 0. */
static bool apply(aur_row_system *s) {
    aur_exchange *const g = s->exchange;
    const double *const m = s->best;
    bool cut = false;
    for (size_t a = 0; a < g->rows; ++a) {
        for (uint64_t e = g->starts[a]; e < g->starts[a + 1]; ++e)
            cut |= change(&g->values[e], &s->weights[e], g->columns[e] == a ? m[a] : m[a] + m[g->columns[e]]);
        cut |= change(&g->sky[a], &s->losses[a], m[a]);
        cut |= change(&g->back[a], &s->losses[g->rows + a], m[a]);
    }
    return cut;
}

/* One phase with the given weights, until the rows sum to their areas or the residual no longer falls. */
static aur_result balance_rows(aur_row_system *s, double *largest, aur_error *error) {
    double mean_square, before = INFINITY;
    for (size_t round = 0; round < MOST_ROUNDS; ++round) {
        find_deficit(s, largest, &mean_square);
        if (*largest <= GOAL || (mean_square > 0.25 * before && round > 1))
            return AUR_OK;
        before = mean_square;
        aur_row_system_prepare(s);
        const aur_result result = aur_row_system_solve(s, EXACT, error);
        if (result != AUR_OK)
            return result;
        if (apply(s))
            before = INFINITY; /* fewer entries are free now: the next round may start with a larger residual
                                */
    }
    find_deficit(s, largest, &mean_square);
    return AUR_OK;
}

/* The factor from variances of ray counts to squared half widths of intervals. Pooled over all rows, because
 * an entry's few randomisations would give random weights. */
static double scale_of_entries(const aur_exchange *g) {
    double squares = 0.0, counts = 0.0;
    for (uint64_t e = 0; e < g->starts[g->rows]; ++e) {
        squares += g->half_widths[e] * g->half_widths[e];
        counts += g->variances[e];
    }
    return squares > 0.0 && counts > 0.0 ? squares / counts : 0.0;
}

/* Sky and back sums have separate variances: they sum many rays, or half planes, which are evenly
 * distributed, and some rows see sky in all of them. The typical variance, proportional to the row's sky and
 * back, counts as one additional randomisation. */
static void weigh_losses(const aur_exchange *g, double scale, const double *losses, const double *half_widths,
                         double *weights) {
    const double row_weight = (double)(g->randomizations - 1) / (double)g->randomizations;
    double squares = 0.0, counts = 0.0;
    for (size_t a = 0; a < g->rows; ++a) {
        squares += half_widths[a] * half_widths[a];
        counts += losses[a] * g->areas[a];
    }
    for (size_t a = 0; a < g->rows; ++a) {
        const double count = losses[a] * g->areas[a];
        weights[a] = squares > 0.0 && scale > 0.0 ? (row_weight * half_widths[a] * half_widths[a] +
                                                     (1.0 - row_weight) * squares / counts * count) /
                                                        scale
                                                  : count;
    }
}

/* The weights of the sampled entries, or of all entries. */
static void choose_weights(aur_row_system *s, bool all) {
    const aur_exchange *const g = s->exchange;
    const double scale = scale_of_entries(g);
    weigh_losses(g, scale, g->sky, g->sky_half_widths, s->losses);
    weigh_losses(g, scale, g->back, g->back_half_widths, s->losses + g->rows);
    for (size_t a = 0; a < g->rows; ++a) {
        for (uint64_t e = g->starts[a]; e < g->starts[a + 1]; ++e) {
            const double b = g->areas[g->columns[e]];
            s->weights[e] = all ? g->values[e] * g->areas[a] * b / (g->areas[a] + b) : g->variances[e];
        }
    }
}

static aur_result balance_and_settle(aur_row_system *s, double *largest, aur_error *error) {
    const aur_result result = balance_rows(s, largest, error);
    return result == AUR_OK ? aur_row_system_settle(s, error) : result;
}

static aur_result balance_all(aur_row_system *s, aur_balance *balance, aur_error *error) {
    aur_exchange *const g = s->exchange;
    const uint64_t entries = g->starts[g->rows];
    double *const original = malloc((entries + 1) * sizeof *original);
    if (original == NULL)
        return aur_fail_memory(error);
    if (entries > 0)
        memcpy(original, g->values, entries * sizeof *original);
    double mean_square, largest;
    find_deficit(s, &largest, &mean_square);
    balance->before = sqrt(mean_square);
    choose_weights(s, false);
    aur_result result = balance_and_settle(s, &largest, error);
    if (result == AUR_OK && largest > 0.1 * BALANCED) {
        choose_weights(s, true);
        result = balance_and_settle(s, &largest, error);
    }
    if (result == AUR_OK)
        result = aur_exchange_find_widths(g, error);
    find_deficit(s, &largest, &mean_square);
    balance->after = largest;
    for (size_t a = 0; a < g->rows; ++a)
        balance->unbalanced += fabs(s->deficit[a]) > BALANCED * g->areas[a];
    double moved = 0.0, total = 0.0;
    for (uint64_t e = 0; e < entries; ++e) {
        moved += fabs(g->values[e] - original[e]);
        total += original[e];
    }
    balance->moved = total > 0.0 ? moved / total : 0.0;
    free(original);
    return result;
}

aur_result aur_exchange_balance(aur_exchange *exchange, const aur_parallel_options *parallel,
                                aur_balance *balance, aur_error *error) {
    *balance = (aur_balance){0};
    const size_t rows = exchange->rows;
    double *const numbers = calloc(9 * rows + 1, sizeof *numbers);
    aur_row_system s = {.exchange = exchange,
                        .parallel = parallel,
                        .weights = malloc((exchange->starts[rows] + 1) * sizeof *s.weights)};
    aur_result result = AUR_OK;
    if (numbers == NULL || s.weights == NULL) {
        result = aur_fail_memory(error);
    } else {
        double **const parts[] = {&s.diagonal,  &s.deficit, &s.multipliers, &s.residual,
                                  &s.direction, &s.image,   &s.best};
        for (size_t i = 0; i < sizeof parts / sizeof parts[0]; ++i)
            *parts[i] = numbers + i * rows;
        s.losses = numbers + 7 * rows;
        result = balance_all(&s, balance, error);
    }
    free(numbers);
    free(s.weights);
    return result;
}
