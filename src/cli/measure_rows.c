/* The rows of `aureole measure`: one for each set or file and size. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/measure.h"

/* All metrics of one set of points into values[metric_count]; messages name the file. */
static aur_result measure_points(const cli_measure_arguments *arguments, const char *source, size_t count,
                                 uint64_t seed, cli_measure_row *row, double *values, aur_error *error) {
    cli_point_options options = arguments->points;
    options.seed = seed;
    aur_points *points;
    aur_points_view view;
    aur_result result = cli_load_points(source, &options, count, &points, &view, error);
    if (result != AUR_OK)
        return result;
    row->count = view.count;
    row->domain = view.domain;
    for (size_t m = 0; m < arguments->metric_count && result == AUR_OK; ++m)
        result = aur_measure(arguments->metrics[m], &view, &arguments->options, &values[m], error);
    if (result != AUR_OK && error->file[0] == '\0')
        snprintf(error->file, sizeof error->file, "%s", source);
    aur_points_destroy(points);
    return result;
}

/* Mean, spread (the sample's standard deviation) and root mean square over seeds. */
static aur_result measure_seeds(const cli_measure_arguments *arguments, const char *source, size_t count,
                                cli_measure_row *row, double *values, aur_error *error) {
    const size_t metrics = arguments->metric_count;
    double *const means = row->figures;
    memset(row->figures, 0, 3 * metrics * sizeof *row->figures);
    aur_result result = AUR_OK;
    for (size_t k = 0; k < arguments->seed_count && result == AUR_OK; ++k) {
        result = measure_points(arguments, source, count, arguments->points.seed + k, row, values, error);
        for (size_t m = 0; m < metrics && result == AUR_OK; ++m) {
            /* Welford's update of mean and sum of squares. */
            double *const figure = means + 3 * m;
            const double difference = values[m] - figure[0];
            figure[0] += difference / (double)(k + 1);
            figure[1] += difference * (values[m] - figure[0]);
        }
    }
    for (size_t m = 0; m < metrics; ++m) {
        double *const figure = means + 3 * m;
        const double squares = figure[1];
        figure[2] = sqrt(figure[0] * figure[0] + squares / (double)arguments->seed_count);
        figure[1] = sqrt(squares / (double)(arguments->seed_count - 1));
    }
    return result;
}

static cli_measure_row *append(cli_measure_table *rows) {
    if (rows->count == rows->capacity) {
        const size_t capacity = rows->capacity == 0 ? 16 : 2 * rows->capacity;
        cli_measure_row *const larger = realloc(rows->items, capacity * sizeof *larger);
        if (larger == NULL)
            return NULL;
        rows->items = larger;
        rows->capacity = capacity;
    }
    return &rows->items[rows->count];
}

/* Appends the row when it is complete. */
static aur_result measure_row(const cli_measure_arguments *arguments, const char *source, size_t count,
                              cli_measure_table *rows, aur_error *error) {
    const size_t metrics = arguments->metric_count;
    const bool seeded = arguments->seed_count > 0 && !cli_is_file(source);
    cli_measure_row *const row = append(rows);
    double *const values = malloc(metrics * sizeof *values);
    double *const figures = malloc(metrics * cli_figures_per_metric(arguments) * sizeof *figures);
    aur_result result = AUR_ERROR_MEMORY;
    if (row != NULL && values != NULL && figures != NULL) {
        *row = (cli_measure_row){.source = source, .figures = figures};
        if (seeded)
            result = measure_seeds(arguments, source, count, row, values, error);
        else
            result = measure_points(arguments, source, count, arguments->points.seed, row, values, error);
    }
    if (result == AUR_OK) {
        for (size_t m = 0; m < metrics && !seeded; ++m) {
            double *const figure = figures + m * cli_figures_per_metric(arguments);
            figure[0] = values[m];
            if (arguments->seed_count > 0) {
                figure[1] = 0.0;
                figure[2] = fabs(values[m]);
            }
        }
        ++rows->count;
    } else {
        free(figures);
    }
    free(values);
    return result;
}

static int print_rows(const cli_measure_arguments *arguments, const cli_measure_table *rows) {
    const size_t per = cli_figures_per_metric(arguments);
    const size_t columns = 3 + arguments->metric_count * per;
    static const char *const suffixes[] = {"", "-spread", "-rms"};
    enum { NAME_CAPACITY = 96 };
    char(*const names)[NAME_CAPACITY] = malloc(columns * sizeof *names);
    const char **const texts = malloc(columns * sizeof *texts);
    cli_table *table = NULL;
    if (names != NULL && texts != NULL) {
        texts[0] = "set";
        texts[1] = "n";
        texts[2] = "domain";
        for (size_t c = 3; c < columns; ++c) {
            snprintf(names[c], NAME_CAPACITY, "%s%s", arguments->metrics[(c - 3) / per],
                     suffixes[(c - 3) % per]);
            texts[c] = names[c];
        }
        table = cli_table_create(columns, texts);
    }
    for (size_t r = 0; r < rows->count; ++r) {
        const cli_measure_row *const row = &rows->items[r];
        cli_table_text(table, row->source);
        cli_table_integer(table, row->count);
        cli_table_text(table, aur_domain_name(row->domain));
        for (size_t f = 0; f < columns - 3; ++f)
            cli_table_number(table, row->figures[f], 6);
    }
    free(names);
    free(texts);
    const int status = cli_table_print(table, arguments->format);
    cli_table_destroy(table);
    return status;
}

int cli_measure_each(const cli_measure_arguments *arguments, void *context, cli_measure_step step,
                     int (*print)(const cli_measure_arguments *arguments, void *context)) {
    aur_error error = {0};
    aur_result result = AUR_OK;
    size_t finished = 0;
    for (size_t s = 0; s < arguments->source_count && result == AUR_OK; ++s) {
        const char *const source = arguments->sources[s];
        /* Without sizes all points of file:PATH. */
        const bool whole = cli_is_file(source) || arguments->size_count == 0;
        for (size_t i = 0; i < (whole ? 1 : arguments->size_count) && result == AUR_OK; ++i) {
            result = step(arguments, source, whole ? 0 : arguments->sizes[i], context, &error);
            finished += result == AUR_OK;
        }
    }
    cli_progress_clear();
    int status = CLI_SUCCESS;
    /* Rows that are finished are kept when the work ends early. */
    if (result == AUR_OK || finished > 0)
        status = print(arguments, context);
    if (result == AUR_ERROR_CANCELLED) {
        error = (aur_error){0};
        snprintf(error.message, sizeof error.message, "interrupted after %zu finished row%s", finished,
                 finished == 1 ? "" : "s");
    }
    if (result == AUR_OK)
        return status;
    error.result = result;
    return cli_fail(&error);
}

static aur_result add_row(const cli_measure_arguments *arguments, const char *source, size_t count,
                          void *context, aur_error *error) {
    return measure_row(arguments, source, count, context, error);
}

static int print_and_plot(const cli_measure_arguments *arguments, void *context) {
    const int status = print_rows(arguments, context);
    return status == CLI_SUCCESS && arguments->plot != NULL ? cli_measure_plot(arguments, context) : status;
}

int cli_measure_rows(const cli_measure_arguments *arguments) {
    cli_measure_table rows = {0};
    const int status = cli_measure_each(arguments, &rows, add_row, print_and_plot);
    for (size_t r = 0; r < rows.count; ++r)
        free(rows.items[r].figures);
    free(rows.items);
    return status;
}
