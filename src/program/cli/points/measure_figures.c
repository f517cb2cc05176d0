/* Computes the measures of `aureole measure` for one set or file and size. */
#include <aureole/text.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "program/cli/points/measure.h"

/* Whether the measure is undefined for these points, which is only a warning if all measures are requested.
 */
static bool is_left_out(const cli_measure_arguments *arguments, const char *source, size_t metric,
                        aur_result result, const aur_error *error) {
    const bool all = arguments->metric_texts != NULL;
    if (!all || (result != AUR_ERROR_ARGUMENT && result != AUR_ERROR_UNSUPPORTED))
        return false;
    char message[AUR_ERROR_MESSAGE_CAPACITY + 128];
    aur_format(message, sizeof message, "%s: no %s: %s", source, cli_metric(arguments, metric),
               error->message);
    if (arguments->options.warnings.function != NULL)
        arguments->options.warnings.function(arguments->options.warnings.user, message);
    return true;
}

/* Computes all metrics of one set of points into values[metrics.count], then the error bounds, or the table;
 * messages name the file. */
static aur_result measure_points(const cli_measure_arguments *arguments, const char *source, size_t count,
                                 uint64_t seed, cli_measure_row *row, double *values, aur_error *error) {
    cli_points from = arguments->points;
    from.options.seed = seed;
    aur_points *points;
    aur_points_view view;
    aur_result result = cli_load_points(source, &from, count, &points, &view, error);
    if (result != AUR_OK)
        return result;
    row->count = view.count;
    row->domain = view.domain;
    if (arguments->series) {
        cli_progress_begin(row->phase);
        result =
            aur_measure_series(cli_metric(arguments, 0), &view, &arguments->options, &row->series, error);
    }
    for (size_t m = 0; m < arguments->metrics.count && !arguments->series && result == AUR_OK; ++m) {
        double *const bound = &values[arguments->metrics.count + m];
        if (arguments->seed_count == 0)
            cli_progress_begin(row->phase + m);
        result = aur_measure_bounded(cli_metric(arguments, m), &view, &arguments->options, &values[m], bound,
                                     error);
        if (is_left_out(arguments, source, m, result, error)) {
            values[m] = *bound = NAN;
            *error = (aur_error){0};
            result = AUR_OK;
        }
    }
    if (result != AUR_OK && error->file[0] == '\0')
        snprintf(error->file, sizeof error->file, "%s", source);
    aur_points_destroy(points);
    return result;
}

/* Mean, sample standard deviation and root mean square over seeds. */
static aur_result measure_seeds(const cli_measure_arguments *arguments, const char *source, size_t count,
                                cli_measure_row *row, double *values, aur_error *error) {
    const size_t metrics = arguments->metrics.count, groups = cli_phases_per_row(arguments);
    double *const means = row->figures;
    aur_result result = AUR_OK;
    for (size_t k = 0; k < arguments->seed_count && result == AUR_OK; ++k) {
        if (k == 0 || k * groups / arguments->seed_count != (k - 1) * groups / arguments->seed_count)
            cli_progress_begin(row->phase + k * groups / arguments->seed_count);
        result =
            measure_points(arguments, source, count, arguments->points.options.seed + k, row, values, error);
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

aur_result cli_measure_figures(const cli_measure_arguments *arguments, const char *source, size_t count,
                               cli_measure_row *row, aur_error *error) {
    const size_t metrics = arguments->metrics.count, per = cli_figures_per_metric(arguments);
    double *const values = calloc(2 * metrics, sizeof *values);
    row->figures = calloc(metrics * per, sizeof *row->figures);
    aur_result result = AUR_OK;
    if (values == NULL || row->figures == NULL)
        result = aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    else if (arguments->seed_count > 0 && !cli_is_file(source))
        result = measure_seeds(arguments, source, count, row, values, error);
    else {
        result = measure_points(arguments, source, count, arguments->points.options.seed, row, values, error);
        for (size_t m = 0; m < metrics; ++m) {
            row->figures[m * per] = values[m];
            if (per == 2)
                row->figures[m * per + 1] = values[metrics + m];
            if (per == 3)
                row->figures[m * per + 2] = fabs(values[m]);
        }
    }
    free(values);
    return result;
}
