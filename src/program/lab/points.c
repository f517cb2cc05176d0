#include "program/lab/points.h"

#include <math.h>

aur_result lab_points_make(const lab_points *points, aur_points **generated, aur_error *error) {
    aur_directions_options set = {.size = sizeof set};
    aur_directions_options_init(points->size, points->domain, &set, NULL);
    set.map = points->map;
    aur_points_request request = {.size = sizeof request};
    aur_points_request_init(&set, &request, NULL);
    request.first = points->first;
    request.count = points->count;
    return aur_points_generate(points->set, &request, generated, error);
}

aur_result lab_figure(const lab_points *points, const char *metric, size_t threads, double *value,
                      aur_error *error) {
    aur_points *generated;
    const aur_result result = lab_points_make(points, &generated, error);
    if (result != AUR_OK)
        return result;
    aur_measure_options how = {.size = sizeof how};
    aur_measure_options_init(&how, NULL);
    how.threads = threads;
    const aur_result measured = aur_measure(metric, aur_points_get_view(generated), &how, value, error);
    aur_points_destroy(generated);
    return measured;
}

const float *lab_colour(size_t index) {
    static const float colours[][3] = {{0.02f, 0.10f, 0.60f},
                                       {0.70f, 0.03f, 0.02f},
                                       {0.03f, 0.35f, 0.05f},
                                       {0.85f, 0.30f, 0.00f},
                                       {0.00f, 0.00f, 0.00f}};
    return colours[index % (sizeof colours / sizeof colours[0])];
}

aur_result lab_canvas(size_t width, size_t height, aur_image **image, aur_error *error) {
    const aur_result result = aur_image_create(width, height, 3, image, error);
    if (result != AUR_OK)
        return result;
    float *const data = aur_image_data(*image);
    for (size_t i = 0; i < 3 * width * height; ++i)
        data[i] = 1.0f;
    return AUR_OK;
}

static size_t clamped(double value, size_t most) {
    return value <= 0.0 ? 0 : value >= (double)most ? most : (size_t)value;
}

void lab_dot(aur_image *image, double x, double y, double radius, const float colour[3]) {
    const size_t width = aur_image_width(image), height = aur_image_height(image);
    const size_t right = clamped(x + radius + 2.0, width), bottom = clamped(y + radius + 2.0, height);
    float *const data = aur_image_data(image);
    for (size_t row = clamped(y - radius - 1.0, height); row < bottom; ++row)
        for (size_t column = clamped(x - radius - 1.0, width); column < right; ++column) {
            const double far = hypot((double)column + 0.5 - x, (double)row + 0.5 - y);
            const float share = (float)fmin(1.0, fmax(0.0, radius + 0.5 - far));
            float *const pixel = data + 3 * (row * width + column);
            for (size_t c = 0; c < 3; ++c)
                pixel[c] += share * (colour[c] - pixel[c]);
        }
}
