#include "material/phong.h"

#include "material/sampling.h"

static bool may_reflect(const aur_color *color) {
    return color->texture != NULL || aur_vector_max(color->constant) > 0.0f;
}

aur_result aur_phong_create(aur_parameters *parameters, aur_bsdf *bsdf, bool times_cosine, aur_error *error) {
    aur_phong *const self = bsdf->data;
    self->diffuse.constant = (aur_vector){0.5f, 0.5f, 0.5f};
    self->specular.constant = (aur_vector){0.2f, 0.2f, 0.2f};
    double exponent = 30.0;
    aur_result result = aur_parameters_color(parameters, "diffuse_reflectance", 1.0, &self->diffuse, error);
    if (result == AUR_OK)
        result = aur_parameters_color(parameters, "specular_reflectance", 1.0, &self->specular, error);
    if (result == AUR_OK)
        result = aur_parameters_float(parameters, "exponent", 0.0, 1e6, &exponent, error);
    if (result != AUR_OK)
        return result;
    self->exponent = (float)exponent;
    const aur_bsdf_lobe diffuse = aur_diffuse_lobe();
    const aur_bsdf_lobe specular = {.shape = AUR_LOBE_SHAPE_COSINE_POWER,
                                    .times_cosine = times_cosine,
                                    .sides = AUR_SIDE_FRONT,
                                    .exponent = self->exponent};
    if (may_reflect(&self->diffuse))
        aur_bsdf_add_lobe(bsdf, &diffuse);
    if (may_reflect(&self->specular))
        aur_bsdf_add_lobe(bsdf, &specular);
    if (self->diffuse.texture != NULL || self->specular.texture != NULL)
        return AUR_OK;
    const float most = aur_vector_max(aur_vector_add(self->diffuse.constant, self->specular.constant));
    if (most > 1.0f + 1e-5f)
        return aur_fail_at(
            error, parameters->location, AUR_ERROR_FORMAT,
            "bsdf '%s': diffuse_reflectance + specular_reflectance must not exceed 1, but adds to %g",
            parameters->plugin, (double)most);
    return AUR_OK;
}

aur_phong_point aur_phong_at(const aur_bsdf *bsdf, aur_bsdf_point point) {
    const aur_phong *const self = bsdf->data;
    aur_phong_point at = {aur_color_at(&self->diffuse, point), aur_color_at(&self->specular, point), 0.0f};
    const float diffuse = aur_luminance(at.diffuse);
    const float specular = aur_luminance(at.specular);
    if (diffuse + specular > 0.0f)
        at.specular_probability = specular / (diffuse + specular);
    return at;
}

static float density(const aur_bsdf *bsdf, const aur_phong_point *at, aur_vector view, aur_vector light) {
    const aur_phong *const self = bsdf->data;
    if (view.z <= 0.0f || light.z <= 0.0f)
        return 0.0f;
    const float cosine = aur_vector_dot(aur_mirror(view), light);
    return at->specular_probability * aur_cosine_power_pdf(cosine, self->exponent) +
           (1.0f - at->specular_probability) * light.z / AUR_PI_F;
}

float aur_phong_pdf(const aur_bsdf *bsdf, aur_bsdf_part part, aur_bsdf_point point, aur_vector view,
                    aur_vector light) {
    (void)part;
    const aur_phong_point at = aur_phong_at(bsdf, point);
    return density(bsdf, &at, view, light);
}

bool aur_phong_sample(const aur_bsdf *bsdf, aur_bsdf_part part, aur_bsdf_point point, aur_vector view,
                      const float u[3], aur_bsdf_sample *drawn) {
    const aur_phong *const self = bsdf->data;
    if (view.z <= 0.0f)
        return false;
    const aur_phong_point at = aur_phong_at(bsdf, point);
    aur_vector light;
    if (u[0] < at.specular_probability) {
        const aur_frame frame = aur_frame_about(aur_mirror(view));
        light = aur_frame_to_world(&frame, aur_sample_cosine_power(u[1], u[2], self->exponent));
    } else {
        light = aur_sample_cosine(u[1], u[2]);
    }
    const float pdf = density(bsdf, &at, view, light);
    if (!(pdf > 0.0f))
        return false;
    const aur_vector value = bsdf->descriptor->evaluate(bsdf, part, point, view, light);
    *drawn = (aur_bsdf_sample){.light = light, .weight = aur_vector_scale(value, 1.0f / pdf), .pdf = pdf};
    return aur_vector_max(value) > 0.0f;
}

void aur_phong_weigh(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view, float scale,
                     aur_bsdf_lobe *lobes) {
    const aur_phong *const self = bsdf->data;
    if (view.z <= 0.0f)
        return;
    for (size_t i = 0; i < bsdf->lobe_count; ++i) {
        if (lobes[i].diffuse) {
            lobes[i].coefficient = aur_vector_scale(aur_color_at(&self->diffuse, point), 1.0f / AUR_PI_F);
            continue;
        }
        lobes[i].axis = aur_mirror(view);
        lobes[i].coefficient = aur_vector_scale(aur_color_at(&self->specular, point), scale);
    }
}

aur_vector aur_phong_diffuse_albedo(const aur_bsdf *bsdf, aur_bsdf_point point, float side) {
    const aur_phong *const self = bsdf->data;
    return side > 0.0f ? aur_color_at(&self->diffuse, point) : (aur_vector){0};
}
