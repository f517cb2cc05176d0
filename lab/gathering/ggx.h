/* GGX lobes of one roughness by a pattern with optimal weights: the pattern is mapped to visible normals, and
 * its weights are tabulated over the view angle. It is turned in K prepared ways relative to the plane of the
 * view, or mirrored in it, so that a weight depends on that angle only. */
#pragma once

#include <math.h>

#include <aureole/quadrature.h>

#include "settings.h"

/* Immutable. */
typedef struct lab_ggx_rule {
    float alpha;
    size_t count, rotations, subsets;
    /* Per rotation: a direction's azimuth from the plane of the view, in turns, and the part of the
     * hemisphere above it. */
    float (*square)[2];
    aur_weight_table *table;
} lab_ggx_rule;

/* The method's functions. Without prepared rotations or optimal weights there is no state. */
aur_result lab_ggx_prepare(const aur_gather_settings *options, const aur_gather_common *common, size_t count,
                           float alpha, void **state, aur_error *error);
void lab_ggx_release(void *state);
void lab_ggx_gather(uint32_t lanes, aur_gather_sweep *sweep);

aur_result lab_ggx_rule_create(const lab_gather_settings *o, const aur_gather_common *common, size_t count,
                               float alpha, lab_ggx_rule **rule, aur_error *error);

/* The rule as a view sees it. */
typedef struct lab_ggx_view {
    const float (*square)[2];
    const float *below, *above; /* rows of weights */
    float part;                 /* interpolation parameter between them */
    float circles;              /* the view's azimuth */
    float sign;                 /* -1: mirrored */
    float mass;                 /* of the lobe */
    float alpha, lambda;        /* Smith's, of the view */
} lab_ggx_view;

/* `view` is local, on either side of the surface. */
lab_ggx_view lab_ggx_rule_view(const lab_ggx_rule *rule, size_t rotation, bool mirrored, const float view[3]);

/* Direction `index` as the pair of numbers with which a BSDF samples visible normals. */
static inline void lab_ggx_view_square(const lab_ggx_view *view, size_t index, float point[2]) {
    const float circles = view->circles + view->sign * view->square[index][0];
    point[0] = fminf(circles - floorf(circles), 0x1.fffffep-1f);
    point[1] = view->square[index][1];
}

/* What the lobe over its density counts in that direction, `height` above the surface, in a sum that
 * estimates the integral: 1/N where weights are p/q. */
float lab_ggx_view_weight(const lab_ggx_view *view, size_t index, float height);
