/* Materials: how a surface scatters light. A BSDF is one file (bsdf_*.c) with one line in bsdf_table.c.
 *
 * A material is a list of lobes, fixed when the scene is loaded. At a surface point each lobe has an axis and
 * a coefficient. A lobe whose texture is black stays in the list, so that lobe indices do not change. Other
 * queries are derived from the list (bsdf.c), unless the material has a specialised function.
 *
 * Directions are unit vectors in the local shading frame, z along the shading normal on the side of the
 * shape's normal. `view` is the outgoing direction (to the eye), `light` the incident direction (to the light
 * source). */
#pragma once

#include <stdbool.h>

#include "points/base/keys.h"
#include "points/base/vector.h"

typedef struct aur_bsdf aur_bsdf;

/* The surface point at which a BSDF is evaluated. */
typedef struct aur_bsdf_point {
    float u, v; /* texture coordinates */
    /* Set for bump mapping: dp/du along the frame's x, and dp/dv along x and y. */
    float tangents[3];
    aur_vector vertex_color, face_color; /* of the mesh, 0 if it has none */
    aur_vector position;                 /* scene coordinates, if the material reads them */
} aur_bsdf_point;

/* Mesh attributes that a material reads. A shape can have one vertex attribute and one face attribute. */
typedef struct aur_attributes {
    const char *vertex, *face; /* with prefix, such as "vertex_color"; NULL: none */
    bool too_many;
    bool position; /* also reads the position */
} aur_attributes;

/* Adds what another material or texture reads. */
void aur_attributes_add(aur_attributes *attributes, const aur_attributes *others);

typedef struct aur_bsdf_sample {
    aur_vector light;
    aur_vector weight; /* BSDF * |cos| / pdf, RGB */
    float pdf;         /* pdf by solid angle; undefined if specular */
    bool specular;     /* a Dirac direction: evaluate and pdf are 0 there */
    float ior_squared; /* 0: no refraction. After refraction: the squared index on the light's side over that
                          on the view's. `weight` is for radiance; for particles it is multiplied by this. */
} aur_bsdf_sample;

typedef enum aur_lobe_shape {
    /* coefficient * max(0, axis . light)^exponent [* |light.z|] [* factor], for light on the view's side */
    AUR_LOBE_SHAPE_COSINE_POWER,
    /* coefficient of a Dirac direction `axis` */
    AUR_LOBE_SHAPE_SPECULAR,
    /* No closed form: the material evaluates and samples all such lobes together (AUR_BSDF_SAMPLED_LOBES).
     * `axis` is their approximate direction; the coefficient only shows whether the lobe is present. */
    AUR_LOBE_SHAPE_SAMPLED
} aur_lobe_shape;

/* Direction of a specular lobe: mirror reflection and straight transmission are the same in all materials. */
typedef enum aur_lobe_way {
    AUR_LOBE_WAY_SEPARATE,
    AUR_LOBE_WAY_MIRROR,
    AUR_LOBE_WAY_UNSCATTERED
} aur_lobe_way;

/* The sides from which a lobe is visible. */
enum { AUR_SIDE_FRONT = 1, AUR_SIDE_BACK = 2, AUR_SIDES_BOTH = 3 };

/* One term of BSDF * cos: the material is the sum of its lobes. */
typedef struct aur_bsdf_lobe {
    /* Fixed when the scene is loaded: */
    aur_lobe_shape shape;
    aur_lobe_way way;  /* of specular lobes */
    bool diffuse;      /* about the normal: integrated by the diffuse quadrature rule */
    bool times_cosine; /* the lobe has a factor |light.z| in addition to the power */
    bool transmits;    /* light may come from the side opposite to the view */
    unsigned sides;    /* sides from which it is visible */
    float exponent;
    /* For a sampled lobe of GGX reflection only, with constant isotropic roughness: its alpha; else 0.
     * Sampled from u[1] and u[2] only. */
    float ggx_alpha;
    /* NULL, or the factor of the lobe besides the power, as a function of |light.z|. Directions are sampled
     * by the power, and weighted by the factor (Marques 2018, section 5.1). */
    float (*factor)(const void *data, float cosine);
    const void *factor_data;
    /* At a point and for a view direction: */
    aur_vector axis;        /* unit, local */
    aur_vector coefficient; /* black: absent */
    float ior_squared;      /* of specular lobes; as in aur_bsdf_sample */
} aur_bsdf_lobe;

/* Textures of a material that are fetched ahead; further ones are not. */
enum { AUR_BSDF_TEXTURES = 8 };

/* Materials with more lobes are rejected when they are created. */
enum { AUR_BSDF_LOBE_CAPACITY = 8 };

/* Bit mask of lobe kinds. */
enum {
    AUR_SCATTERS_DIFFUSE = 1,
    AUR_SCATTERS_GLOSSY = 2, /* other powers of a cosine */
    AUR_SCATTERS_SPECULAR = 4,
    AUR_SCATTERS_SAMPLED = 8
};

/* The part of a material that is queried: all of it, or only its sampled lobes, which are never specular. */
typedef enum aur_bsdf_part { AUR_BSDF_WHOLE, AUR_BSDF_SAMPLED_LOBES } aur_bsdf_part;

typedef struct aur_bsdf_descriptor {
    aur_row row;    /* first, so that a row of the table is its descriptor; its parameters are read into
                       bsdf->data */
    size_t size;    /* size of bsdf->data: zeroed before parameters are read, freed in the end */
    bool polarizes; /* as in Mitsuba 3; ignored here, as light is unpolarised */
    /* Completes bsdf->data from the parameters and adds the lobes; sets bsdf->anisotropic. Reads the
     * parameters that are only named in the row (AUR_KEY_READ_APART). */
    aur_result (*create)(aur_parameters *parameters, aur_bsdf *bsdf, aur_error *error);
    /* Sets axis and coefficient of lobes[bsdf->lobe_count], a copy of bsdf->lobes. Coefficients are initially
     * black, and stay so for lobes not visible from `view`. */
    void (*weigh)(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view, aur_bsdf_lobe *lobes);
    /* Specialised versions of the queries below, or NULL: derived from the lobes. A material with a sampled
     * lobe must have the first two. */
    aur_vector (*evaluate)(const aur_bsdf *bsdf, aur_bsdf_part part, aur_bsdf_point point, aur_vector view,
                           aur_vector light, float *pdf);
    bool (*sample)(const aur_bsdf *bsdf, aur_bsdf_part part, aur_bsdf_point point, aur_vector view,
                   const float u[3], aur_bsdf_sample *sample);
    aur_vector (*diffuse_albedo)(const aur_bsdf *bsdf, aur_bsdf_point point, float side);
} aur_bsdf_descriptor;

struct aur_bsdf {
    const aur_bsdf_descriptor *descriptor;
    void *data;
    size_t
        evaluations; /* number of BSDFs evaluated per query: itself and all nested ones, with multiplicity */
    size_t lobe_count;
    aur_bsdf_lobe lobes[AUR_BSDF_LOBE_CAPACITY]; /* their coefficients are black */
    bool anisotropic; /* the frame's x axis matters; it is the direction of growing texture u */
    /* Derived from the lobes and the parameters: */
    unsigned scatters[2];      /* the kinds of lobes visible from the front and from behind */
    bool scatters_from_behind; /* not black for view.z < 0 */
    bool transmits;            /* light may leave on the other side */
    bool textured;             /* varies over the surface, here or in a nested BSDF */
    size_t texture_count;      /* of the textures that can be fetched ahead, here or in a nested BSDF */
    const struct aur_texture *textures[AUR_BSDF_TEXTURES];
    bool bumpy;                /* requires tangents, here or in a nested BSDF */
    aur_attributes attributes; /* mesh attributes read, here or in a nested BSDF */
    bool plain_diffuse;        /* diffuse reflection only, constant over the surface */
    bool passes;               /* may transmit light unscattered */
};

extern const aur_table aur_bsdf_table;

/* Builds the material of parameters->plugin; errors name the file and line. Nested BSDFs are parameters of
 * kind AUR_PARAMETER_OBJECT with object_kind "bsdf", and must outlive this one. */
aur_result aur_bsdf_create(aur_parameters *parameters, aur_bsdf **bsdf, aur_error *error);
void aur_bsdf_destroy(aur_bsdf *bsdf);

/* --- queries of a material */

/* Fills lobes[AUR_BSDF_LOBE_CAPACITY] and returns bsdf->lobe_count. */
size_t aur_bsdf_lobes(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view, aur_bsdf_lobe *lobes);

/* The kinds of lobes visible from the side of a local direction with this z. */
static inline unsigned aur_bsdf_scatters(const aur_bsdf *bsdf, float side) {
    return bsdf->scatters[side < 0.0f ? 1 : 0];
}

/* BSDF * |light.z|, RGB, for radiance; 0 without scattering. *pdf is the pdf by solid angle with which
 * aur_bsdf_draw samples `light`. */
aur_vector aur_bsdf_evaluate(const aur_bsdf *bsdf, aur_bsdf_part part, aur_bsdf_point point, aur_vector view,
                             aur_vector light, float *pdf);
/* u[0] selects a lobe, u[1], u[2] a direction; false if the sample is absorbed. */
bool aur_bsdf_draw(const aur_bsdf *bsdf, aur_bsdf_part part, aur_bsdf_point point, aur_vector view,
                   const float u[3], aur_bsdf_sample *sample);
/* Unscattered transmission, RGB, as if there were no surface. */
aur_vector aur_bsdf_passed(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view);
/* The diffuse albedo for photon irradiance: radiance = E * albedo / pi. `side` is the local z of the view
 * direction. */
aur_vector aur_bsdf_diffuse_albedo(const aur_bsdf *bsdf, aur_bsdf_point point, float side);

/* A lobe's factor at a cosine. */
static inline float aur_lobe_factor(const aur_bsdf_lobe *lobe, float cosine) {
    return lobe->factor != NULL ? lobe->factor(lobe->factor_data, cosine) : 1.0f;
}

/* Value of a closed-form lobe for a local direction, BSDF * |cos|, given the power of its cosine. */
static inline aur_vector aur_lobe_value_of_power(const aur_bsdf_lobe *lobe, float power, aur_vector light) {
    const float factor = aur_lobe_factor(lobe, fabsf(light.z));
    return aur_vector_scale(lobe->coefficient,
                            factor * (lobe->times_cosine ? power * fabsf(light.z) : power));
}

/* The same for light on the view's side. */
static inline aur_vector aur_lobe_value(const aur_bsdf_lobe *lobe, aur_vector light) {
    const float along = aur_vector_dot(lobe->axis, light);
    if (lobe->shape != AUR_LOBE_SHAPE_COSINE_POWER || along <= 0.0f)
        return (aur_vector){0};
    const float power = lobe->exponent == 1.0f ? along : powf(along, lobe->exponent);
    return aur_lobe_value_of_power(lobe, power, light);
}

/* --- for implementations of materials */

/* Lambertian lobe about the normal, seen from the front. */
static inline aur_bsdf_lobe aur_diffuse_lobe(void) {
    return (aur_bsdf_lobe){.shape = AUR_LOBE_SHAPE_COSINE_POWER,
                           .diffuse = true,
                           .sides = AUR_SIDE_FRONT,
                           .exponent = 1.0f,
                           .axis = {0.0f, 0.0f, 1.0f}};
}

/* Full transmission without a surface, as in `null`. */
extern const aur_bsdf aur_bsdf_nothing;

/* Adds a lobe and returns its index. aur_bsdf_create rejects materials with more lobes than the capacity. */
size_t aur_bsdf_add_lobe(aur_bsdf *bsdf, const aur_bsdf_lobe *lobe);
/* The nested BSDF of that name ("bsdf", "bsdf2" by default); *bsdf is unchanged if absent. */
aur_result aur_parameters_nested_bsdf(aur_parameters *parameters, const char *name, const aur_bsdf **bsdf,
                                      aur_error *error);

/* A row for tables of parameters, for a nested BSDF. */
#define AUR_NESTED_BSDF_KEY(name_, default_, help_)                                                          \
    {                                                                                                        \
        AUR_KEY_READ_APART(AUR_KEY_ITEM, name_, default_, help_), .words = (const char *const[]) {           \
            "bsdf", NULL                                                                                     \
        }                                                                                                    \
    }
