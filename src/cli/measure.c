/* aureole measure: quality figures of points. */
#include "cli/measure.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char help[] =
    "  -n, --count N[,N...]      sizes of the sets; files are measured whole\n"
    "  -m, --metric NAME[,...]   the figures (--list names them)\n"
    "      --list                list the measures with their domains and sources\n"
    "      --domain DOMAIN       square, cube, hemisphere or sphere; else what the first measure is for,\n"
    "                            or what a file holds\n"
    "      --dim D               dimension, for sets on the cube\n"
    "      --map MAP             lambert, concentric, azimuthal or polar, for sets of the square on the "
    "sphere\n"
    "      --lobe LOBE           uniform, cosine, phong:M or ggx:ALPHA[:VIEW_DEGREES], on the hemisphere\n"
    "      --density same|optimal, --smoothness S\n"
    "                            the density that the points follow, as for 'aureole points'\n"
    "      --scramble SCRAMBLE   none, digit, owen, shift, rotate or rotate3d\n"
    "      --seed S              of scrambling and of random sets\n"
    "      --seeds K             mean, spread and root mean square over K seeds from S\n"
    "      --fast                sums over pairs to 2e-14 instead of the last bit\n"
    "      --format FORMAT       table, csv or json\n"
    "      --plot FILE.svg       draw the figures against N with fitted slopes (needs gnuplot)\n"
    "  -t, --threads T           0: all\n"
    "  -q, --quiet               no progress bar and no warnings\n"
    "\n"
    "A SET is NAME[:key=value,...] ('aureole sets' lists them), a FILE CSV or NPY; '-' is standard input.\n"
    "Directions within 1e-6 of unit length are scaled to it; weights are divided by their sum.\n";

enum { OPTION_SEEDS = 256, OPTION_FAST, OPTION_FORMAT, OPTION_PLOT, OPTION_LIST };

static const struct option long_options[] = {{"count", required_argument, NULL, 'n'},
                                             {"metric", required_argument, NULL, 'm'},
                                             {"domain", required_argument, NULL, CLI_POINTS_DOMAIN},
                                             {"dim", required_argument, NULL, CLI_POINTS_DIM},
                                             {"map", required_argument, NULL, CLI_POINTS_MAP},
                                             {"lobe", required_argument, NULL, CLI_POINTS_LOBE},
                                             {"density", required_argument, NULL, CLI_POINTS_DENSITY},
                                             {"smoothness", required_argument, NULL, CLI_POINTS_SMOOTHNESS},
                                             {"scramble", required_argument, NULL, CLI_POINTS_SCRAMBLE},
                                             {"seed", required_argument, NULL, CLI_POINTS_SEED},
                                             {"seeds", required_argument, NULL, OPTION_SEEDS},
                                             {"fast", no_argument, NULL, OPTION_FAST},
                                             {"format", required_argument, NULL, OPTION_FORMAT},
                                             {"plot", required_argument, NULL, OPTION_PLOT},
                                             {"list", no_argument, NULL, OPTION_LIST},
                                             {"threads", required_argument, NULL, 't'},
                                             {"quiet", no_argument, NULL, 'q'},
                                             {NULL, 0, NULL, 0}};

static bool parse_metrics(cli_measure_arguments *arguments, const char *text) {
    size_t count = 1;
    for (const char *c = text; *c != '\0'; ++c)
        count += *c == ',';
    free(arguments->metric_text);
    free(arguments->metrics);
    arguments->metric_text = strdup(text);
    arguments->metrics = malloc(count * sizeof *arguments->metrics);
    arguments->metric_count = 0;
    if (arguments->metric_text == NULL || arguments->metrics == NULL)
        return false;
    size_t series = 0;
    char *rest = arguments->metric_text;
    while (rest != NULL) {
        char *const comma = strchr(rest, ',');
        if (comma != NULL)
            *comma = '\0';
        arguments->metrics[arguments->metric_count++] = rest;
        const aur_measure_description *description;
        aur_error error = {0};
        if (!cli_succeeded(aur_measure_find(rest, &description, &error), &error))
            return false;
        series += description->series;
        rest = comma != NULL ? comma + 1 : NULL;
    }
    arguments->series = series > 0;
    if (series > 0 && arguments->metric_count > 1)
        return cli_bad_usage("--metric: a measure that is a table stands alone, not with others"), false;
    return true;
}

static bool parse_option(int option, cli_measure_arguments *arguments) {
    switch (option) {
    case 'n':
        free(arguments->sizes);
        return cli_parse_sizes("-n", optarg, &arguments->size_count, &arguments->sizes);
    case 'm':
        return parse_metrics(arguments, optarg);
    case 't':
        return cli_parse_size("-t", optarg, 0, 4096, &arguments->options.threads);
    case 'q':
        arguments->quiet = true;
        return true;
    case OPTION_SEEDS:
        return cli_parse_size("--seeds", optarg, 2, 1u << 20, &arguments->seed_count);
    case OPTION_FAST:
        arguments->options.fast = true;
        return true;
    case OPTION_FORMAT:
        return cli_parse_format(optarg, &arguments->format);
    case OPTION_PLOT:
        arguments->plot = optarg;
        return true;
    case OPTION_LIST:
        arguments->list = true;
        return true;
    default:
        return cli_parse_point_option(option, optarg, &arguments->points);
    }
}

/* The domain that the first word of the first measure's list names, or the one that the dimension asks for.
 */
static void choose_domain(cli_measure_arguments *arguments) {
    cli_point_options *const points = &arguments->points;
    if (points->domain_given)
        return;
    const aur_measure_description *description = NULL;
    points->domain = AUR_DOMAIN_SPHERE;
    if (points->dimension > 0)
        points->domain = AUR_DOMAIN_CUBE;
    else if (aur_measure_find(arguments->metrics[0], &description, NULL) == AUR_OK) {
        char first[32] = "";
        snprintf(first, sizeof first, "%.*s", (int)strcspn(description->domains, ","), description->domains);
        cli_parse_domain(first, &points->domain);
    }
}

static bool check_arguments(cli_measure_arguments *arguments) {
    if (arguments->source_count == 0)
        return cli_bad_usage("measure: a file or a set is missing: try 'aureole help measure'"), false;
    if (arguments->metric_count == 0)
        return cli_bad_usage("measure: --metric is missing: 'aureole measure --list' lists them"), false;
    for (size_t i = 0; i < arguments->source_count; ++i)
        if (arguments->size_count == 0 && !cli_is_file(arguments->sources[i]) &&
            strncmp(arguments->sources[i], "file:", 5) != 0)
            return cli_bad_usage("measure: -n is missing for the set '%s' (there is no such file)",
                                 arguments->sources[i]),
                   false;
    if (arguments->series && arguments->seed_count > 0)
        return cli_bad_usage("--seeds: there are no statistics of tables"), false;
    choose_domain(arguments);
    return true;
}

static int print_list(cli_format format) {
    static const char *const columns[] = {"name", "domains", "summary", "source"};
    cli_table *const table = cli_table_create(4, columns);
    for (size_t i = 0; i < aur_measure_count(); ++i) {
        const aur_measure_description *const row = aur_measure_at(i);
        char name[64];
        /* riesz:S, cap-bound[:CENTRES] */
        const bool optional = row->parameter[0] == '[';
        snprintf(name, sizeof name, "%s%s%s", row->row.name,
                 optional                    ? "[:"
                 : row->parameter[0] != '\0' ? ":"
                                             : "",
                 row->parameter + optional);
        cli_table_text(table, name);
        cli_table_text(table, row->domains);
        cli_table_text(table, row->row.summary);
        cli_table_text(table, row->row.source);
    }
    const int status = cli_table_print(table, format);
    cli_table_destroy(table);
    return status;
}

static int run(int argc, char **argv) {
    cli_measure_arguments arguments = {.options = aur_measure_options_default()};
    int status = CLI_BAD_INPUT;
    bool good = true;
    optind = 0;
    for (int option; good && (option = cli_next_option(argc, argv, "n:m:t:q", long_options)) != -1;)
        good = option != '?' && parse_option(option, &arguments);
    arguments.source_count = (size_t)(argc - optind);
    arguments.sources = argv + optind;
    arguments.points.warnings = cli_warnings(arguments.quiet);
    arguments.options.warnings = arguments.points.warnings;
    arguments.options.seed = arguments.points.seed;
    if (good && arguments.list) {
        status = print_list(arguments.format);
    } else if (good && check_arguments(&arguments)) {
        arguments.options.progress = cli_progress(arguments.quiet);
        status = arguments.series ? cli_measure_series(&arguments) : cli_measure_rows(&arguments);
    }
    free(arguments.sizes);
    free(arguments.metrics);
    free(arguments.metric_text);
    return status;
}

const cli_verb cli_verb_measure = {"measure", "FILE|SET... [-n N[,N...]] --metric NAME[,NAME...]",
                                   "quality figures of points", help, run};
