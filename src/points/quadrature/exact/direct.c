/* The Gram matrix of the rows of A, scaled by the roots of the weights, is factored row by row, degree after
 * degree; each degree extends the factorisation of the previous one. Linearly dependent rows are left out; if
 * they are inconsistent, no weights are exact. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/parallel.h"
#include "points/quadrature/exact/system.h"

/* A row is dependent if its squared distance from the span of the previous rows is at most this fraction of
 * its square. */
static const double dependent = 1e-11;
/* The tolerated residual of a dependent row. */
static const double contradiction = 1e-7;

typedef struct factor {
    const aur_exact_system *system;
    const aur_transform_kernel *kernel;
    const aur_basis *basis;
    size_t count, rank, capacity; /* points; independent rows, and their maximum */
    double *rows;                 /* of count each: row l^2 is order 0, l^2 + 2m - 1 and l^2 + 2m order m */
    double *lower;                /* of capacity each */
    double *diagonal;             /* reciprocals of the diagonal of the independent rows */
    size_t *independent;          /* the numbers of independent rows */
    double *y;                    /* the solution of lower y = right */
    double *roots;                /* of the weights to approximate */
    double *gram, *right, *best;
    double *storage;
} factor;

static double *row_at(const factor *f, size_t row) {
    return f->rows + row * f->count;
}

/* The two rows of order m = l from those of l - 1. */
static void fill_sectoral(const factor *f, size_t l) {
    const aur_polar_points *const p = &f->system->points;
    const bool first = l == 1;
    const double *const cosine = row_at(f, first ? 0 : (l - 1) * (l - 1) + 2 * (l - 1) - 1);
    const double *const sine = first ? NULL : row_at(f, (l - 1) * (l - 1) + 2 * (l - 1));
    double *const new_cosine = row_at(f, l * l + 2 * l - 1), *const new_sine = row_at(f, l * l + 2 * l);
    for (size_t i = 0; i < f->count; ++i) {
        const double s = first ? 0.0 : sine[i], scale = f->basis->start[l] * p->sine[i];
        new_cosine[i] = scale * (cosine[i] * p->cosine[i] - s * p->azimuth_sine[i]);
        new_sine[i] = scale * (cosine[i] * p->azimuth_sine[i] + s * p->cosine[i]);
    }
}

static void fill_degree(const factor *f, size_t l) {
    if (l == 0) {
        memcpy(f->rows, f->roots, f->count * sizeof *f->rows);
        return;
    }
    for (size_t k = 0; k < 2 * l - 1; ++k) { /* the orders below l */
        const size_t m = (k + 1) / 2;
        const aur_basis_step step = f->basis->steps[aur_basis_at(f->basis->degree, m) + l - m];
        const double *const z = f->system->points.z, *const here = row_at(f, (l - 1) * (l - 1) + k);
        const double *const before = l > m + 1 ? row_at(f, (l - 2) * (l - 2) + k) : here;
        const double part = l > m + 1 ? step.before : 0.0;
        double *const next = row_at(f, l * l + k);
        for (size_t i = 0; i < f->count; ++i)
            next[i] = (step.scale * z[i] + step.shift) * here[i] - part * before[i];
    }
    fill_sectoral(f, l);
}

/* The column of the factor for row `pivot`, in the rows from `first` on. */
static void fill_column(const factor *f, size_t column, size_t pivot, size_t first, size_t count) {
    double *const lower = f->lower + first * f->capacity;
    f->kernel->dots(f->count, row_at(f, pivot), count, f->count, row_at(f, first), 1, f->gram);
    f->kernel->dots(column, f->lower + pivot * f->capacity, count, f->capacity, lower, f->capacity,
                    lower + column);
    for (size_t r = 0; r < count; ++r) {
        double *const entry = lower + r * f->capacity + column;
        *entry = (f->gram[r] - *entry) * f->diagonal[column];
    }
}

static double dot(const factor *f, size_t count, const double *a, const double *b) {
    double sum;
    f->kernel->dots(count, a, 1, 0, b, 1, &sum);
    return sum;
}

/* Adds the rows of degree l. False if they are inconsistent with the previous rows. */
static bool add_degree(factor *f, size_t l) {
    fill_degree(f, l);
    const size_t first = l * l, last = (l + 1) * (l + 1);
    for (size_t column = 0; column < f->rank; ++column)
        fill_column(f, column, f->independent[column], first, last - first);
    for (size_t r = first; r < last; ++r) {
        const double *const row = row_at(f, r);
        double *const lower = f->lower + r * f->capacity;
        const double square = dot(f, f->count, row, row);
        const double rest = square - dot(f, f->rank, lower, lower);
        const double right = (r == 0 ? 1.0 : 0.0) - dot(f, f->count, row, f->roots);
        const double missing = right - dot(f, f->rank, lower, f->y);
        if (rest <= dependent * square || f->rank == f->capacity) {
            if (fabs(missing) > contradiction)
                return false;
            continue;
        }
        f->diagonal[f->rank] = 1.0 / sqrt(rest);
        f->y[f->rank] = missing * f->diagonal[f->rank];
        f->independent[f->rank] = r;
        if (r + 1 < last)
            fill_column(f, f->rank, r, r + 1, last - r - 1);
        ++f->rank;
    }
    return true;
}

/* Adds the weights of the solution y of the first `rank` rows; y is overwritten. */
static void add_solution(const factor *f, size_t rank, double *y, double *weights) {
    for (size_t k = rank; k-- > 0;) {
        const double *const lower = f->lower + f->independent[k] * f->capacity;
        const double value = y[k] * f->diagonal[k];
        y[k] = value;
        for (size_t j = 0; j < k; ++j)
            y[j] -= value * lower[j];
    }
    memset(f->gram, 0, f->count * sizeof *f->gram);
    for (size_t k = 0; k < rank; ++k) {
        const double *const row = row_at(f, f->independent[k]), value = y[k];
        for (size_t i = 0; i < f->count; ++i)
            f->gram[i] += value * row[i];
    }
    for (size_t i = 0; i < f->count; ++i)
        weights[i] += f->roots[i] * f->gram[i];
}

/* The same for the residual of the weights (iterative refinement). */
static void refine(const factor *f, size_t rank, double *weights) {
    double *const part = f->best;
    for (size_t i = 0; i < f->count; ++i)
        part[i] = f->roots[i] > 0.0 ? weights[i] / f->roots[i] : 0.0;
    for (size_t k = 0; k < rank; ++k) {
        const double *const lower = f->lower + f->independent[k] * f->capacity;
        const double right =
            (f->independent[k] == 0 ? 1.0 : 0.0) - dot(f, f->count, row_at(f, f->independent[k]), part);
        f->right[k] = (right - dot(f, k, lower, f->right)) * f->diagonal[k];
    }
    add_solution(f, rank, f->right, weights);
}

static bool allocate(factor *f, size_t degree, aur_error *error) {
    const size_t row_count = (degree + 1) * (degree + 1);
    const size_t doubles = row_count * (f->count + f->capacity) + 4 * f->capacity + 3 * f->count + row_count;
    f->storage = malloc(doubles * sizeof *f->storage);
    if (f->storage == NULL) {
        aur_fail_memory(error);
        return false;
    }
    f->rows = f->storage;
    f->lower = f->rows + row_count * f->count;
    f->diagonal = f->lower + row_count * f->capacity;
    f->y = f->diagonal + f->capacity;
    f->right = f->y + f->capacity;
    f->independent = (size_t *)(void *)(f->right + f->capacity);
    f->roots = f->right + 2 * f->capacity;
    f->best = f->roots + f->count;
    f->gram = f->best + f->count; /* of a degree's rows, or of the points */
    for (size_t i = 0; i < f->count; ++i)
        f->roots[i] = sqrt(f->system->near[i]);
    return true;
}

static aur_result solve(factor *f, size_t degree, bool search, double *weights, aur_exact_found *found,
                        aur_error *error) {
    size_t rank = 0;
    bool exact = true;
    aur_exact_factoring factoring = {.earlier = 0.0};
    const size_t full = (size_t)sqrt((double)f->system->distinct_points),
                 end = search && full < degree ? full : degree;
    for (size_t l = 0; l <= degree && exact; ++l) {
        exact = add_degree(f, l);
        if (!exact || (!search && l < degree))
            continue;
        if (aur_exact_factoring_stops(&f->system->progress, &factoring, l, l < end ? end : l + 1))
            return aur_fail(error, AUR_ERROR_CANCELLED, "factoring: cancelled");
        memcpy(f->right, f->y, f->rank * sizeof *f->y);
        memcpy(f->best, f->system->near, f->count * sizeof *f->best);
        add_solution(f, f->rank, f->right, f->best);
        if (aur_exact_positive(f->system, f->best, found) || !search) {
            memcpy(weights, f->best, f->count * sizeof *weights);
            found->degree = l;
            found->exact = true;
            rank = f->rank;
        }
    }
    for (int pass = 0; pass < 2 && found->exact; ++pass)
        refine(f, rank, weights);
    return AUR_OK;
}

aur_result aur_exact_direct(const aur_exact_system *system, size_t degree, bool search, double *weights,
                            aur_exact_found *found, aur_error *error) {
    aur_basis basis;
    aur_result result = aur_basis_create(degree, system->lowest, system->exponent, &basis, error);
    if (result != AUR_OK)
        return result;
    factor f = {.system = system,
                .kernel = &AUR_KERNEL_HERE(aur_transform_kernel),
                .basis = &basis,
                .count = system->points.count,
                .capacity = system->distinct_points};
    result = AUR_ERROR_MEMORY;
    if (allocate(&f, degree, error))
        result = solve(&f, degree, search, weights, found, error);
    free(f.storage);
    aur_basis_release(&basis);
    return result;
}
