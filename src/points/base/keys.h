/* Tables of keys: one table declares the keys of an object, and one loop reads them into its struct. Rows are
 * written with the macros below:
 *
 *     static const aur_key keys[] = {
 *         {AUR_KEY_OF_INTEGER(options, "samples", samples, 1, 65536, "64", "directions per point")},
 *         {AUR_KEY_OF_REAL(options, "smoothness", smoothness, 1, 2, "1.5", "s of the Sobolev space"),
 *          .minimum_open = true, .maximum_open = true},
 *         {AUR_KEY_OF_CHOICE(options, "weights", weights, "ratio", "how samples are weighed", "ratio",
 * "equal")},
 *     };
 *
 * The words of a choice are in the order of the field's enum. */
#pragma once

#include <aureole/tables.h>
#include <math.h>

#include "points/base/names.h"
#include "points/base/parameters.h"
#include "points/base/vector.h"

#define AUR_KEY_FIELD(type_, struct_, name_, field_, default_, help_)                                        \
    .name = (name_), .type = (type_), .help = (help_), .default_text = (default_),                           \
    .offset = offsetof(struct_, field_), .size = sizeof(((struct_ *)0)->field_)
#define AUR_KEY_OF_BOOLEAN(struct_, name_, field_, default_, help_)                                          \
    AUR_KEY_FIELD(AUR_KEY_BOOLEAN, struct_, name_, field_, default_, help_)
#define AUR_KEY_OF_INTEGER(struct_, name_, field_, minimum_, maximum_, default_, help_)                      \
    AUR_KEY_FIELD(AUR_KEY_INTEGER, struct_, name_, field_, default_, help_), .minimum = (double)(minimum_),  \
                                                                             .maximum = (double)(maximum_)
#define AUR_KEY_OF_REAL(struct_, name_, field_, minimum_, maximum_, default_, help_)                         \
    AUR_KEY_FIELD(AUR_KEY_REAL, struct_, name_, field_, default_, help_), .minimum = (minimum_),             \
                                                                          .maximum = (maximum_)
#define AUR_KEY_OF_TEXT(struct_, name_, field_, default_, help_)                                             \
    AUR_KEY_FIELD(AUR_KEY_TEXT, struct_, name_, field_, default_, help_)
#define AUR_KEY_OF_CHOICE(struct_, name_, field_, default_, help_, ...)                                      \
    AUR_KEY_FIELD(AUR_KEY_CHOICE, struct_, name_, field_, default_, help_), .words = (const char *const[]) { \
        __VA_ARGS__, NULL                                                                                    \
    }
/* The field is float[3], double[3] or aur_vector. */
#define AUR_KEY_OF_VECTOR(struct_, name_, field_, minimum_, maximum_, default_, help_)                       \
    AUR_KEY_FIELD(AUR_KEY_VECTOR, struct_, name_, field_, default_, help_), .minimum = (minimum_),           \
                                                                            .maximum = (maximum_)
/* The field is an aur_color; numbers from 0 to `maximum`. */
#define AUR_KEY_OF_COLOR(struct_, name_, field_, maximum_, default_, help_)                                  \
    AUR_KEY_FIELD(AUR_KEY_COLOR, struct_, name_, field_, default_, help_), .maximum = (maximum_)
/* The field is double[16], row major. */
#define AUR_KEY_OF_TRANSFORM(struct_, name_, field_, help_)                                                  \
    AUR_KEY_FIELD(AUR_KEY_TRANSFORM, struct_, name_, field_, "identity", help_)
/* The field is a `const aur_parameter *`, read by the object itself; NULL if not given. */
#define AUR_KEY_OF_ITEM(struct_, name_, field_, default_, help_, ...)                                        \
    AUR_KEY_FIELD(AUR_KEY_ITEM, struct_, name_, field_, default_, help_), .words = (const char *const[]) {   \
        __VA_ARGS__, NULL                                                                                    \
    }

/* A key that the object itself finds and reads: for listings, and so that its name is accepted. */
#define AUR_KEY_READ_APART(type_, name_, default_, help_)                                                    \
    .name = (name_), .type = (type_), .help = (help_), .default_text = (default_),                           \
    .computed = (default_) != NULL

/* The two fields of a row, of an array of keys. */
#define AUR_ROW_KEYS(keys_) .key_count = sizeof(keys_) / sizeof(keys_)[0], .keys = (keys_)
/* The two fields of a table, of an array of pointers to rows. */
#define AUR_TABLE_ROWS(rows_) .count = sizeof(rows_) / sizeof(rows_)[0], .rows = (rows_)

/* A colour of a material or light: one for the whole surface, or a texture. */
typedef struct aur_color {
    aur_vector constant;
    const struct aur_texture *texture; /* NULL: constant */
} aur_color;

/* Reads every key of the table into the struct `fields`: the given value, else the key's default. Without
 * either the field is unchanged. Errors: FORMAT with the value's location if it does not parse or is out of
 * range. aur_parameters_finish reports unused values. */
AUR_INTERNAL aur_result aur_keys_read(size_t count, const aur_key *keys, aur_parameters *parameters,
                                      void *fields, aur_error *error);
/* The same for a row, and then aur_parameters_finish. */
AUR_INTERNAL aur_result aur_row_read(const aur_row *row, aur_parameters *parameters, void *fields,
                                     aur_error *error);

/* The names of a table's rows. */
AUR_INTERNAL aur_names aur_names_of_table(const aur_table *table);

/* The row that parameters->plugin names, or a NAME error with the nearest name or all of them. */
AUR_INTERNAL aur_result aur_table_find(const aur_table *table, const aur_parameters *parameters,
                                       const aur_row **row, aur_error *error);
