/* Axes of figures, and what else of them is the same in all formats. */
#pragma once

#include "program/report/figure.h"

enum { REPORT_MOST_TICKS = 32 };

/* An axis as it is drawn: its ends, logarithms where it is logarithmic, and the pixels of these. */
typedef struct report_ruler {
    double low, high;
    bool log;
    double from, to;
} report_ruler;

/* The axis of a panel as tight as the data, with a twentieth around but for cells, unless its ends are given.
 */
report_ruler report_make_ruler(const report_panel *panel, bool of_y, double from, double to);
/* Widens one of two axes until a step is as long on both. */
void report_make_equal(report_ruler *x, report_ruler *y);
/* The pixel of a value. */
double report_place(const report_ruler *ruler, double value);
/* Where numbers stand: on a long logarithmic axis at 1, 2 and 5 times powers of ten, as far as that is not
 * too many of them, else at round numbers. Returns how many there are. */
size_t report_find_ticks(const report_ruler *ruler, double ticks[REPORT_MOST_TICKS]);

/* Whether a point has a place on the axes of a panel. */
bool report_drawable(const report_panel *panel, const report_point *point);
/* The entries of the legend below a panel: at most `capacity` of them, in `entries`; returns their number. */
size_t report_legend_entries(const report_figure *figure, size_t panel, size_t capacity,
                             const report_series **entries);

/* Writes a figure for pgfplots. */
void report_figure_tikz(FILE *to, const report_figure *figure);
