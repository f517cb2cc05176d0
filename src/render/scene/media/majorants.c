/* Grid traversal by Amanatides and Woo (1987). */
#include "render/scene/media/majorants.h"

#include <stdlib.h>

enum { VOXELS_A_CELL = 4, MOST_CELLS = 64 };

aur_result aur_majorants_create(const aur_volume *volume, float scale, aur_majorants *majorants,
                                aur_error *error) {
    *majorants = (aur_majorants){.volume = volume};
    size_t count = 1;
    for (size_t k = 0; k < 3; ++k) {
        const size_t requested = (volume->voxels[k] + VOXELS_A_CELL - 1) / VOXELS_A_CELL;
        majorants->cells[k] = requested < MOST_CELLS ? requested : MOST_CELLS;
        count *= majorants->cells[k];
    }
    majorants->values = malloc(count * sizeof *majorants->values);
    if (majorants->values == NULL)
        return aur_fail_memory(error);
    const size_t *const cells = majorants->cells;
    for (size_t i = 0; i < count; ++i) {
        const size_t cell[3] = {i % cells[0], i / cells[0] % cells[1], i / cells[0] / cells[1]};
        float lower[3], upper[3];
        for (size_t k = 0; k < 3; ++k) {
            lower[k] = (float)cell[k] / (float)cells[k];
            upper[k] = (float)(cell[k] + 1) / (float)cells[k];
        }
        /* A little more than the largest value, as interpolation rounds. */
        majorants->values[i] = 1.00001f * scale * volume->descriptor->maximum_within(volume, lower, upper);
    }
    return AUR_OK;
}

void aur_majorants_release(aur_majorants *majorants) {
    free(majorants->values);
}

void aur_majorant_walk_begin(const aur_majorants *majorants, const aur_ray *ray, float distance,
                             aur_majorant_walk *walk) {
    const aur_vector from = aur_volume_local(majorants->volume, ray->origin);
    const aur_vector along = aur_volume_local_direction(majorants->volume, ray->direction);
    const float origin[3] = {from.x, from.y, from.z}, direction[3] = {along.x, along.y, along.z};
    *walk = (aur_majorant_walk){.majorants = majorants, .end = distance};
    /* The interval of the ray in the unit cube. */
    for (size_t k = 0; k < 3; ++k) {
        if (direction[k] == 0.0f) {
            if (!(origin[k] >= 0.0f && origin[k] <= 1.0f))
                walk->end = -1.0f;
            continue;
        }
        const float a = -origin[k] / direction[k], b = (1.0f - origin[k]) / direction[k];
        walk->position = aur_larger(walk->position, aur_smaller(a, b));
        walk->end = aur_smaller(walk->end, aur_larger(a, b));
    }
    if (!(walk->position < walk->end))
        return;
    for (size_t k = 0; k < 3; ++k) {
        const float count = (float)majorants->cells[k];
        const float at = (origin[k] + walk->position * direction[k]) * count;
        const float cell = aur_smaller(aur_larger(floorf(at), 0.0f), count - 1.0f);
        walk->cell[k] = (ptrdiff_t)cell;
        walk->way[k] = direction[k] < 0.0f ? -1 : 1;
        walk->step[k] = direction[k] != 0.0f ? 1.0f / (count * fabsf(direction[k])) : INFINITY;
        const float border = (cell + (direction[k] < 0.0f ? 0.0f : 1.0f)) / count;
        walk->next[k] = direction[k] != 0.0f ? (border - origin[k]) / direction[k] : INFINITY;
    }
}

bool aur_majorant_walk_next(aur_majorant_walk *walk, float *from, float *to, float *majorant) {
    const size_t *const cells = walk->majorants->cells;
    if (!(walk->position < walk->end))
        return false;
    const size_t index =
        ((size_t)walk->cell[2] * cells[1] + (size_t)walk->cell[1]) * cells[0] + (size_t)walk->cell[0];
    size_t k = walk->next[0] < walk->next[1] ? 0 : 1;
    k = walk->next[2] < walk->next[k] ? 2 : k;
    *majorant = walk->majorants->values[index];
    *from = walk->position;
    *to = aur_smaller(aur_larger(walk->next[k], walk->position), walk->end);
    walk->position = *to;
    walk->next[k] += walk->step[k];
    walk->cell[k] += walk->way[k];
    if (walk->cell[k] < 0 || walk->cell[k] >= (ptrdiff_t)cells[k])
        walk->end = -1.0f; /* past the last cell */
    return true;
}
