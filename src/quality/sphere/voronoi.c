/* Each cell alone: seen from its point through the gnomonic projection, a cell within 90 degrees is a convex
 * polygon, cut by one straight line for each neighbour. Neighbours farther than twice the cell's radius
 * cannot cut it. */
#include "quality/sphere/voronoi.h"

#include <math.h>
#include <stdlib.h>

#include "core/array.h"
#include "core/vector.h"
#include "core/vector3d.h"
#include "quality/sphere/sphere_grid.h"

/* The first polygon's half side, as a tangent: almost 90 degrees. */
static const double horizon = 1e6;

typedef struct corner {
    double p, q;
} corner;

typedef struct polygon {
    size_t count, capacity; /* of both arrays together */
    corner *corners, *spare;
    corner *storage; /* of both */
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
        const corner from = p->corners[i];
        const corner to = p->corners[i + 1 < p->count ? i + 1 : 0];
        const double inside_from = l.c - l.a * from.p - l.b * from.q;
        const double inside_to = l.c - l.a * to.p - l.b * to.q;
        if (inside_from >= 0.0)
            p->spare[kept++] = from;
        if ((inside_from > 0.0 && inside_to < 0.0) || (inside_from < 0.0 && inside_to > 0.0)) {
            const double t = inside_from / (inside_from - inside_to);
            p->spare[kept++] = (corner){from.p + t * (to.p - from.p), from.q + t * (to.q - from.q)};
        }
    }
    corner *const corners = p->corners;
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
        const corner a = p->corners[i];
        const corner b = p->corners[i + 1 < p->count ? i + 1 : 0];
        const double length_a = sqrt(1.0 + a.p * a.p + a.q * a.q);
        const double length_b = sqrt(1.0 + b.p * b.p + b.q * b.q);
        const double product = 1.0 + a.p * b.p + a.q * b.q;
        sum += 2.0 * atan2(a.p * b.q - a.q * b.p, length_a * length_b + length_a + length_b + product);
    }
    return sum;
}

/* What is wanted of the cells of the first `count` points: figures, or corners where `rows` is set. */
typedef struct cells {
    const aur_sphere_grid *grid;
    size_t count;
    aur_voronoi_cell *result;
    const size_t *first_row; /* of each cell */
    double *rows;            /* of AUR_CORNER_COLUMNS */
} cells;

enum { CELLS_PER_ITEM = 256 };

/* Cuts the cell of point `index` by all neighbours within `angle`; the number that share its place is added
 * up. */
static bool cut_cell(const aur_points_view *points, size_t index, const aur_neighbours *near, polygon *p,
                     size_t *coincident) {
    const double *const x = points->coordinates + 3 * index;
    double first[3], second[3];
    aur_frame3(x, first, second);
    if (!reserve(p, near->count + 8))
        return 0;
    p->count = 4;
    p->corners[0] = (corner){-horizon, -horizon};
    p->corners[1] = (corner){horizon, -horizon};
    p->corners[2] = (corner){horizon, horizon};
    p->corners[3] = (corner){-horizon, horizon};
    if (points->domain == AUR_DOMAIN_HEMISPHERE)
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
        const corner c = p->corners[i];
        const double length = sqrt(1.0 + c.p * c.p + c.q * c.q);
        row[0] = (double)(index + 1);
        for (size_t d = 0; d < 3; ++d)
            row[1 + d] = (x[d] + c.p * first[d] + c.q * second[d]) / length;
    }
}

static aur_result find_cell(const cells *work, size_t index, polygon *p, aur_neighbours *near) {
    for (double angle = 3.0 * work->grid->spacing;; angle *= 2.0) {
        const aur_result result = aur_sphere_grid_near(work->grid, index, angle, near);
        size_t coincident;
        if (result != AUR_OK || !cut_cell(work->grid->points, index, near, p, &coincident))
            return AUR_ERROR_MEMORY;
        const double tangent = greatest_tangent(p);
        const double radius = atan(tangent);
        if (2.0 * radius > angle && angle < AUR_PI)
            continue;
        if (work->rows != NULL)
            keep_corners(work, index, p);
        else
            work->result[index] = (aur_voronoi_cell){solid_angle(p) / (double)coincident, radius, p->count,
                                                     tangent > 0.5 * horizon};
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
    work.grid = &grid;
    aur_result result = aur_sphere_grid_create(request->points, request->arena, &grid, error);
    if (result == AUR_OK)
        result =
            aur_measure_items(&request->options, "cutting cells",
                              (work.count + CELLS_PER_ITEM - 1) / CELLS_PER_ITEM, find_cells, &work, error);
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
