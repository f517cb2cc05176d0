#include "render/photons/irradiance.h"

#include <stdlib.h>
#include <string.h>

/* First these numbers, then arrays in the machine's format: ranges, lights, and, if there are glossy
 * surfaces, the starts of members and the members. */
typedef struct head {
    uint64_t elements, texels, glossy, members, photons, paths, rays, cut;
} head;

static size_t light_count(const head *h) {
    return 2 * (size_t)h->texels;
}

static size_t first_count(const head *h) {
    return h->glossy != 0 ? light_count(h) + 1 : 0;
}

/* In double, so that it cannot overflow; exact below 2^53. */
static double size_of(const head *h) {
    return (double)sizeof *h + (double)h->elements * sizeof(aur_texel_range) +
           2.0 * (double)h->texels * sizeof(aur_texel_light) +
           (h->glossy != 0 ? 2.0 * (double)h->texels + 1.0 : 0.0) * sizeof(uint32_t) +
           (double)h->members * sizeof(aur_incident_photon);
}

static char *put(char *at, size_t size, const void *bytes) {
    if (size > 0)
        memcpy(at, bytes, size);
    return at + size;
}

static const char *get(const char *at, size_t size, void *bytes) {
    if (size > 0)
        memcpy(bytes, at, size);
    return at + size;
}

void *aur_irradiance_map_pack(const aur_irradiance_map *map, size_t *size) {
    const bool glossy = map->member_first != NULL;
    const head h = {.elements = map->texels.elements.count,
                    .texels = map->texels.count,
                    .glossy = glossy ? 1 : 0,
                    .members = glossy ? map->member_first[2 * map->texels.count] : 0,
                    .photons = map->photons,
                    .paths = map->paths,
                    .rays = map->rays,
                    .cut = map->cut};
    *size = (size_t)size_of(&h);
    char *const bytes = malloc(*size);
    if (bytes == NULL)
        return NULL;
    char *at = put(bytes, sizeof h, &h);
    at = put(at, h.elements * sizeof *map->texels.ranges, map->texels.ranges);
    at = put(at, light_count(&h) * sizeof *map->lights, map->lights);
    at = put(at, first_count(&h) * sizeof *map->member_first, map->member_first);
    put(at, h.members * sizeof *map->members, map->members);
    return bytes;
}

static bool allocate(aur_irradiance_map *map, const head *h) {
    map->texels.count = h->texels;
    map->texels.ranges = malloc((h->elements + 1) * sizeof *map->texels.ranges);
    map->texels.areas = malloc((h->texels + 1) * sizeof *map->texels.areas);
    map->lights = calloc(light_count(h) + 1, sizeof *map->lights);
    if (h->glossy != 0) {
        map->member_first = malloc(first_count(h) * sizeof *map->member_first);
        map->members = malloc((h->members + 1) * sizeof *map->members);
    }
    return map->texels.ranges != NULL && map->texels.areas != NULL && map->lights != NULL &&
           (h->glossy == 0 || (map->member_first != NULL && map->members != NULL));
}

static bool stays_within(const aur_irradiance_map *map, const head *h) {
    for (size_t i = 0; i < h->elements; ++i) {
        const aur_texel_range range = map->texels.ranges[i];
        if (range.side == 0 || range.side > AUR_TEXELS_SIDE_MAX ||
            range.first + (uint64_t)range.side * range.side > h->texels)
            return false;
    }
    const size_t count = first_count(h);
    for (size_t i = 1; i < count; ++i)
        if (map->member_first[i] < map->member_first[i - 1])
            return false;
    return count == 0 || (map->member_first[0] == 0 && map->member_first[count - 1] == h->members);
}

static bool fill(aur_irradiance_map *map, const head *h, const char *at) {
    if (!allocate(map, h))
        return false;
    at = get(at, h->elements * sizeof *map->texels.ranges, map->texels.ranges);
    at = get(at, light_count(h) * sizeof *map->lights, map->lights);
    at = get(at, first_count(h) * sizeof *map->member_first, map->member_first);
    get(at, h->members * sizeof *map->members, map->members);
    for (size_t i = 0; i < h->texels; ++i)
        map->texels.areas[i] = map->lights[2 * i].area;
    return stays_within(map, h);
}

aur_irradiance_map *aur_irradiance_map_unpack(const aur_scene *scene, size_t size, const void *bytes) {
    head h;
    if (size < sizeof h)
        return NULL;
    const char *const at = get(bytes, sizeof h, &h);
    if ((double)size != size_of(&h) || h.texels > UINT32_MAX / 2 || h.members > UINT32_MAX || h.glossy > 1 ||
        (h.glossy == 0 && h.members > 0))
        return NULL;
    aur_irradiance_map *const map = calloc(1, sizeof *map);
    if (map == NULL)
        return NULL;
    *map = (aur_irradiance_map){.photons = (size_t)h.photons, .paths = h.paths, .rays = h.rays, .cut = h.cut};
    if (aur_elements_create(scene, &map->texels.elements) == AUR_OK &&
        map->texels.elements.count == h.elements && fill(map, &h, at))
        return map;
    aur_irradiance_map_destroy(map);
    return NULL;
}
