/* A surface that scatters on both sides: one nested BSDF for both, or the second one for the back. */
#include "material/mixture.h"

static const aur_key keys[] = {
    AUR_NESTED_BSDF_KEY("bsdf", NULL, "the front, and the back if bsdf2 is not given"),
    AUR_NESTED_BSDF_KEY("bsdf2", "bsdf", "the back"),
};

static aur_result create(aur_parameters *parameters, aur_bsdf *bsdf, aur_error *error) {
    aur_mixture *const self = bsdf->data;
    self->by_side = true;
    aur_result result = aur_parameters_nested_bsdf(parameters, "bsdf", &self->part[0], error);
    self->part[1] = self->part[0];
    if (result == AUR_OK)
        result = aur_parameters_nested_bsdf(parameters, "bsdf2", &self->part[1], error);
    if (result != AUR_OK)
        return result;
    if (self->part[0] == NULL)
        return aur_fail_at(error, parameters->location, AUR_ERROR_FORMAT,
                           "bsdf 'twosided' needs one or two nested bsdfs");
    if (self->part[0]->transmits || self->part[1]->transmits)
        return aur_fail_at(error, parameters->location, AUR_ERROR_FORMAT,
                           "bsdf 'twosided': a nested bsdf that lets light through already has two sides");
    aur_mixture_join(bsdf);
    return AUR_OK;
}

const aur_bsdf_descriptor aur_bsdf_twosided = {
    .row = {.name = "twosided",
            .summary = "the nested bsdf on both sides, or a second one behind",
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
