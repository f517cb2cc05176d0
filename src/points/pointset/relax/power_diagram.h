/* Power diagrams of weighted sites on the torus [0,1)^2: the cell of a site is where |x - site|^2 - weight is
 * least. */
#pragma once

#include "points/pointset/relax/relaxation.h"

enum { AUR_POWER_EDGES = 24 }; /* more edges than a cell ever has here; beyond them none is recorded */

typedef struct aur_power_cell {
    double area;
    aur_point2 centre; /* of mass, from the site */
    size_t edge_count;
    uint32_t neighbours[AUR_POWER_EDGES]; /* the site across each edge; the site itself for an image of it */
    double slopes[AUR_POWER_EDGES];       /* how the area grows with the difference of weights: length / (2
                                             distance) */
} aur_power_cell;

typedef struct aur_power_diagram {
    size_t count;
    const aur_point2 *sites;
    const double *weights;
    aur_site_grid grid; /* filled with the sites */
    aur_power_cell *cells;
    bool warm; /* the cells are those of sites and weights that were much like these: where to begin */
} aur_power_diagram;

/* Computes all cells; they are independent of each other and of the number of threads. */
void aur_power_diagram_compute(aur_power_diagram *diagram);
