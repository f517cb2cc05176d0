#include "program/cli/options.h"

#include <aureole/text.h>
#include <math.h>
#include <string.h>

bool cli_parse_quantity(const char *text, size_t unit_count, const cli_unit *units, double *value) {
    char number[64];
    const size_t length = strlen(text);
    double factor = 1.0;
    size_t cut = 0;
    for (size_t i = 0; i < unit_count; ++i) {
        const size_t suffix = strlen(units[i].name);
        if (suffix > cut && length > suffix && strcmp(text + length - suffix, units[i].name) == 0) {
            factor = units[i].factor;
            cut = suffix;
        }
    }
    if (length - cut >= sizeof number)
        return false;
    memcpy(number, text, length - cut);
    number[length - cut] = '\0';
    if (!aur_parse_double(number, value) || !(*value > 0.0))
        return false;
    *value *= factor;
    return true;
}

aur_result cli_parse_seconds(const char *option, const char *text, double *seconds, aur_error *error) {
    static const cli_unit units[] = {{"s", 1.0}, {"min", 60.0}, {"m", 60.0}, {"h", 3600.0}};
    if (cli_parse_quantity(text, sizeof units / sizeof units[0], units, seconds))
        return AUR_OK;
    return aur_fail(error, AUR_ERROR_ARGUMENT, "--%s: expected a time such as 30s, 5min or 1h, not '%s'",
                    option, text);
}

aur_result cli_parse_bytes(const char *option, const char *text, size_t *bytes, aur_error *error) {
    static const cli_unit units[] = {{"K", 0x1p10}, {"M", 0x1p20}, {"G", 0x1p30}, {"T", 0x1p40}};
    double value = 0.0;
    if (!cli_parse_quantity(text, sizeof units / sizeof units[0], units, &value) || value >= 0x1p62)
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "--%s: expected a size in bytes, or such as 500M or 2G, not '%s'", option, text);
    *bytes = value > 1.0 ? (size_t)value : 1;
    return AUR_OK;
}

size_t cli_split_numbers(const char *text, size_t most, double *numbers) {
    size_t count = 0;
    for (const char *end = text; end != NULL; text = end + 1) {
        char piece[40] = "";
        end = strchr(text, ',');
        const size_t length = end != NULL ? (size_t)(end - text) : strlen(text);
        if (count == most || length >= sizeof piece)
            return 0;
        memcpy(piece, text, length);
        if (!aur_parse_double(piece, &numbers[count++]))
            return 0;
        if (end == NULL)
            break;
    }
    return count;
}
