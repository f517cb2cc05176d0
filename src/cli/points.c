/* aureole points: writes points of any set on any domain. */
#include <aureole/sphere.h>
#include <stdio.h>
#include <string.h>

#include "cli/cli.h"

typedef struct request {
    const char *set;
    const char *path;
    aur_points_format format;
    bool format_given, map_given, lobe_given, domain_given, size_given, quiet;
    aur_points_request points;
} request;

static bool parse_domain(const char *text, request *wanted) {
    static const char *const words[] = {"square", "disk", "hemisphere", "sphere"};
    static const aur_domain domains[] = {AUR_DOMAIN_SQUARE, AUR_DOMAIN_DISK, AUR_DOMAIN_HEMISPHERE,
                                         AUR_DOMAIN_SPHERE};
    size_t index;
    if (!cli_parse_word("--domain", text, 4, words, &index))
        return false;
    wanted->points.options.domain = domains[index];
    wanted->domain_given = true;
    return true;
}

static bool parse_density(const char *text, request *wanted) {
    static const char *const words[] = {"same", "optimal"};
    size_t index;
    if (!cli_parse_word("--density", text, 2, words, &index))
        return false;
    wanted->points.options.optimal_density = index == 1;
    return true;
}

/* Reports an error of the library that came from the command line itself. */
static bool accept(aur_result result, const aur_error *error) {
    if (result != AUR_OK)
        cli_fail(error);
    return result == AUR_OK;
}

enum { FIRST = 256, COUNT, DIMENSION, DOMAIN, MAP, LOBE, DENSITY, SMOOTHNESS, SCRAMBLE, SEED, CAP, FORMAT };

static bool parse_option(int option, const char *text, request *wanted) {
    aur_directions_options *const options = &wanted->points.options;
    aur_error error = {0};
    switch (option) {
    case 'n':
        wanted->size_given = true;
        if (!cli_parse_u64("-n", text, &options->count))
            return false;
        if (options->count == 0)
            cli_bad_usage("-n: must be at least 1, not 0");
        return options->count > 0;
    case 'o':
        wanted->path = text;
        return true;
    case 'q':
        wanted->quiet = true;
        return true;
    case FIRST:
        return cli_parse_u64("--first", text, &wanted->points.first);
    case COUNT:
        return cli_parse_size("--count", text, 1, SIZE_MAX, &wanted->points.count);
    case DIMENSION:
        return cli_parse_size("--dim", text, 1, SIZE_MAX, &wanted->points.dimension);
    case DOMAIN:
        return parse_domain(text, wanted);
    case MAP:
        wanted->map_given = true;
        return accept(aur_map_from_name(text, &options->map, &error), &error);
    case LOBE:
        wanted->lobe_given = true;
        return accept(aur_lobe_parse(text, &options->lobe, &error), &error);
    case DENSITY:
        return parse_density(text, wanted);
    case SMOOTHNESS:
        return cli_parse_number("--smoothness", text, 1.0, 2.0, &options->smoothness);
    case SCRAMBLE:
        return accept(aur_scramble_from_name(text, &options->scramble, &error), &error);
    case SEED:
        return cli_parse_u64("--seed", text, &options->seed);
    case CAP:
        return cli_parse_number("--cap", text, 1e-6, 180.0, &options->cap_degrees);
    case FORMAT:
        wanted->format_given = true;
        return accept(aur_points_format_from_name(text, &wanted->format, &error), &error);
    default:
        return false;
    }
}

/* By the name's end when no format is given. */
static void format_from_path(request *wanted) {
    const char *const dot = wanted->path != NULL ? strrchr(wanted->path, '.') : NULL;
    if (!wanted->format_given && dot != NULL &&
        aur_points_format_from_name(dot + 1, &wanted->format, NULL) != AUR_OK)
        wanted->format = AUR_POINTS_CSV;
}

static bool parse(int argc, char **argv, request *wanted) {
    static const struct option options[] = {{"first", required_argument, NULL, FIRST},
                                            {"count", required_argument, NULL, COUNT},
                                            {"dim", required_argument, NULL, DIMENSION},
                                            {"domain", required_argument, NULL, DOMAIN},
                                            {"map", required_argument, NULL, MAP},
                                            {"lobe", required_argument, NULL, LOBE},
                                            {"density", required_argument, NULL, DENSITY},
                                            {"smoothness", required_argument, NULL, SMOOTHNESS},
                                            {"scramble", required_argument, NULL, SCRAMBLE},
                                            {"seed", required_argument, NULL, SEED},
                                            {"cap", required_argument, NULL, CAP},
                                            {"format", required_argument, NULL, FORMAT},
                                            {0}};
    optind = 0;
    for (int option; (option = cli_next_option(argc, argv, "n:o:q", options)) != -1;)
        if (!parse_option(option, optarg, wanted))
            return false;
    if (optind + 1 != argc) {
        if (optind == argc)
            cli_bad_usage("points: a set is missing: 'aureole sets' lists them");
        else
            cli_bad_usage("points: unexpected argument '%s'", argv[optind + 1]);
        return false;
    }
    wanted->set = argv[optind];
    return true;
}

/* What is left to the set when the command line does not say it. */
static bool complete(request *wanted) {
    if (!wanted->size_given && strncmp(wanted->set, "file:", 5) != 0) {
        cli_bad_usage("points: the size of the set is missing: give -n N");
        return false;
    }
    if (!wanted->domain_given && wanted->lobe_given) {
        wanted->points.options.domain = AUR_DOMAIN_HEMISPHERE;
        wanted->domain_given = true;
    }
    wanted->points.natural_domain = !wanted->domain_given;
    if (wanted->map_given && (!wanted->domain_given || wanted->points.options.domain == AUR_DOMAIN_SQUARE)) {
        cli_bad_usage("--map: needs --domain disk, hemisphere or sphere");
        return false;
    }
    format_from_path(wanted);
    return true;
}

static int run(int argc, char **argv) {
    request wanted = {.path = "-"};
    if (!parse(argc, argv, &wanted) || !complete(&wanted))
        return CLI_BAD_INPUT;
    wanted.points.options.warnings = cli_warnings(wanted.quiet);
    aur_error error = {0};
    aur_points points;
    if (aur_points_generate(wanted.set, &wanted.points, &points, &error) != AUR_OK)
        return cli_fail(&error);
    const aur_points_origin origin = {.set = wanted.set,
                                      .size = wanted.points.options.count,
                                      .first = wanted.points.first,
                                      .scramble = wanted.points.options.scramble,
                                      .seed = wanted.points.options.seed};
    const aur_result result = aur_points_write(wanted.path, wanted.format, &points, &origin, &error);
    aur_points_release(&points);
    return result == AUR_OK ? CLI_SUCCESS : cli_fail(&error);
}

const cli_verb cli_verb_points = {
    "points",
    "SET -n N [options]",
    "write points of a set on the square, disk, hemisphere or sphere",
    "SET is NAME[:key=value,...] or file:PATH; 'aureole sets' lists them.\n\n"
    "  -n N                   the size of the set (a file: all of it)\n"
    "  --first K, --count C   only C points from point K on (0, all)\n"
    "  --dim D                coordinates a point on the cube (2)\n"
    "  --domain DOMAIN        square, disk, hemisphere or sphere (the set's own)\n"
    "  --map MAP              lambert, concentric, azimuthal or polar (lambert)\n"
    "  --cap DEGREES          only the cap of this polar angle about +z, filled with N points\n"
    "  --lobe LOBE            uniform, cosine, phong:M or ggx:ALPHA[:VIEW_DEGREES], on the hemisphere\n"
    "  --density same|optimal points follow the lobe, or its power 2/(s+1) with weights (same)\n"
    "  --smoothness S         s of the optimal density, between 1 and 2 (1.5)\n"
    "  --scramble SCRAMBLE    none, digit, owen, shift, rotate or rotate3d (none)\n"
    "  --seed S               of random sets and scramblings (0)\n"
    "  --format FORMAT        csv, npy, ply or json (by the file's name; csv)\n"
    "  -o FILE                where to (standard output)\n"
    "  -q                     no warnings\n",
    run,
};
