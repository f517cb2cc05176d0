/* The parts of `aureole measure`. */
#ifndef AUR_CLI_MEASURE_H
#define AUR_CLI_MEASURE_H

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
    bool list;
} cli_measure_arguments;

/* One row of figures: value, spread and root mean square of each metric; the last two with seeds only. */
typedef struct cli_measure_row {
    const char *source;
    aur_domain domain;
    size_t count;
    double *figures; /* metric_count * cli_figures_per_metric() */
} cli_measure_row;

typedef struct cli_measure_rows {
    size_t count, capacity;
    cli_measure_row *items;
} cli_measure_rows;

static inline size_t cli_figures_per_metric(const cli_measure_arguments *arguments) {
    return arguments->seed_count > 0 ? 3 : 1;
}

#endif
