#include "figures.h"

aur_result lab_figure(const lab_points *points, const char *metric, size_t threads, double *value,
                      aur_error *error) {
    const aur_directions_options set = aur_directions_options_default(points->size, points->domain);
    aur_points_request request = aur_points_request_default(&set);
    request.first = points->first;
    request.count = points->count;
    aur_points *made;
    const aur_result result = aur_points_generate(points->set, &request, &made, error);
    if (result != AUR_OK)
        return result;
    aur_measure_options how = aur_measure_options_default();
    how.threads = threads;
    const aur_result measured = aur_measure(metric, aur_points_look(made), &how, value, error);
    aur_points_destroy(made);
    return measured;
}
