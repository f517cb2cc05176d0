/* The table of integrators: a new one is one file, which defines aur_integrator_<name>, and one line here. */
#include "render/film/integrator.h"

#include <stdlib.h>
#include <string.h>

#define INTEGRATORS(ROW)                                                                                     \
    ROW(path)                                                                                                \
    ROW(volpath)                                                                                             \
    ROW(volpathmis)                                                                                          \
    ROW(final_gather)                                                                                        \
    ROW(ambient_occlusion)                                                                                   \
    ROW(direct)                                                                                              \
    ROW(depth)                                                                                               \
    ROW(aov)                                                                                                 \
    ROW(radiosity)

#define DECLARE(name) extern const aur_integrator_descriptor aur_integrator_##name;
INTEGRATORS(DECLARE)

#define ADDRESS(name) &aur_integrator_##name.row,
static const aur_row *const rows[] = {INTEGRATORS(ADDRESS)};

const aur_table aur_integrator_table = {
    .kind = "integrator",
    .summary = "how the light that reaches the camera is found",
    AUR_TABLE_ROWS(rows),
};

/* An integrator whose keys have been read. */
static aur_result begin(aur_parameters *parameters, aur_integrator **out, aur_error *error) {
    *out = NULL;
    const aur_row *row;
    aur_result result = aur_table_find(&aur_integrator_table, parameters, &row, error);
    if (result != AUR_OK)
        return result;
    const aur_integrator_descriptor *const descriptor = (const aur_integrator_descriptor *)row;
    aur_integrator *const integrator = calloc(1, sizeof *integrator);
    if (integrator == NULL)
        return aur_fail_memory(error);
    integrator->descriptor = descriptor;
    integrator->data = calloc(1, descriptor->size + 1);
    if (integrator->data != NULL && descriptor->initial != NULL)
        memcpy(integrator->data, descriptor->initial, descriptor->size);
    result = integrator->data != NULL ? aur_row_read(row, parameters, integrator->data, error)
                                      : aur_fail_memory(error);
    if (result == AUR_OK)
        *out = integrator;
    else
        aur_integrator_destroy(integrator);
    return result;
}

aur_result aur_integrator_create(aur_parameters *parameters, const aur_integrator_context *context,
                                 aur_integrator **out, aur_error *error) {
    aur_result result = begin(parameters, out, error);
    if (result != AUR_OK)
        return result;
    (*out)->scene = context->scene;
    aur_integrator_context own = *context;
    own.create = aur_integrator_create;
    if ((*out)->descriptor->create != NULL)
        result = (*out)->descriptor->create(parameters, &own, *out, error);
    if (result != AUR_OK) {
        aur_integrator_destroy(*out);
        *out = NULL;
    }
    return result;
}

aur_result aur_integrator_check(aur_parameters *parameters, aur_error *error) {
    aur_integrator *integrator;
    const aur_result result = begin(parameters, &integrator, error);
    aur_integrator_destroy(integrator);
    return result;
}
