/* Maps of irradiance as bytes, for the cache of later runs. */
#pragma once

#include "render/photons/irradiance.h"

/* What may be cheaper to read than to trace: fewer photons than these are traced in the time that hashing a
 * scene's files, opening and checking takes (scripts/cache.sh). */
enum { AUR_IRRADIANCE_WORTH_KEEPING = 20000 };

/* The bytes, from malloc; NULL when out of memory. */
void *aur_irradiance_map_pack(const aur_irradiance_map *map, size_t *size);
/* The map of the same scene; NULL for bytes that are none, or when out of memory. Whatever the bytes, looking
 * up in the map stays within it. */
aur_irradiance_map *aur_irradiance_map_unpack(const aur_scene *scene, size_t size, const void *bytes);
