#include "points/quadrature/integrate/replicates.h"

#include <math.h>
#include <stdlib.h>

#include "points/base/error.h"
#include "points/base/random.h"
#include "points/base/vector.h"
#include "points/sphere/map.h"

struct aur_replicates {
    aur_integrate_options options;
    aur_directions *grid;                       /* or NULL */
    aur_pointset *sets[AUR_REPLICATES_MAX];     /* where there is no grid */
    aur_rotation rotations[AUR_REPLICATES_MAX]; /* where there is one */
};

double aur_cap_height(const aur_integrate_options *options) {
    if (options->cap_degrees > 0.0)
        return 2.0 * pow(sin(0.5 * options->cap_degrees / 180.0 * AUR_PI), 2.0);
    return options->domain == AUR_DOMAIN_SPHERE ? 2.0 : 1.0;
}

static aur_result make_grid(aur_replicates *replicates, size_t capacity, aur_error *error) {
    aur_directions_options options = {.size = sizeof options};
    aur_directions_options_init(capacity, AUR_DOMAIN_SPHERE, &options, NULL);
    for (size_t r = 0; r < replicates->options.replicates; ++r)
        aur_rotation_uniform(aur_hash3(replicates->options.seed, 0x7475726e, r), &replicates->rotations[r]);
    return aur_directions_create("esfg:base=64", &options, &replicates->grid, error);
}

static aur_result make_sets(aur_replicates *replicates, size_t capacity, aur_error *error) {
    aur_pointset_options options = {.size = sizeof options};
    aur_pointset_options_init(capacity, &options, NULL);
    options.dimension = replicates->options.has_axis ? 3 : 2;
    options.scramble = AUR_SCRAMBLE_OWEN;
    aur_result result = AUR_OK;
    for (size_t r = 0; r < replicates->options.replicates && result == AUR_OK; ++r) {
        options.seed = aur_hash3(replicates->options.seed, 0x6f77656e, r);
        result = aur_pointset_create("sobol", &options, &replicates->sets[r], error);
    }
    return result;
}

aur_result aur_replicates_create(const aur_integrate_options *options, size_t capacity,
                                 aur_replicates **replicates, aur_error *error) {
    *replicates = calloc(1, sizeof **replicates);
    if (*replicates == NULL)
        return aur_fail_memory(error);
    (*replicates)->options = *options;
    const bool turned = aur_cap_height(options) == 2.0 && !options->has_axis;
    const aur_result result =
        turned ? make_grid(*replicates, capacity, error) : make_sets(*replicates, capacity, error);
    if (result != AUR_OK) {
        aur_replicates_destroy(*replicates);
        *replicates = NULL;
    }
    return result;
}

void aur_replicates_destroy(aur_replicates *replicates) {
    if (replicates == NULL)
        return;
    for (size_t r = 0; r < replicates->options.replicates; ++r)
        aur_pointset_destroy(replicates->sets[r]);
    aur_directions_destroy(replicates->grid);
    free(replicates);
}

const aur_directions *aur_replicates_grid(const aur_replicates *replicates) {
    return replicates->grid;
}

aur_result aur_replicates_points(const aur_replicates *replicates, size_t replicate, size_t first,
                                 size_t count, double *directions, double *along, aur_error *error) {
    const aur_integrate_options *const o = &replicates->options;
    if (replicates->grid != NULL) {
        const aur_result made =
            aur_directions_points(replicates->grid, first, count, 3 * count, directions, NULL, error);
        aur_rotation_apply(&replicates->rotations[replicate], count, directions);
        return made;
    }
    double square[3 * AUR_INTEGRAND_POINTS];
    const size_t dimension = o->has_axis ? 3 : 2;
    const double height = aur_cap_height(o);
    const aur_lobe lobe = {.exponent = o->exponent};
    const aur_result result =
        aur_pointset_points(replicates->sets[replicate], first, count, dimension * count, square, error);
    for (size_t i = 0; i < count && result == AUR_OK; ++i) {
        double *const direction = directions + 3 * i;
        aur_point_to_cap(AUR_MAP_LAMBERT, height, square + dimension * i, direction);
        if (o->exponent > 0.0)
            aur_lobe_warp(&lobe, 1, direction, direction);
        if (o->has_axis)
            along[i] = o->axis_from + (o->axis_to - o->axis_from) * square[dimension * i + 2];
    }
    return result;
}
