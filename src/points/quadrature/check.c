#include "points/quadrature/check.h"

#include <math.h>

#include "points/base/error.h"
#include "points/base/vector3d.h"

aur_result aur_check_directions(size_t count, const double *xyz, aur_error *error) {
    for (size_t i = 0; i < count; ++i) {
        const double *const u = xyz + 3 * i;
        if (!aur_is_unit(u))
            return aur_fail(error, AUR_ERROR_ARGUMENT, "point %zu, (%g, %g, %g), is not a unit vector", i + 1,
                            u[0], u[1], u[2]);
    }
    return AUR_OK;
}

aur_result aur_weights_options_read(const aur_weights_options *given, aur_weights_options *copy,
                                    aur_error *error) {
    const aur_result result = aur_options_read(given, sizeof *copy, copy, "aur_weights_options", error);
    if (result == AUR_OK && !(copy->regularization >= 0.0 && isfinite(copy->regularization)))
        return aur_fail(error, AUR_ERROR_ARGUMENT, "the regularisation must be at least 0 and finite, not %g",
                        copy->regularization);
    return result;
}

aur_result aur_points_of_set(const char *set, const aur_directions_options *options, double *xyz,
                             double *weights, aur_error *error) {
    aur_directions *directions;
    aur_result result = aur_directions_create(set, options, &directions, error);
    if (result != AUR_OK)
        return result;
    const uint64_t size = aur_directions_size(directions), count = options->count;
    result = size == count
                 ? aur_directions_points(directions, 0, (size_t)count, 3 * (size_t)count, xyz, weights, error)
                 : aur_fail(error, AUR_ERROR_ARGUMENT, "set '%s' has %llu points, not %llu", set,
                            (unsigned long long)size, (unsigned long long)count);
    aur_directions_destroy(directions);
    return result;
}

aur_result aur_check_exponent(double exponent, aur_error *error) {
    return exponent >= 0.0 && exponent <= AUR_EXPONENT_MAXIMUM
               ? AUR_OK
               : aur_fail(error, AUR_ERROR_ARGUMENT,
                          "the exponent of a lobe must be between 0 and %g, not %g", AUR_EXPONENT_MAXIMUM,
                          exponent);
}

aur_result aur_check_smoothness(double smoothness, aur_error *error) {
    return aur_smoothness_in_range(smoothness)
               ? AUR_OK
               : aur_fail(error, AUR_ERROR_ARGUMENT,
                          "the smoothness must be between 1 and %g (exclusive) and, above 2, .01 away from "
                          "integers, where the kernel is a polynomial; not %g",
                          AUR_SMOOTHNESS_MAXIMUM, smoothness);
}

aur_result aur_weights_options_init(aur_weights_options *options, aur_error *error) {
    static const aur_weights_options defaults = {
        .size = sizeof defaults, .regularization = AUR_REGULARIZATION_DEFAULT, .sum_constraint = true};
    return aur_description_write(&defaults, sizeof defaults, options, "aur_weights_options", error);
}
