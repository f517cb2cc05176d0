/* Vectors of three doubles, beside aur_dot3 and aur_frame3. */
#ifndef AUR_QUALITY_VECTOR3_H
#define AUR_QUALITY_VECTOR3_H

#include <math.h>

#include "quadrature/direction.h"

static inline void aur_cross3(const double *a, const double *b, double c[3]) {
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}

/* Returns the length; a zero vector stays as it is. */
static inline double aur_normalize3(double a[3]) {
    const double length = sqrt(aur_dot3(a, a));
    for (int d = 0; d < 3 && length > 0.0; ++d)
        a[d] /= length;
    return length;
}

#endif
