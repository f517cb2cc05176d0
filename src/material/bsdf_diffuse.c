/* Lambert's ideally diffuse surface. */
#include "material/sampling.h"
#include "material/texture.h"

typedef struct diffuse {
    aur_color reflectance;
} diffuse;

static aur_result create(aur_parameters *parameters, aur_bsdf *bsdf, aur_error *error) {
    const aur_result result = aur_bsdf_allocate(parameters, bsdf, sizeof(diffuse), error);
    if (result != AUR_OK)
        return result;
    diffuse *const self = bsdf->data;
    self->reflectance.constant = (aur_vector){0.5f, 0.5f, 0.5f};
    const aur_result read = aur_parameters_color(parameters, "reflectance", 1.0, &self->reflectance, error);
    bsdf->plain_diffuse = self->reflectance.texture == NULL;
    return read;
}

static aur_vector evaluate(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view, aur_vector light) {
    const diffuse *const self = bsdf->data;
    if (view.z <= 0.0f || light.z <= 0.0f)
        return (aur_vector){0};
    return aur_vector_scale(aur_color_at(&self->reflectance, point), light.z / AUR_PI_F);
}

static float pdf(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view, aur_vector light) {
    (void)bsdf;
    (void)point;
    return view.z > 0.0f && light.z > 0.0f ? light.z / AUR_PI_F : 0.0f;
}

static bool sample(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view, const float u[3],
                   aur_bsdf_sample *drawn) {
    const diffuse *const self = bsdf->data;
    if (view.z <= 0.0f)
        return false;
    const aur_vector light = aur_sample_cosine(u[1], u[2]);
    *drawn = (aur_bsdf_sample){
        .light = light, .weight = aur_color_at(&self->reflectance, point), .pdf = light.z / AUR_PI_F};
    return light.z > 0.0f;
}

static size_t lobes(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view, aur_bsdf_lobe *lobe) {
    const diffuse *const self = bsdf->data;
    if (view.z <= 0.0f)
        return 0;
    lobe[0] = (aur_bsdf_lobe){.shape = AUR_LOBE_SHAPE_COSINE_POWER,
                              .diffuse = true,
                              .exponent = 1.0f,
                              .axis = {0.0f, 0.0f, 1.0f},
                              .coefficient =
                                  aur_vector_scale(aur_color_at(&self->reflectance, point), 1.0f / AUR_PI_F)};
    return 1;
}

static aur_vector diffuse_albedo(const aur_bsdf *bsdf, aur_bsdf_point point, float side) {
    const diffuse *const self = bsdf->data;
    return side > 0.0f ? aur_color_at(&self->reflectance, point) : (aur_vector){0};
}

const aur_bsdf_descriptor aur_bsdf_diffuse = {
    "diffuse",
    "ideally diffuse reflection",
    "Lambert 1760",
    create,
    aur_bsdf_release_data,
    evaluate,
    pdf,
    sample,
    lobes,
    diffuse_albedo,
    NULL,
};
