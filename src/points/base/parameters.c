#include "points/base/parameters.h"

#include <stdlib.h>
#include <string.h>

#include "points/base/array.h"
#include "points/base/names.h"
#include "points/base/text.h"

aur_result aur_parameters_init(aur_parameters *parameters, const char *kind, const char *plugin,
                               aur_location location, aur_error *error) {
    *parameters = (aur_parameters){.location = location};
    parameters->kind = strdup(kind);
    parameters->plugin = strdup(plugin);
    if (parameters->kind != NULL && parameters->plugin != NULL)
        return AUR_OK;
    aur_parameters_release(parameters);
    return aur_fail_memory(error);
}

void aur_parameters_release(aur_parameters *parameters) {
    for (size_t i = 0; i < parameters->count; ++i) {
        free(parameters->items[i].name);
        free(parameters->items[i].text);
    }
    free(parameters->items);
    free(parameters->kind);
    free(parameters->plugin);
    *parameters = (aur_parameters){0};
}

static aur_result add(aur_parameters *parameters, aur_parameter item, const char *name, const char *text,
                      aur_error *error) {
    for (size_t i = 0; i < parameters->count; ++i) {
        if (strcmp(parameters->items[i].name, name) != 0)
            continue;
        char first[48] = "";
        const size_t line = parameters->items[i].location.line;
        if (line > 0)
            snprintf(first, sizeof first, ", first in line %zu", line);
        return aur_fail_at(error, item.location, AUR_ERROR_FORMAT, "%s '%s': '%s' is given twice%s",
                           parameters->kind, parameters->plugin, name, first);
    }
    if (!aur_array_reserve(&parameters->items, &parameters->capacity, parameters->count + 1,
                           sizeof *parameters->items))
        return aur_fail_memory(error);
    item.name = strdup(name);
    item.text = text != NULL ? strdup(text) : NULL;
    if (item.name == NULL || (text != NULL && item.text == NULL)) {
        free(item.name);
        free(item.text);
        return aur_fail_memory(error);
    }
    parameters->items[parameters->count++] = item;
    return AUR_OK;
}

aur_result aur_parameters_add_text(aur_parameters *parameters, aur_parameter_kind kind, const char *name,
                                   const char *text, aur_location location, aur_error *error) {
    return add(parameters, (aur_parameter){.kind = kind, .location = location}, name, text, error);
}

aur_result aur_parameters_add_transform(aur_parameters *parameters, const char *name,
                                        const double transform[16], aur_location location, aur_error *error) {
    aur_parameter item = {.kind = AUR_PARAMETER_TRANSFORM, .location = location};
    memcpy(item.transform, transform, sizeof item.transform);
    return add(parameters, item, name, NULL, error);
}

aur_result aur_parameters_add_object(aur_parameters *parameters, const char *name, const char *object_kind,
                                     const void *object, aur_location location, aur_error *error) {
    const aur_parameter item = {
        .kind = AUR_PARAMETER_OBJECT, .location = location, .object = object, .object_kind = object_kind};
    return add(parameters, item, name, NULL, error);
}

aur_result aur_parameters_copy(const aur_parameters *parameters, aur_parameters *copy, aur_error *error) {
    aur_result result =
        aur_parameters_init(copy, parameters->kind, parameters->plugin, parameters->location, error);
    for (size_t i = 0; i < parameters->count && result == AUR_OK; ++i) {
        aur_parameter item = parameters->items[i];
        item.used = false;
        result = add(copy, item, item.name, item.text, error);
    }
    if (result != AUR_OK)
        aur_parameters_release(copy);
    return result;
}

/* The comma that ends a key=value, or NULL; commas in parentheses do not count. */
static char *end_of_piece(char *text) {
    size_t depth = 0;
    for (; *text != '\0'; ++text) {
        if (*text == '(')
            ++depth;
        else if (*text == ')' && depth > 0)
            --depth;
        else if (*text == ',' && depth == 0)
            return text;
    }
    return NULL;
}

/* Removes the parentheses of "(...)"; other texts are unchanged. */
static char *without_parentheses(char *value) {
    const size_t length = strlen(value);
    if (length < 2 || value[0] != '(' || value[length - 1] != ')')
        return value;
    value[length - 1] = '\0';
    return value + 1;
}

aur_result aur_parameters_parse(aur_parameters *parameters, const char *kind, const char *text,
                                aur_error *error) {
    *parameters = (aur_parameters){0};
    char *const copy = strdup(text);
    if (copy == NULL)
        return aur_fail_memory(error);
    char *rest = strchr(copy, ':');
    if (rest != NULL)
        *rest++ = '\0';
    aur_result result = aur_parameters_init(parameters, kind, copy, (aur_location){0}, error);
    while (result == AUR_OK && rest != NULL) {
        char *const next = end_of_piece(rest);
        if (next != NULL)
            *next = '\0';
        char *const value = strchr(rest, '=');
        if (value == NULL || value == rest) {
            result = aur_fail(error, AUR_ERROR_FORMAT, "%s '%s': '%s' is not of the form key=value", kind,
                              copy, rest);
            break;
        }
        *value = '\0';
        result = aur_parameters_add_text(parameters, AUR_PARAMETER_TEXT, rest, without_parentheses(value + 1),
                                         (aur_location){0}, error);
        rest = next != NULL ? next + 1 : NULL;
    }
    free(copy);
    if (result != AUR_OK)
        aur_parameters_release(parameters);
    return result;
}

const aur_parameter *aur_parameters_find(aur_parameters *parameters, const char *name) {
    const aur_names accepted = aur_names_of(parameters->accepted_count, parameters->accepted);
    if (aur_names_find(accepted, name) == accepted.count && accepted.count < AUR_PARAMETERS_NAMES_CAPACITY)
        parameters->accepted[parameters->accepted_count++] = name;
    for (size_t i = 0; i < parameters->count; ++i) {
        if (strcmp(parameters->items[i].name, name) == 0) {
            parameters->items[i].used = true;
            return parameters->items[i].left_out ? NULL : &parameters->items[i];
        }
    }
    return NULL;
}

void aur_parameters_leave_out(aur_parameters *parameters, const char *name, const char *text) {
    for (size_t i = 0; i < parameters->count; ++i) {
        aur_parameter *const item = &parameters->items[i];
        if (item->text != NULL && strcmp(item->name, name) == 0 && strcmp(item->text, text) == 0)
            item->left_out = true;
    }
}

aur_result aur_parameters_fail(const aur_parameters *parameters, aur_error *error, aur_result result,
                               const char *format, ...) {
    char text[AUR_ERROR_MESSAGE_CAPACITY];
    va_list arguments;
    va_start(arguments, format);
    aur_format_list(text, sizeof text, format, arguments);
    va_end(arguments);
    return aur_fail_at(error, parameters->location, result, "%s '%s': %s", parameters->kind,
                       parameters->plugin, text);
}

aur_result aur_parameters_fail_value(const aur_parameters *parameters, const aur_parameter *item,
                                     const char *expected, aur_error *error) {
    return aur_fail_at(error, item->location, AUR_ERROR_FORMAT, "%s '%s': '%s' must be %s, not '%s'",
                       parameters->kind, parameters->plugin, item->name, expected,
                       item->text != NULL                      ? item->text
                       : item->kind == AUR_PARAMETER_TRANSFORM ? "a transform"
                       : item->object_kind != NULL             ? item->object_kind
                                                               : "an object");
}

aur_result aur_parameters_finish(const aur_parameters *parameters, aur_error *error) {
    for (size_t i = 0; i < parameters->count; ++i) {
        const aur_parameter *const item = &parameters->items[i];
        if (item->used)
            continue;
        aur_sorted_names sorted;
        const aur_names names = aur_names_by_distance(
            aur_names_of(parameters->accepted_count, parameters->accepted), item->name, &sorted);
        char help[AUR_ERROR_MESSAGE_CAPACITY];
        return aur_fail_at(error, item->location, AUR_ERROR_NAME, "%s '%s' has no '%s'%s", parameters->kind,
                           parameters->plugin, item->name,
                           names.count > 0 ? aur_names_suggest(names, item->name, "it has", help)
                                           : ": it takes no parameters");
    }
    return AUR_OK;
}
