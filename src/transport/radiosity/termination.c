/* When to stop (Keller 1994, section 4), and what is known of the error besides. */
#include <inttypes.h>
#include <stdlib.h>

#include "transport/radiosity/solution.h"

/* sum over the lights of L0 A: the length of the colour. */
static double light_measure(const aur_radiosity *radiosity) {
    double sum[3] = {0};
    for (size_t i = 0; i < radiosity->scene.triangle_count; ++i) {
        const aur_vector l = radiosity->scene.emission[i];
        sum[0] += (double)l.x * radiosity->scene.areas[i];
        sum[1] += (double)l.y * radiosity->scene.areas[i];
        sum[2] += (double)l.z * radiosity->scene.areas[i];
    }
    return sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
}

static double squared_length(const double v[3]) {
    return v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
}

static double patch_area(const aur_radiosity *radiosity, size_t patch) {
    return radiosity->scene.areas[aur_radiosity_triangle_of(&radiosity->scene, patch)];
}

double aur_radiosity_standard_error(const aur_radiosity *radiosity) {
    double sum = 0.0, area = 0.0;
    for (size_t i = 0; i < radiosity->scene.patch_count; ++i) {
        double error[3];
        aur_radiosity_power_error(radiosity, i, error);
        const double a = patch_area(radiosity, i);
        sum += squared_length(error) * a;
        area += a;
    }
    return sqrt(sum / area) / light_measure(radiosity);
}

/* Delta E between `before`, which becomes the powers of now, and now. */
static double measure_change(const aur_radiosity *radiosity, double (*before)[3]) {
    double sum = 0.0, area = 0.0;
    for (size_t i = 0; i < radiosity->scene.patch_count; ++i) {
        double now[3];
        aur_radiosity_power(radiosity, i, now);
        const double change[3] = {now[0] - before[i][0], now[1] - before[i][1], now[2] - before[i][2]};
        const double a = patch_area(radiosity, i);
        sum += squared_length(change) * a;
        area += a;
        for (size_t c = 0; c < 3; ++c)
            before[i][c] = now[c];
    }
    return sqrt(sum / area) / light_measure(radiosity);
}

static aur_result check_rule(const aur_radiosity *radiosity, const aur_radiosity_termination *rule,
                             aur_error *error) {
    if (!(rule->epsilon > 0.0))
        return aur_fail(error, AUR_ERROR_ARGUMENT, "radiosity: epsilon must be above 0, not %g",
                        rule->epsilon);
    if (radiosity->paths % rule->interval != 0)
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "radiosity: %" PRIu64 " paths are no multiple of the interval of %" PRIu64,
                        radiosity->paths, rule->interval);
    if (rule->limit <= radiosity->paths)
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "radiosity: the limit of %" PRIu64 " paths is not beyond the %" PRIu64
                        " that there are",
                        rule->limit, radiosity->paths);
    return AUR_OK;
}

aur_result aur_radiosity_terminate(aur_radiosity *radiosity, const aur_radiosity_termination *rule,
                                   int *converged, aur_error *error) {
    aur_radiosity_termination r = *rule;
    r.interval = r.interval != 0 ? r.interval : 1000;
    r.window = r.window != 0 ? r.window : 2;
    r.limit = r.limit != 0 ? r.limit : UINT64_C(1) << 32;
    aur_result result = check_rule(radiosity, &r, error);
    if (result != AUR_OK)
        return result;
    double(*const before)[3] = calloc(radiosity->scene.patch_count, sizeof *before);
    if (before == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "radiosity: out of memory");
    bool measured = radiosity->paths > 0; /* whether `before` holds a solution */
    if (measured)
        measure_change(radiosity, before);
    uint64_t quiet = 0;
    while (result == AUR_OK && quiet < r.window && radiosity->paths < r.limit) {
        const uint64_t left = r.limit - radiosity->paths;
        result =
            aur_radiosity_trace(radiosity, radiosity->paths + (left < r.interval ? left : r.interval), error);
        if (result != AUR_OK)
            break;
        const double change = measure_change(radiosity, before);
        if (measured) {
            radiosity->change = change;
            quiet = change < r.epsilon ? quiet + 1 : 0;
        }
        measured = true;
        const aur_progress *const progress = &radiosity->options.progress;
        if (progress->function != NULL &&
            progress->function(progress->user, "radiosity", radiosity->paths, r.limit) != 0)
            result = aur_fail(error, AUR_ERROR_CANCELLED, "cancelled");
    }
    if (converged != NULL)
        *converged = quiet >= r.window;
    free(before);
    return result;
}
