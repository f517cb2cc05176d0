/* What final gathering compiles once a picture, and nothing changes while the picture is rendered.
 *
 *     rules.c                   what gathers each kind of lobe, of rule.c and rule_*.c
 *     light.c                   maps of photons, and how often lights and bright texels are drawn
 *     plan.c                    the two above, and what the keys ask for
 *
 * What happens at sixteen pixels at a time takes the plan, the places that the pixels see (places.h), the
 * sums to add to (sums.h) and working memory (scratch.h):
 *
 *     incident.c, chain.c       radiance along gather rays: where it is one array read, and where it is not
 *     aim.c                     directions of a rule made into rays at the places, and traced
 *     estimate_*.c              the light of one lobe by such rays; no estimator calls another
 *     drawn_light.c             the light of points on lights and on bright texels
 *     shade.c                   all of these for all lobes of the places
 *     sample.c                  one sample of sixteen pixels: what the eye sees, through mirrors and glass
 * too strata.c, edges.c, pooling.c   what a pixel's samples have seen; more samples at edges; irradiance that
 *                               neighbouring pixels have in common
 *     tile.c                    256 pixels: sixteen groups of sixteen (packets/interleave.h)
 */
#pragma once

#include "transport/gather/light.h"
#include "transport/gather/parameters.h"
#include "transport/gather/rules.h"
#include "transport/packets/shape_class.h"

/* What the keys ask for. */
typedef struct aur_gather_policy {
    aur_gather_component component;
    aur_gather_direct direct;
    aur_gather_decorrelation decorrelation;
    aur_gather_criterion criterion; /* of adaptive gathering */
    float threshold;                /* of the criterion: where a lobe's samples differ more it goes on */
    bool adaptive;
    bool pools;   /* neighbouring pixels split the diffuse rule and pool the irradiance that they find */
    bool packets; /* else every ray by itself: the same picture to rounding, for tests and measurements */
    uint32_t max_depth; /* edges of a light path; UINT32_MAX: no limit */
    uint32_t edge_samples;
    size_t samples_per_pixel;
    uint64_t seed; /* of the rules' rotations */
} aur_gather_policy;

typedef struct aur_gather_plan {
    const aur_scene *scene;
    aur_gather_policy policy;
    aur_gather_rules rules;
    aur_gather_light light;
    aur_shape_class *classes; /* one a shape */
    /* Whether gather rays count the lights that they meet in full. Under next-event estimation they count
     * them by multiple importance sampling. */
    bool counts_emitters;
    bool gathers; /* whether gather rays can bring any light */
} aur_gather_plan;

/* `pattern` is what the rules have in common; the maps of photons come from the context's cache, which
 * outlives the plan. */
aur_result aur_gather_plan_create(const aur_gather_parameters *p, const aur_gather_rule_options *pattern,
                                  const aur_integrator_context *context, aur_gather_plan **plan,
                                  aur_error *error);
void aur_gather_plan_destroy(aur_gather_plan *plan); /* NULL is allowed */

/* Whether the light of a lobe comes by gather rays. */
static inline bool aur_gather_plan_gathers(const aur_gather_plan *plan, const aur_bsdf_lobe *lobe) {
    if (!plan->gathers || lobe->shape == AUR_LOBE_SHAPE_SPECULAR)
        return false;
    return plan->policy.component == AUR_COMPONENT_ALL ||
           lobe->diffuse == (plan->policy.component == AUR_COMPONENT_DIFFUSE);
}
