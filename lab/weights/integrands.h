/* Functions on the sphere of four classes with closed-form integrals. */
#ifndef LAB_WEIGHTS_INTEGRANDS_H
#define LAB_WEIGHTS_INTEGRANDS_H

#include <stddef.h>
#include <stdint.h>

/* About an axis: a wide spherical Gaussian, exp(4 (u.a - 1)); a clipped cosine, max(0, u.a); a cap of 40
 * degrees, 1 inside and 0 outside; a narrow spherical Gaussian, exp(400 (u.a - 1)), 6 degrees wide. */
typedef enum lab_class { LAB_SMOOTH, LAB_CLIPPED, LAB_DISCONTINUOUS, LAB_SPIKY, LAB_CLASSES } lab_class;

typedef struct lab_integrand {
    lab_class kind;
    double axis[3];
} lab_integrand;

const char *lab_class_name(lab_class kind);

/* One of a class, with an axis hashed from the seed, uniform over the sphere. */
lab_integrand lab_integrand_make(lab_class kind, uint64_t seed);
double lab_integrand_value(const lab_integrand *integrand, const double direction[3]);
/* The integral over the sphere. */
double lab_integrand_integral(const lab_integrand *integrand);

#endif
