/* A grid of 64 points that doubles and quadruples and preserves its points, compared with a spherical
 * Fibonacci grid (Marques 2019, figs 1 and 8). */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "program/lab/lab.h"
#include "program/lab/points.h"

enum { BASE = 64, SIDE = 420 };

#define GRID "esfg:base=64,levels=2,first-shift=paper"

typedef struct shown {
    const char *set;
    size_t size;
    const char *figure;
} shown;

static const shown grids[] = {{GRID, 64, "1a"},
                              {GRID, 128, "8"},
                              {GRID, 256, "1b"},
                              {GRID, 1024, "1c"},
                              {"spherical-fibonacci", 1024, "1d"}};
enum { GRIDS = sizeof grids / sizeof grids[0] };

static const char *const columns[] = {"figure",
                                      "set",
                                      "points",
                                      "contained",
                                      "scd",
                                      "scd_n34",
                                      "min_distance_root_n",
                                      "voronoi_deviation",
                                      "voronoi_most",
                                      NULL};
static const char *const of_points[] = {"figure", "points", "level", "u", "v", "right", "up", NULL};

/* The quadrupling step that added a point: 0 for the first 64, 1 for those up to 256. */
static size_t level_of(size_t point) {
    size_t level = 0;
    for (size_t size = BASE; point >= size; size *= 4)
        ++level;
    return level;
}

typedef struct drawing {
    aur_image *plane, *sphere;
    report_table *table;
} drawing;

/* The sphere is viewed from 30 degrees above its equator, so that a pole is visible; points behind it are
 * omitted. */
static void draw(const drawing *on, const shown *grid, const aur_points_view *points) {
    static const double up[] = {0.5, 0.86602540378443865};
    static const float disk[] = {0.86f, 0.87f, 0.9f};
    const double radius = 0.45 * SIDE, dot = fmin(5.0, 90.0 / sqrt((double)points->count));
    lab_dot(on->sphere, 0.5 * SIDE, 0.5 * SIDE, radius, disk);
    for (size_t i = 0; i < points->count; ++i) {
        const double *const x = points->coordinates + points->stride * i;
        const size_t level = strcmp(grid->set, GRID) == 0 ? level_of(i) : 0;
        double uv[2];
        aur_map_from_cap(AUR_MAP_LAMBERT, AUR_CAP_SPHERE, 1, x, uv, NULL);
        const bool front = up[1] * x[0] + up[0] * x[2] >= 0.0;
        const double height = up[1] * x[2] - up[0] * x[0];
        lab_dot(on->plane, uv[0] * SIDE, (1.0 - uv[1]) * SIDE, dot, lab_colour(level));
        if (front)
            lab_dot(on->sphere, 0.5 * SIDE + radius * x[1], 0.5 * SIDE - radius * height, dot,
                    lab_colour(level));
        lab_table_row(on->table, (const char *const[]){grid->figure, NULL}, 6,
                      (const double[]){(double)points->count, (double)level, uv[0], uv[1], front ? x[1] : NAN,
                                       front ? height : NAN});
    }
}

static aur_result show(lab_run *run, const shown *grid, const aur_points_view *points, report_table *table,
                       aur_error *error) {
    drawing on = {.table = table};
    char name[64];
    snprintf(name, sizeof name, "%s, %zu points",
             strcmp(grid->set, GRID) == 0 ? "E-SFG" : "spherical Fibonacci", points->count);
    aur_result result = lab_canvas(SIDE, SIDE, &on.plane, error);
    if (result == AUR_OK)
        result = lab_canvas(SIDE, SIDE, &on.sphere, error);
    if (result == AUR_OK) {
        draw(&on, grid, points);
        result = lab_image(run, &(lab_image_position){.view = "sphere", .name = name}, on.sphere, error);
    }
    if (result == AUR_OK)
        result = lab_image(run, &(lab_image_position){.view = "plane", .name = name}, on.plane, error);
    aur_image_destroy(on.plane);
    aur_image_destroy(on.sphere);
    return result;
}

/* The number of first points of a set that are bit-identical to those at another size. */
static size_t store(const aur_points_view *points, const aur_points_view *smaller) {
    size_t same = 0;
    for (size_t i = 0; i < smaller->count && i < points->count; ++i)
        same += memcmp(points->coordinates + points->stride * i, smaller->coordinates + smaller->stride * i,
                       3 * sizeof(double)) == 0;
    return same;
}

static aur_result add_row(lab_run *run, const shown *grid, const aur_points_view *points, size_t same,
                          double *uneven, aur_error *error) {
    static const char *const metrics[] = {"scd", "min-distance", "voronoi-deviation", "voronoi-max"};
    double values[4];
    aur_measure_options how = {.size = sizeof how};
    aur_measure_options_init(&how, NULL);
    how.threads = lab_run_options(run)->threads;
    for (size_t m = 0; m < 4; ++m) {
        const aur_result result = aur_measure(metrics[m], points, &how, &values[m], error);
        if (result != AUR_OK)
            return result;
    }
    const double n = (double)points->count;
    *uneven = values[0] * pow(n, 0.75);
    lab_row(run, (const char *const[]){grid->figure, grid->set, NULL}, 7,
            (const double[]){n, (double)same, values[0], *uneven, values[1] * sqrt(n), values[2], values[3]});
    return AUR_OK;
}

/* The claims of the figures' captions. */
static void judge(lab_run *run, const double uneven[GRIDS], bool all_preserved) {
    lab_claim(run, all_preserved, "every size contains the points of the previous one");
    const double doubled = uneven[1] / sqrt(uneven[0] * uneven[2]), whole = uneven[3] / uneven[4];
    lab_claim(
        run, doubled > 1.0 && doubled < 1.1,
        "fig. 8: doubled points are slightly less even than quadrupled ones (SCD N^(3/4) is %.3f times that "
        "of the sizes about it)",
        doubled);
    lab_claim(run, whole < 1.1,
              "fig. 1: 1024 points are as even as spherical Fibonacci's within 10 %% (SCD %.3f times theirs)",
              whole);
}

static aur_result run(lab_run *run, aur_error *error) {
    report_table *const table = lab_table(run, "points", of_points);
    const char *const added = lab_run_options(run)->set;
    const shown mine[] = {{added, 64, "added"}, {added, 256, "added"}, {added, 1024, "added"}};
    aur_points *generated[GRIDS] = {NULL};
    double uneven[GRIDS], unused;
    bool all_preserved = true;
    aur_result result = AUR_OK;
    for (size_t g = 0; g < GRIDS && result == AUR_OK; ++g) {
        result = lab_points_make(
            &(lab_points){.set = grids[g].set, .domain = AUR_DOMAIN_SPHERE, .size = grids[g].size},
            &generated[g], error);
        if (result != AUR_OK)
            break;
        const bool extended = g > 0 && grids[g].set == grids[g - 1].set;
        const size_t same =
            extended ? store(aur_points_get_view(generated[g]), aur_points_get_view(generated[g - 1])) : 0;
        all_preserved = all_preserved && (!extended || same == grids[g - 1].size);
        result = add_row(run, &grids[g], aur_points_get_view(generated[g]), same, &uneven[g], error);
        if (result == AUR_OK)
            result = show(run, &grids[g], aur_points_get_view(generated[g]), table, error);
    }
    if (result == AUR_OK)
        judge(run, uneven, all_preserved);
    for (size_t g = 0; g < GRIDS; ++g)
        aur_points_destroy(generated[g]);
    for (size_t g = 0; g < 3 && added != NULL && result == AUR_OK; ++g) {
        aur_points *points = NULL;
        result = lab_points_make(
            &(lab_points){.set = added, .domain = AUR_DOMAIN_SPHERE, .size = mine[g].size}, &points, error);
        if (result == AUR_OK)
            result = add_row(run, &mine[g], aur_points_get_view(points), 0, &unused, error);
        aur_points_destroy(points);
        result = lab_forgive(run, added, result, error);
    }
    return result;
}

static const report_plot plots[] = {
    {.name = "plane",
     .title = "Points on the plane by Lambert's map, by the level that added them",
     .table = "points",
     .x = "u",
     .y = "v",
     .series = "level",
     .panel = "figure,points",
     .points = true},
    {.name = "sphere",
     .title = "Points on the half of the sphere that faces us",
     .table = "points",
     .x = "right",
     .y = "up",
     .series = "level",
     .panel = "figure,points",
     .points = true},
    {.name = NULL},
};

const lab_experiment lab_marques_2019_grids = {
    .name = "marques-2019-grids",
    .reproduces = "Marques 2019, figs 1 and 8",
    .summary = "a grid of 64 points that doubles and quadruples, compared with a spherical Fibonacci grid",
    .columns = columns,
    .plots = plots,
    .seconds = 0.2,
    .quick_seconds = 0.2,
    .run = run,
};
