/* The weights nearest to given ones that integrate all polynomials to a degree exactly: A w = b, where a row
 * of A has one function of the basis at all points and b is 1 for the first function and 0 for the others,
 * and the sum of (w - near)^2 / near is least. */
#pragma once

#include <aureole/sphere.h>

#include "points/base/parallel.h"
#include "points/quadrature/exact/space.h"
#include "points/quadrature/exact/transform.h"

typedef struct aur_exact_system {
    aur_polar_points points;
    aur_exact_space
        *space;         /* the functions, or NULL: polynomials on the sphere; the points' count alone holds */
    const double *near; /* of sum 1, not negative; points of weight 0 keep it */
    size_t places;      /* different ones, of points that have weight */
    double lowest, exponent;
    double tolerance; /* steps end where no function errs by more */
    size_t threads;
    aur_progress progress;
} aur_exact_system;

/* The functions to a degree. */
size_t aur_exact_functions(const aur_exact_system *system, size_t degree);

/* Weights are exact when no function is integrated worse than this or the tolerance, the function's root mean
 * square being 1: far above rounding, far below what a missing degree costs. */
#define AUR_EXACT_TOLERANCE 1e-10

typedef struct aur_exact_found {
    bool exact;    /* there are such weights; else nothing else is set but `degree` and `residual` */
    size_t degree; /* asked for, or the largest with positive weights */
    double least, largest;
    double residual;
    size_t iterations; /* 0: by a factorisation */
} aur_exact_found;

/* Whether every point that has weight keeps a positive one; fills least and largest. */
bool aur_exact_positive(const aur_exact_system *system, const double *weights, aur_exact_found *found);

/* found->residual: the largest |A w - b|. */
aur_result aur_exact_residual(const aur_exact_system *system, size_t degree, const double *weights,
                              aur_exact_found *found, aur_error *error);

/* How far a factorisation is, and the work of those before it. */
typedef struct aur_exact_factoring {
    aur_progress_share share;
    double earlier;
    size_t gap; /* the most degrees without positive weights before one that had some */
} aur_exact_factoring;

/* Reports that a factorisation comes to a degree and is thought to end with another one (0: nobody knows);
 * the degrees before count by their time, the cube of each. True: it is to stop. */
bool aur_exact_factoring_stops(const aur_progress *progress, aur_exact_factoring *factoring, size_t at,
                               size_t end);

/* By a factorisation that grows degree by degree, so that every degree is tried: O(points * degree^4) time.
 * `search`: `degree` is only the last one to try. */
enum { AUR_EXACT_DIRECT_POINTS = 2048 };
aur_result aur_exact_direct(const aur_exact_system *system, size_t degree, bool search, double *weights,
                            aur_exact_found *found, aur_error *error);

/* By at most so many steps of conjugate gradients, of O(points + degree^3) on the sphere and O(points *
 * degree^2) elsewhere. */
enum { AUR_EXACT_STEPS = 600, AUR_EXACT_SEARCH_STEPS = 150 };
aur_result aur_exact_iterate(const aur_exact_system *system, size_t degree, size_t steps, double *weights,
                             aur_exact_found *found, aur_error *error);

/* Exact weights for a density that is known by a quadrature: nodes and masses. Polynomials that are
 * orthonormal over the points are made degree by degree from those before, and carried along at the nodes, so
 * that narrow lobes take no more digits than wide ones ("Vandermonde with Arnoldi", Brubeck, Nakatsukasa and
 * Trefethen 2021, on the sphere). */

typedef struct aur_exact_nodes {
    size_t count;
    double *xyz;  /* 3 * count unit vectors; to be freed, with `mass` behind them */
    double *mass; /* count, of sum 1 */
} aur_exact_nodes;

/* Nodes that integrate polynomials of a degree over the GGX lobe, reflection times cosine above the surface,
 * to some 1e-13. Errors: MEMORY. */
aur_result aur_exact_ggx_nodes(const aur_lobe *lobe, size_t degree, aur_exact_nodes *nodes, aur_error *error);

/* A search goes on for so many degrees without positive weights. */
enum { AUR_EXACT_PATIENCE = 4 };

/* As aur_exact_direct, for the points xyz of the system and the density of the nodes; a
 * search ends earlier. O((points + nodes) degree^4) time. Errors: MEMORY, CANCELLED. */
aur_result aur_exact_measured(const aur_exact_system *system, const double *xyz, const aur_exact_nodes *nodes,
                              size_t degree, bool search, aur_exact_factoring *factoring, double *weights,
                              aur_exact_found *found, aur_error *error);
