/* No floating-point contraction, so that every instruction set gives bit-identical results. */
#include "lighting/daylight/product.h"

void AUR_KERNEL(aur_daylight_product)(size_t hours, size_t patches, const double *restrict radiance,
                                      const double *restrict coefficients, double *restrict values) {
    for (size_t first = 0; first < hours; first += AUR_DAYLIGHT_BLOCK) {
        double sums[AUR_DAYLIGHT_BLOCK][AUR_DAYLIGHT_LANES] = {{0.0}};
        for (size_t patch = 0; patch < patches; ++patch, radiance += AUR_DAYLIGHT_BLOCK)
            for (size_t hour = 0; hour < AUR_DAYLIGHT_BLOCK; ++hour)
                for (size_t lane = 0; lane < AUR_DAYLIGHT_LANES; ++lane)
                    sums[hour][lane] += radiance[hour] * coefficients[patch * AUR_DAYLIGHT_LANES + lane];
        for (size_t hour = 0; hour < AUR_DAYLIGHT_BLOCK; ++hour)
            for (size_t lane = 0; lane < AUR_DAYLIGHT_LANES; ++lane)
                values[(first + hour) * AUR_DAYLIGHT_LANES + lane] = sums[hour][lane];
    }
}
