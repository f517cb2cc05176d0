/* Radiosities of facets, by the matrix or by rays that are traced for each reflection. */
#include <aureole/statistics.h>
#include <stdlib.h>
#include <string.h>

#include "lighting/viewfactors/facet_rays.h"
#include "lighting/viewfactors/upper_walk.h"
#include "lighting/viewfactors/view_factors.h"
#include "points/base/error.h"
#include "points/base/parallel.h"

/* Few rays go to the sun, and the sunlit region has sharp edges, so they start at SUN_ORIGINS times as many
 * origins. */
enum { MOST_REFLECTIONS = 200, FEWEST_RAYS = 16, LEVELS = 16, SUN_ORIGINS = 4 };

/* With a matrix the series ends when the next reflection is below this fraction of the total. */
static const double SMALLEST_CHANGE = 1e-7;

typedef struct solution {
    const aur_facets *facets;
    const aur_view_factors *factors;
    const aur_facets_light *light;
    aur_parallel_options parallel;
    aur_progress_span *span; /* over all products */
    size_t rows, randomizations;
    /* Patterns with successively half as many rays, down to FEWEST_RAYS. */
    aur_facet_pattern patterns[LEVELS];
    size_t level_count;
    aur_facet_pattern sun_origins;
    double smallest; /* fraction of the light at which the series ends */
    /* Per row: the result of one randomisation, and sums over randomisations. */
    double *now, *next, *sky, *found, *total, *squares, *sky_total;
    double *reflectances, *emissions; /* per row */
    double highest;                   /* maximum of the reflectances */
    double *sun; /* [randomizations + 1][rows]: irradiances, the last ones their mean; NULL: no sun */
} solution;

/* Progress: the next product takes `work` after `done` of its randomisation, in units of the first product.
 * The sun's also takes about one; those with fewer rays, as the light decreases, take about one together. */
static void place_product(const solution *s, size_t randomization, bool of_sun, double done, double work) {
    const double sun = s->sun != NULL ? 1.0 : 0.0, others = 1.0 + 1.0 / fmax(1.0 - s->highest, 0.1),
                 each = of_sun ? sun : others,
                 first = (of_sun ? 0.0 : sun * (double)s->randomizations) + each * (double)randomization,
                 all = (sun + others) * (double)s->randomizations;
    s->span->from = (first + fmin(done, each)) / all;
    s->span->to = (first + fmin(done + work, each)) / all;
}

static double mean(const solution *s, const double *values) {
    double sum = 0.0, area = 0.0;
    for (size_t i = 0; i < s->rows; ++i) {
        sum += s->facets->row_areas[i] * values[i];
        area += s->facets->row_areas[i];
    }
    return area > 0.0 ? sum / area : 0.0;
}

/* Multiplies by the factors of one randomisation; by their mean if there is no randomisation of this index.
 */
static bool multiply(const aur_view_factors *m, size_t randomization, const double *x, double *y) {
    for (size_t i = 0; i < m->rows; ++i) {
        double sum = 0.0;
        for (uint64_t e = m->starts[i]; e < m->starts[i + 1]; ++e)
            sum += m->values[e] * x[m->columns[e]];
        y[i] = sum;
    }
    aur_upper_walk walk;
    if (randomization == m->randomizations)
        return true;
    if (!aur_upper_walk_begin(m->rows, m->starts, m->columns, &walk))
        return false;
    for (const float *off = m->deviations + randomization; aur_upper_walk_advance(&walk);
         off += m->randomizations) {
        y[walk.row] += (double)*off / m->areas[walk.row] * x[walk.column];
        if (walk.column != walk.row)
            y[walk.column] += (double)*off / m->areas[walk.column] * x[walk.row];
    }
    return true;
}

/* One application of the factors. Each pair of a randomisation and a reflection uses independent rays, so
 * that the expectation of a product of several is the product of their expectations. */
static aur_result apply(const solution *s, size_t level, size_t randomization, size_t reflection,
                        const double *x, double *y, double *sky, aur_error *error) {
    if (s->factors == NULL)
        return aur_facet_product(s->facets, &s->patterns[level],
                                 randomization + s->randomizations * reflection, 1, &s->parallel, NULL, x, y,
                                 sky, error);
    const aur_view_factors *const m = s->factors;
    if (!multiply(m, randomization, x, y))
        return aur_fail_memory(error);
    for (size_t i = 0; i < s->rows && sky != NULL; ++i)
        sky[i] = m->sky[i] + (randomization < m->randomizations && m->areas[i] > 0.0
                                  ? m->sky_deviations[m->randomizations * i + randomization] / m->areas[i]
                                  : 0.0);
    return AUR_OK;
}

/* Light before reflection: from the sun, the sky and the facets' emission. */
static aur_result first_light(const solution *s, size_t randomization, aur_error *error) {
    const aur_facets_light *const light = s->light;
    memcpy(s->now, s->emissions, s->rows * sizeof *s->now);
    memset(s->found, 0, s->rows * sizeof *s->found);
    place_product(s, randomization, false, 0.0, 1.0);
    aur_result result = apply(s, 0, randomization, 0, s->now, s->next, s->sky, error);
    if (result != AUR_OK)
        return result;
    for (size_t i = 0; i < s->rows; ++i)
        s->next[i] += light->sky * s->sky[i];
    for (size_t i = 0; i < s->rows && s->sun != NULL; ++i)
        s->next[i] += s->sun[s->rows * randomization + i];
    return AUR_OK;
}

static aur_result trace_sun(solution *s, aur_error *error) {
    const size_t count = s->randomizations, rows = s->rows;
    if (!(aur_length3(s->light->sun) > 0.0))
        return AUR_OK;
    s->sun = calloc((count + 1) * rows + 1, sizeof *s->sun);
    aur_result result = s->sun != NULL ? AUR_OK : aur_fail_memory(error);
    for (size_t r = 0; r < count && result == AUR_OK; ++r) {
        place_product(s, r, true, 0.0, 1.0);
        result = aur_facet_product(s->facets, &s->sun_origins, r + count * (MOST_REFLECTIONS + 1), 1,
                                   &s->parallel, s->light->sun, NULL, &s->sun[rows * r], NULL, error);
        for (size_t i = 0; i < rows; ++i)
            s->sun[rows * count + i] += s->sun[rows * r + i] / (double)count;
    }
    return result;
}

/* s->found receives the irradiance of each row, over all reflections. */
static aur_result solve_once(const solution *s, size_t randomization, aur_error *error) {
    aur_result result = first_light(s, randomization, error);
    double before = 0.0, done = 1.0, first = 0.0, whole = mean(s, s->emissions);
    for (size_t k = 1; result == AUR_OK && k < MOST_REFLECTIONS; ++k) {
        for (size_t i = 0; i < s->rows; ++i)
            s->now[i] = s->reflectances[i] * s->next[i];
        const double part = mean(s, s->now), ratio = k > 1 && before > 0.0 ? part / before : 1.0;
        first = k == 1 ? part : first;
        whole += part;
        for (size_t i = 0; i < s->rows; ++i)
            s->found[i] += s->next[i];
        if (part == 0.0 || (ratio < 1.0 && part * ratio / (1.0 - ratio) <= s->smallest * whole)) {
            /* Extrapolates the remaining reflections as a geometric series with the distribution of the last
             * one. */
            for (size_t i = 0; i < s->rows && part > 0.0; ++i)
                s->found[i] += s->next[i] * ratio / (1.0 - ratio);
            return AUR_OK;
        }
        before = part;
        size_t level = 0;
        while (level + 1 < s->level_count && part <= first / (double)(UINT64_C(2) << level))
            ++level;
        const double work = 1.0 / (double)(UINT64_C(1) << level);
        place_product(s, randomization, false, done, work);
        done += work;
        result = apply(s, level, randomization, k, s->now, s->next, NULL, error);
    }
    return result != AUR_OK ? result
                            : aur_fail(error, AUR_ERROR_ARGUMENT,
                                       "after %d reflections there is still light: a closed scene that "
                                       "absorbs (almost) nothing has no radiosities",
                                       MOST_REFLECTIONS);
}

/* Without a matrix the solution is the mean over the randomisations. With one, it is the solution for the
 * matrix; the solutions for the matrices of single randomisations give its error. */
static aur_result solve(solution *s, bool intervals, aur_error *error) {
    const size_t count = intervals || s->factors == NULL ? s->randomizations : 0;
    for (size_t r = 0; r < count; ++r) {
        const aur_result result = solve_once(s, r, error);
        if (result != AUR_OK)
            return result;
        for (size_t i = 0; i < s->rows; ++i) {
            /* Updates the mean and the sum of squared deviations (Welford 1962). */
            const double off = s->found[i] - s->total[i];
            s->total[i] += off / (double)(r + 1);
            s->squares[i] += off * (s->found[i] - s->total[i]);
            s->sky_total[i] += s->sky[i] / (double)count;
        }
    }
    if (s->factors == NULL)
        return AUR_OK;
    const aur_result result = solve_once(s, s->randomizations, error);
    memcpy(s->total, s->found, s->rows * sizeof *s->total);
    memcpy(s->sky_total, s->sky, s->rows * sizeof *s->sky_total);
    return result;
}

static aur_result check(const aur_facets *facets, const aur_view_factors *factors,
                        const aur_facets_light *light, aur_error *error) {
    const double sun = aur_length3(light->sun);
    double emission = light->emission;
    for (size_t i = 0; i < facets->row_count; ++i) {
        const double reflectance = light->reflectances != NULL ? light->reflectances[i] : light->reflectance,
                     row_emission = light->emissions != NULL ? light->emissions[i] : light->emission;
        if (!(reflectance >= 0.0 && reflectance <= 1.0))
            return aur_fail(error, AUR_ERROR_ARGUMENT, "the reflectance must be in [0,1], not %g",
                            reflectance);
        if (!(row_emission >= 0.0 && row_emission < INFINITY))
            return aur_fail(error, AUR_ERROR_ARGUMENT, "emissions must be finite and not negative, not %g",
                            row_emission);
        emission = fmax(emission, row_emission);
    }
    if (!(light->sky >= 0.0 && light->sky < INFINITY && sun < INFINITY))
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "the radiosity of the sky and the sun's irradiance must be finite and not negative");
    if (light->sky + emission + sun == 0.0)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "no light: give sky, emission or sun");
    if (factors != NULL && factors->rows != facets->row_count)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "the view factors are of %zu rows, the facets have %zu",
                        factors->rows, facets->row_count);
    return AUR_OK;
}

static aur_result prepare(solution *s, const aur_view_factors_options *options, double *numbers,
                          aur_error *error) {
    double **const parts[] = {&s->now,     &s->next,      &s->sky,          &s->found,    &s->total,
                              &s->squares, &s->sky_total, &s->reflectances, &s->emissions};
    for (size_t i = 0; i < sizeof parts / sizeof parts[0]; ++i)
        *parts[i] = numbers + i * s->rows;
    for (size_t i = 0; i < s->rows; ++i) {
        const aur_facets_light *const light = s->light;
        const double row_emission = light->emissions != NULL ? light->emissions[i] : light->emission;
        s->reflectances[i] = light->reflectances != NULL ? light->reflectances[i] : light->reflectance;
        s->emissions[i] = s->facets->row_areas[i] > 0.0 ? row_emission : 0.0;
        s->highest = fmax(s->highest, s->reflectances[i]);
    }
    s->smallest =
        s->factors != NULL ? SMALLEST_CHANGE : fmax(SMALLEST_CHANGE, 0.02 / sqrt((double)options->rays));
    size_t rays = options->rays / s->randomizations;
    rays += rays == 0;
    aur_result result = AUR_OK;
    if (aur_length3(s->light->sun) > 0.0)
        result =
            aur_facet_pattern_create(options->set, SUN_ORIGINS * rays, options->seed, &s->sun_origins, error);
    while (result == AUR_OK && s->level_count < LEVELS && (s->level_count == 0 || rays >= FEWEST_RAYS)) {
        result =
            aur_facet_pattern_create(options->set, rays, options->seed, &s->patterns[s->level_count], error);
        s->level_count += result == AUR_OK;
        rays /= 2;
    }
    return result;
}

static void write(const solution *s, double student, const aur_facets_radiosities *solved) {
    const double n = (double)s->randomizations;
    for (size_t i = 0; i < s->rows; ++i) {
        const double half_width = student * sqrt(s->squares[i] / (n * (n - 1.0)));
        if (solved->radiosity != NULL)
            solved->radiosity[i] = s->emissions[i] + s->reflectances[i] * s->total[i];
        if (solved->half_widths != NULL)
            solved->half_widths[i] = s->reflectances[i] * half_width;
        if (solved->sky != NULL)
            solved->sky[i] = s->sky_total[i];
        if (solved->incoming != NULL)
            solved->incoming[i] = s->total[i];
        if (solved->incoming_half_widths != NULL)
            solved->incoming_half_widths[i] = half_width;
    }
}

aur_result aur_view_factors_solve(const aur_facets *facets, const aur_view_factors *factors,
                                  const aur_view_factors_options *given, const aur_facets_light *sources,
                                  const aur_facets_radiosities *requested, aur_error *error) {
    aur_view_factors_options options;
    aur_facets_light light = {.size = sizeof light};
    aur_facets_radiosities solved = {.size = sizeof solved};
    aur_facets_light_init(&light, NULL);
    aur_result result = aur_view_factors_read_options(given, &options, error);
    if (result == AUR_OK)
        result = aur_options_read(sources, sizeof light, &light, "aur_facets_light", error);
    if (result == AUR_OK)
        result = aur_options_read(requested, sizeof solved, &solved, "aur_facets_radiosities", error);
    if (result == AUR_OK)
        result = check(facets, factors, &light, error);
    if (result != AUR_OK)
        return result;
    aur_progress_span span = {.whole = options.progress};
    solution s = {.facets = facets,
                  .factors = factors,
                  .light = &light,
                  .parallel = {.threads = options.threads, .progress = aur_progress_within(&span)},
                  .span = &span,
                  .rows = facets->row_count,
                  .randomizations = factors != NULL ? factors->randomizations : options.randomizations};
    double *const numbers = calloc(9 * s.rows + 1, sizeof *numbers);
    result = numbers != NULL ? prepare(&s, &options, numbers, error) : aur_fail_memory(error);
    if (result == AUR_OK)
        result = trace_sun(&s, error);
    if (result == AUR_OK)
        result = solve(&s, solved.half_widths != NULL || solved.incoming_half_widths != NULL, error);
    if (result == AUR_OK && !(mean(&s, s.total) + mean(&s, s.emissions) > 0.0))
        result = aur_fail(error, AUR_ERROR_ARGUMENT, "no light: no row sees the sky or the sun");
    if (result == AUR_OK)
        write(&s, aur_student_quantile(s.randomizations - 1, 0.5 + 0.5 * options.confidence), &solved);
    for (size_t i = 0; i < s.level_count; ++i)
        aur_facet_pattern_release(&s.patterns[i]);
    aur_facet_pattern_release(&s.sun_origins);
    free(s.sun);
    free(numbers);
    return result;
}

aur_result aur_view_factors_radiosity(const aur_facets *facets, const aur_view_factors *factors,
                                      const aur_view_factors_options *options, const aur_facets_light *light,
                                      double *radiosity, double *half_widths, double *sky, aur_error *error) {
    const aur_facets_radiosities requested = {
        .size = sizeof requested, .radiosity = radiosity, .half_widths = half_widths, .sky = sky};
    return aur_view_factors_solve(facets, factors, options, light, &requested, error);
}

aur_result aur_facets_radiosities_init(aur_facets_radiosities *radiosities, aur_error *error) {
    static const aur_facets_radiosities defaults = {.size = sizeof defaults};
    return aur_description_write(&defaults, sizeof defaults, radiosities, "aur_facets_radiosities", error);
}

aur_result aur_facets_light_init(aur_facets_light *light, aur_error *error) {
    static const aur_facets_light defaults = {.size = sizeof defaults};
    return aur_description_write(&defaults, sizeof defaults, light, "aur_facets_light", error);
}
