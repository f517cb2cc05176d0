/* Materials: how a surface scatters light. A BSDF is one file (bsdf_*.c) with one line in bsdf_table.c.
 *
 * A material is a list of lobes that is fixed when the scene is loaded. At a point of the surface each lobe
 * has an axis and a coefficient; where a texture makes it black it is still there, so that lobes keep their
 * numbers. What else is asked of a material follows from the list (bsdf.c), unless the material has a better
 * form of its own.
 *
 * Directions are unit vectors in the local shading frame, z along the shading normal on the side that the
 * shape's normal points to. `view` points to where light goes (the eye), `light` to where it comes from. */
#pragma once

#include <stdbool.h>

#include "points/base/keys.h"
#include "points/base/vector.h"

typedef struct aur_bsdf aur_bsdf;

/* Where on a surface a BSDF is asked. */
typedef struct aur_bsdf_point {
    float u, v; /* texture coordinates */
    /* Set where the material is bumpy: how far the surface goes along the frame's x for a step of u, and
     * along its x and y for one of v. */
    float tangents[3];
    aur_vector vertex_color, face_color; /* the mesh's, 0 where it has none */
    aur_vector position;                 /* in the scene, where the material reads it */
} aur_bsdf_point;

/* The attributes of meshes that a material reads: one of vertices and one of faces are what a shape can have.
 */
typedef struct aur_attributes {
    const char *vertex, *face; /* with their beginnings, "vertex_color"; NULL: none */
    bool too_many;
    bool position; /* and where a point is */
} aur_attributes;

/* Adds what another material or texture reads. */
void aur_attributes_add(aur_attributes *attributes, const aur_attributes *others);

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
    /* coefficient * max(0, axis . light)^exponent [* |light.z|] [* factor], where light is on the view's side
     */
    AUR_LOBE_SHAPE_COSINE_POWER,
    /* coefficient of a Dirac direction `axis` */
    AUR_LOBE_SHAPE_SPECULAR,
    /* No formula, about `axis`: the material itself evaluates and draws it, with all its sampled lobes at
     * once (AUR_BSDF_SAMPLED_LOBES). The coefficient only says whether it is there. */
    AUR_LOBE_SHAPE_SAMPLED
} aur_lobe_shape;

/* Where light of a specular lobe comes from: lobes that mirror, or let light straight through, are alike in
 * all materials. */
typedef enum aur_lobe_way {
    AUR_LOBE_WAY_SEPARATE,
    AUR_LOBE_WAY_MIRROR,
    AUR_LOBE_WAY_UNSCATTERED
} aur_lobe_way;

/* The sides of a surface that something is seen from. */
enum { AUR_SIDE_FRONT = 1, AUR_SIDE_BACK = 2, AUR_SIDES_BOTH = 3 };

/* One part of BSDF * cos: the sum of the lobes is the material. */
typedef struct aur_bsdf_lobe {
    /* Fixed when the scene is loaded: */
    aur_lobe_shape shape;
    aur_lobe_way way;  /* of specular lobes */
    bool diffuse;      /* about the normal: gathered by the diffuse rule */
    bool times_cosine; /* the factor |light.z| stands beside the power */
    bool transmits;    /* light may come from the other side than the view's */
    unsigned sides;    /* that it may be seen from */
    float exponent;
    /* Of a sampled lobe that is only mirroring facets of the GGX distribution, equally rough
     * everywhere and both ways: its alpha; else 0. It is drawn by u[1] and u[2] alone. */
    float ggx_alpha;
    /* NULL, or what the power lacks of the lobe, of |light.z|: directions are drawn by the power and weighed
     * by the lobe over it (Marques 2018, section 5.1). */
    float (*factor)(const void *data, float cosine);
    const void *factor_data;
    /* At a point and from a view: */
    aur_vector axis;        /* unit, local */
    aur_vector coefficient; /* black: not there */
    float ior_squared;      /* of specular lobes; as in aur_bsdf_sample */
} aur_bsdf_lobe;

/* A material with more lobes is refused when it is made. */
enum { AUR_BSDF_LOBE_CAPACITY = 8 };

/* What kinds of lobes there are, a bit each. */
enum {
    AUR_SCATTERS_DIFFUSE = 1,
    AUR_SCATTERS_GLOSSY = 2, /* other powers of a cosine */
    AUR_SCATTERS_SPECULAR = 4,
    AUR_SCATTERS_SAMPLED = 8
};

/* What is asked of a material: all of it, or its sampled lobes alone, which are never specular. */
typedef enum aur_bsdf_part { AUR_BSDF_WHOLE, AUR_BSDF_SAMPLED_LOBES } aur_bsdf_part;

typedef struct aur_bsdf_descriptor {
    aur_row row; /* first, so that a row of the table is its descriptor; its keys are read into bsdf->data */
    size_t size; /* of what bsdf->data points to: zeroed before the keys are read, freed in the end */
    bool polarizes; /* in Mitsuba 3; here light has no polarisation */
    /* Makes the rest of bsdf->data from what has been read and adds the lobes; sets bsdf->anisotropic. It
     * reads those keys that the row only names (AUR_KEY_READ_APART). */
    aur_result (*create)(aur_parameters *parameters, aur_bsdf *bsdf, aur_error *error);
    /* Sets axis and coefficient of lobes[bsdf->lobe_count], a copy of bsdf->lobes; the coefficients come in
     * black, and stay so for lobes that are not seen from `view`. */
    void (*weigh)(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view, aur_bsdf_lobe *lobes);
    /* The material's own forms of what is asked below, each of which may be NULL: then it follows from the
     * lobes. A material with a sampled lobe has the first two. */
    aur_vector (*evaluate)(const aur_bsdf *bsdf, aur_bsdf_part part, aur_bsdf_point point, aur_vector view,
                           aur_vector light, float *pdf);
    bool (*sample)(const aur_bsdf *bsdf, aur_bsdf_part part, aur_bsdf_point point, aur_vector view,
                   const float u[3], aur_bsdf_sample *sample);
    aur_vector (*diffuse_albedo)(const aur_bsdf *bsdf, aur_bsdf_point point, float side);
} aur_bsdf_descriptor;

struct aur_bsdf {
    const aur_bsdf_descriptor *descriptor;
    void *data;
    size_t evaluations; /* bsdfs that may be evaluated for this one: itself and all inside, as often as they
                     are named */
    size_t lobe_count;
    aur_bsdf_lobe lobes[AUR_BSDF_LOBE_CAPACITY]; /* their coefficients are black */
    bool anisotropic; /* the frame's x axis matters: it is the direction of growing texture u */
    /* What follows from the lobes and the parameters: */
    unsigned scatters[2];      /* the kinds of lobes seen from the front and from behind */
    bool scatters_from_behind; /* view.z < 0 is not black */
    bool transmits;            /* light may leave on the other side */
    bool textured;             /* something varies over the surface, here or in a nested BSDF */
    bool bumpy;                /* asks for a point's tangents, here or in a nested BSDF */
    aur_attributes attributes; /* of meshes, that it reads, here or in a nested BSDF */
    bool plain_diffuse;        /* only diffuse reflection, the same at every point of a surface */
    bool passes;               /* may let light straight through */
};

extern const aur_table aur_bsdf_table;

/* Builds the material that parameters->plugin names; errors name the file and line. Nested BSDFs are
 * parameters of kind AUR_PARAMETER_OBJECT with object_kind "bsdf", and outlive the one that uses them. */
aur_result aur_bsdf_create(aur_parameters *parameters, aur_bsdf **bsdf, aur_error *error);
void aur_bsdf_destroy(aur_bsdf *bsdf);

/* --- what is asked of a material */

/* Fills lobes[AUR_BSDF_LOBE_CAPACITY] and returns bsdf->lobe_count. */
size_t aur_bsdf_lobes(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view, aur_bsdf_lobe *lobes);

/* The kinds of lobes that may be seen from the side of a local direction with this z. */
static inline unsigned aur_bsdf_scatters(const aur_bsdf *bsdf, float side) {
    return bsdf->scatters[side < 0.0f ? 1 : 0];
}

/* BSDF * |light.z|, RGB, for radiance; 0 where nothing scatters. *pdf is the density, a steradian, with which
 * aur_bsdf_draw draws `light`. */
aur_vector aur_bsdf_evaluate(const aur_bsdf *bsdf, aur_bsdf_part part, aur_bsdf_point point, aur_vector view,
                             aur_vector light, float *pdf);
/* u[0] chooses among lobes, u[1], u[2] a direction; false when the sample is absorbed. */
bool aur_bsdf_draw(const aur_bsdf *bsdf, aur_bsdf_part part, aur_bsdf_point point, aur_vector view,
                   const float u[3], aur_bsdf_sample *sample);
/* The part of light that goes straight through, as if there were no surface, RGB. */
aur_vector aur_bsdf_passed(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view);
/* The part of the diffuse reflectance that a photon's irradiance is multiplied by: radiance = E * albedo
 * / pi. `side` is the local z of the direction that it is seen from. */
aur_vector aur_bsdf_diffuse_albedo(const aur_bsdf *bsdf, aur_bsdf_point point, float side);

/* What a lobe's factor is at a cosine. */
static inline float aur_lobe_factor(const aur_bsdf_lobe *lobe, float cosine) {
    return lobe->factor != NULL ? lobe->factor(lobe->factor_data, cosine) : 1.0f;
}

/* What a lobe with a formula has towards a local direction, BSDF * |cos|, by the power of its cosine there.
 */
static inline aur_vector aur_lobe_value_of_power(const aur_bsdf_lobe *lobe, float power, aur_vector light) {
    const float factor = aur_lobe_factor(lobe, fabsf(light.z));
    return aur_vector_scale(lobe->coefficient,
                            factor * (lobe->times_cosine ? power * fabsf(light.z) : power));
}

/* The same on the view's side. */
static inline aur_vector aur_lobe_value(const aur_bsdf_lobe *lobe, aur_vector light) {
    const float along = aur_vector_dot(lobe->axis, light);
    if (lobe->shape != AUR_LOBE_SHAPE_COSINE_POWER || along <= 0.0f)
        return (aur_vector){0};
    const float power = lobe->exponent == 1.0f ? along : powf(along, lobe->exponent);
    return aur_lobe_value_of_power(lobe, power, light);
}

/* --- for the files of the table */

/* Lambert's lobe about the normal, seen from the front. */
static inline aur_bsdf_lobe aur_diffuse_lobe(void) {
    return (aur_bsdf_lobe){.shape = AUR_LOBE_SHAPE_COSINE_POWER,
                           .diffuse = true,
                           .sides = AUR_SIDE_FRONT,
                           .exponent = 1.0f,
                           .axis = {0.0f, 0.0f, 1.0f}};
}

/* Where there is no surface: what `null` is. */
extern const aur_bsdf aur_bsdf_nothing;

/* Adds a lobe and returns its number. aur_bsdf_create refuses a material that has more than the capacity. */
size_t aur_bsdf_add_lobe(aur_bsdf *bsdf, const aur_bsdf_lobe *lobe);
/* The nested BSDF of that name ("bsdf", "bsdf2" when the file gives none); *bsdf keeps its value when absent.
 */
aur_result aur_parameters_nested_bsdf(aur_parameters *parameters, const char *name, const aur_bsdf **bsdf,
                                      aur_error *error);

/* A row for tables of keys, of what it reads. */
#define AUR_NESTED_BSDF_KEY(name_, default_, help_)                                                          \
    {                                                                                                        \
        AUR_KEY_READ_APART(AUR_KEY_ITEM, name_, default_, help_), .words = (const char *const[]) {           \
            "bsdf", NULL                                                                                     \
        }                                                                                                    \
    }
