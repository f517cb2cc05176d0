#include "points/base/keys.h"

#include <string.h>
#include <strings.h>

#include "points/base/text.h"

enum { EXPECTED_CAPACITY = 512 };

const char *aur_key_type_name(aur_key_type type) {
    static const char *const names[] = {"boolean", "integer", "number",    "choice", "text",
                                        "vector",  "color",   "transform", "item"};
    return (size_t)type < sizeof names / sizeof names[0] ? names[type] : NULL;
}

const aur_key *aur_row_key(const aur_row *row, size_t index) {
    return index < row->key_count ? &row->keys[index] : NULL;
}

static const aur_key *find_key(size_t count, const aur_key *keys, const char *name) {
    for (size_t i = 0; i < count; ++i)
        if (strcmp(keys[i].name, name) == 0)
            return &keys[i];
    return NULL;
}

const aur_key *aur_row_find_key(const aur_row *row, const char *name) {
    return find_key(row->key_count, row->keys, name);
}

/* Integers without an exponent, other numbers as %g. */
static void print_number(const aur_key *key, double value, char text[32]) {
    aur_format(text, 32, key->type == AUR_KEY_INTEGER ? "%.0f" : "%g", value);
}

static aur_names names_of_words(const char *const *words) {
    size_t count = 0;
    while (words[count] != NULL)
        ++count;
    return aur_names_of(count, words);
}

static bool is_numeric(const aur_key *key) {
    return key->type == AUR_KEY_INTEGER || key->type == AUR_KEY_REAL || key->type == AUR_KEY_VECTOR ||
           key->type == AUR_KEY_COLOR;
}

size_t aur_key_range(const aur_key *key, size_t capacity, char *text) {
    char list[EXPECTED_CAPACITY] = "";
    if (key->words != NULL) {
        aur_names_list(names_of_words(key->words), sizeof list, list);
    } else if (is_numeric(key) && (isfinite(key->minimum) || isfinite(key->maximum))) {
        char low[32], high[32];
        print_number(key, key->minimum, low);
        print_number(key, key->maximum, high);
        const char *const above = key->minimum_open ? "> " : "";
        const char *const below = key->maximum_open ? "< " : "";
        if (!isfinite(key->maximum))
            aur_format(list, sizeof list, "%s%s ..", above, low);
        else if (!isfinite(key->minimum))
            aur_format(list, sizeof list, ".. %s%s", below, high);
        else
            aur_format(list, sizeof list, "%s%s .. %s%s", above, low, below, high);
    }
    return (size_t)aur_format(text, capacity, "%s", list);
}

/* "between 1 and 2", "above 1 and below 2", "at least 1", ... */
static void say_range(const aur_key *key, size_t capacity, char *expected) {
    char low[32], high[32];
    print_number(key, key->minimum, low);
    print_number(key, key->maximum, high);
    const char *const above = key->minimum_open ? "above" : "at least";
    const char *const below = key->maximum_open ? "below" : "at most";
    if (isinf(key->maximum))
        aur_format(expected, capacity, "%s %s", above, low);
    else if (isinf(key->minimum))
        aur_format(expected, capacity, "%s %s", below, high);
    else if (key->minimum_open && key->maximum_open)
        aur_format(expected, capacity, "between %s and %s, both exclusive", low, high);
    else if (key->minimum_open || key->maximum_open)
        aur_format(expected, capacity, "%s %s and %s %s", above, low, below, high);
    else
        aur_format(expected, capacity, "between %s and %s", low, high);
}

static bool in_range(const aur_key *key, double value) {
    return (key->minimum_open ? value > key->minimum : value >= key->minimum) &&
           (key->maximum_open ? value < key->maximum : value <= key->maximum);
}

static void put_integer(const aur_key *key, uint64_t value, void *field) {
    if (key->size == sizeof(uint32_t))
        *(uint32_t *)field = (uint32_t)value;
    else
        *(uint64_t *)field = value;
}

/* The result of parsing a text for a key. */
typedef enum reading { READ, OUT_OF_RANGE, OF_OTHER_TYPE, TOO_LONG } reading;

static reading parse_integer(const aur_key *key, const char *text, void *field) {
    const char *const digits = aur_skip_spaces(text);
    const bool negative = *digits == '-';
    const char *const start = digits + (negative || *digits == '+');
    uint64_t magnitude = UINT64_MAX;
    const size_t count = strspn(start, "0123456789");
    if (count == 0 || *aur_skip_spaces(start + count) != '\0')
        return OF_OTHER_TYPE;
    const bool fits =
        aur_read_integer(start, negative ? (uint64_t)INT64_MAX : UINT64_MAX, &magnitude) != NULL;
    if (!fits && !negative && isinf(key->maximum))
        return TOO_LONG;
    if (!fits || !in_range(key, negative ? -(double)magnitude : (double)magnitude))
        return OUT_OF_RANGE;
    put_integer(key, negative ? 0 - magnitude : magnitude, field);
    return READ;
}

static reading parse_real(const aur_key *key, const char *text, void *field) {
    double value;
    if (!aur_parse_double(text, &value))
        return OF_OTHER_TYPE;
    if (!in_range(key, value))
        return OUT_OF_RANGE;
    if (key->size == sizeof(float))
        *(float *)field = (float)value;
    else
        *(double *)field = value;
    return READ;
}

static reading parse_vector(const aur_key *key, const char *text, void *field) {
    double value[3];
    const size_t count = aur_parse_doubles(text, value, 3);
    if (count == 1)
        value[2] = value[1] = value[0];
    else if (count != 3)
        return OF_OTHER_TYPE;
    for (size_t i = 0; i < 3; ++i)
        if (!in_range(key, value[i]))
            return OUT_OF_RANGE;
    if (key->type == AUR_KEY_COLOR)
        *(aur_color *)field = (aur_color){{(float)value[0], (float)value[1], (float)value[2]}, NULL};
    for (size_t i = 0; key->type == AUR_KEY_VECTOR && i < 3; ++i) {
        if (key->size == sizeof value)
            ((double *)field)[i] = value[i];
        else
            ((float *)field)[i] = (float)value[i];
    }
    return READ;
}

static reading parse(const aur_key *key, const char *text, void *field) {
    switch (key->type) {
    case AUR_KEY_BOOLEAN: {
        const bool yes = strcasecmp(text, "true") == 0;
        if (!yes && strcasecmp(text, "false") != 0)
            return OF_OTHER_TYPE;
        *(bool *)field = yes;
        return READ;
    }
    case AUR_KEY_INTEGER:
        return parse_integer(key, text, field);
    case AUR_KEY_REAL:
        return parse_real(key, text, field);
    case AUR_KEY_CHOICE: {
        const aur_names names = names_of_words(key->words);
        const size_t index = aur_names_find(names, text);
        if (index == names.count)
            return OF_OTHER_TYPE;
        put_integer(key, index, field);
        return READ;
    }
    case AUR_KEY_TEXT:
        *(const char **)field = text;
        return READ;
    case AUR_KEY_VECTOR:
    case AUR_KEY_COLOR:
        return parse_vector(key, text, field);
    case AUR_KEY_TRANSFORM:
        for (size_t i = 0; i < 16; ++i)
            ((double *)field)[i] = i % 5 == 0 ? 1.0 : 0.0;
        return strcmp(text, "identity") == 0 ? READ : OF_OTHER_TYPE;
    case AUR_KEY_ITEM:
        break;
    }
    return OF_OTHER_TYPE;
}

/* The expected kind of value, in error messages about the type. */
static void say_type(const aur_key *key, size_t capacity, char *expected) {
    static const char *const types[] = {"true or false",
                                        "an integer",
                                        "a number",
                                        "one of ",
                                        "a string",
                                        "one or three numbers",
                                        "one or three numbers or a texture",
                                        "a transform",
                                        "something else than text"};
    const int used = aur_format(expected, capacity, "%s", types[key->type]);
    if (key->type == AUR_KEY_CHOICE && (size_t)used < capacity)
        aur_names_list(names_of_words(key->words), capacity - (size_t)used, expected + used);
}

bool aur_key_parse(const aur_key *key, const char *text, void *fields, size_t capacity, char *expected) {
    const reading result = parse(key, text, (char *)fields + key->offset);
    if (result == OUT_OF_RANGE)
        say_range(key, capacity, expected);
    else if (result == OF_OTHER_TYPE)
        say_type(key, capacity, expected);
    else if (result == TOO_LONG)
        aur_format(expected, capacity, "below 2^64");
    return result == READ;
}

/* Whether a value of this kind may be read as a key of that type: text may be anything. */
static bool kind_fits(aur_parameter_kind kind, aur_key_type type) {
    static const unsigned kinds[] = {
        [AUR_KEY_BOOLEAN] = 1u << AUR_PARAMETER_BOOLEAN,
        [AUR_KEY_INTEGER] = 1u << AUR_PARAMETER_INTEGER,
        [AUR_KEY_REAL] = 1u << AUR_PARAMETER_FLOAT | 1u << AUR_PARAMETER_INTEGER,
        [AUR_KEY_CHOICE] = 1u << AUR_PARAMETER_STRING,
        [AUR_KEY_TEXT] = 1u << AUR_PARAMETER_STRING,
        [AUR_KEY_VECTOR] = 1u << AUR_PARAMETER_VECTOR | 1u << AUR_PARAMETER_COLOR |
                           1u << AUR_PARAMETER_FLOAT | 1u << AUR_PARAMETER_INTEGER,
        [AUR_KEY_COLOR] = 1u << AUR_PARAMETER_VECTOR | 1u << AUR_PARAMETER_COLOR | 1u << AUR_PARAMETER_FLOAT |
                          1u << AUR_PARAMETER_INTEGER,
        [AUR_KEY_TRANSFORM] = 1u << AUR_PARAMETER_TRANSFORM,
    };
    return kind == AUR_PARAMETER_TEXT ? type != AUR_KEY_TRANSFORM : (kinds[type] >> kind & 1u) != 0;
}

/* A colour given as one number: a spectrum of Mitsuba 3 may be one. */
static bool is_grey(const char *text, char number[32]) {
    double value[3];
    const size_t count = aur_parse_doubles(text, value, 3);
    if (count != 1 && !(count == 3 && value[0] == value[1] && value[1] == value[2]))
        return false;
    aur_format(number, 32, "%.17g", value[0]);
    return true;
}

static aur_result read_text(const aur_key *key, const aur_parameters *parameters, const aur_parameter *item,
                            const char *text, void *fields, aur_error *error) {
    char expected[EXPECTED_CAPACITY];
    return aur_key_parse(key, text, fields, sizeof expected, expected)
               ? AUR_OK
               : aur_parameters_fail_value(parameters, item, expected, error);
}

static aur_result read_given(const aur_key *key, const aur_parameters *parameters, const aur_parameter *item,
                             void *fields, aur_error *error) {
    void *const field = (char *)fields + key->offset;
    char expected[EXPECTED_CAPACITY];
    if (key->type == AUR_KEY_ITEM) {
        *(const aur_parameter **)field = item;
        return AUR_OK;
    }
    if (key->type == AUR_KEY_COLOR && item->kind == AUR_PARAMETER_OBJECT &&
        strcmp(item->object_kind, "texture") == 0) {
        *(aur_color *)field = (aur_color){.texture = item->object};
        return AUR_OK;
    }
    char number[32];
    if (key->type == AUR_KEY_REAL && item->kind == AUR_PARAMETER_COLOR && is_grey(item->text, number))
        return read_text(key, parameters, item, number, fields, error);
    if (!kind_fits(item->kind, key->type)) {
        say_type(key, sizeof expected, expected);
        return aur_parameters_fail_value(parameters, item, expected, error);
    }
    if (key->type == AUR_KEY_TRANSFORM) {
        memcpy(field, item->transform, sizeof item->transform);
        return AUR_OK;
    }
    return read_text(key, parameters, item, item->text, fields, error);
}

/* Whether the default text is a description and not a value of the key: "auto", "by the size". */
static bool default_is_words(const aur_key *key) {
    union {
        double numbers[4];
        uint64_t integers[4];
        aur_color color;
    } unused;
    aur_key copy = *key;
    copy.offset = 0;
    if (key->type == AUR_KEY_TEXT || key->type == AUR_KEY_ITEM || key->type == AUR_KEY_TRANSFORM)
        return strchr(key->default_text, ' ') != NULL;
    return parse(&copy, key->default_text, &unused) != READ;
}

aur_result aur_keys_read(size_t count, const aur_key *keys, aur_parameters *parameters, void *fields,
                         aur_error *error) {
    char unused[EXPECTED_CAPACITY];
    for (size_t i = 0; i < count; ++i) {
        if (keys[i].computed && default_is_words(&keys[i]))
            aur_parameters_leave_out(parameters, keys[i].name, keys[i].default_text);
        const aur_parameter *const item = aur_parameters_find(parameters, keys[i].name);
        if (keys[i].size == 0)
            continue;
        if (item != NULL) {
            const aur_result result = read_given(&keys[i], parameters, item, fields, error);
            if (result != AUR_OK)
                return result;
        } else if (keys[i].default_text != NULL && !keys[i].computed && keys[i].type != AUR_KEY_ITEM &&
                   !aur_key_parse(&keys[i], keys[i].default_text, fields, sizeof unused, unused)) {
            return aur_fail(error, AUR_ERROR_INTERNAL, "%s '%s': the default of '%s' must be %s",
                            parameters->kind, parameters->plugin, keys[i].name, unused);
        }
    }
    return AUR_OK;
}

aur_result aur_row_read(const aur_row *row, aur_parameters *parameters, void *fields, aur_error *error) {
    const aur_result result = aur_keys_read(row->key_count, row->keys, parameters, fields, error);
    return result == AUR_OK ? aur_parameters_finish(parameters, error) : result;
}

static const char *row_name(const void *table, size_t index) {
    return ((const aur_table *)table)->rows[index]->name;
}

aur_names aur_names_of_table(const aur_table *table) {
    return (aur_names){table->count, row_name, table};
}

aur_result aur_table_find(const aur_table *table, const aur_parameters *parameters, const aur_row **row,
                          aur_error *error) {
    size_t index;
    const aur_result result = aur_names_choose(aur_names_of_table(table), table->kind, parameters->plugin,
                                               parameters->location, &index, error);
    *row = result == AUR_OK ? table->rows[index] : NULL;
    return result;
}
