/* The generalised distance kernel of the Sobolev space H^s of the sphere (Marques 2018 eq. 3; Brauchart,
 * Saff, Sloan and Womersley 2014, section 5, for s > 2): with c_l the Legendre coefficients of |u-v|^{2s-2}
 * it is the sum of |c_l| P_l(u.v). Beyond degree L, the integer part of s - 1, all c_l have the same sign, so
 * that it is (-1)^{L+1} |u-v|^{2s-2} plus a polynomial of degree L. */
#pragma once

#include "points/base/simd.h"

/* Directions as three arrays, so that a row of the kernel is one vector loop. */
typedef struct aur_columns {
    const double *x, *y, *z;
} aur_columns;

enum { AUR_KERNEL_DEGREE_MAX = 4 };

/* The row for smoothness 3/2. */
typedef void aur_kernel_row_function(double top, const double point[3], size_t count, aur_columns columns,
                                     double *row);

/* K = polynomial(q) + sign q^power in q, the squared chord. */
typedef struct aur_kernel_rule {
    double smoothness;
    double top;   /* K of a point with itself */
    double power; /* s - 1 */
    double sign;
    size_t degree;                                /* of the polynomial, L; 0 for s < 2 */
    double polynomial[AUR_KERNEL_DEGREE_MAX + 1]; /* [0] is top */
    aur_kernel_row_function *row;                 /* for s = 3/2 on this machine */
} aur_kernel_rule;

/* `smoothness` must be in the range of aur_check_smoothness. */
aur_kernel_rule aur_kernel_rule_make(double smoothness);

/* row[j] = K(point, columns[j]), 0 <= j < count. Bit-identical for all instruction sets. */
void aur_kernel_row(const aur_kernel_rule *rule, const double point[3], size_t count, aur_columns columns,
                    double *row);

/* sum of weights[j] K(point, columns[j]), in an order that depends on count only. */
double aur_kernel_sum(const aur_kernel_rule *rule, const double point[3], size_t count, aur_columns columns,
                      const double *weights);

/* Legendre coefficients: K = sum of coefficients[l] P_l(u.v), 0 <= l < count. */
void aur_kernel_coefficients(double smoothness, size_t count, double *coefficients);

/* Splits count x,y,z triples into x[count], y[count], z[count] at `storage` (3 * count). */
aur_columns aur_columns_split(size_t count, const double *xyz, double *storage);

/* Called only by aur_kernel_row. */
AUR_KERNELS(aur_kernel_row_function, aur_kernel_row);
