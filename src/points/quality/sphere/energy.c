/* The distance energy and its published normalisations. */
#include <aureole/statistics.h>
#include <float.h>
#include <math.h>

#include "points/base/error.h"
#include "points/quality/pairs/pair_sum.h"
#include "points/quality/rotations/rotations.h"
#include "points/quality/sphere/fibonacci_sum.h"
#include "points/quality/split/split.h"

/* From this count on the sum by lags is faster than the sum over pairs. */
enum { STRUCTURED_COUNT = 2048 };

static aur_twofold mass_of(const aur_axes *axes) {
    aur_twofold mass = {(double)axes->count, 0.0};
    if (axes->weights == NULL)
        return mass;
    mass.high = 0.0;
    for (size_t i = 0; i < axes->count; ++i)
        mass = aur_twofold_add(mass, (aur_twofold){axes->weights[i], 0.0});
    return mass;
}

/* Twice the mass times the sum of w_i P(x_i), less mass^2 times the mean distance of two points. */
static aur_twofold hemisphere_means(const aur_axes *axes, aur_twofold mass) {
    aur_twofold potential = {0.0, 0.0};
    for (size_t i = 0; i < axes->count; ++i) {
        const double weight = axes->weights != NULL ? axes->weights[i] : 1.0;
        potential = aur_twofold_add(potential, aur_two_product(weight, aur_hemisphere_potential(axes->z[i])));
    }
    const aur_twofold first = aur_twofold_scale(aur_twofold_multiply(mass, potential), 2.0);
    const aur_twofold second = aur_twofold_scale(
        aur_twofold_multiply(aur_twofold_multiply(mass, mass), aur_hemisphere_mean_distance()), -1.0);
    return aur_twofold_add(first, second);
}

/* A practical lower bound of E^2, from the mean distances of some points. No set of N equal weights is known
 * to have a lower E^2 N^(3/2) than .79 (Brauchart, Hardin and Saff 2012), .6 on the hemisphere. */
static double foreseen_square(const aur_axes *axes, aur_domain domain) {
    enum { SAMPLES = 64 };
    const double least = 0.5 * pow((double)axes->count, -1.5);
    if (axes->weights != NULL || domain == AUR_DOMAIN_HEMISPHERE)
        return least;
    aur_moments means = {0};
    for (size_t s = 0; s < SAMPLES; ++s) {
        const size_t i = axes->count * s / SAMPLES;
        double sum = 0.0;
        for (size_t j = 0; j < axes->count; ++j) {
            const double dx = axes->x[i] - axes->x[j], dy = axes->y[i] - axes->y[j],
                         dz = axes->z[i] - axes->z[j];
            sum += sqrt(dx * dx + dy * dy + dz * dz);
        }
        aur_moments_add(&means, 4.0 / 3.0 - sum / (double)axes->count);
    }
    return fmax(means.mean - 4.0 * aur_moments_standard_error(&means), least);
}

/* To options.accuracy. */
static aur_result fast_square(const aur_measure_request *request, const aur_axes *axes, bool *found,
                              double *square, aur_error *error) {
    const double accuracy = request->options.accuracy;
    const double tolerance = 2.0 * accuracy * foreseen_square(axes, request->points->domain);
    aur_split_mean sum;
    const aur_result result = aur_split_pairs(request, -1.0, 1.0, tolerance, found, &sum, error);
    if (result != AUR_OK || !*found)
        return result;
    *square = -sum.excess;
    if (request->points->domain == AUR_DOMAIN_HEMISPHERE) {
        const aur_twofold mass = mass_of(axes), means = hemisphere_means(axes, mass);
        *square += (means.high + means.low) / (mass.high * mass.high) - sum.mean;
        sum.bound += 2.0 * DBL_EPSILON;
    }
    *found = sum.bound <= 2.0 * accuracy * (1.0 - accuracy) * *square;
    *request->bound = *found ? sum.bound : 0.0;
    return AUR_OK;
}

/* E^2: on the sphere 4/3 - S/N^2, on the hemisphere 2 mean_i P(x_i) - 32/(9 pi) - S/N^2. */
static aur_result square_energy(const aur_measure_request *request, double *square, aur_error *error) {
    aur_axes axes;
    aur_result result = aur_axes_create(request->points, &axes, error);
    if (result != AUR_OK)
        return result;
    const bool structured = axes.count >= STRUCTURED_COUNT && aur_is_spherical_fibonacci(request->points);
    bool found = false;
    if (!structured && axes.count >= AUR_SPLIT_COUNT && request->options.accuracy > 0.0)
        result = fast_square(request, &axes, &found, square, error);
    if (result != AUR_OK || found) {
        aur_axes_release(&axes);
        return result;
    }
    aur_twofold sum;
    if (structured)
        result =
            aur_fibonacci_distance_sum(axes.count, request->points->domain, &request->options, &sum, error);
    else
        result = aur_distance_sum(&axes, &request->options, &sum, error);
    if (result == AUR_OK) {
        const aur_twofold mass = mass_of(&axes);
        const aur_twofold mean =
            request->points->domain == AUR_DOMAIN_HEMISPHERE
                ? hemisphere_means(&axes, mass)
                : aur_twofold_multiply(aur_twofold_multiply(mass, mass), aur_twofold_ratio(4.0, 3.0));
        const aur_twofold difference = aur_twofold_add(mean, aur_twofold_scale(sum, -2.0));
        *square = fmax((difference.high + difference.low) / (mass.high * mass.high), 0.0);
    }
    aur_axes_release(&axes);
    return result;
}

/* The published names divide E^2 by the row's variant. */
static aur_result energy(const aur_measure_request *request, double *value, aur_error *error) {
    double square = 0.0;
    const aur_result result = request->points->domain == AUR_DOMAIN_ROTATIONS
                                  ? aur_rotation_energy(request, &square, error)
                                  : square_energy(request, &square, error);
    *value = sqrt(square / (double)request->variant);
    /* sqrt(E^2 - b) is farther from E than sqrt(E^2 + b). */
    if (*request->bound > 0.0)
        *request->bound = *value - sqrt((square - *request->bound) / (double)request->variant);
    return result;
}

const aur_measure_row aur_measure_energy = {
    {.row = {.name = "energy",
             .summary = "distance energy E_N: the worst-case error for the kernel of distances",
             .source = "Marques 2013 eq. 3; on the hemisphere with the mean-distance potential"},
     .domains = "sphere, hemisphere, axes, rotations"},
    .variant = 1,
    .compute = energy};

const aur_measure_row aur_measure_scd = {
    {.row = {.name = "scd",
             .summary = "spherical cap discrepancy as E-SFG has it: energy / sqrt 2",
             .source = "Marques 2019 eq. 57"},
     .domains = "sphere, hemisphere, axes"},
    .variant = 2,
    .compute = energy};

const aur_measure_row aur_measure_l2_cap = {
    {.row = {.name = "l2-cap",
             .summary = "L2 discrepancy of spherical caps, heights by dt: energy / 2",
             .source = "Stolarsky 1973"},
     .domains = "sphere, hemisphere, axes"},
    .variant = 4,
    .compute = energy};

const aur_measure_row aur_measure_l2_cap_mean = {
    {.row = {.name = "l2-cap-mean",
             .summary = "root mean square discrepancy of caps, heights by dt/2: energy / sqrt 8",
             .source = "Stolarsky 1973"},
     .domains = "sphere, hemisphere, axes"},
    .variant = 8,
    .compute = energy};
