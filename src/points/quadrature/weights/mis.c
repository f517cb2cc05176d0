#include <math.h>
#include <stdbool.h>
#include <stdint.h>

#include "points/base/error.h"
#include "points/base/vector3d.h"
#include "points/quadrature/potential/potential.h"
#include "points/sphere/lobe.h"

/* The sampling pdf of a direction by a strategy. */
static double drawn_density(const aur_strategy *strategy, const double direction[3]) {
    const double *const axis = strategy->axis;
    if (aur_lobe_reflects(&strategy->sampled) || aur_is_default_axis(axis))
        return aur_lobe_pdf(&strategy->sampled, direction);
    /* A cos^m lobe depends only on the angle to its axis. */
    const double cosine = aur_dot3(direction, axis);
    const double local[3] = {sqrt(fmax(0.0, 1.0 - cosine * cosine)), 0.0, cosine};
    return aur_lobe_pdf(&strategy->sampled, local);
}

/* The MIS weight of the strategy divided by its pdf: h/(n q). */
static double share(aur_mis_heuristic heuristic, size_t strategy_count, const aur_strategy *strategies,
                    size_t drawn_by, const double direction[3]) {
    double all = 0.0, mine = 0.0;
    for (size_t t = 0; t < strategy_count; ++t) {
        const double drawn = (double)strategies[t].count * drawn_density(&strategies[t], direction);
        all += heuristic == AUR_MIS_POWER ? drawn * drawn : drawn;
        mine = t == drawn_by ? drawn : mine;
    }
    return (heuristic == AUR_MIS_POWER ? mine : 1.0) / all;
}

static aur_result check_strategies(aur_mis_heuristic heuristic, size_t strategy_count,
                                   const aur_strategy *strategies, const aur_potential *target, size_t count,
                                   aur_error *error) {
    if (heuristic != AUR_MIS_BALANCE && heuristic != AUR_MIS_POWER)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "no such heuristic: %d", (int)heuristic);
    if (target->density.kind == AUR_DENSITY_NODES)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "point masses have no density to weigh samples by");
    size_t left = count; /* samples not assigned to a strategy yet */
    for (size_t t = 0; t < strategy_count && left != SIZE_MAX; ++t) {
        const aur_strategy *const strategy = &strategies[t];
        const aur_result result = aur_lobe_check(&strategy->sampled, error);
        if (result != AUR_OK)
            return result;
        if (!aur_is_default_axis(strategy->axis) && !aur_is_unit(strategy->axis))
            return aur_fail(error, AUR_ERROR_ARGUMENT,
                            "the axis (%g, %g, %g) of strategy %zu is not a unit vector", strategy->axis[0],
                            strategy->axis[1], strategy->axis[2], t);
        left = strategy->count <= left ? left - strategy->count : SIZE_MAX;
    }
    return left == 0 ? AUR_OK
                     : aur_fail(error, AUR_ERROR_ARGUMENT,
                                "the strategies' samples must be as many as the weights, %zu", count);
}

aur_result aur_mis_weights(aur_mis_heuristic heuristic, size_t strategy_count, const aur_strategy *strategies,
                           const aur_potential *target, size_t count, const double *xyz, double *weights,
                           aur_error *error) {
    const aur_result result = check_strategies(heuristic, strategy_count, strategies, target, count, error);
    if (result != AUR_OK)
        return result;
    size_t at = 0;
    for (size_t t = 0; t < strategy_count; ++t) {
        for (size_t i = 0; i < strategies[t].count; ++i, ++at) {
            const double *const u = xyz + 3 * at;
            double value;
            const aur_result evaluated = aur_potential_density(target, 1, u, &value, error);
            if (evaluated != AUR_OK)
                return evaluated;
            weights[at] = value == 0.0 ? 0.0 : value * share(heuristic, strategy_count, strategies, t, u);
            if (!isfinite(weights[at]))
                return aur_fail(error, AUR_ERROR_ARGUMENT,
                                "sample %zu has density 0 under its own strategy, which cannot have drawn it",
                                at);
        }
    }
    return AUR_OK;
}

aur_result aur_weights_reweight(const aur_potential *target, const aur_potential *fitted, size_t count,
                                const double *xyz, double *weights, aur_error *error) {
    if (target->density.kind == AUR_DENSITY_NODES || fitted->density.kind == AUR_DENSITY_NODES)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "point masses have no density to weigh samples by");
    for (size_t i = 0; i < count; ++i) {
        if (weights[i] == 0.0)
            continue;
        double values[2];
        aur_result result = aur_potential_density(target, 1, xyz + 3 * i, &values[0], error);
        if (result == AUR_OK)
            result = aur_potential_density(fitted, 1, xyz + 3 * i, &values[1], error);
        if (result != AUR_OK)
            return result;
        weights[i] *= values[0] / values[1];
        if (!isfinite(weights[i]))
            return aur_fail(error, AUR_ERROR_ARGUMENT, "sample %zu: the fitted density is zero there", i);
    }
    return AUR_OK;
}
