/* Textures: values that vary over a surface. A texture is one file (texture_*.c), with one line in
 * texture_table.c. */
#pragma once

#include "points/base/keys.h"
#include "render/scene/materials/bsdf.h"
#include "render/scene/materials/sampling.h"

typedef struct aur_texture aur_texture;

typedef struct aur_texture_descriptor {
    aur_row row; /* first, so that a row of the table is its descriptor */
    size_t size; /* size of texture->data: zeroed before `create`, freed in the end */
    /* Reads its parameters (aur_colors_read), fills texture->data and sets texture->mean and
     * texture->maximum. */
    aur_result (*create)(aur_parameters *parameters, aur_texture *texture, aur_error *error);
    void (*release)(void *data); /* frees what texture->data points to; NULL: nothing */
    aur_vector (*evaluate)(const aur_texture *texture, aur_bsdf_point point);
    /* Starts to load what `evaluate` reads at the point; NULL: nothing worth it. */
    void (*prefetch)(const aur_texture *texture, aur_bsdf_point point);
    /* Derivatives of the luminance by u and v; NULL: zero. */
    void (*slope)(const aur_texture *texture, aur_bsdf_point point, float slope[2]);
} aur_texture_descriptor;

struct aur_texture {
    const aur_texture_descriptor *descriptor;
    void *data;
    struct aur_texel_pages *pages; /* storage of texels; NULL: memory */
    aur_vector mean;               /* mean over the unit square */
    float maximum;                 /* maximum of any channel; 0: not available */
    float aspect;                  /* width over height of an image; 0: not an image */
    aur_attributes attributes;     /* mesh attributes read, here or in a nested texture */
};

extern const aur_table aur_texture_table;

/* Builds the texture of parameters->plugin. A bitmap's `filename` must already be resolved. `pages` may be
 * NULL, and must outlive the texture. */
aur_result aur_texture_create(aur_parameters *parameters, struct aur_texel_pages *pages,
                              aur_texture **texture, aur_error *error);
void aur_texture_destroy(aur_texture *texture);

/* The affine map `to_uv` of a texture. */
typedef struct aur_uv_map {
    float m[6]; /* u' = m0 u + m1 v + m2, v' = m3 u + m4 v + m5 */
} aur_uv_map;

/* Parameters for it: `to_uv`, or the form of Mitsuba 0.6. */
typedef struct aur_uv_keys {
    double to_uv[16], scale[2], offset[2];
} aur_uv_keys;

/* Rows for tables of parameters; the struct has a member `aur_uv_keys uv`. */
#define AUR_UV_KEYS(struct_)                                                                                 \
    {AUR_KEY_OF_TRANSFORM(struct_, "to_uv", uv.to_uv, "applied to the texture coordinates")},                \
        {AUR_KEY_OF_REAL(struct_, "uscale", uv.scale[0], -1e30, 1e30, "1", "factor of u")},                  \
        {AUR_KEY_OF_REAL(struct_, "vscale", uv.scale[1], -1e30, 1e30, "1", "factor of v")},                  \
        {AUR_KEY_OF_REAL(struct_, "uoffset", uv.offset[0], -1e30, 1e30, "0", "added to u")}, {               \
        AUR_KEY_OF_REAL(struct_, "voffset", uv.offset[1], -1e30, 1e30, "0", "added to v")                    \
    }

aur_uv_map aur_uv_map_of(const aur_uv_keys *keys);

static inline aur_bsdf_point aur_uv_map_apply(const aur_uv_map *map, float u, float v) {
    return (aur_bsdf_point){.u = map->m[0] * u + map->m[1] * v + map->m[2],
                            .v = map->m[3] * u + map->m[4] * v + map->m[5]};
}

/* An image's red, green and blue, or grey three times, top row first; *rgb is malloc'ed. Infinite values
 * become the largest half, 65504; NaN and negative ones 0. Errors: ARGUMENT for channels that are not a
 * colour, MEMORY. */
struct aur_image;
aur_result aur_image_radiance(const char *name, const struct aur_image *image, float **rgb, aur_error *error);

static inline aur_vector aur_color_at(const aur_color *color, aur_bsdf_point point) {
    return color->texture == NULL ? color->constant
                                  : color->texture->descriptor->evaluate(color->texture, point);
}

/* For scalar parameters: the luminance of a texture that is not grey. */
static inline float aur_color_number_at(const aur_color *color, aur_bsdf_point point) {
    const aur_vector value = aur_color_at(color, point);
    return value.x == value.y && value.y == value.z ? value.x : aur_luminance(value);
}

static inline aur_vector aur_color_mean(const aur_color *color) {
    return color->texture == NULL ? color->constant : color->texture->mean;
}

/* aur_row_read for structs with colour parameters: a texture must not exceed the parameter's maximum. */
aur_result aur_colors_read(const aur_row *row, aur_parameters *parameters, void *fields, aur_error *error);
