#include "render/scene/importers/nodes/node.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/array.h"
#include "points/base/names.h"

/* Limits growth: a few kilobytes of <default>s that double each other must not make an endless scene. */
enum { MOST_SUBSTITUTED = 1 << 26 };

static aur_xml_variable *find(const aur_xml_variables *variables, const char *name) {
    for (size_t i = 0; i < variables->count; ++i)
        if (strcmp(variables->items[i].name, name) == 0)
            return &variables->items[i];
    return NULL;
}

static aur_result add(aur_xml_variables *variables, const char *name, const char *value, bool defined,
                      aur_error *error) {
    const aur_xml_variable item = {.name = aur_arena_copy(variables->arena, name, strlen(name)),
                                   .value = aur_arena_copy(variables->arena, value, strlen(value)),
                                   .defined = defined};
    if (item.name == NULL || item.value == NULL ||
        !aur_array_reserve(&variables->items, &variables->capacity, variables->count + 1,
                           sizeof *variables->items))
        return aur_fail_memory(error);
    size_t at = variables->count++;
    for (; at > 0 && strlen(variables->items[at - 1].name) < strlen(name); --at)
        variables->items[at] = variables->items[at - 1];
    variables->items[at] = item;
    return AUR_OK;
}

aur_result aur_xml_variables_define(aur_xml_variables *variables, const aur_scene_options *options,
                                    aur_error *error) {
    for (size_t i = 0; i < options->definition_count; ++i) {
        const aur_definition *const definition = &options->definitions[i];
        if (definition->name[0] == '\0')
            return aur_fail(error, AUR_ERROR_ARGUMENT, "-D: a name is missing before '=%s'",
                            definition->value);
        if (find(variables, definition->name) != NULL)
            return aur_fail(error, AUR_ERROR_ARGUMENT, "-D: '%s' is given twice", definition->name);
        const aur_result result = add(variables, definition->name, definition->value, true, error);
        if (result != AUR_OK)
            return result;
    }
    return AUR_OK;
}

aur_result aur_xml_variables_default(aur_xml_variables *variables, const char *name, const char *value,
                                     aur_location location, aur_error *error) {
    if (name[0] == '\0')
        return aur_fail_at(error, location, AUR_ERROR_FORMAT, "<default>: the name is empty");
    aur_xml_variable *const existing = find(variables, name);
    if (existing == NULL)
        return add(variables, name, value, false, error);
    existing->used = true;
    return AUR_OK;
}

aur_result aur_xml_variables_get(aur_xml_variables *variables, const char *name, const char *otherwise,
                                 aur_location location, const char **value, aur_error *error) {
    const aur_result result = aur_xml_variables_default(variables, name, otherwise, location, error);
    aur_xml_variable *const variable = find(variables, name);
    if (result != AUR_OK)
        return result;
    variable->used = true;
    *value = variable->value;
    return AUR_OK;
}

/* The variable whose name is the longest prefix of `text`. */
static aur_xml_variable *match(const aur_xml_variables *variables, const char *text) {
    for (size_t i = 0; i < variables->count; ++i)
        if (strncmp(variables->items[i].name, text, strlen(variables->items[i].name)) == 0)
            return &variables->items[i];
    return NULL;
}

static const char *name_at(const void *items, size_t index) {
    return ((const aur_xml_variable *)items)[index].name;
}

static aur_result fail_undefined(const aur_xml_variables *variables, const char *text, aur_location location,
                                 aur_error *error) {
    char name[64], hint[AUR_HINT_CAPACITY];
    size_t length = 0;
    for (; length + 1 < sizeof name && (isalnum((unsigned char)text[length]) || text[length] == '_');
         ++length)
        name[length] = text[length];
    name[length] = '\0';
    aur_names_hint((aur_names){variables->count, name_at, variables->items}, name, "''", hint);
    if (hint[0] != '\0')
        return aur_fail_at(error, location, AUR_ERROR_NAME, "$%s is not defined%s", name, hint);
    return aur_fail_at(error, location, AUR_ERROR_NAME,
                       "$%s is not defined: give it a <default>, or a value by -D %s=...", name, name);
}

/* Writes the text with $names replaced to `out`, if not NULL, and its length to *length. */
static aur_result write_text(const aur_xml_variables *variables, const char *text, aur_location location,
                             char *out, size_t *length, aur_error *error) {
    const char *const start = text;
    for (*length = 0; *text != '\0';) {
        const char *piece = text;
        size_t size = strcspn(text, "$\\"), taken = size;
        if (text[0] == '$') {
            aur_xml_variable *const variable = match(variables, text + 1);
            if (variable == NULL)
                return fail_undefined(variables, text + 1, location, error);
            variable->used = true;
            piece = variable->value;
            size = strlen(piece);
            taken = 1 + strlen(variable->name);
        } else if (text[0] == '\\') {
            taken = text[1] == '$' ? 2 : 1;
            piece = &text[taken - 1];
            size = 1;
        }
        if (out != NULL)
            memcpy(out + *length, piece, size);
        *length += size;
        text += taken;
        if (*length > (size_t)(text - start) + MOST_SUBSTITUTED - variables->substituted_bytes)
            return aur_fail_at(error, location, AUR_ERROR_FORMAT,
                               "the values of $names make the scene more than %d bytes longer",
                               MOST_SUBSTITUTED);
    }
    return AUR_OK;
}

aur_result aur_xml_variables_substitute(aur_xml_variables *variables, const char *text, aur_location location,
                                        char **result, aur_error *error) {
    size_t length;
    const aur_result status = write_text(variables, text, location, NULL, &length, error);
    if (status != AUR_OK)
        return status;
    *result = aur_arena_allocate(variables->arena, length + 1);
    if (*result == NULL)
        return aur_fail_memory(error);
    const size_t before = strlen(text);
    const aur_result written = write_text(variables, text, location, *result, &length, error);
    variables->substituted_bytes += length > before ? length - before : 0;
    return written;
}

aur_result aur_xml_variables_finish(const aur_xml_variables *variables, const char *file, aur_error *error) {
    for (size_t i = 0; i < variables->count; ++i) {
        const aur_xml_variable *const item = &variables->items[i];
        if (!item->defined || item->used)
            continue;
        const char **const used = malloc(variables->count * sizeof *used);
        size_t count = 0;
        for (size_t k = 0; used != NULL && k < variables->count; ++k)
            if (variables->items[k].used)
                used[count++] = variables->items[k].name;
        char hint[AUR_HINT_CAPACITY];
        aur_names_hint(aur_names_of(count, used), item->name, "''", hint);
        free(used);
        return aur_fail_at(error, (aur_location){.file = file}, AUR_ERROR_NAME,
                           "-D %s=...: the scene has no $%s%s", item->name, item->name, hint);
    }
    return AUR_OK;
}
