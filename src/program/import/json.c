#include "program/import/gltf.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/text.h"

enum { DEEPEST = 200 };

static char *skip(char *at) {
    return at + strspn(at, " \t\r\n");
}

/* Decodes a text after its opening quote in place and returns its end. \u escapes stay: names in glTF have
 * none. */
static char *read_text(char *at, const char **text) {
    char *out = at;
    *text = at;
    while (*at != '"') {
        if (*at == '\0' || (*at == '\\' && *++at == '\0'))
            return NULL;
        *out++ = *at++;
    }
    *out = '\0';
    return at + 1;
}

static char *read_value(char *at, size_t depth, json_value *value_out);

static bool index_items(json_value *array) {
    json_value **next = array->items = calloc(array->count, sizeof *array->items);
    for (json_value *item = array->first; array->items != NULL && item != NULL; item = item->next)
        *next++ = item;
    return array->items != NULL;
}

static char *read_list(char *at, size_t depth, json_value *value_out) {
    const char end = value_out->kind == JSON_OBJECT ? '}' : ']';
    json_value **link = &value_out->first;
    at = skip(at);
    if (*at == end)
        return at + 1;
    for (;;) {
        json_value *const value = *link = calloc(1, sizeof *value);
        if (value == NULL || (value_out->kind == JSON_OBJECT && *at != '"'))
            return NULL;
        if (value_out->kind == JSON_OBJECT) {
            at = read_text(at + 1, &value->name);
            at = at != NULL ? skip(at) : NULL;
            if (at == NULL || *at++ != ':')
                return NULL;
        }
        at = read_value(skip(at), depth + 1, value);
        at = at != NULL ? skip(at) : NULL;
        if (at == NULL || (*at != ',' && *at != end))
            return NULL;
        ++value_out->count;
        if (*at++ == end)
            return value_out->kind == JSON_OBJECT || index_items(value_out) ? at : NULL;
        link = &value->next;
        at = skip(at);
    }
}

static char *read_value(char *at, size_t depth, json_value *value_out) {
    static const struct {
        const char *word;
        json_kind kind;
        double number;
    } words[] = {{"null", JSON_NULL, 0.0}, {"true", JSON_BOOLEAN, 1.0}, {"false", JSON_BOOLEAN, 0.0}};
    if (depth > DEEPEST)
        return NULL;
    value_out->source = at;
    if (*at == '{' || *at == '[') {
        value_out->kind = *at == '{' ? JSON_OBJECT : JSON_ARRAY;
        return read_list(at + 1, depth, value_out);
    }
    if (*at == '"') {
        const char *text;
        value_out->kind = JSON_TEXT;
        at = read_text(at + 1, &text);
        value_out->text = text;
        return at;
    }
    for (size_t i = 0; i < sizeof words / sizeof words[0]; ++i)
        if (strncmp(at, words[i].word, strlen(words[i].word)) == 0) {
            value_out->kind = words[i].kind;
            value_out->number = words[i].number;
            return at + strlen(words[i].word);
        }
    value_out->kind = JSON_NUMBER;
    const char *const after = aur_read_double(at, AUR_NUMBER_FINITE, &value_out->number);
    return after != NULL ? at + (after - at) : NULL;
}

json_value *json_parse(char *text) {
    json_value *const value_out = calloc(1, sizeof *value_out);
    return value_out != NULL && read_value(skip(text), 0, value_out) != NULL ? value_out : NULL;
}

const json_value *json_member(const json_value *object, const char *name) {
    const json_value *value = object != NULL && object->kind == JSON_OBJECT ? object->first : NULL;
    while (value != NULL && strcmp(value->name, name) != 0)
        value = value->next;
    return value;
}

const json_value *json_item(const json_value *array, size_t index) {
    return array != NULL && array->items != NULL && index < array->count ? array->items[index] : NULL;
}

const char *json_text(const json_value *value) {
    return value != NULL && value->kind == JSON_TEXT ? value->text : NULL;
}

size_t json_size(const json_value *value, size_t otherwise) {
    const double number = json_number(value, -1.0);
    return number >= 0.0 && number < 1e15 && number == (double)(size_t)number ? (size_t)number : otherwise;
}

double json_number(const json_value *value, double otherwise) {
    return value != NULL && (value->kind == JSON_NUMBER || value->kind == JSON_BOOLEAN) ? value->number
                                                                                        : otherwise;
}
