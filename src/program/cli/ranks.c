#include "program/cli/listing.h"

#include <aureole/ranks.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* Redirects the standard error of a rank other than 0 to an unnamed temporary file, from which rank 0 can
 * print an error. NULL on failure. */
static FILE *redirect_output(void) {
    FILE *const messages = tmpfile();
    if (freopen("/dev/null", "w", stdout) == NULL || messages == NULL)
        return messages;
    fflush(stderr);
    dup2(fileno(messages), STDERR_FILENO);
    return messages;
}

/* Reads the end of the output, which has the error. */
static void read_last_message(FILE *messages, size_t capacity, char *text) {
    text[0] = '\0';
    if (messages == NULL)
        return;
    fflush(stderr);
    fseek(messages, 0, SEEK_END);
    const long size = ftell(messages), most = (long)capacity - 1;
    fseek(messages, size > most ? size - most : 0, SEEK_SET);
    text[fread(text, 1, capacity - 1, messages)] = '\0';
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
    const bool prints = aur_ranks_rank() == 0;
    FILE *const messages = prints ? NULL : redirect_output();
    int status = joined == AUR_OK ? run(command, argc, argv) : cli_fail(&error);
    char text[512] = "";
    error = (aur_error){0};
    read_last_message(messages, sizeof text, text);
    const int all = aur_ranks_leave(status, text, &error);
    if (status == CLI_SUCCESS && all != CLI_SUCCESS && prints)
        cli_fail(&error);
    if (messages != NULL)
        fclose(messages);
    return all;
}
