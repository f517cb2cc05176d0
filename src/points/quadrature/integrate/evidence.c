#include "points/quadrature/integrate/evidence.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The required number of values that differ from the most frequent one: the count of 64 rare values has an
 * uncertainty of a quarter. */
enum { SPARSE = 64, BUCKETS = 4096 };

/* A tail whose largest value is smaller than this, relative to the mean magnitude, does not affect the mean.
 */
static const double NEGLIGIBLE = 0.01;

static int ascending(const void *left, const void *right) {
    const double a = *(const double *)left, b = *(const double *)right;
    return (a > b) - (a < b);
}

/* Quickselect: moves the value of rank k to index k, with smaller ones before and larger ones after it (Hoare
 * 1961; equal values in the middle, since functions have many). */
static double select_rank(size_t count, double *values, size_t k) {
    size_t from = 0, to = count;
    while (to - from > 1) {
        const double a = values[from], b = values[from + (to - from) / 2], c = values[to - 1];
        const double pivot = fmax(fmin(a, b), fmin(fmax(a, b), c));
        size_t below = from, i = from, above = to;
        while (i < above) {
            const double value = values[i];
            if (value == pivot) {
                ++i;
                continue;
            }
            const size_t target = value < pivot ? below : above - 1;
            values[i] = values[target];
            values[target] = value;
            if (value < pivot) {
                ++below;
                ++i;
            } else {
                --above;
            }
        }
        if (k >= below && k < above)
            return pivot;
        from = k < below ? from : above;
        to = k < below ? below : to;
    }
    return values[k];
}

/* The largest distance between neighbours of the sorted values, to a part in BUCKETS of their range. */
static double largest_gap(size_t count, const double *values) {
    double least = INFINITY, most = -INFINITY;
    for (size_t i = 0; i < count; ++i) {
        least = fmin(least, values[i]);
        most = fmax(most, values[i]);
    }
    if (!(most > least))
        return 0.0;
    double low[BUCKETS + 1], high[BUCKETS + 1];
    for (size_t b = 0; b <= BUCKETS; ++b) {
        low[b] = INFINITY;
        high[b] = -INFINITY;
    }
    const double scale = BUCKETS / (most - least);
    for (size_t i = 0; i < count; ++i) {
        const size_t b = (size_t)fmin((values[i] - least) * scale, (double)BUCKETS);
        low[b] = fmin(low[b], values[i]);
        high[b] = fmax(high[b], values[i]);
    }
    double gap = 0.0, before = high[0];
    for (size_t b = 1; b <= BUCKETS; ++b)
        if (low[b] <= high[b]) {
            gap = fmax(gap, low[b] - before);
            before = high[b];
        }
    return gap;
}

/* The shape of the generalised Pareto distribution of x[count] > 0, ascending: 0.5 and more is infinite
 * variance (Zhang and Stephens 2009, with the prior of Vehtari et al. 2024). */
static double pareto_shape(size_t count, const double *x) {
    enum { MOST = 64 };
    const size_t candidates = 20 + (size_t)fmin(sqrt((double)count), MOST - 20.0);
    const double quartile = x[(size_t)((double)count / 4.0 + 0.5) - 1];
    double profile[MOST], theta[MOST], largest = -INFINITY;
    for (size_t j = 0; j < candidates; ++j) {
        theta[j] =
            1.0 / x[count - 1] + (1.0 - sqrt((double)candidates / ((double)j + 0.5))) / (3.0 * quartile);
        double k = 0.0;
        for (size_t i = 0; i < count; ++i)
            k += log1p(-theta[j] * x[i]) / (double)count;
        profile[j] = (double)count * (log(-theta[j] / k) - k - 1.0);
        largest = fmax(largest, profile[j]);
    }
    double sum = 0.0, mean = 0.0;
    for (size_t j = 0; j < candidates; ++j) {
        const double weight = exp(profile[j] - largest);
        sum += weight;
        mean += weight * theta[j];
    }
    mean /= sum;
    double k = 0.0;
    for (size_t i = 0; i < count; ++i)
        k += log1p(-mean * x[i]) / (double)count;
    return ((double)count * k + 5.0) / ((double)count + 10.0);
}

/* The same for the `tail` largest of ascending magnitudes, above the one before them. NaN: too few, or too
 * many equal ones for a fit. */
static double tail_shape(size_t count, const double *magnitudes, size_t tail, double *x) {
    if (tail < 5 || tail >= count)
        return (double)NAN;
    const double threshold = magnitudes[count - tail - 1];
    for (size_t i = 0; i < tail; ++i)
        x[i] = magnitudes[count - tail + i] - threshold;
    return x[tail / 4] > 0.0 ? pareto_shape(tail, x) : (double)NAN;
}

static void judge_tail(size_t count, size_t others, double *magnitudes, double *scratch,
                       aur_evidence *evidence) {
    const size_t most = (size_t)fmin(0.2 * (double)count, 3.0 * sqrt((double)count));
    const size_t tail = others < most ? others : most;
    if (tail < 5)
        return;
    select_rank(count, magnitudes, count - tail - 1);
    double *const top = magnitudes + count - tail - 1;
    qsort(top, tail + 1, sizeof *top, ascending);
    const double shape = tail_shape(tail + 1, top, tail, scratch);
    const double narrow = tail_shape(tail + 1, top, tail / 4, scratch);
    const bool flat = top[tail] == top[tail - 2];                      /* the function has a largest value */
    const bool matters = top[tail] > NEGLIGIBLE * evidence->magnitude; /* else possibly rounding */
    if (shape > 0.1 && narrow > 0.1) /* singular or not resolved: larger values were not sampled yet */
        evidence->jump = fmax(evidence->jump, top[tail]);
    evidence->heavy_tail = shape > 0.7 && narrow > 0.5 && !flat && matters;
}

aur_evidence aur_evidence_of(size_t count, size_t older, double *values, double *scratch) {
    aur_evidence evidence = {.count = count, .all_equal = true};
    double sum = 0.0, largest = 0.0;
    for (size_t i = 0; i < count; ++i) {
        evidence.all_equal = evidence.all_equal && values[i] == values[0];
        sum += fabs(values[i]);
        largest = fmax(largest, fabs(values[i]));
    }
    evidence.largest = largest;
    evidence.magnitude = count > 0 ? sum / (double)count : 0.0;
    if (evidence.all_equal)
        return evidence;
    evidence.dominated = largest > 0.5 * sum;
    /* A gap that remains with four times as many values is a jump of the function or an unresolved feature;
     * gaps of smooth functions close. */
    const double gap = largest_gap(count, values);
    if (older < 2 || gap > 0.5 * largest_gap(older, values))
        evidence.jump = gap;
    memcpy(scratch, values, count * sizeof *values);
    const double median = select_rank(count, scratch, count / 2);
    size_t others = 0;
    for (size_t i = 0; i < count; ++i) {
        values[i] = fabs(values[i] - median);
        others += values[i] != 0.0;
    }
    evidence.sparse = others < SPARSE && count >= 2 * SPARSE;
    judge_tail(count, others, values, scratch, &evidence);
    return evidence;
}
