#include "points/quadrature/kernel.h"

#include <aureole/quadrature.h>
#include <math.h>
#include <string.h>

#include "points/quadrature/check.h"

/* c_l of |u-v|^{2a} = (2(1-x))^a: I_l is the integral of (1-x)^a P_l(x). */
static void chord_coefficients(double smoothness, size_t count, double *coefficients) {
    const double a = smoothness - 1.0;
    const double scale = pow(2.0, a);
    double integral = pow(2.0, smoothness) / smoothness;
    for (size_t l = 0; l < count; ++l) {
        const double degree = (double)l;
        coefficients[l] = (2.0 * degree + 1.0) / 2.0 * scale * integral;
        integral *= (degree - a) / (degree + a + 2.0);
    }
}

/* Adds `factors` times the Legendre polynomials to degree L to polynomial[] in q = 2(1-x). */
static void add_legendre(size_t degree, const double *factors, double *polynomial) {
    double here[AUR_KERNEL_DEGREE_MAX + 2] = {1.0}, before[AUR_KERNEL_DEGREE_MAX + 2] = {0.0};
    for (size_t l = 0; l <= degree; ++l) {
        double next[AUR_KERNEL_DEGREE_MAX + 2];
        const double n = (double)l;
        for (size_t k = 0; k <= AUR_KERNEL_DEGREE_MAX; ++k) {
            polynomial[k] += factors[l] * here[k];
            const double times_x = here[k] - (k > 0 ? 0.5 * here[k - 1] : 0.0);
            next[k] = ((2.0 * n + 1.0) * times_x - n * before[k]) / (n + 1.0);
        }
        memcpy(before, here, sizeof before);
        memcpy(here, next, (AUR_KERNEL_DEGREE_MAX + 1) * sizeof *here);
    }
}

aur_kernel_rule aur_kernel_rule_make(double smoothness) {
    aur_kernel_rule rule = {.smoothness = smoothness,
                            .top = pow(2.0, 2.0 * smoothness - 1.0) / smoothness,
                            .power = smoothness - 1.0,
                            .sign = -1.0,
                            .degree = (size_t)(smoothness - 1.0),
                            .row = AUR_KERNEL_HERE(aur_kernel_row)};
    rule.polynomial[0] = rule.top; /* twice c_0, which it is for s < 2 */
    if (rule.degree > 0) {
        double factors[AUR_KERNEL_DEGREE_MAX + 1] = {0.0};
        chord_coefficients(smoothness, rule.degree + 1, factors);
        rule.sign = rule.degree % 2 == 0 ? -1.0 : 1.0;
        for (size_t l = 0; l <= rule.degree; ++l)
            factors[l] = fabs(factors[l]) - rule.sign * factors[l];
        rule.polynomial[0] = 0.0;
        add_legendre(rule.degree, factors, rule.polynomial);
        rule.top = rule.polynomial[0];
    }
    return rule;
}

static double smooth_kernel(const aur_kernel_rule *rule, double q) {
    double sum = rule->polynomial[rule->degree];
    for (size_t k = rule->degree; k-- > 0;)
        sum = sum * q + rule->polynomial[k];
    return sum + rule->sign * pow(q, rule->power);
}

double aur_kernel(double smoothness, double chord) {
    if (!aur_smoothness_in_range(smoothness) || !(chord >= 0.0 && chord <= 2.0))
        return (double)NAN;
    const aur_kernel_rule rule = aur_kernel_rule_make(smoothness);
    return smooth_kernel(&rule, chord * chord);
}

void aur_kernel_row(const aur_kernel_rule *rule, const double point[3], size_t count, aur_columns columns,
                    double *row) {
    if (rule->power == 0.5) {
        rule->row(rule->top, point, count, columns, row);
        return;
    }
    for (size_t j = 0; j < count; ++j) {
        const double dx = columns.x[j] - point[0], dy = columns.y[j] - point[1], dz = columns.z[j] - point[2];
        row[j] = smooth_kernel(rule, dx * dx + dy * dy + dz * dz);
    }
}

/* Eight running sums in a fixed order: bit-identical for all vector widths. */
static double dot(size_t count, const double *restrict a, const double *restrict b) {
    double lanes[8] = {0};
    size_t j = 0;
    for (; j + 8 <= count; j += 8)
        for (size_t lane = 0; lane < 8; ++lane)
            lanes[lane] += a[j + lane] * b[j + lane];
    for (; j < count; ++j)
        lanes[j % 8] += a[j] * b[j];
    return ((lanes[0] + lanes[4]) + (lanes[1] + lanes[5])) + ((lanes[2] + lanes[6]) + (lanes[3] + lanes[7]));
}

double aur_kernel_sum(const aur_kernel_rule *rule, const double point[3], size_t count, aur_columns columns,
                      const double *weights) {
    enum { BLOCK = 512 };
    double row[BLOCK];
    double sum = 0.0;
    for (size_t first = 0; first < count; first += BLOCK) {
        const size_t size = count - first < BLOCK ? count - first : BLOCK;
        const aur_columns part = {columns.x + first, columns.y + first, columns.z + first};
        aur_kernel_row(rule, point, size, part, row);
        sum += dot(size, row, weights + first);
    }
    return sum;
}

void aur_kernel_coefficients(double smoothness, size_t count, double *coefficients) {
    chord_coefficients(smoothness, count, coefficients);
    for (size_t l = 0; l < count; ++l)
        coefficients[l] = fabs(coefficients[l]);
    if (count > 0 && smoothness < 2.0) /* equal up to rounding, consistent with the kernel */
        coefficients[0] = pow(2.0, 2.0 * smoothness - 1.0) / smoothness - coefficients[0];
}

aur_columns aur_columns_split(size_t count, const double *xyz, double *storage) {
    double *const x = storage;
    double *const y = storage + count;
    double *const z = storage + 2 * count;
    for (size_t i = 0; i < count; ++i) {
        x[i] = xyz[3 * i];
        y[i] = xyz[3 * i + 1];
        z[i] = xyz[3 * i + 2];
    }
    return (aur_columns){x, y, z};
}
