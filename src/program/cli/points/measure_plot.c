/* Measures against N on log-log axes, and tables. */
#include <aureole/text.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "program/cli/points/measure.h"
#include "program/report/figure.h"

/* The power law value = factor * N^slope, fitted by least squares of the logarithms. */
typedef struct power_model {
    size_t count; /* points with finite logarithms */
    double slope, factor;
} power_model;

static double figure_of(const cli_measure_arguments *arguments, const cli_measure_row *row, size_t metric,
                        size_t which) {
    return row->figures[metric * cli_figures_per_metric(arguments) + which];
}

static bool drawable(double value) {
    return isfinite(value) && value > 0.0;
}

static power_model fit(const cli_measure_arguments *arguments, const cli_measure_rows *rows,
                       const char *source, size_t metric) {
    double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
    size_t count = 0;
    for (size_t r = 0; r < rows->count; ++r) {
        const cli_measure_row *const row = &rows->items[r];
        const double value = figure_of(arguments, row, metric, 0);
        if (row->source != source || !drawable(value))
            continue;
        const double a = log((double)row->count), b = log(value);
        x += a;
        y += b;
        xx += a * a;
        xy += a * b;
        ++count;
    }
    const double n = (double)count;
    const double spread = n * xx - x * x;
    if (count < 2 || !(spread > 1e-9))
        return (power_model){.count = 0};
    const double slope = (n * xy - x * y) / spread;
    return (power_model){count, slope, exp((y - slope * x) / n)};
}

enum { LABEL = 512 };

/* The data of a figure: values and fitted line for each metric and source. */
typedef struct drawing {
    report_panel *panels;
    report_series *series;
    report_point *points;
    char (*labels)[LABEL];
} drawing;

static bool allocate(drawing *d, size_t panels, size_t series, size_t points) {
    d->panels = calloc(panels, sizeof *d->panels);
    d->series = calloc(series, sizeof *d->series);
    d->points = calloc(points, sizeof *d->points);
    d->labels = calloc(series, sizeof *d->labels);
    return d->panels != NULL && d->series != NULL && d->points != NULL && d->labels != NULL;
}

/* Writes the figure, or prints the error, and frees its data; returns the exit status. */
static int finish(drawing *d, bool allocated, const char *path, const report_figure *figure) {
    aur_error error = {.result = AUR_ERROR_MEMORY, .message = "out of memory"};
    const int status =
        allocated
            ? cli_status(report_figure_save(path, report_figure_format_of(path), figure, &error), &error)
            : cli_fail(&error);
    free(d->panels);
    free(d->series);
    free(d->points);
    free(d->labels);
    return status;
}

/* Adds a source's values and its line as two series; returns the end of its points. */
static report_point *plot_source(const cli_measure_arguments *arguments, const cli_measure_rows *rows,
                                 size_t metric, size_t source, report_series *series, char *label,
                                 report_point *points) {
    const char *const name = arguments->sources[source];
    const power_model power_fit = fit(arguments, rows, name, metric);
    const bool spread = arguments->seed_count > 0;
    const unsigned ink = REPORT_INK_SERIES + (unsigned)source;
    double least = INFINITY, most = 0.0;
    series[0] = (report_series){
        .label = label, .parts = REPORT_MARKS | (spread ? REPORT_BARS : 0), .ink = ink, .points = points};
    for (size_t r = 0; r < rows->count; ++r) {
        const cli_measure_row *const row = &rows->items[r];
        const double value = figure_of(arguments, row, metric, 0);
        if (row->source != name || !drawable(value))
            continue;
        const double deviation = spread ? figure_of(arguments, row, metric, 1) : NAN, n = (double)row->count;
        points[series[0].count++] =
            (report_point){.x = n, .y = value, .low = value - deviation, .high = value + deviation};
        least = fmin(least, n);
        most = fmax(most, n);
    }
    points += series[0].count;
    series[1] = (report_series){.parts = REPORT_LINE | REPORT_DASHED, .ink = ink, .points = points};
    if (power_fit.count == 0) {
        snprintf(label, LABEL, "%s", name);
        return points;
    }
    aur_format(label, LABEL, "%s  slope %.3f", name, power_fit.slope);
    points[0] = (report_point){.x = least, .y = power_fit.factor * pow(least, power_fit.slope)};
    points[1] = (report_point){.x = most, .y = power_fit.factor * pow(most, power_fit.slope)};
    series[1].count = 2;
    return points + 2;
}

static void print_slopes(const cli_measure_arguments *arguments, const cli_measure_rows *rows) {
    for (size_t m = 0; m < arguments->metrics.count; ++m)
        for (size_t s = 0; s < arguments->source_count; ++s) {
            const power_model power_fit = fit(arguments, rows, arguments->sources[s], m);
            if (power_fit.count > 0)
                fprintf(stderr, "%s of %s: slope %.4f over %zu sizes\n", cli_metric(arguments, m),
                        arguments->sources[s], power_fit.slope, power_fit.count);
        }
}

static bool has_values(const cli_measure_arguments *arguments, const cli_measure_rows *rows, size_t metric) {
    for (size_t r = 0; r < rows->count; ++r)
        if (drawable(figure_of(arguments, &rows->items[r], metric, 0)))
            return true;
    cli_bad_usage(
        "--plot: no value of '%s' is positive and finite, so none can be drawn on a logarithmic axis",
        cli_metric(arguments, metric));
    return false;
}

int cli_measure_plot(const cli_measure_arguments *arguments, const cli_measure_rows *rows) {
    const size_t metrics = arguments->metrics.count, sources = arguments->source_count;
    for (size_t m = 0; m < metrics; ++m)
        if (!has_values(arguments, rows, m))
            return CLI_BAD_INPUT;
    drawing d = {0};
    const bool allocated =
        allocate(&d, metrics, 2 * metrics * sources, metrics * (rows->count + 2 * sources));
    report_point *points = d.points;
    for (size_t m = 0; m < metrics && allocated; ++m) {
        report_series *const series = d.series + 2 * m * sources;
        d.panels[m] = (report_panel){.x = {.label = "N", .log = true},
                                     .y = {.label = cli_metric(arguments, m), .log = true},
                                     .series_count = 2 * sources,
                                     .series = series};
        for (size_t s = 0; s < sources; ++s)
            points = plot_source(arguments, rows, m, s, series + 2 * s, d.labels[m * sources + s], points);
    }
    const report_figure figure = {.width = 640.0,
                                  .height = 400.0,
                                  .columns = 1,
                                  .panel_count = metrics,
                                  .panels = d.panels,
                                  .legend = REPORT_LEGEND_EACH};
    const int status = finish(&d, allocated, arguments->plot, &figure);
    if (status == CLI_SUCCESS && !arguments->common.quiet)
        print_slopes(arguments, rows);
    return status;
}

/* One table: lines or points of the second column over the first, or an image of the third. */
static void plot_table(const cli_measure_row *row, size_t index, report_series *series, char *label,
                       report_point *points) {
    const aur_series *const table = row->series;
    const size_t columns = aur_series_column_count(table), count = aur_series_row_count(table);
    const double *const values = aur_series_values(table);
    const char *const first = aur_series_column(table, 0);
    const bool is_image = strcmp(first, "kx") == 0;
    snprintf(label, LABEL, "%s, N = %zu", row->source, row->count);
    for (size_t r = 0; r < count; ++r)
        points[r] = (report_point){.x = values[r * columns],
                                   .y = values[r * columns + 1],
                                   .value = values[r * columns + columns - 1]};
    *series = (report_series){.label = is_image ? NULL : label,
                              .parts = is_image                      ? REPORT_CELLS
                                       : strcmp(first, "point") == 0 ? REPORT_MARKS
                                                                     : REPORT_LINE,
                              .ink = is_image ? REPORT_INK_SCALE : REPORT_INK_SERIES + (unsigned)index,
                              .cell = {1.0, 1.0}, /* frequencies are integers */
                              .count = count,
                              .points = points};
}

int cli_measure_plot_series(const cli_measure_arguments *arguments, const cli_measure_rows *rows) {
    const aur_series *const first = rows->items[0].series;
    const bool is_image = strcmp(aur_series_column(first, 0), "kx") == 0;
    const size_t panels = is_image ? rows->count : 1;
    size_t point_count = 0;
    for (size_t i = 0; i < rows->count; ++i)
        point_count += aur_series_row_count(rows->items[i].series);
    drawing d = {0};
    const bool allocated = allocate(&d, panels, rows->count, point_count + 1);
    report_point *points = d.points;
    for (size_t i = 0; i < rows->count && allocated; ++i) {
        plot_table(&rows->items[i], i, &d.series[i], d.labels[i], points);
        points += d.series[i].count;
    }
    for (size_t p = 0; p < panels && allocated; ++p)
        d.panels[p] = (report_panel){.title = is_image ? d.labels[p] : NULL,
                                     .x = {.label = aur_series_column(first, 0)},
                                     .y = {.label = aur_series_column(first, 1)},
                                     .equal = is_image,
                                     .series_count = is_image ? 1 : rows->count,
                                     .series = d.series + p};
    report_figure figure = {.width = is_image ? 480.0 : 800.0,
                            .height = 480.0,
                            .columns = panels,
                            .panel_count = panels,
                            .panels = d.panels,
                            .legend = REPORT_LEGEND_EACH};
    if (is_image)
        figure.scale = (report_scale){"power", 0.0, 4.0, 2, {0x000000, 0xffffff}};
    return finish(&d, allocated, arguments->plot, &figure);
}
