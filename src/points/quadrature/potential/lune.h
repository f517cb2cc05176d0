/* The part of a cos^m lobe below the surface.
 *
 * With the lobe's axis a at the angle theta from the normal, v = cos(beta) (cos(psi) a + sin(psi) t) +
 * sin(beta) e, where t points down in the plane of a and the normal and e is that plane's normal, makes the
 * hidden part the rectangle pi/2 - theta < psi < pi/2 and p a product: cos^m(psi) cos^m(beta). */
#pragma once

#include "points/quadrature/kernel.h"

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

/* `axis` is a unit vector that does not point below the surface. */
void aur_lune_init(aur_lune *lune, const double axis[3], double exponent);

/* The potential at u of the hidden part of the normalised whole lobe: what to take from the whole lobe's. */
double aur_lune_potential(const aur_lune *lune, const aur_kernel_rule *rule, const double u[3]);

/* Nodes and weights, AUR_LUNE_VISIBLE of them, of the visible part of the normalised whole lobe, for
 * functions that are smooth there; their sum is 1 - fraction. */
enum { AUR_LUNE_VISIBLE = 2 * AUR_LUNE_SIDE * AUR_LUNE_ACROSS };
void aur_lune_visible(const aur_lune *lune, double *xyz, double *weights);
