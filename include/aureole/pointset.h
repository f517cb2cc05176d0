/* Point sets on the unit cube [0,1)^d, their scramblings, and files of points.
 *
 * A set is named by one text everywhere: NAME[:key=value[,key=value...]], or file:PATH. Points are random
 * access: point i is computed from i, so any part of a set can be asked for in any order from any thread. */
#ifndef AUREOLE_POINTSET_H
#define AUREOLE_POINTSET_H

#include <aureole/core.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Where points live. The disk is the unit disk; hemisphere and sphere have z up, polar angle theta from +z,
 * azimuth phi from +x towards +y, and unit radius. AUR_DOMAIN_CUBE is [0,1)^d with d other than 2. */
typedef enum aur_domain {
    AUR_DOMAIN_SQUARE,
    AUR_DOMAIN_CUBE,
    AUR_DOMAIN_DISK,
    AUR_DOMAIN_HEMISPHERE,
    AUR_DOMAIN_SPHERE
} aur_domain;

/* How a set is randomised. DIGIT: Kollig-Keller, one XOR word a dimension; OWEN: nested uniform scrambling;
 * SHIFT: Cranley-Patterson, addition modulo 1; ROTATE: a random rotation about z (on the square: a shift of
 * the azimuth coordinate, which is the second); ROTATE3D: a uniformly random rotation of the sphere. */
typedef enum aur_scramble {
    AUR_SCRAMBLE_NONE,
    AUR_SCRAMBLE_DIGIT,
    AUR_SCRAMBLE_OWEN,
    AUR_SCRAMBLE_SHIFT,
    AUR_SCRAMBLE_ROTATE,
    AUR_SCRAMBLE_ROTATE3D
} aur_scramble;

/* "none", "digit", "owen", "shift", "rotate", "rotate3d" to the value and back; NULL for a value out of
 * range. */
AUR_API aur_result aur_scramble_from_name(const char *name, aur_scramble *scramble, aur_error *error)
    AUR_NONNULL(1, 2);
AUR_API const char *aur_scramble_name(aur_scramble scramble);

/* One row of the table of sets. */
typedef struct aur_set_description {
    const char *name;
    const char *keys;    /* "offset=0.5": key=default, comma separated; empty where there are none */
    const char *summary; /* one line */
    const char *domains; /* "square", "cube, square", "sphere, hemisphere", ... */
    const char *sizes;   /* "any", "1..2^32", "base*4^levels", ... */
    int extensible;      /* the first n points of a larger set are the smaller set */
    const char *source;  /* author year */
} aur_set_description;

/* A set made ready: an immutable table or rule that any number of threads may read. */
typedef struct aur_pointset aur_pointset;

typedef struct aur_pointset_options {
    uint64_t count;        /* the size of the set: at least 1; 0 stands for all points of file:PATH */
    size_t dimension;      /* 0 stands for 2, or for what a file, a vector or a set of one dimension has */
    aur_scramble scramble; /* NONE, DIGIT, OWEN, SHIFT or ROTATE */
    uint64_t seed;         /* of scrambling and of random sets */
    aur_warnings warnings; /* "n is not a power of two", ... */
} aur_pointset_options;

/* Makes the set that `set` names ready. Errors: NAME for an unknown set or key, FORMAT, ARGUMENT for a count
 * or dimension that the set does not have, UNSUPPORTED for a scrambling that has no meaning there, MEMORY. */
AUR_API aur_result aur_pointset_create(const char *set, const aur_pointset_options *options,
                                       aur_pointset **pointset, aur_error *error) AUR_NONNULL(1, 2, 3);
AUR_API void aur_pointset_destroy(aur_pointset *pointset); /* NULL is allowed */

AUR_API size_t aur_pointset_dimension(const aur_pointset *pointset) AUR_NONNULL(1);
AUR_API uint64_t aur_pointset_size(const aur_pointset *pointset) AUR_NONNULL(1);

/* Points first .. first+count-1, one after another, into points[count * dimension]; `capacity` counts
 * doubles. Every coordinate is in [0,1). Errors: ARGUMENT for a range beyond the set, CAPACITY. */
AUR_API aur_result aur_pointset_points(const aur_pointset *pointset, uint64_t first, size_t count,
                                       size_t capacity, double *points) AUR_NONNULL(1, 5);

/* Points as they stand in a file. */
typedef struct aur_points {
    aur_domain domain;
    size_t count;
    size_t
        dimension; /* coordinates a point: d on the cube, 2 on square and disk, 3 on hemisphere and sphere */
    double *coordinates; /* count * dimension, one point after another */
    double *weights;     /* count, or NULL */
} aur_points;

/* Reads CSV (header u,v or x,y,z, and w where there are weights; without a header two columns are u,v and
 * three are x,y,z) or NPY. Errors name the line. Free with aur_points_release. */
AUR_API aur_result aur_points_read(const char *path, aur_points *points, aur_error *error) AUR_NONNULL(1, 2);
AUR_API void aur_points_release(aur_points *points);

/* How points are written. CSV: a header (u,v on the square, x,y on the disk, x,y,z on hemisphere and sphere,
 * u1,u2,... on the cube, and w where there are weights), 17 significant digits. JSON: an object with "points"
 * and, where there are, "weights". NPY: float64, a row a point, the weight in the last column. PLY: binary,
 * up to three coordinates, the weight as `quality`. */
typedef enum aur_points_format {
    AUR_POINTS_CSV,
    AUR_POINTS_JSON,
    AUR_POINTS_NPY,
    AUR_POINTS_PLY
} aur_points_format;

/* "csv", "json", "npy", "ply" to the value and back; NULL for a value out of range. */
AUR_API aur_result aur_points_format_from_name(const char *name, aur_points_format *format, aur_error *error)
    AUR_NONNULL(1, 2);
AUR_API const char *aur_points_format_name(aur_points_format format);

/* Where points come from: kept in the formats that have a place for it (JSON, PLY). */
typedef struct aur_points_origin {
    const char *set;
    uint64_t size;  /* of the set, of which the points may be a part */
    uint64_t first; /* the index of the first one */
    aur_scramble scramble;
    uint64_t seed;
} aur_points_origin;

/* Writes points to `path`, "-" for standard output; the file is replaced whole or not at all. `origin` may be
 * NULL. Errors: UNSUPPORTED for a ply file of more than three coordinates, WRITE. */
AUR_API aur_result aur_points_write(const char *path, aur_points_format format, const aur_points *points,
                                    const aur_points_origin *origin, aur_error *error) AUR_NONNULL(1, 3);

#ifdef __cplusplus
}
#endif

#endif
