/* Spherical Fibonacci points from their index. */
#ifndef AUR_SPHERE_FIBONACCI_H
#define AUR_SPHERE_FIBONACCI_H

#include <stddef.h>
#include <stdint.h>

/* Point j has 1 - z = (j + offset) * step and the azimuth phase + j/Phi. */
typedef struct aur_fibonacci {
    double step, offset;
    uint64_t phase;
} aur_fibonacci;

/* Points first .. first+count-1 as x,y,z triples. */
void aur_fibonacci_points(const aur_fibonacci *set, uint64_t first, size_t count, double *xyz);

#endif
