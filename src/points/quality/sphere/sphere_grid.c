#include "points/quality/sphere/voronoi.h"

#include <math.h>
#include <stdlib.h>

#include "points/base/array.h"
#include "points/base/error.h"
#include "points/base/vector.h"

static double polar_angle(const double *x) {
    return atan2(hypot(x[0], x[1]), x[2]);
}

static size_t band_of(const aur_sphere_grid *grid, double theta) {
    const double at = theta / grid->widest * (double)grid->band_count;
    const size_t band = at > 0.0 ? (size_t)at : 0;
    return band < grid->band_count ? band : grid->band_count - 1;
}

static size_t cells_in(const aur_sphere_grid *grid, size_t band) {
    return grid->band_cells[band + 1] - grid->band_cells[band];
}

/* The cell of an azimuth in a band; the azimuth may be outside [0, 2 pi). */
static size_t cell_of(const aur_sphere_grid *grid, size_t band, double phi) {
    const size_t cells = cells_in(grid, band);
    double turn = phi / (2.0 * AUR_PI);
    turn -= floor(turn);
    const size_t cell = (size_t)(turn * (double)cells);
    return grid->band_cells[band] + (cell < cells ? cell : cells - 1);
}

static size_t cell_of_point(const aur_sphere_grid *grid, size_t index) {
    const double *const x = grid->points->coordinates + 3 * index;
    return cell_of(grid, band_of(grid, polar_angle(x)), atan2(x[1], x[0]));
}

aur_result aur_sphere_grid_create(const aur_points_view *points, double widest, aur_arena *arena,
                                  aur_sphere_grid *grid, aur_error *error) {
    const double half = sin(0.5 * widest);
    const double spacing = half * sqrt(4.0 * AUR_PI / (double)points->count);
    *grid = (aur_sphere_grid){
        .points = points, .widest = widest, .spacing = spacing, .band_count = (size_t)ceil(widest / spacing)};
    grid->band_cells = aur_arena_allocate(arena, (grid->band_count + 1) * sizeof *grid->band_cells);
    grid->order = aur_arena_allocate(arena, points->count * sizeof *grid->order);
    if (grid->band_cells == NULL || grid->order == NULL)
        return aur_fail_memory(error);
    for (size_t b = 0; b < grid->band_count; ++b) {
        const double middle = widest * ((double)b + 0.5) / (double)grid->band_count;
        const size_t cells = (size_t)(2.0 * AUR_PI * sin(middle) / spacing);
        grid->band_cells[b + 1] = grid->band_cells[b] + (cells > 0 ? cells : 1);
    }
    const size_t cells = grid->band_cells[grid->band_count];
    grid->cell_start = aur_arena_allocate(arena, (cells + 2) * sizeof *grid->cell_start);
    if (grid->cell_start == NULL)
        return aur_fail_memory(error);
    /* Counts are shifted by two entries, so that filling leaves the start of each cell in place. */
    for (size_t i = 0; i < points->count; ++i)
        ++grid->cell_start[cell_of_point(grid, i) + 2];
    for (size_t c = 2; c < cells + 2; ++c)
        grid->cell_start[c] += grid->cell_start[c - 1];
    for (size_t i = 0; i < points->count; ++i)
        grid->order[grid->cell_start[cell_of_point(grid, i) + 1]++] = i;
    return AUR_OK;
}

static int nearest_first(const void *a, const void *b) {
    const aur_neighbour *const p = a;
    const aur_neighbour *const q = b;
    if (p->square != q->square)
        return p->square < q->square ? -1 : 1;
    return (p->index > q->index) - (p->index < q->index);
}

typedef struct search {
    const aur_sphere_grid *grid;
    size_t index;
    const double *centre;
    double limit; /* of the square of the chord */
    aur_neighbours *found;
} search;

static bool search_cell(const search *s, size_t cell) {
    for (size_t o = s->grid->cell_start[cell]; o < s->grid->cell_start[cell + 1]; ++o) {
        const size_t i = s->grid->order[o];
        const double *const x = s->grid->points->coordinates + 3 * i;
        double square = 0.0;
        for (size_t d = 0; d < 3; ++d)
            square += (x[d] - s->centre[d]) * (x[d] - s->centre[d]);
        if (i == s->index || square > s->limit)
            continue;
        aur_neighbours *const found = s->found;
        if (!aur_array_reserve(&found->items, &found->capacity, found->count + 1, sizeof *found->items))
            return false;
        found->items[found->count++] = (aur_neighbour){square, i};
    }
    return true;
}

aur_result aur_sphere_grid_near(const aur_sphere_grid *grid, size_t index, double angle,
                                aur_neighbours *neighbours) {
    const double *const x = grid->points->coordinates + 3 * index;
    const double chord = angle < AUR_PI ? 2.0 * sin(0.5 * angle) : 3.0;
    const search s = {grid, index, x, chord * chord, neighbours};
    neighbours->count = 0;
    const double theta = polar_angle(x), phi = atan2(x[1], x[0]);
    const double slack = 1e-9; /* the edges of cells are rounded */
    /* Half the width in azimuth of the cap; all of it when a pole is inside. */
    const double reach = angle + slack;
    const double ratio = theta - reach <= 0.0 || theta + reach >= AUR_PI ? 2.0 : sin(reach) / sin(theta);
    const double half_width = ratio < 1.0 ? asin(ratio) + slack : AUR_PI;
    for (size_t band = band_of(grid, theta - reach); band <= band_of(grid, theta + reach); ++band) {
        const size_t first_cell = grid->band_cells[band];
        const size_t cells = cells_in(grid, band);
        const size_t first = cell_of(grid, band, phi - half_width) - first_cell;
        const double width = 2.0 * half_width / (2.0 * AUR_PI) * (double)cells;
        const size_t steps = width + 2.0 < (double)cells ? (size_t)width + 2 : cells;
        for (size_t step = 0; step < steps; ++step)
            if (!search_cell(&s, first_cell + (first + step) % cells))
                return AUR_ERROR_MEMORY;
    }
    if (neighbours->count > 0)
        qsort(neighbours->items, neighbours->count, sizeof *neighbours->items, nearest_first);
    return AUR_OK;
}
