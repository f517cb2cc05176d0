/* The Lambertian surface. Most surfaces use it, so it has specialised versions of all queries. */
#include "render/scene/materials/sampling.h"
#include "render/scene/materials/texture.h"

typedef struct diffuse {
    aur_color reflectance;
} diffuse;

static const aur_key keys[] = {
    {AUR_KEY_OF_COLOR(diffuse, "reflectance", reflectance, 1.0, "0.5",
                      "share of the light that is reflected")},
};

static aur_result create(aur_parameters *parameters, aur_bsdf *bsdf, aur_error *error) {
    (void)parameters;
    (void)error;
    const aur_bsdf_lobe lobe = aur_diffuse_lobe();
    aur_bsdf_add_lobe(bsdf, &lobe);
    return AUR_OK;
}

static void weigh(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view, aur_bsdf_lobe *lobes) {
    const diffuse *const self = bsdf->data;
    if (view.z > 0.0f)
        lobes[0].coefficient = aur_vector_scale(aur_color_at(&self->reflectance, point), 1.0f / AUR_PI_F);
}

static aur_vector evaluate(const aur_bsdf *bsdf, aur_bsdf_part part, aur_bsdf_point point, aur_vector view,
                           aur_vector light, float *pdf) {
    (void)part;
    const diffuse *const self = bsdf->data;
    *pdf = view.z > 0.0f && light.z > 0.0f ? light.z / AUR_PI_F : 0.0f;
    return *pdf > 0.0f ? aur_vector_scale(aur_color_at(&self->reflectance, point), *pdf) : (aur_vector){0};
}

static bool sample(const aur_bsdf *bsdf, aur_bsdf_part part, aur_bsdf_point point, aur_vector view,
                   const float u[3], aur_bsdf_sample *drawn) {
    (void)part;
    const diffuse *const self = bsdf->data;
    if (view.z <= 0.0f)
        return false;
    const aur_vector light = aur_sample_cosine(u[1], u[2]);
    *drawn = (aur_bsdf_sample){
        .light = light, .weight = aur_color_at(&self->reflectance, point), .pdf = light.z / AUR_PI_F};
    return light.z > 0.0f;
}

static aur_vector diffuse_albedo(const aur_bsdf *bsdf, aur_bsdf_point point, float side) {
    const diffuse *const self = bsdf->data;
    return side > 0.0f ? aur_color_at(&self->reflectance, point) : (aur_vector){0};
}

const aur_bsdf_descriptor aur_bsdf_diffuse = {
    .row = {.name = "diffuse",
            .summary = "ideally diffuse reflection",
            .source = "Lambert 1760",
            AUR_ROW_KEYS(keys)},
    .size = sizeof(diffuse),
    .create = create,
    .weigh = weigh,
    .evaluate = evaluate,
    .sample = sample,
    .diffuse_albedo = diffuse_albedo,
};
