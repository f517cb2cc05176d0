/* Fresnel reflectance of smooth boundaries, and refractive indices. */
#pragma once

#include "points/base/keys.h"
#include "points/base/vector.h"

/* The reflectance of a boundary for unpolarised light incident at `cosine` (positive from outside, negative
 * from inside). `ior` is inside over outside. *refracted is the cosine on the other side, of the opposite
 * sign; 0 for total reflection. */
float aur_fresnel_dielectric(float cosine, float ior, float *refracted);

/* The same for a metal with the complex index eta + i k, from vacuum at cosine >= 0. Signs of eta and k do
 * not matter. */
aur_vector aur_fresnel_conductor(float cosine, aur_vector eta, aur_vector k);

/* The mean of aur_fresnel_dielectric over diffuse light: 2 integral F(c) c dc. */
float aur_fresnel_diffuse(float ior);

/* Reads `int_ior` and `ext_ior`, numbers or names ("bk7", "water"); gives inside over outside. */
aur_result aur_parameters_ior(aur_parameters *parameters, const char *inside, float *ior, aur_error *error);

/* A metal's complex index for red, green and blue. */
typedef struct aur_metal {
    aur_vector eta, k;
    bool perfect; /* perfect mirror */
} aur_metal;

/* From `material` (the name of a metal, or "none": a perfect mirror), or `eta` and `k`, which have been read;
 * default: a perfect mirror. Both are divided by `ext_eta`. */
aur_result aur_metal_complete(aur_parameters *parameters, aur_metal *metal, aur_error *error);

/* Rows for tables of keys, of what aur_parameters_ior reads. */
#define AUR_IOR_KEYS(inside_)                                                                                \
    {AUR_KEY_READ_APART(AUR_KEY_ITEM, "int_ior", inside_, "index of refraction inside, or a substance"),     \
     .minimum = 0.1, .maximum = 100.0, .words = (const char *const[]){"number", "substance", NULL}},         \
    {                                                                                                        \
        AUR_KEY_READ_APART(AUR_KEY_ITEM, "ext_ior", "air", "index of refraction outside, or a substance"),   \
            .minimum = 0.1, .maximum = 100.0, .words = (const char *const[]) {                               \
            "number", "substance", NULL                                                                      \
        }                                                                                                    \
    }

/* Rows for tables of keys; the struct has an aur_metal called metal. */
#define AUR_METAL_KEYS(struct_)                                                                              \
    {AUR_KEY_READ_APART(AUR_KEY_TEXT, "material", "none",                                                    \
                        "a metal's symbol such as Au; none reflects all")},                                  \
        {AUR_KEY_OF_VECTOR(struct_, "eta", metal.eta, -1e3, 1e3, NULL,                                       \
                           "instead of material, with k: index for R, G, B")},                               \
        {AUR_KEY_OF_VECTOR(struct_, "k", metal.k, -1e3, 1e3, NULL, "absorption for R, G, B")}, {             \
        AUR_KEY_READ_APART(AUR_KEY_ITEM, "ext_eta", "vacuum",                                                \
                           "index of refraction outside, or a substance"),                                   \
            .minimum = 0.1, .maximum = 100.0, .words = (const char *const[]) {                               \
            "number", "substance", NULL                                                                      \
        }                                                                                                    \
    }
