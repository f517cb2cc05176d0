/* Script F: view factors and emittances in one matrix, over all reflections. */
#include <aureole/statistics.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "lighting/viewfactors/upper_walk.h"
#include "lighting/viewfactors/view_factors.h"
#include "points/base/error.h"

enum { MOST_REFLECTIONS = 10000, MOST_ROWS = 10000 };

typedef struct script_solution {
    const aur_view_factors *from;
    const double *emittances;
    size_t rows;
    /* For the matrix of one randomisation, or for their mean. */
    double *values, *sky;
    double *now, *next, *sum; /* per row */
    double *found, *squares;  /* [rows][rows + 1]: the last column is the sky's */
} script_solution;

/* The factors of one randomisation; their mean if there is no randomisation of this index. */
static aur_result take_randomization(const script_solution *s, size_t randomization, aur_error *error) {
    const aur_view_factors *const m = s->from;
    memcpy(s->values, m->values, m->starts[m->rows] * sizeof *s->values);
    memcpy(s->sky, m->sky, m->rows * sizeof *s->sky);
    if (randomization == m->randomizations)
        return AUR_OK;
    aur_upper_walk walk;
    if (!aur_upper_walk_begin(m->rows, m->starts, m->columns, &walk))
        return aur_fail_memory(error);
    for (const float *off = m->deviations + randomization; aur_upper_walk_advance(&walk);
         off += m->randomizations) {
        s->values[walk.entry] += (double)*off / m->areas[walk.row];
        if (walk.column != walk.row)
            s->values[walk.mirror] += (double)*off / m->areas[walk.column];
    }
    for (size_t i = 0; i < m->rows; ++i)
        if (m->areas[i] > 0.0)
            s->sky[i] += m->sky_deviations[m->randomizations * i + randomization] / m->areas[i];
    return AUR_OK;
}

/* s->sum receives the light of each row over all reflections, given in `first` before reflection: the sum
 * over k of (F rho)^k first. */
static bool sum_reflections(const script_solution *s, const double *first) {
    const aur_view_factors *const m = s->from;
    memcpy(s->now, first, s->rows * sizeof *s->now);
    memcpy(s->sum, first, s->rows * sizeof *s->sum);
    for (size_t k = 0; k < MOST_REFLECTIONS; ++k) {
        double most = 0.0, whole = 0.0;
        for (size_t i = 0; i < s->rows; ++i) {
            double sum = 0.0;
            for (uint64_t e = m->starts[i]; e < m->starts[i + 1]; ++e)
                sum += s->values[e] * (1.0 - s->emittances[m->columns[e]]) * s->now[m->columns[e]];
            s->next[i] = sum;
            s->sum[i] += sum;
            most = fmax(most, fabs(sum));
            whole = fmax(whole, fabs(s->sum[i]));
        }
        memcpy(s->now, s->next, s->rows * sizeof *s->now);
        if (most <= 1e-14 * whole)
            return true;
    }
    return false;
}

static aur_result solve(const script_solution *s, size_t randomization, aur_error *error) {
    const aur_view_factors *const m = s->from;
    const size_t width = s->rows + 1;
    double *const first = calloc(s->rows + 1, sizeof *first);
    aur_result result = first != NULL ? take_randomization(s, randomization, error) : aur_fail_memory(error);
    for (size_t k = 0; k <= s->rows && result == AUR_OK; ++k) {
        for (size_t i = 0; i < s->rows; ++i) {
            first[i] = k == s->rows ? s->sky[i] : 0.0;
            for (uint64_t e = m->starts[i]; k < s->rows && e < m->starts[i + 1]; ++e)
                if (m->columns[e] == k)
                    first[i] = s->values[e] * s->emittances[k];
        }
        if (!sum_reflections(s, first))
            result = aur_fail(error, AUR_ERROR_ARGUMENT,
                              "after %d reflections there is still light: rows that absorb are needed",
                              (int)MOST_REFLECTIONS);
        for (size_t i = 0; i < s->rows && result == AUR_OK; ++i) {
            const double value = s->emittances[i] * s->sum[i];
            double *const found = &s->found[width * i + k], off = value - *found;
            if (randomization < m->randomizations)
                s->squares[width * i + k] += off * off;
            else
                *found = value;
        }
    }
    free(first);
    return result;
}

/* All pairs of rows with emittances above 0. */
static aur_result finish(const script_solution *s, double student, aur_view_factors *factors,
                         aur_error *error) {
    const size_t n = s->rows, width = n + 1;
    const double parts = (double)s->from->randomizations;
    factors->starts = calloc(n + 1, sizeof *factors->starts);
    factors->columns = calloc(n * n + 1, sizeof *factors->columns);
    factors->values = calloc(n * n + 1, sizeof *factors->values);
    factors->half_widths = calloc(n * n + 1, sizeof *factors->half_widths);
    double **const arrays[] = {&factors->areas, &factors->sky, &factors->sky_half_widths, &factors->back};
    bool good = factors->starts != NULL && factors->columns != NULL && factors->values != NULL &&
                factors->half_widths != NULL;
    for (size_t i = 0; i < 4; ++i)
        good = (*arrays[i] = calloc(n + 1, sizeof **arrays[i])) != NULL && good;
    if (s->from->name_width > 0)
        good = (factors->names = malloc(n * s->from->name_width)) != NULL && good;
    if (!good)
        return aur_fail_memory(error);
    factors->rows = n;
    factors->name_width = s->from->name_width;
    if (factors->names != NULL)
        memcpy(factors->names, s->from->names, n * factors->name_width);
    memcpy(factors->areas, s->from->areas, n * sizeof *factors->areas);
    uint64_t entry = 0;
    for (size_t i = 0; i < n; ++i) {
        factors->starts[i] = entry;
        for (size_t k = 0; k < n; ++k) {
            if (!(s->found[width * i + k] > 0.0))
                continue;
            factors->columns[entry] = (uint32_t)k;
            factors->values[entry] = s->found[width * i + k];
            factors->half_widths[entry++] =
                student * sqrt(s->squares[width * i + k] / (parts * (parts - 1.0)));
        }
        factors->sky[i] = s->found[width * i + n];
        factors->sky_half_widths[i] = student * sqrt(s->squares[width * i + n] / (parts * (parts - 1.0)));
    }
    factors->starts[n] = entry;
    return AUR_OK;
}

static aur_result check(const aur_view_factors *factors, const double *emittances, double confidence,
                        aur_error *error) {
    for (size_t i = 0; i < factors->rows; ++i)
        if (!(emittances[i] >= 0.0 && emittances[i] <= 1.0))
            return aur_fail(error, AUR_ERROR_ARGUMENT, "the emittance of row %zu must be in [0,1], not %g", i,
                            emittances[i]);
    if (factors->deviations == NULL && factors->starts[factors->rows] > 0)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "expected view factors of aur_view_factors_create");
    if (factors->rows > MOST_ROWS)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "script F has all pairs of rows: at most %d, not %zu",
                        (int)MOST_ROWS, factors->rows);
    return confidence == 0.0 || (confidence > 0.0 && confidence < 1.0)
               ? AUR_OK
               : aur_fail(error, AUR_ERROR_ARGUMENT, "the confidence must be in (0,1), not %g", confidence);
}

aur_result aur_view_factors_script(const aur_view_factors *factors, const double *emittances,
                                   double confidence, aur_view_factors **script, aur_error *error) {
    *script = NULL;
    aur_result result = check(factors, emittances, confidence, error);
    if (result != AUR_OK)
        return result;
    const size_t n = factors->rows, entries = factors->starts[n];
    double *const numbers = calloc(entries + 4 * n + 2 * n * (n + 1) + 1, sizeof *numbers);
    aur_view_factors *const created = calloc(1, sizeof *created);
    script_solution s = {.from = factors, .emittances = emittances, .rows = n, .values = numbers};
    if (numbers != NULL) {
        s.sky = numbers + entries;
        s.now = s.sky + n;
        s.next = s.now + n;
        s.sum = s.next + n;
        s.found = s.sum + n;
        s.squares = s.found + n * (n + 1);
    }
    result = numbers != NULL && created != NULL ? solve(&s, factors->randomizations, error)
                                                : aur_fail_memory(error);
    for (size_t r = 0; r < factors->randomizations && result == AUR_OK; ++r)
        result = solve(&s, r, error);
    const double level = confidence > 0.0 ? confidence : 0.95;
    if (result == AUR_OK)
        result =
            finish(&s, aur_student_quantile(factors->randomizations - 1, 0.5 + 0.5 * level), created, error);
    free(numbers);
    if (result != AUR_OK) {
        aur_view_factors_destroy(created);
        return result;
    }
    created->description = (aur_view_factors_description){.size = sizeof created->description};
    *script = created;
    return AUR_OK;
}
