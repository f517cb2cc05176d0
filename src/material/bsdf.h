/* Materials: how a surface scatters light. One BSDF a file (bsdf_*.c), with one line in the table of bsdf.c.
 *
 * Directions are unit vectors in the local shading frame, z along the shading normal on the side that the
 * shape's normal points to. `view` points to where light goes (the eye), `light` to where it comes from. */
#ifndef AUR_MATERIAL_BSDF_H
#define AUR_MATERIAL_BSDF_H

#include <stdbool.h>

#include "core/parameters.h"
#include "core/vector.h"

typedef struct aur_bsdf aur_bsdf;

/* Where on a surface a BSDF is asked. */
typedef struct aur_bsdf_point {
    float u, v; /* texture coordinates */
} aur_bsdf_point;

typedef struct aur_bsdf_sample {
    aur_vector light;
    aur_vector weight; /* BSDF * |cos| / pdf, RGB */
    float pdf;         /* a steradian; of no meaning when specular */
    bool specular;     /* a Dirac direction: evaluate and pdf are 0 there */
    float ior_squared; /* 0: both sides are alike. When the light went through a boundary: the squared index
                          of the light's side over the view's. The weight is radiance's; a particle's is
                          weight times this. */
} aur_bsdf_sample;

typedef enum aur_lobe_shape {
    AUR_LOBE_SHAPE_COSINE_POWER, /* coefficient * max(0, axis . light)^exponent [* |light.z|] [* factor] */
    AUR_LOBE_SHAPE_SPECULAR,     /* coefficient of a Dirac direction `axis` */
    AUR_LOBE_SHAPE_SAMPLED /* no formula, about `axis`; at most one: aur_bsdf_evaluate_sampled and its kin */
} aur_lobe_shape;

/* One part of BSDF * cos, as final gathering wants it: the sum of the lobes is `evaluate` wherever light is
 * on the side of view (and what a lobe has on the other side is to be left out). */
typedef struct aur_bsdf_lobe {
    aur_lobe_shape shape;
    bool diffuse;      /* about the normal: gathered by the diffuse rule */
    bool times_cosine; /* the factor |light.z| stands beside the power */
    float exponent;
    aur_vector axis; /* unit, local */
    aur_vector coefficient;
    /* NULL, or what the power lacks of the lobe, of |light.z|: directions are drawn by the power and weighed
     * by the lobe over it (Marques 2018, section 5.1). */
    float (*factor)(const void *data, float cosine);
    const void *factor_data;
} aur_bsdf_lobe;

enum { AUR_BSDF_LOBE_CAPACITY = 4 };

/* A lobe without a formula, alone; as the functions of the whole BSDF below. */
typedef struct aur_bsdf_sampled {
    aur_vector (*evaluate)(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view, aur_vector light);
    float (*pdf)(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view, aur_vector light);
    bool (*sample)(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view, const float u[3],
                   aur_bsdf_sample *sample);
} aur_bsdf_sampled;

typedef struct aur_bsdf_descriptor {
    const char *name;
    const char *summary;
    const char *source;
    /* Reads its parameters (aur_parameters_finish is called by aur_bsdf_create) and sets bsdf->data. */
    aur_result (*create)(aur_parameters *parameters, aur_bsdf *bsdf, aur_error *error);
    void (*release)(aur_bsdf *bsdf); /* frees bsdf->data */
    /* BSDF * |light.z|, RGB, for radiance; 0 where nothing scatters. */
    aur_vector (*evaluate)(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view, aur_vector light);
    /* The density with which `sample` draws `light`, a steradian. */
    float (*pdf)(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view, aur_vector light);
    /* u[0] chooses among lobes, u[1], u[2] a direction; false when the sample is absorbed. */
    bool (*sample)(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view, const float u[3],
                   aur_bsdf_sample *sample);
    /* Fills lobes[AUR_BSDF_LOBE_CAPACITY] and returns how many. */
    size_t (*lobes)(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view, aur_bsdf_lobe *lobes);
    /* The part of the diffuse reflectance that a photon's irradiance is multiplied by: radiance = E * albedo
     * / pi. `side` is the local z of the direction that it is seen from. */
    aur_vector (*diffuse_albedo)(const aur_bsdf *bsdf, aur_bsdf_point point, float side);
    /* Of BSDFs that may have a sampled lobe beside others. NULL: where there is one, it is all there is. */
    const aur_bsdf_sampled *sampled;
} aur_bsdf_descriptor;

struct aur_bsdf {
    const aur_bsdf_descriptor *descriptor;
    void *data;
    bool scatters_from_behind; /* twosided or transmissive: view.z < 0 is not black */
    bool transmits;            /* light may leave on the other side */
    bool plain_diffuse;        /* nothing but diffuse reflection, the same at every point of a surface */
    bool anisotropic;          /* the frame's x axis matters: it is the direction of growing texture u */
    bool textured;             /* something varies over the surface, here or in a nested BSDF */
};

/* The table; NULL beyond it. */
const aur_bsdf_descriptor *aur_bsdf_descriptor_at(size_t index);

/* Builds the material that parameters->plugin names; errors name the file and line. Nested BSDFs are
 * parameters of kind AUR_PARAMETER_OBJECT with object_kind "bsdf", and outlive the one that uses them. */
aur_result aur_bsdf_create(aur_parameters *parameters, aur_bsdf **bsdf, aur_error *error);
void aur_bsdf_destroy(aur_bsdf *bsdf);

/* The sampled lobe: BSDF * |light.z|, the density of its draws, and draws of it, never specular. */
aur_vector aur_bsdf_evaluate_sampled(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view,
                                     aur_vector light);
float aur_bsdf_pdf_sampled(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view, aur_vector light);
bool aur_bsdf_sample_sampled(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view, const float u[3],
                             aur_bsdf_sample *sample);

/* What a lobe's factor is at a cosine. */
static inline float aur_lobe_factor(const aur_bsdf_lobe *lobe, float cosine) {
    return lobe->factor != NULL ? lobe->factor(lobe->factor_data, cosine) : 1.0f;
}

/* --- for the files of the table */

/* bsdf->data = `size` zero bytes. */
aur_result aur_bsdf_allocate(const aur_parameters *parameters, aur_bsdf *bsdf, size_t size, aur_error *error);
/* What smooth materials answer: nothing but Dirac directions. */
aur_vector aur_bsdf_evaluate_none(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view,
                                  aur_vector light);
float aur_bsdf_pdf_none(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view, aur_vector light);
aur_vector aur_bsdf_albedo_none(const aur_bsdf *bsdf, aur_bsdf_point point, float side);
/* A `release` for data that owns nothing else. */
void aur_bsdf_release_data(aur_bsdf *bsdf);
/* The nested BSDF of that name ("bsdf", "bsdf2" when the file gives none); *bsdf keeps its value when absent.
 */
aur_result aur_parameters_nested_bsdf(aur_parameters *parameters, const char *name, const aur_bsdf **bsdf,
                                      aur_error *error);

#endif
