#include "transport/gather/plan.h"

#include <stdlib.h>

#include "core/error.h"

static aur_gather_policy policy_of(const aur_gather_parameters *p, const aur_gather_rule_options *pattern,
                                   const aur_integrator_context *context) {
    return (aur_gather_policy){.component = p->component,
                               .direct = p->direct,
                               .decorrelation = p->decorrelation,
                               .criterion = p->criterion,
                               .threshold = (float)p->threshold,
                               .adaptive = p->adaptive,
                               .pools = p->share,
                               .packets = p->packets,
                               .max_depth = p->max_depth < 0 ? UINT32_MAX : (uint32_t)p->max_depth,
                               .edge_samples = (uint32_t)p->edges,
                               .samples_per_pixel = context->samples_per_pixel,
                               .seed = pattern->seed};
}

static aur_result compile(aur_gather_plan *plan, const aur_gather_parameters *p,
                          const aur_gather_rule_options *pattern, const aur_integrator_context *context,
                          aur_error *error) {
    const aur_gather_policy *const policy = &plan->policy;
    aur_result result = aur_gather_rules_create(p, pattern, context, &plan->rules, error);
    if (result == AUR_OK)
        result = aur_shape_classes_create(context->scene, &plan->classes, error);
    /* Where gather rays go on from every surface, there is no use for photons. */
    const bool wants_photons = p->incident == AUR_INCIDENT_PHOTONS && policy->max_depth >= 3 &&
                               (plan->rules.scatters & (AUR_SCATTERS_DIFFUSE | AUR_SCATTERS_GLOSSY)) != 0;
    if (result == AUR_OK)
        result = aur_gather_light_create(p, context, plan->classes, wants_photons, &plan->light, error);
    plan->counts_emitters = policy->direct == AUR_DIRECT_GATHER ||
                            (p->incident == AUR_INCIDENT_EMITTERS && policy->direct == AUR_DIRECT_NONE);
    plan->gathers = plan->light.map != NULL ||
                    (policy->max_depth >= 2 && (plan->counts_emitters || policy->direct == AUR_DIRECT_NEE));
    return result;
}

aur_result aur_gather_plan_create(const aur_gather_parameters *p, const aur_gather_rule_options *pattern,
                                  const aur_integrator_context *context, aur_gather_plan **plan,
                                  aur_error *error) {
    *plan = calloc(1, sizeof **plan);
    if (*plan == NULL)
        return aur_fail_memory(error);
    (*plan)->scene = context->scene;
    (*plan)->policy = policy_of(p, pattern, context);
    const aur_result result = compile(*plan, p, pattern, context, error);
    if (result != AUR_OK) {
        aur_gather_plan_destroy(*plan);
        *plan = NULL;
    }
    return result;
}

void aur_gather_plan_destroy(aur_gather_plan *plan) {
    if (plan == NULL)
        return;
    aur_gather_rules_release(&plan->rules);
    aur_gather_light_release(&plan->light);
    free(plan->classes);
    free(plan);
}
