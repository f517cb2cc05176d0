/* Densities as point masses: importance-sampled spherical Fibonacci points (Marques 2013 eq. 4). */
#include <math.h>

#include "points/base/vector.h"
#include "points/base/vector3d.h"
#include "points/quadrature/potential/potential.h"

/* Fibonacci points distributed as a lobe about +z, or uniform on the whole sphere. */
static aur_result draw(size_t count, aur_domain domain, const aur_lobe *lobe, double *columns,
                       aur_error *error) {
    aur_directions_options options = {.size = sizeof options};
    aur_directions_options_init(count, domain, &options, NULL);
    options.lobe = *lobe;
    aur_directions *directions;
    aur_result result = aur_directions_create("spherical-fibonacci", &options, &directions, error);
    if (result != AUR_OK)
        return result;
    const aur_output output = {.layout = AUR_LAYOUT_ARRAYS, .capacity = 3 * count, .doubles = columns};
    result = aur_directions_generate(directions, 0, count, &output, NULL, error);
    aur_directions_destroy(directions);
    return result;
}

aur_result aur_nodes_function(const aur_density *density, double *columns, double *masses, aur_error *error) {
    const size_t count = density->node_count;
    const bool sphere = density->whole_sphere;
    const aur_lobe lobe = {.exponent = sphere ? 0.0 : density->exponent};
    aur_result result =
        draw(count, sphere ? AUR_DOMAIN_SPHERE : AUR_DOMAIN_HEMISPHERE, &lobe, columns, error);
    if (result != AUR_OK)
        return result;
    double frame_x[3], frame_y[3];
    aur_frame3(density->axis, frame_x, frame_y);
    enum { BLOCK = 256 };
    for (size_t first = 0; first < count; first += BLOCK) {
        const size_t block = count - first < BLOCK ? count - first : BLOCK;
        double directions[3 * BLOCK], sampled[BLOCK];
        for (size_t i = 0; i < block; ++i) {
            const size_t at = first + i;
            const double local[3] = {columns[at], columns[count + at], columns[2 * count + at]};
            sampled[i] = sphere ? 1.0 / (4.0 * AUR_PI) : aur_lobe_pdf(&lobe, local);
            for (size_t k = 0; k < 3; ++k)
                columns[k * count + at] = directions[3 * i + k] =
                    local[0] * frame_x[k] + local[1] * frame_y[k] + local[2] * density->axis[k];
        }
        result = density->function(density->user, block, directions, masses + first, error);
        for (size_t i = 0; i < block && result == AUR_OK; ++i) {
            const double value = masses[first + i], *const u = directions + 3 * i;
            if (!(value >= 0.0 && isfinite(value)))
                return aur_fail(error, AUR_ERROR_ARGUMENT,
                                "the density at (%g, %g, %g) is %g: it must be finite and not negative", u[0],
                                u[1], u[2], value);
            masses[first + i] = value / (sampled[i] * (double)count);
        }
        if (result != AUR_OK)
            return result;
    }
    return AUR_OK;
}

/* Smith's Lambda of the GGX distribution for a direction with a given cosine to the normal (Heitz 2014). */
static double smith_lambda(double alpha, double cosine) {
    const double tangent2 = fmax(0.0, 1.0 - cosine * cosine) / (cosine * cosine);
    return 0.5 * (sqrt(1.0 + alpha * alpha * tangent2) - 1.0);
}

/* G2/G1 with height-correlated masking: the GGX lobe over the density of its visible normals. Below the
 * surface it is 0. */
static double unmasked(const aur_density *density, double cosine) {
    if (cosine <= 0.0)
        return 0.0;
    const double view = smith_lambda(density->alpha, cos(density->view_degrees * AUR_PI / 180.0));
    return (1.0 + view) / (1.0 + view + smith_lambda(density->alpha, cosine));
}

static aur_lobe ggx_lobe(const aur_density *density) {
    return (aur_lobe){.kind = AUR_LOBE_GGX, .alpha = density->alpha, .view_degrees = density->view_degrees};
}

aur_result aur_nodes_ggx(const aur_density *density, double *columns, double *masses, aur_error *error) {
    const size_t count = density->node_count;
    const aur_lobe lobe = ggx_lobe(density);
    const aur_result result = draw(count, AUR_DOMAIN_HEMISPHERE, &lobe, columns, error);
    for (size_t i = 0; i < count && result == AUR_OK; ++i)
        masses[i] = unmasked(density, columns[2 * count + i]) / (double)count;
    return result;
}

double aur_ggx_value(const aur_density *density, const double direction[3]) {
    const aur_lobe lobe = ggx_lobe(density);
    return aur_lobe_pdf(&lobe, direction) * unmasked(density, direction[2]);
}
