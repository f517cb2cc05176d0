/* The table of integrators: a new one is one file, which defines aur_integrator_<name>, and one line here. */
#include "render/film/integrator.h"

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/error.h"
#include "render/scene/load/loader.h"
#include "render/scene/plugin/plugin.h"

#define INTEGRATORS(ROW)                                                                                     \
    ROW(path)                                                                                                \
    ROW(volpath)                                                                                             \
    ROW(volpathmis)                                                                                          \
    ROW(final_gather)                                                                                        \
    ROW(ambient_occlusion)                                                                                   \
    ROW(ptracer)                                                                                             \
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
    .summary = "methods of light transport",
    AUR_TABLE_ROWS(rows),
};

/* The row that the parameters name, of the table or the caller's. */
static aur_result find(const aur_parameters *parameters, const aur_gather_integrator *gather,
                       const aur_row **row, aur_error *error) {
    enum { COUNT = sizeof rows / sizeof rows[0] };
    if (gather != NULL && gather->size != sizeof *gather)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "aur_gather_integrator: 'size' is %zu, not %zu",
                        gather->size, sizeof *gather);
    const aur_row *all[COUNT + 1] = {[COUNT] = gather != NULL ? &gather->row : NULL};
    memcpy(all, rows, sizeof rows);
    const aur_table table = {
        .kind = aur_integrator_table.kind, .count = gather != NULL ? COUNT + 1 : COUNT, .rows = all};
    const aur_result refused = aur_parameters_refuse(parameters, error);
    return refused != AUR_OK ? refused : aur_table_find(&table, parameters, row, error);
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

/* An integrator may contain only one other. */
static aur_result refuse_second(const aur_parameters *parameters, aur_error *error) {
    for (size_t i = 0; i < parameters->count; ++i)
        if (strcmp(parameters->items[i].name, "integrator2") == 0)
            return aur_fail_at(error, parameters->items[i].location, AUR_ERROR_UNSUPPORTED,
                               "a second <integrator> inside another: one is the most");
    return AUR_OK;
}

/* What an integrator is filled from. */
typedef struct source {
    const aur_gather_integrator *gather;   /* if supplied by the caller; else NULL */
    const aur_integrator_context *context; /* NULL: the keys are only read */
} source;

/* Options of the caller's, with what they begin with. Keys beyond them are refused: they would be written
 * there. */
static aur_result make_options(const aur_gather_integrator *gather, aur_integrator *integrator,
                               aur_error *error) {
    const size_t least = integrator->descriptor->size;
    const size_t size = gather->settings_size > least ? gather->settings_size : least;
    for (size_t i = 0; i < gather->row.key_count; ++i)
        if (gather->row.keys[i].offset + gather->row.keys[i].size > size)
            return aur_fail(error, AUR_ERROR_ARGUMENT, "integrator '%s': unknown field '%s' of its settings",
                            gather->row.name, gather->row.keys[i].name);
    integrator->gather = gather;
    free(integrator->data);
    integrator->data = calloc(1, size);
    if (integrator->data == NULL)
        return aur_fail_memory(error);
    if (size > least && gather->initial != NULL)
        memcpy(integrator->data, gather->initial, size);
    return AUR_OK;
}

static aur_result fill(aur_parameters *parameters, void *object, const void *context, aur_error *error) {
    const source *const from = context;
    aur_integrator *const integrator = object;
    const aur_integrator_descriptor *const descriptor = integrator->descriptor;
    aur_result result = from->gather != NULL ? make_options(from->gather, integrator, error) : AUR_OK;
    if (result == AUR_OK && descriptor->initial != NULL)
        memcpy(integrator->data, descriptor->initial, descriptor->size);
    if (result == AUR_OK && from->gather != NULL)
        result = aur_keys_read(descriptor->row.key_count, descriptor->row.keys, parameters, integrator->data,
                               error);
    if (result == AUR_OK)
        result = aur_row_read(from->gather != NULL ? &from->gather->row : &descriptor->row, parameters,
                              integrator->data, error);
    if (result != AUR_OK || from->context == NULL)
        return result;
    aur_integrator_context local = *from->context;
    local.create = aur_integrator_create;
    integrator->scene = local.scene;
    return descriptor->create != NULL ? descriptor->create(parameters, &local, integrator, error) : AUR_OK;
}

static const aur_plugin_kind kind = {.table = &aur_integrator_table,
                                     .size = sizeof(aur_integrator),
                                     .data = offsetof(aur_integrator, data),
                                     .data_size = offsetof(aur_integrator_descriptor, size),
                                     .fill = fill,
                                     .release = aur_integrator_release};

static aur_result create(aur_parameters *parameters, const aur_gather_integrator *gather,
                         const aur_integrator_context *context, aur_integrator **integrator,
                         aur_error *error) {
    source from = {.context = context};
    const aur_row *row;
    *integrator = NULL;
    aur_result result = find(parameters, gather, &row, error);
    if (result != AUR_OK)
        return result;
    result = refuse_second(parameters, error);
    if (result != AUR_OK)
        return result;
    if (gather != NULL && row == &gather->row) {
        from.gather = gather;
        row = &aur_integrator_final_gather.row;
    } else {
        result = refuse_moved(((const aur_integrator_descriptor *)row)->moved, parameters, error);
    }
    aur_parameters_ignore(parameters, row, context != NULL ? &context->warnings : NULL);
    return result == AUR_OK ? aur_plugin_create_row(&kind, row, parameters, &from, integrator, error)
                            : result;
}

aur_result aur_integrator_create(aur_parameters *parameters, const aur_integrator_context *context,
                                 aur_integrator **integrator, aur_error *error) {
    return create(parameters, context->gather, context, integrator, error);
}

aur_result aur_integrator_check(aur_parameters *parameters, const aur_gather_integrator *gather,
                                aur_error *error) {
    aur_integrator *integrator;
    const aur_result result = create(parameters, gather, NULL, &integrator, error);
    aur_integrator_destroy(integrator);
    return result;
}
