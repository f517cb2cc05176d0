#include "cli/plot.h"

#include <aureole/ranks.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "cli/cli.h"

static bool ends_with(const char *text, const char *end) {
    const size_t length = strlen(text), end_length = strlen(end);
    return length >= end_length && strcmp(text + length - end_length, end) == 0;
}

extern char **environ;

/* Starts gnuplot with its commands from plot->script and the picture as its output, so that no shell and no
 * command of gnuplot's ever reads a path. Returns an error number, 0 for none. */
static int start(cli_plot *plot, int picture) {
    int ends[2];
    if (pipe(ends) != 0)
        return errno;
    /* gnuplot must not hold the end that this program closes to say that the commands are over. */
    fcntl(ends[0], F_SETFD, FD_CLOEXEC);
    fcntl(ends[1], F_SETFD, FD_CLOEXEC);
    posix_spawn_file_actions_t actions;
    int failure = posix_spawn_file_actions_init(&actions);
    if (failure == 0) {
        posix_spawn_file_actions_adddup2(&actions, ends[0], STDIN_FILENO);
        posix_spawn_file_actions_adddup2(&actions, picture, STDOUT_FILENO);
        posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
        char name[] = "gnuplot";
        char *const arguments[] = {name, NULL};
        failure = posix_spawnp(&plot->process, name, &actions, NULL, arguments, environ);
        posix_spawn_file_actions_destroy(&actions);
    }
    close(ends[0]);
    plot->script = failure == 0 ? fdopen(ends[1], "w") : NULL;
    if (plot->script != NULL) {
        /* A gnuplot that ends early must be an error, not the end of this program. */
        signal(SIGPIPE, SIG_IGN);
        return 0;
    }
    close(ends[1]);
    return failure != 0 ? failure : ENOMEM;
}

/* What gnuplot calls the format, or NULL, which is said. */
static const char *terminal_of(const char *path) {
    static const char *const terminals[][2] = {{".svg", "svg"}, {".pdf", "pdfcairo"}, {".png", "pngcairo"}};
    for (size_t i = 0; i < sizeof terminals / sizeof terminals[0]; ++i)
        if (ends_with(path, terminals[i][0]))
            return terminals[i][1];
    cli_bad_usage("--plot: '%s' must end in .svg, .pdf or .png", path);
    return NULL;
}

bool cli_plot_can(const char *path) {
    return terminal_of(path) != NULL;
}

bool cli_plot_open(const char *path, int width, int height, cli_plot *plot) {
    *plot = (cli_plot){.path = path};
    const char *const terminal = terminal_of(path);
    if (terminal == NULL)
        return false;
    const bool pdf = strcmp(terminal, "pdfcairo") == 0;
    if (aur_ranks_rank() != 0) { /* rank 0 draws */
        plot->script = fopen("/dev/null", "w");
        return plot->script != NULL;
    }
    const size_t capacity = strlen(path) + 32;
    plot->temporary = malloc(capacity);
    if (plot->temporary == NULL) {
        cli_bad_usage("out of memory");
        return false;
    }
    snprintf(plot->temporary, capacity, "%s.tmp.%ld", path, (long)getpid());
    const int picture = open(plot->temporary, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    const int failure = picture < 0 ? errno : start(plot, picture);
    if (picture >= 0)
        close(picture);
    if (failure != 0) {
        if (picture < 0)
            cli_bad_usage("%s: cannot write: %s", path, strerror(failure));
        else
            cli_bad_usage("--plot: cannot start gnuplot: %s", strerror(failure));
        unlink(plot->temporary);
        free(plot->temporary);
        return false;
    }
    /* A sheet is measured in inches: 100 of what is a pixel elsewhere. */
    if (pdf)
        fprintf(plot->script, "set terminal %s size %d.%02d,%d.%02d\n", terminal, width / 100, width % 100,
                height / 100, height % 100);
    else
        fprintf(plot->script, "set terminal %s size %d,%d background rgb 'white'\n", terminal, width, height);
    return true;
}

void cli_plot_text(cli_plot *plot, const char *text) {
    for (const char *c = text; *c != '\0'; ++c)
        if (*c == '\'')
            fputs("''", plot->script);
        else
            fputc((unsigned char)*c < ' ' ? '?' : *c, plot->script);
}

int cli_plot_close(cli_plot *plot) {
    fputs("\nunset output\n", plot->script);
    fclose(plot->script);
    if (plot->process == 0)
        return CLI_SUCCESS;
    int status = 0;
    pid_t ended;
    do
        ended = waitpid(plot->process, &status, 0);
    while (ended < 0 && errno == EINTR);
    int result = CLI_SUCCESS;
    if (ended < 0 || status != 0) {
        cli_bad_usage("--plot: gnuplot did not draw '%s': is it installed?", plot->path);
        result = CLI_FAILURE;
    } else if (rename(plot->temporary, plot->path) != 0) {
        cli_bad_usage("%s: cannot write: %s", plot->path, strerror(errno));
        result = CLI_FAILURE;
    }
    if (result != CLI_SUCCESS)
        unlink(plot->temporary);
    free(plot->temporary);
    *plot = (cli_plot){0};
    return result;
}
