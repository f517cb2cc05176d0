#include <aureole/exact.h>
#include <aureole/integrate.h>
#include <aureole/statistics.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/error.h"
#include "points/base/parallel.h"
#include "points/base/random.h"
#include "points/base/vector.h"
#include "points/quadrature/integrate/replicates.h"

/* Points of the first level, and of the last whose weights are exact: what is not smooth enough to be done
 * then gains nothing by them. */
enum { FIRST = 64, EXACT_POINTS = 1024 };

static aur_result check(const aur_integrate_options *o, aur_error *error) {
    const double most = o->domain == AUR_DOMAIN_SPHERE ? 180.0 : 90.0;
    if (o->domain != AUR_DOMAIN_SPHERE && o->domain != AUR_DOMAIN_HEMISPHERE)
        return aur_fail(error, AUR_ERROR_UNSUPPORTED,
                        "integrals are over the sphere, the hemisphere and caps");
    if (!(o->cap_degrees >= 0.0 && o->cap_degrees <= most))
        return aur_fail(error, AUR_ERROR_ARGUMENT, "the cap must be between 0 and %g degrees, not %g", most,
                        o->cap_degrees);
    if (!(o->exponent >= 0.0 && o->exponent <= 1e9))
        return aur_fail(error, AUR_ERROR_ARGUMENT, "the exponent must be between 0 and 1e9, not %g",
                        o->exponent);
    if (o->exponent > 0.0 && (o->domain == AUR_DOMAIN_SPHERE || o->cap_degrees > 0.0))
        return aur_fail(error, AUR_ERROR_UNSUPPORTED, "powers of the cosine are for the whole hemisphere");
    if (o->has_axis && !(isfinite(o->axis_from) && isfinite(o->axis_to) && o->axis_from < o->axis_to))
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "the axis must go up from one finite number to another, "
                        "not from %g to %g",
                        o->axis_from, o->axis_to);
    if (!(o->absolute >= 0.0 && o->relative >= 0.0 && o->absolute + o->relative > 0.0))
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "one of the tolerances must be greater than 0, not %g and %g", o->absolute,
                        o->relative);
    if (!(o->confidence > 0.0 && o->confidence < 1.0))
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "the confidence must be between 0 and 1 (exclusive), not %g", o->confidence);
    if (o->replicates < 4 || o->replicates > AUR_REPLICATES_MAX)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "the replicates must be 4 to %d, not %zu",
                        AUR_REPLICATES_MAX, o->replicates);
    if (o->evaluations / FIRST < o->replicates)
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "%zu replicates take at least %zu evaluations; %llu are allowed", o->replicates,
                        FIRST * o->replicates, (unsigned long long)o->evaluations);
    return AUR_OK;
}

/* Steradians, times the length of the axis. */
static double measure(const aur_integrate_options *o) {
    const double height = aur_cap_height(o);
    const double length = o->has_axis ? o->axis_to - o->axis_from : 1.0;
    return length * 2.0 * AUR_PI * (o->exponent > 0.0 ? 1.0 / (o->exponent + 1.0) : height);
}

/* One integration: the values of all replicates so far, replicate after replicate. */
typedef struct integration {
    const aur_integrate_options *options;
    aur_replicates *replicates;
    aur_integrand function;
    void *user;
    size_t capacity; /* points of a replicate */
    double *values;  /* options->replicates * capacity */
    double *weights; /* capacity: of the level */
} integration;

/* Values of the points from `first` to `last` of every replicate. */
static aur_result evaluate(const integration *work, size_t first, size_t last, aur_error *error) {
    double directions[3 * AUR_INTEGRAND_POINTS], along[AUR_INTEGRAND_POINTS];
    const aur_integrate_options *const o = work->options;
    for (size_t r = 0; r < o->replicates; ++r) {
        double *const values = work->values + r * work->capacity;
        for (size_t at = first; at < last; at += AUR_INTEGRAND_POINTS) {
            const size_t rest = last - at, count = rest < AUR_INTEGRAND_POINTS ? rest : AUR_INTEGRAND_POINTS;
            aur_result result =
                aur_replicates_points(work->replicates, r, at, count, directions, along, error);
            if (result == AUR_OK)
                result = work->function(work->user, count, directions, o->has_axis ? along : NULL,
                                        values + at, error);
            if (result != AUR_OK)
                return result;
            for (size_t i = 0; i < count; ++i)
                if (!isfinite(values[at + i]))
                    return aur_fail(error, AUR_ERROR_ARGUMENT,
                                    "the function is %g in the direction (%.17g, %.17g, %.17g)",
                                    values[at + i], directions[3 * i], directions[3 * i + 1],
                                    directions[3 * i + 2]);
        }
        const uint64_t done = r * last + (o->replicates - r) * first;
        if (aur_progress_stops(&o->progress, "integrating", done, o->evaluations))
            return aur_fail(error, AUR_ERROR_CANCELLED, "integrating: cancelled");
    }
    return AUR_OK;
}

/* Weights to a degree that grids have with room to spare, or equal ones. */
static aur_result weigh(const integration *work, size_t count, aur_error *error) {
    const aur_directions *const grid = aur_replicates_grid(work->replicates);
    for (size_t i = 0; i < count; ++i)
        work->weights[i] = 1.0 / (double)count;
    if (grid == NULL || count > EXACT_POINTS)
        return AUR_OK;
    double *const xyz = malloc(3 * count * sizeof *xyz);
    if (xyz == NULL)
        return aur_fail_memory(error);
    aur_exact_options options = {.size = sizeof options};
    aur_exact_options_init(AUR_DOMAIN_SPHERE, &options, NULL);
    options.threads = 1;
    options.degree = (size_t)sqrt((double)count / 2.2) - 1;
    aur_result result = aur_directions_points(grid, 0, count, 3 * count, xyz, NULL, error);
    if (result == AUR_OK)
        result = aur_weights_exact(count, xyz, &options, count, work->weights, NULL, error);
    free(xyz);
    return result == AUR_ERROR_ARGUMENT ? AUR_OK : result; /* no positive ones: they stay equal */
}

/* The mean over the replicates and its interval. */
static void judge(const integration *work, size_t count, aur_integral *integral) {
    const aur_integrate_options *const o = work->options;
    aur_moments moments = {0};
    for (size_t r = 0; r < o->replicates; ++r) {
        double sum = 0.0;
        for (size_t i = 0; i < count; ++i)
            sum += work->weights[i] * work->values[r * work->capacity + i];
        aur_moments_add(&moments, sum);
    }
    const double scale = measure(o), value = scale * moments.mean;
    integral->difference = integral->levels > 0 ? fabs(value - integral->value) : INFINITY;
    integral->value = value;
    integral->interval = scale * aur_moments_interval(&moments, o->confidence);
    integral->error = fmax(integral->interval, 0.25 * integral->difference);
    integral->evaluations = o->replicates * count;
    ++integral->levels;
}

static aur_result integrate(integration *work, aur_integral *integral, aur_error *error) {
    const aur_integrate_options *const o = work->options;
    size_t before = 0;
    for (size_t count = FIRST;; count *= 2) {
        aur_result result = evaluate(work, before, count, error);
        if (result == AUR_OK)
            result = weigh(work, count, error);
        if (result != AUR_OK)
            return result;
        judge(work, count, integral);
        before = count;
        integral->reason = AUR_INTEGRATE_TOLERANCE;
        if (integral->error <= fmax(o->absolute, o->relative * fabs(integral->value)))
            return AUR_OK;
        integral->reason = AUR_INTEGRATE_EVALUATIONS;
        if (2 * count > work->capacity)
            return AUR_OK;
    }
}

aur_result aur_integrate(aur_integrand function, void *user, const aur_integrate_options *options,
                         aur_integral *integral, aur_error *error) {
    aur_integrate_options own = {.size = sizeof own};
    aur_integrate_options_init(AUR_DOMAIN_SPHERE, &own, NULL);
    aur_result result = aur_options_read(options, sizeof own, &own, "aur_integrate_options", error);
    if (result == AUR_OK)
        result = check(&own, error);
    if (result != AUR_OK)
        return result;
    integration work = {.options = &own, .function = function, .user = user, .capacity = FIRST};
    while (2 * work.capacity <= own.evaluations / own.replicates)
        work.capacity *= 2;
    work.values = malloc((own.replicates + 1) * work.capacity * sizeof *work.values);
    aur_integral found = {.size = sizeof found};
    if (work.values == NULL) {
        result = aur_fail_memory(error);
    } else {
        work.weights = work.values + own.replicates * work.capacity;
        result = aur_replicates_create(&own, work.capacity, &work.replicates, error);
        if (result == AUR_OK)
            result = integrate(&work, &found, error);
        aur_replicates_destroy(work.replicates);
    }
    free(work.values);
    return result == AUR_OK ? aur_description_write(&found, sizeof found, integral, "aur_integral", error)
                            : result;
}

aur_result aur_integrate_options_init(aur_domain domain, aur_integrate_options *options, aur_error *error) {
    static const aur_integrate_options defaults = {.size = sizeof defaults,
                                                   .relative = 0.01,
                                                   .confidence = 0.95,
                                                   .replicates = 8,
                                                   .evaluations = UINT64_C(1) << 22};
    const aur_result result =
        aur_description_write(&defaults, sizeof defaults, options, "aur_integrate_options", error);
    if (result == AUR_OK)
        options->domain = domain;
    return result;
}
