#include "core/error.h"
#include "quadrature/check.h"
#include "quadrature/potential.h"

static aur_result weigh(const aur_rule_options *options, const double *xyz, double *weights,
                        aur_error *error) {
    aur_density density;
    aur_potential *potential = NULL;
    aur_result result = aur_density_from_lobe(&options->points.lobe, options->points.domain, &density, error);
    if (result == AUR_OK)
        result = aur_potential_create(&density, options->points.smoothness, &potential, error);
    const aur_potential *const one = potential;
    if (result == AUR_OK)
        result = aur_weights_solve((size_t)options->points.count, xyz, 1, &one, &options->weights, weights,
                                   NULL, NULL, error);
    aur_potential_destroy(potential);
    return result;
}

aur_result aur_rule_make(const aur_rule_options *options, size_t capacity, double *xyz, double *weights,
                         aur_error *error) {
    const char *const set = options->set != NULL ? options->set : "spherical-fibonacci";
    const size_t count = (size_t)options->points.count;
    if (count == 0)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "a rule needs at least one sample");
    aur_directions *directions;
    aur_result result = aur_check_capacity(count, capacity / 3, error);
    if (result != AUR_OK)
        return result;
    result = aur_directions_create(set, &options->points, &directions, error);
    if (result != AUR_OK)
        return result;
    if (aur_directions_size(directions) != count)
        result = aur_fail(error, AUR_ERROR_ARGUMENT, "set '%s' has %llu points, not %zu", set,
                          (unsigned long long)aur_directions_size(directions), count);
    else
        result = aur_directions_points(directions, 0, count, 3 * count, xyz, weights);
    aur_directions_destroy(directions);
    return result == AUR_OK && options->optimal ? weigh(options, xyz, weights, error) : result;
}
