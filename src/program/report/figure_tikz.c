/* TikZ for papers: pgfplots draws axes and legends from the data in the text. */
#include <aureole/text.h>
#include <math.h>
#include <string.h>

#include "program/report/canvas.h"
#include "program/report/figure.h"
#include "program/report/report.h"

enum { MOST_ENTRIES = 64 };

static void put_key(FILE *to, const char *key, const char *text) {
    if (text == NULL || text[0] == '\0')
        return;
    fprintf(to, ", %s={", key);
    report_escape_latex(to, text);
    fputc('}', to);
}

/* The color and shape of a series, as options. */
static void put_style(FILE *to, const report_series *series) {
    static const char *const marks[] = {
        "*", "square*", "triangle*", "diamond*", "triangle*, mark options={rotate=180}",
        "o", "square",  "triangle"};
    const unsigned k = series->ink >= REPORT_INK_SERIES ? (series->ink - REPORT_INK_SERIES) : 0;
    if (series->ink != REPORT_INK_SCALE)
        fprintf(to, "color=%s%u, ", series->ink >= REPORT_INK_SERIES ? "series" : "ink",
                series->ink >= REPORT_INK_SERIES ? k % 8 + 1 : series->ink);
    if ((series->parts & REPORT_LINE) == 0)
        fputs("only marks", to);
    else
        fprintf(to, "thick%s", k >= 8 || (series->parts & REPORT_DASHED) != 0 ? ", dashed" : "");
    if ((series->parts & REPORT_MARKS) != 0)
        fprintf(to, ", mark=%s, mark size=1.8", marks[k % 8]);
    else
        fputs((series->parts & REPORT_DOTS) != 0 ? ", mark=*" : ", mark=none", to);
}

/* The corners of a cell, counterclockwise. */
static void put_cell(FILE *to, const report_series *series, const report_point *p) {
    for (size_t i = 0; i < 4; ++i)
        aur_print(to, "%.9g %.9g %.9g\\\\\n", p->x + (i == 1 || i == 2 ? 0.5 : -0.5) * series->cell[0],
                  p->y + (i > 1 ? 0.5 : -0.5) * series->cell[1], p->value);
}

static void put_segments(FILE *to, const report_series *series) {
    for (size_t i = 0; i + 1 < series->count; i += 2)
        aur_print(to, "\\draw[thin] (axis cs:%.9g,%.9g) -- (axis cs:%.9g,%.9g);\n", series->points[i].x,
                  series->points[i].y, series->points[i + 1].x, series->points[i + 1].y);
}

/* The coordinates of a series in the text. */
static void put_reference(FILE *to, const char *data, size_t number, bool bars) {
    const char *const slash = strrchr(data, '/');
    fprintf(to, "] table[x=x%zu, y=y%zu", number, number);
    if (bars)
        fprintf(to, ", y error plus=above%zu, y error minus=below%zu", number, number);
    fprintf(to, "] {%s};\n", slash != NULL ? slash + 1 : data);
}

static double above(const report_point *p) {
    return isfinite(p->high) ? p->high - p->y : 0.0;
}

static double below(const report_point *p) {
    return isfinite(p->low) ? p->y - p->low : 0.0;
}

static bool in_file(const report_series *series) {
    return series->count > 0 && (series->parts & (REPORT_SEGMENTS | REPORT_CELLS | REPORT_DOTS)) == 0;
}

static void put_series(FILE *to, const report_panel *panel, const report_series *series, const char *data,
                       size_t number) {
    if ((series->parts & REPORT_SEGMENTS) != 0) {
        put_segments(to, series);
        return;
    }
    const bool bars = (series->parts & REPORT_BARS) != 0, cells = (series->parts & REPORT_CELLS) != 0;
    const bool dots = (series->parts & REPORT_DOTS) != 0, scaled = series->ink == REPORT_INK_SCALE;
    if (series->count == 0)
        return;
    fputs("\\addplot[forget plot, ", to);
    if (cells)
        fputs("patch, patch type=rectangle, shader=flat, draw=none, point meta=explicit", to);
    else
        put_style(to, series);
    if (dots) { /* each with its radius */
        char ink[32] = "mapped color";
        if (!scaled)
            snprintf(ink, sizeof ink, "ink%u", series->ink);
        fprintf(to,
                ", scatter, scatter/use mapped color={draw=%s, fill=%s}, point meta=explicit,\n  "
                "visualization depends on={\\thisrow{size} \\as \\dotsize}, "
                "scatter/@pre marker code/.append style={/tikz/mark size=\\dotsize}",
                ink, ink);
    }
    if (bars)
        fputs(", error bars/.cd, y dir=both, y explicit", to);
    if (data != NULL && in_file(series)) {
        put_reference(to, data, number, bars);
        return;
    }
    fprintf(to, "] table[x=x, y=y%s%s, row sep=\\\\] {\n%s\\\\\n",
            bars ? ", y error plus=above, y error minus=below" : "", cells || dots ? ", meta=value" : "",
            bars    ? "x y above below"
            : dots  ? "x y value size"
            : cells ? "x y value"
                    : "x y");
    for (size_t i = 0; i < series->count; ++i) {
        const report_point *const p = &series->points[i];
        if (!report_drawable(panel, p))
            continue;
        if (cells)
            put_cell(to, series, p);
        else if (dots)
            aur_print(to, "%.9g %.9g %.9g %.3g\\\\\n", p->x, p->y, scaled ? p->value : 0.0, 0.72 * p->size);
        else if (bars)
            aur_print(to, "%.9g %.9g %.9g %.9g\\\\\n", p->x, p->y, above(p), below(p));
        else
            aur_print(to, "%.9g %.9g\\\\\n", p->x, p->y);
    }
    fputs("};\n", to);
}

/* A list of tick labels; on a logarithmic axis pgfplots would write 10^{0.05}. */
static void put_ticks(FILE *to, const char *key, size_t count, const double *ticks) {
    fprintf(to, ", %s={", key);
    for (size_t i = 0; i < count; ++i)
        aur_print(to, "%s%g", i > 0 ? "," : "", ticks[i]);
    fputc('}', to);
}

static void put_axis(FILE *to, const report_panel *panel, bool of_y) {
    static const char *const keys[2][6] = {{"xmode=log", "xmin", "xmax", "xtick", "xticklabels", "xlabel"},
                                           {"ymode=log", "ymin", "ymax", "ytick", "yticklabels", "ylabel"}};
    const report_axis *const axis = of_y ? &panel->y : &panel->x;
    const char *const *const key = keys[of_y];
    double ticks[REPORT_TICK_LIMIT];
    if (axis->low < axis->high)
        aur_print(to, ", %s=%.9g, %s=%.9g", key[1], axis->low, key[2], axis->high);
    if (panel->border != REPORT_BORDER_AXES)
        return;
    if (axis->log) {
        const report_ruler ruler = report_make_ruler(panel, of_y, 0.0, 1.0);
        const size_t count = report_find_ticks(&ruler, ticks);
        fprintf(to, ", %s", key[0]);
        put_ticks(to, key[3], count, ticks);
        put_ticks(to, key[4], count, ticks);
    }
    put_key(to, key[5], axis->label);
}

static void put_panel(FILE *to, const report_figure *figure, size_t index) {
    const report_panel *const panel = &figure->panels[index];
    const bool axes = panel->border == REPORT_BORDER_AXES, last = index + 1 == figure->panel_count;
    const report_series *entries[MOST_ENTRIES];
    const double scale = figure->scale_by > 0.0 ? figure->scale_by : 1.0;
    aur_print(to, "\\nextgroupplot[width=%gbp, height=%gbp%s", 0.72 * scale * figure->width,
              0.72 * scale * figure->height, axes ? ", grid=major" : ", ticks=none");
    put_key(to, "title", panel->title);
    put_axis(to, panel, false);
    put_axis(to, panel, true);
    fputs(panel->equal ? ", axis equal" : "", to);
    fputs(panel->border == REPORT_BORDER_NONE ? ", axis line style={draw=none}" : "", to);
    if (figure->scale.label != NULL && last) {
        fputs(", colorbar, colorbar style={", to);
        fputs("ytick pos=right", to);
        put_key(to, "ylabel", figure->scale.label);
        fputc('}', to);
    }
    fputs("]\n", to);
    for (size_t i = 0; i < 2; ++i)
        if (panel->rings[i] > 0.0)
            aur_print(to, "\\draw[ink3] (axis cs:0,0) circle[radius=%.9g];\n", panel->rings[i]);
    size_t before = 0;
    for (size_t i = 0; i < index; ++i)
        before += figure->panels[i].series_count;
    for (size_t s = 0; s < panel->series_count; ++s)
        put_series(to, panel, &panel->series[s], figure->data, before + s + 1);
    const size_t count = figure->legend == REPORT_LEGEND_SHARED && !last
                             ? 0
                             : report_legend_entries(figure, index, MOST_ENTRIES, entries);
    for (size_t e = 0; e < count; ++e) {
        fputs("\\addlegendimage{", to);
        put_style(to, entries[e]);
        fputs("}\\addlegendentry{", to);
        report_escape_latex(to, entries[e]->label);
        fputs("}\n", to);
    }
}

/* Row `row` of the drawn points of a series; row 0 has the column names. */
static void put_data(FILE *to, const report_panel *panel, const report_series *series, size_t number,
                     size_t row) {
    const bool bars = (series->parts & REPORT_BARS) != 0;
    const report_point *found = NULL;
    for (size_t i = 0, seen = 0; i < series->count && row > 0 && found == NULL; ++i)
        if (report_drawable(panel, &series->points[i]) && ++seen == row)
            found = &series->points[i];
    if (row == 0)
        fprintf(to, bars ? "x%zu y%zu above%zu below%zu " : "x%zu y%zu ", number, number, number, number);
    else if (found == NULL)
        fputs(bars ? "nan nan nan nan " : "nan nan ", to);
    else if (bars)
        aur_print(to, "%.9g %.9g %.9g %.9g ", found->x, found->y, above(found), below(found));
    else
        aur_print(to, "%.9g %.9g ", found->x, found->y);
}

void report_figure_data(FILE *to, const report_figure *figure) {
    size_t rows = 0;
    for (size_t p = 0; p < figure->panel_count; ++p)
        for (size_t s = 0; s < figure->panels[p].series_count; ++s)
            rows = figure->panels[p].series[s].count > rows ? figure->panels[p].series[s].count : rows;
    for (size_t row = 0; row <= rows; ++row) {
        size_t number = 1;
        for (size_t p = 0; p < figure->panel_count; ++p)
            for (size_t s = 0; s < figure->panels[p].series_count; ++s, ++number)
                if (in_file(&figure->panels[p].series[s]))
                    put_data(to, &figure->panels[p], &figure->panels[p].series[s], number, row);
        fputc('\n', to);
    }
}

void report_figure_tikz(FILE *to, const report_figure *figure) {
    const size_t columns = figure->columns, rows = (figure->panel_count + columns - 1) / columns;
    fputs("% \\usepackage{pgfplots}\\usepgfplotslibrary{groupplots}\\pgfplotsset{compat=1.16}\n", to);
    for (unsigned k = 0; k < 8; ++k)
        fprintf(to, "\\definecolor{series%u}{HTML}{%06X}\n", k + 1,
                (unsigned)report_pen_of(REPORT_INK_SERIES + k, 1.0).rgb);
    for (unsigned ink = 0; ink < REPORT_INK_SCALE; ++ink)
        fprintf(to, "\\definecolor{ink%u}{HTML}{%06X}\n", ink, (unsigned)report_pen_of(ink, 1.0).rgb);
    fprintf(
        to,
        "\\begin{tikzpicture}\n\\begin{groupplot}[group style={group size=%zu by %zu, horizontal sep=50bp, "
        "vertical sep=%dbp},\n  legend style={at={(0.5,0)}, yshift=-34bp, anchor=north, draw=none, "
        "font=\\small, "
        "cells={anchor=west}}",
        columns, rows, figure->legend == REPORT_LEGEND_EACH ? 110 : 60);
    if (figure->scale.label != NULL) {
        fputs(",\n  colormap={scale}{", to);
        for (size_t i = 0; i < figure->scale.stop_count; ++i)
            fprintf(to, "rgb255=(%u,%u,%u) ", (unsigned)figure->scale.stops[i] >> 16 & 255,
                    (unsigned)figure->scale.stops[i] >> 8 & 255, (unsigned)figure->scale.stops[i] & 255);
        aur_print(to, "}, point meta min=%.9g, point meta max=%.9g", figure->scale.low, figure->scale.high);
    }
    fputs("]\n", to);
    for (size_t p = 0; p < figure->panel_count; ++p)
        put_panel(to, figure, p);
    fputs("\\end{groupplot}\n\\end{tikzpicture}\n", to);
}
