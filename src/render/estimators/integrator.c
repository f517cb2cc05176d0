/* The table of integrators: a new one is one file, which defines aur_integrator_<name>, and one line here. */
#include "render/film/integrator.h"

#include <stdlib.h>
#include <string.h>

#include "points/base/error.h"

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

/* The row that the parameters name, of the table or the caller's. */
static aur_result find(const aur_parameters *parameters, const aur_gather_integrator *gather,
                       const aur_row **row, aur_error *error) {
    enum { COUNT = sizeof rows / sizeof rows[0] };
    const aur_row *all[COUNT + 1] = {[COUNT] = gather != NULL ? &gather->row : NULL};
    memcpy(all, rows, sizeof rows);
    const aur_table table = {
        .kind = aur_integrator_table.kind, .count = gather != NULL ? COUNT + 1 : COUNT, .rows = all};
    for (size_t i = 0; gather != NULL && i < gather->row.key_count; ++i)
        if (gather->row.keys[i].offset + gather->row.keys[i].size > sizeof(aur_gather_options))
            return aur_fail(error, AUR_ERROR_ARGUMENT,
                            "integrator '%s': '%s' is no field of aur_gather_options", gather->row.name,
                            gather->row.keys[i].name);
    return aur_table_find(&table, parameters, row, error);
}

static aur_result refuse_moved(const aur_moved_key *moved, const aur_parameters *parameters,
                               aur_error *error) {
    for (; moved != NULL && moved->name != NULL; ++moved)
        for (size_t i = 0; i < parameters->count; ++i)
            if (strcmp(parameters->items[i].name, moved->name) == 0)
                return aur_fail_at(error, parameters->items[i].location, AUR_ERROR_NAME,
                                   "integrator '%s' has no '%s' any more: %s", parameters->plugin,
                                   moved->name, moved->where);
    return AUR_OK;
}

/* An integrator whose keys have been read. */
static aur_result begin(aur_parameters *parameters, const aur_gather_integrator *gather, aur_integrator **out,
                        aur_error *error) {
    *out = NULL;
    const aur_row *row;
    aur_result result = find(parameters, gather, &row, error);
    if (result != AUR_OK)
        return result;
    const bool is_callers = gather != NULL && row == &gather->row;
    const aur_integrator_descriptor *const descriptor =
        is_callers ? &aur_integrator_final_gather : (const aur_integrator_descriptor *)row;
    result = is_callers ? AUR_OK : refuse_moved(descriptor->moved, parameters, error);
    if (result != AUR_OK)
        return result;
    aur_integrator *const integrator = calloc(1, sizeof *integrator);
    if (integrator == NULL)
        return aur_fail_memory(error);
    integrator->descriptor = descriptor;
    integrator->data = calloc(1, descriptor->size + 1);
    if (integrator->data != NULL && descriptor->initial != NULL)
        memcpy(integrator->data, descriptor->initial, descriptor->size);
    result = integrator->data != NULL ? AUR_OK : aur_fail_memory(error);
    if (result == AUR_OK && is_callers)
        result = aur_keys_read(descriptor->row.key_count, descriptor->row.keys, parameters, integrator->data,
                               error);
    if (result == AUR_OK)
        result = aur_row_read(row, parameters, integrator->data, error);
    if (result == AUR_OK)
        *out = integrator;
    else
        aur_integrator_destroy(integrator);
    return result;
}

aur_result aur_integrator_create(aur_parameters *parameters, const aur_integrator_context *context,
                                 aur_integrator **out, aur_error *error) {
    aur_result result = begin(parameters, context->gather, out, error);
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

aur_result aur_integrator_check(aur_parameters *parameters, const aur_gather_integrator *gather,
                                aur_error *error) {
    aur_integrator *integrator;
    const aur_result result = begin(parameters, gather, &integrator, error);
    aur_integrator_destroy(integrator);
    return result;
}
