/* aureole help: the list of commands, the options of a command, the kinds of components, and the keys of a
 * component. */
#include <aureole/text.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "program/cli/listing.h"

enum { OPTION_COLUMN = 26, NAME_COLUMN = 14 };

static void print_option(const cli_option *option) {
    char what[CLI_WORDS_CAPACITY], help[CLI_HELP_CAPACITY];
    cli_write_option(option, true, what);
    cli_write_option_help(option, help);
    cli_print_entry(what, OPTION_COLUMN, help);
}

int cli_print_command_help(const cli_command *command) {
    printf("aureole %s", command->name);
    for (const cli_operand *operand = command->operands; operand->word != NULL; ++operand)
        printf(" %s%s%s%s", operand->optional ? "[" : "", operand->word, operand->repeated ? "..." : "",
               operand->optional ? "]" : "");
    puts(cli_option_at(command, 0, NULL) != NULL ? " [OPTION...]\n" : "\n");
    cli_print_paragraph(0, 0, command->summary);
    putchar('\n');
    for (const cli_operand *operand = command->operands; operand->word != NULL; ++operand)
        cli_print_entry(operand->word, OPTION_COLUMN, operand->help);
    if (command->operands[0].word != NULL)
        putchar('\n');
    const cli_option *option;
    for (size_t i = 0; (option = cli_option_at(command, i, NULL)) != NULL; ++i)
        print_option(option);
    if (command->notes != NULL) {
        putchar('\n');
        cli_print_paragraph(0, 0, command->notes);
    }
    return CLI_SUCCESS;
}

/* Adds a row to the table of keys or options. */
static void add_key(report_table *table, const aur_key *key, const char *name, const char *type,
                    const char *values) {
    report_text(table, name);
    report_text(table, type);
    report_text(table, key->default_text);
    report_text(table, values);
    report_text(table, key->help);
}

static const char *const key_columns[] = {"key", "type", "default", "values", "help"};
enum { KEY_COLUMNS = sizeof key_columns / sizeof key_columns[0] };

static void add_keys(report_table *table, const aur_row *row) {
    for (size_t i = 0; aur_row_key(row, i) != NULL; ++i) {
        const aur_key *const key = aur_row_key(row, i);
        char range[CLI_WORDS_CAPACITY];
        aur_key_range(key, sizeof range, range);
        add_key(table, key, key->name, aur_key_type_name(key->type), range);
    }
}

/* Prints the keys of a row as text. */
static void print_keys(const aur_row *row) {
    for (size_t i = 0; aur_row_key(row, i) != NULL; ++i) {
        const aur_key *const key = aur_row_key(row, i);
        char what[CLI_WORDS_CAPACITY], help[CLI_HELP_CAPACITY];
        cli_write_key(key, what);
        cli_write_key_help(key, help);
        cli_print_entry(what, OPTION_COLUMN, help);
    }
}

static int print_row(const aur_table *kind, const aur_row *row, report_format format) {
    if (format != REPORT_TABLE) {
        report_table *const table = report_create(KEY_COLUMNS, key_columns);
        add_keys(table, row);
        if (kind->common != NULL)
            add_keys(table, kind->common);
        return cli_finish(table, format);
    }
    const bool sourced = row->source != NULL && row->source[0] != '\0';
    char text[CLI_HELP_CAPACITY];
    aur_format(text, sizeof text, "%s %s: %s%s%s%s", kind->kind, row->name, row->summary, sourced ? " (" : "",
               sourced ? row->source : "", sourced ? ")" : "");
    cli_print_paragraph(0, 0, text);
    if (row->key_count > 0 || kind->common != NULL)
        putchar('\n');
    print_keys(row);
    if (kind->common != NULL)
        print_keys(kind->common);
    return CLI_SUCCESS;
}

static int print_kind(const aur_table *kind, report_format format) {
    report_table *const table = report_create(3, (const char *const[]){"name", "summary", "source"});
    for (size_t i = 0; i < kind->count; ++i) {
        report_text(table, kind->rows[i]->name);
        report_text(table, kind->rows[i]->summary);
        report_text(table, kind->rows[i]->source);
    }
    return cli_finish_listing(table, format);
}

/* Prints the options of a command as a table for programs. */
static int print_options(const cli_command *command, report_format format) {
    report_table *const table = report_create(KEY_COLUMNS, key_columns);
    const cli_option *option;
    for (size_t i = 0; (option = cli_option_at(command, i, NULL)) != NULL; ++i) {
        char what[CLI_WORDS_CAPACITY], values[CLI_WORDS_CAPACITY];
        const bool choice = option->name != NULL || option->key.type == AUR_KEY_CHOICE;
        cli_write_option(option, false, what);
        cli_list_values(option, values);
        add_key(table, &option->key, what,
                option->value == NULL ? "flag"
                : choice              ? "choice"
                                      : aur_key_type_name(option->key.type),
                option->value != NULL ? values : "");
    }
    return cli_finish(table, format);
}

static int print_commands(const cli_command *const *commands, report_format format) {
    report_table *const table = report_create(2, (const char *const[]){"name", "summary"});
    for (; *commands != NULL; ++commands) {
        report_text(table, (*commands)->name);
        report_text(table, (*commands)->summary);
    }
    return cli_finish_listing(table, format);
}

static int print_overview(const cli_command *const *commands) {
    printf("aureole: quasi-Monte Carlo points, weights and light transport\n\n");
    for (; *commands != NULL; ++commands)
        cli_print_entry((*commands)->name, NAME_COLUMN, (*commands)->summary);
    cli_print_paragraph(
        0, 0,
        "\n'aureole help COMMAND' prints the options of a command, 'aureole --version' the version. 'aureole "
        "help KIND' lists the plugins of a kind, 'aureole help KIND NAME' the parameters of one:\n");
    for (size_t i = 0; cli_table_at(i) != NULL; ++i)
        cli_print_entry(cli_table_at(i)->kind, NAME_COLUMN, cli_table_at(i)->summary);
    return CLI_SUCCESS;
}

/* Completes `aureole help`: commands and kinds, or the rows of a kind. */
typedef struct name_list {
    size_t count;
    const char *names[CLI_NAME_LIMIT];
} name_list;

static void add_name(name_list *list, const char *name) {
    if (list->count < CLI_NAME_LIMIT)
        list->names[list->count++] = name;
}

static int refuse_name(const name_list *list, const char *kind, const char *name, const char *topic) {
    const char *const nearest = aur_nearest_name(name, list->count, list->names);
    if (nearest != NULL)
        return cli_bad_usage("help: unknown %s '%s'; did you mean '%s'?", kind, name, nearest);
    return cli_bad_usage("help: unknown %s '%s': 'aureole help%s' lists them", kind, name, topic);
}

static int help_on_row(const aur_table *kind, const char *name, report_format format) {
    name_list list = {0};
    for (size_t i = 0; i < kind->count; ++i) {
        add_name(&list, kind->rows[i]->name);
        if (strcmp(kind->rows[i]->name, name) == 0)
            return print_row(kind, kind->rows[i], format);
    }
    char topic[64];
    aur_format(topic, sizeof topic, " %s", kind->kind);
    return refuse_name(&list, kind->kind, name, topic);
}

int cli_print_row(const char *kind, const char *name, report_format format) {
    return help_on_row(cli_find_table(kind), name, format);
}

static int help_on_command(const cli_command *const *commands, const char *name, report_format format,
                           bool or_kind) {
    name_list list = {0};
    for (; *commands != NULL; ++commands) {
        add_name(&list, (*commands)->name);
        if (strcmp((*commands)->name, name) == 0)
            return format == REPORT_TABLE ? cli_print_command_help(*commands)
                                          : print_options(*commands, format);
    }
    for (size_t i = 0; or_kind && cli_table_at(i) != NULL; ++i)
        add_name(&list, cli_table_at(i)->kind);
    return refuse_name(&list, "command", name, "");
}

/* Deprecated names of version 0.1, to be removed in the next version. */
static const char *current_name(const char *topic) {
    return strcmp(topic, "picture") == 0 ? "image" : strcmp(topic, "verb") == 0 ? "command" : topic;
}

static int run(const cli_call *call) {
    const report_format format = ((const cli_common *)call->options)->format;
    if (call->operand_count == 0)
        return print_overview(call->commands);
    const char *const topic = current_name(call->operands[0]);
    const char *const name = call->operand_count > 1 ? call->operands[1] : NULL;
    if (strcmp(topic, "command") == 0)
        return name != NULL ? help_on_command(call->commands, name, format, false)
                            : print_commands(call->commands, format);
    const aur_table *const kind = cli_find_table(topic);
    if (kind == NULL && name != NULL)
        return cli_bad_usage("help: %s: 'aureole help' lists them", call->command->too_many);
    if (name != NULL)
        return help_on_row(kind, name, format);
    /* If a command and a kind have the same name, machine-readable formats describe the kind. */
    bool command_too = false;
    for (size_t i = 0; call->commands[i] != NULL; ++i)
        command_too = command_too || strcmp(call->commands[i]->name, topic) == 0;
    if (kind != NULL && (!command_too || format != REPORT_TABLE))
        return print_kind(kind, format);
    return help_on_command(call->commands, topic, format, true);
}

const cli_command cli_command_help = {
    .name = "help",
    .summary = "print the commands, the options of a command, or the parameters of a plugin",
    .too_many = "expected one command, or a kind and a name",
    .operands = {{"TOPIC", "a command, a kind of plugins, or the word command", .optional = true,
                  .content = "topic"},
                 {"NAME", "one plugin of that kind", .optional = true, .content = "row"}},
    .groups = {{cli_format_option, 0}},
    .size = sizeof(cli_common),
    .run = run,
};
