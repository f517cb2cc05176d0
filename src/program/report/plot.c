/* Plots of tables: assigns rows to panels and series. */
#include "program/report/report.h"

#include <aureole/core.h>
#include <aureole/text.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "program/report/canvas.h"

enum { LABEL = 160, GROUPS = 64 };

/* The names of panels or of series, in the order of the rows. */
typedef struct groups {
    size_t count;
    char names[GROUPS][LABEL];
} groups;

typedef struct layout {
    const report_table *table;
    const report_plot *plot;
    size_t x, y, low, high; /* columns */
    groups panels, series;
    report_panel panel[GROUPS];
    report_series *drawn; /* the series of panel p begin at p * series.count */
    report_point *points;
    report_figure figure;
} layout;

/* The cells of a row in a list of columns, separated by blanks. */
static void label(const report_table *table, size_t row, const char *columns, char text[LABEL]) {
    text[0] = '\0';
    while (columns != NULL && *columns != '\0') {
        char name[64];
        const size_t length = strcspn(columns, ",");
        snprintf(name, sizeof name, "%.*s", (int)length, columns);
        columns += length + (columns[length] == ',');
        const size_t column = report_find(table, name), used = strlen(text);
        if (column == SIZE_MAX)
            continue;
        const double value = report_value(table, row, column);
        if (isnan(value))
            snprintf(text + used, LABEL - used, "%s%s", used > 0 ? " " : "", report_cell(table, row, column));
        else
            aur_format(text + used, LABEL - used, "%s%s %g", used > 0 ? " " : "", name, value);
    }
}

/* The index of a row's group, which is added if new; GROUPS if there are too many. */
static size_t join(groups *g, const layout *l, size_t row, const char *columns) {
    char name[LABEL];
    label(l->table, row, columns, name);
    size_t i = 0;
    while (i < g->count && strcmp(g->names[i], name) != 0)
        ++i;
    if (i == g->count && i < GROUPS)
        memcpy(g->names[g->count++], name, LABEL);
    return i;
}

static report_point point_of(const layout *l, size_t row) {
    return (report_point){.x = report_value(l->table, row, l->x),
                          .y = report_value(l->table, row, l->y),
                          .low = report_value(l->table, row, l->low),
                          .high = report_value(l->table, row, l->high)};
}

static bool is_drawn(const layout *l, const report_point *p) {
    return isfinite(p->x) && isfinite(p->y) && !(l->plot->log_x && p->x <= 0.0) &&
           !(l->plot->log_y && p->y <= 0.0);
}

static int by_x(const void *a, const void *b) {
    const report_point *const p = a, *const q = b;
    return (p->x > q->x) - (p->x < q->x);
}

/* The points of a panel and series, sorted by x for lines. */
static size_t collect(layout *l, size_t panel, size_t series, report_point *points) {
    size_t count = 0;
    for (size_t row = 0; row < report_rows(l->table); ++row) {
        const report_point p = point_of(l, row);
        if (is_drawn(l, &p) && join(&l->panels, l, row, l->plot->panel) == panel &&
            join(&l->series, l, row, l->plot->series) == series)
            points[count++] = p;
    }
    if (count > 0 && !l->plot->points)
        qsort(points, count, sizeof *points, by_x);
    return count;
}

static void fill(layout *l) {
    const report_plot *const plot = l->plot;
    report_point *points = l->points;
    const unsigned parts =
        REPORT_MARKS | (plot->points ? 0 : REPORT_LINE) | (plot->low != NULL ? REPORT_BARS : 0);
    for (size_t p = 0; p < l->panels.count; ++p) {
        l->panel[p] = (report_panel){.title = l->panels.names[p],
                                     .x = {.label = plot->x, .log = plot->log_x},
                                     .y = {.label = plot->y, .log = plot->log_y},
                                     .equal = plot->points,
                                     .series_count = l->series.count,
                                     .series = l->drawn + p * l->series.count};
        for (size_t s = 0; s < l->series.count; ++s) {
            const size_t count = collect(l, p, s, points);
            l->drawn[p * l->series.count + s] = (report_series){.label = l->series.names[s],
                                                                .parts = parts,
                                                                .ink = REPORT_INK_SERIES + (unsigned)s,
                                                                .count = count,
                                                                .points = points};
            points += count;
        }
    }
    l->figure =
        (report_figure){.panel_count = l->panels.count, .panels = l->panel, .legend = REPORT_LEGEND_SHARED};
}

static void destroy(layout *l) {
    if (l != NULL) {
        free(l->drawn);
        free(l->points);
    }
    free(l);
}

/* The layout of a plot; without panels if a column is missing or no row has numbers. NULL when out of memory.
 */
static layout *create(const report_table *table, const report_plot *plot) {
    layout *const l = calloc(1, sizeof *l);
    if (l == NULL)
        return NULL;
    l->table = table;
    l->plot = plot;
    l->x = report_find(table, plot->x);
    l->y = report_find(table, plot->y);
    l->low = report_find(table, plot->low);
    l->high = report_find(table, plot->high);
    for (size_t row = 0; row < report_rows(table) && l->x != SIZE_MAX && l->y != SIZE_MAX; ++row) {
        const report_point p = point_of(l, row);
        if (is_drawn(l, &p)) {
            join(&l->panels, l, row, plot->panel);
            join(&l->series, l, row, plot->series);
        }
    }
    l->drawn = calloc(l->panels.count * l->series.count + 1, sizeof *l->drawn);
    l->points = calloc(report_rows(table) + 1, sizeof *l->points);
    if (l->drawn != NULL && l->points != NULL) {
        fill(l);
        return l;
    }
    destroy(l);
    return NULL;
}

static aur_result save_data(const char *path, const report_figure *figure, aur_error *error) {
    char *text = NULL;
    size_t size = 0;
    FILE *const to = open_memstream(&text, &size);
    if (to != NULL)
        report_figure_data(to, figure);
    const bool written = to != NULL && fclose(to) == 0;
    const aur_result result = written ? aur_file_write(path, size, text, error)
                                      : aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    free(text);
    return result;
}

/* Converts to pixels of 1/100 inch, such that the font size in points is REPORT_TEXT_SIZE in pixels. */
static void apply_style(const report_style *style, report_figure *figure) {
    figure->width = 500.0;
    figure->height = 360.0;
    if (style == NULL)
        return;
    figure->scale_by = style->text_size / (0.72 * REPORT_TEXT_SIZE);
    const double pixels = 100.0 / 2.54 / figure->scale_by;
    figure->width = pixels * style->width / (double)figure->columns;
    figure->height = pixels * style->height;
    figure->font = style->font;
    figure->data = style->data;
}

aur_result report_plot_save(const char *path, const report_table *table, const report_plot *plot,
                            const report_style *style, bool *drawn, aur_error *error) {
    layout *const l = create(table, plot);
    if (l == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    aur_result result = AUR_OK;
    const char *const format = report_figure_format_of(path);
    l->figure.columns = l->panels.count < 2 ? 1 : 2;
    apply_style(style, &l->figure);
    *drawn = l->panels.count > 0;
    if (*drawn)
        result = report_figure_save(path, format != NULL ? format : path, &l->figure, error);
    if (*drawn && result == AUR_OK && l->figure.data != NULL)
        result = save_data(l->figure.data, &l->figure, error);
    destroy(l);
    return result;
}

aur_result report_plot_put(FILE *page, const report_table *table, const report_plot *plot, aur_error *error) {
    layout *const l = create(table, plot);
    if (l == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    l->figure.width = 360.0;
    l->figure.height = 260.0;
    fputs(l->panels.count > 0 ? "<figure class=\"plot\"><figcaption>" : "", page);
    report_escape(page, l->panels.count > 0 ? plot->title : "");
    fputs(l->panels.count > 0 ? "</figcaption>\n<ul class=\"legend\">" : "", page);
    for (size_t s = 0; s < l->series.count && l->series.names[s][0] != '\0'; ++s) {
        fputs("<li>", page);
        report_figure_put_key(page, &l->drawn[s]);
        report_escape(page, l->series.names[s]);
        fputs("</li>", page);
    }
    fputs(l->panels.count > 0 ? "</ul>\n<div class=\"panels\">\n" : "", page);
    for (size_t p = 0; p < l->panels.count; ++p)
        report_figure_put_panel(page, &l->figure, p, plot->title);
    fputs(l->panels.count > 0 ? "</div></figure>\n" : "", page);
    destroy(l);
    return AUR_OK;
}
