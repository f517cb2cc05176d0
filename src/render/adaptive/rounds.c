#include "render/adaptive/candidate.h"

#include <math.h>

/* The number of samples of a pixel at which one more saves as much variance as it costs; `spending` is one
 * over the root of the price. */
static double samples_at(double spending, double variance, uint32_t samples) {
    return fmax(spending * sqrt(variance * samples), samples);
}

/* The spending at which the sum of variances becomes `factor` of the current one. Targets above the current
 * samples change a variance to min(variance, root(variance x targets) / spending). So the sum is concave in
 * one over the spending, with a corner for each pixel. Newton's steps from 0 stay below the solution and end
 * there, when no pixel passes its corner any more. */
static double spending_to(size_t count, const double *variances, double factor, const uint32_t *targets) {
    double goal = 0.0;
    for (size_t i = 0; i < count; ++i)
        goal += factor * variances[i];
    double slack = 0.0; /* one over the spending */
    for (bool moves = goal > 0.0; moves;) {
        double fixed = 0.0, slope = 0.0;
        for (size_t i = 0; i < count; ++i) {
            const double root = sqrt(variances[i] * targets[i]);
            const bool spends = slack * root < variances[i];
            fixed += spends ? 0.0 : variances[i];
            slope += spends ? root : 0.0;
        }
        const double next = slope > 0.0 ? (goal - fixed) / slope : slack;
        const double close_enough = 1.0 + 1e-9;
        moves = next > close_enough * slack;
        slack = fmax(next, slack);
    }
    return 1.0 / slack;
}

double aur_samples_left(size_t count, const double *variances, double factor, const uint32_t *targets) {
    const double spending = spending_to(count, variances, factor, targets);
    double left = 0.0;
    for (size_t i = 0; i < count; ++i)
        if (variances[i] > 0.0)
            left += samples_at(spending, variances[i], targets[i]) - targets[i];
    return left;
}

/* Every pixel gets at least a quarter of the mean, and half of it before it has 32 samples. Otherwise a pixel
 * whose first samples agreed by chance, such as those of few directions from a dim point, would never get
 * more, nor would its neighbours; and one whose samples have all missed an emitter covering a thirtieth of it
 * shows no variance. The cost is at most that part more, if most pixels have no variance. */
static bool raise_least(size_t count, uint32_t *targets) {
    double sum = 0.0;
    for (size_t i = 0; i < count; ++i)
        sum += targets[i];
    const double mean = sum / (double)count, first = 32.0;
    const double least = ceil(fmax(0.25 * mean, floor(fmin(0.5 * mean, first))));
    bool raised = false;
    for (size_t i = 0; i < count; ++i)
        if (targets[i] < least) {
            targets[i] = (uint32_t)fmin(least, (double)AUR_MOST_GROWTH * targets[i]);
            raised = true;
        }
    return raised;
}

bool aur_raise_targets(size_t count, const double *variances, double factor, uint32_t most,
                       uint32_t *targets) {
    const double spending = spending_to(count, variances, factor, targets);
    bool raised = false;
    for (size_t i = 0; i < count; ++i) {
        const double goal = variances[i] > 0.0 ? ceil(fmin(samples_at(spending, variances[i], targets[i]),
                                                           (double)AUR_MOST_GROWTH * targets[i]))
                                               : targets[i];
        const uint32_t target = (uint32_t)fmin(goal, most);
        raised = raised || target > targets[i];
        targets[i] = target > targets[i] ? target : targets[i];
    }
    return raise_least(count, targets) || raised;
}
