#include <aureole/estimate.h>
#include <math.h>
#include <stdlib.h>

#include "points/base/array.h"
#include "points/base/error.h"
#include "points/base/parallel.h"
#include "points/base/random.h"
#include "points/quadrature/estimate/levels.h"

/* Points of a randomisation on the first level; points after which a constant functional ends the estimate.
 */
enum { MOST_REPLICATES = 64, MOST_VALUES = 4096, FIRST = 128, CONSTANT = 65536 };

static aur_result check(const aur_estimate_options *o, aur_error *error) {
    if (o->dimension < 1)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "points must have 1 dimension or more, not 0");
    if (o->values < 1 || o->values > MOST_VALUES)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "the functional must have 1 to %d values, not %zu",
                        MOST_VALUES, o->values);
    if (!(o->absolute >= 0.0 && o->relative >= 0.0))
        return aur_fail(error, AUR_ERROR_ARGUMENT, "target errors must be 0 or more, not %g and %g",
                        o->absolute, o->relative);
    if (!(o->confidence > 0.0 && o->confidence < 1.0))
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "the confidence must be between 0 and 1 (exclusive), not %g", o->confidence);
    if (o->replicates < 4 || o->replicates > MOST_REPLICATES)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "the replicates must be 4 to %d, not %zu", MOST_REPLICATES,
                        o->replicates);
    if (o->evaluations / o->replicates < 1 || o->evaluations / o->replicates < o->first)
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "%zu replicates of %zu points, at least 1 each, do not fit into %llu evaluations",
                        o->replicates, o->first, (unsigned long long)o->evaluations);
    return AUR_OK;
}

/* The state of an estimate. */
typedef struct work {
    const aur_estimate_options *options;
    aur_functional functional;
    void *user;
    aur_levels levels;
    double *values; /* of one level: replicates * options->values */
    double *points, *weights;
    size_t capacity; /* doubles of the points */
    aur_estimate_report report;
} work;

static aur_result generate(const work *w, size_t count, size_t replicate, aur_error *error) {
    const aur_estimate_options *const o = w->options;
    const char *const set = o->set != NULL ? o->set : "sobol";
    const aur_pointset_options plain = {.size = sizeof plain, .count = count, .dimension = o->dimension};
    aur_pointset_options options = plain;
    options.seed = aur_hash4(o->seed, 0x65737469, w->report.levels, replicate);
    options.scramble = AUR_SCRAMBLE_OWEN;
    aur_pointset *generator = NULL;
    aur_result result = aur_pointset_create(set, &options, &generator, error);
    if (result == AUR_ERROR_UNSUPPORTED) {
        options.scramble = AUR_SCRAMBLE_SHIFT;
        result = aur_pointset_create(set, &options, &generator, error);
    }
    if (result == AUR_OK)
        result = aur_pointset_points(generator, 0, count, count * o->dimension, w->points, error);
    aur_pointset_destroy(generator);
    return result;
}

static aur_result reserve(work *w, size_t count, aur_error *error) {
    size_t needed;
    if (!aur_size_product(count, w->options->dimension + 1, &needed) ||
        !aur_array_reserve(&w->points, &w->capacity, needed, sizeof *w->points))
        return aur_fail_memory(error);
    w->weights = w->points + count * w->options->dimension;
    return AUR_OK;
}

static aur_result evaluate_level(work *w, size_t count, aur_error *error) {
    const aur_estimate_options *const o = w->options;
    aur_result result = reserve(w, count, error);
    for (size_t r = 0; r < o->replicates && result == AUR_OK; ++r) {
        double *const values = w->values + r * o->values;
        result = generate(w, count, r, error);
        if (result != AUR_OK)
            return result;
        for (size_t i = 0; i < count; ++i)
            w->weights[i] = 1.0 / (double)count;
        const aur_estimate_points points = {r, w->report.levels, count, o->dimension, w->points, w->weights};
        result = w->functional(w->user, &points, values, error);
        for (size_t v = 0; v < o->values && result == AUR_OK; ++v)
            if (!isfinite(values[v]))
                result = aur_fail(error, AUR_ERROR_ARGUMENT,
                                  "value %zu of the functional is %g in randomisation %zu", v, values[v], r);
        w->report.evaluations += count;
        if (result == AUR_OK &&
            aur_progress_stops(&o->progress, "estimating", w->report.evaluations, o->evaluations))
            result = aur_fail(error, AUR_ERROR_CANCELLED, "estimating: cancelled");
    }
    if (result != AUR_OK)
        return result;
    aur_levels_add(&w->levels, count, w->values);
    ++w->report.levels;
    return AUR_OK;
}

static int ascending(const void *left, const void *right) {
    const double a = *(const double *)left, b = *(const double *)right;
    return (a > b) - (a < b);
}

/* The effect of one more point, estimated from replicates: the smallest step between their values if at most
 * half of them are distinct, as with counts of points of a stratified set. 0: they are distinct; infinite:
 * all are equal up to rounding, which gives no information. */
static double step_between(const work *w, size_t value) {
    const size_t count = w->options->replicates;
    double sorted[MOST_REPLICATES];
    for (size_t r = 0; r < count; ++r)
        sorted[r] = w->levels.sums[r * w->options->values + value] / w->levels.weight;
    qsort(sorted, count, sizeof *sorted, ascending);
    const double rounding = 1e-13 * fmax(fabs(sorted[0]), fabs(sorted[count - 1]));
    size_t distinct = 1;
    double least = INFINITY;
    for (size_t r = 1; r < count; ++r)
        if (sorted[r] - sorted[r - 1] > rounding) {
            ++distinct;
            least = fmin(least, sorted[r] - sorted[r - 1]);
        }
    return distinct > count / 2 ? 0.0 : least;
}

/* If all R replicates have the same count, the probability that one has one more is, at alpha/2, below about
 * ln(2/alpha)/R: the uncertainty of the mean is that fraction of the step. */
static aur_estimated estimated(const work *w, size_t value) {
    const aur_moments moments = aur_levels_moments(&w->levels, value);
    const aur_estimate_options *const o = w->options;
    const double alpha = 1.0 - o->confidence, step = step_between(w, value);
    const double floor = step > 0.0 ? log(2.0 / alpha) * step / (double)o->replicates : 0.0;
    const double quantile = aur_student_quantile(o->replicates - 1, 1.0 - 0.5 * alpha);
    const double error = aur_moments_standard_error(&moments);
    return (aur_estimated){moments.mean, hypot(error, floor / quantile), hypot(quantile * error, floor)};
}

static aur_result estimate(work *w, aur_error *error) {
    const aur_estimate_options *const o = w->options;
    const bool to_error = o->absolute > 0.0 || o->relative > 0.0;
    const uint64_t most = o->evaluations / o->replicates; /* of one replicate */
    uint64_t used = 0;
    uint64_t first = o->first > 0 ? o->first : FIRST;
    while (o->first == 0 && first > 1 && 3 * first > most) /* no room for two levels */
        first /= 2;
    for (uint64_t count = to_error ? first : most; used + count <= most; count *= 2) {
        const aur_result result = evaluate_level(w, (size_t)count, error);
        if (result != AUR_OK)
            return result;
        used += count;
        const aur_estimated found = estimated(w, 0);
        w->report.constant = isinf(found.half_width);
        w->report.reached = to_error && w->report.levels > 1 &&
                            found.half_width <= fmax(o->absolute, o->relative * fabs(found.value));
        if (w->report.reached || (w->report.constant && w->report.evaluations >= CONSTANT))
            break;
    }
    w->report.resolution = 3.0 / (double)w->report.evaluations;
    if (w->report.constant)
        aur_warn_at(&o->warnings, (aur_location){0},
                    "the functional has one value for all %zu randomisations: what a point of %llu has not "
                    "hit is not known",
                    o->replicates, (unsigned long long)w->report.evaluations);
    else if (to_error && !w->report.reached)
        aur_warn_at(&o->warnings, (aur_location){0},
                    "the target was not reached: the half width is %.3g after %llu points",
                    estimated(w, 0).half_width, (unsigned long long)w->report.evaluations);
    return AUR_OK;
}

aur_result aur_estimate(aur_functional functional, void *user, const aur_estimate_options *options,
                        aur_estimated *results, aur_estimate_report *report, aur_error *error) {
    aur_estimate_options copy = {.size = sizeof copy};
    aur_estimate_options_init(0, 0, &copy, NULL);
    aur_result result = aur_options_read(options, sizeof copy, &copy, "aur_estimate_options", error);
    if (result == AUR_OK)
        result = check(&copy, error);
    if (result != AUR_OK)
        return result;
    const size_t count = copy.replicates * copy.values;
    work w = {.options = &copy, .functional = functional, .user = user, .report = {.size = sizeof w.report}};
    w.values = calloc(2 * count, sizeof *w.values);
    if (w.values == NULL)
        return aur_fail_memory(error);
    w.levels = (aur_levels){.replicates = copy.replicates, .values = copy.values, .sums = w.values + count};
    result = estimate(&w, error);
    for (size_t v = 0; v < copy.values && result == AUR_OK; ++v)
        results[v] = estimated(&w, v);
    free(w.values);
    free(w.points);
    return result == AUR_OK && report != NULL
               ? aur_description_write(&w.report, sizeof w.report, report, "aur_estimate_report", error)
               : result;
}

aur_result aur_estimate_options_init(size_t dimension, size_t values, aur_estimate_options *options,
                                     aur_error *error) {
    static const aur_estimate_options defaults = {.size = sizeof defaults,
                                                  .relative = 0.01,
                                                  .confidence = 0.95,
                                                  .replicates = 16,
                                                  .evaluations = UINT64_C(1) << 20};
    const aur_result result =
        aur_description_write(&defaults, sizeof defaults, options, "aur_estimate_options", error);
    if (result == AUR_OK) {
        options->dimension = dimension;
        options->values = values;
    }
    return result;
}
