/* 512 points of four sets in the square and on the hemisphere under two maps, drawn, and each point's
 * distance to its nearest neighbour (Marques 2013, fig. 2). */
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "patterns.h"
#include "program/lab/points.h"

enum { COUNT = 512, QUICK = 128, VIEWS = 2 * MARQUES_PATTERNS, CELL = 128, MARGIN = 6 };

typedef struct view {
    const char *set, *projection;
    double least, mean, spread; /* distances to the nearest point, times the root of the count */
} view;

typedef struct sheet {
    lab_run *run;
    report_table *points;
    aur_image *drawn; /* a column per set and a row per projection, as in the paper */
    size_t count, view_count;
    view views[VIEWS];
} sheet;

static double distance_to_nearest(const aur_points_view *points, size_t index) {
    double least = DBL_MAX;
    for (size_t i = 0; i < points->count; ++i) {
        double square = 0.0;
        for (size_t d = 0; d < points->dimension; ++d) {
            const double off =
                points->coordinates[i * points->stride + d] - points->coordinates[index * points->stride + d];
            square += off * off;
        }
        if (i != index)
            least = fmin(least, square);
    }
    return sqrt(least);
}

/* The column of a set in the drawing: spherical Fibonacci on the right, then the set of --set. */
static size_t column_of(const char *set) {
    static const char *const sets[] = {"sobol", "bnot", "larcher-pillichshammer", "spherical-fibonacci"};
    size_t column = 0;
    while (column < 4 && strcmp(sets[column], set) != 0)
        ++column;
    return column;
}

/* A point in the square, or on the disk by the hemisphere's equal-area projection. */
static void draw(const sheet *s, const view *v, const aur_points_view *points) {
    const bool square = points->dimension == 2;
    const double size = CELL - 2 * MARGIN;
    const size_t row = square ? 0 : strcmp(v->projection, "concentric") == 0 ? 2 : 1;
    for (size_t i = 0; i < points->count; ++i) {
        const double *const p = points->coordinates + i * points->stride;
        const double scale = square ? 1.0 : 1.0 / sqrt(1.0 + p[2]);
        const double x = scale * p[0], y = scale * p[1];
        lab_table_row(s->points, (const char *const[]){v->set, v->projection, NULL}, 2,
                      (const double[]){x, y});
        lab_dot(s->drawn, CELL * (double)column_of(v->set) + MARGIN + size * (square ? x : 0.5 + 0.5 * x),
                CELL * (double)row + MARGIN + size * (square ? 1.0 - y : 0.5 - 0.5 * y), 1.4, lab_colour(4));
    }
}

static aur_result add_view(sheet *s, const marques_pattern *pattern, aur_domain domain, aur_error *error) {
    aur_points *generated;
    const aur_result result = marques_points(pattern, domain, s->count, 0, &generated, error);
    if (result != AUR_OK)
        return result;
    const aur_points_view points = *aur_points_get_view(generated);
    view *const v = &s->views[s->view_count++];
    *v = (view){.set = pattern->set,
                .projection = domain == AUR_DOMAIN_SQUARE ? "square" : pattern->label,
                .least = DBL_MAX};
    double squares = 0.0;
    for (size_t i = 0; i < points.count; ++i) {
        const double nearest = distance_to_nearest(&points, i) * sqrt((double)points.count);
        v->least = fmin(v->least, nearest);
        v->mean += nearest / (double)points.count;
        squares += nearest * nearest / (double)points.count;
    }
    v->spread = sqrt(fmax(0.0, squares - v->mean * v->mean)) / v->mean;
    draw(s, v, &points);
    aur_points_destroy(generated);
    lab_row(s->run, (const char *const[]){v->set, v->projection, NULL}, 4,
            (const double[]){(double)s->count, v->least, v->mean, v->spread});
    return AUR_OK;
}

static const view *find(const sheet *s, const char *set, const char *projection) {
    for (size_t i = 0; i < s->view_count; ++i)
        if (strcmp(s->views[i].set, set) == 0 && strcmp(s->views[i].projection, projection) == 0)
            return &s->views[i];
    return NULL;
}

/* Checks the paper's statements on these drawings by the distances. */
static void judge(const sheet *s) {
    static const char *const projections[] = {"square", "lambert", "concentric"};
    static const char *const even[] = {"bnot", "larcher-pillichshammer"};
    for (size_t p = 0; p < 3; ++p) {
        const view *const sobol = find(s, "sobol", projections[p]);
        for (size_t i = 0; i < 2; ++i) {
            const view *const other = find(s, even[i], projections[p]);
            lab_claim(
                s->run, other->spread < sobol->spread,
                "%s points (%s) lie more evenly than Sobol's: distances to the nearest vary by %.3f and "
                "%.3f of their mean",
                even[i], projections[p], other->spread, sobol->spread);
        }
    }
    const view *const fibonacci = find(s, "spherical-fibonacci", "-");
    size_t behind = 0, others = 0;
    for (size_t i = 0; i < s->view_count; ++i)
        if (strcmp(s->views[i].projection, "square") != 0 && &s->views[i] != fibonacci) {
            ++others;
            behind += s->views[i].least < fibonacci->least && s->views[i].spread > fibonacci->spread;
        }
    lab_claim(s->run, behind == others,
              "spherical Fibonacci points are the most uniform on the hemisphere: %zu of %zu others have a "
              "smaller least distance and a wider spread",
              behind, others);
}

static const char *const columns[] = {"set", "projection", "n", "least", "mean", "spread", NULL};

static aur_result run(lab_run *run, aur_error *error) {
    static const char *const of_points[] = {"set", "projection", "x", "y", NULL};
    const char *const more = lab_run_options(run)->set;
    sheet s = {.run = run,
               .points = lab_table(run, "points", of_points),
               .count = lab_run_options(run)->quick ? QUICK : COUNT};
    marques_pattern patterns[MARQUES_PATTERNS];
    const size_t count = marques_patterns(run, patterns);
    aur_result result = lab_canvas((more != NULL ? 5 : 4) * CELL, 3 * CELL, &s.drawn, error);
    for (size_t i = 1; i < count && patterns[i].map == AUR_MAP_LAMBERT && result == AUR_OK; ++i) {
        result = add_view(&s, &patterns[i], AUR_DOMAIN_SQUARE, error);
        /* A set of --set may consist of directions only. */
        if (result != AUR_OK && patterns[i].set == more)
            result = result == AUR_ERROR_MEMORY ? result : AUR_OK;
    }
    for (size_t i = 0; i < count && result == AUR_OK; ++i)
        result = lab_forgive(run, patterns[i].set, add_view(&s, &patterns[i], AUR_DOMAIN_HEMISPHERE, error),
                             error);
    if (result == AUR_OK)
        judge(&s);
    if (result == AUR_OK)
        result = lab_image(run, &(lab_image_position){.name = "drawing"}, s.drawn, error);
    aur_image_destroy(s.drawn);
    return result;
}

static const report_plot plots[] = {
    {.name = "points",
     .title = "Points in the square, and on the hemisphere as a disk of the same areas",
     .table = "points",
     .x = "x",
     .y = "y",
     .panel = "set,projection",
     .points = true},
    {.name = NULL},
};

const lab_experiment lab_marques_2013_fig2 = {
    .name = "marques-2013-fig2",
    .reproduces = "Marques 2013, fig. 2",
    .summary = "512 points of four sets in the square and under two maps, and their nearest distances",
    .columns = columns,
    .plots = plots,
    .seconds = 0.1,
    .quick_seconds = 0.1,
    .run = run,
};
