/* Areas of Voronoi cells as weights. */
#include <aureole/quality.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/error.h"
#include "points/quadrature/potential/potential.h"
#include "points/sphere/lobe.h"

/* The density at a point, up to a factor; the whole sphere's is 1. */
static double value_at(const aur_lobe *lobe, aur_domain domain, const double direction[3]) {
    if (domain != AUR_DOMAIN_HEMISPHERE)
        return 1.0;
    if (lobe->kind != AUR_LOBE_GGX)
        return aur_lobe_pdf(lobe, direction);
    const aur_density density = {
        .kind = AUR_DENSITY_GGX, .alpha = lobe->alpha, .view_degrees = lobe->view_degrees};
    return aur_ggx_value(&density, direction);
}

/* Sets weights[i] to the area of the cell of xyz[3 * i] times the density at the point, for `count` points
 * above the surface, and *sum to their sum. */
static aur_result weigh(size_t count, const double *xyz, aur_domain domain, const aur_lobe *lobe,
                        const aur_measure_options *options, double *weights, double *sum, aur_error *error) {
    const aur_points_view view = aur_points_view_of(domain, count, 3, xyz);
    aur_series *cells;
    const aur_result result = aur_measure_series("voronoi", &view, options, &cells, error);
    if (result != AUR_OK)
        return result;
    const double *const values = aur_series_values(cells);
    const size_t columns = aur_series_column_count(cells);
    enum { AREA = 1 };
    *sum = 0.0;
    for (size_t i = 0; i < count; ++i) {
        weights[i] = values[i * columns + AREA] * value_at(lobe, domain, xyz + 3 * i);
        *sum += weights[i];
    }
    aur_series_destroy(cells);
    return AUR_OK;
}

aur_result aur_weights_voronoi(size_t count, const double *xyz, aur_domain domain, const aur_lobe *lobe,
                               const aur_measure_options *options, size_t capacity, double *weights,
                               aur_error *error) {
    const aur_lobe uniform = {.kind = AUR_LOBE_COSINE_POWER};
    const aur_lobe *const density = lobe != NULL ? lobe : &uniform;
    const bool ggx = density->kind == AUR_LOBE_GGX;
    if (domain != AUR_DOMAIN_SPHERE && domain != AUR_DOMAIN_HEMISPHERE && domain != AUR_DOMAIN_AXES)
        return aur_fail(error, AUR_ERROR_UNSUPPORTED,
                        "areas of cells are for the sphere, the hemisphere and axes, not for the domain '%s'",
                        aur_domain_name(domain));
    if (density->kind == AUR_LOBE_VISIBLE)
        return aur_fail(error, AUR_ERROR_UNSUPPORTED,
                        "weights are for the light that is reflected, ggx:ALPHA:VIEW, not for visible "
                        "normals, which are for "
                        "points");
    if (domain != AUR_DOMAIN_HEMISPHERE && (ggx || density->exponent != 0.0))
        return aur_fail(error, AUR_ERROR_UNSUPPORTED,
                        "areas of cells of the whole sphere and of axes are for the uniform lobe");
    aur_measure_options copy = {.size = sizeof copy};
    aur_measure_options_init(&copy, NULL);
    aur_result result = aur_options_read(options, sizeof copy, &copy, "aur_measure_options", error);
    if (result != AUR_OK)
        return result;
    if (copy.cap_degrees > 0.0 && (ggx || density->exponent != 0.0))
        return aur_fail(error, AUR_ERROR_UNSUPPORTED, "a lobe is for the whole hemisphere, not for a cap");
    if (capacity < count)
        return aur_fail(error, AUR_ERROR_CAPACITY, "there is room for %zu weights, not for %zu", capacity,
                        count);
    result = aur_lobe_check(density, error);
    if (result != AUR_OK)
        return result;
    double *const above = malloc((4 * count + 1) * sizeof *above);
    if (above == NULL)
        return aur_fail_memory(error);
    double *const found = above + 3 * count, sum = 0.0;
    size_t used = 0;
    for (size_t i = 0; i < count; ++i)
        if (!ggx || !(xyz[3 * i + 2] < 0.0))
            memcpy(above + 3 * used++, xyz + 3 * i, 3 * sizeof *xyz);
    result = used == 0 && count > 0 ? aur_fail(error, AUR_ERROR_ARGUMENT, "no point lies above the surface")
                                    : weigh(used, above, domain, density, options, found, &sum, error);
    used = 0;
    for (size_t i = 0; i < count && result == AUR_OK; ++i)
        weights[i] = ggx && xyz[3 * i + 2] < 0.0 ? 0.0 : found[used++] / sum;
    free(above);
    return result;
}
