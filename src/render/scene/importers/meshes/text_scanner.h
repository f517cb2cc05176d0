/* Walks through the text of a mesh file: lines, words and numbers, fast enough for millions of them. */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* The text ends with a zero byte at `end`, which no number crosses. */
typedef struct aur_scanner {
    const char *at;
    const char *end;
    size_t line;
} aur_scanner;

/* A piece of the text. */
typedef struct aur_word {
    size_t length;
    const char *text;
} aur_word;

static inline bool aur_is_blank(char c) {
    return c == ' ' || c == '\t';
}

/* Lines end with a line feed, a carriage return, or the one after the other. */
static inline bool aur_is_line_end(char c) {
    return c == '\n' || c == '\r';
}

/* Skips line ends that a backslash hides, and blanks after them. */
void aur_scan_hidden_ends(aur_scanner *scanner);
/* Skips blanks, and line ends that a backslash hides. */
static inline void aur_scan_blanks(aur_scanner *scanner) {
    while (aur_is_blank(*scanner->at))
        ++scanner->at;
    if (*scanner->at == '\\')
        aur_scan_hidden_ends(scanner);
}
/* Skips the end of the line, at which the scanner is. */
void aur_scan_line_end(aur_scanner *scanner);
/* Skips the rest of the line and its end. */
void aur_scan_next_line(aur_scanner *scanner);
/* Whether only a comment is left in the line. */
static inline bool aur_scan_line_done(aur_scanner *scanner) {
    aur_scan_blanks(scanner);
    return aur_is_line_end(*scanner->at) || *scanner->at == '\0' || *scanner->at == '#';
}
/* The next word of the line; its length is 0 at the end. */
aur_word aur_scan_word(aur_scanner *scanner);
/* A name to the end of the line; it may have blanks, and "#1" in it: a comment is a # with blanks around it.
 */
aur_word aur_scan_rest(aur_scanner *scanner);
/* Which of `count` names the word is; `count` for none. */
size_t aur_word_find(aur_word word, size_t count, const char *const *names);
bool aur_word_is(aur_word word, const char *name);
/* A number, the nearest double; false when there is none. inf and nan are numbers here: the caller refuses
 * them. */
bool aur_scan_double(aur_scanner *scanner, double *value);
/* A whole number that fits 64 bits. */
bool aur_scan_integer(aur_scanner *scanner, int64_t *value);
