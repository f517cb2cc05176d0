/* The view factors of facets: rays, closed forms, and the balance of both. */
#include <aureole-lighting/view_factors.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "lighting/viewfactors/closed_pairs.h"
#include "lighting/viewfactors/exchange.h"
#include "lighting/viewfactors/sky_slices.h"
#include "lighting/viewfactors/view_factors.h"
#include "points/base/error.h"

enum { MOST_RAYS = UINT16_MAX, DEFAULT_RAYS = 2048, DEFAULT_RANDOMIZATIONS = 8, MOST_RANDOMIZATIONS = 64 };

/* The sky dominates the error of a city's radiosities: three half planes for two rays reach .1 % fastest
 * (docs/view-factors.md). */
static size_t usual_half_planes(const aur_view_factors_options *options) {
    const size_t most = MOST_RAYS * options->randomizations, requested = (3 * options->rays + 1) / 2;
    return requested < most ? requested : most;
}

aur_result aur_view_factors_read_options(const aur_view_factors_options *given,
                                         aur_view_factors_options *options, aur_error *error) {
    options->size = sizeof(aur_view_factors_options);
    aur_view_factors_options_init(options, NULL);
    const aur_result result =
        aur_options_read(given, sizeof *options, options, "aur_view_factors_options", error);
    if (result != AUR_OK)
        return result;
    if (options->rays == 0)
        options->rays = DEFAULT_RAYS;
    if (options->randomizations == 0)
        options->randomizations = DEFAULT_RANDOMIZATIONS;
    if (options->set == NULL)
        options->set = "sobol";
    if (options->confidence == 0.0)
        options->confidence = 0.95;
    if (!(options->confidence > 0.0 && options->confidence < 1.0))
        return aur_fail(error, AUR_ERROR_ARGUMENT, "the confidence must be in (0,1), not %g",
                        options->confidence);
    if (options->randomizations < 2 || options->randomizations > MOST_RANDOMIZATIONS)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "there must be 2 to %d randomisations, not %zu",
                        MOST_RANDOMIZATIONS, options->randomizations);
    if (options->rays < options->randomizations || options->rays > MOST_RAYS * options->randomizations)
        return aur_fail(
            error, AUR_ERROR_ARGUMENT,
            "there must be 1 to %d rays for each of %zu randomisations, %zu to %zu in all, not %zu",
            MOST_RAYS, options->randomizations, options->randomizations, MOST_RAYS * options->randomizations,
            options->rays);
    if (!(options->error >= 0.0 && options->error < INFINITY))
        return aur_fail(error, AUR_ERROR_ARGUMENT, "the error must be above 0, not %g", options->error);
    if (options->half_planes == 0)
        options->half_planes = usual_half_planes(options);
    if (options->half_planes > MOST_RAYS * options->randomizations)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "there must be at most %zu half planes, not %zu",
                        MOST_RAYS * options->randomizations, options->half_planes);
    return AUR_OK;
}

/* Converts exchanges to factors. */
static void finish(aur_exchange *g, aur_view_factors *factors) {
    factors->columns = g->columns;
    factors->starts = g->starts;
    factors->values = g->values;
    factors->half_widths = g->half_widths;
    factors->areas = g->areas;
    factors->sky = g->sky;
    factors->sky_half_widths = g->sky_half_widths;
    factors->back = g->back;
    factors->rows = g->rows;
    factors->randomizations = g->randomizations;
    factors->deviations = g->deviations;
    factors->sky_deviations = g->loss_deviations; /* those of backs follow */
    g->deviations = NULL;
    g->loss_deviations = NULL;
    g->columns = NULL;
    g->starts = NULL;
    g->values = g->half_widths = g->areas = g->sky = g->sky_half_widths = g->back = NULL;
    double total = 0.0;
    for (size_t a = 0; a < factors->rows; ++a) {
        const double area = factors->areas[a] > 0.0 ? factors->areas[a] : 1.0;
        for (uint64_t e = factors->starts[a]; e < factors->starts[a + 1]; ++e) {
            total += factors->values[e];
            factors->values[e] /= area;
            factors->half_widths[e] /= area;
        }
        factors->sky[a] /= area;
        factors->sky_half_widths[a] /= area;
        factors->back[a] /= area;
    }
    factors->description.closed_share = total > 0.0 ? fmin(g->closed_total / total, 1.0) : 0.0;
}

static aur_result copy_names(const aur_facets *facets, aur_view_factors *factors, aur_error *error) {
    if (!facets->grouped)
        return AUR_OK;
    for (size_t i = 0; i < facets->group_count; ++i)
        if (strlen(facets->names[i]) > factors->name_width)
            factors->name_width = strlen(facets->names[i]);
    factors->name_width += factors->name_width == 0;
    factors->names = calloc(factors->rows, factors->name_width);
    if (factors->names == NULL)
        return aur_fail_memory(error);
    for (size_t i = 0; i < factors->rows; ++i) {
        const char *const name = aur_facets_name(facets, i);
        memcpy(&factors->names[factors->name_width * i], name, strlen(name));
    }
    return AUR_OK;
}

/* One or two rays may have passed between adjacent facets because of rounded origins: no warning for back
 * hits below `least` of the light. */
static void warn(const aur_facets *facets, const aur_view_factors *factors, const aur_balance *balance,
                 double least, const aur_warnings *warnings) {
    const aur_location location = {.file = facets->path};
    size_t count = 0;
    double most = 0.0;
    for (size_t a = 0; a < factors->rows; ++a) {
        count += factors->back[a] > least;
        most = fmax(most, factors->back[a]);
    }
    if (count > 0)
        aur_warn_at(warnings, location,
                    "%zu rows see backs of facets, up to %.3g of what leaves them: the surfaces are open, or "
                    "inside out, or see on both sides",
                    count, most);
    if (balance->unbalanced > 0)
        aur_warn_at(
            warnings, location,
            "%zu rows cannot be made to add up to 1 with symmetric exchanges, the worst is off by %.3g",
            balance->unbalanced, balance->after);
}

/* Replaces the sky counted by rays with that of half planes, which are more accurate in less time. A mesh
 * that no ray has left is closed, except for gaps by rounding. */
static aur_result measure_sky(const aur_facets *facets, const aur_view_factors_options *options,
                              const aur_parallel_options *parallel, aur_ray_hits *ray_hits,
                              aur_error *error) {
    const size_t count = ray_hits->randomizations, numbers = ray_hits->patch_count * count;
    bool open = false;
    for (size_t i = 0; i < numbers; ++i)
        open |= ray_hits->sky[i] > 0.0;
    if (!open)
        return AUR_OK;
    aur_sky_slices *slices;
    aur_result result =
        aur_sky_slices_create(facets, options->set, (options->half_planes + count - 1) / count, count,
                              options->seed, &slices, error);
    if (result == AUR_OK)
        result = aur_sky_slices_measure(slices, parallel, ray_hits->sky, error);
    for (size_t i = 0; i < numbers && result == AUR_OK; ++i)
        ray_hits->sky[i] *= (double)ray_hits->rays;
    aur_sky_slices_destroy(slices);
    return result;
}

static aur_result compute(const aur_facets *facets, const aur_view_factors_options *options,
                          aur_view_factors *factors, aur_error *error) {
    const aur_parallel_options parallel = {.threads = options->threads, .progress = options->progress};
    aur_facet_pattern pattern = {0};
    aur_ray_hits ray_hits = {0};
    aur_closed_pairs closed = {.patch_count = facets->patch_count,
                               .rows = calloc(facets->patch_count, sizeof *closed.rows)};
    aur_exchange exchange = {0};
    aur_balance balance = {0};
    const uint64_t before = aur_rays_traced;
    aur_result result = closed.rows != NULL ? AUR_OK : aur_fail_memory(error);
    if (result == AUR_OK)
        result = aur_facet_pattern_create(options->set, options->rays / options->randomizations,
                                          options->seed, &pattern, error);
    if (result == AUR_OK)
        result = aur_ray_hits_trace(facets, &pattern, options->randomizations, &parallel, &ray_hits, error);
    if (result == AUR_OK && !options->rays_only)
        result = measure_sky(facets, options, &parallel, &ray_hits, error);
    if (result == AUR_OK && !options->rays_only) {
        aur_closed_pairs_release(&closed);
        result = aur_closed_pairs_find(facets, &ray_hits, &parallel, &closed, error);
        if (result == AUR_OK)
            result = aur_unseen_pairs_fill(facets, &ray_hits, &closed, error);
    }
    if (result == AUR_OK)
        result = aur_exchange_assemble(facets, &ray_hits, &closed, options->confidence, &parallel, &exchange,
                                       error);
    const size_t rays = ray_hits.rays * ray_hits.randomizations;
    aur_ray_hits_release(&ray_hits); /* largest allocation; the following steps need as much */
    aur_closed_pairs_release(&closed);
    if (result == AUR_OK)
        result = aur_exchange_balance(&exchange, &parallel, &balance, error);
    if (result == AUR_OK) {
        factors->description =
            (aur_view_factors_description){.size = sizeof factors->description,
                                           .rays = aur_rays_traced - before,
                                           .closed_pairs = exchange.closed_pairs,
                                           .sampled_pairs = exchange.sampled_pairs,
                                           .largest_row_error = balance.after,
                                           .raw_row_error = balance.before,
                                           .moved = balance.moved,
                                           .unseen = -log(0.5 - 0.5 * options->confidence) / (double)rays};
        finish(&exchange, factors);
        result = copy_names(facets, factors, error);
        warn(facets, factors, &balance, 2.5 / (double)rays, &options->warnings);
    }
    aur_facet_pattern_release(&pattern);
    aur_exchange_release(&exchange);
    return result;
}

/* For the intervals of factors and sky. */
static double find_widest(const aur_view_factors *factors) {
    double widest = 0.0;
    for (uint64_t e = 0; e < factors->starts[factors->rows]; ++e)
        widest = fmax(widest, factors->half_widths[e]);
    for (size_t i = 0; i < factors->rows; ++i)
        widest = fmax(widest, factors->sky_half_widths[i]);
    return widest;
}

aur_result aur_view_factors_create(const aur_facets *facets, const aur_view_factors_options *given,
                                   aur_view_factors **factors, aur_error *error) {
    *factors = NULL;
    aur_view_factors_options options;
    aur_result result = aur_view_factors_read_options(given, &options, error);
    if (result != AUR_OK)
        return result;
    for (;;) {
        aur_view_factors *const created = calloc(1, sizeof *created);
        result = created != NULL ? compute(facets, &options, created, error) : aur_fail_memory(error);
        if (result != AUR_OK) {
            aur_view_factors_destroy(created);
            return result;
        }
        const double widest = options.error > 0.0 ? find_widest(created) : 0.0;
        const bool more = 2 * options.rays <= MOST_RAYS * options.randomizations;
        if (widest <= options.error || !more) {
            if (widest > options.error)
                aur_warn_at(&options.warnings, (aur_location){.file = facets->path},
                            "%zu rays are the most, and half widths are up to %.3g: the error of %g is not "
                            "reached",
                            options.rays, widest, options.error);
            *factors = created;
            return AUR_OK;
        }
        aur_view_factors_destroy(created);
        /* The error of rays falls with the inverse root of their number. */
        for (double excess = widest;
             excess > options.error && 2 * options.rays <= MOST_RAYS * options.randomizations;
             excess *= 0.70710678118654752) {
            options.rays *= 2;
            options.half_planes = usual_half_planes(&options);
        }
    }
}

void aur_view_factors_destroy(aur_view_factors *factors) {
    if (factors == NULL)
        return;
    free(factors->starts);
    free(factors->columns);
    free(factors->values);
    free(factors->half_widths);
    free(factors->areas);
    free(factors->sky);
    free(factors->sky_half_widths);
    free(factors->back);
    free(factors->deviations);
    free(factors->sky_deviations);
    free(factors->names);
    free(factors);
}

aur_result aur_view_factors_get_matrix(const aur_view_factors *factors, aur_view_factors_matrix *matrix,
                                       aur_error *error) {
    const aur_view_factors_matrix computed = {.size = sizeof computed,
                                              .rows = factors->rows,
                                              .starts = factors->starts,
                                              .columns = factors->columns,
                                              .values = factors->values,
                                              .half_widths = factors->half_widths,
                                              .areas = factors->areas,
                                              .sky = factors->sky,
                                              .sky_half_widths = factors->sky_half_widths,
                                              .back = factors->back};
    return aur_description_write(&computed, sizeof computed, matrix, "aur_view_factors_matrix", error);
}

aur_result aur_view_factors_get_description(const aur_view_factors *factors,
                                            aur_view_factors_description *description, aur_error *error) {
    const aur_view_factors_description *const computed = &factors->description;
    return aur_description_write(computed, sizeof *computed, description, "aur_view_factors_description",
                                 error);
}

aur_result aur_view_factors_options_init(aur_view_factors_options *options, aur_error *error) {
    static const aur_view_factors_options defaults = {.size = sizeof defaults};
    return aur_description_write(&defaults, sizeof defaults, options, "aur_view_factors_options", error);
}
