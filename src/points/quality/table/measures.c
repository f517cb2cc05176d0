/* The table of measures, and what prepares points for one. */
#include "points/quality/measures.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/error.h"
#include "points/base/keys.h"
#include "points/base/text.h"
#include "points/quality/table/check.h"
#include "points/sphere/native.h"

#define ROW_OF(name) &aur_measure_##name.description.row,
static const aur_row *const rows[] = {AUR_MEASURES(ROW_OF)};

static const aur_table measures = {
    .kind = "measure", .summary = "measures of the quality of points", AUR_TABLE_ROWS(rows)};

size_t aur_measure_count(void) {
    return measures.count;
}

const aur_measure_description *aur_measure_at(size_t index) {
    return index < measures.count ? &((const aur_measure_row *)rows[index])->description : NULL;
}

const aur_table *aur_table_at(size_t index) {
    const aur_table *const tables[] = {&aur_set_table, &measures};
    return index < sizeof tables / sizeof tables[0] ? tables[index] : NULL;
}

static aur_result find_row(const char *metric, const aur_measure_row **row, const char **parameter,
                           aur_error *error) {
    const size_t length = strcspn(metric, ":");
    char name[64];
    aur_format(name, sizeof name, "%.*s", (int)(length < sizeof name ? length : sizeof name - 1), metric);
    size_t index;
    const aur_result result =
        aur_names_choose(aur_names_of_table(&measures), "measure", name, (aur_location){0}, &index, error);
    if (result != AUR_OK)
        return result;
    *row = (const aur_measure_row *)rows[index];
    *parameter = metric[length] == ':' ? metric + length + 1 : NULL;
    const char *const syntax = (*row)->description.parameter;
    if (*parameter != NULL && syntax == NULL)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "measure '%s' takes no parameter, not '%s'", name,
                        *parameter);
    if (syntax != NULL && syntax[0] == ':' && (*parameter == NULL || (*parameter)[0] == '\0'))
        return aur_fail(error, AUR_ERROR_ARGUMENT, "measure '%s' needs a parameter: %s%s", name, name,
                        syntax);
    return AUR_OK;
}

aur_result aur_measure_find(const char *metric, const aur_measure_description **description,
                            aur_error *error) {
    const aur_measure_row *row = NULL;
    const char *parameter;
    const aur_result result = find_row(metric, &row, &parameter, error);
    if (result == AUR_OK)
        *description = &row->description;
    return result;
}

/* A vector of unit length to rounding is unchanged. */
static double unit_scale(size_t dimension, const double *x) {
    const double square = aur_square_length(dimension, x);
    return fabs(square - 1.0) <= 1e-15 ? 1.0 : 1.0 / sqrt(square);
}

/* Whether directions can be measured in place: contiguous, of unit length to the last bit. */
static bool are_unit(const aur_points_view *points) {
    bool unit = points->stride == points->dimension;
    for (size_t i = 0; i < points->count && unit; ++i)
        unit = unit_scale(points->dimension, aur_point_at(points, i)) == 1.0;
    return unit;
}

/* A normalised, contiguous copy, so that files of seven digits are measured as intended. */
static double *unit_copy(const aur_points_view *points, aur_arena *arena) {
    const size_t dimension = points->dimension;
    double *const copy = aur_arena_allocate(arena, points->count * dimension * sizeof *copy);
    for (size_t i = 0; i < points->count && copy != NULL; ++i) {
        const double *const x = aur_point_at(points, i);
        const double scale = unit_scale(dimension, x);
        for (size_t d = 0; d < dimension; ++d)
            copy[dimension * i + d] = x[d] * scale;
    }
    return copy;
}

/* Each axis with both ends, each rotation with both quaternions: first the given ones, then their opposites.
 */
static bool add_opposites(aur_points_view *points, aur_arena *arena) {
    const size_t count = points->count, size = points->dimension * count;
    double *const both = aur_arena_allocate(arena, 2 * size * sizeof *both);
    double *const weights = aur_arena_allocate(arena, 2 * count * sizeof *weights);
    if (both == NULL || weights == NULL)
        return false;
    for (size_t i = 0; i < size; ++i) {
        both[i] = points->coordinates[i];
        both[size + i] = -points->coordinates[i];
    }
    for (size_t i = 0; i < count; ++i)
        weights[i] = weights[count + i] = aur_weight_at(points, i);
    points->coordinates = both;
    points->weights = points->weights != NULL ? weights : NULL;
    points->lines = NULL;
    points->count = 2 * count;
    return true;
}

/* Weights that add up to 1. */
static double *masses_of(const aur_points_view *points, aur_arena *arena) {
    double *const masses = aur_arena_allocate(arena, points->count * sizeof *masses);
    double sum = 0.0;
    for (size_t i = 0; i < points->count; ++i)
        sum += aur_weight_at(points, i);
    for (size_t i = 0; i < points->count && masses != NULL; ++i)
        masses[i] = aur_weight_at(points, i) / sum;
    return masses;
}

/* The row and a checked request with its data. Release the arena even after an error. */
typedef struct prepared {
    const aur_measure_row *row;
    aur_measure_request request;
    aur_points_view points;
    aur_arena arena;
    double bound;
} prepared;

static aur_result prepare(const char *metric, const aur_points_view *given,
                          const aur_measure_options *options, prepared *p, aur_error *error) {
    aur_points_view *const points = &p->points;
    *p = (prepared){.request = {.points = points, .arena = &p->arena, .bound = &p->bound}};
    aur_measure_options *const filled = &p->request.options;
    filled->size = sizeof(aur_measure_options);
    aur_measure_options_init(filled, NULL);
    aur_result result = aur_options_read(options, sizeof *filled, filled, "aur_measure_options", error);
    if (result == AUR_OK && !(filled->accuracy >= 0.0 && filled->accuracy < 1.0))
        result =
            aur_fail(error, AUR_ERROR_ARGUMENT,
                     "the accuracy must be 0 (exact) or a relative error below 1, not %g", filled->accuracy);
    if (result == AUR_OK)
        result = find_row(metric, &p->row, &p->request.parameter, error);
    if (result == AUR_OK)
        result = aur_points_view_read(given, points, error);
    if (result == AUR_OK)
        result = aur_measure_check(p->row, points, filled, error);
    if (result != AUR_OK)
        return result;
    p->request.variant = p->row->variant;
    if (aur_domain_dimension(points->domain) >= 3 && !are_unit(points)) {
        points->coordinates = unit_copy(points, &p->arena);
        points->stride = points->dimension;
    }
    const bool twofold = points->domain == AUR_DOMAIN_AXES || points->domain == AUR_DOMAIN_ROTATIONS;
    if (twofold && points->coordinates != NULL && !add_opposites(points, &p->arena))
        return aur_fail_memory(error);
    if (p->row->masses)
        points->weights = masses_of(points, &p->arena);
    const bool complete = points->coordinates != NULL && (points->weights != NULL || !p->row->masses);
    return complete ? AUR_OK : aur_fail_memory(error);
}

aur_result aur_measure_bounded(const char *metric, const aur_points_view *points,
                               const aur_measure_options *options, double *value, double *bound,
                               aur_error *error) {
    prepared p;
    aur_result result = prepare(metric, points, options, &p, error);
    if (result == AUR_OK && p.row->compute != NULL)
        result = p.row->compute(&p.request, value, error);
    else if (result == AUR_OK)
        result = aur_fail(error, AUR_ERROR_UNSUPPORTED, "measure '%s' is a table, not one value",
                          p.row->description.row.name);
    *bound = p.bound;
    aur_arena_release(&p.arena);
    return result;
}

aur_result aur_measure(const char *metric, const aur_points_view *points, const aur_measure_options *options,
                       double *value, aur_error *error) {
    double bound;
    return aur_measure_bounded(metric, points, options, value, &bound, error);
}

aur_result aur_measure_series(const char *metric, const aur_points_view *points,
                              const aur_measure_options *options, aur_series **series, aur_error *error) {
    *series = NULL;
    prepared p;
    aur_result result = prepare(metric, points, options, &p, error);
    aur_series *computed = NULL;
    if (result == AUR_OK && p.row->tabulate == NULL)
        result = aur_fail(error, AUR_ERROR_UNSUPPORTED, "measure '%s' is one value, not a table",
                          p.row->description.row.name);
    if (result == AUR_OK) {
        computed = calloc(1, sizeof *computed);
        result = computed != NULL ? p.row->tabulate(&p.request, computed, error) : aur_fail_memory(error);
    }
    if (result == AUR_OK)
        *series = computed;
    else
        aur_series_destroy(computed);
    aur_arena_release(&p.arena);
    return result;
}

aur_result aur_measure_options_init(aur_measure_options *options, aur_error *error) {
    static const aur_measure_options defaults = {.size = sizeof defaults};
    return aur_description_write(&defaults, sizeof defaults, options, "aur_measure_options", error);
}
