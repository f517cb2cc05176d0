/* Integrals of functions with a point group by symmetric rules. */
#include <aureole/symmetry.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/error.h"
#include "points/base/parallel.h"
#include "points/base/vector.h"
#include "points/quadrature/integrate/shape.h"
#include "points/quadrature/integrate/values.h"

/* Points of the first rule; points after which a function counts as constant. */
enum { FIRST = 256, CONSTANT = 65536 };

typedef struct orbits {
    aur_integrand function;
    void *user;
    const aur_integrate_options *options;
    size_t width;
    double *values; /* of one call */
    double scale;
    bool equal; /* all values of the rule equal the first ones */
} orbits;

/* Adds a rule's values to found[width]. */
static aur_result add_rule(orbits *w, size_t count, const double *xyz, const double *weights,
                           aur_estimated *found, aur_error *error) {
    double *const first = w->values + AUR_INTEGRAND_POINTS * w->width;
    w->equal = true;
    for (size_t v = 0; v < w->width; ++v)
        found[v] = (aur_estimated){0};
    for (size_t at = 0; at < count; at += AUR_INTEGRAND_POINTS) {
        const size_t here = count - at < AUR_INTEGRAND_POINTS ? count - at : AUR_INTEGRAND_POINTS;
        aur_result result = w->function(w->user, here, xyz + 3 * at, NULL, w->values, error);
        if (result == AUR_OK)
            result = aur_integrand_check(w->options, w->width, here, xyz + 3 * at, w->values, error);
        if (result != AUR_OK)
            return result;
        if (at == 0)
            memcpy(first, w->values, w->width * sizeof *first);
        for (size_t i = 0; i < here; ++i)
            for (size_t v = 0; v < w->width; ++v) {
                found[v].value += w->scale * weights[at + i] * w->values[i * w->width + v];
                w->equal = w->equal && w->values[i * w->width + v] == first[v];
            }
    }
    return AUR_OK;
}

/* The rule of at most n points. */
static aur_result evaluate(orbits *w, size_t n, aur_estimated *found, size_t *count, aur_error *error) {
    double *const xyz = n <= SIZE_MAX / 64 ? malloc(4 * n * sizeof *xyz) : NULL;
    if (xyz == NULL)
        return aur_fail_memory(error);
    aur_result result = aur_symmetric_rule(w->options->group, n, 3 * n, xyz, xyz + 3 * n, count, error);
    if (result == AUR_OK)
        result = add_rule(w, *count, xyz, xyz + 3 * n, found, error);
    free(xyz);
    return result;
}

/* The largest change from the previous rule, and the largest value. */
static double change_of(const orbits *w, const aur_estimated *found, const double *before, double *largest) {
    double change = 0.0;
    *largest = 0.0;
    for (size_t v = 0; v < w->width; ++v) {
        change = fmax(change, fabs(found[v].value - before[v]));
        *largest = fmax(*largest, fabs(found[v].value));
    }
    return change;
}

static aur_result refine(orbits *w, double *before, aur_estimated *found, aur_integral *integral,
                         aur_error *error) {
    const aur_integrate_options *const o = w->options;
    for (size_t n = o->first > FIRST ? o->first : FIRST;; n *= 4) {
        size_t count;
        const aur_result result = evaluate(w, n, found, &count, error);
        if (result != AUR_OK)
            return result;
        integral->evaluations += count;
        double largest, change = change_of(w, found, before, &largest);
        change = integral->levels++ == 0 || w->equal ? (double)INFINITY : change;
        const bool converged = change <= fmax(o->absolute, o->relative * largest);
        const bool constant = w->equal && integral->evaluations >= CONSTANT;
        for (size_t v = 0; v < w->width; ++v) {
            before[v] = found[v].value;
            found[v].error = found[v].half_width = change;
        }
        integral->error = integral->interval = integral->difference = change;
        integral->reason = converged  ? AUR_INTEGRATE_TOLERANCE
                           : constant ? AUR_INTEGRATE_CONSTANT
                                      : AUR_INTEGRATE_EVALUATIONS;
        if (converged || constant || integral->evaluations + 4 * n > o->evaluations)
            return AUR_OK;
        if (aur_progress_stops(&o->progress, "integrating", integral->evaluations, o->evaluations))
            return aur_fail(error, AUR_ERROR_CANCELLED, "integrating: cancelled");
    }
}

aur_result aur_integrate_orbits(aur_integrand function, void *user, const aur_integrate_options *options,
                                aur_estimated *found, aur_integral *integral, aur_error *error) {
    const size_t width = options->values > 0 ? options->values : 1;
    orbits w = {.function = function,
                .user = user,
                .options = options,
                .width = width,
                .scale = options->mean ? 1.0 : 4.0 * AUR_PI};
    w.values = calloc((AUR_INTEGRAND_POINTS + 2) * width, sizeof *w.values);
    if (w.values == NULL)
        return aur_fail_memory(error);
    const aur_result result =
        refine(&w, w.values + (AUR_INTEGRAND_POINTS + 1) * width, found, integral, error);
    free(w.values);
    integral->value = found[0].value;
    integral->doubts = w.equal ? AUR_INTEGRATE_ALL_EQUAL : 0U;
    integral->resolution = 3.0 / (double)(integral->evaluations > 0 ? integral->evaluations : 1);
    integral->resolution_degrees = aur_shape_share_degrees(options, integral->resolution);
    return result;
}
