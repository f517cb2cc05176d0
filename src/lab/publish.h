/* The report of what was run. */
#pragma once

#include "lab/lab.h"

/* Draws plot `plot` of a table as a file of its own, NAME beside the page; returns false where it cannot. */
typedef struct lab_printer {
    bool (*print)(void *user, const char *name, const report_table *table, const report_plot *plot);
    void *user;
} lab_printer;

/* Writes the page of all results in a folder to `path`. Errors: OPEN when there are none, FORMAT, WRITE,
 * MEMORY. */
aur_result lab_publish(const char *results, const char *path, const lab_printer *printer, aur_error *error);
