/* The report of what was run. */
#pragma once

#include "program/lab/lab.h"

/* Draws plot `plot` of a table as a file of its own, NAME beside the page; returns false where it cannot. */
typedef struct lab_printer {
    bool (*print)(void *user, const char *name, const report_table *table, const report_plot *plot);
    void *user;
} lab_printer;

/* Writes the page of all results in a folder to `path`; without a printer there are no plots for print. A
 * small page shows large pictures as means of 2 x 2 pixels, within .8 %. Errors: OPEN when there are none,
 * FORMAT, WRITE, MEMORY. */
aur_result lab_publish(const char *results, const char *path, bool small, const lab_printer *printer,
                       aur_error *error);
