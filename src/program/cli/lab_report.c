/* aureole lab report: a page of all that was run. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "program/cli/lab_run.h"
#include "program/cli/plot.h"
#include "program/lab/publish.h"

/* Where the plots for print go, and whether gnuplot has drawn all of them so far. */
typedef struct prints {
    const char *folder;
    bool fail;
} prints;

static bool print(void *user, const char *name, const report_table *table, const report_plot *plot) {
    enum { WIDTH = 500, HEIGHT = 360 }; /* of a panel */
    prints *const state = user;
    char path[AUR_ERROR_FILE_CAPACITY], *script = NULL;
    size_t bytes = 0;
    cli_plot drawn;
    snprintf(path, sizeof path, "%s/%s", state->folder, name);
    FILE *const memory = open_memstream(&script, &bytes);
    const int panels = memory != NULL ? (int)report_plot_script(memory, table, plot) : 0;
    if (memory == NULL || fclose(memory) != 0)
        state->fail = true;
    const int columns = panels < 2 ? 1 : 2, rows = panels < 2 ? 1 : (panels + 1) / 2;
    if (state->fail || !cli_plot_open(path, columns * WIDTH, rows * HEIGHT, &drawn)) {
        state->fail = true;
        free(script);
        return false;
    }
    fwrite(script, 1, bytes, drawn.script);
    free(script);
    const bool any = panels > 0;
    state->fail = cli_plot_close(&drawn) != CLI_SUCCESS;
    return any && !state->fail;
}

int cli_lab_report(const char *results, const char *folder, bool small) {
    if (mkdir(folder, 0777) != 0 && errno != EEXIST) {
        fprintf(stderr, "aureole: %s: cannot make the folder: %s\n", folder, strerror(errno));
        return CLI_FAILURE;
    }
    char path[AUR_ERROR_FILE_CAPACITY];
    aur_error error = {0};
    prints state = {.folder = folder};
    const lab_printer printer = {.print = print, .user = &state};
    snprintf(path, sizeof path, "%s/index.html", folder);
    const int status = cli_status(lab_publish(results, path, small, small ? NULL : &printer, &error), &error);
    if (status == CLI_SUCCESS)
        printf("%s\n", path);
    return status;
}
