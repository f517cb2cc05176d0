/* Plots as commands for gnuplot, which draws them for print. */
#include <aureole/text.h>
#include <math.h>
#include <stdlib.h>

#include "program/report/plot_layout.h"

/* A text between single quotes: quotes are doubled, and what would end the command becomes a question mark.
 */
static void put_text(FILE *script, const char *before, const char *text) {
    fprintf(script, "%s'", before);
    for (; *text != '\0'; ++text)
        if (*text == '\'')
            fputs("''", script);
        else
            fputc((unsigned char)*text < ' ' ? '?' : *text, script);
    fputc('\'', script);
}

static void put_panel(FILE *script, const report_layout *l, size_t panel, report_plotted *points) {
    put_text(script, "set title ", l->panels[panel]);
    fputs("\nplot ", script);
    size_t drawn = 0;
    for (size_t s = 0; s < l->series_count; ++s)
        if (report_layout_points(l, panel, s, points) > 0) {
            const bool intervals = l->plot->low != NULL;
            const char *const style = intervals         ? l->plot->points ? "yerrorbars" : "yerrorlines"
                                      : l->plot->points ? "points"
                                                        : "linespoints";
            /* A series keeps its colour from panel to panel. */
            fprintf(script, "%s'-' using %s with %s linetype %zu pointtype 7 pointsize .4",
                    drawn++ > 0 ? ", " : "", intervals ? "1:2:3:4" : "1:2", style, s + 1);
            put_text(script, " title ", l->series[s]);
        }
    fputc('\n', script);
    for (size_t s = 0; s < l->series_count; ++s) {
        const size_t count = report_layout_points(l, panel, s, points);
        for (size_t i = 0; i < count; ++i)
            aur_print(script, "%.9g %.9g %.9g %.9g\n", points[i].x, points[i].y,
                      isfinite(points[i].low) ? points[i].low : points[i].y,
                      isfinite(points[i].high) ? points[i].high : points[i].y);
        fputs(count > 0 ? "e\n" : "", script);
    }
}

size_t report_plot_script(FILE *script, const report_table *table, const report_plot *plot) {
    report_layout *const l = malloc(sizeof *l);
    report_plotted *const points = malloc((report_rows(table) + 1) * sizeof *points);
    size_t panels = 0;
    if (l != NULL && points != NULL && report_layout_begin(l, table, plot)) {
        panels = l->panel_count;
        const size_t columns = panels < 2 ? 1 : 2;
        fputs("set termoption noenhanced\nset encoding utf8\nset key outside below\nset grid\n", script);
        put_text(script, "set xlabel ", plot->x);
        put_text(script, "\nset ylabel ", plot->y);
        fprintf(script, "\n%s%sset autoscale xfix\nset offsets graph .05, graph .05, %s\n",
                plot->log_x ? "set logscale x\n" : "", plot->log_y ? "set logscale y\n" : "",
                plot->log_y ? "0, 0" : "graph .05, graph .05");
        if (plot->points)
            fputs("set size ratio -1\n", script);
        fprintf(script, "set multiplot layout %zu,%zu\n", (panels + columns - 1) / columns, columns);
        for (size_t p = 0; p < panels; ++p)
            put_panel(script, l, p, points);
        fputs("unset multiplot\n", script);
    }
    free(l);
    free(points);
    return panels;
}
