#include "points/pointset/relax/relaxation.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/error.h"
#include "points/base/file.h"

bool aur_site_grid_create(aur_site_grid *grid, size_t count) {
    grid->side = 1;
    while ((grid->side + 1) * (grid->side + 1) <= count)
        ++grid->side;
    grid->start = malloc((grid->side * grid->side + 2) * sizeof *grid->start);
    grid->sites = malloc(count * sizeof *grid->sites);
    return grid->start != NULL && grid->sites != NULL;
}

void aur_site_grid_destroy(aur_site_grid *grid) {
    free(grid->start);
    free(grid->sites);
    *grid = (aur_site_grid){0};
}

static size_t cell_of(const aur_site_grid *grid, aur_point2 p) {
    const double side = (double)grid->side;
    return (size_t)(p.y * side) * grid->side + (size_t)(p.x * side);
}

void aur_site_grid_fill(aur_site_grid *grid, size_t count, const aur_point2 *sites) {
    const size_t cells = grid->side * grid->side;
    uint32_t *const start = grid->start;
    memset(start, 0, (cells + 2) * sizeof *start);
    for (size_t i = 0; i < count; ++i)
        ++start[cell_of(grid, sites[i]) + 2];
    for (size_t c = 0; c <= cells; ++c)
        start[c + 1] += start[c];
    /* start[c + 1] is the beginning of cell c; inserting its sites advances it to the end of the cell. */
    for (size_t i = 0; i < count; ++i)
        grid->sites[start[cell_of(grid, sites[i]) + 1]++] = (uint32_t)i;
}

aur_result aur_prepare_relaxed(aur_pointset *set, aur_parameters *keys, aur_error *error) {
    (void)keys;
    const aur_relaxation *const how = set->kind->kind_data;
    const char *const name = set->kind->description.row.name;
    const size_t bytes = (size_t)set->size * sizeof(aur_point2);
    char key[128];
    snprintf(key, sizeof key, "%s %u %" PRIu64 " %" PRIu64, name, how->version, set->size, set->seed);
    size_t size;
    set->data = aur_cache_file_read(name, key, &size);
    if (set->data != NULL && size == bytes)
        return AUR_OK;
    free(set->data);
    set->data = malloc(bytes);
    if (set->data == NULL)
        return aur_fail_memory(error);
    const aur_result result = how->relax(set->seed, (size_t)set->size, set->data, error);
    if (result == AUR_OK)
        aur_cache_file_write(name, key, bytes, set->data);
    return result;
}
