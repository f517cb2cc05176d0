/* aureole points: writes points of any set on any domain. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "program/cli/points/point_source.h"
#include "program/report/figure.h"

enum { FIRST_FIGURE = AUR_POINTS_PLY + 1 }; /* figure formats follow the library's formats */

typedef struct points_command {
    const char *path;
    const char *warp; /* path of an image */
    unsigned format;
    const char *symmetry;
    bool matrices; /* of rotations */
    cli_common common;
    cli_points from;
    aur_points_request points;
    aur_points_write_options write;
} points_command;

static const char *format_name(unsigned format) {
    return format < FIRST_FIGURE ? aur_points_format_name((aur_points_format)format)
                                 : report_figure_format(format - FIRST_FIGURE);
}

static aur_result choose_json(const char *text, void *field, aur_error *error) {
    (void)text, (void)error;
    *(unsigned *)field = AUR_POINTS_JSON;
    return AUR_OK;
}

static const cli_option options[] = {
    {CLI_INTEGER(points_command, from.options.count, "size", "N", 1, INFINITY, "all points of a file",
                 "size of the set"),
     .letter = 'n', .key.computed = true},
    {CLI_INTEGER(points_command, points.first, "first", "K", 0, INFINITY, "0",
                 "index of the first point to write")},
    {CLI_INTEGER(points_command, points.count, "count", "C", 1, INFINITY, "all", "number of points to write"),
     .key.computed = true},
    {CLI_TEXT(points_command, warp, "warp", "IMAGE", NULL,
              "warp points of the square to the brightness of an image"),
     .content = "file"},
    {CLI_TEXT(
        points_command, symmetry, "symmetry", "GROUP", NULL,
        "only points in the fundamental region: of rotations for a crystal's group (432 for a cubic one; 1 "
        "makes w positive), of directions for a point group (D2h, Oh)")},
    {CLI_FLAG(points_command, matrices, "matrices", "write rotations as matrices, row by row")},
    {CLI_CHOICE(points_command, format, "format", "FORMAT", "from the extension, or csv",
                "output format; svg, pdf, png and tex are plots"),
     .key.computed = true, .name = format_name},
    {CLI_FLAG(points_command, format, "json", "same as --format json"), .parse = choose_json},
    {CLI_FLAG(points_command, write.no_header, "no-header", "write CSV without a header")},
    {CLI_INTEGER(points_command, write.digits, "digits", "D", 1, 17, NULL,
                 "significant digits of CSV; 17, the default, are exact")},
    {CLI_FLAG(points_command, write.single, "single",
              "write 32-bit floats instead of 64-bit ones (NPY, PLY)")},
    {CLI_TEXT(points_command, path, "output", "FILE", "-", "output file; '-' is standard output"),
     .letter = 'o', .content = "file", .writes = true},
    {.key = {0}}};

/* The format given by option, or else by the file's extension. CSV without an extension and for '-'. */
static bool choose_format(points_command *command, bool format_given) {
    const char *const slash = strrchr(command->path, '/');
    const char *const dot = strrchr(slash != NULL ? slash : command->path, '.');
    if (format_given || dot == NULL)
        return true;
    for (unsigned i = 0; format_name(i) != NULL; ++i)
        if (strcasecmp(format_name(i), dot + 1) == 0) {
            command->format = i;
            return true;
        }
    cli_bad_usage("-o: '%s' must end in .csv, .json, .npy, .ply, .svg, .pdf, .png or .tex, or --format say "
                  "how it is written",
                  command->path);
    return false;
}

/* Values that follow from the set and the file name unless they are given. */
static bool derive_options(const cli_call *call) {
    points_command *const command = call->options;
    bool domain_given = cli_given(call, "domain") != NULL;
    if (cli_given(call, "size") == NULL && !cli_has_size(call->operands[0])) {
        cli_bad_usage("points: the size of the set is missing: give -n N");
        return false;
    }
    if (!domain_given && cli_given(call, "lobe") != NULL) {
        command->from.options.domain = AUR_DOMAIN_HEMISPHERE;
        domain_given = true;
    }
    command->points.natural_domain = !domain_given;
    if (cli_given(call, "map") != NULL &&
        (!domain_given || command->from.options.domain <= AUR_DOMAIN_CUBE)) {
        cli_bad_usage("--map: needs --domain disk, hemisphere, sphere or axes");
        return false;
    }
    return choose_format(command, cli_given(call, "format") != NULL || cli_given(call, "json") != NULL);
}

static int out_of_memory(void) {
    return cli_fail(&(aur_error){.result = AUR_ERROR_MEMORY, .message = "out of memory"});
}

/* Copies the points to an array, which the caller frees. */
static int warp(const char *path, aur_points_view *points, double **warped) {
    if (points->domain != AUR_DOMAIN_SQUARE)
        return cli_bad_usage("--warp: needs points of the square");
    aur_density_image *density;
    const int status = cli_read_density(path, &density);
    if (status != CLI_SUCCESS)
        return status;
    *warped = malloc(2 * points->count * sizeof **warped);
    for (size_t i = 0; i < points->count && *warped != NULL; ++i)
        aur_density_image_warp(density, points->coordinates + 2 * i, *warped + 2 * i);
    aur_density_image_destroy(density);
    points->coordinates = *warped;
    return *warped != NULL ? CLI_SUCCESS : out_of_memory();
}

/* Weights of whole orbits sum to 1 if the set has the symmetry. */
static int check_sum(const aur_points_view *points) {
    double sum = 0.0;
    for (size_t i = 0; i < points->count; ++i)
        sum += points->weights[i];
    return fabs(sum - 1.0) < 1e-9
               ? CLI_SUCCESS
               : cli_bad_usage("--symmetry: the set has weights and not this symmetry: those of the "
                               "fundamental region add up to %.6g",
                               sum);
}

/* Copies points of the fundamental region, and rotations as matrices, to an array, which the caller frees. */
static int change_points(const points_command *command, aur_points_view *points, double **changed) {
    if (command->symmetry == NULL && !command->matrices)
        return CLI_SUCCESS;
    cli_symmetry symmetry;
    aur_error error = {0};
    if (cli_parse_symmetry(command->symmetry, points->domain, &symmetry, &error) != AUR_OK)
        return cli_fail(&error);
    const size_t count = points->count, from = points->dimension;
    if (command->matrices && points->domain != AUR_DOMAIN_ROTATIONS)
        return cli_bad_usage("--matrices: needs --domain rotations");
    if (points->weights != NULL && symmetry.given && from != 3)
        return cli_bad_usage("--symmetry: the rotations have weights, which would no longer add up to 1");
    *changed = malloc((from + 10) * count * sizeof **changed);
    if (*changed == NULL)
        return out_of_memory();
    double *const copied = *changed + (command->matrices ? 9 * count : 0);
    double *const weights = points->weights != NULL ? *changed + (from + 9) * count : NULL;
    for (size_t i = 0; i < from * count; ++i)
        copied[i] = points->coordinates[i / from * points->stride + i % from];
    if (weights != NULL)
        memcpy(weights, points->weights, count * sizeof *weights);
    if (symmetry.given)
        points->count = from == 3 ? aur_point_group_select(&symmetry.group, count, copied, weights)
                                  : aur_symmetry_select(symmetry.crystal, count, copied);
    if (points->count == 0)
        return cli_bad_usage("--symmetry: no point is in the fundamental region: take a larger -n");
    for (size_t i = 0; i < points->count && command->matrices; ++i) {
        aur_rotation rotation;
        aur_rotation_from_quaternion(copied + 4 * i, &rotation);
        memcpy(*changed + 9 * i, rotation.m, sizeof rotation.m);
    }
    points->coordinates = *changed;
    points->weights = weights;
    points->dimension = points->stride = command->matrices ? 9 : from;
    return weights != NULL && symmetry.given ? check_sum(points) : CLI_SUCCESS;
}

static int write_points(const char *set, points_command *command, const aur_points_view *points) {
    aur_error error = {0};
    const uint64_t size = command->from.options.count; /* 0: all points of a file */
    const aur_points_origin origin = {.size = sizeof origin,
                                      .set = set,
                                      .count = size != 0 ? size : command->points.first + points->count,
                                      .first = command->points.first,
                                      .scramble = command->from.options.scramble,
                                      .seed = command->from.options.seed};
    command->write.size = sizeof command->write;
    command->write.origin = &origin;
    const aur_result result =
        command->format >= FIRST_FIGURE
            ? cli_draw_points(command->path, format_name(command->format), points, &error)
            : aur_points_write(command->path, (aur_points_format)command->format, points, &command->write,
                               &error);
    return cli_status(result, &error);
}

/* A GGX lobe's visible normals reflect some directions below the horizon. */
static void warn_below(const points_command *command, const aur_points_view *view) {
    const aur_warnings warnings = command->from.options.warnings;
    const aur_lobe_kind kind = command->from.options.lobe.kind;
    if ((kind != AUR_LOBE_GGX && kind != AUR_LOBE_VISIBLE) || view->domain != AUR_DOMAIN_HEMISPHERE ||
        warnings.function == NULL)
        return;
    size_t below = 0;
    for (size_t i = 0; i < view->count; ++i)
        below += view->coordinates[3 * i + 2] < 0.0;
    char text[256];
    snprintf(text, sizeof text,
             "%zu of %zu points lie below the horizon, where reflection is 0: integrals count them as 0%s",
             below, view->count,
             kind == AUR_LOBE_GGX ? " (points of ggx are those of its visible normals, visible:ALPHA:VIEW)"
                                  : "");
    if (below > 0)
        warnings.function(warnings.user, text);
}

static int run(const cli_call *call) {
    points_command *const command = call->options;
    const char *const set = call->operands[0];
    if (!derive_options(call))
        return CLI_BAD_INPUT;
    command->from.options.size = sizeof command->from.options;
    command->from.options.warnings = cli_warnings(command->common.quiet);
    command->points.size = sizeof command->points;
    command->points.options = &command->from.options;
    command->points.dimension = command->from.dimension;
    aur_error error = {0};
    aur_points *points;
    if (aur_points_generate(set, &command->points, &points, &error) != AUR_OK)
        return cli_fail(&error);
    aur_points_view view = *aur_points_get_view(points);
    warn_below(command, &view);
    double *warped = NULL;
    int status = command->warp != NULL ? warp(command->warp, &view, &warped) : CLI_SUCCESS;
    if (status == CLI_SUCCESS && command->warp == NULL)
        status = change_points(command, &view, &warped);
    if (status == CLI_SUCCESS)
        status = write_points(set, command, &view);
    free(warped);
    aur_points_destroy(points);
    return status;
}

const cli_command cli_command_points = {
    .name = "points",
    .summary =
        "write points of a set on the square, cube, disk, hemisphere or sphere, as axes or as rotations",
    .too_few = "a set is missing: 'aureole sets' lists them",
    .operands = {{"SET", "NAME[:key=value,...] or file:PATH; 'aureole sets' lists them", .content = "set"}},
    .groups = {{options, 0},
               {cli_points_options, offsetof(points_command, from)},
               {cli_cap_option, offsetof(points_command, from)},
               {cli_dimension_option, offsetof(points_command, from)},
               {cli_quiet_option, offsetof(points_command, common)},
               {cli_cache_option, offsetof(points_command, common)}},
    .size = sizeof(points_command),
    .run = run,
};
