#include <stdint.h>

#include "points/base/options.h"
#include "points/quadrature/check.h"

static aur_result weigh(const aur_directions_options *points, const aur_weights_options *options,
                        const double *xyz, double *weights, aur_error *error) {
    const size_t count = (size_t)points->count;
    aur_density density = {.size = sizeof density};
    aur_density_init(&density, NULL);
    aur_potential *potential = NULL;
    aur_result result = aur_density_from_lobe(&points->lobe, points->domain, &density, error);
    if (result == AUR_OK)
        result = aur_potential_create(&density, points->smoothness, &potential, error);
    const aur_potential *const one = potential;
    if (result == AUR_OK)
        result = aur_weights_solve(count, xyz, 1, &one, options, count, weights, NULL, NULL, error);
    aur_potential_destroy(potential);
    return result;
}

aur_result aur_rule_make(const aur_rule_options *options, size_t capacity, double *xyz, double *weights,
                         aur_error *error) {
    aur_rule_options own = {.set = NULL};
    aur_directions_options points = {.size = sizeof points};
    aur_directions_options_init(0, AUR_DOMAIN_HEMISPHERE, &points, NULL);
    aur_result result = aur_options_read(options, sizeof own, &own, "aur_rule_options", error);
    if (result == AUR_OK)
        result = aur_options_read(own.points, sizeof points, &points, "aur_directions_options", error);
    if (result == AUR_OK && points.count == 0)
        result = aur_fail(error, AUR_ERROR_ARGUMENT, "a rule needs at least one sample");
    if (result == AUR_OK)
        result = aur_check_capacity((size_t)points.count, capacity / 3, error);
    if (result == AUR_OK)
        result = aur_points_of_set(own.set != NULL ? own.set : aur_set_default, &points, xyz, weights, error);
    return result == AUR_OK && own.optimal ? weigh(&points, own.weights, xyz, weights, error) : result;
}

aur_result aur_rule_options_init(const aur_directions_options *points, aur_rule_options *options,
                                 aur_error *error) {
    static const aur_rule_options defaults = {.size = sizeof defaults};
    const aur_result result =
        aur_description_write(&defaults, sizeof defaults, options, "aur_rule_options", error);
    if (result == AUR_OK)
        options->points = points;
    return result;
}
