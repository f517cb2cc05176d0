/* A symmetric matrix from its upper triangle. */
#include <stdlib.h>
#include <string.h>

#include "lighting/viewfactors/upper_row.h"

static void put(aur_exchange *exchange, uint64_t at, size_t column, const aur_upper_row *row, size_t k,
                double variance_scale) {
    exchange->columns[at] = (uint32_t)column;
    exchange->values[at] = row->closed[k] + row->sampled[k];
    exchange->variances[at] = variance_scale * row->sampled[k];
    exchange->half_widths[at] = row->half_widths[k];
}

/* Builds the whole matrix from its upper triangle. Rows are processed in order, so that columns ascend. */
bool aur_exchange_mirror(aur_upper_row *uppers, aur_exchange *exchange) {
    const size_t rows = exchange->rows, width = exchange->randomizations;
    uint64_t *const next = calloc(rows + 1, sizeof *next);
    if (next == NULL)
        return false;
    size_t upper = 0;
    for (size_t a = 0; a < rows; ++a) {
        const aur_upper_row *const row = &uppers[a];
        upper += row->count;
        exchange->closed_pairs += row->closed_pairs;
        exchange->sampled_pairs += row->sampled_pairs;
        for (size_t k = 0; k < row->count; ++k) {
            ++next[a];
            next[row->columns[k]] += row->columns[k] != a;
            exchange->closed_total += (row->columns[k] != a ? 2.0 : 1.0) * row->closed[k];
        }
    }
    for (size_t a = 0; a < rows; ++a) {
        exchange->starts[a + 1] = exchange->starts[a] + next[a];
        next[a] = exchange->starts[a];
    }
    const size_t entries = exchange->starts[rows];
    exchange->columns = malloc((entries + 1) * sizeof *exchange->columns);
    exchange->values = malloc((entries + 1) * sizeof *exchange->values);
    exchange->variances = malloc((entries + 1) * sizeof *exchange->variances);
    exchange->half_widths = malloc((entries + 1) * sizeof *exchange->half_widths);
    exchange->deviations = malloc((upper + 1) * width * sizeof *exchange->deviations);
    const bool good = exchange->columns != NULL && exchange->values != NULL && exchange->variances != NULL &&
                      exchange->half_widths != NULL && exchange->deviations != NULL;
    float *to = exchange->deviations;
    for (size_t a = 0; good && a < rows; ++a) {
        aur_upper_row *const row = &uppers[a];
        if (row->count > 0)
            memcpy(to, row->deviations, row->count * width * sizeof *to);
        to += row->count * width;
        free(row->deviations); /* the largest array of a row */
        row->deviations = NULL;
        for (size_t k = 0; k < row->count; ++k) {
            const size_t b = row->columns[k];
            const double scale =
                exchange->areas[a] * exchange->areas[b] / (exchange->areas[a] + exchange->areas[b]);
            put(exchange, next[a]++, b, row, k, scale);
            if (b != a)
                put(exchange, next[b]++, a, row, k, scale);
        }
    }
    free(next);
    return good;
}
