/* Fast scanner for the text of mesh files: lines, words and numbers. */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* The text ends with a zero byte at `end`, which terminates numbers. */
typedef struct aur_scanner {
    const char *at;
    const char *end;
    size_t line;
} aur_scanner;

/* A substring. */
typedef struct aur_word {
    size_t length;
    const char *text;
} aur_word;

static inline bool aur_is_blank(char c) {
    return c == ' ' || c == '\t';
}

/* Lines end with a line feed, a carriage return, or both. */
static inline bool aur_is_line_end(char c) {
    return c == '\n' || c == '\r';
}

/* Skips line ends continued by a backslash, and blanks after them. */
void aur_scan_hidden_ends(aur_scanner *scanner);
/* Skips blanks, and line ends continued by a backslash. */
static inline void aur_scan_blanks(aur_scanner *scanner) {
    while (aur_is_blank(*scanner->at))
        ++scanner->at;
    if (*scanner->at == '\\')
        aur_scan_hidden_ends(scanner);
}
/* Skips the line end at the current position. */
void aur_scan_line_end(aur_scanner *scanner);
/* Skips the rest of the line and its end. */
void aur_scan_next_line(aur_scanner *scanner);
/* Whether the rest of the line is empty or a comment. */
static inline bool aur_scan_line_done(aur_scanner *scanner) {
    aur_scan_blanks(scanner);
    return aur_is_line_end(*scanner->at) || *scanner->at == '\0' || *scanner->at == '#';
}
/* The next word of the line; its length is 0 at the end. */
aur_word aur_scan_word(aur_scanner *scanner);
/* A name up to the end of the line. It may contain blanks and "#1": a comment is a # between blanks. */
aur_word aur_scan_rest(aur_scanner *scanner);
/* Index of the word among `count` names; `count` if none matches. */
size_t aur_word_find(aur_word word, size_t count, const char *const *names);
bool aur_word_is(aur_word word, const char *name);
/* A number, rounded to the nearest double; false if there is none. Accepts inf and nan, which the caller
 * rejects. */
bool aur_scan_double(aur_scanner *scanner, double *value);
/* An integer within 64 bits. */
bool aur_scan_integer(aur_scanner *scanner, int64_t *value);
