#include "lighting/daylight/coefficients.h"

#include <math.h>

#include "lighting/daylight/product.h"

enum { LANES = AUR_DAYLIGHT_LANES, MEASURES = AUR_DAYLIGHT_MEASURES };

static const double SUNLIT = 1000.0; /* lux: IES LM-83-12 */

/* The measures of one randomisation. Hours without light are below all thresholds. */
static void measure(const aur_lit_hours *lit, const aur_daylight_options *options, const double *lux,
                    const double *sun, double overcast, double *values) {
    size_t enough = 0, useful = 0, above = 0, sunny = 0;
    double part = 0.0, sum = 0.0;
    for (size_t i = 0; i < lit->count; ++i) {
        sum += lux[i];
        if (!lit->hours[i].counts)
            continue;
        const bool reached = lux[i] >= options->threshold;
        enough += reached;
        part += reached ? 1.0 : lux[i] / options->threshold;
        useful += lux[i] >= options->useful[0] && lux[i] <= options->useful[1];
        above += lux[i] > options->useful[1];
        sunny += sun[i] > SUNLIT;
    }
    const double percent = 100.0 / (double)lit->counted;
    values[AUR_DAYLIGHT_FACTOR] = 100.0 * overcast;
    values[AUR_DAYLIGHT_AUTONOMY] = percent * (double)enough;
    values[AUR_DAYLIGHT_CONTINUOUS] = percent * part;
    values[AUR_DAYLIGHT_USEFUL] = percent * (double)useful;
    values[AUR_DAYLIGHT_BELOW] = percent * (double)(lit->counted - useful - above);
    values[AUR_DAYLIGHT_ABOVE] = percent * (double)above;
    values[AUR_DAYLIGHT_SUN_HOURS] = (double)sunny;
    values[AUR_DAYLIGHT_ANNUAL] = sum;
}

/* The mean of the randomisations without `left_out`, or of all. */
static double mean_without(const double *lanes, size_t left_out) {
    double sum = 0.0;
    for (size_t k = 0; k < LANES; ++k)
        sum += k == left_out ? 0.0 : lanes[k];
    return sum / (left_out < LANES ? LANES - 1 : LANES);
}

void aur_daylight_measure_year(const aur_lit_hours *lit, const aur_daylight_options *options,
                               const aur_daylight_year *year, double *scratch, aur_daylight *found) {
    double *const lux = scratch, *const sun = scratch + lit->count;
    double values[LANES + 1][MEASURES];
    for (size_t r = 0; r <= LANES; ++r) {
        for (size_t i = 0; i < lit->count; ++i) {
            lux[i] = mean_without(year->all + LANES * i, r);
            sun[i] = mean_without(year->sun + LANES * i, r);
        }
        measure(lit, options, lux, sun, mean_without(year->overcast, r), values[r]);
    }
    for (size_t m = 0; m < MEASURES; ++m) {
        /* Relative to the first one, so that equal values have a spread of exactly 0. */
        double mean = values[0][m], squares = 0.0;
        for (size_t r = 1; r < LANES; ++r)
            mean += (values[r][m] - values[0][m]) / LANES;
        for (size_t r = 0; r < LANES; ++r)
            squares += (values[r][m] - mean) * (values[r][m] - mean);
        found->value[m] = values[LANES][m];
        found->error[m] = sqrt(squares * (LANES - 1) / LANES);
    }
}
