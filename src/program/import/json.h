/* JSON as a tree: what assimp leaves out of a glTF file is looked up in it. */
#pragma once

#include <stddef.h>

typedef enum json_kind { JSON_NULL, JSON_BOOLEAN, JSON_NUMBER, JSON_TEXT, JSON_ARRAY, JSON_OBJECT } json_kind;

typedef struct json_value {
    json_kind kind;
    double number;    /* of a boolean 0 or 1 */
    const char *name; /* of a member, else NULL */
    struct json_value *first, *next;
    size_t count;              /* of an array's items or an object's members */
    struct json_value **items; /* of an array */
} json_value;

/* Of a text that a zero byte ends, which is changed; NULL where it is no JSON or memory is out. Texts that
 * are no names are not kept. The tree stays until the process ends. */
json_value *json_parse(char *text);

/* These take NULL and give NULL, or `otherwise`, where there is no such thing. */
const json_value *json_member(const json_value *object, const char *name);
const json_value *json_item(const json_value *array, size_t index);
double json_number(const json_value *value, double otherwise);
