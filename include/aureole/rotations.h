/* Rotations of space, SO(3): sets of them, quaternions and matrices, and the symmetries of crystals.
 *
 * A rotation is a unit quaternion w,x,y,z, turning by 2 acos(w) about (x,y,z); q and -q are one rotation.
 * Densities and uniformity are with respect to the Haar measure. */
#ifndef AUREOLE_ROTATIONS_H
#define AUREOLE_ROTATIONS_H

#include <aureole/sphere.h>

#ifdef __cplusplus
extern "C" {
#endif

/* To the matrix of a unit quaternion, and back (Shepperd 1978; w is not always positive). */
AUR_API void aur_rotation_from_quaternion(const double wxyz[4], aur_rotation *rotation) AUR_NONNULL(1, 2);
AUR_API void aur_rotation_to_quaternion(const aur_rotation *rotation, double wxyz[4]) AUR_NONNULL(1, 2);

/* A prepared set of rotations: immutable, usable by any number of threads. */
typedef struct aur_rotations aur_rotations;

typedef struct aur_rotations_options {
    size_t size;           /* sizeof the caller's struct */
    uint64_t count;        /* rotations of the set: at least 1 */
    aur_scramble scramble; /* ROTATE3D: one random rotation of all; others as for the cube */
    uint64_t seed;
    aur_warnings warnings;
} aur_rotations_options;

AUR_API aur_result aur_rotations_options_init(uint64_t count, aur_rotations_options *options,
                                              aur_error *error) AUR_NONNULL(2);

/* Prepares a set of rotations: a native one (super-fibonacci, its grid, esfg-rotations), or any set of the
 * cube, whose first three coordinates are mapped to rotations (Shoemake 1992). Errors: as
 * aur_pointset_create. */
AUR_API aur_result aur_rotations_create(const char *set, const aur_rotations_options *options,
                                        aur_rotations **rotations, aur_error *error) AUR_NONNULL(1, 2, 3);
AUR_API void aur_rotations_destroy(aur_rotations *rotations); /* NULL is allowed */
AUR_API uint64_t aur_rotations_size(const aur_rotations *rotations) AUR_NONNULL(1);

/* Writes rotations first .. first+count-1 as w,x,y,z into wxyz[4 * count] (`capacity` counts doubles).
 * Errors: ARGUMENT for a range beyond the set, CAPACITY. */
AUR_API aur_result aur_rotations_points(const aur_rotations *rotations, uint64_t first, size_t count,
                                        size_t capacity, double *wxyz, aur_error *error) AUR_NONNULL(1, 5);

/* The rotational symmetry groups of crystals by their Hermann-Mauguin symbols: the eleven groups without
 * reflections. The first axis, of order 2, 3, 4 or 6, is along z; axes of order 2 across it are along x; 23
 * and 432 have the cube's axes x, y, z and (1,1,1). */
typedef enum aur_symmetry {
    AUR_SYMMETRY_1,   /* triclinic */
    AUR_SYMMETRY_2,   /* monoclinic */
    AUR_SYMMETRY_222, /* orthorhombic */
    AUR_SYMMETRY_3,
    AUR_SYMMETRY_32, /* trigonal */
    AUR_SYMMETRY_4,
    AUR_SYMMETRY_422, /* tetragonal */
    AUR_SYMMETRY_6,
    AUR_SYMMETRY_622, /* hexagonal */
    AUR_SYMMETRY_23,
    AUR_SYMMETRY_432 /* cubic */
} aur_symmetry;

enum { AUR_SYMMETRY_ORDER_MAX = 24 };

/* "1", "2", "222", ... to the value and back. Errors: NAME; the name of a value out of range is NULL. */
AUR_API aur_result aur_symmetry_from_name(const char *name, aur_symmetry *symmetry, aur_error *error)
    AUR_NONNULL(1, 2);
AUR_API const char *aur_symmetry_name(aur_symmetry symmetry);
/* The quaternions of the group, the identity first, into group[4 * AUR_SYMMETRY_ORDER_MAX]; returns their
 * number, or 0 for a value out of range. */
AUR_API size_t aur_symmetry_group(aur_symmetry symmetry, double *group) AUR_NONNULL(2);
/* Replaces each q of wxyz[4 * count] by the rotation of smallest angle among all q g, g in the group, with w
 * >= 0: the same orientation of the crystal, where q maps the crystal's frame to the specimen's. The results
 * are in the fundamental zone, 1/order of all rotations. Errors: ARGUMENT for a symmetry out of range. */
AUR_API aur_result aur_symmetry_reduce(aur_symmetry symmetry, size_t count, double *wxyz, aur_error *error)
    AUR_NONNULL(3);
/* Selects the rotations in the fundamental zone among `count`, in their order, with w >= 0; returns their
 * number. Rotations on the zone's boundary, within 1e-12, are selected. 0 for a symmetry out of range. */
AUR_API size_t aur_symmetry_select(aur_symmetry symmetry, size_t count, double *wxyz) AUR_NONNULL(3);

#ifdef __cplusplus
}
#endif

#endif
