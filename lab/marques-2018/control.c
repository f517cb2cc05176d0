#include "control.h"

#include <aureole/text.h>
#include <math.h>
#include <string.h>

enum { MOST = (LAB_CONTROL_DEGREE_MAX + 1) * (LAB_CONTROL_DEGREE_MAX + 1) };

/* Regularisation relative to the trace: for a narrow lobe, high powers are nearly dependent. */
static const double RIDGE = 1e-14;

static double density(const aur_strategy *strategy, const double u[3]) {
    const double *const a = strategy->axis, m = strategy->sampled.exponent;
    const double up =
        a[0] == 0.0 && a[1] == 0.0 && a[2] == 0.0 ? u[2] : u[0] * a[0] + u[1] * a[1] + u[2] * a[2];
    return up > 0.0 ? (m + 1.0) / (2.0 * 3.14159265358979323846) * pow(up, m) : 0.0;
}

/* All x^a y^b z^c with c at most 1: the others are linear combinations of them on the sphere. */
static size_t polynomials(size_t degree, const double u[3], double values[MOST]) {
    size_t count = 0;
    for (size_t c = 0; c < 2; ++c)
        for (size_t a = 0; a + c <= degree; ++a)
            for (size_t b = 0; a + b + c <= degree; ++b)
                values[count++] = pow(u[0], (double)a) * pow(u[1], (double)b) * (c == 1 ? u[2] : 1.0);
    return count;
}

/* The basis at a direction. */
static size_t evaluate(const lab_control *of, const double u[3], double values[MOST]) {
    if (of->basis == LAB_CONTROL_DENSITIES) {
        for (size_t k = 0; k < 2; ++k)
            values[k] = density(&of->strategies[k], u);
        return 2;
    }
    const size_t count = polynomials(of->degree, u, values);
    const double p = density(&of->strategies[of->lobe], u);
    for (size_t j = 0; j < count; ++j)
        values[j] *= p;
    return count;
}

/* The integrals of the basis over the upper hemisphere. */
static void integrate(const lab_control *of, double integrals[MOST]) {
    memset(integrals, 0, MOST * sizeof *integrals);
    for (size_t k = 0; k < 2; ++k) {
        const bool densities = of->basis == LAB_CONTROL_DENSITIES;
        for (size_t i = 0; i < of->node_count && (densities || k == of->lobe); ++i) {
            const double *const u = of->nodes + 3 * (k * of->node_count + i);
            double values[MOST];
            if (u[2] < 0.0)
                continue;
            const size_t count = densities ? 0 : polynomials(of->degree, u, values);
            if (densities)
                integrals[k] += 1.0 / (double)of->node_count;
            for (size_t j = 0; j < count; ++j)
                integrals[j] += values[j] / (double)of->node_count;
        }
    }
}

/* Solves the symmetric positive definite system in place by Cholesky decomposition. */
static bool solve(size_t n, double a[MOST][MOST], double x[MOST]) {
    for (size_t j = 0; j < n; ++j)
        for (size_t i = j; i < n; ++i) {
            double sum = a[i][j];
            for (size_t k = 0; k < j; ++k)
                sum -= a[i][k] * a[j][k];
            if (i == j && !(sum > 0.0))
                return false;
            a[i][j] = i == j ? sqrt(sum) : sum / a[j][j];
        }
    for (size_t i = 0; i < n; ++i) {
        for (size_t k = 0; k < i; ++k)
            x[i] -= a[i][k] * x[k];
        x[i] /= a[i][i];
    }
    for (size_t i = n; i-- > 0;) {
        for (size_t k = i + 1; k < n; ++k)
            x[i] -= a[k][i] * x[k];
        x[i] /= a[i][i];
    }
    return true;
}

/* The estimate is the control variate's integral plus the mean of the residual, sum c_j M_j + sum_i (F_i -
 * sum c_j phi_ij) / d_i with d = n_1 q_1 + n_2 q_2; c minimises the sum of the squares of (F_i - sum c_j
 * phi_ij) / d_i. It is linear in F, so it is a weight for each sample. */
aur_result lab_control_weights(const lab_control *control, double *weights, aur_error *error) {
    double matrix[MOST][MOST] = {{0}}, off[MOST], trace = 0.0, values[MOST];
    integrate(control, off);
    size_t basis = 0;
    for (size_t i = 0; i < control->count; ++i) {
        const double *const u = control->xyz + 3 * i;
        double d = 0.0;
        for (size_t k = 0; k < 2; ++k)
            d += (double)control->strategies[k].count * density(&control->strategies[k], u);
        weights[i] = u[2] < 0.0 ? 0.0 : 1.0 / d; /* before the correction */
        basis = evaluate(control, u, values);
        for (size_t j = 0; j < basis && weights[i] > 0.0; ++j) {
            off[j] -= values[j] / d;
            for (size_t k = 0; k < basis; ++k)
                matrix[j][k] += values[j] * values[k] / (d * d);
        }
    }
    for (size_t j = 0; j < basis; ++j)
        trace += matrix[j][j];
    for (size_t j = 0; j < basis; ++j)
        matrix[j][j] += RIDGE * trace;
    if (!solve(basis, matrix, off)) {
        if (error != NULL) {
            *error = (aur_error){.result = AUR_ERROR_INTERNAL};
            aur_format(error->message, sizeof error->message, "control variates: a singular system");
        }
        return AUR_ERROR_INTERNAL;
    }
    for (size_t i = 0; i < control->count; ++i) {
        const double *const u = control->xyz + 3 * i, scale = weights[i];
        double more = 1.0;
        evaluate(control, u, values);
        for (size_t j = 0; j < basis; ++j)
            more += values[j] * off[j] * scale;
        weights[i] = scale * density(&control->strategies[control->lobe], u) * more;
    }
    return AUR_OK;
}
