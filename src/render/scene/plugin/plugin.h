/* Objects that a scene names by type. Each kind has a table of descriptors; all kinds are created and
 * destroyed by the same steps. */
#pragma once

#include "points/base/keys.h"

/* A kind of object. Its structure begins with the address of its descriptor, which begins with an aur_row. */
typedef struct aur_plugin_kind {
    const aur_table *table; /* of descriptors */
    size_t size;            /* of the structure */
    /* Offsets of `data` in the structure, and in the descriptor of its `size` and of `release`, a void
     * (*)(void *data) that frees what the data point to, and may be NULL; 0: the kind has none. */
    size_t data, data_size, data_release;
    /* Reads the parameters into the zeroed structure and data, and completes them. `context` is that of
     * aur_plugin_create. */
    aur_result (*fill)(aur_parameters *parameters, void *object, const void *context, aur_error *error);
    /* Frees what else the structure points to, also after `fill` has failed; NULL: nothing. */
    void (*release)(void *object);
} aur_plugin_kind;

/* The kind of aur_<name> with data, a table aur_<name>_table of aur_<name>_descriptor, and `fill` in the
 * file. */
#define AUR_PLUGIN_KIND(name_)                                                                               \
    {                                                                                                        \
        .table = &aur_##name_##_table, .size = sizeof(aur_##name_), .data = offsetof(aur_##name_, data),     \
        .data_size = offsetof(aur_##name_##_descriptor, size),                                               \
        .data_release = offsetof(aur_##name_##_descriptor, release), .fill = fill                            \
    }

/* Finds the row for parameters->plugin, allocates, fills, and rejects unread parameters. `object` is the
 * address of the pointer, which is NULL after errors. Errors: NAME, MEMORY and those of `fill`, with the
 * location in the file. */
aur_result aur_plugin_create(const aur_plugin_kind *kind, aur_parameters *parameters, const void *context,
                             void *object, aur_error *error);
/* The same for a given row. */
aur_result aur_plugin_create_row(const aur_plugin_kind *kind, const aur_row *row, aur_parameters *parameters,
                                 const void *context, void *object, aur_error *error);
void aur_plugin_destroy(const aur_plugin_kind *kind, void *object); /* NULL is allowed */
