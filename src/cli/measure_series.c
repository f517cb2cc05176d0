/* Measures that are tables: spectra, cells. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/measure.h"
#include "cli/plot.h"

typedef struct series_item {
    const char *source;
    size_t count;
    aur_domain domain;
    aur_series *series;
} series_item;

typedef struct series_list {
    size_t count, capacity;
    series_item *items;
} series_list;

static aur_result add_series(const cli_measure_arguments *arguments, const char *source, size_t count,
                             void *context, aur_error *error) {
    series_list *const list = context;
    if (list->count == list->capacity) {
        const size_t capacity = list->capacity == 0 ? 8 : 2 * list->capacity;
        series_item *const larger = realloc(list->items, capacity * sizeof *larger);
        if (larger == NULL)
            return AUR_ERROR_MEMORY;
        list->items = larger;
        list->capacity = capacity;
    }
    aur_points *points;
    aur_points_view view;
    aur_result result = cli_load_points(source, &arguments->points, count, &points, &view, error);
    if (result != AUR_OK)
        return result;
    series_item item = {.source = source, .count = view.count, .domain = view.domain};
    result = aur_measure_series(arguments->metrics[0], &view, &arguments->options, &item.series, error);
    aur_points_destroy(points);
    if (result != AUR_OK && error->file[0] == '\0')
        snprintf(error->file, sizeof error->file, "%s", source);
    if (result == AUR_OK)
        list->items[list->count++] = item;
    return result;
}

static const double *row_of(const aur_series *series, size_t row) {
    return aur_series_values(series) + row * aur_series_column_count(series);
}

/* The second column against the first; a periodogram as a picture. */
static int plot_series(const cli_measure_arguments *arguments, const series_list *list) {
    cli_plot plot;
    const bool picture = strcmp(aur_series_column(list->items[0].series, 0), "kx") == 0;
    const size_t panels = picture ? list->count : 1;
    if (!cli_plot_open(arguments->plot, (int)panels * 480 + 320, 480, &plot))
        return CLI_BAD_INPUT;
    if (picture)
        fprintf(plot.script, "set size ratio -1\nset palette gray\nset multiplot layout 1,%zu\n",
                list->count);
    else
        fprintf(plot.script, "set grid\nset xlabel '%s'\nset ylabel '%s'\nset key outside\nplot ",
                aur_series_column(list->items[0].series, 0), aur_series_column(list->items[0].series, 1));
    for (size_t i = 0; i < list->count; ++i) {
        const series_item *const item = &list->items[i];
        if (picture)
            fputs("set cbrange [0:4]\nset title '", plot.script);
        else
            fprintf(plot.script, "%s'-' with %s title '", i > 0 ? ", " : "",
                    strcmp(aur_series_column(item->series, 0), "point") == 0 ? "points" : "lines");
        cli_plot_text(&plot, item->source);
        fprintf(plot.script, ", N = %zu' noenhanced%s", item->count,
                picture ? "\nunset key\nplot '-' with image\n" : "");
        for (size_t r = 0; r < aur_series_row_count(item->series) && picture; ++r) {
            const double *const row = row_of(item->series, r);
            fprintf(plot.script, "%g %g %g\n", row[0], row[1], row[2]);
        }
        if (picture)
            fputs("e\n", plot.script);
    }
    for (size_t i = 0; i < list->count && !picture; ++i) {
        const aur_series *const series = list->items[i].series;
        fputs(i == 0 ? "\n" : "", plot.script);
        for (size_t r = 0; r < aur_series_row_count(series); ++r)
            fprintf(plot.script, "%g %g\n", row_of(series, r)[0], row_of(series, r)[1]);
        fputs("e\n", plot.script);
    }
    fputs(picture ? "unset multiplot\n" : "", plot.script);
    return cli_plot_close(&plot);
}

static int print_series(const cli_measure_arguments *arguments, void *context) {
    const series_list *const list = context;
    const aur_series *const first = list->items[0].series;
    const size_t column_count = aur_series_column_count(first);
    const char *columns[3 + AUR_SERIES_COLUMNS_MAX] = {"set", "n", "domain"};
    for (size_t c = 0; c < column_count; ++c)
        columns[3 + c] = aur_series_column(first, c);
    cli_table *const table = cli_table_create(3 + column_count, columns);
    for (size_t i = 0; i < list->count; ++i) {
        const series_item *const item = &list->items[i];
        for (size_t r = 0; r < aur_series_row_count(item->series); ++r) {
            cli_table_text(table, item->source);
            cli_table_integer(table, item->count);
            cli_table_text(table, aur_domain_name(item->domain));
            for (size_t c = 0; c < column_count; ++c)
                cli_table_number(table, row_of(item->series, r)[c], 6);
        }
    }
    const int status = cli_table_print(table, arguments->format);
    cli_table_destroy(table);
    return status == CLI_SUCCESS && arguments->plot != NULL ? plot_series(arguments, list) : status;
}

int cli_measure_series(const cli_measure_arguments *arguments) {
    series_list list = {0};
    const int status = cli_measure_each(arguments, &list, add_series, print_series);
    for (size_t i = 0; i < list.count; ++i)
        aur_series_destroy(list.items[i].series);
    free(list.items);
    return status;
}
