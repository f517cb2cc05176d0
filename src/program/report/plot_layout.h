/* Which rows of a table belong to which panel and line of a plot. */
#pragma once

#include "program/report/plot.h"

enum { REPORT_LABEL = 160, REPORT_GROUPS = 64 };

/* The rows of a plot, each of a panel and of a series. */
typedef struct report_layout {
    const report_table *table;
    const report_plot *plot;
    size_t x, y, low, high; /* columns */
    size_t panel_count, series_count;
    char panels[REPORT_GROUPS][REPORT_LABEL], series[REPORT_GROUPS][REPORT_LABEL];
} report_layout;

/* Sorts the rows that can be drawn into panels and series. False when there are none, or a column is missing.
 */
bool report_layout_begin(report_layout *layout, const report_table *table, const report_plot *plot);
/* Whether a row is drawn in a panel and series; REPORT_GROUPS is any series. */
bool report_layout_has(const report_layout *layout, size_t row, size_t panel, size_t series);

typedef struct report_plotted {
    double x, y, low, high; /* the interval is NaN where there is none */
} report_plotted;

/* The points of a line from left to right, at most as many as the table has rows; returns their number. */
size_t report_layout_points(const report_layout *layout, size_t panel, size_t series, report_plotted *points);
