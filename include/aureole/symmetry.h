/* Point groups, and quadrature rules for functions with their symmetry: each evaluation stands for all images
 * under the group. */
#ifndef AUREOLE_SYMMETRY_H
#define AUREOLE_SYMMETRY_H

#include <aureole/sphere.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { AUR_POINT_GROUP_ORDER_MAX = 120, AUR_POINT_GROUP_AXIS_MAX = 30 };

/* Rotations and reflections as orthogonal matrices, the identity first. */
typedef struct aur_point_group {
    size_t order;
    aur_rotation elements[AUR_POINT_GROUP_ORDER_MAX];
} aur_point_group;

/* The point group of a Schoenflies symbol, n from 1 to AUR_POINT_GROUP_AXIS_MAX: "Ci" (antipodal, u and -u),
 * "Cs" (a mirror plane), "Cn", "Cnv", "Cnh", "Sn" (n even), "Dn", "Dnh", "Dnd", "T", "Td", "Th", "O", "Oh",
 * "I", "Ih". The main axis is z, the mirror of Cs and Cnh is z = 0; mirrors of Cnv contain x, axes of order 2
 * across z lie along x; the cubic groups have the axes x, y, z and (1,1,1), I has axes of order 2 along x, y,
 * z. A box along the axes has D2h, a cylinder Dnh for every n. Errors: NAME. */
AUR_API aur_result aur_point_group_from_name(const char *name, aur_point_group *group, aur_error *error)
    AUR_NONNULL(1, 2);

/* Selects one point of each orbit of `count` unit vectors xyz[3 * count], in their order: those in the
 * fundamental region. These are the directions that no element brings nearer to the direction 40 degrees from
 * +z at the azimuth 2.3 degrees. Returns their number. Of points on the boundary (within 1e-12) one image is
 * selected. weights[count], unless NULL, become those of the whole orbits; for a set with the symmetry their
 * sum is unchanged. */
AUR_API size_t aur_point_group_select(const aur_point_group *group, size_t count, double *xyz,
                                      double *weights) AUR_NONNULL(1, 3);

/* At most `most` directions xyz[3 * *count] and weights[*count] of sum 1 whose images under the group are a
 * product rule on the sphere: Gauss-Legendre heights times equal azimuths. Means of functions that are
 * invariant under the group are exact for polynomials of degree about sqrt(2 most order) - 1; the order
 * counts elements that map the z axis to itself or to -z. `capacity` counts doubles of xyz; weights has a
 * third as many elements. Errors: ARGUMENT for fewer points than the smallest rule (which number), CAPACITY,
 * MEMORY. */
AUR_API aur_result aur_symmetric_rule(const aur_point_group *group, size_t most, size_t capacity, double *xyz,
                                      double *weights, size_t *count, aur_error *error)
    AUR_NONNULL(1, 4, 5, 6);

#ifdef __cplusplus
}
#endif

#endif
