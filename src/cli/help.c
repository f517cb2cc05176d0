/* aureole help: the verbs, one verb's options, the kinds of things to choose from, and the keys of each
 * thing. */
#include <aureole/render.h>
#include <aureole/text.h>
#include <stdio.h>
#include <string.h>

#include "cli/cli.h"
#include "cli/verbs.h"

const aur_table *cli_table_at(size_t index) {
    size_t count = 0;
    while (aur_table_at(count) != NULL)
        ++count;
    return index < count ? aur_table_at(index) : aur_render_table_at(index - count);
}

static const aur_table *find_table(const char *kind) {
    for (size_t i = 0; cli_table_at(i) != NULL; ++i)
        if (strcmp(cli_table_at(i)->kind, kind) == 0)
            return cli_table_at(i);
    return NULL;
}

void cli_print_verb_help(const cli_verb *verb) {
    printf("aureole %s %s\n\n%s\n", verb->name, verb->arguments, verb->summary);
    if (verb->help[0] != '\0')
        printf("\n%s", verb->help);
}

static void add_keys(cli_table *table, const aur_row *row) {
    for (size_t i = 0; aur_row_key(row, i) != NULL; ++i) {
        const aur_key *const key = aur_row_key(row, i);
        char range[512];
        aur_key_range(key, sizeof range, range);
        cli_table_text(table, key->name);
        cli_table_text(table, aur_key_type_name(key->type));
        cli_table_text(table, key->default_text != NULL ? key->default_text : "");
        cli_table_text(table, range);
        cli_table_text(table, key->help);
    }
}

static int print_row(const aur_table *kind, const aur_row *row, cli_format format) {
    static const char *const columns[] = {"key", "type", "default", "values", "help"};
    if (format == CLI_TABLE)
        printf("%s %s: %s%s%s%s\n", kind->kind, row->name, row->summary, row->source[0] != '\0' ? " (" : "",
               row->source, row->source[0] != '\0' ? ")" : "");
    if (format == CLI_TABLE && row->key_count == 0 && kind->common == NULL)
        return CLI_SUCCESS;
    if (format == CLI_TABLE)
        printf("\n");
    cli_table *const table = cli_table_create(sizeof columns / sizeof columns[0], columns);
    add_keys(table, row);
    if (kind->common != NULL)
        add_keys(table, kind->common);
    const int status = cli_table_print(table, format);
    cli_table_destroy(table);
    return status;
}

static int print_kind(const aur_table *kind, cli_format format) {
    static const char *const columns[] = {"name", "summary", "source"};
    cli_table *const table = cli_table_create(sizeof columns / sizeof columns[0], columns);
    for (size_t i = 0; kind->row(i) != NULL; ++i) {
        cli_table_text(table, kind->row(i)->name);
        cli_table_text(table, kind->row(i)->summary);
        cli_table_text(table, kind->row(i)->source);
    }
    const int status = cli_table_print(table, format);
    cli_table_destroy(table);
    return status;
}

static int help_on_row(const aur_table *kind, const char *name, cli_format format) {
    enum { MOST_NAMES = 256 };
    const char *names[MOST_NAMES];
    size_t count = 0;
    for (; count < MOST_NAMES && kind->row(count) != NULL; ++count) {
        names[count] = kind->row(count)->name;
        if (strcmp(names[count], name) == 0)
            return print_row(kind, kind->row(count), format);
    }
    const char *const nearest = aur_nearest_name(name, count, names);
    if (nearest != NULL)
        return cli_bad_usage("help: unknown %s '%s'; did you mean '%s'?", kind->kind, name, nearest);
    return cli_bad_usage("help: unknown %s '%s': 'aureole help %s' lists them", kind->kind, name, kind->kind);
}

static int fail_topic(size_t verb_count, const cli_verb *const *verbs, const char *topic) {
    enum { MOST_NAMES = 64 };
    const char *names[MOST_NAMES];
    size_t count = 0;
    for (size_t i = 0; i < verb_count && count < MOST_NAMES; ++i)
        names[count++] = verbs[i]->name;
    for (size_t i = 0; cli_table_at(i) != NULL && count < MOST_NAMES; ++i)
        names[count++] = cli_table_at(i)->kind;
    const char *const nearest = aur_nearest_name(topic, count, names);
    if (nearest != NULL)
        return cli_bad_usage("help: unknown verb '%s'; did you mean '%s'?", topic, nearest);
    return cli_bad_usage("help: unknown verb '%s': 'aureole help' lists them", topic);
}

static int print_overview(size_t verb_count, const cli_verb *const *verbs) {
    printf("aureole: quasi-Monte Carlo points, weights and light transport\n\n");
    for (size_t i = 0; i < verb_count; ++i)
        printf("  %-10s %s\n", verbs[i]->name, verbs[i]->summary);
    printf(
        "\n'aureole help VERB' shows a verb's options; 'aureole --version' the version.\n"
        "'aureole help KIND' lists what there is of a kind, 'aureole help KIND NAME' the keys of one:\n\n");
    for (size_t i = 0; cli_table_at(i) != NULL; ++i)
        printf("  %-10s %s\n", cli_table_at(i)->kind, cli_table_at(i)->summary);
    return CLI_SUCCESS;
}

int cli_help(size_t verb_count, const cli_verb *const *verbs, int argc, char **argv) {
    static const struct option options[] = {{"format", required_argument, NULL, 'f'}, {0}};
    cli_format format = CLI_TABLE;
    bool as_table = false; /* a kind, where a verb has the same name */
    optind = 0;
    for (int option; (option = cli_next_option(argc, argv, "", options)) != -1; as_table = true)
        if (option != 'f' || !cli_parse_format(optarg, &format))
            return CLI_BAD_INPUT;
    const int count = argc - optind;
    if (count == 0)
        return print_overview(verb_count, verbs);
    const char *const topic = argv[optind];
    const aur_table *const kind = find_table(topic);
    for (size_t i = 0; i < verb_count && count == 1 && !as_table; ++i) {
        if (strcmp(verbs[i]->name, topic) == 0) {
            cli_print_verb_help(verbs[i]);
            return CLI_SUCCESS;
        }
    }
    if (kind == NULL && count == 1)
        return fail_topic(verb_count, verbs, topic);
    if (kind == NULL || count > 2)
        return cli_bad_usage("help: one verb, or a kind and a name: 'aureole help' lists them");
    return count == 1 ? print_kind(kind, format) : help_on_row(kind, argv[optind + 1], format);
}
