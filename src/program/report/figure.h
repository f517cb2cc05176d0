/* Figures: panels with axes and series, drawn as SVG, PDF or PNG, or written as TikZ for papers. */
#pragma once

#include <aureole/core.h>
#include <stdbool.h>
#include <stdio.h>

/* A colour of the eight that series have, or one that is not theirs. */
typedef enum report_ink {
    REPORT_INK_TEXT,
    REPORT_INK_PALE,
    REPORT_INK_GRID,
    REPORT_INK_FRAME,
    REPORT_INK_SCALE, /* the colour scale's at the value of the point */
    REPORT_INK_SERIES /* plus the index of the series; from the ninth on lines are dashed */
} report_ink;

/* How a series is drawn: any of these together. */
enum {
    REPORT_LINE = 1,
    REPORT_DASHED = 2,   /* of a line */
    REPORT_MARKS = 4,    /* the shape goes with the ink */
    REPORT_BARS = 8,     /* from low to high; on a logarithmic axis a bar that reaches 0 ends with the axis */
    REPORT_DOTS = 16,    /* disks of the points' own sizes */
    REPORT_CELLS = 32,   /* rectangles about the points, as large as the series says */
    REPORT_SEGMENTS = 64 /* a line from each point at an even place to the next one */
};

/* One that is not finite, or not positive on a logarithmic axis, is not drawn. */
typedef struct report_point {
    double x, y;
    double low, high; /* the interval of y; NaN: none */
    double value;     /* on the colour scale */
    double size;      /* radius of a dot, in pixels */
} report_point;

typedef struct report_series {
    const char *label; /* NULL or "": not in the legend */
    unsigned parts;
    unsigned ink;   /* report_ink, or REPORT_INK_SERIES + k */
    double cell[2]; /* width and height of cells, in units of the axes */
    size_t count;
    const report_point *points;
} report_series;

typedef struct report_axis {
    const char *label; /* NULL: none */
    bool log;
    double low, high; /* the ends; equal: as the data are, with some room */
} report_axis;

typedef enum report_border {
    REPORT_BORDER_AXES,  /* a frame with grid, numbers and labels */
    REPORT_BORDER_FRAME, /* a frame alone */
    REPORT_BORDER_NONE
} report_border;

typedef struct report_panel {
    const char *title; /* NULL: none */
    report_axis x, y;
    bool equal; /* a step is as long on both axes */
    report_border border;
    double rings[2]; /* radii of circles about the origin; 0: none */
    size_t series_count;
    const report_series *series;
} report_panel;

/* Values and their colours, which are sRGB 0xrrggbb at even steps from low to high, linear between. */
typedef struct report_scale {
    const char *label; /* NULL: there is no scale */
    double low, high;
    size_t stop_count; /* 2 to 8 */
    uint32_t stops[8];
} report_scale;

typedef enum report_legend {
    REPORT_LEGEND_NONE,
    REPORT_LEGEND_EACH,  /* below each panel, with its labels */
    REPORT_LEGEND_SHARED /* below all; every panel has the same series in the same order */
} report_legend;

typedef struct report_figure {
    double width, height; /* of a panel with its numbers and labels, in pixels of 1/100 inch */
    size_t columns;       /* panels side by side */
    size_t panel_count;
    const report_panel *panels;
    report_legend legend;
    report_scale scale;
    double scale_by;  /* of all lengths of PDF and TeX; 0: 1 */
    const char *font; /* of PDF: "Times-Roman"; NULL: Helvetica */
    const char *data; /* of TeX: the file that has the numbers; NULL: they stand in the text */
} report_figure;

/* "svg", "pdf", "png", "tex"; NULL beyond them. */
const char *report_figure_format(size_t index);
/* The format whose name, after a point, `path` ends in; or NULL. */
const char *report_figure_format_of(const char *path);

/* Replaces the file `path` ("-": standard output) by the figure, whole or not at all. A figure has the same
 * bytes in every run. SVG and TeX hold any text in UTF-8, PDF that of Latin-1, PNG that of ASCII: other
 * letters are question marks there. TeX is a tikzpicture for pgfplots with the data in it. Errors: NAME for
 * another format, MEMORY, WRITE. */
aur_result report_figure_save(const char *path, const char *format, const report_figure *figure,
                              aur_error *error);

/* One panel without legend and scale as an <svg> within a page, whose styles have its colours: classes grid,
 * frame, l0 to l7 for lines and m0 to m7 for what is filled. Marks of lines show their numbers under the
 * pointer. */
void report_figure_put_panel(FILE *page, const report_figure *figure, size_t panel, const char *title);
/* What stands before a label in the legend, as an <svg> within a page. */
void report_figure_put_key(FILE *page, const report_series *series);

/* `count` colours of aur_image_false_color (at least 2), 0xrrggbb, from 0 to 1, as an sRGB screen has them.
 * Errors: MEMORY. */
aur_result report_false_color(size_t count, uint32_t *colors, aur_error *error);

/* Axes of figures, and what else of them is the same in all formats. */

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

/* Writes the numbers of a figure, a line a point: columns x1 y1 (above1 below1 of intervals) x2 ..., nan
 * where a series has ended. */
void report_figure_data(FILE *to, const report_figure *figure);
/* Writes a figure for pgfplots. */
void report_figure_tikz(FILE *to, const report_figure *figure);
