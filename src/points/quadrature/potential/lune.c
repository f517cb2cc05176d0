#include "points/quadrature/potential/potential.h"

#include <math.h>

#include "points/base/gauss.h"
#include "points/base/vector.h"
#include "points/base/vector3d.h"

static const double negligible = 1e-13;

/* Nodes, their cosines, and weights on [from, to] for cos^exponent, by the Gauss rule of `count` nodes on
 * [-1,1]; `to` is the end where the cosine vanishes or nearly does. There cos^exponent is not smooth for a
 * small non-integer exponent: the substitution t = x^power of the distance t to that end restores smoothness.
 */
static void lobe_rule(double from, double to, double exponent, size_t count, const double *node,
                      const double *share, double *angle, double *cosine, double *weight) {
    const int power = exponent < 0.5 ? 3 : exponent < 1.0 ? 2 : 1;
    for (size_t i = 0; i < count; ++i) {
        const double x = 0.5 * (1.0 - node[i]);
        const double slope = power == 1 ? 1.0 : power == 2 ? 2.0 * x : 3.0 * x * x;
        angle[i] = to + (from - to) * (power == 1 ? x : power == 2 ? x * x : x * x * x);
        cosine[i] = cos(angle[i]);
        weight[i] = 0.5 * fabs(to - from) * share[i] * slope * pow(cosine[i], exponent);
    }
}

/* (m+1)/(2 pi): the peak of the normalised lobe. */
static double peak(const aur_lune *lune) {
    return (lune->exponent + 1.0) / (2.0 * AUR_PI);
}

/* The integral over beta of cos^{m+1}(beta), sqrt(pi) Gamma(n + 1/2) / Gamma(n + 1) with n = (m+1)/2: by the
 * asymptotic series from n = 64 on, to rounding, and by two integrations by parts a step below. */
static double aside_integral(double m) {
    double factor = sqrt(AUR_PI);
    for (; m < 127.0; m += 2.0)
        factor *= (m + 3.0) / (m + 2.0);
    const double t = 2.0 / (m + 1.0);
    const double series =
        1.0 + t * (1.0 / 8.0 +
                   t * (1.0 / 128.0 + t * (-5.0 / 1024.0 + t * (-21.0 / 32768.0 + t * (399.0 / 262144.0)))));
    return factor * sqrt(t) / series;
}

void aur_lune_init(aur_lune *lune, const double axis[3], double exponent) {
    const double cosine = fmin(axis[2], 1.0);
    const double sine = hypot(axis[0], axis[1]);
    *lune = (aur_lune){.exponent = exponent, .horizon = 0.5 * AUR_PI - atan2(sine, cosine)};
    for (int i = 0; i < 3; ++i)
        lune->axis[i] = axis[i];
    if (sine > 0.0) {
        lune->down[0] = axis[0] * cosine / sine;
        lune->down[1] = axis[1] * cosine / sine;
        lune->aside[0] = -axis[1] / sine;
        lune->aside[1] = axis[0] / sine;
    } else {
        lune->down[0] = 1.0;
        lune->aside[1] = 1.0;
    }
    lune->down[2] = -sine;
    lune->psi_reach = exponent > 0.0 ? acos(pow(negligible, 1.0 / exponent)) : 0.5 * AUR_PI;
    lune->beta_reach = acos(pow(negligible, 1.0 / (exponent + 1.0)));
    aur_gauss_legendre(AUR_LUNE_SIDE, lune->side, lune->side_weight);
    if (lune->horizon >= lune->psi_reach)
        return;
    double node[AUR_LUNE_ACROSS], share[AUR_LUNE_ACROSS], psi[AUR_LUNE_ACROSS];
    aur_gauss_legendre(AUR_LUNE_ACROSS, node, share);
    lobe_rule(lune->horizon, lune->psi_reach, exponent, AUR_LUNE_ACROSS, node, share, psi, lune->cosine,
              lune->across_weight);
    double sum = 0.0;
    for (size_t i = 0; i < AUR_LUNE_ACROSS; ++i) {
        lune->sine[i] = sin(psi[i]);
        sum += lune->across_weight[i];
    }
    lune->fraction = fmin(1.0, peak(lune) * aside_integral(exponent) * sum);
}

double aur_lune_potential(const aur_lune *lune, const aur_kernel_rule *rule, const double u[3]) {
    enum { ASIDE = 2 * AUR_LUNE_SIDE, COUNT = ASIDE * AUR_LUNE_ACROSS };
    if (lune->fraction <= 0.0)
        return 0.0;
    const double local[3] = {aur_dot3(u, lune->axis), aur_dot3(u, lune->down), aur_dot3(u, lune->aside)};
    /* The kernel is not smooth at u: the intervals meet at its beta, where Gauss nodes are dense. */
    double middle = asin(fmax(-1.0, fmin(1.0, local[2])));
    if (fabs(middle) >= 0.98 * lune->beta_reach)
        middle = 0.0;
    double beta[ASIDE], cosine[ASIDE], sine[ASIDE], aside_weight[ASIDE];
    for (size_t side = 0; side < 2; ++side) {
        const double end = side == 0 ? -lune->beta_reach : lune->beta_reach;
        const size_t at = side * AUR_LUNE_SIDE;
        lobe_rule(middle, end, lune->exponent + 1.0, AUR_LUNE_SIDE, lune->side, lune->side_weight, beta + at,
                  cosine + at, aside_weight + at);
    }
    for (size_t i = 0; i < ASIDE; ++i)
        sine[i] = sin(beta[i]);
    double x[COUNT], y[COUNT], z[COUNT], weight[COUNT];
    for (size_t j = 0; j < AUR_LUNE_ACROSS; ++j) {
        for (size_t i = 0; i < ASIDE; ++i) {
            const size_t at = j * ASIDE + i;
            x[at] = cosine[i] * lune->cosine[j];
            y[at] = cosine[i] * lune->sine[j];
            z[at] = sine[i];
            weight[at] = lune->across_weight[j] * aside_weight[i];
        }
    }
    return peak(lune) * aur_kernel_sum(rule, local, COUNT, (aur_columns){x, y, z}, weight);
}

void aur_lune_visible(const aur_lune *lune, double *xyz, double *weights) {
    double node[AUR_LUNE_ACROSS], share[AUR_LUNE_ACROSS], psi[AUR_LUNE_ACROSS], psi_weight[AUR_LUNE_ACROSS];
    double beta[AUR_LUNE_SIDE], beta_weight[AUR_LUNE_SIDE], cosine[AUR_LUNE_ACROSS];
    aur_gauss_legendre(AUR_LUNE_ACROSS, node, share);
    lobe_rule(fmin(lune->horizon, lune->psi_reach), -lune->psi_reach, lune->exponent, AUR_LUNE_ACROSS, node,
              share, psi, cosine, psi_weight);
    lobe_rule(0.0, lune->beta_reach, lune->exponent + 1.0, AUR_LUNE_SIDE, lune->side, lune->side_weight, beta,
              cosine, beta_weight);
    size_t at = 0;
    for (size_t j = 0; j < AUR_LUNE_ACROSS; ++j) {
        for (size_t i = 0; i < 2 * AUR_LUNE_SIDE; ++i, ++at) {
            const double angle = i % 2 == 0 ? beta[i / 2] : -beta[i / 2];
            for (int k = 0; k < 3; ++k)
                xyz[3 * at + k] = cos(angle) * (cos(psi[j]) * lune->axis[k] + sin(psi[j]) * lune->down[k]) +
                                  sin(angle) * lune->aside[k];
            weights[at] = peak(lune) * psi_weight[j] * beta_weight[i / 2];
        }
    }
}
