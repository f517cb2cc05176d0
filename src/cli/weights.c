/* aureole weights: optimal weights of samples, their rivals, and what they gain. */
#include "cli/weights.h"

#include <math.h>
#include <stdlib.h>

static aur_result parse_lobe(const char *text, void *field, aur_error *error) {
    return aur_lobe_parse(text, field, error);
}

/* In the order of cli_method. */
static const char *method_name(unsigned method) {
    static const char *const names[] = {"osw", "oswa", "mis", "mis-power", "equal", "ratio"};
    return method < sizeof names / sizeof names[0] ? names[method] : NULL;
}

static const cli_option options[] = {
    {.key = {"n", AUR_KEY_INTEGER, "samples of the set", "all of a file", .computed = true, .minimum = 1,
             .maximum = INFINITY, CLI_FIELD(cli_weights_arguments, size)},
     .value = "N"},
    {.key =
         {"lobe2", AUR_KEY_TEXT,
          "a second lobe about the mirror direction of a view, with samples of its own; its weights are the "
          "column w2",
          .words = (const char *const[]){"uniform", "cosine", "phong:M", "ggx:ALPHA", NULL},
          CLI_FIELD(cli_weights_arguments, mirror)},
     .value = "LOBE",
     .parse = parse_lobe},
    {.key = {"angle", AUR_KEY_REAL, "of the view, for the second lobe", .maximum = 90,
             CLI_FIELD(cli_weights_arguments, degrees)},
     .value = "DEGREES"},
    {.key = {"n2", AUR_KEY_INTEGER, "samples of the second lobe", "as many as of the first", .computed = true,
             .minimum = 1, .maximum = INFINITY, CLI_FIELD(cli_weights_arguments, mirror_size)},
     .value = "N"},
    {.key = {"clip", .help = "the second lobe ends at the horizon; hidden samples get weight 0",
             CLI_FIELD(cli_weights_arguments, clipped)}},
    {.key =
         {"method",
          .help =
              "optimal weights, of two lobes each from its own samples (osw) or from all (oswa); balance or "
              "power heuristic (mis, mis-power), 1/N (equal) or p/(q N) (ratio)",
          .default_text = "osw for one lobe, oswa for two", .computed = true,
          CLI_FIELD(cli_weights_arguments, method)},
     .value = "METHOD",
     .name = method_name},
    {.key = {"regularization", AUR_KEY_REAL, "added to the diagonal", "1e-6", .maximum = INFINITY,
             .maximum_open = true, CLI_FIELD(cli_weights_arguments, weights.regularization)},
     .value = "R"},
    {.key = {"unconstrained", .help = "do not fix the sum of the weights to 1",
             CLI_FIELD(cli_weights_arguments, unconstrained)}},
    {.key = {"report",
             .help = "print worst-case errors with equal and optimal weights and the gain instead of samples",
             CLI_FIELD(cli_weights_arguments, report)}},
    {.key = {"output", AUR_KEY_TEXT, "write x,y,z,w there as CSV",
             "standard output, unless there is a report", .computed = true,
             CLI_FIELD(cli_weights_arguments, path)},
     .letter = 'o',
     .value = "FILE",
     .content = "file"},
    {.key = {"plot", AUR_KEY_TEXT, "draw the samples coloured by weight, .svg or .png (needs gnuplot)",
             CLI_FIELD(cli_weights_arguments, plot)},
     .value = "FILE",
     .content = "file"},
    {.key = {"table", AUR_KEY_TEXT,
             "build a table of OSWA weights for the two lobes, or read one with --lookup",
             CLI_FIELD(cli_weights_arguments, table)},
     .value = "FILE",
     .content = "file"},
    {.key = {"angles", AUR_KEY_INTEGER, "of the view in a table", "64", .minimum = 2, .maximum = 1 << 16,
             CLI_FIELD(cli_weights_arguments, angles)},
     .value = "T"},
    {.key = {"rotations", AUR_KEY_INTEGER, "of the patterns in a table", "16", .minimum = 1,
             .maximum = 1 << 16, CLI_FIELD(cli_weights_arguments, rotations)},
     .value = "K"},
    {.key = {"lookup", AUR_KEY_REAL, "write the samples and weights of a table at that angle of the view",
             .maximum = 90, CLI_FIELD(cli_weights_arguments, look_up_degrees)},
     .value = "DEGREES"},
    {.key = {"rotation", AUR_KEY_INTEGER, "which rotation of the table is looked up", "0",
             .maximum = (1 << 16) - 1, CLI_FIELD(cli_weights_arguments, rotation)},
     .value = "K"},
    {.key = {"mirrored", .help = "the mirror image of what is looked up",
             CLI_FIELD(cli_weights_arguments, mirrored)}},
    {.key = {0}}};

/* What the options mean together; the first rule that they break, or NULL. */
static const char *broken_rule(const cli_call *call, const cli_weights_arguments *arguments) {
    const bool two = arguments->two;
    if (arguments->points.options.optimal_density && cli_has_size(arguments->source))
        return "--density: the points of a file are as they stand";
    if (!two && (cli_given(call, "angle") != NULL || arguments->mirror_size > 0 || arguments->clipped))
        return "--angle, --n2 and --clip are for two lobes: give --lobe2";
    if (two && cli_given(call, "angle") == NULL && arguments->table == NULL)
        return "--lobe2: the angle of the view is missing: give --angle DEGREES";
    if (two && arguments->points.options.domain == AUR_DOMAIN_SPHERE)
        return "--lobe2: two lobes are for the hemisphere";
    if (arguments->table != NULL && !two)
        return "--table: needs two lobes: give --lobe2";
    if (arguments->method == CLI_METHOD_OSWA && !two)
        return "--method oswa: needs two lobes: give --lobe2";
    return NULL;
}

/* What follows from a set or file; the status of what is wrong. */
static int complete(const cli_call *call, cli_weights_arguments *arguments) {
    cli_points *const points = &arguments->points;
    arguments->source = call->operands[0];
    points->domain_given = cli_given(call, "domain") != NULL;
    if (!points->domain_given)
        points->options.domain = AUR_DOMAIN_HEMISPHERE;
    if (points->options.domain != AUR_DOMAIN_HEMISPHERE && points->options.domain != AUR_DOMAIN_SPHERE)
        return cli_bad_usage("--domain: must be one of hemisphere, sphere, not '%s'",
                             aur_domain_name(points->options.domain));
    if (cli_given(call, "n") == NULL && !cli_has_size(arguments->source))
        return cli_bad_usage("weights: -n is missing for the set '%s' (there is no such file)",
                             arguments->source);
    if (cli_given(call, "method") == NULL)
        arguments->method = arguments->two ? CLI_METHOD_OSWA : CLI_METHOD_OSW;
    const char *const rule = broken_rule(call, arguments);
    if (rule != NULL)
        return cli_bad_usage("%s", rule);
    if (arguments->mirror_size == 0)
        arguments->mirror_size = arguments->size;
    return CLI_SUCCESS;
}

static int print_report(const cli_weights_arguments *arguments, const cli_weights_result *result) {
    const bool optimal = arguments->method == CLI_METHOD_OSW || arguments->method == CLI_METHOD_OSWA;
    cli_table *const table =
        cli_table_create(5, (const char *const[]){"set", "n", "lobe", "method", "equal"});
    if (result->has_ratio)
        cli_table_column(table, "ratio");
    cli_table_column(table, optimal ? "optimal" : "weighted");
    cli_table_column(table, "gain_percent");
    cli_table_column(table, "weight_sum");
    if (result->condition > 0.0)
        cli_table_column(table, "condition");
    for (size_t k = 0; k < result->lobe_count; ++k) {
        /* What the points would give without a solve. */
        const double plain = result->has_ratio ? result->ratio[k] : result->equal[k];
        cli_table_text(table, arguments->source);
        cli_table_integer(table, result->count);
        cli_table_text(table, k == 0 ? arguments->lobe_text : arguments->mirror_text);
        cli_table_text(table, arguments->method_name);
        cli_table_number(table, result->equal[k], 8);
        if (result->has_ratio)
            cli_table_number(table, result->ratio[k], 8);
        cli_table_number(table, result->weighted[k], 8);
        cli_table_number(table, 100.0 * (1.0 - result->weighted[k] / plain), 4);
        cli_table_number(table, result->sum[k], 10);
        if (result->condition > 0.0)
            cli_table_number(table, result->condition, 3);
    }
    return cli_table_finish(table, arguments->format);
}

static int write_points(const cli_weights_arguments *arguments, const cli_weights_result *result) {
    aur_error error = {0};
    return cli_status(aur_weights_write(arguments->path != NULL ? arguments->path : "-", result->count,
                                        result->xyz, result->lobe_count, result->weights, &error),
                      &error);
}

static int weigh(const cli_weights_arguments *arguments) {
    cli_weights_result result = {0};
    int status = cli_weights_compute(arguments, &result);
    if (status == CLI_SUCCESS && arguments->report)
        status = print_report(arguments, &result);
    if (status == CLI_SUCCESS && arguments->plot != NULL)
        status = cli_weights_plot(arguments, &result);
    /* Figures or a picture were asked for: the samples only where -o says. */
    const bool asked = arguments->path != NULL || (!arguments->report && arguments->plot == NULL);
    if (status == CLI_SUCCESS && asked)
        status = write_points(arguments, &result);
    free(result.xyz);
    free(result.weights);
    return status;
}

static int run(const cli_call *call) {
    cli_weights_arguments *const arguments = call->options;
    const char *const lobe = cli_given(call, "lobe");
    arguments->lobe_text = lobe != NULL ? lobe : "uniform";
    arguments->mirror_text = cli_given(call, "lobe2");
    arguments->two = arguments->mirror_text != NULL;
    arguments->look_up = cli_given(call, "lookup") != NULL;
    arguments->weights.size = sizeof arguments->weights;
    arguments->weights.sum_constraint = !arguments->unconstrained;
    arguments->points.options.warnings = cli_warnings(arguments->quiet);
    if (arguments->look_up && (arguments->table == NULL || arguments->report || arguments->plot != NULL))
        return cli_bad_usage("--lookup: needs a table to read, --table FILE, and neither reports nor draws");
    if (call->operand_count == 0 && !arguments->look_up)
        return cli_bad_usage("weights: a set or a file is missing: 'aureole sets' lists the sets");
    if (call->operand_count > 0 && complete(call, arguments) != CLI_SUCCESS)
        return CLI_BAD_INPUT;
    arguments->method_name = method_name(arguments->method);
    if (arguments->look_up)
        return cli_weights_look_up(arguments);
    return arguments->table != NULL ? cli_weights_table(arguments) : weigh(arguments);
}

const cli_verb cli_verb_weights = {
    .name = "weights",
    .summary = "optimal weights of samples, and what they gain",
    .notes =
        "Points are directions of the hemisphere (of the sphere, where the lobe is uniform), and the lobe is "
        "what the integrand is multiplied by: the points of a set follow it. Weights are for densities of "
        "integral 1: equal ones are 1/N. They are worth most for random, irregular and partial sets. With "
        "--lookup a set and its options must be those that the table has been built from; they may be left "
        "out.",
    .operands = {{"FILE|SET", "the samples", .optional = true, .content = "file or set"}},
    .groups = {{options},
               {cli_points_options, offsetof(cli_weights_arguments, points.options)},
               {cli_format_option, offsetof(cli_weights_arguments, format)},
               {cli_threads_option, offsetof(cli_weights_arguments, threads)},
               {cli_quiet_option, offsetof(cli_weights_arguments, quiet)}},
    .size = sizeof(cli_weights_arguments),
    .run = run,
};
