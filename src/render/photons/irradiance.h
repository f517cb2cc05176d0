/* Irradiance on texels, from photons: the radiance at the end of a gather ray is one array read, without
 * density estimation while an image is rendered (after Christensen 1999). */
#pragma once

#include "points/base/error.h"
#include "render/photons/photon_map.h"
#include "render/photons/texels.h"

/* A photon as stored for glossy surfaces. */
typedef struct aur_incident_photon {
    aur_vector direction; /* unit, towards where it came from */
    aur_vector power;
} aur_incident_photon;

typedef struct aur_texel_light {
    _Alignas(16) aur_vector irradiance; /* watts per square unit, RGB */
    float area;                         /* of the texel, square units */
} aur_texel_light;

typedef struct aur_irradiance_map {
    aur_texels texels;
    aur_texel_light *lights; /* two per texel: on the side of the shape's normal, and on the back */
    /* Photons of the texels on glossy surfaces, grouped by texel: those of light i begin at member_first[i].
     * NULL if no surface is glossy. */
    uint32_t *member_first;
    aur_incident_photon *members;
    size_t photons; /* stored photons from which the map was computed */
    uint64_t paths; /* particles that left the lights */
    uint64_t rays;  /* traced for the map, also if it was read from a file */
    uint64_t cut;   /* particles whose path was cut (photon_map.h) */
} aur_irradiance_map;

typedef struct aur_irradiance_map_options {
    aur_photon_options photons;
    double photons_a_texel; /* on average, at least 1 */
} aur_irradiance_map_options;

AUR_INTERNAL aur_result aur_irradiance_map_create(const aur_scene *scene,
                                                  const aur_irradiance_map_options *options,
                                                  aur_irradiance_map **map, aur_error *error);
AUR_INTERNAL void aur_irradiance_map_destroy(aur_irradiance_map *map);

/* The light of a triangle at barycentric u, v. */
static inline const aur_texel_light *
aur_irradiance_on_triangle(const aur_irradiance_map *map, uint32_t element, float u, float v, bool behind) {
    const uint32_t texel = aur_texel_of_triangle(map->texels.ranges[element], u, v);
    return &map->lights[2 * (size_t)texel + (behind ? 1 : 0)];
}

/* The map's values at a hit. */
typedef struct aur_texel_view {
    aur_vector radiance; /* exitant */
    float area; /* of the texel, square units; 0 on the back of a surface that does not scatter there */
} aur_texel_view;

/* Exitant radiance of the surface of a hit towards `view` (world, unit): its irradiance times albedo / pi,
 * and the cos^m lobes over the texel's photons. Excludes emission and other lobes. */
AUR_INTERNAL aur_texel_view aur_irradiance_view(const aur_irradiance_map *map, const aur_scene *scene,
                                                const aur_hit *hit, const aur_surface *surface,
                                                aur_vector view);

/* Serialised irradiance maps, for the cache of later runs. */

/* The least number of photons for which reading can be faster than tracing: fewer are traced in the time to
 * hash a scene's files, to open and to check (scripts/cache.sh). */
enum { AUR_IRRADIANCE_WORTH_KEEPING = 20000 };

/* The bytes, from malloc; NULL if out of memory. */
void *aur_irradiance_map_pack(const aur_irradiance_map *map, size_t *size);
/* The map of the same scene; NULL for invalid bytes, or if out of memory. Look-ups in the map are within
 * bounds for any bytes. */
aur_irradiance_map *aur_irradiance_map_unpack(const aur_scene *scene, size_t size, const void *bytes);
