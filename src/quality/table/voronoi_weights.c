/* Areas of Voronoi cells as weights. */
#include <aureole/quality.h>

#include "core/error.h"

aur_result aur_weights_voronoi(size_t count, const double *xyz, aur_domain domain, const aur_lobe *lobe,
                               const aur_measure_options *options, size_t capacity, double *weights,
                               aur_error *error) {
    const aur_lobe uniform = {.kind = AUR_LOBE_COSINE_POWER};
    const aur_lobe *const density = lobe != NULL ? lobe : &uniform;
    if (domain != AUR_DOMAIN_SPHERE && domain != AUR_DOMAIN_HEMISPHERE)
        return aur_fail(error, AUR_ERROR_UNSUPPORTED, "areas of cells are for the sphere and the hemisphere");
    if (density->kind != AUR_LOBE_COSINE_POWER || (domain == AUR_DOMAIN_SPHERE && density->exponent != 0.0))
        return aur_fail(
            error, AUR_ERROR_UNSUPPORTED,
            "areas of cells are for the uniform lobe, and on the hemisphere for cosine and phong:M");
    if (capacity < count)
        return aur_fail(error, AUR_ERROR_CAPACITY, "there is room for %zu weights, not for %zu", capacity,
                        count);
    aur_result result = aur_lobe_check(density, error);
    if (result != AUR_OK)
        return result;
    const aur_points_view view = aur_points_view_of(domain, count, 3, xyz);
    aur_series *cells;
    result = aur_measure_series("voronoi", &view, options, &cells, error);
    if (result != AUR_OK)
        return result;
    const double *const values = aur_series_values(cells);
    const size_t columns = aur_series_column_count(cells);
    enum { AREA = 1 };
    double sum = 0.0;
    for (size_t i = 0; i < count; ++i) {
        weights[i] = values[i * columns + AREA];
        if (domain == AUR_DOMAIN_HEMISPHERE)
            weights[i] *= aur_lobe_pdf(density, xyz + 3 * i);
        sum += weights[i];
    }
    for (size_t i = 0; i < count; ++i)
        weights[i] /= sum;
    aur_series_destroy(cells);
    return AUR_OK;
}
