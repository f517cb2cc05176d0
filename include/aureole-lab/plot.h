/* Tables of results and their plots, as described by experiments of the lab. Experimental: all of this header
 * may change in any version. */
#ifndef AUREOLE_LAB_PLOT_H
#define AUREOLE_LAB_PLOT_H

#include <stdbool.h>

typedef struct report_table report_table;

/* Plots of tables of results: columns and style. */

/* Names of columns; several are separated by commas. */
typedef struct report_plot {
    const char *name;       /* part of file names: "energy"; NULL ends a list of plots */
    const char *title;      /* one line */
    const char *table;      /* one of the experiment's further tables; NULL: the first one */
    const char *x, *y;      /* numeric columns */
    const char *low, *high; /* bounds of y's interval; or NULL */
    const char *series;     /* columns whose texts name a line: "set,map"; NULL: a single line */
    const char *panel;      /* columns whose texts name a panel; NULL: a single panel */
    bool log_x, log_y;
    bool points; /* no lines between the points, and one scale for x and y */
} report_plot;

#endif
