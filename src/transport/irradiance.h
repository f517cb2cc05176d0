/* Irradiance precomputed at a part of the photons (Christensen 1999), so that a gather ray needs the nearest
 * of these points and no density estimate of its own. */
#ifndef AUR_TRANSPORT_IRRADIANCE_H
#define AUR_TRANSPORT_IRRADIANCE_H

#include "transport/photon_map.h"
#include "transport/surface_cells.h"

typedef struct aur_irradiance_point {
    aur_vector position;
    aur_vector normal;
    aur_vector irradiance; /* watts a square unit, RGB, on the side of the normal */
    float radius_squared;  /* of the disc that the estimate's photons fell on; 0: there are none */
    float area;            /* of the part of the disc that is surface */
    uint32_t first;        /* of its photons in `members`; only where the surface is glossy */
    uint32_t members;
} aur_irradiance_point;

/* A photon as glossy surfaces want it. */
typedef struct aur_incident_photon {
    aur_vector direction; /* unit, towards where it came from */
    aur_vector power;
} aur_incident_photon;

typedef struct aur_irradiance_map {
    size_t count;
    aur_irradiance_point *points; /* one a cell that photons fell in */
    aur_incident_photon *members; /* of the points on glossy surfaces, one point's after another's */
    aur_surface_cells cells;
    size_t photons; /* stored, of which the estimates were made */
    uint64_t rays;  /* that the map cost, particles included */
} aur_irradiance_map;

typedef struct aur_irradiance_options {
    aur_photon_options photons;
    size_t neighbours; /* photons an estimate: 1..AUR_IRRADIANCE_NEIGHBOURS_MAX */
} aur_irradiance_options;

enum { AUR_IRRADIANCE_NEIGHBOURS_MAX = 512 };

aur_result aur_irradiance_map_create(const aur_scene *scene, const aur_irradiance_options *options,
                                     aur_irradiance_map **map, aur_error *error);
void aur_irradiance_map_destroy(aur_irradiance_map *map);

/* Radiance that leaves the surface towards `view` (world, unit): the irradiance of its cell times albedo /
 * pi, and the glossy lobes over that estimate's photons; black where no estimate reaches. Emission is not
 * part of it. */
aur_vector aur_irradiance_radiance(const aur_irradiance_map *map, const aur_surface *surface,
                                   aur_vector view);

#endif
