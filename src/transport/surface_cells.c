#include "transport/surface_cells.h"

#include <stdlib.h>
#include <string.h>

#include "core/random.h"

/* A disc is spread over so many half cells from its centre at most. */
static const float MOST_REACH = 64.0f;

enum { COORDINATE_BITS = 20, COORDINATE_MAX = (1 << COORDINATE_BITS) - 1, SIZING_ROUNDS = 5 };

/* Which side of a cube the normal goes through: 0 to 5. */
static uint64_t facing(aur_vector n) {
    const float x = fabsf(n.x), y = fabsf(n.y), z = fabsf(n.z);
    if (x >= y && x >= z)
        return n.x < 0.0f ? 1 : 0;
    if (y >= z)
        return n.y < 0.0f ? 3 : 2;
    return n.z < 0.0f ? 5 : 4;
}

static uint64_t quantized(float coordinate, float origin, float size) {
    const float cell = floorf((coordinate - origin) / size);
    if (!(cell > 0.0f))
        return 0;
    return cell < (float)COORDINATE_MAX ? (uint64_t)cell : COORDINATE_MAX;
}

/* Never 0, which marks an empty slot. */
static uint64_t key_of(const aur_surface_cells *cells, aur_vector position, aur_vector normal) {
    const uint64_t x = quantized(position.x, cells->origin.x, cells->size);
    const uint64_t y = quantized(position.y, cells->origin.y, cells->size);
    const uint64_t z = quantized(position.z, cells->origin.z, cells->size);
    return (x << (2 * COORDINATE_BITS) | y << COORDINATE_BITS | z) * 8 + facing(normal) + 1;
}

static aur_surface_cell *slot_of(const aur_surface_cells *cells, uint64_t key) {
    size_t at = (size_t)aur_mix64(key) & cells->mask;
    while (cells->slots[at].key != 0 && cells->slots[at].key != key)
        at = (at + 1) & cells->mask;
    return &cells->slots[at];
}

uint32_t aur_surface_cells_find(const aur_surface_cells *cells, aur_vector position, aur_vector normal) {
    const aur_surface_cell *const slot = slot_of(cells, key_of(cells, position, normal));
    return slot->key != 0 ? slot->item : AUR_NO_CELL;
}

static aur_vector sample_vector(const aur_vector *first, size_t stride, size_t index) {
    aur_vector v;
    memcpy(&v, (const char *)first + index * stride, sizeof v);
    return v;
}

static float distance_to_centre(const aur_surface_cells *cells, uint64_t key, aur_vector position) {
    const uint64_t cube = (key - 1) / 8;
    const aur_vector corner = {(float)(cube >> (2 * COORDINATE_BITS)),
                               (float)(cube >> COORDINATE_BITS & COORDINATE_MAX),
                               (float)(cube & COORDINATE_MAX)};
    const aur_vector half = {0.5f, 0.5f, 0.5f};
    const aur_vector centre = aur_vector_add_scaled(cells->origin, cells->size, aur_vector_add(corner, half));
    return aur_vector_length(aur_vector_subtract(position, centre));
}

static void fill(aur_surface_cells *cells, const aur_surface_samples *samples) {
    memset(cells->slots, 0, (cells->mask + 1) * sizeof *cells->slots);
    cells->count = 0;
    cells->used = 0;
    for (size_t i = 0; i < samples->count; ++i) {
        const aur_vector position = sample_vector(samples->positions, samples->stride, i);
        const uint64_t key = key_of(cells, position, sample_vector(samples->normals, samples->stride, i));
        aur_surface_cell *const slot = slot_of(cells, key);
        if (slot->key == 0) {
            *slot = (aur_surface_cell){key, (uint32_t)cells->count++, (uint32_t)i};
            ++cells->used;
            continue;
        }
        const aur_vector rival = sample_vector(samples->positions, samples->stride, slot->sample);
        if (distance_to_centre(cells, key, position) < distance_to_centre(cells, key, rival))
            slot->sample = (uint32_t)i;
    }
}

static void bounds_of(const aur_surface_samples *samples, aur_vector *lower, aur_vector *upper) {
    *lower = *upper = sample_vector(samples->positions, samples->stride, 0);
    for (size_t i = 1; i < samples->count; ++i) {
        const aur_vector p = sample_vector(samples->positions, samples->stride, i);
        *lower = (aur_vector){fminf(lower->x, p.x), fminf(lower->y, p.y), fminf(lower->z, p.z)};
        *upper = (aur_vector){fmaxf(upper->x, p.x), fmaxf(upper->y, p.y), fmaxf(upper->z, p.z)};
    }
}

/* The grid is set off by odd parts of a cell, so that walls along the axes do not fall on its planes. */
static void set_size(aur_surface_cells *cells, aur_vector lower, float size) {
    cells->size = size;
    cells->origin = aur_vector_add_scaled(lower, -size, (aur_vector){0.381966f, 0.724492f, 0.554958f});
}

aur_result aur_surface_cells_build(aur_surface_cells *cells, const aur_surface_samples *samples,
                                   size_t wanted) {
    *cells = (aur_surface_cells){.size = 1.0f};
    if (samples->count > (size_t)1 << 31)
        return AUR_ERROR_ARGUMENT;
    size_t slots = 64;
    while (slots < 2 * samples->count)
        slots *= 2;
    cells->slots = calloc(slots, sizeof *cells->slots);
    if (cells->slots == NULL)
        return AUR_ERROR_MEMORY;
    cells->mask = slots - 1;
    if (samples->count == 0)
        return AUR_OK;
    aur_vector lower, upper;
    bounds_of(samples, &lower, &upper);
    const float extent = fmaxf(aur_vector_max(aur_vector_subtract(upper, lower)), 1e-20f);
    const float least = extent / (float)(COORDINATE_MAX - 2);
    float size = extent / 64.0f;
    /* Surfaces are two-dimensional: the number of cells goes with the inverse square of their size. */
    for (unsigned round = 0; round < SIZING_ROUNDS; ++round) {
        set_size(cells, lower, size);
        fill(cells, samples);
        const float ratio = sqrtf((float)cells->count / (float)(wanted > 0 ? wanted : 1));
        if (ratio > 0.9f && ratio < 1.1f)
            break;
        size = fmaxf(least, fminf(size * ratio, extent));
    }
    return AUR_OK;
}

/* Room for one more cell at half load. */
static aur_result grow(aur_surface_cells *cells) {
    if (2 * (cells->used + 1) <= cells->mask + 1)
        return AUR_OK;
    const size_t slots = 2 * (cells->mask + 1);
    aur_surface_cell *const larger = calloc(slots, sizeof *larger);
    if (larger == NULL)
        return AUR_ERROR_MEMORY;
    aur_surface_cell *const old = cells->slots;
    const size_t old_mask = cells->mask;
    cells->slots = larger;
    cells->mask = slots - 1;
    for (size_t i = 0; i <= old_mask; ++i)
        if (old[i].key != 0)
            *slot_of(cells, old[i].key) = old[i];
    free(old);
    return AUR_OK;
}

static aur_result offer(aur_surface_cells *cells, const aur_surface_disc *discs, size_t item,
                        aur_vector position) {
    const uint64_t key = key_of(cells, position, discs[item].normal);
    aur_surface_cell *slot = slot_of(cells, key);
    if (slot->key == 0) {
        const aur_result result = grow(cells);
        if (result != AUR_OK)
            return result;
        slot = slot_of(cells, key);
        *slot = (aur_surface_cell){key, (uint32_t)item, AUR_NO_CELL};
        ++cells->used;
    } else if (slot->sample == AUR_NO_CELL &&
               distance_to_centre(cells, key, discs[item].position) <
                   distance_to_centre(cells, key, discs[slot->item].position)) {
        slot->item = (uint32_t)item;
    }
    return AUR_OK;
}

aur_result aur_surface_cells_spread(aur_surface_cells *cells, size_t count, const aur_surface_disc *discs) {
    for (size_t i = 0; i < count; ++i) {
        const aur_frame frame = aur_frame_about(discs[i].normal);
        const float step = 0.5f * cells->size;
        const long reach = (long)fminf(discs[i].radius / step, MOST_REACH);
        for (long y = -reach; y <= reach; ++y) {
            for (long x = -reach; x <= reach; ++x) {
                const aur_vector offset = {(float)x * step, (float)y * step, 0.0f};
                if (aur_vector_length(offset) > discs[i].radius)
                    continue;
                const aur_vector position =
                    aur_vector_add(discs[i].position, aur_frame_to_world(&frame, offset));
                const aur_result result = offer(cells, discs, i, position);
                if (result != AUR_OK)
                    return result;
            }
        }
    }
    return AUR_OK;
}

void aur_surface_cells_release(aur_surface_cells *cells) {
    free(cells->slots);
    *cells = (aur_surface_cells){0};
}
