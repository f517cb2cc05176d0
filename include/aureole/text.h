/* Numbers, names and JSON as text, independent of the locale: for programs and bindings that read and write
 * the library's formats. */
#ifndef AUREOLE_TEXT_H
#define AUREOLE_TEXT_H

#include <aureole/core.h>
#include <stdbool.h>
#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

/* --- numbers */

/* Reads one decimal number; only blanks may surround it. `-1.5`, `.5`, `1e-008` and `inf` are numbers; NaN,
 * hexadecimal numbers and decimal commas are not. The nearest double is returned, ties to even. False, with
 * *value unchanged, when the text is not a number. */
AUR_API bool aur_parse_double(const char *text, double *value) AUR_NONNULL(1, 2);

/* Reads a whole number of decimal digits, without a sign, that is all of `text`. False, with *value
 * unchanged, when it is something else or larger than `maximum`. */
AUR_API bool aur_parse_integer(const char *text, uint64_t maximum, uint64_t *value) AUR_NONNULL(1, 3);

/* snprintf and fprintf with a decimal point under every locale; the return values are the same. */
AUR_API int aur_format(char *text, size_t capacity, const char *format, ...) AUR_NONNULL(3) AUR_PRINTF(3, 4);
AUR_API int aur_print(FILE *stream, const char *format, ...) AUR_NONNULL(1, 2) AUR_PRINTF(2, 3);

/* --- names */

/* The name nearest to `given` among `count` names by edit distance, or NULL when none is near enough. */
AUR_API const char *aur_nearest_name(const char *given, size_t count, const char *const *names)
    AUR_NONNULL(1);

/* Writes "a, b, c" into text[capacity], always terminated; returns the length of the whole list, as snprintf
 * does. */
AUR_API size_t aur_list_names(size_t count, const char *const *names, size_t capacity, char *text);

/* --- JSON */

/* A writer of JSON. Start with {.stream = ...}; errors remain in the stream. Arrays and objects may be nested
 * 64 deep. */
typedef struct aur_json {
    FILE *stream;
    size_t depth;
    uint64_t lines;   /* bit d: the members at depth d are on separate lines */
    uint64_t members; /* bit d: depth d has a member already */
    bool named;       /* the member's name is written, its value is not */
} aur_json;

/* Opens an object ('{') or an array ('['); `lines` puts each member on a separate line. */
AUR_API void aur_json_open(aur_json *json, char bracket, bool lines) AUR_NONNULL(1);
/* Closes with '}' or ']', and ends the line after the outermost one. */
AUR_API void aur_json_close(aur_json *json, char bracket) AUR_NONNULL(1);
/* The name of the next member of an object. */
AUR_API void aur_json_name(aur_json *json, const char *name) AUR_NONNULL(1, 2);
AUR_API void aur_json_string(aur_json *json, const char *text) AUR_NONNULL(1, 2);
/* 17 digits, which read back exactly; null for infinity and NaN, which JSON does not have. */
AUR_API void aur_json_number(aur_json *json, double value) AUR_NONNULL(1);
AUR_API void aur_json_integer(aur_json *json, uint64_t value) AUR_NONNULL(1);
AUR_API void aur_json_boolean(aur_json *json, bool value) AUR_NONNULL(1);

#ifdef __cplusplus
}
#endif

#endif
