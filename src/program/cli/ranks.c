#include "program/cli/listing.h"

#include <aureole/ranks.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* What a rank after the first one says goes to a file without a name, for rank 0 to tell if it was an error.
 * NULL where there is none. */
static FILE *hush(void) {
    FILE *const said = tmpfile();
    if (freopen("/dev/null", "w", stdout) == NULL || said == NULL)
        return said;
    fflush(stderr);
    dup2(fileno(said), STDERR_FILENO);
    return said;
}

/* The last of what was said, which is where errors stand. */
static void read_said(FILE *said, size_t capacity, char *text) {
    text[0] = '\0';
    if (said == NULL)
        return;
    fflush(stderr);
    fseek(said, 0, SEEK_END);
    const long size = ftell(said), most = (long)capacity - 1;
    fseek(said, size > most ? size - most : 0, SEEK_SET);
    text[fread(text, 1, capacity - 1, said)] = '\0';
    text[strcspn(text, "\n")] = '\0';
}

int cli_run_ranks(const cli_command *command, int argc, char **argv,
                  int (*run)(const cli_command *command, int argc, char **argv)) {
    const size_t count = aur_ranks_started();
    if (count < 2)
        return run(command, argc, argv);
    if (!command->ranks)
        return cli_bad_usage("%s: the work of one process, and mpirun has started %zu", command->name, count);
    aur_error error = {0};
    const aur_result joined = aur_ranks_join(&error);
    const bool speaks = aur_ranks_rank() == 0;
    FILE *const said = speaks ? NULL : hush();
    int status = joined == AUR_OK ? run(command, argc, argv) : cli_fail(&error);
    char text[512] = "";
    error = (aur_error){0};
    read_said(said, sizeof text, text);
    const int all = aur_ranks_leave(status, text, &error);
    if (status == CLI_SUCCESS && all != CLI_SUCCESS && speaks)
        cli_fail(&error);
    if (said != NULL)
        fclose(said);
    return all;
}
