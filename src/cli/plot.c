#include "cli/plot.h"

#include <errno.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/cli.h"

static bool ends_with(const char *text, const char *end) {
    const size_t length = strlen(text), end_length = strlen(end);
    return length >= end_length && strcmp(text + length - end_length, end) == 0;
}

bool cli_plot_open(const char *path, int width, int height, cli_plot *plot) {
    *plot = (cli_plot){.path = path};
    const char *const terminal = ends_with(path, ".svg")   ? "svg"
                                 : ends_with(path, ".png") ? "pngcairo"
                                                           : NULL;
    if (terminal == NULL) {
        cli_bad_usage("--plot: '%s' must end in .svg or .png", path);
        return false;
    }
    const size_t capacity = strlen(path) + 32;
    plot->temporary = malloc(capacity);
    if (plot->temporary == NULL) {
        cli_bad_usage("out of memory");
        return false;
    }
    snprintf(plot->temporary, capacity, "%s.tmp.%ld", path, (long)getpid());
    FILE *const probe = fopen(plot->temporary, "wb");
    if (probe == NULL) {
        cli_bad_usage("%s: cannot write: %s", path, strerror(errno));
        free(plot->temporary);
        return false;
    }
    fclose(probe);
    /* A gnuplot that is not there must be an error, not the end of this program. */
    signal(SIGPIPE, SIG_IGN);
    plot->script = popen("exec gnuplot >/dev/null 2>&1", "w");
    if (plot->script == NULL) {
        cli_bad_usage("--plot: cannot start gnuplot: %s", strerror(errno));
        unlink(plot->temporary);
        free(plot->temporary);
        return false;
    }
    fprintf(plot->script, "set terminal %s size %d,%d background rgb 'white'\nset output '", terminal, width,
            height);
    for (const char *c = plot->temporary; *c != '\0'; ++c)
        fprintf(plot->script, *c == '\'' ? "''" : "%c", *c);
    fputs("'\n", plot->script);
    return true;
}

int cli_plot_close(cli_plot *plot) {
    fputs("\nunset output\n", plot->script);
    const int status = pclose(plot->script);
    int result = CLI_SUCCESS;
    if (status != 0) {
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
