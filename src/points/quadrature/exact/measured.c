#include "points/quadrature/exact/system.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/array.h"
#include "points/base/parallel.h"
#include "points/base/vector3d.h"

/* A function is dependent if its part orthogonal to the previous ones is below this fraction of its length
 * over the points; the second number bounds its integral over the lobe, relative to its length there. */
static const double dependent = 1e-11, contradiction = 1e-9;

typedef struct measured {
    const aur_transform_kernel *kernel;
    const aur_exact_nodes *nodes;
    aur_progress progress;
    size_t points, all;                    /* points with weight; points and nodes */
    size_t *index;                         /* index of each point in the caller's array */
    double *near, *ratio, *best, *scratch; /* of points; `ratio`: weights divided by near */
    double *depth, *across,
        *aside;    /* of all: 1 - cos to the lobe's centre, and the two perpendicular coordinates */
    double **rows; /* of a degree l: 2 l + 1 rows of all */
    double *integral, *length, *product; /* of rows: over the nodes; root mean square there; dot products */
    void *storage;
} measured;

static double *row_at(const measured *m, size_t l, size_t k) {
    return m->rows[l] + k * m->all;
}

/* The length over the points; `scratch` keeps near times row. */
static double length_of(const measured *m, const double *row) {
    double square;
    for (size_t i = 0; i < m->points; ++i)
        m->scratch[i] = m->near[i] * row[i];
    m->kernel->dots(m->points, m->scratch, 1, m->all, row, 1, &square);
    return sqrt(square);
}

/* Orthogonalises row k of degree l against the previous rows. */
static void take_parts(const measured *m, size_t l, size_t k) {
    double *const row = row_at(m, l, k);
    length_of(m, row);
    for (size_t d = 0; d <= l; ++d)
        m->kernel->dots(m->points, m->scratch, d < l ? 2 * d + 1 : k, m->all, m->rows[d], 1,
                        m->product + d * d);
    enum { BLOCK = 1024 };
    for (size_t first = 0; first < m->all; first += BLOCK) {
        const size_t end = first + BLOCK < m->all ? first + BLOCK : m->all;
        for (size_t d = 0; d <= l; ++d)
            for (size_t j = 0; j < (d < l ? 2 * d + 1 : k); ++j) {
                const double part = m->product[d * d + j], *const other = row_at(m, d, j);
                for (size_t i = first; i < end; ++i)
                    row[i] -= part * other[i];
            }
    }
}

/* Its integral over the nodes, and its root mean square. */
static double integrate(const measured *m, const double *row, double *length) {
    double sum = 0.0, square = 0.0;
    for (size_t i = 0; i < m->nodes->count; ++i) {
        const double value = row[m->points + i], part = m->nodes->mass[i] * value;
        sum += part;
        square += part * value;
    }
    *length = sqrt(square);
    return sum;
}

static void scale(double factor, size_t count, double *row) {
    for (size_t i = 0; i < count; ++i)
        row[i] *= factor;
}

/* False if the row vanishes at the points but its integral does not: then no weights are exact. */
static bool settle(const measured *m, size_t l, size_t k) {
    double *const row = row_at(m, l, k);
    const size_t at = l * l + k;
    const double before = length_of(m, row);
    take_parts(m, l, k);
    take_parts(m, l, k);
    const double left = length_of(m, row);
    m->integral[at] = integrate(m, row, &m->length[at]);
    if (l == 0)
        m->integral[at] = 1.0; /* exact, while the sum of the masses has rounding errors */
    if (left > dependent * before) {
        scale(1.0 / left, m->all, row);
        m->integral[at] /= left;
        m->length[at] /= left;
        for (size_t i = 0; i < m->points; ++i)
            m->ratio[i] += m->integral[at] * row[i];
        return true;
    }
    if (fabs(m->integral[at]) > contradiction * m->length[at])
        return false;
    memset(row, 0, m->points * sizeof *row);
    if (m->length[at] > 0.0)
        scale(1.0 / m->length[at], m->nodes->count, row + m->points);
    m->integral[at] = 0.0;
    return true;
}

/* As with harmonics, functions of degree l are those of degree l - 1 times the height, and two of order l;
 * the former give the leading parts of all orders below l. */
static bool add_degree(const measured *m, size_t l) {
    bool exact = true;
    if (l == 0)
        for (size_t i = 0; i < m->all; ++i)
            m->rows[0][i] = 1.0;
    if (l == 0)
        return settle(m, 0, 0);
    const size_t orders = 2 * l - 1;
    for (size_t k = 0; k < orders && exact; ++k) {
        const double *const before = row_at(m, l - 1, k);
        double *const next = row_at(m, l, k);
        for (size_t i = 0; i < m->all; ++i)
            next[i] = m->depth[i] * before[i];
        exact = settle(m, l, k);
    }
    const double *const cosine = row_at(m, l - 1, l > 1 ? orders - 2 : 0);
    const double *const sine = l > 1 ? row_at(m, l - 1, orders - 1) : NULL;
    double *const next = row_at(m, l, orders), *const other = row_at(m, l, orders + 1);
    for (size_t i = 0; i < m->all; ++i) {
        const double s = sine != NULL ? sine[i] : 0.0;
        next[i] = m->across[i] * cosine[i] - m->aside[i] * s;
        other[i] = m->aside[i] * cosine[i] + m->across[i] * s;
    }
    return exact && settle(m, l, orders) && settle(m, l, orders + 1);
}

/* Adds a correction for the residual, and returns the largest residual for functions of mean square 1. */
static double refine(const measured *m, size_t degree, double *ratio) {
    double worst = 0.0;
    for (size_t i = 0; i < m->points; ++i)
        m->scratch[i] = m->near[i] * ratio[i];
    for (size_t l = 0; l <= degree; ++l) {
        m->kernel->dots(m->points, m->scratch, 2 * l + 1, m->all, m->rows[l], 1, m->product + l * l);
        for (size_t k = 0; k < 2 * l + 1; ++k) {
            const double *const row = row_at(m, l, k);
            const double missing = m->integral[l * l + k] - m->product[l * l + k];
            worst = fmax(worst, fabs(missing) / fmax(m->length[l * l + k], 1.0));
            for (size_t i = 0; i < m->points; ++i)
                ratio[i] += missing * row[i];
        }
    }
    return worst;
}

/* Points and nodes in the frame of the lobe's centre: differences are accurate for narrow lobes. */
static void fill_frame(measured *m, const double *xyz) {
    double axis[3] = {0.0}, frame[2][3];
    for (size_t i = 0; i < m->nodes->count; ++i)
        for (size_t d = 0; d < 3; ++d)
            axis[d] += m->nodes->mass[i] * m->nodes->xyz[3 * i + d];
    aur_normalize3(axis);
    aur_frame3(axis, frame[0], frame[1]);
    for (size_t i = 0; i < m->all; ++i) {
        const bool node = i >= m->points;
        double u[3];
        memcpy(u, node ? m->nodes->xyz + 3 * (i - m->points) : xyz + 3 * m->index[i], sizeof u);
        aur_normalize3(u);
        const double from[3] = {u[0] - axis[0], u[1] - axis[1], u[2] - axis[2]};
        m->depth[i] = 0.5 * aur_dot3(from, from);
        m->across[i] = aur_dot3(from, frame[0]);
        m->aside[i] = aur_dot3(from, frame[1]);
    }
}

static aur_result open_measured(const aur_exact_system *system, const double *xyz,
                                const aur_exact_nodes *nodes, size_t degree, measured *m, aur_error *error) {
    const size_t count = system->points.count, all = count + nodes->count,
                 row_count = (degree + 1) * (degree + 1);
    *m = (measured){
        .kernel = &AUR_KERNEL_HERE(aur_transform_kernel), .nodes = nodes, .progress = system->progress};
    m->storage = malloc((4 * count + 3 * all + 3 * row_count) * sizeof(double) + count * sizeof(size_t));
    m->rows = calloc(degree + 1, sizeof *m->rows);
    if (m->storage == NULL || m->rows == NULL)
        return aur_fail_memory(error);
    m->near = m->storage;
    m->ratio = m->near + count;
    m->best = m->ratio + count;
    m->scratch = m->best + count;
    m->depth = m->scratch + count;
    m->across = m->depth + all;
    m->aside = m->across + all;
    m->integral = m->aside + all;
    m->length = m->integral + row_count;
    m->product = m->length + row_count;
    m->index = (size_t *)(void *)(m->product + row_count);
    for (size_t i = 0; i < count; ++i) {
        if (system->near[i] > 0.0) {
            m->near[m->points] = system->near[i];
            m->index[m->points++] = i;
        }
    }
    memset(m->ratio, 0, count * sizeof *m->ratio);
    m->all = m->points + nodes->count;
    fill_frame(m, xyz);
    return AUR_OK;
}

static void close_measured(measured *m, size_t degree) {
    for (size_t l = 0; m->rows != NULL && l <= degree; ++l)
        free(m->rows[l]);
    free(m->rows);
    free(m->storage);
}

static aur_result make_room(const measured *m, size_t l, aur_error *error) {
    const double bytes = (double)m->all * (double)((l + 1) * (l + 1)) * sizeof(double);
    if (bytes < aur_machine_memory())
        m->rows[l] = malloc((2 * l + 1) * m->all * sizeof **m->rows);
    if (m->rows[l] == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory: degree %zu of a lobe takes %.3g GB", l,
                        1e-9 * bytes);
    return AUR_OK;
}

static void spread(const measured *m, const double *ratio, size_t count, double *weights) {
    memset(weights, 0, count * sizeof *weights);
    for (size_t i = 0; i < m->points; ++i)
        weights[m->index[i]] = m->near[i] * ratio[i];
}

static aur_result solve(const measured *m, const aur_exact_system *system, size_t degree, bool search,
                        aur_exact_factoring *factoring, double *weights, aur_exact_found *found,
                        aur_error *error) {
    const size_t count = system->points.count;
    size_t last = 0;
    for (size_t l = 0; l <= degree && l <= last + (search ? AUR_EXACT_PATIENCE : degree); ++l) {
        /* The degree up to which weights are positive is unknown. Beyond it a search soon ends, unless it
         * restarts with more nodes. */
        const bool ends = l > last + 1 + factoring->gap && last + AUR_EXACT_PATIENCE < degree;
        const size_t end = !search ? degree + 1 : ends ? last + AUR_EXACT_PATIENCE + 1 : 0;
        if (aur_exact_factoring_stops(&m->progress, factoring, l, end))
            return aur_fail(error, AUR_ERROR_CANCELLED, "factoring: cancelled");
        const aur_result result = make_room(m, l, error);
        if (result != AUR_OK)
            return result;
        if (!add_degree(m, l))
            break;
        if (!search && l < degree)
            continue;
        spread(m, m->ratio, count, weights);
        if (!search || aur_exact_positive(system, weights, found)) {
            memcpy(m->best, m->ratio, m->points * sizeof *m->best);
            found->exact = true;
            factoring->gap = l > last + 1 + factoring->gap ? l - last - 1 : factoring->gap;
            last = l;
        }
    }
    factoring->earlier = factoring->share.done;
    found->degree = found->exact ? last : degree;
    for (int pass = 0; pass < 3 && found->exact; ++pass)
        found->residual = refine(m, last, m->best);
    spread(m, m->best, count, weights);
    found->exact = found->exact && found->residual <= AUR_EXACT_TOLERANCE;
    return AUR_OK;
}

aur_result aur_exact_measured(const aur_exact_system *system, const double *xyz, const aur_exact_nodes *nodes,
                              size_t degree, bool search, aur_exact_factoring *factoring, double *weights,
                              aur_exact_found *found, aur_error *error) {
    measured m;
    aur_result result = open_measured(system, xyz, nodes, degree, &m, error);
    *found = (aur_exact_found){.degree = degree};
    if (result == AUR_OK)
        result = solve(&m, system, degree, search, factoring, weights, found, error);
    close_measured(&m, degree);
    return result;
}
