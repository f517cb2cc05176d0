#include "points/quadrature/integrate/replicates.h"

#include <aureole/exact.h>
#include <aureole/rotations.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "points/base/error.h"
#include "points/base/random.h"
#include "points/base/vector.h"
#include "points/quadrature/integrate/shape.h"
#include "points/sphere/map.h"

/* Points whose weights are exact to the degree that they allow; larger levels have the degree of
 * EXACT_POINTS, which also compensates for the nonuniformity of grids between complete levels. */
enum { EXACT_POINTS = 1024, EXACT_POINTS_OF_SETS = 16384 };

struct aur_replicates {
    const aur_integrate_options *options;
    size_t peak;
    aur_directions *grid;                       /* rotated by `rotations`; or NULL */
    aur_rotations *turns;                       /* a set of rotations, rotated likewise; or NULL */
    aur_pointset *sets[AUR_REPLICATES_MAX];     /* elsewhere */
    aur_rotation rotations[AUR_REPLICATES_MAX]; /* of the grid */
    double quaternions[AUR_REPLICATES_MAX][4];  /* of the set of rotations */
    double *cube;                               /* AUR_INTEGRAND_POINTS points of the sets */
};

static bool is_rest(const aur_replicates *r) {
    return r->peak == r->options->peak_count;
}

static aur_result make_grid(aur_replicates *r, size_t capacity, aur_error *error) {
    const aur_integrate_options *const o = r->options;
    aur_directions_options options = {.size = sizeof options};
    aur_directions_options_init(capacity, o->domain, &options, NULL);
    for (size_t i = 0; i < o->replicates; ++i)
        aur_rotation_uniform(aur_hash3(o->seed, 0x7475726e, i), &r->rotations[i]);
    char grid[32];
    snprintf(grid, sizeof grid, "esfg:base=%zu", capacity < 64 ? capacity : 64);
    return aur_directions_create(o->set != NULL ? o->set : grid, &options, &r->grid, error);
}

static aur_result make_turns(aur_replicates *r, size_t capacity, aur_error *error) {
    aur_rotations_options options = {.size = sizeof options};
    aur_rotations_options_init(capacity, &options, NULL);
    for (size_t i = 0; i < r->options->replicates; ++i)
        aur_quaternion_uniform(aur_hash3(r->options->seed, 0x7475726e, i), r->quaternions[i]);
    return aur_rotations_create(r->options->set, &options, &r->turns, error);
}

static size_t cube_dimension(const aur_integrate_options *options) {
    return aur_shape_dimension(options) + (options->has_axis ? 1 : 0);
}

static aur_result make_sets(aur_replicates *r, size_t capacity, aur_error *error) {
    const aur_integrate_options *const o = r->options;
    aur_pointset_options options = {.size = sizeof options};
    aur_pointset_options_init(capacity, &options, NULL);
    options.dimension = cube_dimension(o);
    const char *const set = o->set != NULL ? o->set : "sobol";
    r->cube = malloc(options.dimension * AUR_INTEGRAND_POINTS * sizeof *r->cube);
    aur_result result = r->cube != NULL ? AUR_OK : aur_fail_memory(error);
    for (size_t i = 0; i < o->replicates && result == AUR_OK; ++i) {
        const uint64_t seed = aur_hash3(o->seed, 0x6f77656e, i);
        options.seed = is_rest(r) ? seed : aur_hash2(seed, r->peak);
        options.scramble = AUR_SCRAMBLE_OWEN;
        result = aur_pointset_create(set, &options, &r->sets[i], error);
        options.scramble = AUR_SCRAMBLE_SHIFT;
        if (result == AUR_ERROR_UNSUPPORTED)
            result = aur_pointset_create(set, &options, &r->sets[i], error);
    }
    return result;
}

/* A whole domain that is invariant under random rotations. */
static bool is_turned(const aur_replicates *r) {
    const aur_integrate_options *const o = r->options;
    return is_rest(r) && !o->has_axis && aur_shape_is_directions(o) &&
           (o->domain == AUR_DOMAIN_AXES ||
            (o->domain == AUR_DOMAIN_SPHERE && aur_shape_cap_height(o) == 2.0));
}

aur_result aur_replicates_create(const aur_integrate_options *options, size_t peak, size_t capacity,
                                 aur_replicates **replicates, aur_error *error) {
    aur_replicates *const r = *replicates = calloc(1, sizeof *r);
    if (r == NULL)
        return aur_fail_memory(error);
    r->options = options;
    r->peak = peak;
    const bool rotations = options->region == AUR_REGION_DOMAIN && options->domain == AUR_DOMAIN_ROTATIONS;
    const aur_result result = is_turned(r) ? make_grid(r, capacity, error)
                              : rotations && options->set != NULL && !options->has_axis
                                  ? make_turns(r, capacity, error)
                                  : make_sets(r, capacity, error);
    if (result != AUR_OK) {
        aur_replicates_destroy(r);
        *replicates = NULL;
    }
    return result;
}

void aur_replicates_destroy(aur_replicates *replicates) {
    if (replicates == NULL)
        return;
    for (size_t r = 0; r < replicates->options->replicates; ++r)
        aur_pointset_destroy(replicates->sets[r]);
    aur_directions_destroy(replicates->grid);
    aur_rotations_destroy(replicates->turns);
    free(replicates->cube);
    free(replicates);
}

double aur_replicates_measure(const aur_replicates *replicates) {
    const aur_integrate_options *const o = replicates->options;
    const double measure =
        is_rest(replicates) ? aur_shape_measure(o) : aur_shape_peak_measure(o, o->peaks + replicates->peak);
    return measure * (o->has_axis ? o->axis_to - o->axis_from : 1.0);
}

/* Points of an earlier peak do not belong to this stratum. */
static void exclude(const aur_replicates *r, size_t count, const double *points, double *factors) {
    const aur_integrate_options *const o = r->options;
    const size_t coordinates = aur_integrate_coordinates(o);
    for (size_t i = 0; i < count; ++i)
        for (size_t p = 0; p < r->peak && factors[i] != 0.0; ++p)
            if (aur_shape_peak_holds(o, o->peaks + p, points + coordinates * i))
                factors[i] = 0.0;
}

static aur_result turned_points(const aur_replicates *r, size_t replicate, size_t first, size_t count,
                                double *points, aur_error *error) {
    if (r->turns != NULL) {
        const aur_result result = aur_rotations_points(r->turns, first, count, 4 * count, points, error);
        for (size_t i = 0; i < count && result == AUR_OK; ++i)
            aur_quaternion_multiply(r->quaternions[replicate], points + 4 * i, points + 4 * i);
        return result;
    }
    const aur_result result = aur_directions_points(r->grid, first, count, 3 * count, points, NULL, error);
    if (result != AUR_OK)
        return result;
    aur_rotation_apply(&r->rotations[replicate], count, points);
    for (size_t i = 0; i < 3 * count && r->options->domain == AUR_DOMAIN_AXES; i += 3) {
        const double sign = points[i + 2] < 0.0 ? -1.0 : 1.0;
        for (size_t d = 0; d < 3; ++d)
            points[i + d] *= sign;
    }
    return AUR_OK;
}

aur_result aur_replicates_points(const aur_replicates *r, size_t replicate, size_t first, size_t count,
                                 double *points, double *along, double *factors, aur_error *error) {
    const aur_integrate_options *const o = r->options;
    const size_t dimension = cube_dimension(o), coordinates = aur_integrate_coordinates(o);
    for (size_t i = 0; i < count; ++i)
        factors[i] = 1.0;
    aur_result result;
    if (r->sets[0] == NULL) {
        result = turned_points(r, replicate, first, count, points, error);
    } else {
        result = aur_pointset_points(r->sets[replicate], first, count, dimension * count, r->cube, error);
        for (size_t i = 0; i < count && result == AUR_OK; ++i) {
            const double *const cube = r->cube + dimension * i;
            if (is_rest(r))
                aur_shape_point(o, cube, points + coordinates * i);
            else
                aur_shape_peak_point(o, o->peaks + r->peak, cube, points + coordinates * i, factors + i);
            if (o->has_axis)
                along[i] = o->axis_from + (o->axis_to - o->axis_from) * cube[dimension - 1];
        }
    }
    if (result == AUR_OK)
        exclude(r, count, points, factors);
    return result;
}

aur_result aur_replicates_weights(const aur_replicates *r, size_t count, double *weights, aur_error *error) {
    for (size_t i = 0; i < count; ++i)
        weights[i] = 1.0 / (double)count;
    if (r->grid == NULL || count < 2)
        return AUR_OK;
    double *const xyz = malloc(4 * count * sizeof *xyz);
    if (xyz == NULL)
        return aur_fail_memory(error);
    double *const near = xyz + 3 * count;
    const bool axes = r->options->domain == AUR_DOMAIN_AXES;
    aur_exact_options options = {.size = sizeof options};
    aur_exact_options_init(r->options->domain, &options, NULL);
    options.threads = 1;
    const size_t most = r->options->set != NULL ? EXACT_POINTS_OF_SETS : EXACT_POINTS;
    const double points = (double)(count <= most ? count : EXACT_POINTS) * (axes ? 2.0 : 1.0);
    options.degree = (size_t)fmax(sqrt(points / 2.2) - 1.0, 0.0);
    aur_result result = aur_directions_points(r->grid, 0, count, 3 * count, xyz, near, error);
    if (r->options->set != NULL && result == AUR_OK) {
        /* The set's weights may be exact to a higher degree already: then they are the result. */
        double sum = 0.0;
        for (size_t i = 0; i < count; ++i)
            sum += near[i];
        for (size_t i = 0; i < count; ++i)
            weights[i] = near[i] / sum;
        options.near = near;
    }
    if (result == AUR_OK)
        result = aur_weights_exact(count, xyz, &options, count, weights, NULL, error);
    free(xyz);
    return result == AUR_ERROR_ARGUMENT ? AUR_OK : result; /* no positive weights: the set's remain */
}
