/* The parts of `aureole measure`. */
#pragma once

#include <aureole/quality.h>

#include "cli/point_source.h"

typedef struct cli_measure_arguments {
    cli_point_options points;
    size_t source_count;
    char **sources;
    size_t size_count;
    size_t *sizes; /* malloc */
    size_t metric_count;
    char **metrics; /* into metric_text */
    char *metric_text;
    size_t seed_count; /* 0: one set, no statistics */
    aur_measure_options options;
    cli_format format;
    const char *plot; /* NULL: none */
    bool quiet;
    bool series; /* the one metric is a table */
    bool list;
} cli_measure_arguments;

/* One row of figures: value, spread and root mean square of each metric; the last two with seeds only. */
typedef struct cli_measure_row {
    const char *source;
    aur_domain domain;
    size_t count;
    double *figures; /* metric_count * cli_figures_per_metric() */
} cli_measure_row;

typedef struct cli_measure_table {
    size_t count, capacity;
    cli_measure_row *items;
} cli_measure_table;

static inline size_t cli_figures_per_metric(const cli_measure_arguments *arguments) {
    return arguments->seed_count > 0 ? 3 : 1;
}

/* Calls `step` for each source and size (0: all points of a file), then `print` with what is finished, even
 * when the work ends early. Returns the exit status. */
typedef aur_result (*cli_measure_step)(const cli_measure_arguments *arguments, const char *source,
                                       size_t count, void *context, aur_error *error);
int cli_measure_each(const cli_measure_arguments *arguments, void *context, cli_measure_step step,
                     int (*print)(const cli_measure_arguments *arguments, void *context));

/* Figures, and tables: compute, print and plot; return the exit status. */
int cli_measure_rows(const cli_measure_arguments *arguments);
int cli_measure_series(const cli_measure_arguments *arguments);

/* Figures against N on log-log axes with fitted slopes, a panel a metric; slopes go to standard error as
 * well. */
int cli_measure_plot(const cli_measure_arguments *arguments, const cli_measure_table *table);
