/* Sums to twice the precision of a double (Knuth 1969, Dekker 1971). */
#pragma once

#include <math.h>

/* high + low, |low| no more than half a unit in the last place of high. */
typedef struct aur_twofold {
    double high, low;
} aur_twofold;

static inline aur_twofold aur_two_sum(double a, double b) {
    const double sum = a + b;
    const double part = sum - a;
    return (aur_twofold){sum, (a - (sum - part)) + (b - part)};
}

static inline aur_twofold aur_two_product(double a, double b) {
    const double product = a * b;
    return (aur_twofold){product, fma(a, b, -product)};
}

static inline aur_twofold aur_twofold_add(aur_twofold a, aur_twofold b) {
    const aur_twofold sum = aur_two_sum(a.high, b.high);
    return aur_two_sum(sum.high, sum.low + (a.low + b.low));
}

static inline aur_twofold aur_twofold_scale(aur_twofold a, double factor) {
    const aur_twofold product = aur_two_product(a.high, factor);
    return aur_two_sum(product.high, product.low + a.low * factor);
}

static inline aur_twofold aur_twofold_multiply(aur_twofold a, aur_twofold b) {
    const aur_twofold product = aur_two_product(a.high, b.high);
    return aur_two_sum(product.high, product.low + (a.high * b.low + a.low * b.high));
}

/* numerator / denominator of two doubles. */
static inline aur_twofold aur_twofold_ratio(double numerator, double denominator) {
    const double quotient = numerator / denominator;
    return (aur_twofold){quotient, fma(-quotient, denominator, numerator) / denominator};
}
