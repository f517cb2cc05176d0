#include "render/scene/importers/meshes/text_scanner.h"

#include <string.h>

#include "points/base/text.h"

void aur_scan_line_end(aur_scanner *scanner) {
    scanner->at += scanner->at[0] == '\r' && scanner->at[1] == '\n' ? 2 : 1;
    ++scanner->line;
}

void aur_scan_hidden_ends(aur_scanner *scanner) {
    while (scanner->at[0] == '\\' && aur_is_line_end(scanner->at[1])) {
        ++scanner->at;
        aur_scan_line_end(scanner);
        while (aur_is_blank(*scanner->at))
            ++scanner->at;
    }
}

void aur_scan_next_line(aur_scanner *scanner) {
    while (scanner->at < scanner->end && !aur_is_line_end(*scanner->at))
        ++scanner->at;
    if (scanner->at < scanner->end)
        aur_scan_line_end(scanner);
    else
        ++scanner->line;
}

aur_word aur_scan_word(aur_scanner *scanner) {
    aur_scan_blanks(scanner);
    const char *const start = scanner->at;
    while (!aur_is_blank(*scanner->at) && !aur_is_line_end(*scanner->at) && *scanner->at != '\0')
        ++scanner->at;
    return (aur_word){(size_t)(scanner->at - start), start};
}

static bool is_end(const char *at) {
    return *at == '\0' || aur_is_line_end(*at);
}

aur_word aur_scan_rest(aur_scanner *scanner) {
    aur_scan_blanks(scanner);
    const char *const start = scanner->at;
    const char *end = start;
    while (!is_end(end) && !(*end == '#' && (end == start || aur_is_blank(end[-1])) &&
                             (aur_is_blank(end[1]) || is_end(end + 1))))
        ++end;
    scanner->at = end;
    while (end > start && aur_is_blank(end[-1]))
        --end;
    return (aur_word){(size_t)(end - start), start};
}

size_t aur_word_find(aur_word word, size_t count, const char *const *names) {
    /* Compare the first characters before calling memcmp. */
    const char first = word.length > 0 ? *word.text : '\0';
    size_t i = 0;
    while (i < count && (*names[i] != first || strlen(names[i]) != word.length ||
                         memcmp(names[i], word.text, word.length) != 0))
        ++i;
    return i;
}

bool aur_word_is(aur_word word, const char *name) {
    return aur_word_find(word, 1, &name) == 0;
}

bool aur_scan_double(aur_scanner *scanner, double *value) {
    aur_scan_blanks(scanner);
    const char *const end = aur_read_double(scanner->at, AUR_NUMBER_ANY, value);
    if (end != NULL)
        scanner->at = end;
    return end != NULL;
}

bool aur_scan_integer(aur_scanner *scanner, int64_t *value) {
    aur_scan_blanks(scanner);
    const char *c = scanner->at;
    const bool negative = *c == '-';
    c += *c == '-' || *c == '+';
    uint64_t digits;
    const char *const end = aur_read_integer(c, INT64_MAX, &digits);
    if (end == NULL)
        return false;
    *value = negative ? -(int64_t)digits : (int64_t)digits;
    scanner->at = end;
    return true;
}
