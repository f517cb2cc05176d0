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

/* Writes the plot as commands for gnuplot, without a terminal. Returns the number of its panels, 0 where
 * there is nothing to draw. */
size_t report_plot_script(FILE *script, const report_table *table, const report_plot *plot);
