#include "points/quality/measure.h"

#include <stdlib.h>

#include "points/base/text.h"

aur_result aur_measure_number(const aur_measure_request *request, double minimum, double maximum,
                              double missing, double *value, aur_error *error) {
    *value = missing;
    if (request->parameter == NULL)
        return AUR_OK;
    if (!aur_parse_double(request->parameter, value))
        return aur_fail(error, AUR_ERROR_ARGUMENT, "the parameter '%s' is not a number", request->parameter);
    if (!(*value >= minimum && *value <= maximum))
        return aur_fail(error, AUR_ERROR_ARGUMENT, "the parameter must be between %g and %g, not %s", minimum,
                        maximum, request->parameter);
    return AUR_OK;
}

static aur_result run_items(const aur_measure_options *options, aur_parallel_options parallel, size_t count,
                            aur_parallel_function function, void *context, aur_parallel_slice found,
                            aur_error *error) {
    const aur_parallel_share share = {.slices = {found}};
    parallel.threads = options->threads;
    parallel.progress = options->progress;
    parallel.share = found.data != NULL ? &share : NULL;
    return aur_parallel_for(&parallel, count, function, context, error);
}

aur_result aur_measure_items(const aur_measure_options *options, const char *what, size_t count,
                             aur_parallel_function function, void *context, aur_parallel_slice found,
                             aur_error *error) {
    return run_items(options, (aur_parallel_options){.what = what}, count, function, context, found, error);
}

aur_result aur_measure_rows(const aur_measure_options *options, const char *what, size_t count,
                            aur_parallel_function function, void *context, aur_parallel_slice found,
                            aur_error *error) {
    const aur_parallel_options parallel = {.what = what, .triangular = true};
    return run_items(options, parallel, count, function, context, found, error);
}

aur_result aur_series_create(aur_series *series, size_t row_count, size_t column_count,
                             const char *const *columns, aur_error *error) {
    *series = (aur_series){.row_count = row_count, .column_count = column_count};
    for (size_t c = 0; c < column_count; ++c)
        series->columns[c] = columns[c];
    series->values = calloc(row_count * column_count + 1, sizeof *series->values);
    return series->values != NULL ? AUR_OK : aur_fail_memory(error);
}

void aur_series_destroy(aur_series *series) {
    if (series == NULL)
        return;
    free(series->values);
    free(series);
}

size_t aur_series_row_count(const aur_series *series) {
    return series->row_count;
}

size_t aur_series_column_count(const aur_series *series) {
    return series->column_count;
}

const char *aur_series_column(const aur_series *series, size_t column) {
    return column < series->column_count ? series->columns[column] : NULL;
}

const double *aur_series_values(const aur_series *series) {
    return series->values;
}

double aur_sum_of_squares(const aur_points_view *points) {
    double sum = 0.0;
    for (size_t i = 0; i < points->count; ++i)
        sum += aur_weight_at(points, i) * aur_weight_at(points, i);
    return sum;
}
