/* How much light a smooth boundary reflects, and refractive indices. */
#ifndef AUR_MATERIAL_FRESNEL_H
#define AUR_MATERIAL_FRESNEL_H

#include "core/parameters.h"
#include "core/vector.h"

/* The reflectance of a boundary for unpolarised light that arrives at `cosine` (its sign says from which
 * side: positive is the outside). `ior` is inside over outside. *refracted is the cosine on the other side,
 * of the opposite sign; 0 when all is reflected. */
float aur_fresnel_dielectric(float cosine, float ior, float *refracted);

/* The same for a metal with the complex index eta + i k, seen from vacuum at cosine >= 0. Signs of eta and k
 * do not matter. */
aur_vector aur_fresnel_conductor(float cosine, aur_vector eta, aur_vector k);

/* The mean of aur_fresnel_dielectric over diffuse light: 2 integral F(c) c dc. */
float aur_fresnel_diffuse(float ior);

/* Reads `int_ior` and `ext_ior`, numbers or names ("bk7", "water"), and gives inside over outside. */
aur_result aur_parameters_ior(aur_parameters *parameters, const char *inside, float *ior, aur_error *error);

/* Reads `material` (the name of a metal, or "none": a perfect mirror), or `eta` and `k`; a perfect mirror by
 * default. */
aur_result aur_parameters_conductor(aur_parameters *parameters, aur_vector *eta, aur_vector *k, bool *perfect,
                                    aur_error *error);

#endif
