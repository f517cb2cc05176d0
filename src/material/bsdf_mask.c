/* A surface that is only partly there: the nested BSDF with weight `opacity`, else light goes straight
 * through. */
#include "material/mixture.h"

static void weigh_nothing(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view, aur_bsdf_lobe *lobes) {
    (void)bsdf;
    (void)point;
    lobes[0].axis = aur_vector_scale(view, -1.0f);
    lobes[0].coefficient = (aur_vector){1.0f, 1.0f, 1.0f};
}

static const aur_bsdf_descriptor nothing_descriptor = {.weigh = weigh_nothing};

/* Where there is no surface. */
static const aur_bsdf nothing = {
    .descriptor = &nothing_descriptor,
    .lobe_count = 1,
    .lobes = {{.shape = AUR_LOBE_SHAPE_SPECULAR, .sides = AUR_SIDES_BOTH, .transmits = true}},
    .scatters = {AUR_SCATTERS_SPECULAR, AUR_SCATTERS_SPECULAR}};

static const aur_key keys[] = {
    {AUR_KEY_OF_COLOR(aur_mixture, "opacity", weight, 1.0, "0.5",
                      "share of the light that meets the nested bsdf")},
    AUR_NESTED_BSDF_KEY("bsdf", NULL, "what is there; must be given"),
};

static aur_result create(aur_parameters *parameters, aur_bsdf *bsdf, aur_error *error) {
    aur_mixture *const self = bsdf->data;
    const aur_result result = aur_parameters_nested_bsdf(parameters, "bsdf", &self->part[0], error);
    if (result != AUR_OK)
        return result;
    if (self->part[0] == NULL)
        return aur_fail_at(error, parameters->location, AUR_ERROR_FORMAT, "bsdf 'mask' needs a nested bsdf");
    const aur_vector opacity = self->weight.constant;
    if (self->weight.texture != NULL || fminf(fminf(opacity.x, opacity.y), opacity.z) < 1.0f)
        self->part[1] = &nothing;
    aur_mixture_join(bsdf);
    return AUR_OK;
}

const aur_bsdf_descriptor aur_bsdf_mask = {
    .row = {.name = "mask",
            .summary = "the nested bsdf with an opacity",
            .source = "Mitsuba 3",
            AUR_ROW_KEYS(keys)},
    .size = sizeof(aur_mixture),
    .create = create,
    .weigh = aur_mixture_weigh,
    .evaluate = aur_mixture_evaluate,
    .pdf = aur_mixture_pdf,
    .evaluate_with_pdf = aur_mixture_evaluate_with_pdf,
    .sample = aur_mixture_sample,
    .diffuse_albedo = aur_mixture_diffuse_albedo,
};
