/* PDF 1.4 (ISO 32000-1): one page, in Helvetica or Times, which every PDF reader has. */
#include <aureole/text.h>
#include <math.h>
#include <string.h>

#include "program/report/canvas.h"

/* 100 pixels are an inch. */
static double points_per_pixel(const report_canvas *c) {
    return 0.72 * (c->scale_by > 0.0 ? c->scale_by : 1.0);
}

enum { CATALOG = 1, PAGES, PAGE, FONT, CONTENTS, LENGTH, OBJECTS };

static size_t position(const report_canvas *c) {
    return (size_t)ftell(c->to);
}

static void begin_object(report_canvas *c, size_t object) {
    c->offsets[object] = position(c);
    fprintf(c->to, "%zu 0 obj\n", object);
}

static void begin(report_canvas *c) {
    fputs("%PDF-1.4\n%\xc3\xa4\xc3\xb6\n", c->to); /* non-ASCII bytes mark the file as binary */
    begin_object(c, CATALOG);
    fprintf(c->to, "<< /Type /Catalog /Pages %d 0 R >>\nendobj\n", PAGES);
    begin_object(c, PAGES);
    fprintf(c->to, "<< /Type /Pages /Kids [%d 0 R] /Count 1 >>\nendobj\n", PAGE);
    begin_object(c, PAGE);
    aur_print(c->to,
              "<< /Type /Page /Parent %d 0 R /MediaBox [0 0 %.2f %.2f] /Contents %d 0 R\n"
              "/Resources << /Font << /F %d 0 R >> >> >>\nendobj\n",
              PAGES, points_per_pixel(c) * c->width, points_per_pixel(c) * c->height, CONTENTS, FONT);
    begin_object(c, FONT);
    fprintf(c->to, "<< /Type /Font /Subtype /Type1 /BaseFont /%s /Encoding /WinAnsiEncoding >>\nendobj\n",
            c->font != NULL ? c->font : "Helvetica");
    begin_object(c, CONTENTS);
    fprintf(c->to, "<< /Length %d 0 R >>\nstream\n", LENGTH);
    c->offsets[0] = position(c);
    /* Coordinates in pixels from the upper left corner. */
    aur_print(c->to, "%g 0 0 %g 0 %.2f cm\n1 J 1 j\n", points_per_pixel(c), -points_per_pixel(c),
              points_per_pixel(c) * c->height);
}

static void use(report_canvas *c, const report_pen *pen) {
    const double r = (double)(pen->rgb >> 16 & 255) / 255.0, g = (double)(pen->rgb >> 8 & 255) / 255.0,
                 b = (double)(pen->rgb & 255) / 255.0;
    if (pen->width > 0.0)
        aur_print(c->to, "%.4g %.4g %.4g RG %g w %s d\n", r, g, b, pen->width,
                  pen->dashed ? "[5 3] 0" : "[] 0");
    else
        aur_print(c->to, "%.4g %.4g %.4g rg\n", r, g, b);
}

static void paint(report_canvas *c, const report_pen *pen, bool closed) {
    fputs(pen->width <= 0.0 ? "f\n" : closed ? "s\n" : "S\n", c->to);
}

static void path(report_canvas *c, const report_pen *pen, bool closed, size_t count, const double *xy) {
    use(c, pen);
    for (size_t i = 0; i < count; ++i)
        aur_print(c->to, "%.2f %.2f %c\n", xy[2 * i], xy[2 * i + 1], i == 0 ? 'm' : 'l');
    paint(c, pen, closed);
}

/* Four cubic Bezier curves, within .03 % of the radius of the circle. */
static void circle(report_canvas *c, const report_pen *pen, double x, double y, double radius) {
    const double k = 4.0 / 3.0 * (sqrt(2.0) - 1.0) * radius;
    use(c, pen);
    aur_print(c->to, "%.2f %.2f m\n", x + radius, y);
    double ux = 1.0, uy = 0.0; /* start of the quarter; it ends at (-uy, ux) */
    for (size_t i = 0; i < 4; ++i) {
        const double vx = -uy, vy = ux;
        aur_print(c->to, "%.2f %.2f %.2f %.2f %.2f %.2f c\n", x + radius * ux + k * vx,
                  y + radius * uy + k * vy, x + radius * vx + k * ux, y + radius * vy + k * uy,
                  x + radius * vx, y + radius * vy);
        ux = vx;
        uy = vy;
    }
    paint(c, pen, true);
}

static void text(report_canvas *c, double x, double y, double anchor, bool turned, const char *words) {
    const double before = anchor * report_text_width(words);
    aur_print(c->to, "0.05 g BT /F %d Tf %s %.2f %.2f Tm (", REPORT_TEXT_SIZE,
              turned ? "0 -1 -1 0" : "1 0 0 -1", turned ? x : x - before, turned ? y + before : y);
    for (uint32_t letter; (letter = report_next_letter(&words)) != 0;)
        if (letter == '(' || letter == ')' || letter == '\\')
            fprintf(c->to, "\\%c", (int)letter);
        else if (letter < 127)
            fputc(letter < ' ' ? '?' : (int)letter, c->to);
        else if (letter >= 160 && letter < 256)
            fprintf(c->to, "\\%03o", (unsigned)letter);
        else
            fputc('?', c->to);
    fputs(") Tj ET\n", c->to);
}

static void end(report_canvas *c) {
    const size_t length = position(c) - c->offsets[0];
    fputs("endstream\nendobj\n", c->to);
    begin_object(c, LENGTH);
    fprintf(c->to, "%zu\nendobj\n", length);
    const size_t table = position(c);
    fprintf(c->to, "xref\n0 %d\n0000000000 65535 f \n", OBJECTS);
    for (size_t i = 1; i < OBJECTS; ++i)
        fprintf(c->to, "%010zu 00000 n \n", c->offsets[i]);
    fprintf(c->to, "trailer\n<< /Size %d /Root %d 0 R >>\nstartxref\n%zu\n%%%%EOF\n", OBJECTS, CATALOG,
            table);
}

const report_canvas_format report_canvas_pdf = {"pdf", begin, path, circle, text, end, NULL};
