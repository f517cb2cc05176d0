/* Densities as point masses: importance-sampled spherical Fibonacci points (Marques 2013 eq. 4, with the
 * azimuth in fixed point). */
#include <math.h>

#include "core/vector.h"
#include "quadrature/direction.h"
#include "quadrature/potential.h"

static const uint64_t golden_fraction = UINT64_C(0x9e3779b97f4a7c15);

aur_result aur_nodes_function(const aur_density *density, double *columns, double *masses, aur_error *error) {
    const size_t count = density->node_count;
    const double m = density->exponent;
    double frame_x[3], frame_y[3];
    aur_frame3(density->axis, frame_x, frame_y);
    for (size_t i = 0; i < count; ++i) {
        const double even = ((double)i + 0.5) / (double)count;
        const double cosine = density->whole_sphere ? 1.0 - 2.0 * even : pow(1.0 - even, 1.0 / (m + 1.0));
        const double sampled =
            density->whole_sphere ? 1.0 / (4.0 * AUR_PI) : (m + 1.0) / (2.0 * AUR_PI) * pow(cosine, m);
        const double phi = 2.0 * AUR_PI * 0x1p-64 * (double)((uint64_t)i * golden_fraction);
        const double radius = sqrt(fmax(0.0, (1.0 - cosine) * (1.0 + cosine)));
        double direction[3];
        for (size_t k = 0; k < 3; ++k)
            direction[k] =
                radius * (cos(phi) * frame_x[k] + sin(phi) * frame_y[k]) + cosine * density->axis[k];
        const double value = density->function(density->user, direction);
        if (!(value >= 0.0 && isfinite(value)))
            return aur_fail(error, AUR_ERROR_ARGUMENT,
                            "the density at (%g, %g, %g) is %g: it must be finite and not negative",
                            direction[0], direction[1], direction[2], value);
        for (size_t k = 0; k < 3; ++k)
            columns[k * count + i] = direction[k];
        masses[i] = value / (sampled * (double)count);
    }
    return AUR_OK;
}
