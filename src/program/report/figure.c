/* Layout of figures. */
#include "program/report/figure.h"

#include <aureole/text.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "program/report/canvas.h"

enum { LEFT = 60, RIGHT = 20, TOP = 24, BOTTOM = 40, MARGIN = 20, SCALE = 80, LINE = 16, KEY = 26, GAP = 24 };
enum { MOST_ENTRIES = 64 };

/* A panel and its axes during drawing. */
typedef struct drawn_panel {
    report_canvas *canvas;
    const report_figure *figure;
    const report_panel *panel;
    report_ruler x, y;
} drawn_panel;

static void line(report_canvas *c, unsigned ink, double width, double x0, double y0, double x1, double y1) {
    const report_pen pen = report_pen_of(ink, width);
    c->format->path(c, &pen, false, 2, (const double[]){x0, y0, x1, y1});
}

static void box(report_canvas *c, const report_pen *pen, double x0, double y0, double x1, double y1) {
    c->format->path(c, pen, true, 4, (const double[]){x0, y0, x1, y0, x1, y1, x0, y1});
}

static void format_tick(double tick, char number[32]) {
    aur_format(number, 32, "%g", tick);
}

/* Whether tick labels along a horizontal axis overlap. */
static bool is_crowded(const report_ruler *along, size_t count, const double *ticks) {
    double end = -INFINITY;
    for (size_t i = 0; i < count; ++i) {
        char number[32];
        format_tick(ticks[i], number);
        const double half = 0.5 * report_text_width(number), at = report_pixel_of(along, ticks[i]);
        if (at - half < end + 4.0)
            return true;
        end = at + half;
    }
    return false;
}

static bool is_power_of_ten(double tick) {
    const double power = log10(tick);
    return fabs(power - round(power)) < 1e-9;
}

/* Draws the grid first, so that it is one group. If labels overlap, only powers of ten are labeled. */
static void put_ticks(report_canvas *c, const report_ruler *along, const report_ruler *across, bool of_y) {
    double ticks[REPORT_TICK_LIMIT];
    const size_t count = report_find_ticks(along, ticks);
    for (size_t i = 0; i < count; ++i) {
        const double at = report_pixel_of(along, ticks[i]);
        if (of_y)
            line(c, REPORT_INK_GRID, 0.7, across->from, at, across->to, at);
        else
            line(c, REPORT_INK_GRID, 0.7, at, across->from, at, across->to);
    }
    const bool crowded = !of_y && along->log && is_crowded(along, count, ticks);
    for (size_t i = 0; i < count; ++i) {
        char number[32];
        if (crowded && !is_power_of_ten(ticks[i]))
            continue;
        format_tick(ticks[i], number);
        const double at = report_pixel_of(along, ticks[i]);
        if (of_y)
            c->format->text(c, across->from - 4.0, at + 4.0, 1.0, false, number);
        else
            c->format->text(c, at, across->from + 14.0, 0.5, false, number);
    }
}

/* One of eight shapes that are distinguishable without colors, the last three hollow. */
static void put_mark(report_canvas *c, unsigned ink, double x, double y) {
    static const double corners[3][4][2] = {{{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}},
                                            {{0.0, -1.3}, {1.2, 0.9}, {-1.2, 0.9}, {0.0, -1.3}},
                                            {{0.0, -1.4}, {1.4, 0.0}, {0.0, 1.4}, {-1.4, 0.0}}};
    static const struct {
        size_t corners; /* row of vertices; 3: a circle */
        double size;
        bool hollow;
    } shapes[8] = {{3, 2.6, false},  {0, 2.3, false}, {1, 2.6, false}, {2, 2.5, false},
                   {1, -2.6, false}, {3, 2.6, true},  {0, 2.3, true},  {1, 2.8, true}};
    const size_t shape = (ink - REPORT_INK_SERIES) % 8;
    report_pen pen = report_pen_of(ink, shapes[shape].hollow ? 1.2 : 0.0);
    const double size = shapes[shape].size;
    pen.dashed = false;
    if (shapes[shape].corners == 3) {
        c->format->circle(c, &pen, x, y, size);
        return;
    }
    double xy[8];
    for (size_t i = 0; i < 4; ++i) {
        xy[2 * i] = x + size * corners[shapes[shape].corners][i][0];
        xy[2 * i + 1] = y + size * corners[shapes[shape].corners][i][1];
    }
    c->format->path(c, &pen, true, 4, xy);
}

static void put_line(const drawn_panel *d, const report_series *series) {
    double *const xy = malloc((2 * series->count + 1) * sizeof *xy);
    report_pen pen = report_pen_of(series->ink, 1.6);
    size_t count = 0;
    pen.dashed = pen.dashed || (series->parts & REPORT_DASHED) != 0;
    for (size_t i = 0; i < series->count && xy != NULL; ++i)
        if (report_drawable(d->panel, &series->points[i])) {
            xy[2 * count] = report_pixel_of(&d->x, series->points[i].x);
            xy[2 * count++ + 1] = report_pixel_of(&d->y, series->points[i].y);
        }
    if (count > 1)
        d->canvas->format->path(d->canvas, &pen, false, count, xy);
    free(xy);
}

static void put_bar(const drawn_panel *d, const report_series *series, const report_point *p) {
    if (!isfinite(p->low) || !isfinite(p->high))
        return;
    const double x = report_pixel_of(&d->x, p->x), top = report_pixel_of(&d->y, p->high);
    const double bottom =
        d->y.log && p->low <= 0.0 ? d->y.from : fmin(report_pixel_of(&d->y, p->low), d->y.from);
    report_pen pen = report_pen_of(series->ink, 1.0);
    pen.dashed = false;
    /* One line: the upper cap, down, and the lower cap unless the bar leaves the panel. */
    const double xy[] = {x - 3.0, top, x + 3.0, top, x, top, x, bottom, x - 3.0, bottom, x + 3.0, bottom};
    d->canvas->format->path(d->canvas, &pen, false, bottom < d->y.from ? 6 : 4, xy);
}

/* Draws dots and cells. Cells are slightly enlarged, to avoid seams between them. */
static void put_area(const drawn_panel *d, const report_series *series, const report_point *p) {
    report_pen pen = report_pen_of(series->ink, 0.0);
    if (series->ink == REPORT_INK_SCALE)
        pen.rgb = report_scale_color(&d->figure->scale, p->value);
    const double x = report_pixel_of(&d->x, p->x), y = report_pixel_of(&d->y, p->y);
    if ((series->parts & REPORT_DOTS) != 0)
        d->canvas->format->circle(d->canvas, &pen, x, y, p->size);
    if ((series->parts & REPORT_CELLS) != 0)
        box(d->canvas, &pen, report_pixel_of(&d->x, p->x - 0.5 * series->cell[0]) - 0.5,
            report_pixel_of(&d->y, p->y + 0.5 * series->cell[1]) - 0.5,
            report_pixel_of(&d->x, p->x + 0.5 * series->cell[0]) + 0.5,
            report_pixel_of(&d->y, p->y - 0.5 * series->cell[1]) + 0.5);
}

/* Thin lines between pairs of points. */
static void put_segments(const drawn_panel *d, const report_series *series) {
    const report_pen pen = report_pen_of(series->ink, 0.8);
    for (size_t i = 0; i + 1 < series->count; i += 2) {
        const report_point *const a = &series->points[i], *const b = a + 1;
        const double xy[4] = {report_pixel_of(&d->x, a->x), report_pixel_of(&d->y, a->y),
                              report_pixel_of(&d->x, b->x), report_pixel_of(&d->y, b->y)};
        if (report_drawable(d->panel, a) && report_drawable(d->panel, b))
            d->canvas->format->path(d->canvas, &pen, false, 2, xy);
    }
}

static void put_series(const drawn_panel *d, const report_series *series) {
    report_canvas *const c = d->canvas;
    if ((series->parts & REPORT_LINE) != 0)
        put_line(d, series);
    if ((series->parts & REPORT_SEGMENTS) != 0)
        put_segments(d, series);
    for (size_t i = 0; i < series->count && (series->parts & REPORT_BARS) != 0; ++i)
        if (report_drawable(d->panel, &series->points[i]))
            put_bar(d, series, &series->points[i]);
    for (size_t i = 0; i < series->count; ++i) {
        const report_point *const p = &series->points[i];
        if (!report_drawable(d->panel, p))
            continue;
        if ((series->parts & (REPORT_DOTS | REPORT_CELLS)) != 0)
            put_area(d, series, p);
        if ((series->parts & REPORT_MARKS) == 0)
            continue;
        c->title = c->inside && (series->parts & REPORT_LINE) != 0;
        c->label = series->label != NULL ? series->label : "";
        c->at[0] = p->x;
        c->at[1] = p->y;
        put_mark(c, series->ink, report_pixel_of(&d->x, p->x), report_pixel_of(&d->y, p->y));
        c->title = false;
    }
}

static void put_border(const drawn_panel *d) {
    report_canvas *const c = d->canvas;
    const report_panel *const panel = d->panel;
    const report_ruler *const x = &d->x, *const y = &d->y;
    const report_pen frame = report_pen_of(REPORT_INK_FRAME, 1.0);
    const double middle = 0.5 * (x->from + x->to), half_way = 0.5 * (y->from + y->to);
    if (panel->border == REPORT_BORDER_AXES) {
        put_ticks(c, x, y, false);
        put_ticks(c, y, x, true);
        if (panel->x.label != NULL)
            c->format->text(c, middle, y->from + 31.0, 0.5, false, panel->x.label);
        if (panel->y.label != NULL)
            c->format->text(c, x->from - 46.0, half_way, 0.5, true, panel->y.label);
    }
    if (panel->title != NULL)
        c->format->text(c, middle, y->to - 8.0, 0.5, false, panel->title);
    for (size_t i = 0; i < 2; ++i)
        if (panel->rings[i] > 0.0)
            c->format->circle(c, &frame, report_pixel_of(x, 0.0), report_pixel_of(y, 0.0),
                              report_pixel_of(x, panel->rings[i]) - report_pixel_of(x, 0.0));
}

static void put_panel(report_canvas *c, const report_figure *figure, size_t index, double left, double top) {
    const report_panel *const panel = &figure->panels[index];
    const bool axes = panel->border == REPORT_BORDER_AXES;
    const double above = axes || panel->title != NULL ? TOP : MARGIN;
    drawn_panel d = {.canvas = c, .figure = figure, .panel = panel};
    d.x = report_make_ruler(panel, false, left + (axes ? LEFT : MARGIN),
                            left + figure->width - (axes ? RIGHT : MARGIN));
    d.y = report_make_ruler(panel, true, top + figure->height - (axes ? BOTTOM : MARGIN), top + above);
    if (panel->equal)
        report_make_equal(&d.x, &d.y);
    put_border(&d);
    for (size_t s = 0; s < panel->series_count; ++s)
        put_series(&d, &panel->series[s]);
    const report_pen frame = report_pen_of(REPORT_INK_FRAME, 1.0);
    if (panel->border != REPORT_BORDER_NONE)
        box(c, &frame, d.x.from, d.y.to, d.x.to, d.y.from);
}

static void put_key(report_canvas *c, const report_series *series, double x, double y) {
    report_pen pen = report_pen_of(series->ink, 1.6);
    pen.dashed = pen.dashed || (series->parts & REPORT_DASHED) != 0;
    if ((series->parts & REPORT_LINE) != 0)
        c->format->path(c, &pen, false, 2, (const double[]){x, y, x + KEY, y});
    if ((series->parts & REPORT_MARKS) != 0)
        put_mark(c, series->ink, x + 0.5 * KEY, y);
}

/* Draws the legend below `top`; entries share a row if they fit, also in a font slightly wider than
 * Helvetica. Without a canvas it only returns its height. */
static double put_legend(report_canvas *c, const report_figure *figure, size_t panel, double left, double top,
                         double width) {
    const report_series *entries[MOST_ENTRIES];
    const size_t count = report_legend_entries(figure, panel, MOST_ENTRIES, entries);
    double widest = 0.0;
    for (size_t i = 0; i < count; ++i)
        widest = fmax(widest, KEY + 6.0 + 1.15 * report_text_width(entries[i]->label) + GAP);
    const size_t across =
        count > 0 ? (size_t)fmax(1.0, fmin(floor((width - LEFT) / widest), (double)count)) : 1;
    for (size_t i = 0; i < count && c != NULL; ++i) {
        const double x = left + LEFT + (double)(i % across) * widest;
        const double y = top + LINE * ((double)(i / across) + 0.5);
        put_key(c, entries[i], x, y);
        c->format->text(c, x + KEY + 6.0, y + 4.0, 0.0, false, entries[i]->label);
    }
    return count > 0 ? LINE * (double)((count + across - 1) / across) + 0.5 * LINE : 0.0;
}

/* A color bar from the lowest value at the bottom to the highest, with labels to its right. */
static void put_scale(report_canvas *c, const report_scale *scale, double left, double top, double bottom) {
    enum { STEPS = 64, WIDTH = 14 };
    const report_ruler r = {scale->low, scale->high, false, bottom, top};
    const report_pen frame = report_pen_of(REPORT_INK_FRAME, 1.0);
    report_pen pen = {.ink = REPORT_INK_SCALE};
    double ticks[REPORT_TICK_LIMIT];
    for (size_t i = 0; i < STEPS; ++i) {
        const double y = bottom + (top - bottom) * (double)i / STEPS;
        pen.rgb =
            report_scale_color(scale, scale->low + (scale->high - scale->low) * ((double)i + 0.5) / STEPS);
        box(c, &pen, left, bottom + (top - bottom) * (double)(i + 1) / STEPS - 0.5, left + WIDTH, y);
    }
    box(c, &frame, left, top, left + WIDTH, bottom);
    const size_t count = report_find_ticks(&r, ticks);
    for (size_t i = 0; i < count; ++i) {
        char number[32];
        aur_format(number, sizeof number, "%g", ticks[i]);
        line(c, REPORT_INK_FRAME, 1.0, left + WIDTH, report_pixel_of(&r, ticks[i]), left + WIDTH + 3.0,
             report_pixel_of(&r, ticks[i]));
        c->format->text(c, left + WIDTH + 5.0, report_pixel_of(&r, ticks[i]) + 4.0, 0.0, false, number);
    }
    c->format->text(c, left + SCALE - 12.0, 0.5 * (top + bottom), 0.5, true, scale->label);
}

static void draw(report_canvas *c, const report_figure *figure) {
    const size_t columns = figure->columns, rows = (figure->panel_count + columns - 1) / columns;
    const bool shared = figure->legend == REPORT_LEGEND_SHARED;
    double below = 0.0; /* of a panel */
    for (size_t p = 0; p < figure->panel_count && !shared; ++p)
        below = fmax(below, put_legend(NULL, figure, p, 0.0, 0.0, figure->width));
    const double width = figure->width * (double)columns, height = (figure->height + below) * (double)rows;
    c->width = ceil(width + (figure->scale.label != NULL ? SCALE : 0));
    c->height = ceil(height + (shared ? put_legend(NULL, figure, 0, 0.0, 0.0, width) : 0.0));
    c->format->begin(c);
    for (size_t p = 0; p < figure->panel_count; ++p) {
        const double left = figure->width * (double)(p % columns);
        const double top = (figure->height + below) * (double)(p / columns);
        put_panel(c, figure, p, left, top);
        if (!shared)
            put_legend(c, figure, p, left, top + figure->height, figure->width);
    }
    if (shared)
        put_legend(c, figure, 0, 0.0, height, width);
    if (figure->scale.label != NULL)
        put_scale(c, &figure->scale, width, TOP,
                  figure->height - (figure->panels->border == REPORT_BORDER_AXES ? BOTTOM : MARGIN));
    c->format->end(c);
}

/* NULL: TikZ, which has no canvas. */
static const struct {
    const char *name;
    const report_canvas_format *canvas;
} formats[] = {
    {"svg", &report_canvas_svg}, {"pdf", &report_canvas_pdf}, {"png", &report_canvas_png}, {"tex", NULL}};

enum { FORMATS = sizeof formats / sizeof formats[0] };

const char *report_figure_format(size_t index) {
    return index < FORMATS ? formats[index].name : NULL;
}

const char *report_figure_format_of(const char *path) {
    const char *const point = strrchr(path, '.');
    for (size_t i = 0; i < FORMATS && point != NULL; ++i)
        if (strcmp(point + 1, formats[i].name) == 0)
            return formats[i].name;
    return NULL;
}

aur_result report_figure_save(const char *path, const char *format, const report_figure *figure,
                              aur_error *error) {
    size_t of = 0, size = 0;
    while (of < FORMATS && strcmp(format, formats[of].name) != 0)
        ++of;
    if (of == FORMATS)
        return aur_fail(error, AUR_ERROR_NAME, "figures are written as svg, pdf, png or tex, not '%s'",
                        format);
    if (formats[of].canvas != NULL && formats[of].canvas->begin == NULL)
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "%s: png needs libaureole-render, which this program was built without", path);
    char *text = NULL;
    report_canvas canvas = {.format = formats[of].canvas,
                            .to = open_memstream(&text, &size),
                            .scale_by = figure->scale_by,
                            .font = figure->font};
    if (canvas.to == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    if (canvas.format != NULL)
        draw(&canvas, figure);
    else
        report_figure_tikz(canvas.to, figure);
    const bool failed = ferror(canvas.to) != 0;
    aur_result result;
    if (fclose(canvas.to) != 0 || failed)
        result = aur_fail(error, AUR_ERROR_MEMORY, "out of memory for the figure");
    else if (canvas.format != NULL && canvas.format->save != NULL)
        result = canvas.format->save(path, &canvas, error);
    else
        result = aur_file_write(path, size, text, error);
    free(canvas.pixels);
    free(text);
    return result;
}

void report_figure_put_panel(FILE *page, const report_figure *figure, size_t panel, const char *title) {
    report_canvas c = {.format = &report_canvas_svg, .to = page, .inside = true};
    aur_print(page, "<svg viewBox=\"0 0 %g %g\" role=\"img\"><title>", figure->width, figure->height);
    report_escape(page, title);
    fputs("</title>\n", page);
    put_panel(&c, figure, panel, 0.0, 0.0);
    c.format->end(&c);
}

void report_figure_put_key(FILE *page, const report_series *series) {
    report_canvas c = {.format = &report_canvas_svg, .to = page, .inside = true};
    fprintf(page, "<svg viewBox=\"0 0 %d 12\" aria-hidden=\"true\">", KEY);
    put_key(&c, series, 0.0, 6.0);
    c.format->end(&c);
}
