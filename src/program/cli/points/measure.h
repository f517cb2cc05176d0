/* The parts of `aureole measure`. */
#pragma once

#include <aureole/quality.h>

#include "program/cli/points/point_source.h"

typedef struct cli_measure_arguments {
    cli_points points;
    size_t source_count;
    char **sources;
    cli_list sizes; /* empty: only files */
    cli_list metrics;
    size_t seed_count; /* 0: one set, no statistics */
    aur_measure_options options;
    cli_common common;
    const char *plot; /* NULL: none */
    bool list;
    bool series;                     /* the only metric is a table */
    char *size_texts, *metric_texts; /* owns generated lists */
} cli_measure_arguments;

/* The results of one source and size: a table, or per metric the value, with seeds also the standard
 * deviation and the root mean square, otherwise with an accuracy the error bound. */
typedef struct cli_measure_row {
    const char *source;
    aur_domain domain;
    size_t count;
    size_t phase;       /* of the progress: the row's first one */
    double *figures;    /* metrics.count * cli_figures_per_metric() */
    aur_series *series; /* NULL: figures */
} cli_measure_row;

typedef struct cli_measure_rows {
    size_t count;
    cli_measure_row *items;
} cli_measure_rows;

static inline size_t cli_figures_per_metric(const cli_measure_arguments *arguments) {
    return arguments->seed_count > 0 ? 3 : arguments->options.accuracy > 0.0 ? 2 : 1;
}

/* A row's phases of progress: its metrics; with seeds, groups of them. */
static inline size_t cli_phases_per_row(const cli_measure_arguments *arguments) {
    enum { MOST_GROUPS = 64 };
    const size_t seeds = arguments->seed_count;
    return seeds == 0 ? arguments->metrics.count : seeds < MOST_GROUPS ? seeds : MOST_GROUPS;
}

static inline const char *cli_metric(const cli_measure_arguments *arguments, size_t index) {
    return cli_list_at(&arguments->metrics, index);
}

/* Measures a source at a size (0: all points of a file) and fills the row except for its source. */
aur_result cli_measure_figures(const cli_measure_arguments *arguments, const char *source, size_t count,
                               cli_measure_row *row, aur_error *error);

/* Plots values against N on log-log axes with fitted slopes, a panel per metric; also prints the slopes on
 * standard error. The other function plots a table: the second column against the first, a periodogram as an
 * image. Both return the exit status. */
int cli_measure_plot(const cli_measure_arguments *arguments, const cli_measure_rows *rows);
int cli_measure_plot_series(const cli_measure_arguments *arguments, const cli_measure_rows *rows);

/* Whether an item of -n is N, A:B, A:B:xR or A:B:S; and the expansion of such items into sizes. The caller
 * frees *storage, also after an error. */
aur_result cli_check_sizes(const char *text, void *field, aur_error *error);
aur_result cli_expand_sizes(cli_list *sizes, char **storage, aur_error *error);

/* The measures for points of a domain (of a `cap` of it) without required parameters; where a measure has a
 * cheaper bound, the bound. */
aur_result cli_all_metrics(aur_domain domain, bool cap, cli_list *metrics, char **storage, aur_error *error);
