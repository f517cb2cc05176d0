#include "pointset/relax/power_diagram.h"

#include <math.h>

#include "core/parallel.h"

enum { VERTICES = 64, BATCH = 64 };

/* A convex polygon about the origin; edge k goes from vertex k to the next one. */
typedef struct polygon {
    size_t count;
    aur_point2 vertices[VERTICES];
    uint32_t neighbours[VERTICES];
    double distances[VERTICES]; /* to the neighbour's site */
} polygon;

static const uint32_t no_neighbour = UINT32_MAX;

static double reach_of(const polygon *p) {
    double farthest = 0.0;
    for (size_t k = 0; k < p->count; ++k)
        farthest = fmax(farthest, p->vertices[k].x * p->vertices[k].x + p->vertices[k].y * p->vertices[k].y);
    return sqrt(farthest);
}

/* Keeps the part where x.normal <= offset. */
static void clip(polygon *p, aur_point2 normal, double offset, uint32_t neighbour, double distance) {
    polygon result;
    result.count = 0;
    for (size_t k = 0; k < p->count && result.count + 2 < VERTICES; ++k) {
        const size_t next = k + 1 < p->count ? k + 1 : 0;
        const aur_point2 a = p->vertices[k];
        const aur_point2 b = p->vertices[next];
        const double side_a = a.x * normal.x + a.y * normal.y - offset;
        const double side_b = b.x * normal.x + b.y * normal.y - offset;
        const double t = side_a / (side_a - side_b);
        const aur_point2 crossing = {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
        if (side_a <= 0.0) {
            result.vertices[result.count] = a;
            result.neighbours[result.count] = p->neighbours[k];
            result.distances[result.count++] = p->distances[k];
            if (side_b > 0.0) {
                result.vertices[result.count] = crossing;
                result.neighbours[result.count] = neighbour;
                result.distances[result.count++] = distance;
            }
        } else if (side_b <= 0.0) {
            result.vertices[result.count] = crossing;
            result.neighbours[result.count] = p->neighbours[k];
            result.distances[result.count++] = p->distances[k];
        }
    }
    *p = result;
}

static void finish(const polygon *p, aur_power_cell *cell) {
    *cell = (aur_power_cell){0};
    for (size_t k = 0; k < p->count; ++k) {
        const size_t next = k + 1 < p->count ? k + 1 : 0;
        const aur_point2 a = p->vertices[k];
        const aur_point2 b = p->vertices[next];
        const double cross = a.x * b.y - a.y * b.x;
        cell->area += 0.5 * cross;
        cell->centre.x += cross * (a.x + b.x) / 6.0;
        cell->centre.y += cross * (a.y + b.y) / 6.0;
        if (p->neighbours[k] == no_neighbour || cell->edge_count == AUR_POWER_EDGES)
            continue;
        const double dx = b.x - a.x;
        const double dy = b.y - a.y;
        cell->neighbours[cell->edge_count] = p->neighbours[k];
        cell->slopes[cell->edge_count++] = sqrt(dx * dx + dy * dy) / (2.0 * p->distances[k]);
    }
    if (cell->area > 0.0) {
        cell->centre.x /= cell->area;
        cell->centre.y /= cell->area;
    }
}

typedef struct search {
    aur_power_diagram *diagram;
    double largest_weight;
} search;

/* Clips by all images of the sites of one cell of the grid, which may lie outside the torus' one copy. */
static void clip_by_cell(const aur_power_diagram *d, size_t site, ptrdiff_t column, ptrdiff_t row, polygon *p,
                         double *reach) {
    const ptrdiff_t side = (ptrdiff_t)d->grid.side;
    const ptrdiff_t turns_x = column >= 0 ? column / side : -((side - 1 - column) / side);
    const ptrdiff_t turns_y = row >= 0 ? row / side : -((side - 1 - row) / side);
    const size_t cell = (size_t)((row - turns_y * side) * side + (column - turns_x * side));
    for (uint32_t k = d->grid.start[cell]; k < d->grid.start[cell + 1]; ++k) {
        const uint32_t other = d->grid.sites[k];
        const aur_point2 to = {d->sites[other].x + (double)turns_x - d->sites[site].x,
                               d->sites[other].y + (double)turns_y - d->sites[site].y};
        const double squared = to.x * to.x + to.y * to.y;
        if (squared == 0.0)
            continue;
        /* x.to <= (|to|^2 + w - w') / 2 */
        const double offset = 0.5 * (squared + d->weights[site] - d->weights[other]);
        const double distance = sqrt(squared);
        if (offset >= *reach * distance)
            continue;
        clip(p, to, offset, other, distance);
        *reach = reach_of(p);
    }
}

static void compute_cell(const search *s, size_t site) {
    const aur_power_diagram *const d = s->diagram;
    /* Images of the site itself cut the cell to the unit square at most; begin with more than that. */
    polygon p = {.count = 4,
                 .vertices = {{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}},
                 .neighbours = {no_neighbour, no_neighbour, no_neighbour, no_neighbour}};
    double reach = reach_of(&p);
    const double side = (double)d->grid.side;
    const ptrdiff_t column = (ptrdiff_t)(d->sites[site].x * side);
    const ptrdiff_t row = (ptrdiff_t)(d->sites[site].y * side);
    clip_by_cell(d, site, column, row, &p, &reach);
    for (ptrdiff_t ring = 1; p.count > 0; ++ring) {
        for (ptrdiff_t k = -ring; k <= ring; ++k) {
            clip_by_cell(d, site, column + k, row - ring, &p, &reach);
            clip_by_cell(d, site, column + k, row + ring, &p, &reach);
        }
        for (ptrdiff_t k = -ring + 1; k < ring; ++k) {
            clip_by_cell(d, site, column - ring, row + k, &p, &reach);
            clip_by_cell(d, site, column + ring, row + k, &p, &reach);
        }
        /* Sites of the next ring are at least this far; their borders are beyond the cell when
         * distance^2 + w - w' >= 2 distance reach, which grows with the distance from `reach` on. */
        const double distance = (double)ring / side;
        if (distance >= reach &&
            distance * distance + d->weights[site] - s->largest_weight >= 2.0 * distance * reach)
            break;
    }
    finish(&p, &d->cells[site]);
}

static aur_result compute_batch(void *context, size_t index) {
    const search *const s = context;
    const size_t end = (index + 1) * BATCH < s->diagram->count ? (index + 1) * BATCH : s->diagram->count;
    for (size_t site = index * BATCH; site < end; ++site)
        compute_cell(s, site);
    return AUR_OK;
}

void aur_power_diagram_compute(aur_power_diagram *diagram) {
    search s = {.diagram = diagram, .largest_weight = -INFINITY};
    for (size_t i = 0; i < diagram->count; ++i)
        s.largest_weight = fmax(s.largest_weight, diagram->weights[i]);
    const aur_parallel_options options = {0};
    (void)aur_parallel_for(&options, (diagram->count + BATCH - 1) / BATCH, compute_batch, &s, NULL);
}
