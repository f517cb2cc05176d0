/* Plots of tables of results: which columns are drawn, and how. */
#pragma once

#include "program/report/report.h"

/* Names of columns; where several make a name, commas stand between them. */
typedef struct report_plot {
    const char *name;       /* a part of file names: "energy"; NULL ends a list of plots */
    const char *title;      /* what is seen, in a line */
    const char *table;      /* of an experiment's further tables; NULL: the first one */
    const char *x, *y;      /* numbers */
    const char *low, *high; /* the interval of y; or NULL */
    const char *series;     /* columns whose words name a line: "set,map"; NULL: there is one */
    const char *panel;      /* columns whose words name a panel beside the others; NULL: there is one */
    bool log_x, log_y;
    bool points; /* no lines between the points, and one scale for x and y */
} report_plot;

/* Writes the plot to `path`, in a format of report/figure.h that its name ends in; no file, and *drawn false,
 * when a column is missing or no row has numbers. Errors: NAME, MEMORY, WRITE. */
aur_result report_plot_save(const char *path, const report_table *table, const report_plot *plot, bool *drawn,
                            aur_error *error);
/* The same as a part of a page, a drawing for each panel: nothing without numbers. Errors: MEMORY. */
aur_result report_plot_put(FILE *page, const report_table *table, const report_plot *plot, aur_error *error);
