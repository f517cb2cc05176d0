#include "ask/rounds.h"

#include <math.h>

/* The samples of a pixel at the price `price` a sample: where one more would save as much as it costs. */
static double samples_at(double price, double variance, uint32_t samples) {
    return fmax(sqrt(variance * samples / price), samples);
}

static double variance_at(double price, size_t count, const double *variances, const uint32_t *targets) {
    double sum = 0.0;
    for (size_t i = 0; i < count; ++i)
        sum += variances[i] * targets[i] / samples_at(price, variances[i], targets[i]);
    return sum;
}

/* The price at which the sum of variances becomes `factor` of what it is. */
static double price_of(size_t count, const double *variances, double factor, const uint32_t *targets) {
    double sum = 0.0, high = 0.0;
    for (size_t i = 0; i < count; ++i) {
        sum += variances[i];
        high = fmax(high, variances[i] / targets[i]);
    }
    /* At the highest price nobody buys; at this part of the lowest gain the variance is a quarter of what is
     * wanted. */
    double low = high;
    for (size_t i = 0; i < count; ++i)
        if (variances[i] > 0.0)
            low = fmin(low, variances[i] / targets[i]);
    low *= 0.0625 * factor * factor;
    /* Samples are whole numbers and go as the root of the price. */
    const double close_enough = 1.0 + 1e-6;
    for (int k = 0; k < 64 && high > close_enough * low; ++k) {
        const double price = sqrt(low * high);
        if (variance_at(price, count, variances, targets) > factor * sum)
            high = price;
        else
            low = price;
    }
    return low;
}

double aur_growth_to(size_t count, const double *variances, double factor, const uint32_t *targets) {
    const double price = price_of(count, variances, factor, targets);
    double before = 0.0, after = 0.0;
    for (size_t i = 0; i < count; ++i) {
        before += targets[i];
        after += variances[i] > 0.0 ? samples_at(price, variances[i], targets[i]) : targets[i];
    }
    return after / before;
}

/* No pixel is left with less than a quarter of the mean of all, nor with less than half of it before it has
 * 32 samples: one whose first samples agreed by chance, as those of few directions from a dim place do, would
 * stay as it is, and so would all about it; and one in which none has met a lamp that covers a thirtieth of
 * it shows no variance at all. It costs at most that part more, where most pixels have no variance. */
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
    const double price = price_of(count, variances, factor, targets);
    bool raised = false;
    for (size_t i = 0; i < count; ++i) {
        const double wanted = variances[i] > 0.0 ? ceil(fmin(samples_at(price, variances[i], targets[i]),
                                                             (double)AUR_MOST_GROWTH * targets[i]))
                                                 : targets[i];
        const uint32_t target = (uint32_t)fmin(wanted, most);
        raised = raised || target > targets[i];
        targets[i] = target > targets[i] ? target : targets[i];
    }
    return raise_least(count, targets) || raised;
}
