/* A surface that is only partly there: the nested BSDF with weight `opacity`, else light goes straight
 * through. */
#include "material/texture.h"

extern const aur_bsdf_descriptor aur_bsdf_mask;

typedef struct mask {
    aur_color opacity;
    const aur_bsdf *nested;
} mask;

static aur_result create(aur_parameters *parameters, aur_bsdf *bsdf, aur_error *error) {
    aur_result result = aur_bsdf_allocate(parameters, bsdf, sizeof(mask), error);
    if (result != AUR_OK)
        return result;
    mask *const self = bsdf->data;
    self->opacity.constant = (aur_vector){0.5f, 0.5f, 0.5f};
    bsdf->scatters_from_behind = bsdf->transmits = true;
    result = aur_parameters_color(parameters, "opacity", 1.0, &self->opacity, error);
    if (result == AUR_OK)
        result = aur_parameters_nested_bsdf(parameters, "bsdf", &self->nested, error);
    if (result != AUR_OK)
        return result;
    if (self->nested == NULL)
        return aur_fail_at(error, parameters->location, AUR_ERROR_FORMAT, "bsdf 'mask' needs a nested bsdf");
    bsdf->anisotropic = self->nested->anisotropic;
    return AUR_OK;
}

static float opacity_at(const mask *self, aur_bsdf_point point) {
    const aur_vector color = aur_color_at(&self->opacity, point);
    return fminf((color.x + color.y + color.z) / 3.0f, 1.0f);
}

static aur_vector evaluate(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view, aur_vector light) {
    const mask *const self = bsdf->data;
    return aur_vector_scale(self->nested->descriptor->evaluate(self->nested, point, view, light),
                            opacity_at(self, point));
}

static float pdf(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view, aur_vector light) {
    const mask *const self = bsdf->data;
    return opacity_at(self, point) * self->nested->descriptor->pdf(self->nested, point, view, light);
}

static bool sample(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view, const float u[3],
                   aur_bsdf_sample *drawn) {
    const mask *const self = bsdf->data;
    const float opacity = opacity_at(self, point);
    if (u[0] >= opacity) {
        *drawn = (aur_bsdf_sample){
            .light = aur_vector_scale(view, -1.0f), .weight = {1.0f, 1.0f, 1.0f}, .specular = true};
        return true;
    }
    const float rest[3] = {fminf(u[0] / opacity, 0x1.fffffep-1f), u[1], u[2]};
    if (!self->nested->descriptor->sample(self->nested, point, view, rest, drawn))
        return false;
    drawn->pdf *= opacity;
    return true;
}

static size_t lobes(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view, aur_bsdf_lobe *lobe) {
    const mask *const self = bsdf->data;
    const float opacity = opacity_at(self, point);
    size_t count = self->nested->descriptor->lobes(self->nested, point, view, lobe);
    for (size_t i = 0; i < count; ++i)
        lobe[i].coefficient = aur_vector_scale(lobe[i].coefficient, opacity);
    if (self->opacity.texture == NULL && opacity >= 1.0f)
        return count;
    const aur_vector straight = aur_vector_scale(view, -1.0f);
    /* A nested mask's light that goes straight on and this one's are one lobe, the last. */
    const bool nested = self->nested->descriptor == &aur_bsdf_mask && count > 0 &&
                        lobe[count - 1].shape == AUR_LOBE_SHAPE_SPECULAR;
    if (!nested)
        lobe[count++] = (aur_bsdf_lobe){.shape = AUR_LOBE_SHAPE_SPECULAR, .axis = straight};
    const float through = 1.0f - opacity;
    lobe[count - 1].coefficient =
        aur_vector_add(lobe[count - 1].coefficient, (aur_vector){through, through, through});
    return count;
}

static aur_vector diffuse_albedo(const aur_bsdf *bsdf, aur_bsdf_point point, float side) {
    const mask *const self = bsdf->data;
    return aur_vector_scale(self->nested->descriptor->diffuse_albedo(self->nested, point, side),
                            opacity_at(self, point));
}

/* The nested lobe is gathered as often as if it were there; what passes is no part of it. */
static aur_vector evaluate_sampled(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view,
                                   aur_vector light) {
    const mask *const self = bsdf->data;
    return aur_vector_scale(aur_bsdf_evaluate_sampled(self->nested, point, view, light),
                            opacity_at(self, point));
}

static float pdf_sampled(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view, aur_vector light) {
    const mask *const self = bsdf->data;
    return aur_bsdf_pdf_sampled(self->nested, point, view, light);
}

static bool sample_sampled(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view, const float u[3],
                           aur_bsdf_sample *drawn) {
    const mask *const self = bsdf->data;
    if (!aur_bsdf_sample_sampled(self->nested, point, view, u, drawn))
        return false;
    drawn->weight = aur_vector_scale(drawn->weight, opacity_at(self, point));
    return true;
}

static const aur_bsdf_sampled sampled = {evaluate_sampled, pdf_sampled, sample_sampled};

const aur_bsdf_descriptor aur_bsdf_mask = {
    .name = "mask",
    .summary = "the nested bsdf with an opacity",
    .source = "Mitsuba 3",
    .create = create,
    .release = aur_bsdf_release_data,
    .evaluate = evaluate,
    .pdf = pdf,
    .sample = sample,
    .lobes = lobes,
    .diffuse_albedo = diffuse_albedo,
    .sampled = &sampled,
};
