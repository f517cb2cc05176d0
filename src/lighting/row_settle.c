/* Intervals of what the least change leaves: its own linear map is applied to every randomisation. */
#include <stdlib.h>
#include <string.h>

#include "lighting/row_system.h"

/* An interval need not be known better than to a part in ten thousand. */
static const double GOOD_ENOUGH = 1e-8;

/* The entries from the diagonal on, row by row, which is the order of their deviations; `mirror` is the same
 * entry below the diagonal. */
typedef struct upper_entry {
    size_t row, column;
    uint64_t entry, mirror;
} upper_entry;

typedef struct upper_walk {
    const aur_exchange *exchange;
    uint64_t *next; /* of each row, the entry below the diagonal that comes next; then the row's own */
    upper_entry at;
} upper_walk;

static bool begin(upper_walk *walk, const aur_exchange *exchange) {
    *walk = (upper_walk){exchange, malloc((exchange->rows + 1) * sizeof *walk->next), {0}};
    if (walk->next != NULL)
        memcpy(walk->next, exchange->starts, exchange->rows * sizeof *walk->next);
    return walk->next != NULL;
}

/* False after the last one, when the walk has been released. */
static bool advance(upper_walk *walk) {
    const aur_exchange *const g = walk->exchange;
    upper_entry *const at = &walk->at;
    while (at->row < g->rows && walk->next[at->row] == g->starts[at->row + 1])
        ++at->row;
    if (at->row == g->rows) {
        free(walk->next);
        return false;
    }
    at->entry = at->mirror = walk->next[at->row]++;
    at->column = g->columns[at->entry];
    if (at->column != at->row)
        at->mirror = walk->next[at->column]++;
    return true;
}

/* lacks[randomizations][rows]: what rows lack in each randomisation more than in the mean. What has been cut
 * at 0 is 0 in all. */
static bool find_lacks(const aur_row_system *s, double *lacks) {
    const aur_exchange *const g = s->exchange;
    const size_t width = g->randomizations, rows = g->rows;
    memset(lacks, 0, width * rows * sizeof *lacks);
    upper_walk walk;
    if (!begin(&walk, g))
        return false;
    for (const float *from = g->deviations; advance(&walk); from += width)
        for (size_t r = 0; r < width && s->weights[walk.at.entry] > 0.0; ++r) {
            lacks[rows * r + walk.at.row] -= (double)from[r];
            if (walk.at.row != walk.at.column)
                lacks[rows * r + walk.at.column] -= (double)from[r];
        }
    for (size_t a = 0; a < 2 * rows; ++a)
        for (size_t r = 0; r < width && s->losses[a] > 0.0; ++r)
            lacks[rows * r + a % rows] -= g->loss_deviations[width * a + r];
    return true;
}

static bool apply(const aur_row_system *s, const double *multipliers) {
    const aur_exchange *const g = s->exchange;
    const size_t width = g->randomizations, rows = g->rows;
    upper_walk walk;
    if (!begin(&walk, g))
        return false;
    for (float *to = g->deviations; advance(&walk); to += width)
        for (size_t r = 0; r < width; ++r) {
            const double *const m = &multipliers[rows * r];
            const double by =
                walk.at.row != walk.at.column ? m[walk.at.row] + m[walk.at.column] : m[walk.at.row];
            to[r] += (float)(s->weights[walk.at.entry] * by);
        }
    for (size_t a = 0; a < 2 * rows; ++a)
        for (size_t r = 0; r < width; ++r)
            g->loss_deviations[width * a + r] += s->losses[a] * multipliers[rows * r + a % rows];
    return true;
}

aur_result aur_row_system_settle(aur_row_system *s, aur_error *error) {
    const size_t width = s->exchange->randomizations, rows = s->exchange->rows;
    double *const numbers = malloc((width * rows + 1) * sizeof *numbers); /* lacks, then multipliers */
    aur_result result = numbers != NULL && find_lacks(s, numbers) ? AUR_OK : aur_fail_memory(error);
    aur_row_system_prepare(s);
    for (size_t r = 0; r < width && result == AUR_OK; ++r) {
        memcpy(s->lack, &numbers[rows * r], rows * sizeof *s->lack);
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
    upper_walk walk;
    if (!begin(&walk, g))
        return aur_fail_memory(error);
    for (const float *from = g->deviations; advance(&walk); from += width) {
        double squares = 0.0;
        for (size_t r = 0; r < width; ++r)
            squares += (double)from[r] * (double)from[r];
        g->half_widths[walk.at.entry] = g->half_widths[walk.at.mirror] = scale * sqrt(squares);
    }
    for (size_t a = 0; a < 2 * rows; ++a) {
        double squares = 0.0;
        for (size_t r = 0; r < width; ++r)
            squares += g->loss_deviations[width * a + r] * g->loss_deviations[width * a + r];
        *(a < rows ? &g->sky_half_widths[a] : &g->back_half_widths[a - rows]) = scale * sqrt(squares);
    }
    return AUR_OK;
}
