/* A map of what arrives at sensors. */
#include <math.h>
#include <stdlib.h>

#include "program/cli/lighting/irradiance.h"
#include "program/report/figure.h"

/* The sensors along one coordinate. */
typedef struct spread {
    double low, high;
    double step; /* the least distance of two that differ; 0: all are at one place */
} spread;

static int ascending(const void *a, const void *b) {
    const double p = *(const double *)a, q = *(const double *)b;
    return (p > q) - (p < q);
}

/* `room` holds a number for each sensor. What differs by less than a millionth of the whole is the same
 * place. */
static spread measure(const aur_sensors_view *sensors, size_t axis, double *room) {
    for (size_t i = 0; i < sensors->count; ++i)
        room[i] = sensors->positions[3 * i + axis];
    qsort(room, sensors->count, sizeof *room, ascending);
    spread s = {room[0], room[sensors->count - 1], 0.0};
    for (size_t i = 1; i < sensors->count; ++i) {
        const double gap = room[i] - room[i - 1];
        if (gap > 1e-6 * (s.high - s.low) && !(s.step > 0.0 && s.step <= gap))
            s.step = gap;
    }
    return s;
}

/* Whether so few cells fill the ground between all sensors that they are a grid; then their width and height.
 */
static bool find_cells(size_t count, const spread *x, const spread *y, double cell[2]) {
    const double step = fmax(x->step, y->step);
    cell[0] = x->step > 0.0 ? x->step : step;
    cell[1] = y->step > 0.0 ? y->step : step;
    if (!(step > 0.0))
        return false;
    return ((x->high - x->low) / cell[0] + 1.0) * ((y->high - y->low) / cell[1] + 1.0) <= 4.0 * (double)count;
}

aur_result cli_irradiance_plot(const char *path, const char *unit, const aur_sensors_view *sensors,
                               const aur_irradiance *results, aur_error *error) {
    static const char *const names[] = {"x", "y", "z"};
    static const size_t seen[3][2] = {{1, 2}, {0, 2}, {0, 1}}; /* along x, y, z */
    enum { SIDE = 480 };
    report_figure figure = {.width = SIDE + 80, .height = SIDE, .columns = 1, .panel_count = 1};
    double *const room = malloc(sensors->count * sizeof *room);
    report_point *const points = malloc(sensors->count * sizeof *points);
    aur_result result = room == NULL || points == NULL
                            ? aur_fail(error, AUR_ERROR_MEMORY, "out of memory for the map")
                            : report_false_color(8, figure.scale.stops, error);
    if (result == AUR_OK) {
        spread spreads[3];
        size_t along = 2;
        for (size_t a = 3; a-- > 0;) {
            spreads[a] = measure(sensors, a, room);
            if (spreads[a].high - spreads[a].low < spreads[along].high - spreads[along].low)
                along = a;
        }
        const size_t x = seen[along][0], y = seen[along][1];
        report_series series = {.ink = REPORT_INK_SCALE, .count = sensors->count, .points = points};
        series.parts =
            find_cells(sensors->count, &spreads[x], &spreads[y], series.cell) ? REPORT_CELLS : REPORT_DOTS;
        double most = 0.0;
        for (size_t i = 0; i < sensors->count; ++i) {
            points[i] =
                (report_point){.x = sensors->positions[3 * i + x],
                               .y = sensors->positions[3 * i + y],
                               .value = results[i].value[AUR_IRRADIANCE_TOTAL][3],
                               .size = fmin(fmax(0.3 * SIDE / sqrt((double)sensors->count), 1.0), 6.0)};
            most = fmax(most, points[i].value);
        }
        const report_panel panel = {.x = {.label = names[x]},
                                    .y = {.label = names[y]},
                                    .equal = true,
                                    .series_count = 1,
                                    .series = &series};
        figure.panels = &panel;
        figure.scale.label = unit != NULL ? unit : "luminance";
        figure.scale.high = most > 0.0 ? most : 1.0;
        figure.scale.stop_count = 8;
        result = report_figure_save(path, report_figure_format_of(path), &figure, error);
    }
    free(points);
    free(room);
    return result;
}
