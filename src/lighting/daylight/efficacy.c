#include "lighting/daylight/efficacy.h"

#include <math.h>

/* a, b, c, d of each class of clearness. */
static const double sky_rows[8][4] = {{97.24, -0.46, 12.00, -8.91},   {107.22, 1.15, 0.59, -3.95},
                                      {104.97, 2.96, -5.53, -8.77},   {102.39, 5.59, -13.95, -13.90},
                                      {100.71, 5.94, -22.75, -23.74}, {106.42, 3.83, -36.15, -28.83},
                                      {141.88, 1.90, -53.24, -14.03}, {152.23, 0.35, -45.27, -7.98}};
static const double sun_rows[8][4] = {{57.20, -4.55, -2.98, 117.12}, {98.99, -3.46, -1.21, 12.38},
                                      {109.83, -4.90, -1.71, -8.81}, {110.34, -5.84, -1.99, -4.56},
                                      {106.36, -3.97, -1.75, -6.16}, {107.19, -1.25, -1.51, -26.73},
                                      {105.75, 0.77, -1.26, -34.44}, {101.18, 1.58, -1.10, -8.29}};

double aur_efficacy_of_sky(const aur_perez_conditions *conditions, double water) {
    const double *const row = sky_rows[conditions->category];
    return fmax(row[0] + row[1] * water + row[2] * cos(conditions->zenith) +
                    row[3] * log(conditions->brightness),
                0.0);
}

double aur_efficacy_of_sun(const aur_perez_conditions *conditions, double water) {
    const double *const row = sun_rows[conditions->category];
    return fmax(row[0] + row[1] * water + row[2] * exp(5.73 * conditions->zenith - 5.0) +
                    row[3] * conditions->brightness,
                0.0);
}

double aur_precipitable_water(double dew_point) {
    return isnan(dew_point) ? 2.0 : exp(0.07 * dew_point - 0.075);
}
