#include <aureole/integrate.h>
#include <aureole/statistics.h>
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/array.h"
#include "points/base/error.h"
#include "points/base/parallel.h"
#include "points/quadrature/integrate/evidence.h"
#include "points/quadrature/integrate/shape.h"
#include "points/quadrature/integrate/values.h"

/* Default evaluations of the first level and the minimum for a result; evaluations after which a function
 * counts as constant; the largest number of stored values, 1 GiB, and 128 MiB for the default resolution. */
static const uint64_t FIRST = 2048, FEWEST = 8192, CONSTANT = 65536, STORED = UINT64_C(1) << 27,
                      STORED_BY_DEFAULT = UINT64_C(1) << 24;

/* The default resolution: the sun, with a radius of 0.27 degrees, has 1.1e-5 of the hemisphere. */
static const double RESOLUTION = 1e-5;

static aur_result check_orbits(const aur_integrate_options *o, aur_error *error) {
    const bool whole = o->region == AUR_REGION_DOMAIN && o->domain == AUR_DOMAIN_SPHERE &&
                       (o->cap_degrees == 0.0 || o->cap_degrees == 180.0);
    if (!whole || o->has_axis || o->peak_count > 0 || o->set != NULL || o->separate ||
        !(o->absolute + o->relative > 0.0))
        return aur_fail(error, AUR_ERROR_UNSUPPORTED,
                        "a symmetry is for the whole sphere without peaks, with a tolerance above 0");
    if (o->group->order < 1 || o->group->order > AUR_POINT_GROUP_ORDER_MAX)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "a point group has between 1 and %d elements, not %zu",
                        AUR_POINT_GROUP_ORDER_MAX, o->group->order);
    return AUR_OK;
}

/* Points that sample the smallest feature with 95 % probability. The default is for callers who tell nothing
 * about the structure of the function. */
static double seen_points(const aur_integrate_options *o) {
    const bool to_target = o->absolute + o->relative > 0.0;
    if (o->resolution == 0.0 && (!to_target || o->first > 0 || o->peak_count > 0 || o->set != NULL))
        return 0.0;
    return 3.0 / (o->resolution > 0.0 ? o->resolution : RESOLUTION);
}

static aur_result check(const aur_integrate_options *o, aur_error *error) {
    const aur_result result = aur_shape_check(o, error);
    if (result != AUR_OK)
        return result;
    if (o->has_axis && !(isfinite(o->axis_from) && isfinite(o->axis_to) && o->axis_from < o->axis_to))
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "the axis must go up from one finite number to another, "
                        "not from %g to %g",
                        o->axis_from, o->axis_to);
    if (!(o->absolute >= 0.0 && o->relative >= 0.0))
        return aur_fail(error, AUR_ERROR_ARGUMENT, "the tolerances must be 0 or more, not %g and %g",
                        o->absolute, o->relative);
    if (!(o->confidence > 0.0 && o->confidence < 1.0))
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "the confidence must be between 0 and 1 (exclusive), not %g", o->confidence);
    if (o->replicates < 4 || o->replicates > AUR_REPLICATES_MAX)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "the replicates must be 4 to %d, not %zu",
                        AUR_REPLICATES_MAX, o->replicates);
    if (o->values > AUR_INTEGRATE_VALUES_MAX)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "the function must have 1 to %d values, not %zu",
                        AUR_INTEGRATE_VALUES_MAX, o->values);
    if (o->resolution != 0.0 && !(o->resolution >= 1e-12 && o->resolution <= 1.0))
        return aur_fail(error, AUR_ERROR_ARGUMENT, "the resolution must be 0 or from 1e-12 to 1, not %g",
                        o->resolution);
    if (o->resolution != 0.0 && (o->group != NULL || o->set != NULL))
        return aur_fail(error, AUR_ERROR_UNSUPPORTED,
                        "a resolution is for neither a symmetry nor a given set");
    if (o->group != NULL)
        return check_orbits(o, error);
    if (o->resolution > 0.0 && seen_points(o) > (double)o->evaluations)
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "a resolution of %g takes %.0f evaluations, and %llu are allowed", o->resolution,
                        seen_points(o), (unsigned long long)o->evaluations);
    const uint64_t least = o->first > 0 ? o->first : 2;
    if (o->evaluations / o->replicates < least)
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "%zu replicates of %llu points take more than the %llu evaluations that are allowed",
                        o->replicates, (unsigned long long)least, (unsigned long long)o->evaluations);
    if (o->set != NULL && (o->first == 0 || o->absolute + o->relative > 0.0 || o->peak_count > 0))
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "a set makes one level: it takes `first`, no tolerance and no peaks");
    return AUR_OK;
}

/* --- intervals */

/* The means of one value over each stratum and replicate, times the measures. */
static void add_up(const aur_integration *work, size_t value) {
    const size_t replicates = work->options.replicates;
    for (size_t s = 0; s < work->strata; ++s) {
        const aur_stratum *const part = &work->parts[s];
        for (size_t r = 0; r < replicates; ++r) {
            const double *const values = part->values[r] + value;
            double sum = 0.0;
            for (size_t i = 0; i < part->count; ++i) {
                const double term = values[i * work->values];
                sum += isnan(term) ? 0.0 : part->weights[i] * term;
            }
            work->means[s * replicates + r] = part->scale * sum;
        }
    }
}

/* Over the replicates, of one stratum or of all. */
static aur_moments moments_of(const aur_integration *work, size_t only) {
    const size_t replicates = work->options.replicates;
    aur_moments moments = {0};
    for (size_t r = 0; r < replicates; ++r) {
        double sum = 0.0;
        for (size_t s = 0; s < work->strata; ++s)
            sum += only == work->strata || s == only ? work->means[s * replicates + r] : 0.0;
        aur_moments_add(&moments, sum);
    }
    return moments;
}

/* The variance of a mean from that of this level and the prediction from earlier levels: replicates that
 * agree by chance would otherwise end the integration. Variances fall between n^-1 (random points) and n^-4.
 */
static double pooled(const double variance[3], size_t levels) {
    if (levels < 2 || !(variance[2] > 0.0))
        return variance[0];
    const double fall = fmin(fmax(variance[1] / variance[2], 1.0 / 16.0), 0.5);
    return fmax(variance[0], 0.5 * (variance[0] + fall * variance[1]));
}

/* A value and its interval over the replicates only; adds the strata's variances to their shares. */
static void judge_replicates(aur_integration *work, size_t value) {
    add_up(work, value);
    const aur_moments all = moments_of(work, work->strata);
    double *const variance = work->variances[value];
    variance[0] = pow(aur_moments_standard_error(&all), 2.0);
    const double error = sqrt(pooled(variance, work->integral.levels));
    work->found[value] = (aur_estimated){all.mean, error, work->quantile * error};
    for (size_t s = 0; s < work->strata; ++s) {
        const aur_moments moments = moments_of(work, s);
        work->shares[s] += pow(aur_moments_standard_error(&moments), 2.0);
    }
}

/* Collects the values of one stratum for `evidence`, beginning with a quarter that is a set by itself;
 * returns the size of the quarter. It is the set of two levels ago; for sets without levels, which may be
 * ordered along z, every fourth point. */
static size_t gather(const aur_integration *work, const aur_stratum *part, size_t value, size_t *older) {
    const bool levels = work->options.set == NULL;
    size_t count = 0;
    for (size_t round = 0; round < 2; ++round) {
        for (size_t r = 0; r < work->options.replicates; ++r)
            for (size_t i = 0; i < part->count; ++i) {
                const bool early = levels ? i < part->count / 4 : i % 4 == 0;
                const double term = part->values[r][i * work->values + value];
                if (early == (round == 0) && !isnan(term))
                    work->scratch[count++] = term;
            }
        *older = round == 0 ? count : *older;
    }
    return count;
}

/* Widens the interval by the possible effect of one more point in one replicate. If all R replicates have the
 * same count, the probability phi that one has one more is, at alpha/2, below 1 - (alpha/2)^(1/R), about
 * ln(2/alpha)/R: the uncertainty of the mean is ln(2/alpha) jump/(R n), which is included in the half width.
 */
static void widen(aur_integration *work, size_t value, size_t s, const aur_evidence *evidence) {
    const aur_stratum *const part = &work->parts[s];
    const double alpha = 1.0 - work->options.confidence;
    const double points = (double)(work->options.replicates * part->count);
    const double rounding = 8.0 * DBL_EPSILON * part->scale * evidence->magnitude;
    const double floor = log(2.0 / alpha) * part->scale * evidence->jump / points + rounding;
    aur_estimated *const found = &work->found[value];
    found->half_width = hypot(found->half_width, floor);
    found->error = hypot(found->error, floor / work->quantile);
    work->shares[s] += pow(floor / work->quantile, 2.0);
}

/* Evidence on the function in addition to the spread of replicates, over all values. */
typedef struct doubts {
    bool all_equal; /* all values of all points */
    unsigned bits;
} doubts;

/* The tolerated error of one value of the level. */
static double target_of(const aur_integration *work, size_t value) {
    const aur_integrate_options *const o = &work->options;
    double largest = fabs(work->found[value].value);
    for (size_t v = 0; v < work->values && !o->separate; ++v)
        largest = fmax(largest, fabs(work->found[v].value));
    return fmax(o->absolute, o->relative * largest);
}

/* The doubts of one stratum. They are ignored outside declared peaks if the function is small there: if the
 * unsampled fraction of the domain, with a hundred times the largest value, is negligible. */
static unsigned bits_of(const aur_integration *work, size_t value, size_t s, const aur_evidence *evidence) {
    const aur_stratum *const part = &work->parts[s];
    const double unseen = 3.0 / (double)(part->count * work->options.replicates);
    if (work->strata > 1 && 100.0 * unseen * part->scale * evidence->largest < 0.1 * target_of(work, value))
        return 0U;
    return (evidence->sparse ? AUR_INTEGRATE_SPARSE : 0U) |
           (evidence->dominated ? AUR_INTEGRATE_DOMINATED : 0U) |
           (evidence->heavy_tail ? AUR_INTEGRATE_HEAVY_TAIL : 0U);
}

static void judge_all_replicates(aur_integration *work) {
    for (size_t s = 0; s < work->strata; ++s)
        work->shares[s] = 0.0;
    for (size_t v = 0; v < work->values; ++v)
        judge_replicates(work, v);
}

/* The intervals with all evidence. */
static aur_result judge_values(aur_integration *work, doubts *doubt, aur_error *error) {
    size_t most = 0;
    for (size_t s = 0; s < work->strata; ++s)
        most = work->parts[s].count > most ? work->parts[s].count : most;
    if (!aur_array_reserve(&work->scratch, &work->scratch_capacity, 2 * most * work->options.replicates,
                           sizeof *work->scratch))
        return aur_fail_memory(error);
    bool varies = false;
    for (size_t v = 0; v < work->values; ++v) {
        bool equal = true;
        for (size_t s = 0; s < work->strata; ++s) {
            size_t older;
            const size_t count = gather(work, &work->parts[s], v, &older);
            const aur_evidence evidence = aur_evidence_of(count, older, work->scratch, work->scratch + count);
            widen(work, v, s, &evidence);
            const unsigned bits = bits_of(work, v, s, &evidence);
            work->shares[s] = bits != 0 ? INFINITY : work->shares[s]; /* this stratum must grow */
            doubt->bits |= bits;
            equal = equal && evidence.all_equal;
        }
        /* A declared peak may be constant, but 0 everywhere gives no information. */
        equal = equal && (work->options.peak_count == 0 || work->found[v].half_width == 0.0);
        work->all_equal[v] = equal;
        varies = varies || !equal;
        doubt->all_equal = doubt->all_equal || (equal && work->options.separate);
    }
    doubt->all_equal = doubt->all_equal || !varies;
    return AUR_OK;
}

/* The errors of the level, compared with the target. */
static bool compare(aur_integration *work) {
    aur_integral *const integral = &work->integral;
    bool met = true;
    const double joint = target_of(work, 0);
    integral->error = 0.0;
    for (size_t v = 0; v < work->values; ++v) {
        const aur_estimated *const found = &work->found[v];
        const double change = integral->levels > 0 ? fabs(found->value - work->before[v]) : INFINITY;
        const double value_error = fmax(found->half_width, 0.25 * change);
        met = met && value_error <= (work->options.separate ? target_of(work, v) : joint);
        integral->error = fmax(integral->error, value_error);
        if (v == 0)
            integral->difference = change;
    }
    integral->value = work->found[0].value;
    integral->interval = work->found[0].half_width;
    return work->met = met;
}

/* --- levels */

/* Whether the rest of the domain has too few points to sample the smallest feature. */
static bool lacks_points(const aur_integration *work) {
    const aur_integrate_options *const o = &work->options;
    return (double)(work->parts[o->peak_count].count * o->replicates) < seen_points(o);
}

/* Doubles the points of the relevant strata. False: it would exceed the allowed evaluations, or `most`
 * values. */
static bool choose(aur_integration *work, uint64_t most) {
    double largest = 0.0;
    uint64_t evaluations = 0, stored = 0;
    for (size_t s = 0; s < work->strata; ++s)
        largest = fmax(largest, work->shares[s]);
    for (size_t s = 0; s < work->strata; ++s) {
        aur_stratum *const part = &work->parts[s];
        const bool blind = s == work->options.peak_count && lacks_points(work);
        part->next = blind || work->shares[s] >= 0.125 * largest ? 2 * part->count : part->count;
        evaluations += (uint64_t)part->next * work->options.replicates;
        stored += (uint64_t)part->next * (work->options.replicates * work->values + 1);
        if (part->next > work->most)
            return false;
    }
    return evaluations <= work->options.evaluations && stored <= most;
}

/* All values were equal: there is no information on other values. */
static void judge_constant(aur_integration *work) {
    aur_integral *const integral = &work->integral;
    integral->doubts |= AUR_INTEGRATE_ALL_EQUAL;
    if (integral->evaluations >= CONSTANT)
        integral->reason = AUR_INTEGRATE_CONSTANT;
    for (size_t v = 0; v < work->values; ++v)
        if (work->all_equal[v])
            work->found[v].half_width = work->found[v].error = INFINITY;
    integral->interval = work->found[0].half_width;
    integral->error = INFINITY;
}

/* Whether the level is the last. */
static aur_result judge_level(aur_integration *work, bool *last, aur_error *error) {
    const aur_integrate_options *const o = &work->options;
    aur_integral *const integral = &work->integral;
    const bool to_target = o->absolute + o->relative > 0.0;
    judge_all_replicates(work);
    const bool met = compare(work);
    if (to_target && !met && choose(work, STORED))
        return AUR_OK;
    doubts doubt = {0};
    const aur_result result = judge_values(work, &doubt, error);
    if (result != AUR_OK)
        return result;
    const bool lacks = lacks_points(work);
    integral->doubts = doubt.bits | (lacks ? AUR_INTEGRATE_UNRESOLVED : 0U);
    const uint64_t fewest = doubt.all_equal ? CONSTANT : o->first > 0 ? 0 : FEWEST;
    const bool enough = integral->evaluations >= fewest && !lacks;
    const bool reached = met && to_target && doubt.bits == 0 && compare(work) && !doubt.all_equal;
    const bool done = reached && enough, by_default = reached && o->resolution == 0.0;
    *last = done || !to_target || (doubt.all_equal && enough) ||
            !choose(work, by_default ? STORED_BY_DEFAULT : STORED);
    integral->reason = done ? AUR_INTEGRATE_TOLERANCE : AUR_INTEGRATE_EVALUATIONS;
    compare(work);
    if (*last && doubt.all_equal)
        judge_constant(work);
    return AUR_OK;
}

static aur_result integrate(aur_integration *work, aur_error *error) {
    for (bool last = false; !last;) {
        aur_result result = AUR_OK;
        for (size_t s = 0; s < work->strata && result == AUR_OK; ++s)
            result = aur_integration_evaluate(work, &work->parts[s], error);
        if (result == AUR_OK)
            result = judge_level(work, &last, error);
        if (result != AUR_OK)
            return result;
        ++work->integral.levels;
        for (size_t v = 0; v < work->values; ++v) {
            work->before[v] = work->found[v].value;
            memmove(work->variances[v] + 1, work->variances[v], 2 * sizeof **work->variances);
        }
    }
    const aur_stratum *const rest = &work->parts[work->options.peak_count];
    work->integral.resolution = 3.0 / (double)(rest->count * work->options.replicates);
    work->integral.resolution_degrees = aur_shape_share_degrees(&work->options, work->integral.resolution);
    return AUR_OK;
}

static size_t power_of_two(uint64_t least) {
    size_t power = 1;
    while (power < least)
        power *= 2;
    return power;
}

/* Evaluations of a level that samples the smallest feature, without those of peaks. */
static unsigned long long needed_evaluations(const aur_integrate_options *o) {
    return (unsigned long long)power_of_two((uint64_t)ceil(seen_points(o) / (double)o->replicates)) *
           o->replicates;
}

/* Whether a relative tolerance cannot be reached, because all values are 0 within their intervals. */
static bool may_be_zero(const aur_integration *work) {
    bool zero = work->options.absolute == 0.0;
    for (size_t v = 0; v < work->values; ++v)
        zero = zero && fabs(work->found[v].value) <= work->found[v].half_width;
    return zero;
}

static void warn(const aur_integration *work) {
    static const char *const words[] = {
        "all values of the function are equal: features smaller than %s may not have been sampled (peaks "
        "with "
        "separate points and more evaluations help)",
        "fewer than 64 values of the function differ from the others: the error may be larger (features "
        "smaller than %s may not have been sampled)",
        "one point has more than half of the sum of the values: the error may be larger (features smaller "
        "than "
        "%s may not have been sampled)",
        "the largest values fall as slowly as those of infinite variance do: the interval may not hold "
        "(features smaller than %s may not have been sampled; declare a singularity by the exponent of a "
        "peak)",
        "features smaller than %s may not have been sampled: %sset `resolution` to the share of the smallest "
        "feature (1: none is narrow)"};
    const aur_integral *const integral = &work->integral;
    const aur_integrate_options *const o = &work->options;
    char size[96];
    int length = snprintf(size, sizeof size, "a share of %.2g of the domain", integral->resolution);
    if (integral->resolution_degrees > 0.0)
        snprintf(size + length, sizeof size - (size_t)length, " (a cap with a radius of %.2g degrees)",
                 integral->resolution_degrees);
    char allow[64] = ""; /* nothing to allow where the memory for the values is the limit */
    if (needed_evaluations(o) > o->evaluations)
        snprintf(allow, sizeof allow, "allow %llu evaluations, or ", needed_evaluations(o));
    for (size_t bit = 0; bit < sizeof words / sizeof words[0]; ++bit)
        if (integral->doubts >> bit & 1U)
            aur_warn_at(&o->warnings, (aur_location){0}, words[bit], size, allow);
    if (integral->reason == AUR_INTEGRATE_EVALUATIONS && o->absolute + o->relative > 0.0 && !work->met)
        aur_warn_at(&o->warnings, (aur_location){0},
                    "the target was not reached: the error is %.3g after %llu evaluations%s", integral->error,
                    (unsigned long long)integral->evaluations,
                    may_be_zero(work) ? "; the integral may be 0: set an absolute tolerance" : "");
}

/* --- the call */

/* Points of the rest of the domain on the first level. */
static size_t first_points(const aur_integration *work) {
    const aur_integrate_options *const o = &work->options;
    if (o->set != NULL)
        return o->first;
    if (o->first > 0)
        return power_of_two(o->first);
    size_t first = power_of_two(FIRST / o->replicates);
    while (first > 2 &&
           (2 * first * o->replicates > o->evaluations || 2 * first * o->replicates * work->values > STORED))
        first /= 2;
    /* Levels far below those that the resolution needs would end nothing. */
    while (8 * first * o->replicates <= fmin(seen_points(o), (double)o->evaluations) &&
           8 * first * o->replicates * work->values <= STORED_BY_DEFAULT)
        first *= 2;
    return first;
}

static aur_result open_strata(aur_integration *work, aur_error *error) {
    const aur_integrate_options *const o = &work->options;
    const size_t first = first_points(work), least = first < 16 ? first : 16;
    const uint64_t share = o->evaluations / o->replicates;
    work->most = o->set != NULL ? first : power_of_two(share < STORED ? share : STORED);
    uint64_t points = 0;
    aur_result result = AUR_OK;
    for (size_t s = 0; s < work->strata && result == AUR_OK; ++s) {
        aur_stratum *const part = &work->parts[s];
        const size_t of_peak = power_of_two(first / work->strata);
        part->next = s == o->peak_count ? first : of_peak > least ? of_peak : least;
        points += (uint64_t)part->next * o->replicates;
        result = aur_replicates_create(o, s, work->most, &part->replicates, error);
        if (result == AUR_OK)
            part->scale = aur_replicates_measure(part->replicates);
    }
    if (result == AUR_OK && points > o->evaluations)
        result = aur_fail(error, AUR_ERROR_ARGUMENT,
                          "the first level takes %llu evaluations, and %llu are allowed",
                          (unsigned long long)points, (unsigned long long)o->evaluations);
    const double total = work->parts[o->peak_count].scale;
    for (size_t s = 0; s < work->strata && o->mean && result == AUR_OK; ++s)
        work->parts[s].scale /= total;
    return result;
}

static aur_result open(aur_integration *work, aur_error *error) {
    const aur_integrate_options *const o = &work->options;
    const size_t coordinates = aur_integrate_coordinates(o);
    work->values = o->values > 0 ? o->values : 1;
    work->strata = o->peak_count + 1;
    work->parts = calloc(work->strata, sizeof *work->parts);
    work->results = malloc((coordinates + 2 + work->values) * AUR_INTEGRAND_POINTS * sizeof *work->results);
    work->means = malloc(work->strata * (o->replicates + 1) * sizeof *work->means);
    work->found = malloc(work->values * sizeof *work->found);
    work->before = malloc(work->values * sizeof *work->before);
    work->all_equal = calloc(work->values, sizeof *work->all_equal);
    work->variances = calloc(work->values, sizeof *work->variances);
    work->quantile = aur_student_quantile(o->replicates - 1, 0.5 + 0.5 * o->confidence);
    if (work->parts == NULL || work->results == NULL || work->means == NULL || work->found == NULL ||
        work->before == NULL || work->all_equal == NULL || work->variances == NULL)
        return aur_fail_memory(error);
    work->shares = work->means + work->strata * o->replicates;
    return open_strata(work, error);
}

static void release(aur_integration *work) {
    for (size_t s = 0; s < work->strata && work->parts != NULL; ++s) {
        aur_replicates_destroy(work->parts[s].replicates);
        for (size_t r = 0; r < AUR_REPLICATES_MAX; ++r)
            free(work->parts[s].values[r]);
        free(work->parts[s].weights);
    }
    free(work->parts);
    free(work->results);
    free(work->means);
    free(work->found);
    free(work->before);
    free(work->all_equal);
    free(work->variances);
    free(work->scratch);
}

aur_result aur_integrate_values(aur_integrand function, void *user, const aur_integrate_options *options,
                                aur_estimated *results, aur_integral *integral, aur_error *error) {
    aur_integration work = {.options = {.size = sizeof work.options},
                            .function = function,
                            .user = user,
                            .integral = {.size = sizeof work.integral}};
    aur_integrate_options_init(AUR_DOMAIN_SPHERE, &work.options, NULL);
    aur_result result =
        aur_options_read(options, sizeof work.options, &work.options, "aur_integrate_options", error);
    if (result == AUR_OK)
        result = check(&work.options, error);
    const bool orbits = result == AUR_OK && work.options.group != NULL;
    if (orbits) {
        work.values = work.options.values > 0 ? work.options.values : 1;
        work.found = malloc(work.values * sizeof *work.found);
        result = work.found != NULL
                     ? aur_integrate_orbits(function, user, &work.options, work.found, &work.integral, error)
                     : aur_fail_memory(error);
    } else if (result == AUR_OK) {
        result = open(&work, error);
    }
    if (result == AUR_OK && !orbits)
        result = integrate(&work, error);
    if (result == AUR_OK)
        result = aur_description_write(&work.integral, sizeof work.integral, integral, "aur_integral", error);
    if (result == AUR_OK && results != NULL)
        memcpy(results, work.found, work.values * sizeof *results);
    if (result == AUR_OK)
        warn(&work);
    release(&work);
    return result;
}

aur_result aur_integrate(aur_integrand function, void *user, const aur_integrate_options *options,
                         aur_integral *integral, aur_error *error) {
    return aur_integrate_values(function, user, options, NULL, integral, error);
}

aur_result aur_integrate_options_init(aur_domain domain, aur_integrate_options *options, aur_error *error) {
    static const aur_integrate_options defaults = {.size = sizeof defaults,
                                                   .relative = 0.01,
                                                   .confidence = 0.95,
                                                   .replicates = 16,
                                                   .evaluations = UINT64_C(1) << 22};
    const aur_result result =
        aur_description_write(&defaults, sizeof defaults, options, "aur_integrate_options", error);
    if (result == AUR_OK)
        options->domain = domain;
    return result;
}
