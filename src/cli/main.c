/* aureole: finds the verb and runs it. Adding a verb is one file, which defines cli_verb_<name>, and one
 * line here. */
#include <stdio.h>
#include <string.h>

#include "cli/verbs.h"

#define VERBS(ROW)                                                                                           \
    ROW(sets)                                                                                                \
    ROW(points)                                                                                              \
    ROW(measure)                                                                                             \
    ROW(weights)                                                                                             \
    ROW(render)                                                                                              \
    ROW(compare)                                                                                             \
    ROW(convert)                                                                                             \
    ROW(lab)                                                                                                 \
    ROW(info)                                                                                                \
    ROW(help)

#define DECLARE(name) extern const cli_verb cli_verb_##name;
VERBS(DECLARE)

static int run_help(int argc, char **argv);

const cli_verb cli_verb_help = {
    .name = "help",
    .arguments = "[VERB | KIND [NAME]] [--format table|csv|json]",
    .summary = "show the verbs, the options of one, or the keys of a thing",
    .help = "",
    .run = run_help,
};

#define ADDRESS(name) &cli_verb_##name,
static const cli_verb *const verbs[] = {VERBS(ADDRESS)};

enum { VERB_COUNT = sizeof verbs / sizeof verbs[0] };

static int run_help(int argc, char **argv) {
    return cli_help(VERB_COUNT, verbs, argc, argv);
}

static const cli_verb *find_verb(const char *name) {
    for (size_t i = 0; i < VERB_COUNT; ++i)
        if (strcmp(verbs[i]->name, name) == 0)
            return verbs[i];
    return NULL;
}

/* A result that cannot be delivered (a full disk behind standard output) is a failure. */
static int finish(int status) {
    if (fflush(stdout) != 0 || ferror(stdout)) {
        if (status == CLI_SUCCESS)
            fprintf(stderr, "aureole: cannot write standard output\n");
        return CLI_FAILURE;
    }
    return status;
}

int main(int argc, char **argv) {
    if (argc < 2) {
        char *help[] = {"help", NULL};
        run_help(1, help);
        return cli_bad_usage("a verb is missing: try 'aureole help'");
    }
    const char *const name = argv[1];
    if (strcmp(name, "--version") == 0) {
        printf("aureole %s\n", aur_version());
        return finish(CLI_SUCCESS);
    }
    if (strcmp(name, "--help") == 0 || strcmp(name, "-h") == 0)
        return finish(run_help(1, (char *[]){"help", NULL}));
    const cli_verb *const verb = find_verb(name);
    if (verb == NULL)
        return cli_bad_usage("unknown verb '%s': 'aureole help' lists them", name);
    for (int i = 2; i < argc && strcmp(argv[i], "--") != 0; ++i) {
        if (strcmp(argv[i], "--help") == 0) {
            cli_print_verb_help(verb);
            return finish(CLI_SUCCESS);
        }
    }
    return finish(verb->run(argc - 1, argv + 1));
}
