/* aureole measure: quality measures of points. */
#include "program/cli/points/measure.h"
#include "program/cli/listing.h"

#include <aureole/text.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static aur_result check_metric(const char *text, void *field, aur_error *error) {
    const aur_measure_description **const description = field;
    return strcmp(text, "all") == 0 ? AUR_OK : aur_measure_find(text, description, error);
}

static const cli_option options[] = {
    {CLI_INTEGER(cli_measure_arguments, sizes, "count", "N", 1, INFINITY, NULL,
                 "set sizes, also 64:4096 (64, 128, ...), 64:4096:x4 or 100:500:50; files are always "
                 "measured completely"),
     .letter = 'n', .list = true, .parse = cli_check_sizes},
    {CLI_TEXT(cli_measure_arguments, metrics, "metric", "NAME", "all",
              "measures (see --list); all: all measures of the domain without parameters, with bounds "
              "instead of slow ones"),
     .letter = 'm', .list = true, .parse = check_metric, .content = "measure"},
    {CLI_FLAG(cli_measure_arguments, list, "list", "list the measures with domains and sources")},
    {CLI_INTEGER(cli_measure_arguments, seed_count, "seeds", "K", 2, 1 << 20, NULL,
                 "report mean, standard deviation and root mean square over K seeds, starting at --seed")},
    {CLI_FLAG(cli_measure_arguments, options.fast, "fast",
              "compute sums over pairs to 2e-14 instead of the last bit")},
    {CLI_REAL(cli_measure_arguments, options.accuracy, "accuracy", "ERROR", 0.0, 1.0, NULL,
              "allow this relative error in energies of many points and in spectra, which is faster; adds "
              "columns with error bounds")},
    {CLI_TEXT(cli_measure_arguments, plot, "plot", "FILE", NULL,
              "plot the measures over N with fitted slopes: .svg, .pdf, .png, or .tex for pgfplots"),
     .parse = cli_parse_plot, .content = "file", .writes = true},
    {.key = {0}}};

/* The domain of the first measure's list, or the one with the given dimension. */
static aur_domain choose_domain(const cli_measure_arguments *arguments) {
    const aur_measure_description *description = NULL;
    aur_domain domain = AUR_DOMAIN_SPHERE;
    if (arguments->points.dimension > 0)
        return AUR_DOMAIN_CUBE;
    if (aur_measure_find(cli_metric(arguments, 0), &description, NULL) == AUR_OK) {
        char first[32];
        snprintf(first, sizeof first, "%.*s", (int)strcspn(description->domains, ","), description->domains);
        aur_domain_from_name(first, &domain, NULL);
    }
    return domain;
}

/* The domain for --metric all: --domain, or that of the first source's points. */
static aur_result find_all(cli_measure_arguments *arguments, aur_error *error) {
    const char *const source = arguments->sources[0];
    cli_points from = arguments->points;
    if (!from.domain_given && strcmp(source, "-") == 0)
        return aur_fail(
            error, AUR_ERROR_ARGUMENT,
            "--metric all: standard input is read once, so --domain must state the domain of its points");
    if (!from.domain_given) {
        uint64_t size = 0;
        if (arguments->sizes.count > 0)
            aur_parse_integer(cli_list_at(&arguments->sizes, 0), SIZE_MAX, &size);
        from.natural_domain = true;
        aur_points *points;
        aur_points_view view;
        const aur_result result =
            cli_load_points(source, &from, cli_is_file(source) ? 0 : (size_t)size, &points, &view, error);
        if (result != AUR_OK)
            return result;
        arguments->points.options.domain = view.domain;
        aur_points_destroy(points);
    }
    return cli_all_metrics(arguments->points.options.domain, arguments->options.cap_degrees > 0.0,
                           &arguments->metrics, &arguments->metric_texts, error);
}

/* Derives values from combinations of options. */
static bool complete(cli_measure_arguments *arguments) {
    if (arguments->source_count == 0)
        return cli_bad_usage("measure: no file or set given: try 'aureole help measure'"), false;
    aur_error error = {0};
    if (arguments->sizes.count > 0 &&
        cli_expand_sizes(&arguments->sizes, &arguments->size_texts, &error) != AUR_OK)
        return cli_fail(&error), false;
    size_t series = 0;
    for (size_t i = 0; i < arguments->metrics.count; ++i) {
        const aur_measure_description *description;
        series +=
            aur_measure_find(cli_metric(arguments, i), &description, NULL) == AUR_OK && description->series;
    }
    arguments->series = series > 0;
    if (series > 0 && arguments->metrics.count > 1)
        return cli_bad_usage("--metric: a measure that is a table cannot be combined with others"), false;
    if (series > 0 && arguments->seed_count > 0)
        return cli_bad_usage("--seeds cannot be used with a measure that is a table"), false;
    for (size_t i = 0; i < arguments->source_count; ++i)
        if (arguments->sizes.count == 0 && !cli_has_size(arguments->sources[i]))
            return cli_bad_usage("measure: -n is missing for the set '%s' (no such file)",
                                 arguments->sources[i]),
                   false;
    for (size_t i = 0; i < arguments->metrics.count; ++i) {
        if (strcmp(cli_metric(arguments, i), "all") != 0)
            continue;
        if (arguments->metrics.count > 1)
            return cli_bad_usage("--metric: 'all' cannot be combined with other measures"), false;
        return cli_status(find_all(arguments, &error), &error) == CLI_SUCCESS;
    }
    if (!arguments->points.domain_given)
        arguments->points.options.domain = choose_domain(arguments);
    return true;
}

static int print_list(report_format format) {
    static const char *const columns[] = {"name", "domains", "summary", "source"};
    report_table *const table = report_create(4, columns);
    for (size_t i = 0; i < aur_measure_count(); ++i) {
        const aur_measure_description *const row = aur_measure_at(i);
        char name[64];
        snprintf(name, sizeof name, "%s%s", row->row.name, row->parameter != NULL ? row->parameter : "");
        report_text(table, name);
        report_text(table, row->domains);
        report_text(table, row->row.summary);
        report_text(table, row->row.source);
    }
    return cli_finish_listing(table, format);
}

static int print_rows(const cli_measure_arguments *arguments, const cli_measure_rows *rows) {
    const size_t per = cli_figures_per_metric(arguments);
    const aur_series *const first = rows->items[0].series;
    const size_t columns =
        arguments->series ? aur_series_column_count(first) : arguments->metrics.count * per;
    static const char *const suffixes[] = {"", "-spread", "-rms"}, *const with_bound[] = {"", "-error"};
    report_table *const table = report_create(3, (const char *const[]){"set", "n", "domain"});
    for (size_t c = 0; c < columns; ++c) {
        char name[96];
        if (arguments->series)
            snprintf(name, sizeof name, "%s", aur_series_column(first, c));
        else
            snprintf(name, sizeof name, "%s%s", cli_metric(arguments, c / per),
                     per == 2 ? with_bound[c % per] : suffixes[c % per]);
        report_column(table, name);
    }
    for (size_t i = 0; i < rows->count; ++i) {
        const cli_measure_row *const row = &rows->items[i];
        const double *const values = arguments->series ? aur_series_values(row->series) : row->figures;
        const size_t lines = arguments->series ? aur_series_row_count(row->series) : 1;
        for (size_t k = 0; k < lines; ++k) {
            report_text(table, row->source);
            report_integer(table, row->count);
            report_text(table, aur_domain_name(row->domain));
            for (size_t c = 0; c < columns; ++c)
                report_number(table, values[k * columns + c], 6);
        }
    }
    const int status = cli_finish(table, arguments->common.format);
    if (status != CLI_SUCCESS || arguments->plot == NULL)
        return status;
    return arguments->series ? cli_measure_plot_series(arguments, rows) : cli_measure_plot(arguments, rows);
}

/* A row for each source and size; finished rows are printed if the work is stopped. */
static aur_result measure(const cli_measure_arguments *arguments, cli_measure_rows *rows, aur_error *error) {
    for (size_t s = 0; s < arguments->source_count; ++s) {
        char *const source = arguments->sources[s];
        /* Without sizes all points of file:PATH. */
        const bool whole = cli_is_file(source) || arguments->sizes.count == 0;
        for (size_t i = 0; i < (whole ? 1 : arguments->sizes.count); ++i) {
            cli_measure_row *const row = &rows->items[rows->count];
            uint64_t size = 0;
            if (!whole)
                aur_parse_integer(cli_list_at(&arguments->sizes, i), SIZE_MAX, &size);
            row->source = source;
            row->phase = rows->count * cli_phases_per_row(arguments);
            const aur_result result = cli_measure_figures(arguments, source, (size_t)size, row, error);
            if (result != AUR_OK)
                return result;
            ++rows->count;
        }
    }
    return AUR_OK;
}

/* Most measures sum over pairs of points; the sizes of files are not available yet. */
static cli_phase *plan(const cli_measure_arguments *arguments, size_t rows) {
    const size_t per = cli_phases_per_row(arguments);
    cli_phase *const phases = calloc(rows * per, sizeof *phases);
    for (size_t i = 0; i < rows * per && phases != NULL; ++i) {
        uint64_t size = 1;
        if (arguments->sizes.count > 0)
            aur_parse_integer(cli_list_at(&arguments->sizes, i / per % arguments->sizes.count), SIZE_MAX,
                              &size);
        phases[i].work = (double)size * (double)size;
    }
    cli_progress_plan(phases != NULL ? rows * per : 0, phases);
    return phases;
}

static int measure_all(const cli_measure_arguments *arguments) {
    const size_t sizes = arguments->sizes.count > 0 ? arguments->sizes.count : 1;
    const size_t most = arguments->source_count * sizes;
    cli_measure_rows rows = {.items = calloc(most, sizeof *rows.items)};
    aur_error error = {0};
    cli_phase *const phases = plan(arguments, most);
    const bool ready = rows.items != NULL && phases != NULL;
    const aur_result result = ready ? measure(arguments, &rows, &error) : AUR_ERROR_MEMORY;
    cli_progress_plan(0, NULL);
    cli_progress_clear();
    free(phases);
    int status = CLI_SUCCESS;
    if (rows.count > 0)
        status = print_rows(arguments, &rows);
    if (result == AUR_ERROR_CANCELLED) {
        error = (aur_error){0};
        aur_fail(&error, result, "interrupted after %zu finished row%s", rows.count,
                 rows.count == 1 ? "" : "s");
    }
    error.result = result;
    for (size_t i = 0; rows.items != NULL && i < most; ++i) {
        free(rows.items[i].figures);
        aur_series_destroy(rows.items[i].series);
    }
    free(rows.items);
    return result == AUR_OK ? status : cli_fail(&error);
}

static int run(const cli_call *call) {
    cli_measure_arguments *const arguments = call->options;
    arguments->source_count = call->operand_count;
    arguments->sources = call->operands;
    arguments->points.domain_given = cli_given(call, "domain") != NULL;
    arguments->points.options.warnings = cli_warnings(arguments->common.quiet);
    arguments->options.threads = arguments->common.threads;
    arguments->options.size = sizeof arguments->options;
    arguments->options.warnings = arguments->points.options.warnings;
    arguments->options.cap_degrees = arguments->points.options.cap_degrees;
    arguments->options.seed = arguments->points.options.seed;
    if (arguments->list)
        return print_list(arguments->common.format);
    int status = CLI_BAD_INPUT;
    if (complete(arguments)) {
        arguments->options.progress = cli_progress_of_resumable(arguments->common.quiet);
        status = measure_all(arguments);
    }
    free(arguments->size_texts);
    free(arguments->metric_texts);
    return status;
}

const cli_command cli_command_measure = {
    .name = "measure",
    .summary = "measure the quality of points: discrepancies, energies, distances, spectra",
    .notes = "A SET is NAME[:key=value,...] (see 'aureole sets'), a FILE is CSV or NPY; '-' is standard "
             "input. Without --domain sets are generated on the domain of the first measure. Directions "
             "within 1e-6 of unit length are normalised; weights are divided by their sum.",
    .operands = {{"FILE|SET", "points to measure", .optional = true, .repeated = true,
                  .content = "file or set"}},
    .groups = {{options, 0},
               {cli_points_options, offsetof(cli_measure_arguments, points)},
               {cli_cap_option, offsetof(cli_measure_arguments, points)},
               {cli_dimension_option, offsetof(cli_measure_arguments, points)},
               {cli_format_option, offsetof(cli_measure_arguments, common)},
               {cli_threads_option, offsetof(cli_measure_arguments, common)},
               {cli_quiet_option, offsetof(cli_measure_arguments, common)},
               {cli_cache_option, offsetof(cli_measure_arguments, common)}},
    .size = sizeof(cli_measure_arguments),
    .run = run,
    .ranks = true,
};
