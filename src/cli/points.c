/* aureole points: writes points of any set on any domain. */
#include <aureole/image.h>
#include <aureole/sphere.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/cli.h"
#include "cli/draw.h"
#include "cli/picture.h"

/* The first four are the library's, in its order. */
static const char *const format_words[] = {"csv", "json", "npy", "ply", "svg", "png"};
enum { FORMAT_COUNT = sizeof format_words / sizeof format_words[0], FORMAT_SVG = 4, FORMAT_PNG = 5 };

typedef struct request {
    const char *set;
    const char *path;
    const char *warp; /* a picture's path */
    size_t format;    /* index into format_words */
    bool format_given, map_given, lobe_given, domain_given, size_given, quiet;
    aur_directions_options options; /* of points */
    aur_points_request points;
} request;

static bool parse_domain(const char *text, request *wanted) {
    static const char *const words[] = {"square", "disk", "hemisphere", "sphere"};
    static const aur_domain domains[] = {AUR_DOMAIN_SQUARE, AUR_DOMAIN_DISK, AUR_DOMAIN_HEMISPHERE,
                                         AUR_DOMAIN_SPHERE};
    size_t index;
    if (!cli_parse_word("--domain", text, 4, words, &index))
        return false;
    wanted->options.domain = domains[index];
    wanted->domain_given = true;
    return true;
}

static bool parse_density(const char *text, request *wanted) {
    static const char *const words[] = {"same", "optimal"};
    size_t index;
    if (!cli_parse_word("--density", text, 2, words, &index))
        return false;
    wanted->options.optimal_density = index == 1;
    return true;
}

/* Reports an error of the library that came from the command line itself. */
static bool accept(aur_result result, const aur_error *error) {
    if (result != AUR_OK)
        cli_fail(error);
    return result == AUR_OK;
}

enum {
    FIRST = 256,
    COUNT,
    DIMENSION,
    DOMAIN,
    MAP,
    LOBE,
    DENSITY,
    SMOOTHNESS,
    SCRAMBLE,
    SEED,
    CAP,
    WARP,
    FORMAT
};

static bool parse_option(int option, const char *text, request *wanted) {
    aur_directions_options *const options = &wanted->options;
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
        return cli_parse_word("--format", text, FORMAT_COUNT, format_words, &wanted->format);
    case WARP:
        wanted->warp = text;
        return true;
    default:
        return false;
    }
}

/* By the name's end when no format is given. */
static void format_from_path(request *wanted) {
    const char *const dot = strrchr(wanted->path, '.');
    for (size_t i = 0; i < FORMAT_COUNT && dot != NULL && !wanted->format_given; ++i)
        if (strcmp(format_words[i], dot + 1) == 0)
            wanted->format = i;
}

static bool parse(int argc, char **argv, request *wanted) {
    static const struct option options[] = {
        {"first", required_argument, NULL, FIRST},       {"count", required_argument, NULL, COUNT},
        {"dim", required_argument, NULL, DIMENSION},     {"domain", required_argument, NULL, DOMAIN},
        {"map", required_argument, NULL, MAP},           {"lobe", required_argument, NULL, LOBE},
        {"density", required_argument, NULL, DENSITY},   {"smoothness", required_argument, NULL, SMOOTHNESS},
        {"scramble", required_argument, NULL, SCRAMBLE}, {"seed", required_argument, NULL, SEED},
        {"cap", required_argument, NULL, CAP},           {"warp", required_argument, NULL, WARP},
        {"format", required_argument, NULL, FORMAT},     {0}};
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
        wanted->options.domain = AUR_DOMAIN_HEMISPHERE;
        wanted->domain_given = true;
    }
    wanted->points.natural_domain = !wanted->domain_given;
    if (wanted->map_given && (!wanted->domain_given || wanted->options.domain == AUR_DOMAIN_SQUARE)) {
        cli_bad_usage("--map: needs --domain disk, hemisphere or sphere");
        return false;
    }
    format_from_path(wanted);
    return true;
}

/* The density that a picture's brightness (Rec. 709 luminance) makes; returns the exit status. */
static int read_density(const char *path, aur_density_image **density) {
    aur_image *image;
    const int status = cli_read_picture(path, NULL, &image);
    if (status != CLI_SUCCESS)
        return status;
    size_t channels[3];
    if (!aur_image_color_channels(image, channels)) {
        aur_image_destroy(image);
        return cli_bad_usage("--warp: %s must have one channel (or Y), or R, G and B, to have a brightness",
                             path);
    }
    const size_t width = aur_image_width(image), height = aur_image_height(image);
    const size_t count = width * height, channel_count = aur_image_channel_count(image);
    float *const luminance = malloc(count * sizeof *luminance);
    aur_error error = {.result = AUR_ERROR_MEMORY, .message = "out of memory"};
    for (size_t i = 0; i < count && luminance != NULL; ++i) {
        const float *const pixel = aur_image_data(image) + i * channel_count;
        luminance[i] =
            0.2126f * pixel[channels[0]] + 0.7152f * pixel[channels[1]] + 0.0722f * pixel[channels[2]];
    }
    const bool good =
        luminance != NULL && aur_density_image_create(width, height, luminance, density, &error) == AUR_OK;
    free(luminance);
    aur_image_destroy(image);
    snprintf(error.file, sizeof error.file, "%s", path);
    return good ? CLI_SUCCESS : cli_fail(&error);
}

/* Moves the points into an array of their own, which the caller frees. */
static int warp(const char *path, aur_points_view *points, double **warped) {
    if (points->domain != AUR_DOMAIN_SQUARE)
        return cli_bad_usage("--warp: needs points of the square");
    aur_density_image *density;
    const int status = read_density(path, &density);
    if (status != CLI_SUCCESS)
        return status;
    *warped = malloc(2 * points->count * sizeof **warped);
    for (size_t i = 0; i < points->count && *warped != NULL; ++i)
        aur_density_image_warp(density, points->coordinates + 2 * i, *warped + 2 * i);
    aur_density_image_destroy(density);
    points->coordinates = *warped;
    return *warped != NULL ? CLI_SUCCESS
                           : cli_fail(&(aur_error){.result = AUR_ERROR_MEMORY, .message = "out of memory"});
}

static int write_points(const request *wanted, const aur_points_view *points) {
    aur_error error = {0};
    const uint64_t size = wanted->options.count; /* 0: all of a file */
    const aur_points_origin origin = {.size = sizeof origin,
                                      .set = wanted->set,
                                      .count = size != 0 ? size : wanted->points.first + points->count,
                                      .first = wanted->points.first,
                                      .scramble = wanted->options.scramble,
                                      .seed = wanted->options.seed};
    const aur_result result =
        wanted->format >= FORMAT_SVG
            ? cli_draw_points(wanted->path, wanted->format == FORMAT_PNG, points, &error)
            : aur_points_write(wanted->path, (aur_points_format)wanted->format, points, &origin, &error);
    return result == AUR_OK ? CLI_SUCCESS : cli_fail(&error);
}

static int run(int argc, char **argv) {
    request wanted = {.path = "-",
                      .options = aur_directions_options_default(0, AUR_DOMAIN_SQUARE),
                      .points = aur_points_request_default(&wanted.options)};
    if (!parse(argc, argv, &wanted) || !complete(&wanted))
        return CLI_BAD_INPUT;
    wanted.options.warnings = cli_warnings(wanted.quiet);
    aur_error error = {0};
    aur_points *points;
    if (aur_points_generate(wanted.set, &wanted.points, &points, &error) != AUR_OK)
        return cli_fail(&error);
    aur_points_view view = *aur_points_look(points);
    double *warped = NULL;
    int status = wanted.warp != NULL ? warp(wanted.warp, &view, &warped) : CLI_SUCCESS;
    if (status == CLI_SUCCESS)
        status = write_points(&wanted, &view);
    free(warped);
    aur_points_destroy(points);
    return status;
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
    "  --warp IMAGE           move points of the square so that they follow the picture's brightness\n"
    "  --format FORMAT        csv, npy, ply, json, svg or png (by the file's name; csv)\n"
    "  -o FILE                where to (standard output)\n"
    "  -q                     no warnings\n",
    run,
};
