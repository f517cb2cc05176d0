#include "program/cli/points/point_source.h"

#include <math.h>
#include <stdlib.h>

#include "program/report/figure.h"

enum { SIDE = 400, MARGINS = 40, POINT_LIMIT = 1000000, PANELS = 2 };

/* The coordinates of a point in a panel, and its depth towards the viewer. */
typedef struct view {
    const char *title;
    bool round;
    size_t across, up; /* which coordinates */
    size_t depth;      /* which coordinate points to the viewer */
    double depth_sign; /* 0: no depth */
} view;

/* Returns the number of panels. */
static size_t choose_views(const aur_points_view *points, view views[PANELS]) {
    static const view square = {NULL, false, 0, 1, 0, 0.0}, disk = {NULL, true, 0, 1, 0, 0.0};
    static const view side = {"side", true, 0, 2, 1, -1.0}, pole = {"pole", true, 0, 1, 2, 1.0};
    /* The vector part of quaternions, in a ball. */
    static const view turned_side = {"side", true, 1, 3, 2, -1.0}, turned_pole = {"pole", true, 1, 2, 3, 1.0};
    const bool rotations = points->domain == AUR_DOMAIN_ROTATIONS;
    if (rotations || (points->domain >= AUR_DOMAIN_HEMISPHERE && points->domain != AUR_DOMAIN_DISK)) {
        views[0] = rotations ? turned_side : side;
        views[1] = rotations ? turned_pole : pole;
        return 2;
    }
    views[0] = points->domain == AUR_DOMAIN_DISK ? disk : square;
    return 1;
}

/* The points on the near or the far side of a panel. */
static size_t project(const aur_points_view *points, const view *to, bool near, report_point *projected) {
    const double radius = fmin(fmax(0.22 * (SIDE - MARGINS) / sqrt((double)points->count), 0.6), 4.0);
    size_t count = 0;
    for (size_t i = 0; i < points->count; ++i) {
        const double *const at = points->coordinates + i * points->stride;
        const bool is_near = to->depth_sign == 0.0 || at[to->depth] * to->depth_sign >= 0.0;
        const double weight = points->weights != NULL ? points->weights[i] * (double)points->count : 1.0;
        if (is_near == near)
            projected[count++] = (report_point){.x = at[to->across],
                                                .y = points->dimension == 1 ? 0.5 : at[to->up],
                                                .size = radius * fmin(sqrt(fmax(weight, 0.0)), 6.0)};
    }
    return count;
}

aur_result cli_draw_points(const char *path, const char *format, const aur_points_view *points,
                           aur_error *error) {
    view views[PANELS];
    report_series series[PANELS][2];
    report_panel panels[PANELS];
    if (points->count > POINT_LIMIT)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "a plot shows at most %d points (found %zu): use --count",
                        POINT_LIMIT, points->count);
    const size_t panel_count = choose_views(points, views);
    report_point *const projected = malloc((panel_count * points->count + 1) * sizeof *projected),
                        *next = projected;
    if (projected == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory for the image");
    for (size_t p = 0; p < panel_count; ++p) {
        const report_axis axis = {.low = views[p].round ? -1.0 : 0.0, .high = 1.0};
        for (size_t near = 0; near < 2; ++near) {
            const size_t count = project(points, &views[p], near != 0, next);
            series[p][near] = (report_series){.parts = REPORT_DOTS,
                                              .ink = near != 0 ? REPORT_INK_TEXT : REPORT_INK_PALE,
                                              .count = count,
                                              .points = next};
            next += count;
        }
        panels[p] = (report_panel){.title = views[p].title,
                                   .x = axis,
                                   .y = axis,
                                   .equal = true,
                                   .border = views[p].round ? REPORT_BORDER_NONE : REPORT_BORDER_FRAME,
                                   .rings = {views[p].round ? 1.0 : 0.0},
                                   .series_count = 2,
                                   .series = series[p]};
    }
    const report_figure figure = {
        .width = SIDE, .height = SIDE, .columns = panel_count, .panel_count = panel_count, .panels = panels};
    const aur_result result = report_figure_save(path, format, &figure, error);
    free(projected);
    return result;
}
