/* Surfaces that transmit light unscattered: no surface at all, and polarising filters for unpolarised light.
 */
#include "render/scene/materials/texture.h"

typedef struct filter {
    aur_color transmittance;
} filter;

/* Half of unpolarised light is absorbed by a linear or circular polariser. */
static const float POLARIZED_SHARE = 0.5f;

static aur_result create(aur_parameters *parameters, aur_bsdf *bsdf, aur_error *error) {
    (void)parameters;
    (void)error;
    aur_bsdf_add_lobe(bsdf, &aur_bsdf_nothing.lobes[0]);
    return AUR_OK;
}

static void weigh_all(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view, aur_bsdf_lobe *lobes) {
    (void)bsdf;
    (void)point;
    lobes[0].axis = aur_vector_scale(view, -1.0f);
    lobes[0].coefficient = (aur_vector){1.0f, 1.0f, 1.0f};
}

static void weigh_filter(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view, aur_bsdf_lobe *lobes) {
    const filter *const self = bsdf->data;
    lobes[0].axis = aur_vector_scale(view, -1.0f);
    lobes[0].coefficient = aur_color_at(&self->transmittance, point);
}

static void weigh_polarizer(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view,
                            aur_bsdf_lobe *lobes) {
    weigh_filter(bsdf, point, view, lobes);
    lobes[0].coefficient = aur_vector_scale(lobes[0].coefficient, POLARIZED_SHARE);
}

const aur_bsdf_descriptor aur_bsdf_null = {
    .row = {.name = "null", .summary = "no surface at all", .source = "Mitsuba 3"},
    .size = sizeof(filter),
    .create = create,
    .weigh = weigh_all,
};

const aur_bsdf aur_bsdf_nothing = {.descriptor = &aur_bsdf_null,
                                   .lobe_count = 1,
                                   .lobes = {{.shape = AUR_LOBE_SHAPE_SPECULAR,
                                              .way = AUR_LOBE_WAY_UNSCATTERED,
                                              .sides = AUR_SIDES_BOTH,
                                              .transmits = true}},
                                   .scatters = {AUR_SCATTERS_SPECULAR, AUR_SCATTERS_SPECULAR},
                                   .scatters_from_behind = true,
                                   .transmits = true,
                                   .passes = true};

/* --- filters */

static const aur_key filter_keys[] = {
    {AUR_KEY_OF_COLOR(filter, "transmittance", transmittance, 1.0, "1", "factor of the transmitted light")},
};

#define FILTER(name_, summary_, weigh_)                                                                      \
    const aur_bsdf_descriptor aur_bsdf_##name_ = {                                                           \
        .row = {.name = #name_, .summary = summary_, .source = "Mitsuba 3", AUR_ROW_KEYS(filter_keys)},      \
        .size = sizeof(filter),                                                                              \
        .polarizes = true,                                                                                   \
        .create = create,                                                                                    \
        .weigh = weigh_}

FILTER(polarizer, "a linear polariser: lets half of unpolarised light through", weigh_polarizer);
FILTER(retarder, "a wave plate: lets unpolarised light through", weigh_filter);
FILTER(circular, "a circular polariser: lets half of unpolarised light through", weigh_polarizer);
