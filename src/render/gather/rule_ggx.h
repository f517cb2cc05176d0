/* A rule for a GGX lobe of one roughness: the pattern is mapped to visible normals, and its optimal weights
 * are tabulated over the view angle. It is turned in K prepared ways relative to the plane of the view, or
 * mirrored in it, so that a weight depends on that angle only. */
#pragma once

#include "points/quadrature/tables/weight_table.h"
#include "render/gather/settings.h"
#include "render/sampling/rule.h"

typedef struct aur_ggx_rule_options {
    aur_gather_rule_options pattern; /* at least one rotation */
    float alpha;
    double regularization;
    size_t threads; /* that build the table; 0: all */
    aur_progress progress;
} aur_ggx_rule_options;

/* Immutable. */
typedef struct aur_ggx_rule {
    float alpha;
    size_t count, rotations;
    /* Per rotation: a direction's azimuth from the plane of the view, in turns, and the part of the
     * hemisphere above it. */
    float (*square)[2];
    aur_weight_table *table;
} aur_ggx_rule;

aur_result aur_ggx_rule_create(const aur_ggx_rule_options *options, aur_ggx_rule *rule, aur_error *error);
void aur_ggx_rule_release(aur_ggx_rule *rule);

/* The rule as a view sees it. */
typedef struct aur_ggx_view {
    const float (*square)[2];
    const float *below, *above; /* rows of weights */
    float part;                 /* interpolation parameter between them */
    float circles;              /* the view's azimuth */
    float sign;                 /* -1: mirrored */
    float mass;                 /* of the lobe */
    float alpha, lambda;        /* Smith's, of the view */
} aur_ggx_view;

/* `view` is local, on either side of the surface. */
aur_ggx_view aur_ggx_rule_view(const aur_ggx_rule *rule, size_t rotation, bool mirrored, aur_vector view);

/* Direction `index` as the pair of numbers with which a BSDF samples visible normals. */
static inline void aur_ggx_view_square(const aur_ggx_view *view, size_t index, float point[2]) {
    const float circles = view->circles + view->sign * view->square[index][0];
    point[0] = fminf(circles - floorf(circles), 0x1.fffffep-1f);
    point[1] = view->square[index][1];
}

/* What the lobe over its density counts in that direction, `height` above the surface, in a sum that
 * estimates the integral: 1/N where weights are p/q. */
float aur_ggx_view_weight(const aur_ggx_view *view, size_t index, float height);
