/* Weights that make a quadrature of any points exact to a degree.
 *
 * On square, cube, disk and rotations the functions are polynomials of a total degree in the coordinates, and
 * Wigner's functions to a degree. On axes only polynomials of even degree are defined: the rule is that of
 * the sphere with both ends, each with half the weight. On the sphere, the hemisphere or a cap about +z a
 * rule is exact to degree L when it integrates every polynomial in x, y, z of degree L or less without error:
 * on the sphere all spherical harmonics to degree L, (L+1)^2 of them. Of all such weights these are the
 * nearest to equal weights, or to given weights. Everywhere the density that is integrated against is
 * normalised to integral 1, so that equal weights are 1/N and the weights sum to 1: multiply by the area (4
 * pi, 2 pi, ...) for integrals over solid angle. */
#ifndef AUREOLE_EXACT_H
#define AUREOLE_EXACT_H

#include <aureole/rotations.h>
#include <aureole/symmetry.h>
#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Instead of a degree: the largest with positive weights. */
#define AUR_DEGREE_LARGEST SIZE_MAX
/* The largest degree. */
#define AUR_EXACT_DEGREE_MAX 1500
/* The largest exponent of a lobe. */
#define AUR_EXACT_EXPONENT_MAX 1e4
/* The largest degree for a GGX lobe. */
#define AUR_EXACT_GGX_DEGREE_MAX 64
/* The tolerance of conjugate gradients that 0 stands for. */
#define AUR_EXACT_TOLERANCE_DEFAULT 1e-14
/* The smallest and largest tolerance. */
#define AUR_EXACT_TOLERANCE_MIN 1e-15
#define AUR_EXACT_TOLERANCE_MAX 1e-2
/* The largest dimension of a cube. */
#define AUR_EXACT_DIMENSION_MAX 4096
/* The largest product of functions and points on square, cube, disk and rotations. */
#define AUR_EXACT_ENTRIES_MAX 134217728

typedef struct aur_exact_options {
    size_t size;        /* sizeof the caller's struct */
    aur_domain domain;  /* any */
    double cap_degrees; /* 0: all of the domain; else the cap of that polar angle about +z */
    /* The density: uniform unless the domain is the whole HEMISPHERE. With GGX points below the surface (z <
     * 0) have weight 0. */
    aur_lobe lobe;
    size_t degree;      /* AUR_DEGREE_LARGEST, or 0 to AUR_EXACT_DEGREE_MAX */
    bool negative;      /* a given degree may take negative weights */
    const double *near; /* weights to approximate: one per point, >= 0, not all 0; NULL: equal */
    size_t threads;     /* 0: all; results are bit-identical for any number */
    aur_progress progress;
    /* For more than 2048 points: conjugate gradients end when the error of every function is at most this. 0:
     * AUR_EXACT_TOLERANCE_DEFAULT. */
    double tolerance;
    size_t dimension; /* of the CUBE: 1 to AUR_EXACT_DIMENSION_MAX */
    /* SPHERE: only functions with the symmetry of this group, one point of each orbit (or any points); a
     * weight is that of the whole orbit. NULL: no symmetry. */
    const aur_point_group *group;
    /* ROTATIONS: only functions that are the same at q g for g of the crystal's group, and at s q for s of
     * the sample's. */
    aur_symmetry crystal, sample;
} aur_exact_options;

/* The largest degree, near to equal weights, on a whole domain. */
AUR_API aur_result aur_exact_options_init(aur_domain domain, aur_exact_options *options, aur_error *error)
    AUR_NONNULL(2);

typedef struct aur_exact_report {
    size_t degree;
    double residual; /* the largest error among the orthonormal functions to the degree (harmonics on the
                        sphere), whose mean square is 1 */
    double least, largest;  /* weight times `points` */
    size_t points;          /* points with weights: without those below a GGX lobe's surface */
    size_t distinct_points; /* among `points`: coincident points count once */
    size_t iterations;      /* of conjugate gradients; 0: solved by a factorisation */
} aur_exact_report;

/* weights[count] for unit vectors points[3 * count], or coordinates points[dimension * count] of square, cube
 * and disk, or unit quaternions w,x,y,z points[4 * count]: those that minimise the sum of (w - near)^2 / near
 * among all weights that are exact to the degree, where `near` is scaled to sum 1. Coincident points share
 * the weight of one point, unless `near` is given; points with `near` 0 keep the weight 0. For up to 2048
 * points one growing factorisation tries every degree, O(count degree^4). More points are solved by conjugate
 * gradients until the residual reaches the tolerance, or is below 1e-10 after 600 steps. Each step is O(count
 * + degree^3) on the whole sphere and O(count degree^2) elsewhere; the largest degree is found by bisection
 * with 150 steps each. GGX lobes are integrated by a product quadrature to 1e-13; O((count + 1e4 to 1e5
 * nodes) degree^4) for any count, and the search for the largest degree ends after four without positive
 * weights. On square, cube, disk and rotations steps of conjugate gradients take O(count functions), and
 * AUR_EXACT_ENTRIES_MAX limits the search for the largest degree. `capacity` counts weights; `report` may be
 * NULL.
 *
 * Errors: ARGUMENT for no point, a vector that is not of unit length or lies outside the domain (which),
 * options out of range, a degree that no weights of these points reach (with the remaining error), a degree
 * that needs negative weights unless they are allowed (with the least one); CAPACITY; MEMORY; CANCELLED. */
AUR_API aur_result aur_weights_exact(size_t count, const double *points, const aur_exact_options *options,
                                     size_t capacity, double *weights, aur_exact_report *report,
                                     aur_error *error) AUR_NONNULL(2, 3, 5);

/* Nested rules: the same for the first counts[k] points of a set, for each of `level_count` ascending counts,
 * the last of which may be less than `count`. weights[level_count * count] begin with the first level;
 * weights of points beyond a level are 0. One function value per point then gives an integral for every
 * level. Differences of consecutive levels estimate the error: of the lower level for smooth functions, of
 * either for rough ones. Intended for the levels of extensible grids (esfg) and for prefixes of sequences.
 * `reports`, unless NULL, has level_count elements; `near` of the options covers all points. Errors: as
 * aur_weights_exact, with the level; ARGUMENT for counts that do not ascend from 1. */
AUR_API aur_result aur_weights_nested(size_t count, const double *xyz, size_t level_count,
                                      const size_t *counts, const aur_exact_options *options, size_t capacity,
                                      double *weights, aur_exact_report *reports, aur_error *error)
    AUR_NONNULL(2, 4, 5, 7);

#ifdef __cplusplus
}
#endif

#endif
