#include "render/photons/texels.h"

#include <stdlib.h>

#include "points/base/array.h"
#include "points/base/random.h"

enum { COORDINATE_BITS = 20, COORDINATE_MAX = (1 << COORDINATE_BITS) - 1 };

/* Cubes that collect small elements, each split into six by the direction that they face. */
typedef struct cluster {
    uint64_t key; /* 0: empty */
    uint32_t texel;
} cluster;

typedef struct layout {
    const aur_scene *scene;
    const uint32_t *hits;
    double photons_a_texel;
    double cell_area; /* the area with this number of photons on average */
    aur_vector origin;
    float cell_size;
    size_t mask; /* slots - 1 */
    cluster *slots;
    size_t area_capacity;
    aur_texels *texels;
} layout;

static uint64_t quantized(float coordinate, float origin, float size) {
    const float cell = floorf((coordinate - origin) / size);
    if (!(cell > 0.0f))
        return 0;
    return cell < (float)COORDINATE_MAX ? (uint64_t)cell : COORDINATE_MAX;
}

/* Never 0, which marks an empty slot. */
static uint64_t key_of(const layout *work, aur_vector position, aur_vector normal) {
    const uint64_t x = quantized(position.x, work->origin.x, work->cell_size);
    const uint64_t y = quantized(position.y, work->origin.y, work->cell_size);
    const uint64_t z = quantized(position.z, work->origin.z, work->cell_size);
    return (x << (2 * COORDINATE_BITS) | y << COORDINATE_BITS | z) * 8 + aur_vector_facing(normal) + 1;
}

static bool add_texels(layout *work, size_t count, double area) {
    aur_texels *const texels = work->texels;
    if (!aur_array_reserve(&texels->areas, &work->area_capacity, texels->count + count,
                           sizeof *texels->areas))
        return false;
    for (size_t i = 0; i < count; ++i)
        texels->areas[texels->count + i] = (float)area;
    texels->count += count;
    return true;
}

/* The cluster with this key, or the empty slot for it. */
static cluster *slot_of(const layout *work, uint64_t key) {
    size_t at = (size_t)aur_mix64(key) & work->mask;
    while (work->slots[at].key != 0 && work->slots[at].key != key)
        at = (at + 1) & work->mask;
    return &work->slots[at];
}

/* Joins the texel of the element's cube. */
static bool join_cluster(layout *work, const aur_placement *placement, uint32_t primitive, double area) {
    aur_vector position, normal;
    aur_element_middle(work->scene, placement, primitive, &position, &normal);
    const uint64_t key = key_of(work, position, normal);
    cluster *const slot = slot_of(work, key);
    if (slot->key == 0) {
        *slot = (cluster){key, (uint32_t)work->texels->count};
        if (!add_texels(work, 1, 0.0))
            return false;
    }
    work->texels->areas[slot->texel] += (float)area;
    work->texels->ranges[placement->first + primitive] = (aur_texel_range){slot->texel, 1};
    return true;
}

static bool lay_out_element(layout *work, const aur_placement *placement, uint32_t primitive) {
    const uint32_t element = placement->first + primitive;
    const double area = aur_element_area(work->scene, placement, primitive);
    const double target = (double)work->hits[element] / work->photons_a_texel;
    if (target < 2.0 && area < work->cell_area && !placement->curved)
        return join_cluster(work, placement, primitive, area);
    double side = floor(sqrt(target));
    side = fmin(fmax(side, 1.0), AUR_TEXELS_SIDE_MAX);
    work->texels->ranges[element] = (aur_texel_range){(uint32_t)work->texels->count, (uint32_t)side};
    return add_texels(work, (size_t)(side * side), area / (side * side));
}

static aur_result lay_out_all(layout *work) {
    const aur_elements *const elements = &work->texels->elements;
    for (size_t i = 0; i < elements->placement_count; ++i) {
        const aur_placement *const placement = &elements->placements[i];
        for (uint32_t k = 0; k < placement->count; ++k) {
            if (!lay_out_element(work, placement, k))
                return AUR_ERROR_MEMORY;
            if (work->texels->count > UINT32_MAX / 2)
                return AUR_ERROR_ARGUMENT;
        }
    }
    return AUR_OK;
}

/* The texel that one has joined, directly or not. */
static uint32_t joined_by(const uint32_t *into, uint32_t texel) {
    while (into[texel] != texel)
        texel = into[texel];
    return texel;
}

/* The largest texel of the cubes around one, for the same direction; its own texel if there is none. */
static uint32_t largest_beside(const layout *work, const cluster *slot, const uint32_t *into) {
    const uint64_t cube = (slot->key - 1) / 8, facing = (slot->key - 1) % 8, mask = COORDINATE_MAX;
    const uint64_t at[3] = {cube >> (2 * COORDINATE_BITS), cube >> COORDINATE_BITS & mask, cube & mask};
    uint32_t largest = slot->texel;
    for (uint64_t k = 0; k < 27; ++k) {
        const uint64_t x = at[0] + k / 9 - 1, y = at[1] + k / 3 % 3 - 1, z = at[2] + k % 3 - 1;
        if (x > mask || y > mask || z > mask)
            continue;
        const uint64_t key = (x << (2 * COORDINATE_BITS) | y << COORDINATE_BITS | z) * 8 + facing + 1;
        const cluster *const other = slot_of(work, key);
        const uint32_t texel = other->key != 0 ? joined_by(into, other->texel) : largest;
        if (work->texels->areas[texel] > work->texels->areas[largest])
            largest = texel;
    }
    return largest;
}

/* Clusters smaller than a photon's share of the area, such as a corner of a surface in its cube, join a
 * neighbour: the rare photon there would make its texel brighter than any light. */
static bool join_slivers(layout *work) {
    aur_texels *const texels = work->texels;
    uint32_t *const into = malloc((texels->count + 1) * sizeof *into);
    const double least = work->cell_area / work->photons_a_texel;
    for (uint32_t i = 0; i < texels->count && into != NULL; ++i)
        into[i] = i;
    for (size_t i = 0; i <= work->mask && into != NULL; ++i) {
        const cluster *const slot = &work->slots[i];
        if (slot->key == 0 || (double)texels->areas[slot->texel] >= least)
            continue;
        const uint32_t largest = largest_beside(work, slot, into);
        if (largest == slot->texel)
            continue;
        texels->areas[largest] += texels->areas[slot->texel];
        texels->areas[slot->texel] = 0.0f;
        into[slot->texel] = largest;
    }
    for (size_t i = 0; i < texels->elements.count && into != NULL; ++i)
        texels->ranges[i].first = joined_by(into, texels->ranges[i].first);
    const bool allocated = into != NULL;
    free(into);
    return allocated;
}

/* The area that photons can reach: the elements that were hit, and, where elements are small compared with
 * the photons' distance, an estimate of those missed by chance from the numbers of elements hit once and
 * twice (Chao 1984). */
static double lit_area(const layout *work, double *photons) {
    const aur_elements *const elements = &work->texels->elements;
    double area = 0.0, once_area = 0.0, once = 0.0, twice = 0.0;
    *photons = 0.0;
    for (size_t i = 0; i < elements->placement_count; ++i) {
        const aur_placement *const placement = &elements->placements[i];
        for (uint32_t k = 0; k < placement->count; ++k) {
            const uint32_t hits = work->hits[placement->first + k];
            if (hits == 0)
                continue;
            const double here = aur_element_area(work->scene, placement, k);
            *photons += (double)hits;
            area += here;
            once_area += hits == 1 ? here : 0.0;
            once += hits == 1 ? 1.0 : 0.0;
            twice += hits == 2 ? 1.0 : 0.0;
        }
    }
    return area + once_area * once / (2.0 * fmax(twice, 1.0));
}

static void measure(layout *work) {
    double photons;
    const double area = lit_area(work, &photons);
    aur_vector lower, upper;
    aur_scene_bounds(work->scene, &lower, &upper);
    const float extent = fmaxf(aur_vector_max(aur_vector_subtract(upper, lower)), 1e-20f);
    work->cell_area = photons > 0.0 ? area * work->photons_a_texel / photons : 0.0;
    work->cell_size = fmaxf((float)sqrt(work->cell_area), extent / (float)(COORDINATE_MAX - 2));
    /* Set off by odd parts of a cell, so that walls along the axes do not fall on the planes of the grid. */
    work->origin =
        aur_vector_add_scaled(lower, -work->cell_size, (aur_vector){0.381966f, 0.724492f, 0.554958f});
}

aur_result aur_texels_create(const aur_scene *scene, aur_elements elements, const uint32_t *hits,
                             double photons_a_texel, aur_texels *texels) {
    *texels = (aur_texels){.elements = elements};
    layout work = {.scene = scene, .hits = hits, .photons_a_texel = photons_a_texel, .texels = texels};
    size_t slots = 64;
    while (slots < 2 * elements.count)
        slots *= 2;
    work.mask = slots - 1;
    work.slots = calloc(slots, sizeof *work.slots);
    texels->ranges = malloc((elements.count + 1) * sizeof *texels->ranges);
    aur_result result = work.slots != NULL && texels->ranges != NULL ? AUR_OK : AUR_ERROR_MEMORY;
    if (result == AUR_OK) {
        measure(&work);
        result = lay_out_all(&work);
    }
    if (result == AUR_OK && !join_slivers(&work))
        result = AUR_ERROR_MEMORY;
    free(work.slots);
    if (result != AUR_OK)
        aur_texels_release(texels);
    return result;
}

void aur_texels_release(aur_texels *texels) {
    aur_elements_release(&texels->elements);
    free(texels->ranges);
    free(texels->areas);
    *texels = (aur_texels){0};
}
