/* Each cell alone: seen from its point through the gnomonic projection, a cell within 90 degrees is a convex
 * polygon, cut by one straight line for each neighbour. Neighbours farther than twice the cell's radius
 * cannot cut it. */
#include "quality/sphere/voronoi.h"

#include <math.h>
#include <stdlib.h>

#include "core/array.h"
#include "core/vector.h"
#include "core/vector3d.h"
#include "quality/sphere/cap_part.h"
#include "quality/sphere/sphere_grid.h"

/* The first polygon's half side, as a tangent: almost 90 degrees. */
static const double horizon = 1e6;

typedef struct polygon {
    size_t count, capacity; /* of both arrays together */
    aur_corner *corners, *spare;
    aur_corner *storage; /* of both */
} polygon;

typedef struct line {
    double a, b, c; /* keeps a p + b q <= c */
} line;

/* An empty polygon with room for `capacity` corners. */
static bool reserve(polygon *p, size_t capacity) {
    p->count = 0;
    if (!aur_array_reserve(&p->storage, &p->capacity, 2 * capacity, sizeof *p->storage))
        return false;
    p->corners = p->storage;
    p->spare = p->storage + capacity;
    return true;
}

/* A convex polygon gains one corner at most. */
static void cut(polygon *p, line l) {
    size_t kept = 0;
    for (size_t i = 0; i < p->count; ++i) {
        const aur_corner from = p->corners[i];
        const aur_corner to = p->corners[i + 1 < p->count ? i + 1 : 0];
        const double inside_from = l.c - l.a * from.p - l.b * from.q;
        const double inside_to = l.c - l.a * to.p - l.b * to.q;
        if (inside_from >= 0.0)
            p->spare[kept++] = from;
        if ((inside_from > 0.0 && inside_to < 0.0) || (inside_from < 0.0 && inside_to > 0.0)) {
            const double t = inside_from / (inside_from - inside_to);
            p->spare[kept++] = (aur_corner){from.p + t * (to.p - from.p), from.q + t * (to.q - from.q)};
        }
    }
    aur_corner *const corners = p->corners;
    p->corners = p->spare;
    p->spare = corners;
    p->count = kept;
}

static double greatest_tangent(const polygon *p) {
    double square = 0.0;
    for (size_t i = 0; i < p->count; ++i)
        square = fmax(square, p->corners[i].p * p->corners[i].p + p->corners[i].q * p->corners[i].q);
    return sqrt(square);
}

/* Triangles between the point and the sides (Van Oosterom and Strackee 1983). */
static double solid_angle(const polygon *p) {
    double sum = 0.0;
    for (size_t i = 0; i < p->count; ++i) {
        const aur_corner a = p->corners[i];
        const aur_corner b = p->corners[i + 1 < p->count ? i + 1 : 0];
        const double length_a = sqrt(1.0 + a.p * a.p + a.q * a.q);
        const double length_b = sqrt(1.0 + b.p * b.p + b.q * b.q);
        const double product = 1.0 + a.p * b.p + a.q * b.q;
        sum += 2.0 * atan2(a.p * b.q - a.q * b.p, length_a * length_b + length_a + length_b + product);
    }
    return sum;
}

enum { TANGENTS = 16 };

/* Cuts a cell by great circles just outside of the rim of a cap of at most 90 degrees, the first of them
 * where it is nearest to the cell's point, so that the cell has an end there; of a wider cap it has one by
 * its neighbours. */
static void cut_by_rim(polygon *p, double widest, const double x[3], const double first[3],
                       const double second[3]) {
    if (widest > 0.5 * AUR_PI)
        return;
    const double angle = widest + fmin(1e-3 * widest, 0.5 * (0.5 * AUR_PI - widest));
    for (size_t k = 0; k < TANGENTS; ++k) {
        const double azimuth = atan2(x[1], x[0]) + 2.0 * AUR_PI * (double)k / TANGENTS;
        const double inward[3] = {-cos(angle) * cos(azimuth), -cos(angle) * sin(azimuth), sin(angle)};
        cut(p, (line){-aur_dot3(inward, first), -aur_dot3(inward, second), fmax(aur_dot3(inward, x), 0.0)});
    }
}

/* What is wanted of the cells of the first `count` points: figures, or corners where `rows` is set. */
typedef struct cells {
    const aur_sphere_grid *grid;
    const aur_rim *rim; /* of the cap that ends the cells, or NULL */
    size_t count;
    aur_voronoi_cell *result;
    const size_t *first_row; /* of each cell */
    double *rows;            /* of AUR_CORNER_COLUMNS */
} cells;

enum { CELLS_PER_ITEM = 256 };

/* Cuts the cell of point `index` by all neighbours within `angle`; the number that share its place is added
 * up. */
static bool cut_cell(const cells *work, size_t index, const aur_neighbours *near, polygon *p,
                     size_t *coincident) {
    const aur_points_view *const points = work->grid->points;
    const double *const x = points->coordinates + 3 * index;
    double first[3], second[3];
    aur_frame3(x, first, second);
    if (!reserve(p, near->count + 8 + TANGENTS))
        return 0;
    const double widest = work->grid->widest;
    /* A small cap is all within a square that is no larger than it need be, which keeps digits. */
    const double side = work->rim != NULL && widest < 0.6 ? tan(2.2 * widest) : horizon;
    p->count = 4;
    p->corners[0] = (aur_corner){-side, -side};
    p->corners[1] = (aur_corner){side, -side};
    p->corners[2] = (aur_corner){side, side};
    p->corners[3] = (aur_corner){-side, side};
    if (work->rim != NULL)
        cut_by_rim(p, widest, x, first, second);
    else if (points->domain == AUR_DOMAIN_HEMISPHERE)
        cut(p, (line){-first[2], -second[2], fmax(x[2], 0.0)});
    *coincident = 1;
    for (size_t n = 0; n < near->count; ++n) {
        const double *const y = points->coordinates + 3 * near->items[n].index;
        if (near->items[n].square < 1e-28) {
            ++*coincident;
            continue;
        }
        cut(p, (line){aur_dot3(y, first), aur_dot3(y, second), 0.5 * near->items[n].square});
    }
    return 1;
}

static void keep_corners(const cells *work, size_t index, const polygon *p) {
    const double *const x = work->grid->points->coordinates + 3 * index;
    double first[3], second[3];
    aur_frame3(x, first, second);
    for (size_t i = 0; i < p->count; ++i) {
        double *const row = work->rows + AUR_CORNER_COLUMNS * (work->first_row[index] + i);
        const aur_corner c = p->corners[i];
        const double length = sqrt(1.0 + c.p * c.p + c.q * c.q);
        row[0] = (double)(index + 1);
        for (size_t d = 0; d < 3; ++d)
            row[1 + d] = (x[d] + c.p * first[d] + c.q * second[d]) / length;
    }
}

static aur_voronoi_cell figures_of(const cells *work, size_t index, const polygon *p, size_t coincident) {
    const double limit = 0.5 * horizon;
    if (work->rim == NULL) {
        const double tangent = greatest_tangent(p);
        return (aur_voronoi_cell){solid_angle(p) / (double)coincident, atan(tangent), p->count,
                                  tangent > limit};
    }
    const aur_cap_part part =
        aur_cap_part_of(work->rim, work->grid->points->coordinates + 3 * index, p->count, p->corners);
    return (aur_voronoi_cell){part.area / (double)coincident, part.radius, part.sides,
                              part.radius > atan(limit)};
}

static aur_result find_cell(const cells *work, size_t index, polygon *p, aur_neighbours *near) {
    for (double angle = 3.0 * work->grid->spacing;; angle *= 2.0) {
        const aur_result result = aur_sphere_grid_near(work->grid, index, angle, near);
        size_t coincident;
        if (result != AUR_OK || !cut_cell(work, index, near, p, &coincident))
            return AUR_ERROR_MEMORY;
        if (2.0 * atan(greatest_tangent(p)) > angle && angle < AUR_PI)
            continue;
        if (work->rows != NULL)
            keep_corners(work, index, p);
        else
            work->result[index] = figures_of(work, index, p, coincident);
        return AUR_OK;
    }
}

static aur_result find_cells(void *context, size_t item) {
    const cells *const work = context;
    polygon p = {0};
    aur_neighbours near = {0};
    aur_result result = AUR_OK;
    for (size_t i = item * CELLS_PER_ITEM;
         i < (item + 1) * CELLS_PER_ITEM && i < work->count && result == AUR_OK; ++i)
        result = find_cell(work, i, &p, &near);
    free(p.storage);
    free(near.items);
    return result;
}

/* Fills in the grid, which `work` has none of yet. */
static aur_result cut_cells(const aur_measure_request *request, cells work, aur_error *error) {
    aur_sphere_grid grid;
    const double cap = request->options.cap_degrees;
    const aur_rim rim = aur_rim_at(cap);
    work.grid = &grid;
    work.rim = cap > 0.0 ? &rim : NULL;
    aur_result result = aur_sphere_grid_create(request->points, cap > 0.0 ? cap * (AUR_PI / 180.0) : AUR_PI,
                                               request->arena, &grid, error);
    if (result == AUR_OK)
        result = aur_measure_items(&request->options, "cutting cells",
                                   (work.count + CELLS_PER_ITEM - 1) / CELLS_PER_ITEM, find_cells, &work,
                                   (aur_parallel_slice){work.result, CELLS_PER_ITEM * sizeof *work.result,
                                                        work.count * sizeof *work.result},
                                   error);
    return result;
}

aur_result aur_voronoi_cells(const aur_measure_request *request, aur_voronoi_cell **found, bool *unbounded,
                             aur_error *error) {
    const size_t count = request->points->count;
    const cells work = {.count = count,
                        .result = aur_arena_allocate(request->arena, count * sizeof *work.result)};
    const aur_result result = work.result != NULL ? cut_cells(request, work, error) : aur_fail_memory(error);
    *unbounded = false;
    for (size_t i = 0; i < count && result == AUR_OK; ++i)
        *unbounded |= work.result[i].unbounded;
    *found = work.result;
    return result;
}

aur_result aur_voronoi_corners(const aur_measure_request *request, size_t count,
                               const aur_voronoi_cell *found, double *rows, aur_error *error) {
    size_t *const first_row = aur_arena_allocate(request->arena, count * sizeof *first_row);
    if (first_row == NULL)
        return aur_fail_memory(error);
    for (size_t i = 0, row = 0; i < count; row += found[i++].sides)
        first_row[i] = row;
    return cut_cells(request, (cells){.count = count, .first_row = first_row, .rows = rows}, error);
}
