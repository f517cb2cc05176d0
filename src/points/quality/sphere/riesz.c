/* Riesz energies for any exponent. */
#include <math.h>

#include "points/base/error.h"
#include "points/quality/pairs/pair_sum.h"
#include "points/quality/rotations/rotations.h"
#include "points/quality/split/split.h"

/* In units of a distance computed with the widest vectors. */
enum { PAIR_COST = 8 };

static aur_twofold riesz_tile(const aur_axes *axes, aur_pair_tile tile, double exponent) {
    const int diagonal = tile.first_row == tile.first_column;
    aur_twofold total = {0.0, 0.0};
    for (size_t i = tile.first_row; i < tile.last_row; ++i) {
        const size_t last = diagonal ? i : tile.last_column;
        for (size_t j = tile.first_column; j < last; ++j) {
            const double dx = axes->x[i] - axes->x[j];
            const double dy = axes->y[i] - axes->y[j];
            const double dz = axes->z[i] - axes->z[j];
            const double square = dx * dx + dy * dy + dz * dz;
            const double weight = axes->weights != NULL ? axes->weights[i] * axes->weights[j] : 1.0;
            if (square == 0.0 && exponent >= 0.0) /* an infinity must not meet the error terms */
                return (aur_twofold){weight == 0.0 ? 0.0 : INFINITY, 0.0};
            total = aur_twofold_add(total, aur_two_product(weight, aur_split_whole(exponent, square)));
        }
    }
    return total;
}

/* The sum over unordered pairs to options.accuracy, with a bound of its error; `found` is false if the sum
 * over all pairs is required. */
static aur_result fast_sum(const aur_measure_request *request, double exponent, bool *found, aur_twofold *sum,
                           aur_error *error) {
    const double accuracy = request->options.accuracy, count = (double)request->points->count;
    *found = accuracy > 0.0 && request->points->count >= AUR_SPLIT_COUNT && aur_split_has(exponent);
    if (!*found)
        return AUR_OK;
    /* An estimate of the mean: that of the sphere, or for S >= 2 that of near points. */
    const double about = exponent == 0.0  ? 0.2
                         : exponent < 2.0 ? pow(2.0, 1.0 - exponent) / (2.0 - exponent)
                                          : pow(0.25 * count, 0.5 * exponent - 1.0);
    aur_split_mean mean;
    const aur_result result =
        aur_split_pairs(request, exponent, PAIR_COST, accuracy * about, found, &mean, error);
    if (result != AUR_OK || !*found)
        return result;
    double mass = 0.0;
    for (size_t i = 0; i < request->points->count; ++i)
        mass += aur_weight_at(request->points, i);
    const double value = mean.mean + mean.excess, pairs = 0.5 * mass * mass;
    *found = isinf(value) || mean.bound <= 0.5 * accuracy * fabs(value);
    *sum = (aur_twofold){pairs * value, 0.0};
    *request->bound = *found && isfinite(value) ? pairs * mean.bound : 0.0;
    return AUR_OK;
}

/* The sum over unordered pairs of points, the unit of their masses, and the interaction of the ends of an
 * axis. */
static aur_result sum_of_directions(const aur_measure_request *request, double exponent, double *value,
                                    aur_error *error) {
    aur_axes axes;
    aur_result result = aur_axes_create(request->points, &axes, error);
    if (result != AUR_OK)
        return result;
    aur_twofold sum = {0.0, 0.0};
    bool found = false;
    result = fast_sum(request, exponent, &found, &sum, error);
    if (result == AUR_OK && !found)
        result = aur_pair_sum(&axes, riesz_tile, exponent, &request->options, &sum, error);
    if (result == AUR_OK) {
        double scale = 2.0;
        if (axes.weights != NULL) {
            double mass = 0.0;
            for (size_t i = 0; i < axes.count; ++i)
                mass += axes.weights[i];
            const double unit = (double)axes.count / mass; /* the same for axes: twice over twice */
            scale *= unit * unit;
        }
        /* For axes each pair of ends once, without pairs of one axis. */
        if (request->points->domain == AUR_DOMAIN_AXES) {
            double squares = 0.0;
            for (size_t i = 0; i < axes.count; ++i)
                squares += axes.weights != NULL ? 0.5 * axes.weights[i] * axes.weights[i] : 0.5;
            sum = aur_twofold_add(sum, aur_two_product(-squares, aur_split_whole(exponent, 4.0)));
            scale *= 0.5;
        }
        *request->bound *= scale;
        *value = isfinite(sum.high) ? scale * (sum.high + sum.low) : INFINITY;
    }
    aur_axes_release(&axes);
    return result;
}

/* Two rotations whose nearer quaternions have this squared distance d^2; the farther ones have 4 - d^2. */
static double both_quaternions(double square, double exponent) {
    if (square == 0.0 && exponent >= 0.0)
        return INFINITY;
    return aur_split_whole(exponent, square) + aur_split_whole(exponent, 4.0 - square);
}

static aur_result riesz(const aur_measure_request *request, double *value, aur_error *error) {
    double exponent;
    aur_result result = aur_measure_number(request, -64.0, 64.0, 0.0, &exponent, error);
    if (result == AUR_OK && request->points->domain == AUR_DOMAIN_ROTATIONS) {
        result = aur_rotation_pair_sum(request, both_quaternions, exponent, value, error);
        const double count = 0.5 * (double)request->points->count;
        *value *= 2.0 * count * count;
    } else if (result == AUR_OK) {
        result = sum_of_directions(request, exponent, value, error);
    }
    if (result == AUR_OK && isinf(*value))
        aur_warn_at(&request->options.warnings, (aur_location){0},
                    "points coincide: the Riesz energy is infinite");
    return result;
}

const aur_measure_row aur_measure_riesz = {
    {.row = {.name = "riesz",
             .summary = "Riesz energy: the sum of |x_i - x_j|^-S over ordered pairs, S = 0 the logarithm of "
                        "1/|x_i - x_j|",
             .source = "Hardin and Saff 2004"},
     .parameter = ":S",
     .domains = "sphere, hemisphere, axes, rotations, caps"},
    .compute = riesz};
