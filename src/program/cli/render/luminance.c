/* Luminances of images in cd/m2, and false-color maps of them with a scale. */
#include "program/cli/render/luminance.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "program/report/contours.h"

enum { LONGEST = 480, STOPS = 8 }; /* of a map, in cells */

aur_result cli_image_luminance(cli_luminance weights, aur_image **image, aur_error *error) {
    static const struct {
        double efficacy, weights[3];
    } rows[] = {{0.0, {0.0}},
                {179.0, {0.265, 0.670, 0.065}},
                {179.0, {0.2126, 0.7152, 0.0722}},
                {683.0, {0.2126, 0.7152, 0.0722}}};
    const aur_image *const from = *image;
    const size_t width = aur_image_width(from), height = aur_image_height(from),
                 count = aur_image_channel_count(from);
    size_t channels[3];
    aur_image *luminances = NULL;
    aur_result result = aur_image_color_channels(from, channels)
                            ? AUR_OK
                            : aur_fail(error, AUR_ERROR_FORMAT, "--luminance: the image has no R, G and B");
    if (result == AUR_OK)
        result = aur_image_create(width, height, 1, &luminances, error);
    if (result == AUR_OK)
        result = aur_image_name_channel(luminances, 0, "Y", error);
    const float *const values = aur_image_data(from);
    for (size_t i = 0; i < width * height && result == AUR_OK; ++i) {
        double sum = 0.0;
        for (size_t c = 0; c < 3; ++c)
            sum += rows[weights].weights[c] * (double)values[count * i + channels[c]];
        aur_image_data(luminances)[i] = (float)(rows[weights].efficacy * sum);
    }
    if (result != AUR_OK) {
        aur_image_destroy(luminances);
        return result;
    }
    aur_image_destroy(*image);
    *image = luminances;
    return AUR_OK;
}

/* Averages blocks of pixels, so that the map has at most LONGEST cells along each side. */
static size_t take_cells(const aur_image *image, size_t block, report_point *cells, double *most) {
    const size_t width = aur_image_width(image), height = aur_image_height(image);
    const float *const values = aur_image_data(image);
    size_t count = 0;
    *most = 0.0;
    for (size_t y = 0; y < height; y += block)
        for (size_t x = 0; x < width; x += block) {
            double sum = 0.0, all = 0.0;
            for (size_t j = y; j < y + block && j < height; ++j)
                for (size_t i = x; i < x + block && i < width; ++i) {
                    sum += (double)values[width * j + i];
                    all += 1.0;
                }
            cells[count] = (report_point){.x = (double)(x / block) + 0.5,
                                          .y = (double)((height - 1 - y) / block) + 0.5,
                                          .value = sum / all};
            *most = fmax(*most, cells[count++].value);
        }
    return count;
}

/* The cells are row by row from the top. */
static bool find_contours(const report_point *cells, double high, report_contours *lines) {
    double *const values = malloc(lines->across * lines->up * sizeof *values);
    for (size_t j = 0; j < lines->up && values != NULL; ++j)
        for (size_t i = 0; i < lines->across; ++i)
            values[j * lines->across + i] = cells[(lines->up - 1 - j) * lines->across + i].value;
    lines->values = values;
    const bool good = values != NULL && report_find_contours(high, LONGEST, lines);
    free(values);
    return good;
}

aur_result cli_image_map(const char *path, const aur_image *image, double scale, bool contours,
                         aur_error *error) {
    const size_t width = aur_image_width(image), height = aur_image_height(image);
    const char *const format = report_figure_format_of(path);
    if (format == NULL)
        return aur_fail(error, AUR_ERROR_NAME, "--falsecolor: '%s': .png, .svg, .pdf or .tex expected", path);
    const size_t block = ((width > height ? width : height) + LONGEST - 1) / LONGEST;
    report_point *const cells = malloc((width / block + 1) * (height / block + 1) * sizeof *cells);
    if (cells == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory for the map");
    double most = 0.0;
    const double across = ceil((double)width / (double)block), up = ceil((double)height / (double)block);
    report_series series[2] = {
        {.ink = REPORT_INK_SCALE, .parts = REPORT_CELLS, .cell = {1.0, 1.0}, .points = cells},
        {.ink = REPORT_INK_TEXT, .parts = REPORT_SEGMENTS}};
    series[0].count = take_cells(image, block, cells, &most);
    const report_panel panel = {.x = {.low = 0.0, .high = across},
                                .y = {.low = 0.0, .high = up},
                                .equal = true,
                                .border = REPORT_BORDER_FRAME,
                                .series_count = contours ? 2 : 1,
                                .series = series};
    report_figure figure = {.width = across + 30.0,
                            .height = up + 30.0,
                            .columns = 1,
                            .panel_count = 1,
                            .panels = &panel,
                            .scale = {.label = "cd/m2", .stop_count = STOPS}};
    figure.scale.high = scale > 0.0 ? scale : most > 0.0 ? most : 1.0;
    report_contours lines = {
        .across = (size_t)across, .up = (size_t)up, .low = {0.5, 0.5}, .step = {1.0, 1.0}};
    aur_result result = report_false_color(STOPS, figure.scale.stops, error);
    if (result == AUR_OK && contours && !find_contours(cells, figure.scale.high, &lines))
        result = aur_fail(error, AUR_ERROR_MEMORY, "out of memory for the contours");
    series[1].count = lines.count;
    series[1].points = lines.segments;
    if (result == AUR_OK)
        result = report_figure_save(path, format, &figure, error);
    free(lines.segments);
    free(cells);
    return result;
}
