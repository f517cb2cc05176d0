/* Riesz energies for any exponent. */
#include <math.h>

#include "core/error.h"
#include "quality/pairs/pair_sum.h"
#include "quality/rotations/rotations.h"

static double kernel(double square, double exponent) {
    if (exponent == 0.0)
        return -0.5 * log(square);
    if (exponent == 1.0)
        return 1.0 / sqrt(square);
    if (exponent == 2.0)
        return 1.0 / square;
    if (exponent == -1.0)
        return sqrt(square);
    return pow(square, -0.5 * exponent);
}

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
            total = aur_twofold_add(total, aur_two_product(weight, kernel(square, exponent)));
        }
    }
    return total;
}

/* The sum over unordered pairs of points, the unit of their masses, and what an axis does to its other end.
 */
static aur_result sum_of_directions(const aur_measure_request *request, double exponent, double *value,
                                    aur_error *error) {
    aur_axes axes;
    aur_result result = aur_axes_create(request->points, &axes, error);
    if (result != AUR_OK)
        return result;
    aur_twofold sum = {0.0, 0.0};
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
        /* Of axes each pair of ends once, and no axis against itself. */
        if (request->points->domain == AUR_DOMAIN_AXES) {
            double squares = 0.0;
            for (size_t i = 0; i < axes.count; ++i)
                squares += axes.weights != NULL ? 0.5 * axes.weights[i] * axes.weights[i] : 0.5;
            sum = aur_twofold_add(sum, aur_two_product(-squares, kernel(4.0, exponent)));
            scale *= 0.5;
        }
        *value = isfinite(sum.high) ? scale * (sum.high + sum.low) : INFINITY;
    }
    aur_axes_release(&axes);
    return result;
}

/* Of two rotations whose nearer quaternions have this squared distance: the farther ones have the rest of 4.
 */
static double both_quaternions(double square, double exponent) {
    if (square == 0.0 && exponent >= 0.0)
        return INFINITY;
    return kernel(square, exponent) + kernel(4.0 - square, exponent);
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
     .domains = "sphere, hemisphere, axes, rotations"},
    .compute = riesz};
