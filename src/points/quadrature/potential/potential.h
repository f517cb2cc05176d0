/* The implementation of a potential: its density and the data to evaluate z, which depend on the kind. A lobe
 * has the series of its potential along the axis and, if clipped, its hidden part. The other kinds are sums
 * over nodes, except the constant one of the sphere. Immutable. */
#pragma once

#include <aureole/quadrature.h>
#include <stdbool.h>
#include <stddef.h>

#include "points/base/error.h"
#include "points/quadrature/kernel.h"

/* The potential of a cos^m lobe: a function only of x = u.axis. */

/* z(x) is smooth except at x = 0, where the lobe ends: one Chebyshev series for each side, in t = 2|x| - 1.
 */
typedef struct aur_zonal {
    size_t count[2];         /* of x >= 0 and of x < 0 */
    double *coefficients[2]; /* one allocation, that of [0] */
    double self_energy;
} aur_zonal;

/* The lobe (m+1)/(2 pi) cos^m with m in [0, 1e5]. */
aur_result aur_zonal_create(double exponent, double smoothness, aur_zonal *zonal, aur_error *error);
void aur_zonal_release(aur_zonal *zonal);

/* z[i] at x[i] in [-1,1]; rounding may exceed it slightly. NaN gives NaN. */
void aur_zonal_evaluate(const aur_zonal *zonal, size_t count, const double *x, double *z);

/* The number of terms for a truncation error of about 1e-12 of the sum. */
size_t aur_zonal_terms(double exponent, double smoothness);

/* The part of a cos^m lobe below the surface.
 *
 * With the lobe's axis a at the angle theta from the normal, v = cos(beta) (cos(psi) a + sin(psi) t) +
 * sin(beta) e, where t points down in the plane of a and the normal and e is that plane's normal, makes the
 * hidden part the rectangle pi/2 - theta < psi < pi/2 and p a product: cos^m(psi) cos^m(beta). */

enum { AUR_LUNE_SIDE = 24, AUR_LUNE_ACROSS = 32 };

typedef struct aur_lune {
    double axis[3], down[3], aside[3];
    double exponent;
    double horizon;               /* psi of the horizon: pi/2 - theta */
    double fraction;              /* of the lobe that is hidden */
    double psi_reach, beta_reach; /* beyond these the lobe is 1e-13 of its peak */
    double side[AUR_LUNE_SIDE], side_weight[AUR_LUNE_SIDE];
    /* Of the nodes in psi, and their weights times p. */
    double cosine[AUR_LUNE_ACROSS], sine[AUR_LUNE_ACROSS], across_weight[AUR_LUNE_ACROSS];
} aur_lune;

/* `axis` is a unit vector with z >= 0. */
void aur_lune_init(aur_lune *lune, const double axis[3], double exponent);

/* The potential at u of the hidden part of the normalised whole lobe, to subtract from that of the whole
 * lobe. */
double aur_lune_potential(const aur_lune *lune, const aur_kernel_rule *rule, const double u[3]);

/* Nodes and weights, AUR_LUNE_VISIBLE of them, of the visible part of the normalised whole lobe, for smooth
 * functions; their sum is 1 - fraction. */
enum { AUR_LUNE_VISIBLE = 2 * AUR_LUNE_SIDE * AUR_LUNE_ACROSS };
void aur_lune_visible(const aur_lune *lune, double *xyz, double *weights);

struct aur_potential {
    aur_density density; /* with a unit axis and the default node_count filled in */
    aur_kernel_rule rule;
    double mass;
    aur_zonal zonal; /* COSINE_POWER; SPHERE: only the self-energy */
    aur_lune lune;   /* COSINE_POWER, clipped */
    double *storage; /* NODES, FUNCTION, GGX: x, y, z and masses of sum 1, node_count each */
    aur_columns nodes;
    const double *node_masses; /* NULL: the density has no nodes */
};

/* Whether samples below the surface are hidden. */
static inline bool aur_potential_hides(const aur_potential *potential) {
    const aur_density_kind kind = potential->density.kind;
    return kind == AUR_DENSITY_GGX || (kind == AUR_DENSITY_COSINE_POWER && potential->density.clipped);
}

/* Whether the axis is all zero, the default +z. */
static inline bool aur_is_default_axis(const double axis[3]) {
    return axis[0] == 0.0 && axis[1] == 0.0 && axis[2] == 0.0;
}

/* Unnormalised densities as nodes: fill columns x, y, z and masses, node_count each. */
aur_result aur_nodes_function(const aur_density *density, double *columns, double *masses, aur_error *error);
aur_result aur_nodes_ggx(const aur_density *density, double *columns, double *masses, aur_error *error);
/* The GGX lobe, reflection times cosine, in 1/steradian. */
double aur_ggx_value(const aur_density *density, const double direction[3]);

/* The published look-up table of z, for aur_z_grid. */

typedef struct aur_potential_table aur_potential_table;

/* Errors: ARGUMENT for a grid out of its ranges, MEMORY. */
aur_result aur_potential_table_create(const aur_z_grid *grid, double smoothness, aur_potential_table **table,
                                      aur_error *error);
void aur_potential_table_destroy(aur_potential_table *table); /* NULL is allowed */

/* z of the normalised cos^m lobe at directions with given cosines to its axis. */
void aur_potential_table_evaluate(const aur_potential_table *table, double exponent, size_t count,
                                  const double *cosines, double *z);
