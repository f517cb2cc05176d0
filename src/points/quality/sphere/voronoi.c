/* Each cell is computed separately: the sphere, cut by one great circle for each neighbour. Neighbours
 * farther than twice the cell's radius cannot cut it. */
#include "points/quality/sphere/voronoi.h"

#include <math.h>
#include <stdlib.h>

#include "points/base/array.h"
#include "points/base/vector.h"
#include "points/base/vector3d.h"

/* A point and two perpendicular directions: the frame of its cell. */
typedef struct cell_frame {
    const double *point;
    double first[3], second[3];
} cell_frame;

static cell_frame frame_at(const double *point) {
    cell_frame frame = {.point = point};
    aur_frame3(point, frame.first, frame.second);
    return frame;
}

/* Cuts to the positive side of `normal`, whose product with the frame's point is `along`. */
static void cut(aur_cell *cell, const cell_frame *frame, const double normal[3], double along) {
    const double local[3] = {aur_dot3(normal, frame->first), aur_dot3(normal, frame->second), along};
    aur_cell_cut(cell, local);
}

static void direction_of(const cell_frame *frame, const double local[3], double direction[3]) {
    for (size_t d = 0; d < 3; ++d)
        direction[d] = local[2] * frame->point[d] + local[0] * frame->first[d] + local[1] * frame->second[d];
    aur_normalize3(direction);
}

enum { TANGENTS = 16 };

/* Cuts a cell by great circles just outside of the rim of a cap of at most 90 degrees, the first where the
 * rim is nearest to the cell's point, so that the cell is bounded there; in a wider cap the neighbours bound
 * it. */
static void cut_by_rim(aur_cell *cell, const cell_frame *frame, double widest) {
    if (widest > 0.5 * AUR_PI)
        return;
    const double *const x = frame->point;
    const double angle = widest + fmin(1e-3 * widest, 0.5 * (0.5 * AUR_PI - widest));
    for (size_t k = 0; k < TANGENTS; ++k) {
        const double azimuth = atan2(x[1], x[0]) + 2.0 * AUR_PI * (double)k / TANGENTS;
        const double inward[3] = {-cos(angle) * cos(azimuth), -cos(angle) * sin(azimuth), sin(angle)};
        cut(cell, frame, inward, fmax(aur_dot3(inward, x), 0.0));
    }
}

/* Computes the cells of the first `count` points: areas and radii, or corners if `rows` is set. */
typedef struct cells {
    const aur_sphere_grid *grid;
    const aur_rim *rim; /* of the cap that bounds the cells, or NULL */
    size_t count;
    aur_voronoi_cell *result;
    const size_t *first_row; /* of each cell */
    double *rows;            /* of AUR_CORNER_COLUMNS */
} cells;

enum { CELLS_PER_ITEM = 256 };

/* Memory of one thread. */
typedef struct cell_work {
    aur_cell cell;
    aur_neighbours near;
    size_t corner_capacity;
    double (*corners)[3];
} cell_work;

/* Cuts the cell of a point by its neighbours `near`; *coincident is the number of coincident points. */
static bool cut_cell(const cells *work, const cell_frame *frame, cell_work *scratch, size_t *coincident) {
    const aur_points_view *const points = work->grid->points;
    aur_cell *const cell = &scratch->cell;
    if (!aur_cell_begin(cell, scratch->near.count + 1 + TANGENTS))
        return false;
    static const double up[3] = {0.0, 0.0, 1.0};
    if (work->rim != NULL)
        cut_by_rim(cell, frame, work->grid->widest);
    else if (points->domain == AUR_DOMAIN_HEMISPHERE)
        cut(cell, frame, up, fmax(frame->point[2], 0.0));
    *coincident = 1;
    for (size_t n = 0; n < scratch->near.count; ++n) {
        const aur_neighbour *const item = &scratch->near.items[n];
        const double *const y = points->coordinates + 3 * item->index;
        if (item->square < 1e-28) {
            ++*coincident;
            continue;
        }
        double away[3];
        for (size_t d = 0; d < 3; ++d)
            away[d] = frame->point[d] - y[d];
        cut(cell, frame, away, 0.5 * item->square);
    }
    return true;
}

static void store_corners(const cells *work, size_t index, const cell_frame *frame, const aur_cell *cell) {
    for (size_t i = 0; i < cell->count; ++i) {
        double *const row = work->rows + AUR_CORNER_COLUMNS * (work->first_row[index] + i);
        row[0] = (double)(index + 1);
        direction_of(frame, cell->sides[i].corner, row + 1);
    }
}

/* The area is NAN if a cell of a cap is not a polygon. */
static bool measure_cell(const cells *work, const cell_frame *frame, cell_work *scratch, size_t coincident,
                         aur_voronoi_cell *found) {
    const aur_cell *const cell = &scratch->cell;
    if (work->rim == NULL) {
        *found =
            (aur_voronoi_cell){aur_cell_area(cell) / (double)coincident, aur_cell_radius(cell), cell->count};
        return true;
    }
    *found = (aur_voronoi_cell){.area = NAN};
    if (cell->count < 3)
        return true;
    if (!aur_array_reserve(&scratch->corners, &scratch->corner_capacity, cell->count,
                           sizeof *scratch->corners))
        return false;
    for (size_t i = 0; i < cell->count; ++i)
        direction_of(frame, cell->sides[i].corner, scratch->corners[i]);
    const aur_cap_part part =
        aur_cap_part_of(work->rim, frame->point, cell->count, (const double(*)[3])scratch->corners);
    *found = (aur_voronoi_cell){part.area / (double)coincident, part.radius, part.sides};
    return true;
}

static aur_result find_cell(const cells *work, size_t index, cell_work *scratch) {
    const cell_frame frame = frame_at(work->grid->points->coordinates + 3 * index);
    for (double angle = 3.0 * work->grid->spacing;; angle *= 2.0) {
        const aur_result result = aur_sphere_grid_near(work->grid, index, angle, &scratch->near);
        size_t coincident;
        if (result != AUR_OK || !cut_cell(work, &frame, scratch, &coincident))
            return AUR_ERROR_MEMORY;
        if (2.0 * aur_cell_radius(&scratch->cell) > angle && angle < AUR_PI)
            continue;
        if (work->rows != NULL)
            store_corners(work, index, &frame, &scratch->cell);
        else if (!measure_cell(work, &frame, scratch, coincident, &work->result[index]))
            return AUR_ERROR_MEMORY;
        return AUR_OK;
    }
}

static aur_result find_cells(void *context, size_t item) {
    const cells *const work = context;
    cell_work scratch = {0};
    aur_result result = AUR_OK;
    for (size_t i = item * CELLS_PER_ITEM;
         i < (item + 1) * CELLS_PER_ITEM && i < work->count && result == AUR_OK; ++i)
        result = find_cell(work, i, &scratch);
    aur_cell_release(&scratch.cell);
    free(scratch.near.items);
    free(scratch.corners);
    return result;
}

/* Builds the grid of `work`. */
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

aur_result aur_voronoi_cells(const aur_measure_request *request, aur_voronoi_cell **found, aur_error *error) {
    const size_t count = request->points->count;
    const cells work = {.count = count,
                        .result = aur_arena_allocate(request->arena, count * sizeof *work.result)};
    aur_result result = work.result != NULL ? cut_cells(request, work, error) : aur_fail_memory(error);
    for (size_t i = 0; i < count && result == AUR_OK; ++i)
        if (isnan(work.result[i].area))
            result = aur_fail(
                error, AUR_ERROR_UNSUPPORTED,
                "the cell of point %zu has fewer than three sides: a cap wider than 90 degrees must have "
                "points all around",
                i + 1);
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
