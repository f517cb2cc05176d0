/* Pictures of measures that are tables: spectra, cells. */
#include <stdio.h>
#include <string.h>

#include "program/cli/measure.h"
#include "program/cli/plot.h"

static const double *row_of(const aur_series *series, size_t row) {
    return aur_series_values(series) + row * aur_series_column_count(series);
}

int cli_measure_plot_series(const cli_measure_arguments *arguments, const cli_measure_rows *rows) {
    cli_plot plot;
    const bool picture = strcmp(aur_series_column(rows->items[0].series, 0), "kx") == 0;
    const size_t panels = picture ? rows->count : 1;
    if (!cli_plot_open(arguments->plot, (int)panels * 480 + 320, 480, &plot))
        return CLI_BAD_INPUT;
    if (picture)
        fprintf(plot.script, "set size ratio -1\nset palette gray\nset multiplot layout 1,%zu\n",
                rows->count);
    else
        fprintf(plot.script, "set grid\nset xlabel '%s'\nset ylabel '%s'\nset key outside\nplot ",
                aur_series_column(rows->items[0].series, 0), aur_series_column(rows->items[0].series, 1));
    for (size_t i = 0; i < rows->count; ++i) {
        const cli_measure_row *const item = &rows->items[i];
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
    for (size_t i = 0; i < rows->count && !picture; ++i) {
        const aur_series *const series = rows->items[i].series;
        fputs(i == 0 ? "\n" : "", plot.script);
        for (size_t r = 0; r < aur_series_row_count(series); ++r)
            fprintf(plot.script, "%g %g\n", row_of(series, r)[0], row_of(series, r)[1]);
        fputs("e\n", plot.script);
    }
    fputs(picture ? "unset multiplot\n" : "", plot.script);
    return cli_plot_close(&plot);
}
