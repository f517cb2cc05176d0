/* aureole voronoi: the Voronoi cells of a set or file of points, with areas and vertices. */
#include <aureole/quality.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "program/cli/points/point_source.h"

typedef struct voronoi_command {
    cli_points from;
    size_t count;
    const char *cells; /* a file, or NULL */
    cli_common common;
} voronoi_command;

static const double pi = 3.14159265358979323846;

static const cli_option options[] = {
    {CLI_INTEGER(voronoi_command, count, "count", "N", 1, INFINITY, NULL, "size of POINTS, if it is a set"),
     .letter = 'n'},
    {CLI_TEXT(voronoi_command, cells, "cells", "FILE", NULL,
              "write the corners of the cells: .obj and .ply as polygons, .csv as rows of point, x, y, z"),
     .content = "file", .writes = true},
    {.key = {0}}};

/* Writes a row per vertex: the index of its point, x, y, z. */
typedef struct corners {
    size_t count;
    const double *rows;
} corners;

static void write_csv(corners c, FILE *stream) {
    fputs("point,x,y,z\n", stream);
    for (size_t i = 0; i < c.count; ++i) {
        const double *const row = c.rows + 4 * i;
        fprintf(stream, "%.0f,%.17g,%.17g,%.17g\n", row[0], row[1], row[2], row[3]);
    }
}

/* One past the last vertex of the cell that begins with vertex `first`. */
static size_t end_of_cell(corners c, size_t first) {
    size_t end = first + 1;
    while (end < c.count && c.rows[4 * end] == c.rows[4 * first])
        ++end;
    return end;
}

/* Writes a line per vertex, then a line per cell. */
static void write_polygons(corners c, const char *corner_mark, size_t first_index, bool with_size,
                           FILE *stream) {
    for (size_t i = 0; i < c.count; ++i) {
        const double *const row = c.rows + 4 * i;
        fprintf(stream, "%s%.17g %.17g %.17g\n", corner_mark, row[1], row[2], row[3]);
    }
    for (size_t i = 0, end; i < c.count; i = end) {
        end = end_of_cell(c, i);
        if (with_size)
            fprintf(stream, "%zu", end - i);
        else
            fputc('f', stream);
        for (size_t k = i; k < end; ++k)
            fprintf(stream, " %zu", k + first_index);
        fputc('\n', stream);
    }
}

static void write_obj(corners c, FILE *stream) {
    write_polygons(c, "v ", 1, false, stream);
}

static void write_ply(corners c, FILE *stream) {
    size_t cells = 0;
    for (size_t i = 0; i < c.count; i = end_of_cell(c, i))
        ++cells;
    fprintf(
        stream,
        "ply\nformat ascii 1.0\nelement vertex %zu\nproperty double x\nproperty double y\nproperty double "
        "z\nelement face %zu\nproperty list uint uint vertex_indices\nend_header\n",
        c.count, cells);
    write_polygons(c, "", 0, true, stream);
}

typedef struct cell_format {
    const char *ending;
    void (*write)(corners c, FILE *stream);
} cell_format;

/* The format by the path's extension; NULL if unknown. */
static const cell_format *find_format(const char *path) {
    static const cell_format formats[] = {{".csv", write_csv}, {".obj", write_obj}, {".ply", write_ply}};
    const char *const dot = strrchr(path, '.');
    for (size_t i = 0; i < sizeof formats / sizeof formats[0] && dot != NULL; ++i)
        if (strcmp(formats[i].ending, dot) == 0)
            return &formats[i];
    return NULL;
}

static aur_result write_cells(const char *path, const aur_points_view *points, const aur_measure_options *how,
                              aur_error *error) {
    aur_series *series;
    aur_result result = aur_measure_series("voronoi-cells", points, how, &series, error);
    if (result != AUR_OK)
        return result;
    char *text = NULL;
    size_t size = 0;
    FILE *const stream = open_memstream(&text, &size);
    if (stream != NULL)
        find_format(path)->write((corners){aur_series_row_count(series), aur_series_values(series)}, stream);
    const bool written = stream != NULL && !ferror(stream);
    const bool whole = stream != NULL && fclose(stream) == 0 && written;
    result =
        whole ? aur_file_write(path, size, text, error) : aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    free(text);
    aur_series_destroy(series);
    return result;
}

/* Writes the area and the number of sides of each point's cell, with the point. */
static report_table *tabulate(const aur_points_view *points, double cap_degrees, const aur_series *series) {
    static const char *const columns[] = {"point", "x", "y", "z", "area", "steradians", "radius", "sides"};
    const double whole = points->domain == AUR_DOMAIN_SPHERE ? 180.0 : 90.0;
    const double half = 0.5 * (cap_degrees > 0.0 ? cap_degrees : whole) * (pi / 180.0);
    const double mean = 4.0 * pi * sin(half) * sin(half) / (double)points->count;
    report_table *const table = report_create(8, columns);
    for (size_t i = 0; i < points->count; ++i) {
        const double *const row = aur_series_values(series) + 4 * i;
        report_integer(table, i + 1);
        for (size_t d = 0; d < 3; ++d)
            report_number(table, points->coordinates[points->stride * i + d], 6);
        report_number(table, row[1], 6);
        report_number(table, row[1] * mean, 6);
        report_number(table, row[2], 6);
        report_integer(table, (uint64_t)row[3]);
    }
    return table;
}

static int find_cells(const voronoi_command *command, const aur_points_view *points, aur_error *error) {
    aur_measure_options how = {.size = sizeof how};
    aur_measure_options_init(&how, NULL);
    how.cap_degrees = command->from.options.cap_degrees;
    how.threads = command->common.threads;
    static const cli_phase phases[] = {
        {"cutting cells", 1.0}, {"cutting cells", 1.0}, {"cutting cells", 1.0}};
    how.progress = cli_progress(command->common.quiet);
    cli_progress_plan(command->cells != NULL ? 3 : 1,
                      phases); /* the vertices are computed twice, first to count them */
    how.warnings = cli_warnings(command->common.quiet);
    aur_series *series;
    aur_result result = aur_measure_series("voronoi", points, &how, &series, error);
    if (result == AUR_OK && command->cells != NULL)
        result = write_cells(command->cells, points, &how, error);
    const int status = result == AUR_OK
                           ? cli_finish(tabulate(points, how.cap_degrees, series), command->common.format)
                           : cli_fail(error);
    aur_series_destroy(series);
    return status;
}

static int run(const cli_call *call) {
    voronoi_command *const command = call->options;
    const char *const source = call->operands[0];
    if (command->count == 0 && !cli_has_size(source))
        return cli_bad_usage("voronoi: -n is missing for the set '%s' (no such file)", source);
    if (command->cells != NULL && find_format(command->cells) == NULL)
        return cli_bad_usage("--cells: '%s' ends in none of .csv, .obj, .ply", command->cells);
    if (command->cells != NULL && command->from.options.cap_degrees > 0.0)
        return cli_bad_usage("--cells cannot be used with --cap: cells at the rim are not polygons");
    command->from.domain_given = cli_given(call, "domain") != NULL;
    if (!command->from.domain_given && !cli_is_file(source))
        command->from.options.domain =
            cli_given(call, "lobe") != NULL ? AUR_DOMAIN_HEMISPHERE : AUR_DOMAIN_SPHERE;
    command->from.options.warnings = cli_warnings(command->common.quiet);
    aur_points *points = NULL;
    aur_points_view view;
    aur_error error;
    const aur_result result = cli_load_points(source, &command->from, command->count, &points, &view, &error);
    const int status = result == AUR_OK ? find_cells(command, &view, &error) : cli_fail(&error);
    aur_points_destroy(points);
    return status;
}

const cli_command cli_command_voronoi = {
    .name = "voronoi",
    .summary = "compute the Voronoi cells of points: areas and corners",
    .notes = "POINTS are a set or a file on the sphere (the default of sets), the hemisphere (cells end at "
             "the equator), a --cap (cells end at its rim), or axes. Prints for each point the area of its "
             "cell (relative to the mean, and in steradians), the angle to its farthest corner in radians, "
             "and the number of sides. Corners are counter-clockwise as seen from outside. Coincident points "
             "divide the area of their cell.",
    .too_few = "no points given: try 'aureole help voronoi'",
    .operands = {{"POINTS", "a set or a file", .content = "file or set"}},
    .groups = {{options, 0},
               {cli_points_options, offsetof(voronoi_command, from)},
               {cli_cap_option, offsetof(voronoi_command, from)},
               {cli_format_option, offsetof(voronoi_command, common)},
               {cli_threads_option, offsetof(voronoi_command, common)},
               {cli_quiet_option, offsetof(voronoi_command, common)},
               {cli_cache_option, offsetof(voronoi_command, common)}},
    .size = sizeof(voronoi_command),
    .run = run,
};
