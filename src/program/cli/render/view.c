/* aureole view: shows images in a page in the browser. */
#include <errno.h>
#include <fcntl.h>
#include <spawn.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "program/cli/render/image_input.h"

typedef struct view_options {
    const char *output;
    double exposure;
    cli_image_input input;
} view_options;

static const cli_option options[] = {
    {CLI_TEXT(view_options, output, "output", "FILE", "a new file in $TMPDIR or /tmp", "output page"),
     .letter = 'o', .key.computed = true, .content = "file", .writes = true},
    {CLI_REAL(view_options, exposure, "exposure", "STOPS", -100, 100, "0", "initial exposure")},
    {.key = {0}}};

extern char **environ;

static bool is_set(const char *variable) {
    const char *const value = getenv(variable);
    return value != NULL && value[0] != '\0';
}

/* Opens the page in the browser, on a desktop and with a terminal. On failure the user has the printed path.
 */
static void open_page(char *path) {
    if (!isatty(STDOUT_FILENO) || (!is_set("DISPLAY") && !is_set("WAYLAND_DISPLAY")))
        return;
    char program[] = "xdg-open";
    char *const arguments[] = {program, path, NULL};
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    if (posix_spawn_file_actions_init(&actions) != 0)
        return;
    if (posix_spawnattr_init(&attributes) != 0) {
        posix_spawn_file_actions_destroy(&actions);
        return;
    }
    /* A separate process group survives if the terminal closes immediately. */
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    for (int stream = STDIN_FILENO; stream <= STDERR_FILENO; ++stream)
        posix_spawn_file_actions_addopen(&actions, stream, "/dev/null", O_RDWR, 0);
    pid_t child;
    posix_spawnp(&child, program, &actions, &attributes, arguments, environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
}

static int run(const cli_call *call) {
    const view_options *const given = call->options;
    const char *const root = getenv("TMPDIR");
    char path[AUR_ERROR_FILE_CAPACITY], folder[AUR_ERROR_FILE_CAPACITY] = "";
    if (given->output != NULL) {
        snprintf(path, sizeof path, "%s", given->output);
    } else {
        snprintf(path, sizeof path, "%.900s/aureole-view-XXXXXX",
                 root != NULL && root[0] != '\0' ? root : "/tmp");
        if (mkdtemp(path) == NULL) {
            fprintf(stderr, "aureole: %s: cannot make the folder: %s\n", path, strerror(errno));
            return CLI_FAILURE;
        }
        memcpy(folder, path, sizeof folder);
        memcpy(path + strlen(path), "/index.html", sizeof "/index.html");
    }
    const int status =
        cli_write_viewer(path, call->operand_count, call->operands, &given->input, given->exposure, false);
    if (status != CLI_SUCCESS && folder[0] != '\0')
        rmdir(folder); /* it is empty */
    if (status == CLI_SUCCESS && strcmp(path, "-") != 0)
        printf("%s\n", path);
    if (status == CLI_SUCCESS && given->output == NULL)
        open_page(path);
    return status;
}

const cli_command cli_command_view = {
    .name = "view",
    .summary = "write a page that shows images: flip, slider, differences, values",
    .notes = "The page is one file and needs no network. It shows the values of the images as 16-bit floats. "
             "The path of the page is printed; without -o, in a desktop terminal, the browser opens it.",
    .too_few = "no image given",
    .operands = {{"IMAGE", "images of the same size", .repeated = true, .content = "file"}},
    .groups = {{options, 0}, {cli_image_input_options, offsetof(view_options, input)}},
    .size = sizeof(view_options),
    .run = run,
};
