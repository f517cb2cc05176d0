/* The table of integrators: a new one is one file and one line here. */
#include "transport/integrator.h"

#include <stdlib.h>
#include <string.h>

extern const aur_integrator_descriptor aur_integrator_path;
extern const aur_integrator_descriptor aur_integrator_final_gather;
extern const aur_integrator_descriptor aur_integrator_ambient_occlusion;
extern const aur_integrator_descriptor aur_integrator_direct;
extern const aur_integrator_descriptor aur_integrator_depth;
extern const aur_integrator_descriptor aur_integrator_aov;
extern const aur_integrator_descriptor aur_integrator_radiosity;

/* A line an integrator. */
/* clang-format off */
static const aur_integrator_descriptor *const integrators[] = {
    &aur_integrator_path,
    &aur_integrator_final_gather,
    &aur_integrator_ambient_occlusion,
    &aur_integrator_direct,
    &aur_integrator_depth,
    &aur_integrator_aov,
    &aur_integrator_radiosity,
};
/* clang-format on */

enum { INTEGRATOR_COUNT = sizeof integrators / sizeof integrators[0] };

const aur_integrator_descriptor *aur_integrator_descriptor_at(size_t index) {
    return index < INTEGRATOR_COUNT ? integrators[index] : NULL;
}

aur_result aur_integrator_create(aur_parameters *parameters, const aur_integrator_context *context,
                                 aur_integrator **out, aur_error *error) {
    *out = NULL;
    const aur_integrator_descriptor *descriptor = NULL;
    const char *names[INTEGRATOR_COUNT];
    for (size_t i = 0; i < INTEGRATOR_COUNT; ++i) {
        names[i] = integrators[i]->description.name;
        if (strcmp(names[i], parameters->plugin) == 0)
            descriptor = integrators[i];
    }
    if (descriptor == NULL)
        return aur_fail_unknown_plugin(error, parameters, INTEGRATOR_COUNT, names);
    aur_integrator *const integrator = calloc(1, sizeof *integrator);
    if (integrator == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    integrator->descriptor = descriptor;
    integrator->scene = context->scene;
    aur_integrator_context own = *context;
    own.create = aur_integrator_create;
    const aur_result result = descriptor->create(parameters, &own, integrator, error);
    if (result != AUR_OK) {
        aur_integrator_destroy(integrator);
        return result;
    }
    *out = integrator;
    return AUR_OK;
}
