#include "quadrature/check.h"

#include <math.h>

#include "core/vector.h"
#include "core/vector3d.h"

aur_result aur_check_directions(size_t count, const double *xyz, aur_error *error) {
    for (size_t i = 0; i < count; ++i) {
        const double *const u = xyz + 3 * i;
        if (!aur_is_unit(u))
            return aur_fail(error, AUR_ERROR_ARGUMENT, "point %zu, (%g, %g, %g), is not a unit vector", i,
                            u[0], u[1], u[2]);
    }
    return AUR_OK;
}

aur_result aur_check_capacity(size_t needed, size_t capacity, aur_error *error) {
    return needed <= capacity ? AUR_OK
                              : aur_fail(error, AUR_ERROR_CAPACITY,
                                         "there is room for %zu numbers, not for %zu", capacity, needed);
}

aur_result aur_check_angle(double radians, aur_error *error) {
    return radians >= 0.0 && radians <= 0.5 * AUR_PI + 1e-9
               ? AUR_OK
               : aur_fail(error, AUR_ERROR_ARGUMENT, "the angle must be between 0 and pi/2, not %g", radians);
}
