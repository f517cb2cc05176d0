/* Tables of all choices (sets, measures, integrators, materials, ...) and of the keys of each, with types,
 * ranges, defaults and one line of help. The readers of scenes and of SET texts, `aureole help` and the
 * tables of the documentation use these rows.
 *
 * Everything returned is static storage. Later versions may add rows: find them by name. Access keys by
 * aur_row_key, since the struct of a key may grow at its end. */
#ifndef AUREOLE_TABLES_H
#define AUREOLE_TABLES_H

#include <aureole/core.h>
#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum aur_key_type {
    AUR_KEY_BOOLEAN, /* true or false */
    AUR_KEY_INTEGER,
    AUR_KEY_REAL,
    AUR_KEY_CHOICE, /* one of `words` */
    AUR_KEY_TEXT,
    AUR_KEY_VECTOR,    /* three numbers; one stands for three equal ones */
    AUR_KEY_COLOR,     /* the same as RGB, or a texture */
    AUR_KEY_TRANSFORM, /* an affine map: double[16], row major */
    AUR_KEY_ITEM       /* an item of a kind in `words`: "bsdf", "number", "name of a metal", ... */
} aur_key_type;

/* One key, written as `key=value` or as a child of a scene's element. */
typedef struct aur_key {
    const char *name;
    aur_key_type type;
    const char *help; /* one line */
    /* The default value, as a user would write it; NULL: no default, the key is optional or required. Where
     * `computed`, a description of how the default follows from other keys. */
    const char *default_text;
    bool computed;
    double minimum, maximum;         /* INTEGER, REAL and each number of VECTOR and COLOR; may be infinite */
    bool minimum_open, maximum_open; /* the bound itself is excluded */
    const char *const *words;        /* NULL-terminated; NULL: none */
    /* Where a reader stores the value in its private struct: bool, an integer or enum of 4 or 8 bytes, float
     * or double, const char *. */
    size_t offset, size;
} aur_key;

/* One row of a table. */
typedef struct aur_row {
    const char *name;
    const char *summary; /* one line */
    const char *source;  /* "author year, ..."; NULL or empty for none */
    size_t key_count;
    const aur_key *keys;
} aur_row;

/* All rows of one kind. */
typedef struct aur_table {
    const char *kind;    /* "integrator": the word in messages and in `aureole help integrator` */
    const char *summary; /* one line */
    size_t count;
    const aur_row *const *rows;
    const aur_row *common; /* the keys that all rows share; or NULL */
} aur_table;

/* The tables of point sets and of measures, one after the other; NULL beyond the last. aur_render_table_at
 * has the tables of rendering. */
AUR_API const aur_table *aur_table_at(size_t index);

/* Key `index` of a row; NULL beyond its keys. */
AUR_API const aur_key *aur_row_key(const aur_row *row, size_t index) AUR_NONNULL(1);
/* The key of that name, or NULL. */
AUR_API const aur_key *aur_row_find_key(const aur_row *row, const char *name) AUR_NONNULL(1, 2);

/* "boolean", "integer", "number", "choice", "text", "vector", "color", "transform" or "item"; NULL for no
 * type. */
AUR_API const char *aur_key_type_name(aur_key_type type);

/* Parses the text of a value and stores it in the struct `fields`, at key->offset. On failure `expected`, of
 * `capacity` characters, describes the valid values: "a number", "between 1 and 2", "one of a, b". Not for
 * ITEM; a TRANSFORM must be "identity" and a COLOR numbers. TEXT stores the pointer. */
AUR_API bool aur_key_parse(const aur_key *key, const char *text, void *fields, size_t capacity,
                           char *expected) AUR_NONNULL(1, 2, 3, 5);

/* The range or the words as a short text, "1 .. 65536", "> 1 .. < 2", "ratio, equal": empty where there are
 * none. Returns the length of the whole text, as snprintf does. */
AUR_API size_t aur_key_range(const aur_key *key, size_t capacity, char *text) AUR_NONNULL(1, 3);

#ifdef __cplusplus
}
#endif

#endif
