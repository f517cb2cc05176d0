#include "program/cli/listing.h"

#include <aureole/text.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { LINE_WIDTH = 80, WIDEST_NAME = 22 };

/* The length of the next word, or of the part of a list without spaces that fits in a line. */
static size_t word_length(const char *text, size_t space) {
    const size_t length = strcspn(text, " \n");
    size_t fitting = length;
    while (length > space && fitting > 0 && (fitting > space || text[fitting - 1] != ','))
        --fitting;
    return fitting > 0 ? fitting : length;
}

void cli_print_paragraph(size_t column, size_t indent, const char *text) {
    while (*text != '\0') {
        const size_t length = word_length(text, LINE_WIDTH - indent);
        const bool cut = text[length] != '\0' && text[length] != ' ' && text[length] != '\n';
        if (column > indent && column + 1 + length > LINE_WIDTH) {
            printf("\n%*s", (int)indent, "");
            column = indent;
        } else if (column > indent) {
            putchar(' ');
            ++column;
        }
        printf("%.*s", (int)length, text);
        column += length;
        text += length;
        if (*text == '\n') {
            printf("\n%*s", (int)indent, "");
            column = indent;
        }
        text += *text != '\0' && !cut;
    }
    putchar('\n');
}

void cli_print_entry(const char *what, int column, const char *help) {
    const int length = printf("  %s", what);
    if (length >= column)
        printf("\n%*s", column, "");
    else
        printf("%*s", column - length, "");
    cli_print_paragraph((size_t)column, (size_t)column, help);
}

void cli_write_option(const cli_option *option, bool aligned, char text[CLI_WORDS_CAPACITY]) {
    const char *const name = option->key.name;
    const char *const value = option->value != NULL ? option->value : "";
    char letter[8] = "";
    if (name[1] == '\0')
        aur_format(text, CLI_WORDS_CAPACITY, "-%s %s", name, value);
    if (name[1] == '\0')
        return;
    if (option->letter != '\0')
        aur_format(letter, sizeof letter, "-%c, ", option->letter);
    const char *const between = value[0] == '\0' ? "" : option->value_is_optional ? "[=" : " ";
    aur_format(text, CLI_WORDS_CAPACITY, "%*s--%s%s%s%s", aligned ? 4 : 0, letter, name, between, value,
               option->value_is_optional ? "]" : "");
    const size_t used = strlen(text);
    if (option->list)
        aur_format(text + used, CLI_WORDS_CAPACITY - used, "[,%s...]", value);
}

void cli_list_values(const cli_option *option, char text[CLI_WORDS_CAPACITY]) {
    aur_key_range(&option->key, CLI_WORDS_CAPACITY, text);
    for (unsigned i = 0; option->name != NULL && option->name(i) != NULL; ++i) {
        const size_t used = i > 0 ? strlen(text) : 0;
        aur_format(text + used, CLI_WORDS_CAPACITY - used, "%s%s", i > 0 ? ", " : "", option->name(i));
    }
}

/* "HELP: a, b (default: a)" or "HELP [1 .. 2] (default: 1)" */
static void write_help(const aur_key *key, bool named, const char *values, char text[CLI_HELP_CAPACITY]) {
    const char *const preset = key->default_text;
    const bool shown = values[0] != '\0';
    aur_format(text, CLI_HELP_CAPACITY, "%s%s%s%s%s%s%s", key->help, shown ? named ? ": " : " [" : "", values,
               shown && !named ? "]" : "", preset != NULL ? " (default: " : "", preset != NULL ? preset : "",
               preset != NULL ? ")" : "");
}

/* The range of all numbers from 0 is not printed. */
static bool is_open(const aur_key *key) {
    return key->minimum == 0.0 && isinf(key->maximum);
}

void cli_write_option_help(const cli_option *option, char text[CLI_HELP_CAPACITY]) {
    char values[CLI_WORDS_CAPACITY];
    cli_list_values(option, values);
    const bool shown = option->value != NULL && !is_open(&option->key);
    write_help(&option->key, cli_option_name(option, 0) != NULL, shown ? values : "", text);
}

void cli_write_key(const aur_key *key, char text[CLI_WORDS_CAPACITY]) {
    const bool named = key->type == AUR_KEY_CHOICE || key->type == AUR_KEY_ITEM;
    aur_format(text, CLI_WORDS_CAPACITY, "%s%s%s", key->name, named ? "" : "=",
               named ? "" : aur_key_type_name(key->type));
}

void cli_write_key_help(const aur_key *key, char text[CLI_HELP_CAPACITY]) {
    char values[CLI_WORDS_CAPACITY];
    aur_key_range(key, sizeof values, values);
    write_help(key, key->words != NULL, is_open(key) ? "" : values, text);
}

/* "keys: base=auto; sizes: 1..2^48" */
static void write_details(const report_table *table, size_t row, size_t summary, size_t capacity,
                          char *text) {
    size_t used = 0;
    text[0] = '\0';
    for (size_t c = 1; c < report_columns(table) && used < capacity; ++c) {
        const char *const cell = report_cell(table, row, c);
        if (c != summary && cell[0] != '\0')
            used += aur_format(text + used, capacity - used, "%s%s: %s", used > 0 ? "; " : "",
                               report_column_name(table, c), cell);
    }
}

int cli_finish_listing(report_table *table, report_format format) {
    if (format != REPORT_TABLE || report_failed(table)) /* cli_finish reports the error */
        return cli_finish(table, format);
    const size_t named = report_find(table, "summary");
    const size_t summary = named < report_columns(table) ? named : report_columns(table) - 1;
    size_t widest = 0;
    for (size_t i = 0; i < report_rows(table); ++i) {
        const size_t width = strlen(report_cell(table, i, 0));
        widest = width > widest && width <= WIDEST_NAME ? width : widest;
    }
    const int column = (int)widest + 4;
    for (size_t i = 0; i < report_rows(table); ++i) {
        char details[CLI_HELP_CAPACITY];
        write_details(table, i, summary, sizeof details, details);
        cli_print_entry(report_cell(table, i, 0), column, report_cell(table, i, summary));
        if (details[0] == '\0')
            continue;
        printf("%*s", column, "");
        cli_print_paragraph((size_t)column, (size_t)column, details);
    }
    report_destroy(table);
    return CLI_SUCCESS;
}
