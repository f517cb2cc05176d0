/* Blue noise through optimal transport (de Goes, Breeden, Ostromoukhov, Desbrun 2012), periodic: sites and
 * weights of a power diagram whose cells all have area 1/n and whose sites are near the centres of mass of
 * their cells. Weights for given sites by damped Newton steps on the concave transport energy (the Hessian is
 * the graph Laplacian with length / (2 distance) on each edge; conjugate gradients), sites for given weights
 * by moving to the centres. From random sites, by the seed. The number of rounds is fixed and small: a full
 * descent ends in crystals, whose patches the paper breaks up by jitter. A table: n up to 2^16, time about
 * n^(3/2). Error about N^-3/4 and lower for smooth functions; no alignments. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "pointset/relax/power_diagram.h"

enum {
    VERSION = 1,
    ROUNDS = 30,      /* of weights and sites in turns */
    NEWTON_STEPS = 2, /* a round; the last round goes on until the areas are right */
    LAST_NEWTON_STEPS = 60,
    HALVINGS = 30,
    SOLVER_STEPS = 600
};

/* Relative error of an area that is as good as none, and of the linear solutions. */
static const double area_tolerance = 1e-9;
static const double solver_tolerance = 1e-3;

typedef struct transport {
    aur_power_diagram diagram;
    aur_point2 *sites;
    double *weights;
    double *step, *residual, *direction, *image, *trial; /* vectors of the solver */
} transport;

static double dot(size_t count, const double *a, const double *b) {
    double sum = 0.0;
    for (size_t i = 0; i < count; ++i)
        sum += a[i] * b[i];
    return sum;
}

static double diagonal(const aur_power_cell *cell, size_t site) {
    double sum = 0.0;
    for (size_t k = 0; k < cell->edge_count; ++k)
        if (cell->neighbours[k] != site)
            sum += cell->slopes[k];
    return sum;
}

static void apply_laplacian(const aur_power_diagram *diagram, const double *x, double *y) {
    for (size_t i = 0; i < diagram->count; ++i) {
        const aur_power_cell *const cell = &diagram->cells[i];
        double sum = 0.0;
        for (size_t k = 0; k < cell->edge_count; ++k)
            sum += cell->slopes[k] * (x[i] - x[cell->neighbours[k]]);
        y[i] = sum;
    }
}

/* t->step solves the Laplacian for the missing areas; conjugate gradients scaled by the diagonal, in
 * sequence. */
static void solve(transport *t) {
    const size_t n = t->diagram.count;
    for (size_t i = 0; i < n; ++i) {
        t->step[i] = 0.0;
        t->residual[i] = 1.0 / (double)n - t->diagram.cells[i].area;
        const double scale = diagonal(&t->diagram.cells[i], i);
        t->trial[i] = scale > 0.0 ? 1.0 / scale : 0.0;
        t->direction[i] = t->trial[i] * t->residual[i];
    }
    const double begin = sqrt(dot(n, t->residual, t->residual));
    double old = dot(n, t->residual, t->direction);
    for (unsigned k = 0; k < SOLVER_STEPS && old > 0.0; ++k) {
        apply_laplacian(&t->diagram, t->direction, t->image);
        const double curvature = dot(n, t->direction, t->image);
        if (!(curvature > 0.0))
            break;
        const double length = old / curvature;
        for (size_t i = 0; i < n; ++i) {
            t->step[i] += length * t->direction[i];
            t->residual[i] -= length * t->image[i];
        }
        if (sqrt(dot(n, t->residual, t->residual)) <= solver_tolerance * begin)
            break;
        double now = 0.0;
        for (size_t i = 0; i < n; ++i)
            now += t->residual[i] * t->residual[i] * t->trial[i];
        for (size_t i = 0; i < n; ++i)
            t->direction[i] = t->trial[i] * t->residual[i] + now / old * t->direction[i];
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

/* One Newton step, halved until no cell is much smaller than the smallest one was and the areas come nearer
 * to what they should be (Kitagawa, Merigot, Thibert 2019). False when no step is short enough. */
static bool newton_step(transport *t) {
    const size_t n = t->diagram.count;
    const double floor_area = 0.5 * fmin(least_area(&t->diagram), 1.0 / (double)n);
    const double before = norm_of_missing(&t->diagram);
    solve(t);
    memcpy(t->trial, t->weights, n * sizeof *t->trial);
    double length = 1.0;
    for (unsigned k = 0; k < HALVINGS; ++k, length *= 0.5) {
        for (size_t i = 0; i < n; ++i)
            t->weights[i] = t->trial[i] + length * t->step[i];
        aur_power_diagram_compute(&t->diagram);
        if (least_area(&t->diagram) >= floor_area &&
            norm_of_missing(&t->diagram) <= (1.0 - 0.5 * length) * before + 1e-18)
            return true;
    }
    memcpy(t->weights, t->trial, n * sizeof *t->trial);
    aur_power_diagram_compute(&t->diagram);
    return false;
}

/* Sites to the centres of their cells. Weights are kept as a start unless they leave a cell empty. */
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

static void iterate(transport *t) {
    aur_site_grid_fill(&t->diagram.grid, t->diagram.count, t->sites);
    aur_power_diagram_compute(&t->diagram);
    for (unsigned round = 0; round < ROUNDS; ++round) {
        for (unsigned k = 0; k < NEWTON_STEPS && worst_area(&t->diagram) > area_tolerance; ++k)
            if (!newton_step(t))
                break;
        move_sites(t);
    }
    for (unsigned k = 0; k < LAST_NEWTON_STEPS && worst_area(&t->diagram) > area_tolerance; ++k)
        if (!newton_step(t))
            break;
}

static aur_result relax(uint64_t seed, size_t count, aur_point2 *sites, aur_error *error) {
    enum { VECTORS = 6 };
    double *const vectors = calloc(VECTORS * count, sizeof *vectors);
    transport t = {.diagram = {.count = count, .sites = sites}, .sites = sites};
    t.diagram.cells = malloc(count * sizeof *t.diagram.cells);
    if (!aur_site_grid_create(&t.diagram.grid, count) || vectors == NULL || t.diagram.cells == NULL) {
        aur_site_grid_destroy(&t.diagram.grid);
        free(vectors);
        free(t.diagram.cells);
        return aur_fail_memory(error);
    }
    t.weights = vectors;
    t.step = vectors + count;
    t.residual = vectors + 2 * count;
    t.direction = vectors + 3 * count;
    t.image = vectors + 4 * count;
    t.trial = vectors + 5 * count;
    t.diagram.weights = t.weights;
    aur_random_sites(aur_hash2(seed, 3), count, sites);
    iterate(&t);
    aur_site_grid_destroy(&t.diagram.grid);
    free(vectors);
    free(t.diagram.cells);
    return AUR_OK;
}

const aur_square_set aur_set_bnot = {
    .description = {.row = {.name = "bnot",
                            .summary = "blue noise through optimal transport, periodic",
                            .source = "de Goes, Breeden, Ostromoukhov, Desbrun 2012"},
                    .domains = AUR_ON_SQUARE,
                    .dimensions = {2, 2},
                    .maximum_size = 1 << 16},
    .scramblings = AUR_SCRAMBLES_SHIFT,
    .own = &(const aur_relaxation){VERSION, relax},
    .prepare = aur_prepare_relaxed,
    .fill = aur_fill_table,
};
