/* SVG. Consecutive elements with the same pen share a group. */
#include <aureole/text.h>
#include <math.h>

#include "program/report/canvas.h"

void report_escape(FILE *page, const char *text) {
    for (const char *from = text; *text != '\0'; from = text) {
        const uint32_t letter = report_next_letter(&text);
        const bool control = letter < ' ' && letter != '\n' && letter != '\t';
        if (letter == '&')
            fputs("&amp;", page);
        else if (letter == '<')
            fputs("&lt;", page);
        else if (letter == '>')
            fputs("&gt;", page);
        else if (letter == '"')
            fputs("&quot;", page);
        else if (letter == 0xfffd || control || letter == 0x7f)
            fputc('?', page);
        else
            fwrite(from, 1, (size_t)(text - from), page);
    }
}

static void begin(report_canvas *c) {
    aur_print(c->to,
              "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%g\" height=\"%g\" viewBox=\"0 0 %g %g\" "
              "font-family=\"Helvetica,Arial,sans-serif\" font-size=\"%d\">\n"
              "<rect width=\"100%%\" height=\"100%%\" fill=\"#fff\"/>\n",
              c->width, c->height, c->width, c->height, REPORT_TEXT_SIZE);
}

static void put_class(report_canvas *c, const report_pen *pen) {
    static const char *const names[REPORT_INK_SERIES] = {"text", "pale", "grid", "frame", "scale"};
    if (pen->ink < REPORT_INK_SERIES)
        fprintf(c->to, " class=\"%s\"", names[pen->ink]);
    else if (pen->ink < REPORT_INK_RGB)
        fprintf(c->to, " class=\"%c%u\"", pen->width > 0.0 ? 'l' : 'm', (pen->ink - REPORT_INK_SERIES) % 8);
}

static void end_dots(report_canvas *c) {
    fputs(c->dots > 0.0 ? "\"/>\n" : "", c->to);
    c->dots = 0.0;
}

static void close_group(report_canvas *c) {
    end_dots(c);
    fputs(c->open ? "</g>\n" : "", c->to);
    c->open = false;
}

/* Colors of the scale are attributes of each element. Crisp edges avoid seams between adjacent cells. */
static void use(report_canvas *c, const report_pen *pen, bool crisp) {
    const bool scale = pen->ink == REPORT_INK_SCALE;
    if (!c->open || c->pen.ink != pen->ink || c->crisp != crisp || (!scale && c->pen.rgb != pen->rgb) ||
        c->pen.dashed != pen->dashed || fabs(c->pen.width - pen->width) > 0.0) {
        close_group(c);
        fputs("<g", c->to);
        put_class(c, pen);
        if (pen->width > 0.0)
            aur_print(c->to, " fill=\"none\" stroke=\"#%06x\" stroke-width=\"%g\"%s>\n", (unsigned)pen->rgb,
                      pen->width, pen->dashed ? " stroke-dasharray=\"5 3\"" : "");
        else if (scale)
            fputs(crisp ? " shape-rendering=\"crispEdges\">\n" : ">\n", c->to);
        else
            fprintf(c->to, " fill=\"#%06x\">\n", (unsigned)pen->rgb);
    }
    c->pen = *pen;
    c->crisp = crisp;
    c->open = true;
}

static void begin_element(report_canvas *c, const report_pen *pen, const char *name) {
    end_dots(c);
    fprintf(c->to, "<%s", name);
    if (pen->ink == REPORT_INK_SCALE)
        fprintf(c->to, " fill=\"#%06x\"", (unsigned)pen->rgb);
}

static void end_element(report_canvas *c, const char *name) {
    if (!c->title) {
        fputs("/>\n", c->to);
        return;
    }
    fputs("><title>", c->to);
    report_escape(c->to, c->label);
    aur_print(c->to, "%s%.5g, %.5g</title></%s>\n", c->label[0] != '\0' ? ": " : "", c->at[0], c->at[1],
              name);
}

/* Pages have many plots: a resolution of a tenth of a pixel keeps them small. */
static void put_number(report_canvas *c, const char *before, double value) {
    fputs(before, c->to);
    if (c->inside)
        aur_print(c->to, "%.5g", round(10.0 * value) / 10.0);
    else
        aur_print(c->to, "%.2f", value);
}

static void path(report_canvas *c, const report_pen *pen, bool closed, size_t count, const double *xy) {
    use(c, pen, pen->ink == REPORT_INK_SCALE);
    begin_element(c, pen, "path");
    fputs(" d=\"", c->to);
    for (size_t i = 0; i < count; ++i) {
        put_number(c, i == 0 ? "M" : "L", xy[2 * i]);
        put_number(c, " ", xy[2 * i + 1]);
    }
    fputs(closed ? "Z\"" : "\"", c->to);
    end_element(c, "path");
}

/* Scatter plots in pages: dots of one color and size are round caps of one path. */
static void put_dot(report_canvas *c, const report_pen *pen, double x, double y, double radius) {
    if (fabs(c->dots - radius) > 0.0) {
        end_dots(c);
        aur_print(c->to,
                  "<path class=\"l%u\" fill=\"none\" stroke=\"#%06x\" stroke-width=\"%g\" "
                  "stroke-linecap=\"round\" d=\"",
                  (pen->ink - REPORT_INK_SERIES) % 8, (unsigned)pen->rgb, 2.0 * radius);
        c->dots = radius;
    }
    put_number(c, "M", x);
    put_number(c, " ", y);
    fputs("h0", c->to);
}

static void circle(report_canvas *c, const report_pen *pen, double x, double y, double radius) {
    const bool of_series = pen->ink >= REPORT_INK_SERIES && pen->ink < REPORT_INK_RGB;
    use(c, pen, false);
    if (c->inside && !c->title && of_series && !(pen->width > 0.0)) {
        put_dot(c, pen, x, y, radius);
        return;
    }
    begin_element(c, pen, "circle");
    put_number(c, " cx=\"", x);
    put_number(c, "\" cy=\"", y);
    put_number(c, "\" r=\"", radius);
    fputs("\"", c->to);
    end_element(c, "circle");
}

static void text(report_canvas *c, double x, double y, double anchor, bool turned, const char *words) {
    close_group(c);
    aur_print(c->to, "<text x=\"%.2f\" y=\"%.2f\"%s", x, y,
              anchor <= 0.0  ? ""
              : anchor < 1.0 ? " text-anchor=\"middle\""
                             : " text-anchor=\"end\"");
    if (turned)
        aur_print(c->to, " transform=\"rotate(-90 %.2f %.2f)\"", x, y);
    fputs(c->inside ? ">" : " fill=\"#0d0d0d\">", c->to);
    report_escape(c->to, words);
    fputs("</text>\n", c->to);
}

static void end(report_canvas *c) {
    close_group(c);
    fputs("</svg>\n", c->to);
}

const report_canvas_format report_canvas_svg = {"svg", begin, path, circle, text, end, NULL};
