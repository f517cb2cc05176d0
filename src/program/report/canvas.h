/* Canvas for figures: lines, polygons, circles and text, in pixels from the upper left corner. Each format is
 * one file. */
#pragma once

#include "program/report/figure.h"

enum { REPORT_INK_RGB = 256, REPORT_TEXT_SIZE = 12 };

/* The style of lines and areas. */
typedef struct report_pen {
    unsigned ink; /* report_ink, or REPORT_INK_RGB for the colour that follows */
    uint32_t rgb; /* 0xrrggbb; report_pen_of sets it for the others */
    double width; /* of a line; 0: filled */
    bool dashed;
} report_pen;

typedef struct report_canvas report_canvas;

typedef struct report_canvas_format {
    const char *name;
    void (*begin)(report_canvas *canvas);
    /* The polygon is filled or closed if the pen says so. */
    void (*path)(report_canvas *canvas, const report_pen *pen, bool closed, size_t count, const double *xy);
    void (*circle)(report_canvas *canvas, const report_pen *pen, double x, double y, double radius);
    /* `anchor` is 0 if the text begins at x, .5 if it is centered there, 1 if it ends there; turned text is
     * rotated to run upwards. */
    void (*text)(report_canvas *canvas, double x, double y, double anchor, bool turned, const char *text);
    void (*end)(report_canvas *canvas);
    /* Writes the result of a binary format; NULL: a text format, which was written to the canvas's stream. */
    aur_result (*save)(const char *path, report_canvas *canvas, aur_error *error);
} report_canvas_format;

struct report_canvas {
    const report_canvas_format *format;
    FILE *to;
    double width, height;
    double scale_by;   /* of a PDF; 0: 1 */
    const char *font;  /* of a PDF; NULL: Helvetica */
    bool inside;       /* inside a page, which has the styles */
    bool open;         /* a group for `pen` is open */
    bool title;        /* the tooltip below belongs to the next mark */
    bool crisp;        /* an SVG group for it is open */
    double dots;       /* radius of the dots in the open SVG path; 0: none is open */
    report_pen pen;    /* current pen of lines and areas */
    const char *label; /* of that mark; x and y follow */
    double at[2];
    size_t offsets[8]; /* of a PDF's objects */
    float *pixels;     /* RGB in sRGB encoding; NULL when out of memory */
};

extern const report_canvas_format report_canvas_svg, report_canvas_pdf, report_canvas_png;

report_pen report_pen_of(unsigned ink, double width);
/* The width of a line of text in Helvetica at REPORT_TEXT_SIZE, in pixels. */
double report_text_width(const char *text);
/* Decodes the next character of UTF-8 text and advances; 0 at its end, U+FFFD for invalid UTF-8. */
uint32_t report_next_letter(const char **text);

/* The color of the scale at a value. */
uint32_t report_scale_color(const report_scale *scale, double value);

/* Escapes text for markup; invalid UTF-8 and characters that XML does not allow become question marks. */
void report_escape(FILE *page, const char *text);
