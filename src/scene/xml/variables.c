#include "scene/xml/variables.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#include "core/array.h"
#include "core/names.h"

#include "core/text.h"

static aur_xml_variable *find(const aur_xml_variables *variables, const char *name) {
    for (size_t i = 0; i < variables->count; ++i)
        if (strcmp(variables->items[i].name, name) == 0)
            return &variables->items[i];
    return NULL;
}

static aur_result add(aur_xml_variables *variables, const char *name, const char *value, bool defined,
                      aur_location location, aur_error *error) {
    if (!aur_array_reserve(&variables->items, &variables->capacity, variables->count + 1,
                           sizeof *variables->items))
        return aur_fail_memory(error);
    const aur_xml_variable item = {strdup(name), strdup(value), false, defined};
    if (item.name == NULL || item.value == NULL) {
        free(item.name);
        free(item.value);
        return aur_fail_memory_at(error, location);
    }
    size_t place = variables->count++;
    for (; place > 0 && strlen(variables->items[place - 1].name) < strlen(name); --place)
        variables->items[place] = variables->items[place - 1];
    variables->items[place] = item;
    return AUR_OK;
}

aur_result aur_xml_variables_init(aur_xml_variables *variables, const aur_scene_options *options,
                                  aur_error *error) {
    *variables = (aur_xml_variables){0};
    for (size_t i = 0; options != NULL && i < options->definition_count; ++i) {
        const aur_definition *const definition = &options->definitions[i];
        aur_result result = AUR_OK;
        if (definition->name[0] == '\0')
            result =
                aur_fail(error, AUR_ERROR_ARGUMENT, "-D: a name is missing before '=%s'", definition->value);
        else if (find(variables, definition->name) != NULL)
            result = aur_fail(error, AUR_ERROR_ARGUMENT, "-D: '%s' is given twice", definition->name);
        else
            result = add(variables, definition->name, definition->value, true, (aur_location){0}, error);
        if (result != AUR_OK) {
            aur_xml_variables_release(variables);
            return result;
        }
    }
    return AUR_OK;
}

void aur_xml_variables_release(aur_xml_variables *variables) {
    for (size_t i = 0; i < variables->count; ++i) {
        free(variables->items[i].name);
        free(variables->items[i].value);
    }
    free(variables->items);
    *variables = (aur_xml_variables){0};
}

aur_result aur_xml_variables_default(aur_xml_variables *variables, const char *name, const char *value,
                                     aur_location location, aur_error *error) {
    if (name[0] == '\0')
        return aur_fail_at(error, location, AUR_ERROR_FORMAT, "<default>: the name is empty");
    aur_xml_variable *const known = find(variables, name);
    if (known == NULL)
        return add(variables, name, value, false, location, error);
    known->used = true;
    return AUR_OK;
}

/* The variable whose name `text` begins with. */
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
    char name[64];
    size_t length = 0;
    while (length + 1 < sizeof name && (isalnum((unsigned char)text[length]) || text[length] == '_')) {
        name[length] = text[length];
        ++length;
    }
    name[length] = '\0';
    const char *const nearest =
        aur_names_nearest((aur_names){variables->count, name_at, variables->items}, name);
    if (nearest != NULL)
        return aur_fail_at(error, location, AUR_ERROR_NAME, "$%s is not defined; did you mean '$%s'?", name,
                           nearest);
    return aur_fail_at(error, location, AUR_ERROR_NAME,
                       "$%s is not defined: give it a <default>, or a value by -D %s=...", name, name);
}

typedef struct text_buffer {
    char *text;
    size_t length, capacity;
} text_buffer;

static bool append(text_buffer *buffer, const char *text, size_t length) {
    if (!aur_array_reserve(&buffer->text, &buffer->capacity, buffer->length + length + 1, 1))
        return false;
    memcpy(buffer->text + buffer->length, text, length);
    buffer->length += length;
    buffer->text[buffer->length] = '\0';
    return true;
}

enum { LONGEST_VALUE = 1 << 24 };

aur_result aur_xml_variables_substitute(aur_xml_variables *variables, const char *text, aur_location location,
                                        char **result, aur_error *error) {
    text_buffer buffer = {0};
    aur_result status = AUR_OK;
    bool enough = append(&buffer, "", 0);
    while (enough && status == AUR_OK && *text != '\0') {
        const size_t plain = strcspn(text, "$\\");
        enough = append(&buffer, text, plain);
        text += plain;
        if (text[0] == '\\' && text[1] == '$') {
            enough = enough && append(&buffer, "$", 1);
            text += 2;
        } else if (text[0] == '\\') {
            enough = enough && append(&buffer, "\\", 1);
            ++text;
        } else if (text[0] == '$') {
            aur_xml_variable *const variable = match(variables, text + 1);
            if (variable == NULL) {
                status = fail_undefined(variables, text + 1, location, error);
                break;
            }
            variable->used = true;
            enough = enough && append(&buffer, variable->value, strlen(variable->value));
            text += 1 + strlen(variable->name);
        }
        if (buffer.length > LONGEST_VALUE)
            status = aur_fail_at(error, location, AUR_ERROR_FORMAT, "a value is longer than %d bytes",
                                 LONGEST_VALUE);
    }
    if (!enough)
        status = aur_fail_memory_at(error, location);
    if (status != AUR_OK) {
        free(buffer.text);
        return status;
    }
    *result = buffer.text;
    return AUR_OK;
}

aur_result aur_xml_variables_finish(const aur_xml_variables *variables, const char *file, aur_error *error) {
    for (size_t i = 0; i < variables->count; ++i) {
        const aur_xml_variable *const item = &variables->items[i];
        if (!item->defined || item->used)
            continue;
        const aur_location location = {.file = file};
        const char **const names = malloc(variables->count * sizeof *names);
        size_t count = 0;
        for (size_t k = 0; names != NULL && k < variables->count; ++k)
            if (variables->items[k].used)
                names[count++] = variables->items[k].name;
        const char *const nearest = names != NULL ? aur_nearest_name(item->name, count, names) : NULL;
        aur_result result;
        if (nearest != NULL)
            result = aur_fail_at(error, location, AUR_ERROR_NAME,
                                 "-D %s=...: the scene has no $%s; did you mean '%s'?", item->name,
                                 item->name, nearest);
        else
            result = aur_fail_at(error, location, AUR_ERROR_NAME, "-D %s=...: the scene has no $%s",
                                 item->name, item->name);
        free(names);
        return result;
    }
    return AUR_OK;
}
