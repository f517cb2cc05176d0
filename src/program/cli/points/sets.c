/* aureole sets: the table of all sets. */
#include <aureole/sphere.h>
#include <stdio.h>
#include <string.h>

#include "program/cli/listing.h"

/* The domains of a set: sets of the square are mapped to the other domains. */
static void add_domains(report_table *table, const aur_set_description *set) {
    enum {
        LIFTED =
            1 << AUR_DOMAIN_DISK | 1 << AUR_DOMAIN_HEMISPHERE | 1 << AUR_DOMAIN_SPHERE | 1 << AUR_DOMAIN_AXES
    };
    const bool square = (set->domains >> AUR_DOMAIN_SQUARE & 1u) != 0;
    const unsigned domains = square ? set->domains | LIFTED : set->domains;
    char text[160] = "";
    for (unsigned d = 0; aur_domain_name((aur_domain)d) != NULL; ++d) {
        const size_t used = strlen(text);
        if ((domains >> d & 1u) != 0)
            snprintf(text + used, sizeof text - used, "%s%s", used > 0 ? ", " : "",
                     aur_domain_name((aur_domain)d));
    }
    report_text(table, text);
}

/* "offset=0.5,epsilon=none" */
static void add_keys(report_table *table, const aur_row *row) {
    char text[512] = "";
    for (size_t i = 0; i < row->key_count; ++i) {
        const aur_key *const key = aur_row_key(row, i);
        const size_t used = strlen(text);
        snprintf(text + used, sizeof text - used, "%s%s%s%s", i > 0 ? "," : "", key->name,
                 key->default_text != NULL ? "=" : "", key->default_text != NULL ? key->default_text : "");
    }
    report_text(table, text);
}

static int run(const cli_call *call) {
    const report_format format = ((const cli_common *)call->options)->format;
    if (call->operand_count > 0)
        return cli_print_row("set", call->operands[0], format);
    static const char *const columns[] = {"set",        "keys",   "domains", "sizes",
                                          "extensible", "source", "summary"};
    report_table *const table = report_create(7, columns);
    for (size_t i = 0; i < aur_set_count(); ++i) {
        const aur_set_description *const set = aur_set_at(i);
        report_text(table, set->row.name);
        add_keys(table, &set->row);
        add_domains(table, set);
        char sizes[96];
        aur_set_sizes(set, sizeof sizes, sizes);
        report_text(table, sizes);
        report_text(table, set->extensible ? "yes" : "no");
        report_text(table, set->row.source);
        report_text(table, set->row.summary);
    }
    return cli_finish_listing(table, format);
}

const cli_command cli_command_sets = {
    .name = "sets",
    .summary = "list the point sets with parameters, domains, sizes, extensibility and sources",
    .notes = "A set is named NAME[:key=value[,key=value...]] or file:PATH.",
    .operands = {{"SET", "print the parameters of this set, as 'aureole help set' does", .optional = true,
                  .content = "set"}},
    .groups = {{cli_format_option, 0}},
    .size = sizeof(cli_common),
    .run = run,
};
