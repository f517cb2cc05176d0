/* aureole weights: optimal weights of samples, their rivals, and what they gain. */
#include "cli/weights.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char help[] =
    "  -n N                   samples of the set (a file: all of it)\n"
    "  --domain DOMAIN        hemisphere or sphere, where the lobe is uniform (hemisphere)\n"
    "  --lobe LOBE            what the integrand is multiplied by: uniform, cosine, phong:M or\n"
    "                         ggx:ALPHA[:VIEW_DEGREES]; the points of a set follow it (uniform)\n"
    "  --lobe2 LOBE --angle DEGREES [--n2 N]\n"
    "                         a second lobe about the mirror direction of a view at that angle, with samples "
    "of\n"
    "                         its own; its weights are the column w2\n"
    "  --clip                 the second lobe ends at the horizon; hidden samples get weight 0\n"
    "  --method METHOD        osw (optimal, each lobe from its own samples), oswa (optimal, from all; needs\n"
    "                         --lobe2), mis or mis-power (balance, power heuristic), equal, ratio (p/q);\n"
    "                         osw for one lobe, oswa for two\n"
    "  --density same|optimal points follow the lobe, or its power 2/(s+1) (same)\n"
    "  --smoothness S         s of the integrand, between 1 and 2 (1.5)\n"
    "  --regularization R     added to the diagonal (1e-6)\n"
    "  --unconstrained        do not fix the sum of the weights to 1\n"
    "  --map MAP, --scramble SCRAMBLE, --seed S\n"
    "                         as for 'aureole points'\n"
    "  --report               print worst-case errors with equal and optimal weights and the gain instead\n"
    "  --format FORMAT        of the report: table, csv or json\n"
    "  -o FILE                write x,y,z,w there as CSV (standard output, unless there is a report)\n"
    "  --plot FILE.svg        draw the samples coloured by weight (needs gnuplot)\n"
    "  --table FILE --angles T --rotations K\n"
    "                         build a table of OSWA weights for the two lobes (64 angles, 16 rotations)\n"
    "  --table FILE --lookup DEGREES [--rotation K] [--mirrored]\n"
    "                         write the samples and weights of a table at that angle (rotation 0); with a "
    "set and\n"
    "                         its options the table must have been built from them, else they may be left "
    "out\n"
    "  -t, --threads T        0: all\n"
    "  -q                     no progress bar and no warnings\n"
    "\n"
    "Weights are for densities of integral 1: equal ones are 1/N. They are worth most for random, irregular "
    "and\n"
    "partial sets.\n";

enum {
    OPTION_LOBE2 = 256,
    OPTION_ANGLE,
    OPTION_N2,
    OPTION_CLIP,
    OPTION_METHOD,
    OPTION_REGULARIZATION,
    OPTION_UNCONSTRAINED,
    OPTION_REPORT,
    OPTION_FORMAT,
    OPTION_PLOT,
    OPTION_TABLE,
    OPTION_ANGLES,
    OPTION_ROTATIONS,
    OPTION_LOOKUP,
    OPTION_ROTATION,
    OPTION_MIRRORED
};

static const struct option long_options[] = {
    {"domain", required_argument, NULL, CLI_POINTS_DOMAIN},
    {"lobe", required_argument, NULL, CLI_POINTS_LOBE},
    {"lobe2", required_argument, NULL, OPTION_LOBE2},
    {"angle", required_argument, NULL, OPTION_ANGLE},
    {"n2", required_argument, NULL, OPTION_N2},
    {"clip", no_argument, NULL, OPTION_CLIP},
    {"method", required_argument, NULL, OPTION_METHOD},
    {"density", required_argument, NULL, CLI_POINTS_DENSITY},
    {"smoothness", required_argument, NULL, CLI_POINTS_SMOOTHNESS},
    {"regularization", required_argument, NULL, OPTION_REGULARIZATION},
    {"unconstrained", no_argument, NULL, OPTION_UNCONSTRAINED},
    {"map", required_argument, NULL, CLI_POINTS_MAP},
    {"scramble", required_argument, NULL, CLI_POINTS_SCRAMBLE},
    {"seed", required_argument, NULL, CLI_POINTS_SEED},
    {"report", no_argument, NULL, OPTION_REPORT},
    {"format", required_argument, NULL, OPTION_FORMAT},
    {"plot", required_argument, NULL, OPTION_PLOT},
    {"table", required_argument, NULL, OPTION_TABLE},
    {"angles", required_argument, NULL, OPTION_ANGLES},
    {"rotations", required_argument, NULL, OPTION_ROTATIONS},
    {"lookup", required_argument, NULL, OPTION_LOOKUP},
    {"rotation", required_argument, NULL, OPTION_ROTATION},
    {"mirrored", no_argument, NULL, OPTION_MIRRORED},
    {"threads", required_argument, NULL, 't'},
    {"quiet", no_argument, NULL, 'q'},
    {NULL, 0, NULL, 0}};

static bool parse_method(const char *text, cli_weights_arguments *arguments) {
    static const char *const words[] = {"osw", "oswa", "mis", "mis-power", "equal", "ratio"};
    size_t index;
    if (!cli_parse_word("--method", text, sizeof words / sizeof words[0], words, &index))
        return false;
    arguments->method = (cli_method)index;
    arguments->method_name = words[index];
    arguments->method_given = true;
    return true;
}

static bool parse_option(int option, const char *text, cli_weights_arguments *arguments) {
    aur_error error = {0};
    switch (option) {
    case 'n':
        arguments->size_given = true;
        return cli_parse_size("-n", text, 1, SIZE_MAX, &arguments->size);
    case 'o':
        arguments->path = text;
        return true;
    case 'q':
        arguments->quiet = true;
        return true;
    case 't':
        return cli_parse_size("--threads", text, 0, 4096, &arguments->threads);
    case CLI_POINTS_LOBE:
        arguments->lobe_given = true;
        arguments->lobe_text = text;
        return cli_parse_point_option(option, text, &arguments->points);
    case OPTION_LOBE2:
        arguments->mirror_given = true;
        arguments->mirror_text = text;
        return cli_succeeded(aur_lobe_parse(text, &arguments->mirror, &error), &error);
    case OPTION_ANGLE:
        arguments->angle_given = true;
        return cli_parse_number("--angle", text, 0.0, 90.0, &arguments->degrees);
    case OPTION_N2:
        return cli_parse_size("--n2", text, 1, SIZE_MAX, &arguments->mirror_size);
    case OPTION_CLIP:
        arguments->clipped = true;
        return true;
    case OPTION_METHOD:
        return parse_method(text, arguments);
    case OPTION_REGULARIZATION:
        return cli_parse_number("--regularization", text, 0.0, 1e300, &arguments->weights.regularization);
    case OPTION_UNCONSTRAINED:
        arguments->weights.sum_constraint = false;
        return true;
    case OPTION_REPORT:
        arguments->report = true;
        return true;
    case OPTION_FORMAT:
        return cli_parse_format(text, &arguments->format);
    case OPTION_PLOT:
        arguments->plot = text;
        return true;
    case OPTION_TABLE:
        arguments->table = text;
        return true;
    case OPTION_ANGLES:
        return cli_parse_size("--angles", text, 2, 1 << 16, &arguments->angles);
    case OPTION_ROTATIONS:
        return cli_parse_size("--rotations", text, 1, 1 << 16, &arguments->rotations);
    case OPTION_LOOKUP:
        arguments->look_up = true;
        return cli_parse_number("--lookup", text, 0.0, 90.0, &arguments->look_up_degrees);
    case OPTION_ROTATION:
        return cli_parse_size("--rotation", text, 0, (1 << 16) - 1, &arguments->rotation);
    case OPTION_MIRRORED:
        arguments->mirrored = true;
        return true;
    default:
        return cli_parse_point_option(option, text, &arguments->points);
    }
}

/* What the options mean together. */
static bool complete(cli_weights_arguments *arguments) {
    if (!arguments->points.domain_given)
        arguments->points.domain = AUR_DOMAIN_HEMISPHERE;
    if (arguments->points.domain != AUR_DOMAIN_HEMISPHERE && arguments->points.domain != AUR_DOMAIN_SPHERE) {
        cli_bad_usage("--domain: must be one of hemisphere, sphere, not '%s'",
                      aur_domain_name(arguments->points.domain));
        return false;
    }
    if (!arguments->size_given && !cli_is_file(arguments->source) &&
        strncmp(arguments->source, "file:", 5) != 0) {
        cli_bad_usage("weights: -n is missing for the set '%s' (there is no such file)", arguments->source);
        return false;
    }
    if (arguments->points.optimal_density &&
        (cli_is_file(arguments->source) || strncmp(arguments->source, "file:", 5) == 0)) {
        cli_bad_usage("--density: the points of a file are as they stand");
        return false;
    }
    if (arguments->points.smoothness == 1.0 || arguments->points.smoothness == 2.0) {
        cli_bad_usage("--smoothness: must be between 1 and 2, both exclusive");
        return false;
    }
    const bool two = arguments->mirror_given;
    if (!two && (arguments->angle_given || arguments->mirror_size > 0 || arguments->clipped)) {
        cli_bad_usage("--angle, --n2 and --clip are for two lobes: give --lobe2");
        return false;
    }
    if (two && !arguments->angle_given && arguments->table == NULL) {
        cli_bad_usage("--lobe2: the angle of the view is missing: give --angle DEGREES");
        return false;
    }
    if (two && arguments->points.domain == AUR_DOMAIN_SPHERE) {
        cli_bad_usage("--lobe2: two lobes are for the hemisphere");
        return false;
    }
    if (arguments->table != NULL && !two) {
        cli_bad_usage("--table: needs two lobes: give --lobe2");
        return false;
    }
    if (!arguments->method_given) {
        arguments->method = two ? CLI_METHOD_OSWA : CLI_METHOD_OSW;
        arguments->method_name = two ? "oswa" : "osw";
    }
    if (arguments->method == CLI_METHOD_OSWA && !two) {
        cli_bad_usage("--method oswa: needs two lobes: give --lobe2");
        return false;
    }
    if (arguments->mirror_size == 0)
        arguments->mirror_size = arguments->size;
    return true;
}

static bool parse(int argc, char **argv, cli_weights_arguments *arguments) {
    optind = 0;
    for (int option; (option = cli_next_option(argc, argv, "n:o:t:q", long_options)) != -1;)
        if (!parse_option(option, optarg, arguments))
            return false;
    if (arguments->look_up && (arguments->table == NULL || arguments->report || arguments->plot != NULL)) {
        cli_bad_usage("--lookup: needs a table to read, --table FILE, and neither reports nor draws");
        return false;
    }
    if (arguments->look_up && optind == argc)
        return true;
    if (optind + 1 != argc) {
        if (optind == argc)
            cli_bad_usage("weights: a set or a file is missing: 'aureole sets' lists the sets");
        else
            cli_bad_usage("weights: unexpected argument '%s'", argv[optind + 1]);
        return false;
    }
    arguments->source = argv[optind];
    arguments->points.warnings = cli_warnings(arguments->quiet);
    return complete(arguments);
}

static int print_report(const cli_weights_arguments *arguments, const cli_weights_result *result) {
    const bool optimal = arguments->method == CLI_METHOD_OSW || arguments->method == CLI_METHOD_OSWA;
    const char *columns[10] = {"set", "n", "lobe", "method", "equal"};
    size_t count = 5;
    if (result->has_ratio)
        columns[count++] = "ratio";
    columns[count++] = optimal ? "optimal" : "weighted";
    columns[count++] = "gain_percent";
    columns[count++] = "weight_sum";
    if (result->condition > 0.0)
        columns[count++] = "condition";
    cli_table *const table = cli_table_create(count, columns);
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
    const int status = cli_table_print(table, arguments->format);
    cli_table_destroy(table);
    return status;
}

static int write_points(const cli_weights_arguments *arguments, const cli_weights_result *result) {
    aur_error error = {0};
    const char *const path = arguments->path != NULL ? arguments->path : "-";
    return aur_weights_write(path, result->count, result->xyz, result->lobe_count, result->weights, &error) ==
                   AUR_OK
               ? CLI_SUCCESS
               : cli_fail(&error);
}

static int run(int argc, char **argv) {
    cli_weights_arguments arguments = {
        .weights = aur_weights_options_default(), .lobe_text = "uniform", .angles = 64, .rotations = 16};
    if (!parse(argc, argv, &arguments))
        return CLI_BAD_INPUT;
    if (arguments.look_up)
        return cli_weights_look_up(&arguments);
    if (arguments.table != NULL)
        return cli_weights_table(&arguments);
    cli_weights_result result = {0};
    int status = cli_weights_compute(&arguments, &result);
    if (status == CLI_SUCCESS && arguments.report)
        status = print_report(&arguments, &result);
    if (status == CLI_SUCCESS && arguments.plot != NULL)
        status = cli_weights_plot(&arguments, &result);
    /* Figures or a picture were asked for: the samples only where -o says. */
    const bool asked = arguments.path != NULL || (!arguments.report && arguments.plot == NULL);
    if (status == CLI_SUCCESS && asked)
        status = write_points(&arguments, &result);
    free(result.xyz);
    free(result.weights);
    return status;
}

const cli_verb cli_verb_weights = {"weights", "FILE|SET [-n N] --lobe LOBE [options]",
                                   "optimal weights of samples, and what they gain", help, run};
