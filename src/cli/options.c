/* Reading the command line, with messages that say what would be right. */
#include <aureole/text.h>
#include <ctype.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/cli.h"

static int exit_status(aur_result result) {
    switch (result) {
    case AUR_OK:
        return CLI_SUCCESS;
    case AUR_ERROR_INTERNAL:
    case AUR_ERROR_MEMORY:
    case AUR_ERROR_CANCELLED:
    case AUR_ERROR_WRITE:
        return CLI_FAILURE;
    default:
        return CLI_BAD_INPUT;
    }
}

int cli_fail(const aur_error *error) {
    char text[AUR_ERROR_FILE_CAPACITY + AUR_ERROR_MESSAGE_CAPACITY + 64];
    aur_error_format(error, text, sizeof text);
    cli_progress_clear();
    fprintf(stderr, "aureole: %s\n", text[0] != '\0' ? text : aur_result_string(error->result));
    return exit_status(error->result);
}

int cli_bad_usage(const char *format, ...) {
    cli_progress_clear();
    fputs("aureole: ", stderr);
    va_list arguments;
    va_start(arguments, format);
    vfprintf(stderr, format, arguments);
    va_end(arguments);
    fputc('\n', stderr);
    return CLI_BAD_INPUT;
}

int cli_next_option(int argc, char **argv, const char *short_options, const struct option *long_options) {
    opterr = 0;
    const int value = getopt_long(argc, argv, short_options, long_options, NULL);
    if (value != '?')
        return value;
    const char *const at = optind > 0 && optind <= argc ? argv[optind - 1] : "";
    const bool is_short = optopt > 0 && optopt < 256 && isprint(optopt);
    const char *const known = is_short ? strchr(short_options, optopt) : NULL;
    if (known != NULL && known[1] == ':')
        cli_bad_usage("%s: option '-%c' needs a value: try 'aureole help %s'", argv[0], optopt, argv[0]);
    else if (is_short && (at[0] != '-' || at[1] != '-'))
        cli_bad_usage("%s: unknown option '-%c': try 'aureole help %s'", argv[0], optopt, argv[0]);
    else if (optopt != 0)
        cli_bad_usage("%s: option '%s' needs a value or takes none: try 'aureole help %s'", argv[0], at,
                      argv[0]);
    else
        cli_bad_usage("%s: unknown option '%s': try 'aureole help %s'", argv[0], at, argv[0]);
    return '?';
}

bool cli_parse_u64(const char *name, const char *text, uint64_t *value) {
    if (aur_parse_integer(text, UINT64_MAX, value))
        return true;
    cli_bad_usage("%s: '%s' is not a whole number", name, text);
    return false;
}

bool cli_parse_size(const char *name, const char *text, size_t minimum, size_t maximum, size_t *value) {
    uint64_t parsed;
    if (!cli_parse_u64(name, text, &parsed))
        return false;
    if (parsed < minimum || parsed > maximum) {
        if (maximum == SIZE_MAX)
            cli_bad_usage("%s: must be at least %zu, not %s", name, minimum, text);
        else
            cli_bad_usage("%s: must be between %zu and %zu, not %s", name, minimum, maximum, text);
        return false;
    }
    *value = (size_t)parsed;
    return true;
}

bool cli_parse_number(const char *name, const char *text, double minimum, double maximum, double *value) {
    double parsed;
    if (!aur_parse_double(text, &parsed)) {
        cli_bad_usage("%s: '%s' is not a number", name, text);
        return false;
    }
    if (parsed < minimum || parsed > maximum) {
        cli_bad_usage("%s: must be between %g and %g, not %s", name, minimum, maximum, text);
        return false;
    }
    *value = parsed;
    return true;
}

bool cli_parse_word(const char *name, const char *text, size_t count, const char *const *words,
                    size_t *value) {
    for (size_t i = 0; i < count; ++i) {
        if (strcmp(words[i], text) == 0) {
            *value = i;
            return true;
        }
    }
    char list[AUR_ERROR_MESSAGE_CAPACITY];
    aur_list_names(count, words, list, sizeof list);
    cli_bad_usage("%s: must be one of %s, not '%s'", name, list, text);
    return false;
}

bool cli_parse_sizes(const char *name, const char *text, size_t *count, size_t **values) {
    size_t pieces = 1;
    for (const char *c = text; *c != '\0'; ++c)
        pieces += *c == ',';
    char *const copy = strdup(text);
    *values = malloc(pieces * sizeof **values);
    *count = 0;
    bool good = copy != NULL && *values != NULL;
    char *rest = copy;
    while (good && rest != NULL) {
        char *const comma = strchr(rest, ',');
        if (comma != NULL)
            *comma = '\0';
        good = cli_parse_size(name, rest, 1, SIZE_MAX, &(*values)[*count]);
        ++*count;
        rest = comma != NULL ? comma + 1 : NULL;
    }
    free(copy);
    if (!good) {
        free(*values);
        *values = NULL;
    }
    return good;
}

bool cli_parse_format(const char *text, cli_format *format) {
    static const char *const words[] = {"table", "csv", "json"};
    size_t index = 0;
    if (!cli_parse_word("--format", text, 3, words, &index))
        return false;
    *format = (cli_format)index;
    return true;
}
