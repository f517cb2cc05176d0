#include "scene/text_scanner.h"

#include <stdlib.h>
#include <string.h>

void aur_scan_blanks(aur_scanner *scanner) {
    for (;;) {
        while (aur_is_blank(*scanner->at))
            ++scanner->at;
        if (scanner->at[0] != '\\' || (scanner->at[1] != '\n' && scanner->at[1] != '\r'))
            return;
        scanner->at += scanner->at[1] == '\r' && scanner->at[2] == '\n' ? 3 : 2;
        ++scanner->line;
    }
}

void aur_scan_next_line(aur_scanner *scanner) {
    const char *const newline = memchr(scanner->at, '\n', (size_t)(scanner->end - scanner->at));
    scanner->at = newline != NULL ? newline + 1 : scanner->end;
    ++scanner->line;
}

bool aur_scan_line_done(aur_scanner *scanner) {
    aur_scan_blanks(scanner);
    return *scanner->at == '\n' || *scanner->at == '\0' || *scanner->at == '#';
}

size_t aur_scan_word(aur_scanner *scanner, const char **word) {
    aur_scan_blanks(scanner);
    *word = scanner->at;
    while (!aur_is_blank(*scanner->at) && *scanner->at != '\n' && *scanner->at != '\0')
        ++scanner->at;
    return (size_t)(scanner->at - *word);
}

static bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

/* Up to 18 digits and a power of ten that a double holds exactly give the double next to the number, or the
 * one beside it; the rest is left to strtod. */
bool aur_scan_double(aur_scanner *scanner, double *value) {
    static const double powers[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                    1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
    aur_scan_blanks(scanner);
    const char *c = scanner->at;
    const bool negative = *c == '-';
    c += *c == '-' || *c == '+';
    uint64_t digits = 0;
    int count = 0;
    int exponent = 0;
    const char *const first = c;
    for (; is_digit(*c); ++c, ++count)
        digits = 10 * digits + (uint64_t)(*c - '0');
    if (*c == '.')
        for (++c; is_digit(*c); ++c, ++count, --exponent)
            digits = 10 * digits + (uint64_t)(*c - '0');
    bool simple = count > 0 && count <= 18 && !(first[0] == '0' && (first[1] == 'x' || first[1] == 'X'));
    if (simple && (*c == 'e' || *c == 'E')) {
        const char *e = c + 1;
        const bool below = *e == '-';
        e += *e == '-' || *e == '+';
        int power = 0;
        simple = is_digit(*e);
        for (; is_digit(*e) && power < 1000; ++e)
            power = 10 * power + (*e - '0');
        exponent += below ? -power : power;
        c = e;
    }
    if (simple && exponent >= -22 && exponent <= 22 && !is_digit(*c)) {
        const double whole = (double)digits;
        const double magnitude = exponent < 0 ? whole / powers[-exponent] : whole * powers[exponent];
        *value = negative ? -magnitude : magnitude;
        scanner->at = c;
        return true;
    }
    char *end;
    *value = strtod(scanner->at, &end);
    /* strtod skips line ends, which are not its to skip. */
    if (end == scanner->at || *scanner->at == '\n' || *scanner->at == '\0')
        return false;
    scanner->at = end;
    return true;
}

bool aur_scan_integer(aur_scanner *scanner, int64_t *value) {
    aur_scan_blanks(scanner);
    const char *c = scanner->at;
    const bool negative = *c == '-';
    c += *c == '-' || *c == '+';
    const char *const first = c;
    int64_t digits = 0;
    for (; is_digit(*c); ++c) {
        if (c - first >= 18)
            return false;
        digits = 10 * digits + (*c - '0');
    }
    if (c == first)
        return false;
    *value = negative ? -digits : digits;
    scanner->at = c;
    return true;
}
