/* aureole help: the verbs, or one verb's options. */
#include <stdio.h>
#include <string.h>

#include "cli/cli.h"

void cli_print_verb_help(const cli_verb *verb) {
    printf("aureole %s %s\n\n%s\n", verb->name, verb->arguments, verb->summary);
    if (verb->help[0] != '\0')
        printf("\n%s", verb->help);
}

static int run(int argc, char **argv) {
    if (argc > 2)
        return cli_bad_usage("help: one verb at most");
    if (argc == 2) {
        for (size_t i = 0; i < cli_verb_count(); ++i) {
            if (strcmp(cli_verb_at(i)->name, argv[1]) == 0) {
                cli_print_verb_help(cli_verb_at(i));
                return CLI_SUCCESS;
            }
        }
        return cli_bad_usage("help: unknown verb '%s'", argv[1]);
    }
    printf("aureole: quasi-Monte Carlo points, weights and light transport\n\n");
    for (size_t i = 0; i < cli_verb_count(); ++i)
        printf("  %-9s %s\n", cli_verb_at(i)->name, cli_verb_at(i)->summary);
    printf("\n'aureole help VERB' shows a verb's options; 'aureole --version' the version.\n");
    return CLI_SUCCESS;
}

const cli_verb cli_verb_help = {"help", "[VERB]", "show the verbs, or the options of one", "", run};
