/* Reads result tables. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "program/report/report.h"

static aur_result fail_in(const char *path, size_t line, aur_result result, const char *what,
                          aur_error *error) {
    aur_fail(error, result, "%s", what);
    if (error != NULL) {
        snprintf(error->file, sizeof error->file, "%s", path);
        error->line = line;
    }
    return result;
}

/* The next field of a CSV line, unquoted in place; *next is the rest after its comma, NULL at the end. */
static char *field(char *text, char **next) {
    char *const begin = text, *out = text;
    bool quoted = false;
    for (; *text != '\0' && (quoted || *text != ','); ++text) {
        if (*text != '"')
            *out++ = *text;
        else if (quoted && text[1] == '"')
            *out++ = *text++;
        else
            quoted = !quoted;
    }
    *next = *text == ',' ? text + 1 : NULL;
    *out = '\0';
    return begin;
}

/* Adds a row of `columns` cells, or sets the column names if there are none yet. */
static bool add_line(report_table *table, char *line) {
    const bool names = report_columns(table) == 0;
    size_t count = 0;
    for (char *next = line; next != NULL; ++count) {
        char *const text = field(next, &next);
        if (names)
            report_column(table, text);
        else
            report_text(table, text);
    }
    return count == report_columns(table);
}

aur_result report_load(const char *path, report_table **table, char **notes, aur_error *error) {
    *table = NULL;
    struct stat status;
    if (stat(path, &status) == 0 && !S_ISREG(status.st_mode))
        return fail_in(path, 0, AUR_ERROR_OPEN, "not a regular file", error);
    FILE *const file = fopen(path, "r");
    if (file == NULL)
        return fail_in(path, 0, AUR_ERROR_OPEN, strerror(errno), error);
    report_table *const loaded = report_create(0, NULL);
    size_t size, capacity = 0, number = 0;
    FILE *const comments = notes != NULL ? open_memstream(notes, &size) : NULL;
    char *line = NULL;
    bool good = loaded != NULL && (comments != NULL || notes == NULL);
    while (good && getline(&line, &capacity, file) >= 0) {
        ++number;
        line[strcspn(line, "\n")] = '\0';
        if (line[0] != '#')
            good = add_line(loaded, line);
        else if (comments != NULL)
            fprintf(comments, "%s\n", line + strspn(line, "# "));
    }
    free(line);
    fclose(file);
    if (comments != NULL)
        fclose(comments);
    if (good && report_columns(loaded) > 0) {
        *table = loaded;
        return AUR_OK;
    }
    report_destroy(loaded);
    if (notes != NULL) {
        free(*notes);
        *notes = NULL;
    }
    return fail_in(path, number, AUR_ERROR_FORMAT,
                   "not a row of a table of the lab: expected as many cells as columns", error);
}
