/* Exact weights for a density that is known by a quadrature: nodes and masses. Polynomials that are
 * orthonormal over the points are made degree by degree from those before, and carried along at the nodes, so
 * that narrow lobes take no more digits than wide ones ("Vandermonde with Arnoldi", Brubeck, Nakatsukasa and
 * Trefethen 2021, on the sphere). */
#pragma once

#include <aureole/sphere.h>

#include "points/quadrature/exact/system.h"

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
