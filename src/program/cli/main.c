/* aureole: finds the command, parses its options and runs it. To add a command, add one file that defines
 * cli_command_<name>, and one line here. */
#include <aureole/text.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "program/cli/listing.h"

#define COMMANDS(ROW)                                                                                        \
    ROW(sets)                                                                                                \
    ROW(points)                                                                                              \
    ROW(measure)                                                                                             \
    ROW(nearest)                                                                                             \
    ROW(voronoi)                                                                                             \
    ROW(weights)                                                                                             \
    ROW(render)                                                                                              \
    ROW(irradiance)                                                                                          \
    ROW(merge)                                                                                               \
    ROW(viewfactors)                                                                                         \
    ROW(compare)                                                                                             \
    ROW(convert)                                                                                             \
    ROW(view)                                                                                                \
    ROW(lab)                                                                                                 \
    ROW(info)                                                                                                \
    ROW(completion)                                                                                          \
    ROW(manual)                                                                                              \
    ROW(help)

#define DECLARE(name) extern const cli_command cli_command_##name;
COMMANDS(DECLARE)

#define ADDRESS(name) &cli_command_##name,
static const cli_command *const commands[] = {COMMANDS(ADDRESS) NULL};

static const cli_command *find_command(const char *name) {
    for (size_t i = 0; commands[i] != NULL; ++i)
        if (strcmp(commands[i]->name, name) == 0)
            return commands[i];
    return NULL;
}

static int refuse_command(const char *name) {
    enum { COUNT = sizeof commands / sizeof commands[0] - 1 };
    const char *names[COUNT];
    for (size_t i = 0; i < COUNT; ++i)
        names[i] = commands[i]->name;
    const char *const nearest = aur_nearest_name(name, COUNT, names);
    if (nearest != NULL)
        return cli_bad_usage("unknown command '%s'; did you mean '%s'?", name, nearest);
    return cli_bad_usage("unknown command '%s': 'aureole help' lists the commands", name);
}

/* A failed write to standard output, such as to a full disk, is an error. */
static int finish(int status) {
    cli_progress_clear();
    if (fflush(stdout) != 0 || ferror(stdout)) {
        if (status != CLI_FAILURE) /* its error was printed */
            fprintf(stderr, "aureole: cannot write standard output\n");
        return CLI_FAILURE;
    }
    return status;
}

/* argv[0] is the command. */
static int run(const cli_command *command, int argc, char **argv) {
    if (command->absent != NULL)
        return cli_bad_usage("%s: needs %s, which this program was built without", command->name,
                             command->absent);
    for (int i = 1; i < argc && strcmp(argv[i], "--") != 0; ++i)
        if (strcmp(argv[i], "--help") == 0 || strcmp(argv[i], "-h") == 0)
            return cli_print_command_help(command);
    cli_call call = {.commands = commands, .options = calloc(1, command->size + 1)};
    int status = CLI_BAD_INPUT;
    if (call.options == NULL)
        status = cli_fail(&(aur_error){.result = AUR_ERROR_MEMORY, .message = "out of memory"});
    else if (cli_read_options(command, argc, argv, &call)) {
        cli_forgive_names(&call);
        status = cli_announce_outputs(&call);
        if (status == CLI_SUCCESS)
            status = command->run(&call);
    }
    free(call.options);
    return finish(status);
}

/* A parent may leave signals blocked or ignored, which exec preserves: services with signalfd block
 * termination signals, and an ignored SIGCHLD hides the importer's exit status. SIGHUP stays ignored, for
 * nohup. With SIGXFSZ ignored, a file beyond the size limit is a write error. */
static void reset_signals(void) {
    static const int ending[] = {SIGTERM, SIGALRM, SIGCHLD};
    for (size_t i = 0; i < sizeof ending / sizeof *ending; ++i)
        signal(ending[i], SIG_DFL);
    signal(SIGXFSZ, SIG_IGN);
    sigset_t none;
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, NULL);
}

int main(int argc, char **argv) {
    reset_signals();
    char *const name = argc < 2 ? "" : argv[1];
    const bool help = strcmp(name, "--help") == 0 || strcmp(name, "-h") == 0;
    if (argc < 2 || help) {
        const int status = run(&cli_command_help, 1, (char *[]){"help", NULL});
        return help ? status : cli_bad_usage("no command given: try 'aureole help'");
    }
    if (strcmp(name, "--version") == 0 || strcmp(name, "-V") == 0 || strcmp(name, "version") == 0) {
        printf("aureole %s\n", aur_version());
        return finish(CLI_SUCCESS);
    }
    const cli_command *const command = find_command(name);
    if (command == NULL)
        return refuse_command(name);
    return cli_run_ranks(command, argc - 1, argv + 1, run);
}
