/* Directions: maps from the square, lobes, rotations, sets that are native to the sphere, and the table of
 * all sets.
 *
 * Angle convention: polar angle theta from +z, azimuth phi from +x towards +y. A direction is a unit vector
 * x,y,z; densities are per steradian. */
#ifndef AUREOLE_SPHERE_H
#define AUREOLE_SPHERE_H

#include <aureole/pointset.h>
#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Maps from the unit square. All except POLAR preserve area, so that uniform points stay uniform. LAMBERT:
 * the cylindrical equal-area map, z = 1 - u (hemisphere) or 1 - 2u (sphere), phi = 2 pi v. CONCENTRIC:
 * Shirley and Chiu 1997, square to disk, then z = 1 - r^2 (sphere 1 - 2 r^2). AZIMUTHAL: Lambert's azimuthal
 * equal-area map by polar coordinates, r = sqrt u; once lifted it is LAMBERT. POLAR: Schretter 2012 fig. 3, r
 * = u, phi = 2 pi v, no square root; points are denser near the pole and have the weight aur_map_weight. */
typedef enum aur_map { AUR_MAP_LAMBERT, AUR_MAP_CONCENTRIC, AUR_MAP_AZIMUTHAL, AUR_MAP_POLAR } aur_map;

/* "lambert", "concentric", "azimuthal", "polar" to the value and back. Errors: NAME, *map untouched. */
AUR_API aur_result aur_map_from_name(const char *name, aur_map *map, aur_error *error) AUR_NONNULL(1, 2);
AUR_API const char *aur_map_name(aur_map map); /* NULL for a value out of range */

/* Maps `count` points u,v in [0,1) to the unit disk, and back: square[2 * count], disk[2 * count], which may
 * be the same array. The inverses return coordinates in [0,1), so that a point on the rim comes back as the
 * greatest number below 1; the azimuth of the centre is 0. Round trips are good to 1e-15 of the domain's
 * size. Errors of all maps: ARGUMENT for a map or a height out of its range, with no output. */
AUR_API aur_result aur_map_to_disk(aur_map map, size_t count, const double *square, double *disk,
                                   aur_error *error);
AUR_API aur_result aur_map_from_disk(aur_map map, size_t count, const double *disk, double *square,
                                     aur_error *error);
/* Maps u,v in [0,1) to the unit directions xyz[3 * count] of the cap z >= 1 - height about +z, height in
 * (0,2], and back. A direction outside the cap is replaced by the nearest one on its rim. */
AUR_API aur_result aur_map_to_cap(aur_map map, double height, size_t count, const double *square, double *xyz,
                                  aur_error *error);
AUR_API aur_result aur_map_from_cap(aur_map map, double height, size_t count, const double *xyz,
                                    double *square, aur_error *error);
/* Heights of the caps that are the hemisphere z >= 0 and the sphere. */
#define AUR_CAP_HEMISPHERE 1.0
#define AUR_CAP_SPHERE 2.0
/* The ratio of the uniform density to that of the map: 1, and 2u for POLAR. Its mean over the square is 1. */
AUR_API double aur_map_weight(aur_map map, const double square[2]) AUR_NONNULL(2);

typedef enum aur_lobe_kind { AUR_LOBE_COSINE_POWER, AUR_LOBE_GGX, AUR_LOBE_VISIBLE } aur_lobe_kind;

/* A density about +z. COSINE_POWER: (M+1)/(2 pi) cos^M theta on the hemisphere with M = exponent >= 0; M = 0
 * is uniform. VISIBLE: reflections of a view direction at `view_degrees` from +z (towards +x) by the visible
 * normals of a surface of roughness `alpha`; those below the horizon, z < 0, carry no light. GGX: the light
 * that the surface reflects, D G2 cos above the horizon (height-correlated Smith). Weights are computed for
 * GGX; its points, pdf and warps are those of VISIBLE, which samples it. A zero lobe is uniform. */
typedef struct aur_lobe {
    aur_lobe_kind kind;
    double exponent;     /* M in [0, 1e9] */
    double alpha;        /* in [1e-4, 1] */
    double view_degrees; /* in [0, 90) */
} aur_lobe;

/* "uniform", "cosine", "phong:M", "ggx:ALPHA[:VIEW_DEGREES]", "visible:ALPHA[:VIEW_DEGREES]". */
AUR_API aur_result aur_lobe_parse(const char *text, aur_lobe *lobe, aur_error *error) AUR_NONNULL(1, 2);
/* Maps `count` uniform directions of the hemisphere to directions distributed as the lobe, at the same
 * azimuths about +z (GGX: about the normal of the stretched space): z' = z^{1/(M+1)}; GGX by spherical caps
 * (Dupuy and Benyoub 2023). The inverse of a direction outside the lobe is an arbitrary direction of the
 * hemisphere. The arrays, 3 * count, may be the same. */
AUR_API void aur_lobe_warp(const aur_lobe *lobe, size_t count, const double *uniform, double *xyz)
    AUR_NONNULL(1);
AUR_API void aur_lobe_unwarp(const aur_lobe *lobe, size_t count, const double *xyz, double *uniform)
    AUR_NONNULL(1);
/* The density in 1/steradian; its integral over the sphere is 1. 0 below the horizon for COSINE_POWER. */
AUR_API double aur_lobe_pdf(const aur_lobe *lobe, const double direction[3]) AUR_NONNULL(1, 2);
/* The sampling density for optimally weighted points, p^{2/(s+1)} normalised, for smoothness s in (1,6):
 * cos^M becomes cos^{2M/(s+1)}. UNSUPPORTED for GGX, which has no closed form. */
AUR_API aur_result aur_lobe_optimal(const aur_lobe *lobe, double smoothness, aur_lobe *density,
                                    aur_error *error) AUR_NONNULL(1, 3);

/* A density on the unit square from an image: immutable. Experimental. */
typedef struct aur_density_image aur_density_image;

/* density[width * height] with the top row first, finite and not negative, not all 0; u increases along a row
 * and v upwards, 1 to 65536 pixels per side. The density is constant within a pixel. */
AUR_EXPERIMENTAL aur_result aur_density_image_create(size_t width, size_t height, const float *density,
                                                     aur_density_image **image, aur_error *error)
    AUR_NONNULL(3, 4);
AUR_EXPERIMENTAL void aur_density_image_destroy(aur_density_image *image); /* NULL is allowed */
/* Maps uniform points of the square to points distributed as the density, by inversion: rows first by v, then
 * along the row by u (Schretter 2012 fig. 4), and back. Results are in [0,1); input is clamped to [0,1), NaN
 * to 0. The arrays may be the same. */
AUR_EXPERIMENTAL void aur_density_image_warp(const aur_density_image *image, const double square[2],
                                             double warped[2]) AUR_NONNULL(1, 2, 3);
AUR_EXPERIMENTAL void aur_density_image_unwarp(const aur_density_image *image, const double warped[2],
                                               double square[2]) AUR_NONNULL(1, 2, 3);
/* The density at a point of the square, clamped as above; its integral is 1. */
AUR_EXPERIMENTAL double aur_density_image_pdf(const aur_density_image *image, const double point[2])
    AUR_NONNULL(1, 2);

/* A rotation, row by row: rotated[i] = sum over k of m[3 i + k] v[k]. */
typedef struct aur_rotation {
    double m[9];
} aur_rotation;

/* About +z by an angle that is uniform over seeds, and a uniformly random rotation (Shoemake 1992), each from
 * a separate hash of the seed: equal seeds give equal rotations, and the two are independent. Rotating one
 * set many times randomises it without computing it again. */
AUR_API void aur_rotation_axial(uint64_t seed, aur_rotation *rotation) AUR_NONNULL(2);
AUR_API void aur_rotation_uniform(uint64_t seed, aur_rotation *rotation) AUR_NONNULL(2);
/* Rotates `count` vectors in xyz[3 * count] in place. */
AUR_API void aur_rotation_apply(const aur_rotation *rotation, size_t count, double *xyz) AUR_NONNULL(1, 3);

/* The inverse map of a spherical Fibonacci set (offset 1/2) on the HEMISPHERE or the SPHERE, 1 to 2^50
 * points; in constant time. Directions are unit vectors of the domain, to 1e-4. Points at the same computed
 * distance are ordered by index. */
typedef struct aur_fibonacci_set {
    uint64_t size;
    aur_domain domain;
} aur_fibonacci_set;

enum { AUR_FIBONACCI_NEIGHBOURS_MAX = 256 };

/* indices[i] is the nearest point of direction xyz[3 i ...] (Keinert 2015); `capacity` counts indices.
 * Errors: ARGUMENT for a set or a direction out of its range (without output), CAPACITY. */
AUR_API aur_result aur_fibonacci_nearest(const aur_fibonacci_set *set, size_t count, const double *xyz,
                                         size_t capacity, uint64_t *indices, aur_error *error) AUR_NONNULL(1);
/* The `count` nearest points of one direction, nearest first; at most AUR_FIBONACCI_NEIGHBOURS_MAX and the
 * size of the set. Errors: ARGUMENT for a larger count, a set or a direction out of its range, CAPACITY where
 * `capacity` indices are fewer than `count`; without output. */
AUR_API aur_result aur_fibonacci_neighbours(const aur_fibonacci_set *set, const double direction[3],
                                            size_t count, size_t capacity, uint64_t *indices,
                                            aur_error *error) AUR_NONNULL(1, 2, 5);

/* A prepared set of directions: immutable, usable by any number of threads. */
typedef struct aur_directions aur_directions;

typedef struct aur_directions_options {
    size_t size;          /* sizeof the caller's struct */
    uint64_t count;       /* points of the set: at least 1; 0 for a file: all of its points */
    aur_domain domain;    /* HEMISPHERE, SPHERE or AXES */
    double cap_degrees;   /* 0: all of the domain; else its cap of that polar angle about +z */
    aur_map map;          /* for sets of the square; native sets ignore it */
    aur_lobe lobe;        /* whole hemisphere only; zero is uniform */
    bool optimal_density; /* sample lobe^{2/(s+1)} with weights p/q */
    double smoothness;    /* s of the optimal density, in (1,6); 0: 1.5 */
    aur_scramble scramble;
    uint64_t seed;
    aur_warnings warnings;
} aur_directions_options;

/* Uniform directions without scrambling, sets of the square by LAMBERT. */
AUR_API aur_result aur_directions_options_init(uint64_t count, aur_domain domain,
                                               aur_directions_options *options, aur_error *error)
    AUR_NONNULL(3);

/* Prepares the directions of a set of the square or of the sphere; `set` as in aur_pointset_create.
 * Directions of a file are used unchanged. Sets native to the sphere support the scramblings ROTATE and, on
 * the sphere and for axes, ROTATE3D; sets of the square apply these after the map and the others before it.
 */
AUR_API aur_result aur_directions_create(const char *set, const aur_directions_options *options,
                                         aur_directions **directions, aur_error *error) AUR_NONNULL(1, 2, 3);
AUR_API void aur_directions_destroy(aur_directions *directions); /* NULL is allowed */
/* The number of directions: the options' count or, where that is 0, the number in the file. */
AUR_API uint64_t aur_directions_size(const aur_directions *directions) AUR_NONNULL(1);

/* Writes unit vectors first .. first+count-1 as x,y,z triples into xyz[3 * count] (`capacity` counts
 * doubles), and their weights into weights[count] unless NULL: those of a rule for integrals against the lobe
 * (uniform: against 1/area), 1/N each where the density is the lobe itself, p/(q N) where it is not, 0 below
 * the horizon of a GGX lobe. Errors: ARGUMENT for a range beyond the set, CAPACITY. */
AUR_API aur_result aur_directions_points(const aur_directions *directions, uint64_t first, size_t count,
                                         size_t capacity, double *xyz, double *weights, aur_error *error)
    AUR_NONNULL(1, 5);
/* The same in any layout, with doubles rounded to floats: `xyz` takes three coordinates, `weights` (may be
 * NULL) one. Errors: also ARGUMENT for an inconsistent output. */
AUR_API aur_result aur_directions_generate(const aur_directions *directions, uint64_t first, size_t count,
                                           const aur_output *xyz, const aur_output *weights, aur_error *error)
    AUR_NONNULL(1, 4);

/* Points of any set on any domain, all at once. */
typedef struct aur_points_request {
    size_t size;                           /* sizeof the caller's struct */
    const aur_directions_options *options; /* .domain may be any; .map lifts to the disk too */
    bool natural_domain;                   /* the native domain of the set or file instead */
    size_t dimension;                      /* of the cube, or 2 for the square; 0: 2, or that of the set */
    uint64_t first;                        /* of the set's points */
    size_t count;                          /* 0: all from `first` on */
} aur_points_request;

/* All points of the set. The options must outlive the request. */
AUR_API aur_result aur_points_request_init(const aur_directions_options *options, aur_points_request *request,
                                           aur_error *error) AUR_NONNULL(2);

/* Computes *points: free with aur_points_destroy. Equal weights are left out. The azimuthal map takes native
 * sets from the hemisphere to the disk. Errors: as aur_directions_create and aur_pointset_create; UNSUPPORTED
 * for a native set on the square. */
AUR_API aur_result aur_points_generate(const char *set, const aur_points_request *request,
                                       aur_points **points, aur_error *error) AUR_NONNULL(1, 2, 3);

/* The pixels[count] of HEALPix (Gorski 2005) that contain the vectors xyz[3 * count] of any length except 0:
 * numbers of 12 side^2 pixels in rings, or nested. The set `healpix` has their centres in the same order
 * (order=nested). `capacity` counts pixels. Errors: ARGUMENT for a side beyond 1 to 2^29, a nested one that
 * is not a power of 2, a zero vector (which); CAPACITY. */
AUR_API aur_result aur_healpix_pixels(uint64_t side, bool nested, size_t count, const double *xyz,
                                      size_t capacity, uint64_t *pixels, aur_error *error) AUR_NONNULL(4, 6);

/* The table of all sets, of the square and of the sphere. */
AUR_API size_t aur_set_count(void);
AUR_API const aur_set_description *aur_set_at(size_t index); /* NULL beyond the table */
/* The row of the set that a text in SET syntax names, whatever its keys; NULL for none (file:PATH has none).
 */
AUR_API const aur_set_description *aur_set_find(const char *set) AUR_NONNULL(1);

#ifdef __cplusplus
}
#endif

#endif
