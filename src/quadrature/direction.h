/* Directions in double precision: the small algebra of this room. */
#ifndef AUR_QUADRATURE_DIRECTION_H
#define AUR_QUADRATURE_DIRECTION_H

#include <math.h>

static inline double aur_dot3(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline int aur_is_unit(const double a[3]) {
    return fabs(aur_dot3(a, a) - 1.0) <= 2e-6; /* false for NaN */
}

/* Two unit vectors that make a right-handed frame with the unit vector `z` (Duff et al. 2017). */
static inline void aur_frame3(const double z[3], double x[3], double y[3]) {
    const double sign = copysign(1.0, z[2]);
    const double a = -1.0 / (sign + z[2]);
    const double b = z[0] * z[1] * a;
    x[0] = 1.0 + sign * z[0] * z[0] * a;
    x[1] = sign * b;
    x[2] = -sign * z[0];
    y[0] = b;
    y[1] = sign + z[1] * z[1] * a;
    y[2] = -z[1];
}

#endif
