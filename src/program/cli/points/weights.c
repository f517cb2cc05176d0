/* aureole weights: optimal, exact and other weights of samples, and their gain. */
#include "program/cli/points/weights.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static aur_result parse_lobe(const char *text, void *field, aur_error *error) {
    return aur_lobe_parse(text, field, error);
}

/* In the order of cli_method. */
static const char *method_name(unsigned method) {
    static const char *const names[] = {"osw",   "oswa",  "mis",   "mis-power",
                                        "equal", "ratio", "exact", "voronoi"};
    return method < sizeof names / sizeof names[0] ? names[method] : NULL;
}

static const cli_option options[] = {
    {CLI_INTEGER(cli_weights_arguments, size, "size", "N", 1, INFINITY, "all points of a file",
                 "number of samples of the set"),
     .letter = 'n', .key.computed = true},
    {CLI_TEXT(cli_weights_arguments, mirror, "lobe2", "LOBE", NULL,
              "add a second lobe around the mirror direction of a view, with separate samples; its weights "
              "are the column w2"),
     .key.words = (const char *const[]){"uniform", "cosine", "phong:M", "ggx:ALPHA", NULL},
     .parse = parse_lobe},
    {CLI_REAL(cli_weights_arguments, degrees, "angle", "DEGREES", 0, 90, NULL,
              "angle of the view, for the second lobe")},
    {CLI_INTEGER(cli_weights_arguments, mirror_size, "n2", "N", 1, INFINITY, "as many as in the first lobe",
                 "number of samples of the second lobe"),
     .key.computed = true},
    {CLI_FLAG(cli_weights_arguments, clipped, "clip",
              "cut the second lobe at the horizon; samples below get weight 0")},
    {CLI_CHOICE(cli_weights_arguments, method, "method", "METHOD", "osw for one lobe, oswa for two",
                "optimal weights from the samples of each lobe (osw) or from all samples (oswa); balance or "
                "power heuristic (mis, mis-power); 1/N (equal); p/(q N) (ratio); exact for polynomials and "
                "nearest to equal weights (exact); areas of Voronoi cells (voronoi)"),
     .key.computed = true, .name = method_name},
    {CLI_INTEGER(cli_weights_arguments, degree, "degree", "L", 0, AUR_EXACT_DEGREE_MAX,
                 "the largest with positive weights",
                 "degree of the polynomials that --method exact integrates"),
     .key.computed = true},
    {CLI_TEXT(
         cli_weights_arguments, levels, "levels", "N,N,...", NULL,
         "exact weights of the first N samples for each N given: the columns w, w2, ... (rotations: weight, "
         "weight2, ...)"),
     .list = true},
    {CLI_FLAG(cli_weights_arguments, negative, "negative", "allow negative weights with --degree")},
    {CLI_REAL(cli_weights_arguments, tolerance, "tolerance", "E", AUR_EXACT_TOLERANCE_MIN,
              AUR_EXACT_TOLERANCE_MAX, "1e-14",
              "for exact weights of more than 2048 samples: largest error of a polynomial of mean square 1")},
    {CLI_TEXT(
        cli_weights_arguments, symmetry, "symmetry", "GROUP", NULL,
        "exact weights for functions with a symmetry: of directions a point group (D2h, Oh), of rotations "
        "CRYSTAL[:SAMPLE] (432:222)")},
    {CLI_FLAG(cli_weights_arguments, near, "near",
              "exact weights nearest to the weights of the file (column w)")},
    {CLI_REAL(cli_weights_arguments, weights.regularization, "regularization", "R", 0, INFINITY, "1e-6",
              "regularisation added to the diagonal"),
     .key.maximum_open = true},
    {CLI_FLAG(cli_weights_arguments, unconstrained, "unconstrained",
              "do not constrain the sum of the weights to 1")},
    {CLI_FLAG(cli_weights_arguments, report, "report",
              "print worst-case errors with equal and optimal weights and the gain instead of samples; for "
              "exact weights the degree, the remaining error, and the smallest and largest weight times N")},
    {CLI_TEXT(cli_weights_arguments, path, "output", "FILE", "standard output, unless --report",
              "output file, CSV with x,y,z,w"),
     .letter = 'o', .key.computed = true, .content = "file", .writes = true},
    {CLI_TEXT(cli_weights_arguments, plot, "plot", "FILE", NULL,
              "draw the samples coloured by weight: .svg, .pdf, .png, or .tex for pgfplots"),
     .parse = cli_parse_plot, .content = "file", .writes = true},
    {CLI_TEXT(cli_weights_arguments, table, "table", "FILE", NULL,
              "build a table of optimal weights for two lobes (oswa) or for one ggx lobe, or read one with "
              "--lookup"),
     .content = "file"},
    {CLI_INTEGER(cli_weights_arguments, angles, "angles", "T", 2, 1 << 16, "64",
                 "number of view angles of a table")},
    {CLI_INTEGER(cli_weights_arguments, roughnesses, "roughnesses", "R", 1, 256, "1",
                 "number of roughnesses of a table of a ggx lobe, from its ALPHA to 1, logarithmic")},
    {CLI_INTEGER(cli_weights_arguments, rotations, "rotations", "K", 1, 1 << 16, "16",
                 "number of rotations of a table")},
    {CLI_REAL(cli_weights_arguments, look_up_degrees, "lookup", "DEGREES", 0, 90, NULL,
              "write the samples and weights of a table at this view angle")},
    {CLI_REAL(cli_weights_arguments, look_up_alpha, "roughness", "ALPHA", 1e-4, 1,
              "the smallest of the table", "roughness to look up, in a table of several roughnesses"),
     .key.computed = true},
    {CLI_INTEGER(cli_weights_arguments, rotation, "rotation", "K", 0, (1 << 16) - 1, "0",
                 "index of the rotation to look up")},
    {CLI_FLAG(cli_weights_arguments, mirrored, "mirrored", "mirror the samples that are looked up")},
    {.key = {0}}};

/* Checks combinations of options; returns the first violated rule, or NULL. */
static const char *broken_rule(const cli_call *call, const cli_weights_arguments *arguments) {
    const bool two = arguments->two;
    if (arguments->points.options.optimal_density && cli_has_size(arguments->source))
        return "--density cannot be used with a file";
    if (!two && (cli_given(call, "angle") != NULL || arguments->mirror_size > 0 || arguments->clipped))
        return "--angle, --n2 and --clip are for two lobes: give --lobe2";
    if (two && cli_given(call, "angle") == NULL && arguments->table == NULL)
        return "--lobe2: the angle of the view is missing: give --angle DEGREES";
    if (two && arguments->points.options.domain != AUR_DOMAIN_HEMISPHERE)
        return "--lobe2: two lobes are for the hemisphere";
    const bool ggx = (two ? arguments->mirror : arguments->points.options.lobe).kind == AUR_LOBE_GGX;
    if (arguments->table != NULL && !two && !ggx)
        return "--table: needs two lobes, or one that is ggx: give --lobe2";
    if (arguments->roughnesses > 1 && (arguments->table == NULL || !ggx))
        return "--roughnesses: is for a --table of a ggx lobe";
    if (arguments->method == CLI_METHOD_OSWA && !two)
        return "--method oswa: needs two lobes: give --lobe2";
    const bool exact = arguments->method == CLI_METHOD_EXACT;
    if (two && (exact || arguments->method == CLI_METHOD_VORONOI))
        return "--lobe2: exact weights and areas of cells are for one lobe";
    if (!exact &&
        (arguments->degree != AUR_DEGREE_LARGEST || arguments->negative || arguments->near ||
         arguments->levels.count > 0 || cli_given(call, "tolerance") != NULL || arguments->symmetry != NULL))
        return "--degree, --levels, --negative, --near, --symmetry and --tolerance are for --method exact";
    if (!exact && arguments->method != CLI_METHOD_VORONOI && arguments->points.options.cap_degrees > 0.0)
        return "--cap: is for --method exact and voronoi";
    if (arguments->levels.count > CLI_LEVEL_LIMIT)
        return "--levels: there may be at most 32";
    if (arguments->levels.count > 0 && arguments->plot != NULL)
        return "--plot: draws one level: leave --levels out";
    if (arguments->near && !cli_has_size(arguments->source))
        return "--near: only a file has weights to stay near to";
    return NULL;
}

/* Derives values from a set or file; returns the status of an error. */
static int complete(const cli_call *call, cli_weights_arguments *arguments) {
    cli_points *const points = &arguments->points;
    arguments->source = call->operands[0];
    points->domain_given = cli_given(call, "domain") != NULL;
    if (!points->domain_given)
        points->options.domain =
            points->options.cap_degrees > 90.0 ? AUR_DOMAIN_SPHERE : AUR_DOMAIN_HEMISPHERE;
    arguments->domain_follows = !points->domain_given && !arguments->two && cli_given(call, "lobe") == NULL &&
                                points->options.cap_degrees == 0.0;
    if (cli_given(call, "size") == NULL && !cli_has_size(arguments->source))
        return cli_bad_usage("weights: -n is missing for the set '%s' (no such file)", arguments->source);
    if (cli_given(call, "method") == NULL)
        arguments->method = arguments->two ? CLI_METHOD_OSWA
                            : cli_has_directions(points->options.domain) && arguments->symmetry == NULL
                                ? CLI_METHOD_OSW
                                : CLI_METHOD_EXACT;
    if (cli_given(call, "degree") == NULL)
        arguments->degree = AUR_DEGREE_LARGEST;
    const char *const rule = broken_rule(call, arguments);
    if (rule != NULL)
        return cli_bad_usage("%s", rule);
    if (arguments->mirror_size == 0)
        arguments->mirror_size = arguments->size;
    return CLI_SUCCESS;
}

enum { FIGURES = 11 };

/* A row for one lobe or one level; NaN where the method has no value. */
static void find_figures(const cli_weights_arguments *arguments, const cli_weights_result *result, size_t k,
                         double figures[FIGURES]) {
    for (size_t i = 0; i < FIGURES; ++i)
        figures[i] = NAN;
    if (arguments->method == CLI_METHOD_EXACT) {
        const aur_exact_report *const exact = &result->exact[k];
        const double found[] = {(double)exact->degree, exact->residual, exact->least, exact->largest,
                                (double)exact->distinct_points};
        memcpy(figures + 6, found, sizeof found);
        return;
    }
    /* Values with equal weights, without a solve. */
    const double plain = result->has_ratio ? result->ratio[k] : result->equal[k];
    figures[0] = result->equal[k];
    figures[1] = result->has_ratio ? result->ratio[k] : NAN;
    figures[2] = result->weighted[k];
    figures[3] = 100.0 * (1.0 - result->weighted[k] / plain);
    figures[4] = result->sum[k];
    figures[5] = result->condition > 0.0 ? result->condition : NAN;
}

/* Machine-readable tables have all columns, text only the nonempty ones. */
static int print_report(const cli_weights_arguments *arguments, const cli_weights_result *result) {
    static const struct {
        const char *name;
        int digits;
    } of[FIGURES] = {{"equal", 8},       {"ratio", 8},     {"weighted", 8}, {"gain_percent", 4},
                     {"weight_sum", 10}, {"condition", 3}, {"degree", 9},   {"residual", 3},
                     {"least", 8},       {"largest", 8},   {"distinct", 9}};
    const bool exact = arguments->method == CLI_METHOD_EXACT;
    double figures[FIGURES];
    find_figures(arguments, result, 0, figures);
    bool shown[FIGURES];
    report_table *const table = report_create(4, (const char *const[]){"set", "n", "lobe", "method"});
    for (size_t i = 0; i < FIGURES; ++i) {
        shown[i] = arguments->common.format != REPORT_TABLE || !isnan(figures[i]);
        if (shown[i])
            report_column(table, of[i].name);
    }
    for (size_t k = 0; k < result->lobe_count; ++k) {
        find_figures(arguments, result, k, figures);
        report_text(table, arguments->source);
        report_integer(table, exact ? result->exact[k].points : result->count);
        report_text(table, k == 0 || exact ? arguments->lobe_text : arguments->mirror_text);
        report_text(table, arguments->method_name);
        for (size_t i = 0; i < FIGURES; ++i)
            if (shown[i])
                report_number(table, figures[i], of[i].digits);
    }
    return cli_finish(table, arguments->common.format);
}

static int write_points(const cli_weights_arguments *arguments, const cli_weights_result *result) {
    aur_error error = {0};
    const aur_points_view points =
        aur_points_view_of(result->domain, result->count, result->dimension, result->xyz);
    return cli_status(aur_weights_write_points(arguments->path != NULL ? arguments->path : "-", &points,
                                               result->lobe_count, result->weights, &error),
                      &error);
}

static int weigh(const cli_weights_arguments *arguments) {
    cli_weights_result result = {0};
    int status = cli_weights_compute(arguments, &result);
    if (status == CLI_SUCCESS && arguments->report)
        status = print_report(arguments, &result);
    if (status == CLI_SUCCESS && arguments->plot != NULL)
        status = cli_weights_plot(arguments, &result);
    /* A report or plot was requested: samples are written only with -o. */
    const bool writes = arguments->path != NULL || (!arguments->report && arguments->plot == NULL);
    if (status == CLI_SUCCESS && writes)
        status = write_points(arguments, &result);
    free(result.xyz);
    free(result.weights);
    free(result.near);
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
    arguments->points.options.warnings = cli_warnings(arguments->common.quiet);
    if (arguments->look_up && (arguments->table == NULL || arguments->report || arguments->plot != NULL))
        return cli_bad_usage("--lookup: needs a table to read, --table FILE, and neither reports nor draws");
    if (call->operand_count == 0 && !arguments->look_up)
        return cli_bad_usage(
            "weights: no set or file given: see 'aureole sets' (--table FILE is read by --lookup DEGREES)");
    aur_error error = {0};
    if (arguments->table != NULL && !arguments->look_up &&
        cli_announce_output(arguments->table, &error) != AUR_OK)
        return cli_fail(&error);
    if (call->operand_count > 0 && complete(call, arguments) != CLI_SUCCESS)
        return CLI_BAD_INPUT;
    arguments->method_name = method_name(arguments->method);
    if (arguments->look_up)
        return cli_weights_look_up(arguments);
    return arguments->table != NULL ? cli_weights_table(arguments) : weigh(arguments);
}

const cli_command cli_command_weights = {
    .name = "weights",
    .summary = "compute optimal and exact weights of samples, and their gain",
    .notes =
        "Points are directions of the hemisphere (of the sphere, if the lobe is uniform). The lobe "
        "multiplies the integrand, and points of a set follow it. Weights add up to 1: equal ones are 1/N. "
        "Square, cube, disk and rotations have exact weights only. Weights gain most for random, irregular "
        "and partial sets. With --lookup, omit the set and its options, or give those of the table.",
    .operands = {{"FILE|SET", "the samples", .optional = true, .content = "file or set"}},
    .groups = {{options, 0},
               {cli_points_options, offsetof(cli_weights_arguments, points)},
               {cli_cap_option, offsetof(cli_weights_arguments, points)},
               {cli_dimension_option, offsetof(cli_weights_arguments, points)},
               {cli_format_option, offsetof(cli_weights_arguments, common)},
               {cli_threads_option, offsetof(cli_weights_arguments, common)},
               {cli_quiet_option, offsetof(cli_weights_arguments, common)},
               {cli_cache_option, offsetof(cli_weights_arguments, common)}},
    .size = sizeof(cli_weights_arguments),
    .run = run,
    .ranks = true,
};
