/* Pictures by gnuplot. It reads its commands from one private file and draws into another, both without a
 * name: no shell and no command of gnuplot's ever reads a path, and what gnuplot does not say, a picture that
 * was cut, is looked for before the file of the user is replaced. */
#if defined(__linux__) && !defined(_GNU_SOURCE)
#define _GNU_SOURCE /* memfd_create */
#endif
#include "program/cli/plot.h"

#include <aureole/core.h>
#include <aureole/ranks.h>
#include <errno.h>
#include <fcntl.h>
#include <spawn.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "program/cli/cli.h"

/* What a name ends in, gnuplot's name of the format, and the end of a whole picture. */
typedef struct plot_format {
    const char *ending, *terminal, *end;
} plot_format;

static const plot_format formats[] = {
    {".svg", "svg", "</svg>"}, {".pdf", "pdfcairo", "%%EOF"}, {".png", "pngcairo", "IEND\xae\x42\x60\x82"}};

static bool ends_with(size_t length, const char *text, const char *end) {
    const size_t end_length = strlen(end);
    return length >= end_length && memcmp(text + length - end_length, end, end_length) == 0;
}

/* The format by the file's name, or NULL, which is said. */
static const plot_format *format_of(const char *path) {
    for (size_t i = 0; i < sizeof formats / sizeof *formats; ++i)
        if (ends_with(strlen(path), path, formats[i].ending))
            return &formats[i];
    cli_bad_usage("--plot: '%s' must end in .svg, .pdf or .png", path);
    return NULL;
}

bool cli_plot_can(const char *path) {
    return format_of(path) != NULL;
}

/* A file without a name, in memory where the system has such files. */
static FILE *private_file(void) {
#if defined(MFD_CLOEXEC)
    const int descriptor = memfd_create("aureole-plot", MFD_CLOEXEC);
    if (descriptor >= 0)
        return fdopen(descriptor, "w+");
#endif
    return tmpfile();
}

bool cli_plot_open(const char *path, int width, int height, cli_plot *plot) {
    *plot = (cli_plot){.path = path};
    const plot_format *const format = format_of(path);
    if (format == NULL)
        return false;
    plot->script = aur_ranks_rank() == 0 ? private_file() : fopen("/dev/null", "w"); /* rank 0 draws */
    if (plot->script == NULL) {
        cli_bad_usage("--plot: cannot write for gnuplot: %s", strerror(errno));
        return false;
    }
    /* A sheet is measured in inches: 100 of what is a pixel elsewhere. */
    if (strcmp(format->ending, ".pdf") == 0)
        fprintf(plot->script, "set terminal %s size %d.%02d,%d.%02d\n", format->terminal, width / 100,
                width % 100, height / 100, height % 100);
    else
        fprintf(plot->script, "set terminal %s size %d,%d background rgb 'white'\n", format->terminal, width,
                height);
    return true;
}

void cli_plot_text(cli_plot *plot, const char *text) {
    for (const char *c = text; *c != '\0'; ++c)
        if (*c == '\'')
            fputs("''", plot->script);
        else
            fputc((unsigned char)*c < ' ' ? '?' : *c, plot->script);
}

extern char **environ;

/* Runs gnuplot from one file into the other. Returns what is wrong, or NULL. */
static const char *run_gnuplot(FILE *script, FILE *picture) {
    posix_spawn_file_actions_t actions;
    if (posix_spawn_file_actions_init(&actions) != 0)
        return "out of memory";
    posix_spawn_file_actions_adddup2(&actions, fileno(script), STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, fileno(picture), STDOUT_FILENO);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    char name[] = "gnuplot";
    char *const arguments[] = {name, NULL};
    pid_t process, ended;
    const int failure = posix_spawnp(&process, name, &actions, NULL, arguments, environ);
    posix_spawn_file_actions_destroy(&actions);
    if (failure != 0)
        return strerror(failure);
    int status = 0;
    do
        ended = waitpid(process, &status, 0);
    while (ended < 0 && errno == EINTR);
    return ended == process && status == 0 ? NULL : "it failed: is it installed?";
}

/* The whole picture, to be freed; NULL where it was cut. */
static char *whole_picture(FILE *picture, const char *end, size_t *size) {
    struct stat status;
    if (fstat(fileno(picture), &status) != 0)
        return NULL;
    *size = (size_t)status.st_size;
    char *const data = malloc(*size + 1);
    size_t last = *size;
    if (data != NULL && (fseek(picture, 0, SEEK_SET) != 0 || fread(data, 1, *size, picture) != *size))
        last = 0;
    while (data != NULL && last > 0 && (data[last - 1] == '\n' || data[last - 1] == '\r'))
        --last;
    if (data != NULL && ends_with(last, data, end))
        return data;
    free(data);
    return NULL;
}

/* What is wrong, or NULL. */
static const char *draw(const cli_plot *plot, char **data, size_t *size) {
    fputs("\nunset output\n", plot->script);
    if (fflush(plot->script) != 0 || ferror(plot->script) || fseek(plot->script, 0, SEEK_SET) != 0)
        return strerror(errno != 0 ? errno : EIO);
    FILE *const picture = private_file();
    if (picture == NULL)
        return strerror(errno);
    const char *wrong = run_gnuplot(plot->script, picture);
    if (wrong == NULL) {
        *data = whole_picture(picture, format_of(plot->path)->end, size);
        wrong = *data == NULL ? "its picture is not whole" : NULL;
    }
    fclose(picture);
    return wrong;
}

int cli_plot_close(cli_plot *plot) {
    int status = CLI_SUCCESS;
    if (aur_ranks_rank() == 0) {
        char *data = NULL;
        size_t size = 0;
        aur_error error = {0};
        errno = 0;
        const char *const wrong = draw(plot, &data, &size);
        if (wrong != NULL) {
            cli_bad_usage("--plot: gnuplot did not draw '%s': %s", plot->path, wrong);
            status = CLI_FAILURE;
        } else {
            status = cli_status(aur_file_write(plot->path, size, data, &error), &error);
        }
        free(data);
    }
    fclose(plot->script);
    *plot = (cli_plot){0};
    return status;
}
