/* What figures are drawn on: lines, polygons, circles and text, in pixels from the upper left corner. A
 * format is one file. */
#pragma once

#include "program/report/figure.h"

enum { REPORT_INK_RGB = 256, REPORT_TEXT_SIZE = 12 };

/* How lines are drawn and areas filled. */
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
    /* A polygon when it is filled or closed. */
    void (*path)(report_canvas *canvas, const report_pen *pen, bool closed, size_t count, const double *xy);
    void (*circle)(report_canvas *canvas, const report_pen *pen, double x, double y, double radius);
    /* `anchor` is 0 where the text begins at x, .5 where its middle is there, 1 where it ends; turned text
     * runs upwards. */
    void (*text)(report_canvas *canvas, double x, double y, double anchor, bool turned, const char *text);
    void (*end)(report_canvas *canvas);
    /* Writes what was drawn; NULL: it is text, which went to the canvas's stream. */
    aur_result (*save)(const char *path, report_canvas *canvas, aur_error *error);
} report_canvas_format;

struct report_canvas {
    const report_canvas_format *format;
    FILE *to;
    double width, height;
    double scale_by;   /* of a PDF; 0: 1 */
    const char *font;  /* of a PDF; NULL: Helvetica */
    bool inside;       /* a page, which has the styles */
    bool open;         /* there is a group for `pen` */
    bool title;        /* the next mark has the words below */
    bool crisp;        /* so is the group of an SVG */
    double dots;       /* radius of those in the SVG's path that is open; 0: none is */
    report_pen pen;    /* the one that lines and areas have now */
    const char *label; /* of that mark; x and y follow */
    double at[2];
    size_t offsets[8]; /* of a PDF's objects */
    float *pixels;     /* three a pixel, as the eye counts them; NULL without memory */
};

extern const report_canvas_format report_canvas_svg, report_canvas_pdf, report_canvas_png;

report_pen report_pen_of(unsigned ink, double width);
/* The width of a line of text in Helvetica at REPORT_TEXT_SIZE, in pixels. */
double report_text_width(const char *text);
/* The next letter of UTF-8 text, which moves on; 0 at its end, U+FFFD for what is no UTF-8 or no letter of
 * Unicode. */
uint32_t report_next_letter(const char **text);

/* The colour of the scale at a value. */
uint32_t report_scale_color(const report_scale *scale, double value);

/* Text that is no markup; what is no UTF-8, or no letter of XML, becomes question marks. */
void report_escape(FILE *page, const char *text);
