/* A map of irradiance at sensors. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "program/cli/lighting/irradiance.h"
#include "program/report/contours.h"

enum { SIDE = 480 }; /* size of the map in pixels */

/* The sensors' positions along one coordinate. */
typedef struct spread {
    double low, high;
    double step; /* smallest distance of different positions; 0: all are equal */
} spread;

static int ascending(const void *a, const void *b) {
    const double p = *(const double *)a, q = *(const double *)b;
    return (p > q) - (p < q);
}

/* `scratch` holds a number for each sensor. Positions that differ by less than a millionth of the extent are
 * equal. */
static spread measure(const aur_sensors_view *sensors, size_t axis, double *scratch) {
    for (size_t i = 0; i < sensors->count; ++i)
        scratch[i] = sensors->positions[3 * i + axis];
    qsort(scratch, sensors->count, sizeof *scratch, ascending);
    spread s = {scratch[0], scratch[sensors->count - 1], 0.0};
    for (size_t i = 1; i < sensors->count; ++i) {
        const double gap = scratch[i] - scratch[i - 1];
        if (gap > 1e-6 * (s.high - s.low) && !(s.step > 0.0 && s.step <= gap))
            s.step = gap;
    }
    return s;
}

/* Whether the bounding rectangle has few enough cells per sensor to draw a grid; then sets the size of a
 * cell. */
static bool find_cells(size_t count, const spread *x, const spread *y, double cell[2]) {
    const double step = fmax(x->step, y->step);
    cell[0] = x->step > 0.0 ? x->step : step;
    cell[1] = y->step > 0.0 ? y->step : step;
    if (!(step > 0.0))
        return false;
    return ((x->high - x->low) / cell[0] + 1.0) * ((y->high - y->low) / cell[1] + 1.0) <= 4.0 * (double)count;
}

/* The cells of a grid, and values at their centers: NaN without a sensor. */
static bool take_cells(const spread spreads[2], size_t count, const report_point *points,
                       report_contours *lines, double **values) {
    const size_t across = (size_t)floor((spreads[0].high - spreads[0].low) / lines->step[0] + 1.5);
    const size_t up = (size_t)floor((spreads[1].high - spreads[1].low) / lines->step[1] + 1.5);
    double *const values_of_cells = malloc(across * up * sizeof *values_of_cells);
    for (size_t i = 0; i < across * up && values_of_cells != NULL; ++i)
        values_of_cells[i] = NAN;
    for (size_t i = 0; i < count && values_of_cells != NULL; ++i) {
        const size_t x = (size_t)floor((points[i].x - spreads[0].low) / lines->step[0] + 0.5);
        const size_t y = (size_t)floor((points[i].y - spreads[1].low) / lines->step[1] + 0.5);
        values_of_cells[y * across + x] = points[i].value;
    }
    lines->across = across;
    lines->up = up;
    lines->values = *values = values_of_cells;
    return values_of_cells != NULL;
}

/* The axis along which the sensors spread least, the viewing direction of the map. */
static size_t find_view(const aur_sensors_view *sensors, double *scratch, spread spreads[3]) {
    size_t along = 2;
    for (size_t a = 3; a-- > 0;) {
        spreads[a] = measure(sensors, a, scratch);
        if (spreads[a].high - spreads[a].low < spreads[along].high - spreads[along].low)
            along = a;
    }
    return along;
}

/* The sensors as points of the map; returns the largest value. */
static double take_points(const aur_sensors_view *sensors, const aur_irradiance *results,
                          const size_t axes[2], report_point *points) {
    double most = 0.0;
    for (size_t i = 0; i < sensors->count; ++i) {
        points[i] = (report_point){.x = sensors->positions[3 * i + axes[0]],
                                   .y = sensors->positions[3 * i + axes[1]],
                                   .value = results[i].value[AUR_IRRADIANCE_TOTAL][3],
                                   .size = fmin(fmax(0.3 * SIDE / sqrt((double)sensors->count), 1.0), 6.0)};
        most = fmax(most, points[i].value);
    }
    return most > 0.0 ? most : 1.0;
}

static aur_result draw(const char *path, const char *unit, const aur_sensors_view *sensors,
                       const aur_irradiance *results, double *scratch, report_point *points,
                       aur_error *error) {
    static const char *const names[] = {"x", "y", "z"};
    static const size_t seen[3][2] = {{1, 2}, {0, 2}, {0, 1}}; /* along x, y, z */
    report_figure figure = {.width = SIDE + 80, .height = SIDE, .columns = 1, .panel_count = 1};
    spread spreads[3];
    const size_t *const axes = seen[find_view(sensors, scratch, spreads)];
    const spread ground[2] = {spreads[axes[0]], spreads[axes[1]]};
    report_contours lines = {.low = {ground[0].low, ground[1].low}};
    double *values = NULL;
    report_series series[2] = {{.ink = REPORT_INK_SCALE, .count = sensors->count, .points = points},
                               {.ink = REPORT_INK_TEXT, .parts = REPORT_SEGMENTS}};
    const bool gridded = find_cells(sensors->count, &ground[0], &ground[1], series[0].cell);
    series[0].parts = gridded ? REPORT_CELLS : REPORT_DOTS;
    figure.scale.high = take_points(sensors, results, axes, points);
    memcpy(lines.step, series[0].cell, sizeof lines.step);
    aur_result result = report_false_color(8, figure.scale.stops, error);
    if (result == AUR_OK && gridded &&
        (!take_cells(ground, sensors->count, points, &lines, &values) ||
         !report_find_contours(figure.scale.high, SIDE, &lines)))
        result = aur_fail(error, AUR_ERROR_MEMORY, "out of memory for the contours");
    series[1].count = lines.count;
    series[1].points = lines.segments;
    const report_panel panel = {.x = {.label = names[axes[0]]},
                                .y = {.label = names[axes[1]]},
                                .equal = true,
                                .series_count = lines.count > 0 ? 2 : 1,
                                .series = series};
    figure.panels = &panel;
    figure.scale.label = unit != NULL ? unit : "luminance";
    figure.scale.stop_count = 8;
    if (result == AUR_OK)
        result = report_figure_save(path, report_figure_format_of(path), &figure, error);
    free(values);
    free(lines.segments);
    return result;
}

aur_result cli_irradiance_plot(const char *path, const char *unit, const aur_sensors_view *sensors,
                               const aur_irradiance *results, aur_error *error) {
    double *const scratch = malloc(sensors->count * sizeof *scratch);
    report_point *const points = malloc(sensors->count * sizeof *points);
    const aur_result result = scratch == NULL || points == NULL
                                  ? aur_fail(error, AUR_ERROR_MEMORY, "out of memory for the map")
                                  : draw(path, unit, sensors, results, scratch, points, error);
    free(points);
    free(scratch);
    return result;
}
