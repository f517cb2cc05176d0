/* The materials for all material tests, created from text. */
#pragma once

#include "check.h"

#include <string.h>

#include "points/base/random.h"
#include "render/scene/materials/bsdf.h"
#include "render/scene/materials/texture.h"
#include "short.h"

typedef struct material_row {
    const char *text;   /* PLUGIN:key=value,... */
    const char *nested; /* the same for a nested bsdf, or NULL; FIRST|SECOND for two */
    int flags;
} material_row;

enum { NOT_RECIPROCAL = 1, NARROW = 2, WHITE = 4, GLASS = 8 /* of index 1.5 */ };

static const material_row material_rows[] = {
    {"diffuse:reflectance=0.7", NULL, 0},
    {"phong:exponent=0,diffuse_reflectance=0.1,specular_reflectance=0.6", NULL, 0},
    {"phong:exponent=7.5,diffuse_reflectance=0.3,specular_reflectance=0.5", NULL, 0},
    {"phong:exponent=300,diffuse_reflectance=0,specular_reflectance=1", NULL, NARROW},
    {"phong_lobe:exponent=20,diffuse_reflectance=0.4,specular_reflectance=0.6", NULL, NOT_RECIPROCAL},
    {"phong_lobe:exponent=200,diffuse_reflectance=0,specular_reflectance=0.9", NULL, NOT_RECIPROCAL | NARROW},
    {"twosided", "diffuse:reflectance=0.6", 0},
    {"twosided", "phong:exponent=12", 0},
    {"conductor:material=Au", NULL, 0},
    {"conductor", NULL, WHITE},
    {"roughconductor:alpha=0.3,material=Cu", NULL, 0},
    {"roughconductor:alpha=0.1,distribution=ggx,eta=-0.2,k=-3.9", NULL, NARROW},
    {"roughconductor:alpha_u=0.4,alpha_v=0.15", NULL, 0},
    {"roughconductor:alpha_u=0.15,alpha_v=0.5,distribution=ggx", NULL, 0},
    {"twosided", "roughconductor:alpha=0.6", 0},
    {"dielectric:int_ior=diamond", NULL, WHITE},
    {"thindielectric", NULL, WHITE},
    {"glass:int_ior=1.52", NULL, WHITE},
    {"glass:transmissivity=0.7", NULL, 0},
    {"roughdielectric:alpha=0.3,int_ior=1.5,ext_ior=1", NULL, GLASS},
    {"roughdielectric:alpha_u=0.2,alpha_v=0.5,int_ior=1.5,ext_ior=1,distribution=ggx", NULL, NARROW | GLASS},
    {"plastic:diffuse_reflectance=1,nonlinear=true", NULL, WHITE},
    {"plastic:diffuse_reflectance=0.3", NULL, 0},
    {"roughplastic:alpha=0.2,diffuse_reflectance=0.6,distribution=ggx", NULL, 0},
    {"roughplastic:alpha=0.4,diffuse_reflectance=0.8,nonlinear=true", NULL, 0},
    {"principled:base_color=0.6,roughness=0.7", NULL, 0},
    {"principled:base_color=0.5,flatness=0.8,sheen=0.3,sheen_tint=1,clearcoat=1", NULL, 0},
    {"principled:base_color=0.6,metallic=1,roughness=0.5,anisotropic=0.5", NULL, 0},
    {"principled:base_color=0.8,spec_trans=0.6,eta=1.5,roughness=0.6,metallic=0.2,spec_tint=0.5", NULL,
     GLASS},
    {"principled:base_color=0.9,spec_trans=1,eta=1.5,roughness=0.7", NULL, GLASS},
    {"twosided", "principled:base_color=0.7,metallic=0.4,roughness=0.5", 0},
    {"principledthin:base_color=0.8,roughness=0.6", NULL, 0},
    {"principledthin:base_color=0.7,spec_trans=0.7,roughness=0.6,anisotropic=0.5,diff_trans=0.6", NULL,
     NOT_RECIPROCAL},
    {"principledthin:base_color=0.8,spec_trans=1,roughness=0.7,spec_tint=0.3", NULL, NOT_RECIPROCAL},
    {"mask:opacity=0.25", "diffuse:reflectance=0.9", 0},
    {"pplastic:diffuse_reflectance=0.6,alpha=0.2", NULL, 0},
    {"pplastic:alpha_u=0.4,alpha_v=0.2,distribution=ggx", NULL, 0},
    {"null", NULL, WHITE},
    {"polarizer:transmittance=0.9", NULL, 0},
    {"retarder", NULL, WHITE},
    {"circular", NULL, 0},
    {"blendbsdf:weight=0.3", "diffuse:reflectance=0.7|roughconductor:alpha=0.4", 0},
    {"blendbsdf:weight=0.6", "roughplastic:alpha=0.3|roughdielectric:alpha=0.5,int_ior=1.5,ext_ior=1", GLASS},
    {"normalmap:normalmap=0.6 0.45 0.9", "roughconductor:alpha=0.4", NOT_RECIPROCAL},
    {"normalmap:normalmap=0.7 0.5 0.9,use_shadowing_function=false,flip_invalid_normals=false",
     "phong:exponent=10", NOT_RECIPROCAL},
    {"normalmap:normalmap=0.6 0.45 0.9", "plastic:diffuse_reflectance=0.5", NOT_RECIPROCAL},
    {"mask:opacity=0.7", "roughconductor:alpha=0.4", 0},
    {"bumpmap:scale=0.5", "diffuse:reflectance=0.8", NOT_RECIPROCAL},
    {"bumpmap:scale=-0.3,use_shadowing_function=false", "roughconductor:alpha=0.4", NOT_RECIPROCAL},
    {"ward:alpha=0.3,diffuse_reflectance=0.3,specular_reflectance=0.4", NULL, 0},
    {"ward:alpha=0.15,diffuse_reflectance=0.2,diffuse_transmittance=0.2,specular_transmittance=0.3", NULL,
     NOT_RECIPROCAL},
    {"ward:alpha=0,varnished=true,diffuse_reflectance=0.5,specular_reflectance=0.04", NULL, 0},
    {"ward:alpha=0,diffuse_transmittance=0.2,specular_transmittance=0.3,diffuse_reflectance=0.3", NULL,
     WHITE},
    {"twosided", "ward:alpha=0.2", 0},
    {"roughdiffuse:reflectance=0.8,alpha=0.6", NULL, 0},
    {"roughdiffuse:reflectance=0.7,alpha=1,use_fast_approx=true", NULL, 0},
    {"difftrans:transmittance=0.6", NULL, 0},
    {"coating", "diffuse:reflectance=0.8", 0},
    {"coating:sigma_a=0.4,thickness=0.5,int_ior=1.7", "roughconductor:alpha=0.3,material=Cu", 0},
    {"coating:sigma_a=0.1", "conductor:material=Au", 0},
    {"coating", "roughplastic:alpha=0.3,diffuse_reflectance=0.6", 0},
    {"roughcoating:alpha=0.3", "diffuse:reflectance=0.8", 0},
    {"roughcoating:alpha=0.2,distribution=ggx,sigma_a=0.3", "roughconductor:alpha=0.4", 0},
    {"roughcoating:alpha=0.2", "conductor", 0},
    {"roughconductor:alpha=0.3,distribution=phong,material=Cu", NULL, 0},
    {"roughconductor:alpha_u=0.15,alpha_v=0.5,distribution=as", NULL, 0},
    {"roughdielectric:alpha=0.3,int_ior=1.5,ext_ior=1,distribution=phong", NULL, NARROW | GLASS},
    {"roughplastic:alpha=0.3,diffuse_reflectance=0.6,distribution=phong", NULL, 0},
};

enum { MATERIAL_COUNT = sizeof material_rows / sizeof material_rows[0] };

/* The heights of bumpmaps: they grow by 1 along u and fall by a half along v. */
static inline void slant_slope(const aur_texture *texture, aur_bsdf_point point, float slope[2]) {
    (void)texture;
    (void)point;
    slope[0] = 1.0f;
    slope[1] = -0.5f;
}

static inline aur_vector slant_height(const aur_texture *texture, aur_bsdf_point point) {
    (void)texture;
    const float height = point.u - 0.5f * point.v;
    return (aur_vector){height, height, height};
}

static const aur_texture_descriptor slant_descriptor = {.evaluate = slant_height, .slope = slant_slope};
static const aur_texture slant = {.descriptor = &slant_descriptor};

typedef struct material {
    aur_bsdf *bsdf, *nested[2];
} material;

static inline aur_bsdf *make_bsdf_of(const char *text, const aur_bsdf *const nested[2]) {
    static const char *const names[] = {"bsdf", "bsdf2"};
    aur_parameters parameters;
    aur_error error = {0};
    aur_bsdf *bsdf = NULL;
    assert_int_equal(aur_parameters_parse(&parameters, "bsdf", text, &error), AUR_OK);
    for (size_t i = 0; i < 2; ++i)
        if (nested[i] != NULL)
            assert_int_equal(aur_parameters_add_object(&parameters, names[i], "bsdf", nested[i],
                                                       (aur_location){0}, &error),
                             AUR_OK);
    if (strcmp(parameters.plugin, "bumpmap") == 0)
        assert_int_equal(
            aur_parameters_add_object(&parameters, "texture", "texture", &slant, (aur_location){0}, &error),
            AUR_OK);
    if (aur_bsdf_create(&parameters, &bsdf, &error) != AUR_OK)
        fail_msg("%s: %s", text, error.message);
    aur_parameters_release(&parameters);
    return bsdf;
}

static inline aur_bsdf *make_bsdf(const char *text, const aur_bsdf *nested) {
    return make_bsdf_of(text, (const aur_bsdf *const[2]){nested, NULL});
}

static inline material make_material(const material_row *row) {
    material built = {NULL, {NULL, NULL}};
    char first[128] = "";
    if (row->nested != NULL) {
        const char *const bar = strchr(row->nested, '|');
        strncat(first, row->nested, bar != NULL ? (size_t)(bar - row->nested) : sizeof first - 1);
        built.nested[0] = make_bsdf(first, NULL);
        built.nested[1] = bar != NULL ? make_bsdf(bar + 1, NULL) : NULL;
    }
    built.bsdf = make_bsdf_of(row->text, (const aur_bsdf *const[2]){built.nested[0], built.nested[1]});
    return built;
}

static inline void drop_material(material *built) {
    aur_bsdf_destroy(built->bsdf);
    aur_bsdf_destroy(built->nested[0]);
    aur_bsdf_destroy(built->nested[1]);
}

static inline float unit(uint64_t a, uint64_t b, uint64_t c) {
    return aur_unit_float((uint32_t)(aur_hash3(a, b, c) >> 32));
}

/* View directions from normal to grazing, and from behind if the material scatters there. */
enum { VIEW_COUNT = 12 };

/* A short test has a third of them for each material, others for the next one. */
static inline size_t view_step(void) {
    return check_short() ? 3 : 1;
}

static inline size_t first_view(size_t row) {
    return row % view_step();
}

static inline bool view_at(const aur_bsdf *bsdf, size_t index, aur_vector *view) {
    static const float angles[6] = {0.0f, 15.0f, 40.0f, 60.0f, 75.0f, 87.0f};
    if (index >= 6 && !bsdf->scatters_from_behind)
        return false;
    const float theta = angles[index % 6] * AUR_PI_F / 180.0f;
    const float phi = 1.0f + (float)index;
    *view = (aur_vector){sinf(theta) * cosf(phi), sinf(theta) * sinf(phi), cosf(theta)};
    if (index >= 6)
        view->z = -view->z;
    return true;
}
