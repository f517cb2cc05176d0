#include "points/quality/split/split.h"

#include <math.h>
#include <stdbool.h>

#include "points/base/vector.h"

double aur_split_whole(double exponent, double square) {
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

/* Beyond this the remainder is below the rounding of the kernel. */
static const double far_away = 48.0;

/* g(s, q) = e^-q sum_k q^k / Gamma(s + k + 1), and for the logarithm Euler's Ein(q) = e^-q sum_k H_k q^k / k!
 * with the harmonic numbers: sums of terms of one sign. */
double aur_split_smooth(const aur_split_kernel *kernel, double square) {
    static const double euler = 0.57721566490153286061;
    const double q = kernel->scale * kernel->scale * square, s = 0.5 * kernel->exponent;
    if (q > far_away)
        return aur_split_whole(kernel->exponent, square);
    const bool logarithm = kernel->exponent == 0.0;
    double power = exp(-q); /* times q^k / k! */
    double factor = logarithm ? 0.0 : 1.0 / tgamma(s + 1.0);
    double sum = power * factor;
    for (double k = 1.0; k < q + 8.0 || power * factor > 1e-18 * sum; k += 1.0) {
        power *= q / k;
        factor = logarithm ? factor + 1.0 / k : factor * (k / (s + k));
        sum += power * factor;
    }
    return logarithm ? log(kernel->scale) + 0.5 * (euler - sum) : pow(kernel->scale, kernel->exponent) * sum;
}

/* |Gamma(s, q) / Gamma(s)| a^S q^-s, by Gamma(s, q) <= q^{s-1} e^-q q / (q - s + 1) for s > 1, and without
 * the last factor for s <= 1 (DLMF 8.10); half of E_1(q) <= e^-q / q for the logarithm. */
static double rest_at(double exponent, double scale, double q) {
    const double s = 0.5 * exponent;
    if (exponent == 0.0)
        return 0.5 * exp(-q) / q;
    const double factor = s <= 1.0 ? 1.0 : q / (q - s + 1.0);
    return pow(scale, exponent) * exp(-q) / q * factor / fabs(tgamma(s));
}

aur_split_kernel aur_split_kernel_make(double exponent, double reach, double range) {
    aur_split_kernel kernel = {.exponent = exponent, .scale = sqrt(range) / reach, .reach = reach};
    kernel.rest = rest_at(exponent, kernel.scale, range);
    double values[AUR_SPLIT_TERMS];
    for (int i = 0; i < AUR_SPLIT_TERMS; ++i) {
        const double node = cos(AUR_PI * (i + 0.5) / AUR_SPLIT_TERMS);
        values[i] = aur_split_smooth(&kernel, 0.5 * (1.0 + node) * reach * reach);
    }
    for (int k = 0; k < AUR_SPLIT_TERMS; ++k) {
        double sum = 0.0;
        for (int i = 0; i < AUR_SPLIT_TERMS; ++i)
            sum += values[i] * cos(AUR_PI * k * (i + 0.5) / AUR_SPLIT_TERMS);
        kernel.terms[k] = (k == 0 ? 1.0 : 2.0) / AUR_SPLIT_TERMS * sum;
    }
    kernel.term_count = AUR_SPLIT_TERMS;
    while (kernel.term_count > 1 && fabs(kernel.terms[kernel.term_count - 1]) < 1e-18 * fabs(kernel.terms[0]))
        --kernel.term_count;
    return kernel;
}
