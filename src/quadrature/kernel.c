#include "quadrature/kernel.h"

#include <aureole/quadrature.h>
#include <math.h>

#include "core/simd.h"
#define ROW aur_kernel_row_portable
#include "quadrature/kernel_body.h"

aur_kernel_rule aur_kernel_rule_make(double smoothness) {
    aur_kernel_rule rule = {.smoothness = smoothness,
                            .top = pow(2.0, 2.0 * smoothness - 1.0) / smoothness,
                            .power = smoothness - 1.0,
                            .row = AUR_KERNEL_HERE(aur_kernel_row)};
    return rule;
}

double aur_kernel(double smoothness, double chord) {
    if (!(smoothness > 1.0 && smoothness < 2.0 && chord >= 0.0 && chord <= 2.0))
        return (double)NAN;
    return pow(2.0, 2.0 * smoothness - 1.0) / smoothness - pow(chord * chord, smoothness - 1.0);
}

void aur_kernel_row(const aur_kernel_rule *rule, const double point[3], size_t count, aur_columns columns,
                    double *row) {
    if (rule->power == 0.5) {
        rule->row(rule->top, point, count, columns, row);
        return;
    }
    for (size_t j = 0; j < count; ++j) {
        const double dx = columns.x[j] - point[0], dy = columns.y[j] - point[1], dz = columns.z[j] - point[2];
        row[j] = rule->top - pow(dx * dx + dy * dy + dz * dz, rule->power);
    }
}

/* Eight running sums in a fixed order: vectors of any width give the same bits. */
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
    /* I_l is the integral of (1-x)^a P_l(x): |u-v|^{2a} = (2(1-x))^a. */
    const double a = smoothness - 1.0;
    const double scale = pow(2.0, a);
    double integral = pow(2.0, smoothness) / smoothness;
    for (size_t l = 0; l < count; ++l) {
        const double degree = (double)l;
        coefficients[l] = -(2.0 * degree + 1.0) / 2.0 * scale * integral;
        integral *= (degree - a) / (degree + a + 2.0);
    }
    if (count > 0)
        coefficients[0] += pow(2.0, 2.0 * smoothness - 1.0) / smoothness;
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
