/* Parsing of numbers at a position in a text: the parts of aur_parse_double, for parsers. Independent of the
 * locale. */
#pragma once

#include <aureole/text.h>
#include <stdarg.h>

#include "points/base/error.h"

static inline bool aur_is_digit(char c) {
    return c >= '0' && c <= '9';
}

/* The blanks of the locale "C", including line ends. */
static inline bool aur_is_space(char c) {
    return c == ' ' || (c >= '\t' && c <= '\r');
}

static inline const char *aur_skip_spaces(const char *text) {
    while (aur_is_space(*text))
        ++text;
    return text;
}

/* The accepted range of a number. A decimal number too large for a double is infinite. */
typedef enum aur_number_class { AUR_NUMBER_FINITE, AUR_NUMBER_INFINITE, AUR_NUMBER_ANY } aur_number_class;

/* Reads the decimal number (or `inf`, `infinity`, `nan`, if the class allows it) that starts exactly at
 * `text`. Returns the first character after it, or NULL with *value unchanged, when there is none. */
AUR_INTERNAL const char *aur_read_double(const char *text, aur_number_class allowed, double *value);

/* Reads the decimal digits that start exactly at `text`. Returns the first character after them, or NULL with
 * *value unchanged, when there are none or the number exceeds `maximum`. */
AUR_INTERNAL const char *aur_read_integer(const char *text, uint64_t maximum, uint64_t *value);

/* Parses up to `capacity` numbers separated by blanks or single commas; returns their number, or SIZE_MAX
 * when an item is not a number. Infinities are numbers, NaN is not. */
AUR_INTERNAL size_t aur_parse_doubles(const char *text, double *values, size_t capacity);

/* A new text, as aur_format writes it; NULL: out of memory. */
AUR_INTERNAL char *aur_new_text(const char *format, ...) AUR_PRINTF(1, 2);

/* vsnprintf with a decimal point under every locale. */
AUR_INTERNAL int aur_format_list(char *text, size_t capacity, const char *format, va_list arguments)
    AUR_PRINTF(3, 0);
