/* Figures: panels with axes and series, drawn as SVG, PDF or PNG, or written as TikZ for papers. */
#pragma once

#include <aureole/core.h>
#include <stdbool.h>
#include <stdio.h>

/* A series color by index, or another color. */
typedef enum report_ink {
    REPORT_INK_TEXT,
    REPORT_INK_PALE,
    REPORT_INK_GRID,
    REPORT_INK_FRAME,
    REPORT_INK_SCALE, /* the scale's color for the point's value */
    REPORT_INK_SERIES /* plus the index of the series; lines are dashed from the ninth on */
} report_ink;

/* Parts of a series, which can be combined. */
enum {
    REPORT_LINE = 1,
    REPORT_DASHED = 2,   /* of a line */
    REPORT_MARKS = 4,    /* the shape follows from the ink */
    REPORT_BARS = 8,     /* from low to high; on a logarithmic axis a bar that reaches 0 is cut at the axis */
    REPORT_DOTS = 16,    /* disks with the points' radii */
    REPORT_CELLS = 32,   /* rectangles centered on the points, with the size of the series */
    REPORT_SEGMENTS = 64 /* a line from each point with an even index to the next one */
};

/* A point that is not finite, or not positive on a logarithmic axis, is not drawn. */
typedef struct report_point {
    double x, y;
    double low, high; /* the interval of y; NaN: none */
    double value;     /* for the color scale */
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
    double low, high; /* the range; equal ends: the data's range with a margin */
} report_axis;

typedef enum report_border {
    REPORT_BORDER_AXES,  /* a frame with grid, tick labels and axis labels */
    REPORT_BORDER_FRAME, /* a frame alone */
    REPORT_BORDER_NONE
} report_border;

typedef struct report_panel {
    const char *title; /* NULL: none */
    report_axis x, y;
    bool equal; /* equal units on both axes */
    report_border border;
    double rings[2]; /* radii of circles about the origin; 0: none */
    size_t series_count;
    const report_series *series;
} report_panel;

/* Values and their colors, sRGB 0xrrggbb at equidistant values from low to high, linear between. */
typedef struct report_scale {
    const char *label; /* NULL: no scale */
    double low, high;
    size_t stop_count; /* 2 to 8 */
    uint32_t stops[8];
} report_scale;

typedef enum report_legend {
    REPORT_LEGEND_NONE,
    REPORT_LEGEND_EACH,  /* below each panel, with its labels */
    REPORT_LEGEND_SHARED /* below all panels, which have the same series in the same order */
} report_legend;

typedef struct report_figure {
    double width, height; /* of a panel with its labels, in pixels of 1/100 inch */
    size_t columns;       /* panels side by side */
    size_t panel_count;
    const report_panel *panels;
    report_legend legend;
    report_scale scale;
    double scale_by;  /* factor on all lengths of PDF and TeX; 0: 1 */
    const char *font; /* of PDF: "Times-Roman"; NULL: Helvetica */
    const char *data; /* of TeX: the file for the data; NULL: the data are in the text */
} report_figure;

/* "svg", "pdf", "png", "tex"; NULL beyond the last. */
const char *report_figure_format(size_t index);
/* The format whose name is the extension of `path`; or NULL. */
const char *report_figure_format_of(const char *path);

/* Replaces the file `path` ("-": standard output) by the figure atomically. Output is reproducible byte for
 * byte. SVG and TeX support all of UTF-8, PDF Latin-1, PNG ASCII: other characters become question marks. TeX
 * is a tikzpicture for pgfplots that includes the data. Errors: NAME for another format, MEMORY, WRITE. */
aur_result report_figure_save(const char *path, const char *format, const report_figure *figure,
                              aur_error *error);

/* One panel without legend and scale as an <svg> in a page, whose styles set its colors: classes grid, frame,
 * l0 to l7 for lines and m0 to m7 for fills. Marks of lines have tooltips with their values. */
void report_figure_put_panel(FILE *page, const report_figure *figure, size_t panel, const char *title);
/* The legend key of a series, as an <svg> in a page. */
void report_figure_put_key(FILE *page, const report_series *series);

/* `count` colors of aur_image_false_color (at least 2), sRGB 0xrrggbb, from 0 to 1. Errors: MEMORY. */
aur_result report_false_color(size_t count, uint32_t *colors, aur_error *error);

/* Axes and other parts of figures that are common to all formats. */

enum { REPORT_TICK_LIMIT = 32 };

/* An axis as drawn: its range (logarithms if logarithmic) and the pixels of its ends. */
typedef struct report_ruler {
    double low, high;
    bool log;
    double from, to;
} report_ruler;

/* The axis of a panel with its given range, or the data's range plus a margin of a twentieth unless there are
 * cells. */
report_ruler report_make_ruler(const report_panel *panel, bool of_y, double from, double to);
/* Widens one of two axes until units are equal on both. */
void report_make_equal(report_ruler *x, report_ruler *y);
/* The pixel of a value. */
double report_pixel_of(const report_ruler *ruler, double value);
/* Positions of ticks: on a long logarithmic axis at 1, 2 and 5 times powers of ten, unless too many,
 * otherwise at round numbers. Returns their number. */
size_t report_find_ticks(const report_ruler *ruler, double ticks[REPORT_TICK_LIMIT]);

/* Whether a point can be drawn on the axes of a panel. */
bool report_drawable(const report_panel *panel, const report_point *point);
/* The entries of the legend below a panel, at most `capacity`, in `entries`; returns their number. */
size_t report_legend_entries(const report_figure *figure, size_t panel, size_t capacity,
                             const report_series **entries);

/* Writes the data of a figure, a line per point: columns x1 y1 (above1 below1 of intervals) x2 ..., nan after
 * the end of a series. */
void report_figure_data(FILE *to, const report_figure *figure);
/* Writes a figure for pgfplots. */
void report_figure_tikz(FILE *to, const report_figure *figure);
