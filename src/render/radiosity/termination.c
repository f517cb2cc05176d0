/* When to stop (Keller 1994, section 4). */
#include <inttypes.h>
#include <stdlib.h>

#include "points/base/error.h"
#include "points/base/parallel.h"
#include "render/radiosity/solution.h"

static aur_result check_rule(const aur_radiosity *radiosity, const aur_radiosity_termination *rule,
                             aur_error *error) {
    if (!(rule->epsilon > 0.0))
        return aur_fail(error, AUR_ERROR_ARGUMENT, "radiosity: epsilon must be above 0, not %g",
                        rule->epsilon);
    if (radiosity->paths % rule->interval != 0)
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "radiosity: %" PRIu64 " paths are not a multiple of the interval of %" PRIu64,
                        radiosity->paths, rule->interval);
    if (rule->limit <= radiosity->paths)
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "radiosity: the limit of %" PRIu64 " paths is not beyond the %" PRIu64
                        " that there are",
                        rule->limit, radiosity->paths);
    return AUR_OK;
}

aur_result aur_radiosity_terminate(aur_radiosity *radiosity, const aur_radiosity_termination *rule,
                                   bool *converged, aur_error *error) {
    aur_radiosity_termination r;
    aur_result result = aur_options_read(rule, sizeof r, &r, "aur_radiosity_termination", error);
    if (result != AUR_OK)
        return result;
    r.interval = r.interval != 0 ? r.interval : 1000;
    r.window = r.window != 0 ? r.window : 2;
    r.limit = r.limit != 0 ? r.limit : UINT64_C(1) << 32;
    result = check_rule(radiosity, &r, error);
    if (result != AUR_OK)
        return result;
    double(*const before)[3] = calloc(radiosity->scene.patch_count, sizeof *before);
    if (before == NULL)
        return aur_fail_memory(error);
    bool measured = radiosity->paths > 0; /* whether `before` holds a solution */
    if (measured)
        aur_radiosity_measure_change(radiosity, before);
    uint64_t quiet = 0;
    while (result == AUR_OK && quiet < r.window && radiosity->paths < r.limit) {
        const uint64_t left = r.limit - radiosity->paths;
        result =
            aur_radiosity_trace(radiosity, radiosity->paths + (left < r.interval ? left : r.interval), error);
        if (result != AUR_OK)
            break;
        const double change = aur_radiosity_measure_change(radiosity, before);
        if (measured) {
            radiosity->change = change;
            quiet = change < r.epsilon ? quiet + 1 : 0;
        }
        measured = true;
        if (aur_progress_stops(&radiosity->options.progress, "radiosity", radiosity->paths, r.limit))
            result = aur_fail(error, AUR_ERROR_CANCELLED, "cancelled");
    }
    if (converged != NULL)
        *converged = quiet >= r.window;
    free(before);
    return result;
}

aur_result aur_radiosity_termination_init(double epsilon, aur_radiosity_termination *rule, aur_error *error) {
    static const aur_radiosity_termination defaults = {.size = sizeof defaults};
    const aur_result result =
        aur_description_write(&defaults, sizeof defaults, rule, "aur_radiosity_termination", error);
    if (result == AUR_OK)
        rule->epsilon = epsilon;
    return result;
}
