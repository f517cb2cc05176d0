/* Directions: maps from the square, lobes, sets that are native to the sphere, and the table of all sets.
 *
 * Angle convention: z up, polar angle theta from +z, azimuth phi from +x towards +y. */
#ifndef AUREOLE_SPHERE_H
#define AUREOLE_SPHERE_H

#include <aureole/pointset.h>

#ifdef __cplusplus
extern "C" {
#endif

/* LAMBERT: the cylindrical equal-area map, z = 1 - u (hemisphere) or 1 - 2u (sphere), phi = 2 pi v.
 * CONCENTRIC: Shirley-Chiu square to disk, then z = 1 - r^2 (sphere 1 - 2 r^2). AZIMUTHAL: Lambert's
 * azimuthal equal-area map by polar coordinates, r = sqrt u. POLAR: Schretter 2012 fig. 3, r = u, phi = 2 pi
 * v, no square root. */
typedef enum aur_map { AUR_MAP_LAMBERT, AUR_MAP_CONCENTRIC, AUR_MAP_AZIMUTHAL, AUR_MAP_POLAR } aur_map;

AUR_API aur_result aur_map_from_name(const char *name, aur_map *map, aur_error *error) AUR_NONNULL(1, 2);
AUR_API const char *aur_map_name(aur_map map);

typedef enum aur_lobe_kind { AUR_LOBE_COSINE_POWER, AUR_LOBE_GGX } aur_lobe_kind;

/* A density on the hemisphere about +z. COSINE_POWER: (M+1)/(2 pi) cos^M theta with M = exponent >= 0; M = 0
 * is uniform. GGX: the reflection of a view direction at `view_degrees` from +z (towards +x) by visible
 * normals. */
typedef struct aur_lobe {
    aur_lobe_kind kind;
    double exponent;
    double alpha;
    double view_degrees;
} aur_lobe;

/* "uniform", "cosine", "phong:M", "ggx:ALPHA[:VIEW_DEGREES]". */
AUR_API aur_result aur_lobe_parse(const char *text, aur_lobe *lobe, aur_error *error) AUR_NONNULL(1, 2);

/* A set of directions made ready: immutable, for any number of threads. */
typedef struct aur_directions aur_directions;

typedef struct aur_directions_options {
    uint64_t count;      /* the size of the set: at least 1 */
    aur_domain domain;   /* HEMISPHERE or SPHERE */
    aur_map map;         /* for sets of the square; native sets ignore it */
    aur_lobe lobe;       /* hemisphere only; zero is uniform */
    int optimal_density; /* draw from lobe^{2/(s+1)} and weigh by p/q */
    double smoothness;   /* s of the optimal density, in (1,2); 0 stands for 1.5 */
    aur_scramble scramble;
    uint64_t seed;
    aur_warnings warnings;
} aur_directions_options;

/* Makes the directions of a set of the square or of the sphere ready; `set` as in aur_pointset_create. */
AUR_API aur_result aur_directions_create(const char *set, const aur_directions_options *options,
                                         aur_directions **directions, aur_error *error) AUR_NONNULL(1, 2, 3);
AUR_API void aur_directions_destroy(aur_directions *directions); /* NULL is allowed */
AUR_API uint64_t aur_directions_size(const aur_directions *directions) AUR_NONNULL(1);

/* Unit vectors first .. first+count-1 as x,y,z triples into xyz[3 * count] (`capacity` counts doubles), and
 * their weights into weights[count] unless NULL: 1/N, or p/(q N) with the optimal density. */
AUR_API aur_result aur_directions_points(const aur_directions *directions, uint64_t first, size_t count,
                                         size_t capacity, double *xyz, double *weights) AUR_NONNULL(1, 5);

/* The table of all sets, of the square and of the sphere. */
AUR_API size_t aur_set_count(void);
AUR_API const aur_set_description *aur_set_at(size_t index); /* NULL beyond the table */

#ifdef __cplusplus
}
#endif

#endif
