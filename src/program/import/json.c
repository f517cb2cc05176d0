#include "program/import/gltf.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/text.h"

enum { DEEPEST = 200 };

static char *skip(char *at) {
    return at + strspn(at, " \t\r\n");
}

/* Behind the text that begins after a quote, which becomes what stands for it, but for escapes of more than
 * one letter: no name of glTF has them. */
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

static char *read_value(char *at, size_t depth, json_value *made);

static bool index_items(json_value *array) {
    json_value **next = array->items = calloc(array->count, sizeof *array->items);
    for (json_value *item = array->first; array->items != NULL && item != NULL; item = item->next)
        *next++ = item;
    return array->items != NULL;
}

static char *read_list(char *at, size_t depth, json_value *made) {
    const char end = made->kind == JSON_OBJECT ? '}' : ']';
    json_value **link = &made->first;
    at = skip(at);
    if (*at == end)
        return at + 1;
    for (;;) {
        json_value *const value = *link = calloc(1, sizeof *value);
        if (value == NULL || (made->kind == JSON_OBJECT && *at != '"'))
            return NULL;
        if (made->kind == JSON_OBJECT) {
            at = read_text(at + 1, &value->name);
            at = at != NULL ? skip(at) : NULL;
            if (at == NULL || *at++ != ':')
                return NULL;
        }
        at = read_value(skip(at), depth + 1, value);
        at = at != NULL ? skip(at) : NULL;
        if (at == NULL || (*at != ',' && *at != end))
            return NULL;
        ++made->count;
        if (*at++ == end)
            return made->kind == JSON_OBJECT || index_items(made) ? at : NULL;
        link = &value->next;
        at = skip(at);
    }
}

static char *read_value(char *at, size_t depth, json_value *made) {
    static const struct {
        const char *word;
        json_kind kind;
        double number;
    } words[] = {{"null", JSON_NULL, 0.0}, {"true", JSON_BOOLEAN, 1.0}, {"false", JSON_BOOLEAN, 0.0}};
    if (depth > DEEPEST)
        return NULL;
    made->source = at;
    if (*at == '{' || *at == '[') {
        made->kind = *at == '{' ? JSON_OBJECT : JSON_ARRAY;
        return read_list(at + 1, depth, made);
    }
    if (*at == '"') {
        const char *text;
        made->kind = JSON_TEXT;
        at = read_text(at + 1, &text);
        made->text = text;
        return at;
    }
    for (size_t i = 0; i < sizeof words / sizeof words[0]; ++i)
        if (strncmp(at, words[i].word, strlen(words[i].word)) == 0) {
            made->kind = words[i].kind;
            made->number = words[i].number;
            return at + strlen(words[i].word);
        }
    made->kind = JSON_NUMBER;
    const char *const after = aur_read_double(at, AUR_NUMBER_FINITE, &made->number);
    return after != NULL ? at + (after - at) : NULL;
}

json_value *json_parse(char *text) {
    json_value *const made = calloc(1, sizeof *made);
    return made != NULL && read_value(skip(text), 0, made) != NULL ? made : NULL;
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
