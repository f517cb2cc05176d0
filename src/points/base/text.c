#include "points/base/text.h"

#include <langinfo.h>
#include <locale.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

/* The thread's locale is "C" from enter_c_locale to leave_c_locale. This locale is a constant of the C
 * library: creating it allocates nothing and cannot fail. If the decimal separator is a point already, the
 * locale is not changed and 0 is returned, which saves a third of the time of writing a number. */
static locale_t enter_c_locale(void) {
    if (strcmp(nl_langinfo(RADIXCHAR), ".") == 0)
        return (locale_t)0;
    return uselocale(newlocale(LC_ALL_MASK, "C", (locale_t)0));
}

static void leave_c_locale(locale_t before) {
    uselocale(before);
}

/* --- reading */

static double slow_double(const char *text) {
    const locale_t before = enter_c_locale();
    const double value = strtod(text, NULL);
    leave_c_locale(before);
    return value;
}

/* digits * 10^exponent, rounded once, or NaN if the rounding is uncertain. Both factors are exact as sums of
 * doubles, and the product or quotient is a double with a correction. If the last bits of the correction
 * might change the rounding, the slow path decides. */
static double quick_double(uint64_t digits, int exponent) {
    static const double powers[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                    1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
    if (exponent < -22 || exponent > 22)
        return NAN;
    const double power = powers[exponent < 0 ? -exponent : exponent];
    const double high = (double)digits;
    if (digits <= UINT64_C(1) << 53)
        return exponent < 0 ? high / power : high * power;
    const double low = (double)(int64_t)(digits - (uint64_t)high);
    double value, correction;
    if (exponent < 0) {
        value = high / power;
        correction = (fma(-value, power, high) + low) / power;
    } else {
        value = high * power;
        correction = fma(high, power, -value) + low * power;
    }
    const double below = value + correction * (1.0 - 0x1p-48);
    const double above = value + correction * (1.0 + 0x1p-48);
    return below == above ? below : NAN;
}

/* `text` begins with `word`, in letters of either case. */
static bool begins_with(const char *text, const char *word) {
    for (; *word != '\0'; ++text, ++word)
        if ((*text | 0x20) != *word)
            return false;
    return true;
}

static const char *read_special(const char *text, bool negative, aur_number_class allowed, double *value) {
    if (allowed != AUR_NUMBER_FINITE && begins_with(text, "inf")) {
        *value = negative ? -(double)INFINITY : (double)INFINITY;
        return text + (begins_with(text, "infinity") ? 8 : 3);
    }
    if (allowed == AUR_NUMBER_ANY && begins_with(text, "nan")) {
        *value = (double)NAN;
        return text + 3;
    }
    return NULL;
}

/* Adds the digits at `text` to *digits, modulo 2^64; returns the first character after them. */
static inline const char *take_digits(const char *text, uint64_t *digits) {
    for (; aur_is_digit(*text); ++text)
        *digits = 10 * *digits + (uint64_t)(*text - '0');
    return text;
}

/* The digits of a text with at most one point, without leading zeros. */
static ptrdiff_t count_significant(const char *text, const char *end) {
    ptrdiff_t count = 0;
    for (; text < end; ++text)
        count += aur_is_digit(*text) && (count > 0 || *text != '0');
    return count;
}

const char *aur_read_double(const char *text, aur_number_class allowed, double *value) {
    /* 19 digits always fit 64 bits. */
    enum { MOST_DIGITS = 19, LARGEST_EXPONENT = 99999 };
    const bool negative = *text == '-';
    const char *const start = text + (*text == '-' || *text == '+');
    uint64_t digits = 0;
    int exponent = 0;
    const char *c = take_digits(start, &digits);
    bool any = c > start;
    if (*c == '.') {
        const char *const point = ++c;
        c = take_digits(c, &digits);
        any = any || c > point;
        exponent = (int)(point - c);
    }
    if (!any)
        return read_special(c, negative, allowed, value);
    const bool fits = c - start <= MOST_DIGITS || count_significant(start, c) <= MOST_DIGITS;
    if (*c == 'e' || *c == 'E') {
        const char *e = c + 1;
        const bool below = *e == '-';
        e += *e == '-' || *e == '+';
        if (aur_is_digit(*e)) {
            int power = 0;
            for (; aur_is_digit(*e); ++e)
                power = power < LARGEST_EXPONENT ? 10 * power + (*e - '0') : power;
            exponent += below ? -power : power;
            c = e;
        }
    }
    double parsed = (double)NAN;
    if (fits)
        parsed = digits == 0 ? 0.0 : quick_double(digits, exponent);
    if (isnan(parsed))
        parsed = fabs(slow_double(text));
    if (isinf(parsed) && allowed == AUR_NUMBER_FINITE)
        return NULL;
    *value = negative ? -parsed : parsed;
    return c;
}

const char *aur_read_integer(const char *text, uint64_t maximum, uint64_t *value) {
    enum { SAFE_DIGITS = 19 }; /* any number of so many digits fits 64 bits */
    uint64_t parsed = 0;
    const char *c = text;
    for (; aur_is_digit(*c) && c - text < SAFE_DIGITS; ++c)
        parsed = 10 * parsed + (uint64_t)(*c - '0');
    for (; aur_is_digit(*c); ++c) {
        const uint64_t digit = (uint64_t)(*c - '0');
        if (parsed > (UINT64_MAX - digit) / 10)
            return NULL;
        parsed = 10 * parsed + digit;
    }
    if (c == text || parsed > maximum)
        return NULL;
    *value = parsed;
    return c;
}

bool aur_parse_double(const char *text, double *value) {
    double parsed;
    const char *const end = aur_read_double(aur_skip_spaces(text), AUR_NUMBER_INFINITE, &parsed);
    if (end == NULL || *aur_skip_spaces(end) != '\0')
        return false;
    *value = parsed;
    return true;
}

bool aur_parse_integer(const char *text, uint64_t maximum, uint64_t *value) {
    uint64_t parsed;
    const char *const end = aur_read_integer(text, maximum, &parsed);
    if (end == NULL || *end != '\0')
        return false;
    *value = parsed;
    return true;
}

size_t aur_parse_doubles(const char *text, double *values, size_t capacity) {
    for (size_t count = 0;; ++count) {
        while (aur_is_space(*text) || *text == ',')
            ++text;
        if (*text == '\0')
            return count;
        double parsed;
        text = aur_read_double(text, AUR_NUMBER_INFINITE, &parsed);
        if (text == NULL || (*text != '\0' && *text != ',' && !aur_is_space(*text)))
            return SIZE_MAX;
        if (count < capacity)
            values[count] = parsed;
    }
}

/* --- writing */

int aur_format_list(char *text, size_t capacity, const char *format, va_list arguments) {
    const locale_t before = enter_c_locale();
    const int length = vsnprintf(text, capacity, format, arguments);
    leave_c_locale(before);
    return length;
}

char *aur_new_text(const char *format, ...) {
    va_list arguments, again;
    va_start(arguments, format);
    va_copy(again, arguments);
    const int length = aur_format_list(NULL, 0, format, arguments);
    char *const text = length >= 0 ? malloc((size_t)length + 1) : NULL;
    if (text != NULL)
        aur_format_list(text, (size_t)length + 1, format, again);
    va_end(arguments);
    va_end(again);
    return text;
}

int aur_format(char *text, size_t capacity, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    const int length = aur_format_list(text, capacity, format, arguments);
    va_end(arguments);
    return length;
}

int aur_print(FILE *stream, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    const locale_t before = enter_c_locale();
    const int length = vfprintf(stream, format, arguments);
    leave_c_locale(before);
    va_end(arguments);
    return length;
}
