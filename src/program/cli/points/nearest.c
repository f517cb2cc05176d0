/* aureole nearest: the nearest points of a set or file to query points. */
#include <aureole/nearest.h>
#include <math.h>
#include <stdlib.h>

#include "program/cli/points/point_source.h"

typedef struct nearest_command {
    cli_points from;
    size_t count, neighbours;
    cli_common common;
} nearest_command;

static const cli_option options[] = {
    {CLI_INTEGER(nearest_command, count, "count", "N", 1, INFINITY, NULL, "size of POINTS, if it is a set"),
     .letter = 'n'},
    {CLI_INTEGER(nearest_command, neighbours, "neighbours", "K", 1, 1 << 20, "1",
                 "number of neighbours per query"),
     .letter = 'k'},
    {.key = {0}}};

static int print(const nearest_command *command, size_t count, const size_t *indices,
                 const double *distances) {
    report_table *const table = report_create(3, (const char *const[]){"query", "point", "distance"});
    for (size_t i = 0; i < count * command->neighbours; ++i) {
        report_integer(table, i / command->neighbours);
        report_integer(table, indices[i]);
        report_number(table, distances[i], 9);
    }
    return cli_finish(table, command->common.format);
}

static int find(const nearest_command *command, const aur_points_view *points,
                const aur_points_view *queries) {
    if (points->domain != queries->domain || points->dimension != queries->dimension)
        return cli_bad_usage("nearest: the points are on the %s and the queries on the %s: give --domain",
                             aur_domain_name(points->domain), aur_domain_name(queries->domain));
    aur_nearest_options how = {.size = sizeof how};
    aur_nearest_options_init(&how, NULL);
    how.neighbours = command->neighbours;
    how.threads = command->common.threads;
    how.progress = cli_progress(command->common.quiet);
    const size_t size = queries->count * command->neighbours;
    size_t *const indices = calloc(size, sizeof *indices);
    double *const distances = calloc(size, sizeof *distances);
    aur_error error = {.result = AUR_ERROR_MEMORY, .message = "out of memory"};
    aur_nearest *nearest = NULL;
    bool good =
        indices != NULL && distances != NULL && aur_nearest_create(points, &nearest, &error) == AUR_OK;
    good = good && aur_nearest_find(nearest, &how, queries->count, queries->coordinates, indices, distances,
                                    &error) == AUR_OK;
    const int status = good ? print(command, queries->count, indices, distances) : cli_fail(&error);
    aur_nearest_destroy(nearest);
    free(indices);
    free(distances);
    return status;
}

/* If only the coordinates of one file determine its domain, it gets the other's; the hemisphere is part of
 * the sphere. */
static void match_domains(aur_points_view *a, aur_points_view *b) {
    aur_points_view *const views[] = {a, b};
    for (size_t i = 0; i < 2; ++i) {
        const aur_domain other = views[1 - i]->domain;
        if (views[i]->domain == AUR_DOMAIN_HEMISPHERE &&
            (other == AUR_DOMAIN_SPHERE || (other == AUR_DOMAIN_AXES && views[i]->guessed)))
            views[i]->domain = other;
    }
}

static int run(const cli_call *call) {
    nearest_command *const command = call->options;
    const char *const source = call->operands[0];
    if (command->count == 0 && !cli_has_size(source))
        return cli_bad_usage("nearest: -n is missing for the set '%s' (no such file)", source);
    if (!cli_is_file(call->operands[1]))
        return cli_bad_usage("nearest: cannot read '%s': expected a file of queries", call->operands[1]);
    command->from.domain_given = cli_given(call, "domain") != NULL;
    command->from.options.warnings = cli_warnings(command->common.quiet);
    aur_points *points = NULL, *queries = NULL;
    aur_points_view point_view, query_view;
    aur_error error;
    aur_result result = cli_load_points(call->operands[1], &command->from, 0, &queries, &query_view, &error);
    /* The queries determine the domain of a set unless it is given. */
    if (result == AUR_OK && !command->from.domain_given && !cli_is_file(source)) {
        command->from.options.domain =
            query_view.domain == AUR_DOMAIN_HEMISPHERE ? AUR_DOMAIN_SPHERE : query_view.domain;
        command->from.domain_given = query_view.domain != AUR_DOMAIN_CUBE;
    }
    if (result == AUR_OK)
        result = cli_load_points(source, &command->from, command->count, &points, &point_view, &error);
    if (result == AUR_OK)
        match_domains(&point_view, &query_view);
    const int status = result == AUR_OK ? find(command, &point_view, &query_view) : cli_fail(&error);
    aur_points_destroy(points);
    aur_points_destroy(queries);
    return status;
}

const cli_command cli_command_nearest = {
    .name = "nearest",
    .summary = "find the points that are nearest to others",
    .notes = "POINTS are a set or a file, QUERIES a file of the same domain: directions, axes (--domain "
             "axes), rotations "
             "or points of the square or cube. Prints for each query the index of the nearest point, from 0, "
             "and the "
             "angle between them in radians (on the square and cube the distance).",
    .too_few = "expected points and a file of queries: try 'aureole help nearest'",
    .operands = {{"POINTS", "a set or a file", .content = "file or set"},
                 {"QUERIES", "a file", .content = "file"}},
    .groups = {{options, 0},
               {cli_points_options, offsetof(nearest_command, from)},
               {cli_format_option, offsetof(nearest_command, common)},
               {cli_threads_option, offsetof(nearest_command, common)},
               {cli_quiet_option, offsetof(nearest_command, common)},
               {cli_cache_option, offsetof(nearest_command, common)}},
    .size = sizeof(nearest_command),
    .run = run,
};
