/* Samples colored by weight, in Lambert's azimuthal projection (Marques 2018 figs 3 to 5). */
#include <math.h>
#include <stdlib.h>

#include "program/cli/points/weights.h"
#include "program/report/figure.h"

/* A panel per lobe. The whole sphere extends to radius sqrt 2, as do samples below the horizon. The value is
 * N w: 1 is an equal weight. */
static void project(const cli_weights_result *result, size_t lobe, double reach, report_point *points) {
    for (size_t i = 0; i < result->count; ++i) {
        const double *const u = result->xyz + 3 * i;
        const double radius = hypot(u[0], u[1]);
        const double projected = sqrt(fmax(0.0, 1.0 - u[2])) / reach;
        const double scale = radius > 0.0 ? projected / radius : 0.0;
        points[i] = (report_point){.x = scale * u[0],
                                   .y = scale * u[1],
                                   .value = result->weights[lobe * result->count + i] * (double)result->count,
                                   .size = result->count > 512 ? 1.5 : 3.5};
    }
}

int cli_weights_plot(const cli_weights_arguments *arguments, const cli_weights_result *result) {
    enum { LOBES = 2 };
    char titles[LOBES][512];
    report_series series[LOBES];
    report_panel panels[LOBES];
    report_point *const points = malloc(result->lobe_count * result->count * sizeof *points);
    aur_error error = {.result = AUR_ERROR_MEMORY, .message = "out of memory"};
    if (points == NULL)
        return cli_fail(&error);
    double lowest = 0.0;
    for (size_t i = 0; i < result->count; ++i)
        lowest = fmin(lowest, result->xyz[3 * i + 2]);
    const double reach = sqrt(1.0 - lowest);
    const report_axis axis = {.low = -1.05, .high = 1.05};
    for (size_t k = 0; k < result->lobe_count; ++k) {
        report_point *const lobe_points = points + k * result->count;
        project(result, k, reach, lobe_points);
        snprintf(titles[k], sizeof titles[k], "%s, %zu samples, weights for %s: %s",
                 cli_is_file(arguments->source) ? "file" : arguments->source, result->count,
                 k == 0 ? arguments->lobe_text : arguments->mirror_text, arguments->method_name);
        series[k] = (report_series){
            .parts = REPORT_DOTS, .ink = REPORT_INK_SCALE, .count = result->count, .points = lobe_points};
        panels[k] = (report_panel){.title = titles[k],
                                   .x = axis,
                                   .y = axis,
                                   .equal = true,
                                   .border = REPORT_BORDER_NONE,
                                   .rings = {1.0, 1.0 / reach},
                                   .series_count = 1,
                                   .series = &series[k]};
    }
    /* Blue below an equal weight, green at it, red above, as in the paper. */
    const report_figure figure = {
        .width = 480.0,
        .height = 480.0,
        .columns = result->lobe_count,
        .panel_count = result->lobe_count,
        .panels = panels,
        .scale = {"N w", 0.0, 2.0, 5, {0x00008b, 0xadd8e6, 0x00ff00, 0xffff00, 0xff0000}}};
    const char *const path = arguments->plot;
    const int status =
        cli_status(report_figure_save(path, report_figure_format_of(path), &figure, &error), &error);
    free(points);
    return status;
}
