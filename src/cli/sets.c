/* aureole sets: the table of all sets. */
#include <aureole/sphere.h>
#include <stdio.h>
#include <string.h>

#include "cli/cli.h"

/* Where a set's points can be: sets of the square come to the other domains by a map. */
static void add_domains(cli_table *table, const aur_set_description *set) {
    char text[160];
    const bool lifted = strstr(set->domains, "square") != NULL;
    snprintf(text, sizeof text, "%s%s", set->domains, lifted ? ", disk, hemisphere, sphere" : "");
    cli_table_text(table, text);
}

static int run(int argc, char **argv) {
    static const struct option options[] = {{"format", required_argument, NULL, 'f'}, {0}};
    cli_format format = CLI_TABLE;
    optind = 0;
    for (int option; (option = cli_next_option(argc, argv, "", options)) != -1;)
        if (option != 'f' || !cli_parse_format(optarg, &format))
            return CLI_BAD_INPUT;
    if (optind < argc)
        return cli_bad_usage("sets: unexpected argument '%s'", argv[optind]);
    static const char *const columns[] = {"set",        "keys",   "domains", "sizes",
                                          "extensible", "source", "summary"};
    cli_table *const table = cli_table_create(7, columns);
    for (size_t i = 0; i < aur_set_count(); ++i) {
        const aur_set_description *const set = aur_set_at(i);
        cli_table_text(table, set->name);
        cli_table_text(table, set->keys);
        add_domains(table, set);
        cli_table_text(table, set->sizes);
        cli_table_text(table, set->extensible ? "yes" : "no");
        cli_table_text(table, set->source);
        cli_table_text(table, set->summary);
    }
    const int status = cli_table_print(table, format);
    cli_table_destroy(table);
    return status;
}

const cli_verb cli_verb_sets = {
    "sets",
    "[--format table|csv|json]",
    "list the point sets: keys, domains, sizes, extensible or not, source",
    "A set is named NAME[:key=value[,key=value...]] or file:PATH.\n",
    run,
};
