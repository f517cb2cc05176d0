/* A hash grid over surface points: space is cut in cubes, and each cube in six by the direction that the
 * surface faces. It answers "which sample stands for this place" by one read. */
#ifndef AUR_TRANSPORT_SURFACE_CELLS_H
#define AUR_TRANSPORT_SURFACE_CELLS_H

#include <aureole/core.h>

#include "core/vector.h"

typedef struct aur_surface_cell {
    uint64_t key; /* 0: empty */
    uint32_t
        item; /* of cells with samples: their number, in the order of first samples; else what was offered */
    uint32_t sample; /* the sample nearest to the cell's centre, or AUR_NO_CELL where none fell */
} aur_surface_cell;

typedef struct aur_surface_cells {
    aur_vector origin;
    float size;   /* edge of a cube, scene units */
    size_t count; /* cells with samples */
    size_t used;  /* cells in all */
    size_t mask;  /* slots - 1 */
    aur_surface_cell *slots;
} aur_surface_cells;

#define AUR_NO_CELL UINT32_MAX

/* Positions and normals of samples, `stride` bytes apart. */
typedef struct aur_surface_samples {
    size_t count;
    size_t stride;
    const aur_vector *positions;
    const aur_vector *normals;
} aur_surface_samples;

/* Chooses the cubes' size such that about `wanted` cells hold samples, and fills them. At most 2^31 samples.
 */
aur_result aur_surface_cells_build(aur_surface_cells *cells, const aur_surface_samples *samples,
                                   size_t wanted);
typedef struct aur_surface_disc {
    aur_vector position, normal;
    float radius;
} aur_surface_disc;

/* Lets item i serve the cells of its disc, discs[i], in which no sample fell and to whose centre no other
 * such item is nearer. */
aur_result aur_surface_cells_spread(aur_surface_cells *cells, size_t count, const aur_surface_disc *discs);

void aur_surface_cells_release(aur_surface_cells *cells);

/* The cell's item, or AUR_NO_CELL where there is none. */
uint32_t aur_surface_cells_find(const aur_surface_cells *cells, aur_vector position, aur_vector normal);

#endif
