#include "core/parameters.h"

#include <ctype.h>
#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "core/array.h"
#include "core/names.h"
#include "core/text.h"

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
        const size_t line = parameters->items[i].location.line;
        if (line == 0)
            return aur_fail_at(error, item.location, AUR_ERROR_FORMAT, "%s '%s': '%s' is given twice",
                               parameters->kind, parameters->plugin, name);
        return aur_fail_at(error, item.location, AUR_ERROR_FORMAT,
                           "%s '%s': '%s' is given twice, first in line %zu", parameters->kind,
                           parameters->plugin, name, line);
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

/* "(...)" is what stands between; anything else is itself. */
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
    if (parameters->known_count < AUR_PARAMETERS_KNOWN_CAPACITY)
        parameters->known[parameters->known_count++] = name;
    for (size_t i = 0; i < parameters->count; ++i) {
        if (strcmp(parameters->items[i].name, name) == 0) {
            parameters->items[i].used = true;
            return &parameters->items[i];
        }
    }
    return NULL;
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

static aur_result fail_range(aur_error *error, const aur_parameters *parameters, const aur_parameter *item,
                             double minimum, double maximum) {
    char expected[128];
    if (isinf(maximum))
        aur_format(expected, sizeof expected, "at least %g", minimum);
    else if (isinf(minimum))
        aur_format(expected, sizeof expected, "at most %g", maximum);
    else
        aur_format(expected, sizeof expected, "between %g and %g", minimum, maximum);
    return aur_parameters_fail_value(parameters, item, expected, error);
}

/* Whether a value of this kind may be read as `wanted`: text may be anything, an integer may be a float. */
static bool kind_fits(const aur_parameter *item, aur_parameter_kind wanted) {
    return item->kind == wanted || item->kind == AUR_PARAMETER_TEXT ||
           (wanted == AUR_PARAMETER_FLOAT && item->kind == AUR_PARAMETER_INTEGER);
}

aur_result aur_parameters_float(aur_parameters *parameters, const char *name, double minimum, double maximum,
                                double *value, aur_error *error) {
    const aur_parameter *const item = aur_parameters_find(parameters, name);
    if (item == NULL)
        return AUR_OK;
    double parsed;
    if (!kind_fits(item, AUR_PARAMETER_FLOAT) || !aur_parse_double(item->text, &parsed))
        return aur_parameters_fail_value(parameters, item, "a number", error);
    if (parsed < minimum || parsed > maximum)
        return fail_range(error, parameters, item, minimum, maximum);
    *value = parsed;
    return AUR_OK;
}

aur_result aur_parameters_integer(aur_parameters *parameters, const char *name, int64_t minimum,
                                  int64_t maximum, int64_t *value, aur_error *error) {
    const aur_parameter *const item = aur_parameters_find(parameters, name);
    if (item == NULL)
        return AUR_OK;
    if (!kind_fits(item, AUR_PARAMETER_INTEGER))
        return aur_parameters_fail_value(parameters, item, "an integer", error);
    char *end;
    errno = 0;
    const long long parsed = strtoll(item->text, &end, 10);
    const bool overflow = errno == ERANGE;
    while (isspace((unsigned char)*end))
        ++end;
    if (end == item->text || *end != '\0')
        return aur_parameters_fail_value(parameters, item, "an integer", error);
    if (overflow || parsed < minimum || parsed > maximum) {
        char expected[96];
        if (maximum == INT64_MAX)
            snprintf(expected, sizeof expected, "at least %" PRId64, minimum);
        else
            snprintf(expected, sizeof expected, "between %" PRId64 " and %" PRId64, minimum, maximum);
        return aur_parameters_fail_value(parameters, item, expected, error);
    }
    *value = parsed;
    return AUR_OK;
}

aur_result aur_parameters_boolean(aur_parameters *parameters, const char *name, bool *value,
                                  aur_error *error) {
    const aur_parameter *const item = aur_parameters_find(parameters, name);
    if (item == NULL)
        return AUR_OK;
    if (kind_fits(item, AUR_PARAMETER_BOOLEAN) && strcasecmp(item->text, "true") == 0)
        *value = true;
    else if (kind_fits(item, AUR_PARAMETER_BOOLEAN) && strcasecmp(item->text, "false") == 0)
        *value = false;
    else
        return aur_parameters_fail_value(parameters, item, "true or false", error);
    return AUR_OK;
}

aur_result aur_parameters_string(aur_parameters *parameters, const char *name, const char **value,
                                 aur_error *error) {
    const aur_parameter *const item = aur_parameters_find(parameters, name);
    if (item == NULL)
        return AUR_OK;
    if (!kind_fits(item, AUR_PARAMETER_STRING))
        return aur_parameters_fail_value(parameters, item, "a string", error);
    *value = item->text;
    return AUR_OK;
}

aur_result aur_parameters_choice(aur_parameters *parameters, const char *name, size_t count,
                                 const char *const *choices, size_t *value, aur_error *error) {
    const aur_parameter *const item = aur_parameters_find(parameters, name);
    if (item == NULL)
        return AUR_OK;
    const aur_names names = aur_names_of(count, choices);
    const size_t found = kind_fits(item, AUR_PARAMETER_STRING) ? aur_names_find(names, item->text) : count;
    if (found < count) {
        *value = found;
        return AUR_OK;
    }
    char expected[AUR_ERROR_MESSAGE_CAPACITY] = "one of ";
    aur_names_list(names, expected + strlen(expected), sizeof expected - strlen(expected));
    return aur_parameters_fail_value(parameters, item, expected, error);
}

aur_result aur_parameters_triple(aur_parameters *parameters, const char *name, double minimum, double maximum,
                                 double value[3], aur_error *error) {
    const aur_parameter *const item = aur_parameters_find(parameters, name);
    if (item == NULL)
        return AUR_OK;
    double parsed[3];
    const bool fits = kind_fits(item, AUR_PARAMETER_VECTOR) || kind_fits(item, AUR_PARAMETER_COLOR) ||
                      kind_fits(item, AUR_PARAMETER_FLOAT);
    const size_t count = fits ? aur_parse_doubles(item->text, parsed, 3) : 0;
    if (count == 1)
        parsed[2] = parsed[1] = parsed[0];
    else if (count != 3)
        return aur_parameters_fail_value(parameters, item, "one or three numbers", error);
    for (size_t i = 0; i < 3; ++i)
        if (parsed[i] < minimum || parsed[i] > maximum)
            return fail_range(error, parameters, item, minimum, maximum);
    memcpy(value, parsed, sizeof parsed);
    return AUR_OK;
}

aur_result aur_parameters_transform(aur_parameters *parameters, const char *name, double value[16],
                                    aur_error *error) {
    const aur_parameter *const item = aur_parameters_find(parameters, name);
    if (item == NULL)
        return AUR_OK;
    if (item->kind != AUR_PARAMETER_TRANSFORM)
        return aur_parameters_fail_value(parameters, item, "a transform", error);
    memcpy(value, item->transform, sizeof item->transform);
    return AUR_OK;
}

aur_result aur_fail_unknown_plugin(aur_error *error, const aur_parameters *parameters, size_t count,
                                   const char *const *names) {
    size_t index;
    return aur_names_choose(aur_names_of(count, names), parameters->kind, parameters->plugin,
                            parameters->location, &index, error);
}

aur_result aur_parameters_finish(const aur_parameters *parameters, aur_error *error) {
    for (size_t i = 0; i < parameters->count; ++i) {
        const aur_parameter *const item = &parameters->items[i];
        if (item->used)
            continue;
        const aur_names names = aur_names_of(parameters->known_count, parameters->known);
        const char *const nearest = aur_names_nearest(names, item->name);
        if (nearest != NULL)
            return aur_fail_at(error, item->location, AUR_ERROR_NAME,
                               "%s '%s' has no '%s'; did you mean '%s'?", parameters->kind,
                               parameters->plugin, item->name, nearest);
        char known[AUR_ERROR_MESSAGE_CAPACITY];
        aur_names_list(names, known, sizeof known);
        if (known[0] == '\0')
            return aur_fail_at(error, item->location, AUR_ERROR_NAME,
                               "%s '%s' has no '%s': it takes no parameters", parameters->kind,
                               parameters->plugin, item->name);
        return aur_fail_at(error, item->location, AUR_ERROR_NAME, "%s '%s' has no '%s'; it has: %s",
                           parameters->kind, parameters->plugin, item->name, known);
    }
    return AUR_OK;
}
