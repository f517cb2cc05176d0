/* Sites and weights of a power diagram on the torus whose cells all have the same area and whose sites are
 * near the centres of mass of their cells (Balzer, Schloemer, Deussen 2009; de Goes, Breeden, Ostromoukhov,
 * Desbrun 2012). Weights for given sites by damped Newton steps on the concave transport energy (the Hessian
 * is the graph Laplacian with length / (2 distance) on each edge; conjugate gradients), sites for given
 * weights by moving to the centres. Starts with one random site in each of n cells, whose density is nearly
 * uniform, so that moves are short. */
#include "points/pointset/relax/relaxation.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "points/pointset/sets.h"

enum {
    NEWTON_STEPS = 1, /* per round; after the last round until the areas are equal */
    LAST_NEWTON_STEPS = 60,
    HALVINGS = 30,
    SOLVER_STEPS = 600
};

/* Tolerated relative error of an area, and of the linear solutions. */
static const double area_tolerance = 1e-9;
static const double solver_tolerance = 1e-3;

/* The Laplacian's row of site i: its edges starts[i] .. starts[i + 1] - 1, and their sum. */
typedef struct laplacian {
    size_t *starts;
    uint32_t *columns;
    double *slopes, *diagonal;
} laplacian;

typedef struct transport {
    aur_power_diagram diagram;
    aur_point2 *sites;
    double *weights;
    double *step, *residual, *direction, *image, *candidate; /* vectors of the solver */
    laplacian matrix;
} transport;

static double dot(size_t count, const double *a, const double *b) {
    double sum = 0.0;
    for (size_t i = 0; i < count; ++i)
        sum += a[i] * b[i];
    return sum;
}

static void make_matrix(const aur_power_diagram *diagram, laplacian *m) {
    size_t edges = 0;
    for (size_t i = 0; i < diagram->count; ++i) {
        const aur_power_cell *const cell = &diagram->cells[i];
        m->starts[i] = edges;
        m->diagonal[i] = 0.0;
        for (size_t k = 0; k < cell->edge_count; ++k) {
            if (cell->neighbours[k] == i)
                continue;
            m->columns[edges] = cell->neighbours[k];
            m->slopes[edges++] = cell->slopes[k];
            m->diagonal[i] += cell->slopes[k];
        }
    }
    m->starts[diagram->count] = edges;
}

/* y = A x; returns x.y. */
static double apply(size_t count, const laplacian *m, const double *x, double *y) {
    double curvature = 0.0;
    for (size_t i = 0; i < count; ++i) {
        double sum = m->diagonal[i] * x[i];
        for (size_t k = m->starts[i]; k < m->starts[i + 1]; ++k)
            sum -= m->slopes[k] * x[m->columns[k]];
        y[i] = sum;
        curvature += x[i] * sum;
    }
    return curvature;
}

/* Solves the Laplacian for t->step with the area errors as right-hand side; conjugate gradients scaled by the
 * diagonal, in sequence. */
static void solve(transport *t) {
    const size_t n = t->diagram.count;
    make_matrix(&t->diagram, &t->matrix);
    for (size_t i = 0; i < n; ++i) {
        t->step[i] = 0.0;
        t->residual[i] = 1.0 / (double)n - t->diagram.cells[i].area;
        const double scale = t->matrix.diagonal[i];
        t->candidate[i] = scale > 0.0 ? 1.0 / scale : 0.0;
        t->direction[i] = t->candidate[i] * t->residual[i];
    }
    const double begin = dot(n, t->residual, t->residual);
    double old = dot(n, t->residual, t->direction);
    for (unsigned k = 0; k < SOLVER_STEPS && old > 0.0; ++k) {
        const double curvature = apply(n, &t->matrix, t->direction, t->image);
        if (!(curvature > 0.0))
            break;
        const double length = old / curvature;
        double left = 0.0;
        double now = 0.0;
        for (size_t i = 0; i < n; ++i) {
            t->step[i] += length * t->direction[i];
            const double residual = t->residual[i] - length * t->image[i];
            t->residual[i] = residual;
            left += residual * residual;
            now += residual * residual * t->candidate[i];
        }
        if (left <= solver_tolerance * solver_tolerance * begin)
            break;
        const double turn = now / old;
        for (size_t i = 0; i < n; ++i)
            t->direction[i] = t->candidate[i] * t->residual[i] + turn * t->direction[i];
        old = now;
    }
}

static double least_area(const aur_power_diagram *diagram) {
    double least = INFINITY;
    for (size_t i = 0; i < diagram->count; ++i)
        least = fmin(least, diagram->cells[i].area);
    return least;
}

static double worst_area(const aur_power_diagram *diagram) {
    double worst = 0.0;
    for (size_t i = 0; i < diagram->count; ++i)
        worst = fmax(worst, fabs((double)diagram->count * diagram->cells[i].area - 1.0));
    return worst;
}

static double norm_of_missing(const aur_power_diagram *diagram) {
    double sum = 0.0;
    for (size_t i = 0; i < diagram->count; ++i) {
        const double missing = 1.0 / (double)diagram->count - diagram->cells[i].area;
        sum += missing * missing;
    }
    return sqrt(sum);
}

/* One Newton step, halved until no cell is much smaller than the smallest one before and the area errors
 * decrease (Kitagawa, Merigot, Thibert 2019). False when no step is short enough. */
static bool newton_step(transport *t) {
    const size_t n = t->diagram.count;
    const double floor_area = 0.5 * fmin(least_area(&t->diagram), 1.0 / (double)n);
    const double before = norm_of_missing(&t->diagram);
    solve(t);
    memcpy(t->candidate, t->weights, n * sizeof *t->candidate);
    double length = 1.0;
    for (unsigned k = 0; k < HALVINGS; ++k, length *= 0.5) {
        for (size_t i = 0; i < n; ++i)
            t->weights[i] = t->candidate[i] + length * t->step[i];
        aur_power_diagram_compute(&t->diagram);
        if (least_area(&t->diagram) >= floor_area &&
            norm_of_missing(&t->diagram) <= (1.0 - 0.5 * length) * before + 1e-18)
            return true;
    }
    memcpy(t->weights, t->candidate, n * sizeof *t->candidate);
    aur_power_diagram_compute(&t->diagram);
    return false;
}

/* Moves sites to the centres of their cells. Weights are the next starting point unless they leave a cell
 * empty. */
static void move_sites(transport *t) {
    const size_t n = t->diagram.count;
    for (size_t i = 0; i < n; ++i) {
        t->sites[i].x = aur_unwrap(t->sites[i].x + t->diagram.cells[i].centre.x);
        t->sites[i].y = aur_unwrap(t->sites[i].y + t->diagram.cells[i].centre.y);
    }
    aur_site_grid_fill(&t->diagram.grid, n, t->sites);
    aur_power_diagram_compute(&t->diagram);
    if (least_area(&t->diagram) >= 0.1 / (double)n)
        return;
    memset(t->weights, 0, n * sizeof *t->weights);
    aur_power_diagram_compute(&t->diagram);
}

static void iterate(transport *t, unsigned rounds) {
    aur_site_grid_fill(&t->diagram.grid, t->diagram.count, t->sites);
    aur_power_diagram_compute(&t->diagram);
    t->diagram.warm = true;
    for (unsigned round = 0; round < rounds; ++round) {
        for (unsigned k = 0; k < NEWTON_STEPS && worst_area(&t->diagram) > area_tolerance; ++k)
            if (!newton_step(t))
                break;
        move_sites(t);
    }
    for (unsigned k = 0; k < LAST_NEWTON_STEPS && worst_area(&t->diagram) > area_tolerance; ++k)
        if (!newton_step(t))
            break;
}

/* One random site in each cell, in an order with locality. */
static aur_result begin(uint64_t seed, size_t count, aur_point2 *sites, aur_error *error) {
    const aur_pointset cells = {.kind = &aur_set_jittered, .size = count, .dimension = 2, .seed = seed};
    const aur_output output = {.capacity = 2 * count, .doubles = &sites[0].x};
    return aur_pointset_emit(&cells, 0, 0, count, &output, error);
}

/* Shuffles the sites, with `from` as scratch memory. */
static void mix(uint64_t seed, size_t count, aur_point2 *sites, uint32_t *order, aur_point2 *from) {
    for (size_t i = 0; i < count; ++i)
        order[i] = (uint32_t)i;
    aur_shuffle(count, order, seed);
    memcpy(from, sites, count * sizeof *from);
    for (size_t i = 0; i < count; ++i)
        sites[i] = from[order[i]];
}

aur_result aur_transport_relax(uint64_t seed, unsigned rounds, size_t count, aur_point2 *sites,
                               aur_error *error) {
    enum { VECTORS = 7 };
    double *const vectors = calloc(VECTORS * count, sizeof *vectors);
    transport t = {
        .diagram = {.count = count, .sites = sites, .cells = malloc(count * sizeof(aur_power_cell))},
        .sites = sites,
        .matrix = {.starts = malloc((count + 1) * sizeof(size_t)),
                   .columns = malloc(AUR_POWER_EDGES * count * sizeof(uint32_t)),
                   .slopes = malloc(AUR_POWER_EDGES * count * sizeof(double))}};
    aur_result result = begin(aur_hash2(seed, 3), count, sites, error);
    if (result == AUR_OK &&
        (!aur_site_grid_create(&t.diagram.grid, count) || vectors == NULL || t.diagram.cells == NULL ||
         t.matrix.starts == NULL || t.matrix.columns == NULL || t.matrix.slopes == NULL))
        result = aur_fail_memory(error);
    if (result == AUR_OK) {
        t.weights = vectors;
        t.step = vectors + count;
        t.residual = vectors + 2 * count;
        t.direction = vectors + 3 * count;
        t.image = vectors + 4 * count;
        t.candidate = vectors + 5 * count;
        t.matrix.diagonal = vectors + 6 * count;
        t.diagram.weights = t.weights;
        iterate(&t, rounds);
        mix(aur_hash2(seed, 4), count, sites, t.matrix.columns, (aur_point2 *)(void *)t.step);
    }
    aur_site_grid_destroy(&t.diagram.grid);
    free(vectors);
    free(t.diagram.cells);
    free(t.matrix.starts);
    free(t.matrix.columns);
    free(t.matrix.slopes);
    return result;
}
