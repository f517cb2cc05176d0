/* A surface that scatters on both sides: one nested BSDF for both, or the second one for the back. */
#include "material/bsdf.h"

typedef struct twosided {
    const aur_bsdf *front, *back;
} twosided;

static aur_result create(aur_parameters *parameters, aur_bsdf *bsdf, aur_error *error) {
    aur_result result = aur_bsdf_allocate(parameters, bsdf, sizeof(twosided), error);
    if (result != AUR_OK)
        return result;
    twosided *const self = bsdf->data;
    result = aur_parameters_nested_bsdf(parameters, "bsdf", &self->front, error);
    if (result == AUR_OK)
        result = aur_parameters_nested_bsdf(parameters, "bsdf2", &self->back, error);
    if (result != AUR_OK)
        return result;
    if (self->front == NULL)
        return aur_fail_at(error, parameters->location, AUR_ERROR_FORMAT,
                           "bsdf 'twosided' needs one or two nested bsdfs");
    if (self->back == NULL)
        self->back = self->front;
    if (self->front->transmits || self->back->transmits)
        return aur_fail_at(error, parameters->location, AUR_ERROR_FORMAT,
                           "bsdf 'twosided': a nested bsdf that lets light through already has two sides");
    bsdf->scatters_from_behind = true;
    bsdf->anisotropic = self->front->anisotropic || self->back->anisotropic;
    bsdf->plain_diffuse = self->front->plain_diffuse && self->back->plain_diffuse;
    return AUR_OK;
}

static const aur_bsdf *side_of(const aur_bsdf *bsdf, float z) {
    const twosided *const self = bsdf->data;
    return z < 0.0f ? self->back : self->front;
}

/* Seen from behind, the frame is mirrored in its tangent plane. */
static aur_vector turned(aur_vector direction, float side) {
    return side < 0.0f ? (aur_vector){direction.x, direction.y, -direction.z} : direction;
}

static aur_vector evaluate(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view, aur_vector light) {
    const aur_bsdf *const nested = side_of(bsdf, view.z);
    return nested->descriptor->evaluate(nested, point, turned(view, view.z), turned(light, view.z));
}

static float pdf(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view, aur_vector light) {
    const aur_bsdf *const nested = side_of(bsdf, view.z);
    return nested->descriptor->pdf(nested, point, turned(view, view.z), turned(light, view.z));
}

static bool sample(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view, const float u[3],
                   aur_bsdf_sample *drawn) {
    const aur_bsdf *const nested = side_of(bsdf, view.z);
    if (!nested->descriptor->sample(nested, point, turned(view, view.z), u, drawn))
        return false;
    drawn->light = turned(drawn->light, view.z);
    return true;
}

static size_t lobes(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view, aur_bsdf_lobe *lobe) {
    const aur_bsdf *const nested = side_of(bsdf, view.z);
    const size_t count = nested->descriptor->lobes(nested, point, turned(view, view.z), lobe);
    for (size_t i = 0; i < count; ++i)
        lobe[i].axis = turned(lobe[i].axis, view.z);
    return count;
}

static aur_vector diffuse_albedo(const aur_bsdf *bsdf, aur_bsdf_point point, float side) {
    const aur_bsdf *const nested = side_of(bsdf, side);
    return nested->descriptor->diffuse_albedo(nested, point, fabsf(side));
}

static aur_vector evaluate_sampled(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view,
                                   aur_vector light) {
    return aur_bsdf_evaluate_sampled(side_of(bsdf, view.z), point, turned(view, view.z),
                                     turned(light, view.z));
}

static float pdf_sampled(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view, aur_vector light) {
    return aur_bsdf_pdf_sampled(side_of(bsdf, view.z), point, turned(view, view.z), turned(light, view.z));
}

static bool sample_sampled(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view, const float u[3],
                           aur_bsdf_sample *drawn) {
    if (!aur_bsdf_sample_sampled(side_of(bsdf, view.z), point, turned(view, view.z), u, drawn))
        return false;
    drawn->light = turned(drawn->light, view.z);
    return true;
}

static const aur_bsdf_sampled sampled = {evaluate_sampled, pdf_sampled, sample_sampled};

const aur_bsdf_descriptor aur_bsdf_twosided = {
    "twosided",
    "the nested bsdf on both sides, or a second one behind",
    "Mitsuba 3",
    create,
    aur_bsdf_release_data,
    evaluate,
    pdf,
    sample,
    lobes,
    diffuse_albedo,
    &sampled,
};
