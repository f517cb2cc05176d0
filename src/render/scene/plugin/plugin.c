#include "render/scene/plugin/plugin.h"

#include <stdlib.h>
#include <string.h>

/* A zeroed structure with its descriptor and its data, or NULL. */
static void *allocate(const aur_plugin_kind *kind, const aur_row *row) {
    char *const created = calloc(1, kind->size);
    size_t size = 0;
    if (created == NULL)
        return NULL;
    memcpy(created, &row, sizeof row);
    if (kind->data_size == 0)
        return created;
    memcpy(&size, (const char *)row + kind->data_size, sizeof size);
    void *const data = calloc(1, size + 1);
    memcpy(created + kind->data, &data, sizeof data);
    if (data != NULL)
        return created;
    free(created);
    return NULL;
}

aur_result aur_plugin_create(const aur_plugin_kind *kind, aur_parameters *parameters, const void *context,
                             void *object, aur_error *error) {
    const aur_row *row;
    void *const none = NULL;
    memcpy(object, &none, sizeof none);
    const aur_result result = aur_table_find(kind->table, parameters, &row, error);
    return result == AUR_OK ? aur_plugin_create_row(kind, row, parameters, context, object, error) : result;
}

aur_result aur_plugin_create_row(const aur_plugin_kind *kind, const aur_row *row, aur_parameters *parameters,
                                 const void *context, void *object, aur_error *error) {
    void *created = allocate(kind, row);
    aur_result result = created != NULL ? kind->fill(parameters, created, context, error)
                                        : aur_fail_memory_at(error, parameters->location);
    if (result == AUR_OK)
        result = aur_parameters_finish(parameters, error);
    if (result != AUR_OK) {
        aur_plugin_destroy(kind, created);
        created = NULL;
    }
    memcpy(object, &created, sizeof created);
    return result;
}

void aur_plugin_destroy(const aur_plugin_kind *kind, void *object) {
    const char *row;
    void *data = NULL;
    void (*release)(void *data) = NULL;
    if (object == NULL)
        return;
    if (kind->release != NULL)
        kind->release(object);
    memcpy(&row, object, sizeof row);
    if (kind->data_size != 0)
        memcpy(&data, (char *)object + kind->data, sizeof data);
    if (kind->data_release != 0)
        memcpy(&release, row + kind->data_release, sizeof release);
    if (release != NULL)
        release(data);
    free(data);
    free(object);
}
