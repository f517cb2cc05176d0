/* Annual measures of synthetic illuminances: shares by counting hours, and errors of linear measures. */
#include <aureole/statistics.h>

#include "check.h"
#include "lighting/daylight/coefficients.h"
#include "lighting/daylight/product.h"
#include "points/base/random.h"

enum { LANES = AUR_DAYLIGHT_LANES, HOURS = 500 };

typedef struct year_of {
    aur_lit_hour hours[HOURS];
    double all[HOURS * LANES], sun[HOURS * LANES], overcast[LANES];
} year_of;

/* From 0 to 4000 lux, some of the sun, most hours within the schedule. Randomisations differ by a tenth. */
static void make_year(uint64_t seed, year_of *year) {
    for (size_t i = 0; i < HOURS; ++i) {
        year->hours[i] = (aur_lit_hour){.hour = i, .counts = aur_hash3(seed, 1, i) % 4 != 0};
        const double lux = 4000.0 * pow(aur_unit_double(aur_hash3(seed, 2, i)), 2.0);
        for (size_t k = 0; k < LANES; ++k) {
            year->all[LANES * i + k] = lux * (0.95 + 0.1 * aur_unit_double(aur_hash4(seed, 3, i, k)));
            year->sun[LANES * i + k] = 0.5 * year->all[LANES * i + k];
        }
    }
    for (size_t k = 0; k < LANES; ++k)
        year->overcast[k] = 0.02 + 0.01 * aur_unit_double(aur_hash3(seed, 4, k));
}

static double mean_of(const double *lanes) {
    double sum = 0.0;
    for (size_t k = 0; k < LANES; ++k)
        sum += lanes[k] / LANES;
    return sum;
}

static aur_daylight measured(const year_of *year, size_t counted) {
    static double scratch[2 * HOURS];
    const aur_lit_hours lit = {.count = HOURS, .counted = counted, .hours = (aur_lit_hour *)year->hours};
    aur_daylight_options options = {.size = sizeof options};
    aur_daylight_options_init(&options, NULL);
    options.threshold = 300.0;
    options.useful[0] = 100.0;
    options.useful[1] = 2000.0;
    const aur_daylight_year rows = {year->all, year->sun, year->overcast};
    aur_daylight found = {0};
    aur_daylight_measure_year(&lit, &options, &rows, scratch, &found);
    return found;
}

/* Of 600 hours that count some 375 are lit. */
static void test_shares(void **state) {
    (void)state;
    static year_of year;
    const double counted = 600.0;
    make_year(1, &year);
    const aur_daylight found = measured(&year, 600);
    double enough = 0.0, part = 0.0, useful = 0.0, above = 0.0, sunny = 0.0, sum = 0.0;
    for (size_t i = 0; i < HOURS; ++i) {
        const double lux = mean_of(year.all + LANES * i), one = year.hours[i].counts ? 1.0 : 0.0;
        sum += lux;
        enough += lux >= 300.0 ? one : 0.0;
        part += one * fmin(lux / 300.0, 1.0);
        useful += lux >= 100.0 && lux <= 2000.0 ? one : 0.0;
        above += lux > 2000.0 ? one : 0.0;
        sunny += mean_of(year.sun + LANES * i) > 1000.0 ? one : 0.0; /* IES LM-83-12 */
    }
    assert_true(above > 20.0 && sunny > 20.0 && useful > 100.0 && part > enough + 10.0);
    assert_relative(found.value[AUR_DAYLIGHT_ANNUAL], sum, 1e-12);
    assert_relative(found.value[AUR_DAYLIGHT_FACTOR], 100.0 * mean_of(year.overcast), 1e-12);
    assert_relative(found.value[AUR_DAYLIGHT_AUTONOMY], 100.0 * enough / counted, 1e-12);
    assert_relative(found.value[AUR_DAYLIGHT_CONTINUOUS], 100.0 * part / counted, 1e-12);
    assert_relative(found.value[AUR_DAYLIGHT_USEFUL], 100.0 * useful / counted, 1e-12);
    assert_relative(found.value[AUR_DAYLIGHT_ABOVE], 100.0 * above / counted, 1e-12);
    assert_relative(found.value[AUR_DAYLIGHT_BELOW], 100.0 * (1.0 - (useful + above) / counted), 1e-12);
    assert_relative(found.value[AUR_DAYLIGHT_SUN_HOURS], sunny, 1e-12);
}

/* For linear measures the jackknife's error is the standard error of the mean. */
static void test_linear_errors(void **state) {
    (void)state;
    static year_of year;
    make_year(2, &year);
    const aur_daylight found = measured(&year, 600);
    aur_moments annual = {0}, factor = {0};
    for (size_t k = 0; k < LANES; ++k) {
        double sum = 0.0;
        for (size_t i = 0; i < HOURS; ++i)
            sum += year.all[LANES * i + k];
        aur_moments_add(&annual, sum);
        aur_moments_add(&factor, 100.0 * year.overcast[k]);
    }
    assert_relative(found.error[AUR_DAYLIGHT_ANNUAL], aur_moments_standard_error(&annual), 1e-9);
    assert_relative(found.error[AUR_DAYLIGHT_FACTOR], aur_moments_standard_error(&factor), 1e-9);
}

/* Hours at a threshold that randomisations straddle: the errors of shares are not below their spread over
 * years. The standard deviation over 400 years errs by 3.5 %, and three times that is allowed. A jackknife of
 * counts errs to the safe side. */
static void test_spread_of_shares(void **state) {
    (void)state;
    enum { YEARS = 400 };
    static year_of year;
    aur_moments shares[2] = {0};
    double squares[2] = {0.0};
    static const size_t measures[2] = {AUR_DAYLIGHT_CONTINUOUS, AUR_DAYLIGHT_AUTONOMY};
    make_year(3, &year);
    for (uint64_t y = 0; y < YEARS; ++y) {
        for (size_t i = 0; i < HOURS; ++i)
            for (size_t k = 0; k < LANES; ++k)
                year.all[LANES * i + k] =
                    250.0 + 0.2 * (double)i + 400.0 * (aur_unit_double(aur_hash4(4, y, i, k)) - 0.5);
        const aur_daylight found = measured(&year, HOURS);
        for (size_t m = 0; m < 2; ++m) {
            aur_moments_add(&shares[m], found.value[measures[m]]);
            squares[m] += found.error[measures[m]] * found.error[measures[m]] / YEARS;
        }
    }
    for (size_t m = 0; m < 2; ++m) {
        const double ratio = sqrt(squares[m] / aur_moments_variance(&shares[m]));
        print_message("error over spread: %.3f\n", ratio);
        assert_true(ratio > 0.9);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_shares),
        cmocka_unit_test(test_linear_errors),
        cmocka_unit_test(test_spread_of_shares),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
