/* Densities as point masses: importance-sampled spherical Fibonacci points (Marques 2013 eq. 4, with the
 * azimuth in fixed point). */
#include <math.h>

#include "core/vector.h"
#include "core/vector3d.h"
#include "quadrature/potential/potential.h"

/* Point i of `count` even ones on the hemisphere about +z, or on the whole sphere. */
static void even_direction(size_t i, size_t count, int whole_sphere, double direction[3]) {
    const uint64_t golden_fraction = UINT64_C(0x9e3779b97f4a7c15);
    const double depth = ((double)i + 0.5) / (double)count;
    const double cosine = whole_sphere ? 1.0 - 2.0 * depth : 1.0 - depth;
    const double phi = 2.0 * AUR_PI * 0x1p-64 * (double)((uint64_t)i * golden_fraction);
    const double radius = sqrt(fmax(0.0, (1.0 - cosine) * (1.0 + cosine)));
    direction[0] = radius * cos(phi);
    direction[1] = radius * sin(phi);
    direction[2] = cosine;
}

aur_result aur_nodes_function(const aur_density *density, double *columns, double *masses, aur_error *error) {
    const size_t count = density->node_count;
    const aur_lobe lobe = {.kind = AUR_LOBE_COSINE_POWER, .exponent = density->exponent};
    double frame_x[3], frame_y[3];
    aur_frame3(density->axis, frame_x, frame_y);
    for (size_t i = 0; i < count; ++i) {
        double local[3], direction[3];
        even_direction(i, count, density->whole_sphere, local);
        double sampled = 1.0 / (4.0 * AUR_PI);
        if (!density->whole_sphere) {
            aur_lobe_warp(&lobe, local, local);
            sampled = aur_lobe_pdf(&lobe, local);
        }
        for (size_t k = 0; k < 3; ++k)
            direction[k] = local[0] * frame_x[k] + local[1] * frame_y[k] + local[2] * density->axis[k];
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

/* Smith's Lambda of the GGX distribution for a direction whose cosine to the normal is given (Heitz 2014). */
static double smith_lambda(double alpha, double cosine) {
    const double tangent2 = fmax(0.0, 1.0 - cosine * cosine) / (cosine * cosine);
    return 0.5 * (sqrt(1.0 + alpha * alpha * tangent2) - 1.0);
}

/* G2/G1 with height-correlated masking: the GGX lobe over the density of its visible normals. Below the
 * surface it is 0. */
static double unmasked(const aur_density *density, const double direction[3]) {
    if (direction[2] <= 0.0)
        return 0.0;
    const double view = smith_lambda(density->alpha, cos(density->view_degrees * AUR_PI / 180.0));
    return (1.0 + view) / (1.0 + view + smith_lambda(density->alpha, direction[2]));
}

static aur_lobe ggx_lobe(const aur_density *density) {
    return (aur_lobe){.kind = AUR_LOBE_GGX, .alpha = density->alpha, .view_degrees = density->view_degrees};
}

aur_result aur_nodes_ggx(const aur_density *density, double *columns, double *masses, aur_error *error) {
    const size_t count = density->node_count;
    const aur_lobe lobe = ggx_lobe(density);
    const aur_result result = aur_lobe_check(&lobe, error);
    if (result != AUR_OK)
        return result;
    for (size_t i = 0; i < count; ++i) {
        double direction[3];
        even_direction(i, count, 0, direction);
        aur_lobe_warp(&lobe, direction, direction);
        for (size_t k = 0; k < 3; ++k)
            columns[k * count + i] = direction[k];
        masses[i] = unmasked(density, direction) / (double)count;
    }
    return AUR_OK;
}

double aur_ggx_value(const aur_density *density, const double direction[3]) {
    const aur_lobe lobe = ggx_lobe(density);
    return aur_lobe_pdf(&lobe, direction) * unmasked(density, direction);
}
