#include "points/pointset/relax/relaxation.h"

#include <math.h>
#include <string.h>

#include "points/base/parallel.h"

enum {
    VERTICES = 64,
    BATCH = 64,
    WARM_COUNT = 64 /* with so many sites no cell meets two images of another site */
};

/* A convex polygon about the origin; edge k goes from vertex k to the next one. */
typedef struct polygon {
    size_t count;
    double reach; /* the square of the farthest vertex' distance */
    aur_point2 vertices[VERTICES];
    uint32_t neighbours[VERTICES];
    double distances[VERTICES]; /* to the neighbour's site */
} polygon;

static const uint32_t no_neighbour = UINT32_MAX;

static void measure_reach(polygon *p) {
    double farthest = 0.0;
    for (size_t k = 0; k < p->count; ++k) {
        const double squared = p->vertices[k].x * p->vertices[k].x + p->vertices[k].y * p->vertices[k].y;
        farthest = squared > farthest ? squared : farthest;
    }
    p->reach = farthest;
}

static aur_point2 crossing(aur_point2 a, aur_point2 b, double side_a, double side_b) {
    const double t = side_a / (side_a - side_b);
    return (aur_point2){a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
}

/* Clips to the part where x.normal <= offset. */
static void clip(polygon *p, aur_point2 normal, double offset, uint32_t neighbour, double distance) {
    double sides[VERTICES];
    bool cut = false;
    for (size_t k = 0; k < p->count; ++k) {
        sides[k] = p->vertices[k].x * normal.x + p->vertices[k].y * normal.y - offset;
        cut = cut || sides[k] > 0.0;
    }
    if (!cut || p->count == VERTICES)
        return;
    /* Vertices from `out` to before `in` are cut off. */
    size_t out = 0;
    const size_t last = p->count - 1;
    while (out <= last && !(sides[out] > 0.0 && sides[out == 0 ? last : out - 1] <= 0.0))
        ++out;
    if (out > last) {
        p->count = 0;
        return;
    }
    size_t in = out;
    while (sides[in] > 0.0)
        in = in == last ? 0 : in + 1;
    polygon old;
    memcpy(old.vertices, p->vertices, p->count * sizeof old.vertices[0]);
    memcpy(old.neighbours, p->neighbours, p->count * sizeof old.neighbours[0]);
    memcpy(old.distances, p->distances, p->count * sizeof old.distances[0]);
    const size_t before = out == 0 ? last : out - 1;
    const size_t after = in == 0 ? last : in - 1;
    size_t clipped = 0;
    for (size_t k = in;; k = k == last ? 0 : k + 1) {
        p->vertices[clipped] = old.vertices[k];
        p->neighbours[clipped] = old.neighbours[k];
        p->distances[clipped++] = old.distances[k];
        if (k == before)
            break;
    }
    p->vertices[clipped] = crossing(old.vertices[before], old.vertices[out], sides[before], sides[out]);
    p->neighbours[clipped] = neighbour;
    p->distances[clipped++] = distance;
    p->vertices[clipped] = crossing(old.vertices[after], old.vertices[in], sides[after], sides[in]);
    p->neighbours[clipped] = old.neighbours[after];
    p->distances[clipped++] = old.distances[after];
    p->count = clipped;
    measure_reach(p);
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

/* Clips by an image of a site that is `to` away: x.to <= (|to|^2 + w - w') / 2. */
static void clip_by_site(const aur_power_diagram *d, size_t site, uint32_t other, aur_point2 to, polygon *p) {
    const double squared = to.x * to.x + to.y * to.y;
    const double offset = 0.5 * (squared + d->weights[site] - d->weights[other]);
    if (squared > 0.0 && !(offset > 0.0 && offset * offset >= p->reach * squared))
        clip(p, to, offset, other, sqrt(squared));
}

/* Whether the cell was clipped by this image already. */
static bool is_clipped(size_t clipped_count, const uint32_t *clipped, uint32_t other, aur_point2 to) {
    for (size_t k = 0; k < clipped_count; ++k)
        if (clipped[k] == other)
            return fabs(to.x) < 0.5 && fabs(to.y) < 0.5;
    return false;
}

/* Clips by all images of the sites of one grid cell, which may be outside the fundamental square. */
static void clip_by_cell(const aur_power_diagram *d, size_t site, ptrdiff_t column, ptrdiff_t row,
                         size_t clipped_count, const uint32_t *clipped, polygon *p) {
    const ptrdiff_t side = (ptrdiff_t)d->grid.side;
    const ptrdiff_t turns_x = column >= 0 ? column < side ? 0 : column / side : -((side - 1 - column) / side);
    const ptrdiff_t turns_y = row >= 0 ? row < side ? 0 : row / side : -((side - 1 - row) / side);
    const size_t cell = (size_t)((row - turns_y * side) * side + (column - turns_x * side));
    for (uint32_t k = d->grid.start[cell]; k < d->grid.start[cell + 1]; ++k) {
        const uint32_t other = d->grid.sites[k];
        const aur_point2 to = {d->sites[other].x + (double)turns_x - d->sites[site].x,
                               d->sites[other].y + (double)turns_y - d->sites[site].y};
        if (!is_clipped(clipped_count, clipped, other, to))
            clip_by_site(d, site, other, to, p);
    }
}

static void compute_cell(const search *s, size_t site) {
    const aur_power_diagram *const d = s->diagram;
    aur_power_cell *const cell = &d->cells[site];
    /* Images of the site itself cut the cell to the unit square at most; start with a larger cell. */
    polygon p = {.count = 4,
                 .reach = 2.0,
                 .vertices = {{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}},
                 .neighbours = {no_neighbour, no_neighbour, no_neighbour, no_neighbour}};
    uint32_t clipped[AUR_POWER_EDGES];
    size_t clipped_count = 0;
    if (d->warm && d->count >= WARM_COUNT) {
        clipped_count = cell->edge_count;
        for (size_t k = 0; k < clipped_count; ++k) {
            clipped[k] = cell->neighbours[k];
            clip_by_site(d, site, clipped[k], aur_wrapped_difference(d->sites[clipped[k]], d->sites[site]),
                         &p);
        }
    }
    const double side = (double)d->grid.side;
    const ptrdiff_t column = (ptrdiff_t)(d->sites[site].x * side);
    const ptrdiff_t row = (ptrdiff_t)(d->sites[site].y * side);
    clip_by_cell(d, site, column, row, clipped_count, clipped, &p);
    for (ptrdiff_t ring = 1; p.count > 0; ++ring) {
        /* Sites of this ring are at least this far; their edges are beyond the cell when distance^2 + w - w'
         * >= 2 distance reach, which grows with the distance from `reach` on. */
        const double distance = (double)(ring - 1) / side;
        const double reach = sqrt(p.reach);
        if (distance >= reach &&
            distance * distance + d->weights[site] - s->largest_weight >= 2.0 * distance * reach)
            break;
        for (ptrdiff_t k = -ring; k <= ring; ++k) {
            clip_by_cell(d, site, column + k, row - ring, clipped_count, clipped, &p);
            clip_by_cell(d, site, column + k, row + ring, clipped_count, clipped, &p);
        }
        for (ptrdiff_t k = -ring + 1; k < ring; ++k) {
            clip_by_cell(d, site, column - ring, row + k, clipped_count, clipped, &p);
            clip_by_cell(d, site, column + ring, row + k, clipped_count, clipped, &p);
        }
    }
    finish(&p, cell);
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
