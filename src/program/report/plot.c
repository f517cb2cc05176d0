/* Plots as SVG, a drawing for each panel. */
#include <aureole/text.h>
#include <math.h>
#include <stdlib.h>

#include "program/report/page.h"
#include "program/report/plot_layout.h"

enum { WIDTH = 360, HEIGHT = 260, LEFT = 54, RIGHT = 10, TOP = 22, BOTTOM = 36, STYLES = 8 };

typedef struct axis {
    double low, high; /* logarithms where `log` */
    bool log;
    int from, to; /* the drawing's ends */
} axis;

static double place(const axis *a, double value) {
    const double at = a->log ? log10(value) : value;
    return a->from + (at - a->low) / (a->high - a->low) * (a->to - a->from);
}

/* As tight as the data of the panel, with a twentieth around. */
static axis make_axis(const report_layout *l, size_t panel, const size_t *columns, size_t column_count,
                      bool log, int from, int to) {
    axis a = {INFINITY, -INFINITY, log, from, to};
    for (size_t row = 0; row < report_rows(l->table); ++row)
        for (size_t c = 0; c < column_count && report_layout_has(l, row, panel, REPORT_GROUPS); ++c) {
            const double value = report_value(l->table, row, columns[c]);
            if (!isfinite(value) || (log && value <= 0.0))
                continue;
            a.low = fmin(a.low, log ? log10(value) : value);
            a.high = fmax(a.high, log ? log10(value) : value);
        }
    const double room = a.high > a.low ? 0.05 * (a.high - a.low) : log ? 0.1 : 0.05 * fabs(a.high) + 1e-9;
    a.low -= room;
    a.high += room;
    return a;
}

/* Widens one of two axes until a step is as long on both. */
static void make_equal(axis *x, axis *y) {
    const double of_x = (x->high - x->low) / abs(x->to - x->from);
    const double of_y = (y->high - y->low) / abs(y->to - y->from);
    axis *const wider = of_x < of_y ? x : y;
    const double more = 0.5 * (fmax(of_x, of_y) / fmin(of_x, of_y) - 1.0) * (wider->high - wider->low);
    wider->low -= more;
    wider->high += more;
}

static void put_tick(FILE *page, const axis *a, double value) {
    const double at = place(a, value);
    const bool level = a->from > a->to; /* y goes up */
    if (level)
        aur_print(page,
                  "<line class=\"grid\" x1=\"%d\" x2=\"%d\" y1=\"%.1f\" y2=\"%.1f\"/><text x=\"%d\" "
                  "y=\"%.1f\" text-anchor=\"end\">%g</text>\n",
                  LEFT, WIDTH - RIGHT, at, at, LEFT - 4, at + 4.0, value);
    else
        aur_print(page,
                  "<line class=\"grid\" x1=\"%.1f\" x2=\"%.1f\" y1=\"%d\" y2=\"%d\"/><text x=\"%.1f\" "
                  "y=\"%d\" text-anchor=\"middle\">%g</text>\n",
                  at, at, TOP, HEIGHT - BOTTOM, at, HEIGHT - BOTTOM + 13, value);
}

/* Ticks at 1, 2 and 5 times powers of ten, where that is not too many of them. */
static void put_decades(FILE *page, const axis *a) {
    static const double steps[] = {1.0, 2.0, 5.0};
    const size_t each = a->high - a->low < 2.2 ? 3 : 1;
    const double skip = fmax(1.0, ceil((a->high - a->low) / 6.0));
    for (double decade = floor(a->low); decade <= a->high; decade += skip)
        for (size_t i = 0; i < each; ++i) {
            const double value = steps[i] * pow(10.0, decade);
            if (log10(value) >= a->low && log10(value) <= a->high)
                put_tick(page, a, value);
        }
}

/* Ticks at round numbers. */
static void put_ticks(FILE *page, const axis *a) {
    if (a->log && a->high - a->low > 0.8) {
        put_decades(page, a);
        return;
    }
    const double low = a->log ? pow(10.0, a->low) : a->low, high = a->log ? pow(10.0, a->high) : a->high;
    const double rough = (high - low) / 5.0, power = pow(10.0, floor(log10(rough))), part = rough / power;
    const double step = power * (part > 5.0 ? 10.0 : part > 2.0 ? 5.0 : part > 1.0 ? 2.0 : 1.0);
    for (double k = ceil(low / step); k * step <= high; ++k)
        put_tick(page, a, k == 0.0 ? 0.0 : k * step);
}

static void put_series(FILE *page, const report_layout *l, size_t panel, size_t series, const axis *x,
                       const axis *y, report_plotted *points) {
    const size_t count = report_layout_points(l, panel, series, points);
    fprintf(page, "<g class=\"s%zu\">", series % STYLES);
    if (!l->plot->points && count > 1) {
        fprintf(page, "<polyline%s points=\"", series >= STYLES ? " stroke-dasharray=\"5 3\"" : "");
        for (size_t i = 0; i < count; ++i)
            aur_print(page, "%.1f,%.1f ", place(x, points[i].x), place(y, points[i].y));
        fputs("\"/>\n", page);
    }
    for (size_t i = 0; i < count; ++i) {
        const report_plotted *const p = &points[i];
        const double at = place(x, p->x);
        if (isfinite(p->low) && isfinite(p->high) && !(y->log && p->low <= 0.0))
            aur_print(page, "<line x1=\"%.1f\" x2=\"%.1f\" y1=\"%.1f\" y2=\"%.1f\"/>", at, at,
                      place(y, p->low), place(y, p->high));
        aur_print(page, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"2.4\"", at, place(y, p->y));
        if (l->plot->points) { /* hundreds of them: their numbers are in the table */
            fputs("/>", page);
            continue;
        }
        fputs("><title>", page);
        report_escape(page, l->series[series]);
        aur_print(page, "%s%.5g, %.5g</title></circle>\n", l->series[series][0] != '\0' ? ": " : "", p->x,
                  p->y);
    }
    fputs("</g>\n", page);
}

static void put_panel(FILE *page, const report_layout *l, size_t panel, report_plotted *points) {
    const size_t ys[] = {l->y, l->low, l->high};
    axis x = make_axis(l, panel, &l->x, 1, l->plot->log_x, LEFT, WIDTH - RIGHT);
    axis y = make_axis(l, panel, ys, 3, l->plot->log_y, HEIGHT - BOTTOM, TOP);
    if (l->plot->points)
        make_equal(&x, &y);
    fprintf(page, "<svg viewBox=\"0 0 %d %d\" role=\"img\"><title>", WIDTH, HEIGHT);
    report_escape(page, l->plot->title);
    fprintf(page, "</title>\n<text x=\"%d\" y=\"14\">", LEFT);
    report_escape(page, l->panels[panel]);
    fputs("</text>\n", page);
    put_ticks(page, &x);
    put_ticks(page, &y);
    fprintf(page, "<rect class=\"frame\" x=\"%d\" y=\"%d\" width=\"%d\" height=\"%d\"/>\n", LEFT, TOP,
            WIDTH - LEFT - RIGHT, HEIGHT - TOP - BOTTOM);
    for (size_t s = 0; s < l->series_count; ++s)
        put_series(page, l, panel, s, &x, &y, points);
    fprintf(page, "<text x=\"%d\" y=\"%d\" text-anchor=\"middle\">", (LEFT + WIDTH - RIGHT) / 2, HEIGHT - 6);
    report_escape(page, l->plot->x);
    fprintf(page, "</text><text x=\"12\" y=\"%d\" text-anchor=\"middle\" transform=\"rotate(-90 12 %d)\">",
            HEIGHT / 2, HEIGHT / 2);
    report_escape(page, l->plot->y);
    fputs("</text></svg>\n", page);
}

static void put_plot(FILE *page, const report_layout *l, report_plotted *points) {
    fputs("<figure class=\"plot\"><figcaption>", page);
    report_escape(page, l->plot->title);
    fputs("</figcaption>\n<ul class=\"legend\">", page);
    for (size_t s = 0; s < l->series_count && l->series[s][0] != '\0'; ++s) {
        fprintf(page,
                "<li><svg viewBox=\"0 0 26 12\" aria-hidden=\"true\"><line class=\"s%zu\" x1=\"0\" x2=\"26\" "
                "y1=\"6\" "
                "y2=\"6\" stroke-width=\"2\"%s/><circle class=\"s%zu\" cx=\"13\" cy=\"6\" r=\"3\"/></svg> ",
                s % STYLES, s >= STYLES ? " stroke-dasharray=\"5 3\"" : "", s % STYLES);
        report_escape(page, l->series[s]);
        fputs("</li>", page);
    }
    fputs("</ul>\n<div class=\"panels\">\n", page);
    for (size_t p = 0; p < l->panel_count; ++p)
        put_panel(page, l, p, points);
    fputs("</div></figure>\n", page);
}

void report_page_plot(FILE *page, const report_table *table, const report_plot *plot) {
    report_layout *const l = malloc(sizeof *l);
    report_plotted *const points = malloc((report_rows(table) + 1) * sizeof *points);
    if (l != NULL && points != NULL && report_layout_begin(l, table, plot))
        put_plot(page, l, points);
    free(l);
    free(points);
}
