#include <math.h>

#include "core/error.h"
#include "quadrature/direction.h"
#include "quadrature/potential.h"

static double square(double x) {
    return x * x;
}

/* The density that a strategy draws a direction with. */
static double drawn_density(const aur_strategy *strategy, const double direction[3]) {
    const double *const axis = strategy->axis;
    if (strategy->sampled.kind == AUR_LOBE_GGX || (axis[0] == 0.0 && axis[1] == 0.0 && axis[2] == 0.0))
        return aur_lobe_pdf(&strategy->sampled, direction);
    /* A cos^m lobe asks for the angle to its axis only. */
    const double cosine = aur_dot3(direction, axis);
    const double local[3] = {sqrt(fmax(0.0, 1.0 - cosine * cosine)), 0.0, cosine};
    return aur_lobe_pdf(&strategy->sampled, local);
}

/* How much of the sample is the strategy's own, over the density that it was drawn from: h/(n q). */
static double share(aur_mis_heuristic heuristic, size_t strategy_count, const aur_strategy *strategies,
                    size_t own, const double direction[3]) {
    double all = 0.0, mine = 0.0;
    for (size_t t = 0; t < strategy_count; ++t) {
        const double drawn = (double)strategies[t].count * drawn_density(&strategies[t], direction);
        all += heuristic == AUR_MIS_POWER ? square(drawn) : drawn;
        mine = t == own ? drawn : mine;
    }
    return (heuristic == AUR_MIS_POWER ? mine : 1.0) / all;
}

aur_result aur_mis_weights(aur_mis_heuristic heuristic, size_t strategy_count, const aur_strategy *strategies,
                           const aur_potential *target, const double *xyz, double *weights,
                           aur_error *error) {
    size_t at = 0;
    for (size_t t = 0; t < strategy_count; ++t) {
        for (size_t i = 0; i < strategies[t].count; ++i, ++at) {
            const double *const u = xyz + 3 * at;
            const double value = aur_potential_density(target, u);
            weights[at] = value == 0.0 ? 0.0 : value * share(heuristic, strategy_count, strategies, t, u);
            if (!isfinite(weights[at]))
                return aur_fail(error, AUR_ERROR_ARGUMENT,
                                "sample %zu has no density of its own: its strategy cannot have drawn it",
                                at);
        }
    }
    return AUR_OK;
}

aur_result aur_weights_reweight(const aur_potential *wanted, const aur_potential *fitted, size_t count,
                                const double *xyz, double *weights, aur_error *error) {
    for (size_t i = 0; i < count; ++i) {
        if (weights[i] == 0.0)
            continue;
        weights[i] *= aur_potential_density(wanted, xyz + 3 * i) / aur_potential_density(fitted, xyz + 3 * i);
        if (!isfinite(weights[i]))
            return aur_fail(error, AUR_ERROR_ARGUMENT, "sample %zu: the fitted density is zero there", i);
    }
    return AUR_OK;
}
