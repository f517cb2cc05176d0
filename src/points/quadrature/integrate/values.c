#include "points/quadrature/integrate/values.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/array.h"
#include "points/base/error.h"
#include "points/base/parallel.h"
#include "points/quadrature/integrate/shape.h"

aur_result aur_integrand_check(const aur_integrate_options *options, size_t width, size_t count,
                               const double *points, const double *values, aur_error *error) {
    for (size_t i = 0; i < count * width; ++i)
        if (!isfinite(values[i])) {
            char position[128];
            size_t length = 0;
            const size_t coordinates = aur_integrate_coordinates(options);
            for (size_t d = 0; d < coordinates && d < 4; ++d)
                length += (size_t)snprintf(position + length, sizeof position - length, "%s%.17g",
                                           d > 0 ? ", " : "", points[i / width * coordinates + d]);
            return aur_fail(error, AUR_ERROR_ARGUMENT, "the function is %g %s (%s%s)",
                            isnan(values[i]) ? NAN : values[i], /* no sign before nan */
                            aur_shape_is_directions(options) ? "in the direction" : "at the point", position,
                            coordinates > 4 ? ", ..." : "");
        }
    return AUR_OK;
}

/* Values at one call's points of a stratum, without those outside it. */
static aur_result evaluate_call(aur_integration *work, const aur_stratum *part, size_t replicate,
                                size_t first, size_t count, aur_error *error) {
    const aur_integrate_options *const o = &work->options;
    const size_t coordinates = aur_integrate_coordinates(o), values = work->values;
    double *const points = work->results, *const along = points + AUR_INTEGRAND_POINTS * coordinates;
    double *const factors = along + AUR_INTEGRAND_POINTS, *const computed = factors + AUR_INTEGRAND_POINTS;
    double *const out = part->values[replicate] + first * values;
    aur_result result =
        aur_replicates_points(part->replicates, replicate, first, count, points, along, factors, error);
    size_t inside = 0;
    for (size_t i = 0; i < count && result == AUR_OK; ++i)
        if (factors[i] != 0.0) {
            memmove(points + coordinates * inside, points + coordinates * i, coordinates * sizeof *points);
            along[inside++] = along[i];
        }
    if (result == AUR_OK && inside > 0)
        result = work->function(work->user, inside, points, o->has_axis ? along : NULL, computed, error);
    if (result == AUR_OK)
        result = aur_integrand_check(o, values, inside, points, computed, error);
    work->integral.evaluations += inside;
    for (size_t i = count; i > 0 && result == AUR_OK; --i) {
        const double factor = factors[i - 1];
        inside -= factor != 0.0;
        for (size_t v = 0; v < values; ++v)
            out[(i - 1) * values + v] = factor != 0.0 ? factor * computed[inside * values + v] : (double)NAN;
    }
    return result;
}

static aur_result reserve(const aur_integration *work, aur_stratum *part, size_t count, aur_error *error) {
    if (count <= part->capacity)
        return AUR_OK;
    for (size_t r = 0; r < work->options.replicates; ++r) {
        size_t bytes;
        double *grown = NULL;
        if (aur_size_product(count, work->values * sizeof *grown, &bytes))
            grown = realloc(part->values[r], bytes);
        if (grown == NULL)
            return aur_fail_memory(error);
        part->values[r] = grown;
    }
    double *const weights = realloc(part->weights, count * sizeof *weights);
    if (weights == NULL)
        return aur_fail_memory(error);
    part->weights = weights;
    part->capacity = count;
    return AUR_OK;
}

aur_result aur_integration_evaluate(aur_integration *work, aur_stratum *part, aur_error *error) {
    const aur_integrate_options *const o = &work->options;
    const size_t count = part->next;
    if (count == part->count)
        return AUR_OK;
    aur_result result = reserve(work, part, count, error);
    for (size_t r = 0; r < o->replicates && result == AUR_OK; ++r) {
        for (size_t at = part->count; at < count && result == AUR_OK; at += AUR_INTEGRAND_POINTS) {
            const size_t rest = count - at;
            result = evaluate_call(work, part, r, at,
                                   rest < AUR_INTEGRAND_POINTS ? rest : AUR_INTEGRAND_POINTS, error);
        }
        if (result == AUR_OK &&
            aur_progress_stops(&o->progress, "integrating", work->integral.evaluations, o->evaluations))
            result = aur_fail(error, AUR_ERROR_CANCELLED, "integrating: cancelled");
    }
    if (result == AUR_OK)
        result = aur_replicates_weights(part->replicates, count, part->weights, error);
    part->count = count;
    return result;
}
