/* The weights nearest to given ones that integrate all polynomials to a degree exactly: A w = b, where a row
 * of A has one function of the basis at all points and b is 1 for the first function and 0 for the others,
 * and the sum of (w - near)^2 / near is minimal. */
#pragma once

#include <aureole/sphere.h>

#include "points/base/parallel.h"
#include "points/quadrature/exact/space.h"
#include "points/quadrature/exact/transform.h"

typedef struct aur_exact_system {
    aur_polar_points points;
    aur_exact_space
        *space; /* the functions, or NULL: polynomials on the sphere; of the points only the count is used */
    const double *near;     /* of sum 1, not negative; points of weight 0 keep weight 0 */
    size_t distinct_points; /* distinct points with weight */
    double lowest, exponent;
    double tolerance; /* steps end when the error of every function is at most this */
    size_t threads;
    aur_progress progress;
} aur_exact_system;

/* The functions to a degree. */
size_t aur_exact_functions(const aur_exact_system *system, size_t degree);

/* Weights count as exact if the error of every function, of root mean square 1, is at most this or the
 * tolerance: far above rounding, far below the error of a missing degree. */
#define AUR_EXACT_TOLERANCE 1e-10

typedef struct aur_exact_found {
    bool exact;    /* such weights exist; otherwise only `degree` and `residual` are set */
    size_t degree; /* requested, or the largest with positive weights */
    double least, largest;
    double residual;
    size_t iterations; /* 0: by a factorisation */
} aur_exact_found;

/* Whether all weights are positive, except points with `near` 0; fills least and largest. */
bool aur_exact_positive(const aur_exact_system *system, const double *weights, aur_exact_found *found);

/* found->residual: the largest |A w - b|. */
aur_result aur_exact_residual(const aur_exact_system *system, size_t degree, const double *weights,
                              aur_exact_found *found, aur_error *error);

/* The progress of a factorisation, and the work of previous ones. */
typedef struct aur_exact_factoring {
    aur_progress_share share;
    double earlier;
    size_t gap; /* the longest run of degrees without positive weights before one with positive weights */
} aur_exact_factoring;

/* Reports that a factorisation reaches a degree, and the degree at which it is expected to end (0: unknown).
 * Degrees count by their time, the cube. True: stop. */
bool aur_exact_factoring_stops(const aur_progress *progress, aur_exact_factoring *factoring, size_t at,
                               size_t end);

/* By a factorisation that grows degree by degree, so that every degree is tried: O(points * degree^4) time.
 * `search`: `degree` is the upper bound of a search. */
enum { AUR_EXACT_DIRECT_POINTS = 2048 };
aur_result aur_exact_direct(const aur_exact_system *system, size_t degree, bool search, double *weights,
                            aur_exact_found *found, aur_error *error);

/* By at most `limit` steps of conjugate gradients, of O(points + degree^3) on the sphere and O(points *
 * degree^2) elsewhere. */
enum { AUR_EXACT_STEPS = 600, AUR_EXACT_SEARCH_STEPS = 150 };
aur_result aur_exact_iterate(const aur_exact_system *system, size_t degree, size_t steps, double *weights,
                             aur_exact_found *found, aur_error *error);

/* Exact weights for a density given by a quadrature: nodes and masses. Polynomials that are orthonormal over
 * the points are computed degree by degree, and evaluated at the nodes, too, so that narrow lobes lose no
 * more digits than wide ones ("Vandermonde with Arnoldi", Brubeck, Nakatsukasa and Trefethen 2021, on the
 * sphere). */

typedef struct aur_exact_nodes {
    size_t count;
    double *xyz;  /* 3 * count unit vectors; free it; `mass` is in the same allocation */
    double *mass; /* count, of sum 1 */
} aur_exact_nodes;

/* Nodes that integrate polynomials of a degree over the GGX lobe, reflection times cosine above the surface,
 * to some 1e-13. Errors: MEMORY. */
aur_result aur_exact_ggx_nodes(const aur_lobe *lobe, size_t degree, aur_exact_nodes *nodes, aur_error *error);

/* The number of degrees without positive weights after which a search ends. */
enum { AUR_EXACT_PATIENCE = 4 };

/* As aur_exact_direct, for the points xyz of the system and the density of the nodes; a
 * search ends earlier. O((points + nodes) degree^4) time. Errors: MEMORY, CANCELLED. */
aur_result aur_exact_measured(const aur_exact_system *system, const double *xyz, const aur_exact_nodes *nodes,
                              size_t degree, bool search, aur_exact_factoring *factoring, double *weights,
                              aur_exact_found *found, aur_error *error);
