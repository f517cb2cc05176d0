/* Tables of results and plots of them, as experiments of the lab describe them. Experimental: all of this
 * header may change in any version. */
#ifndef AUREOLE_LAB_PLOT_H
#define AUREOLE_LAB_PLOT_H

#include <stdbool.h>

typedef struct report_table report_table;

/* Plots of tables of results: which columns are drawn, and how. */

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

#endif
