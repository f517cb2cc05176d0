/* The inside of a potential: the density it was made from and, by its kind, what z is evaluated with. A lobe
 * has the series of its potential along the axis and, clipped, the hidden part of it; the other kinds but the
 * constant one of the sphere are sums over nodes. It does not change once it is made. */
#pragma once

#include <aureole/quadrature.h>
#include <stdbool.h>

#include "points/quadrature/kernel.h"
#include "points/quadrature/potential/lune.h"
#include "points/quadrature/potential/zonal.h"

struct aur_potential {
    aur_density density; /* its axis a unit vector, node_count what it stands for */
    aur_kernel_rule rule;
    double mass;
    aur_zonal zonal; /* COSINE_POWER; SPHERE: its self-energy alone */
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

/* All zero, which stands for +z. */
static inline bool aur_is_default_axis(const double axis[3]) {
    return axis[0] == 0.0 && axis[1] == 0.0 && axis[2] == 0.0;
}

/* Unnormalised densities as nodes: fill columns x, y, z and masses, node_count each. */
aur_result aur_nodes_function(const aur_density *density, double *columns, double *masses, aur_error *error);
aur_result aur_nodes_ggx(const aur_density *density, double *columns, double *masses, aur_error *error);
/* The GGX lobe, reflection times cosine, in 1/steradian. */
double aur_ggx_value(const aur_density *density, const double direction[3]);
