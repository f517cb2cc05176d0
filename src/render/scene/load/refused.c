/* Plugins of Mitsuba that are refused by name, with the reason. */
#include "render/scene/load/loader.h"

#include <string.h>

#define NAME(name_, why_)                                                                                    \
    { AUR_KEY_READ_APART(AUR_KEY_TEXT, name_, NULL, why_) }
#define KIND(name_)                                                                                          \
    &(const aur_row) {                                                                                       \
        .name = #name_, .summary = "types of " #name_ " that are not supported", AUR_ROW_KEYS(name_##_names) \
    }

#define OF_DERIVATIVES "it is for derivatives: --integrator path renders the same image"

static const aur_key integrator_names[] = {
    NAME("stokes", "light is unpolarised here: --integrator path renders its intensity"),
    NAME("prb", OF_DERIVATIVES),
    NAME("prb_basic", OF_DERIVATIVES),
    NAME("prb_projective", OF_DERIVATIVES),
    NAME("direct_projective", "it is for derivatives: --integrator direct renders the same image"),
    NAME("prbvolpath", "it is for derivatives: --integrator volpath renders the same image"),
    NAME("volprim_rf_basic", "radiance fields are not rendered"),
};
static const aur_key bsdf_names[] = {
    NAME("hair", "the curves that carry it can have any other bsdf"),
    NAME("measured", "files of measured materials are not read"),
    NAME("measured_polarized", "light is unpolarised here, and files of measured materials are not read"),
    NAME("hk", "'homogeneous' inside a shape is the medium that it approximates"),
    NAME("irawan", "files of woven cloth are not read"),
};
static const aur_key shape_names[] = {
    NAME("sdfgrid", "a mesh of the same surface can be rendered"),
    NAME("ellipsoids", "radiance fields are not rendered"),
    NAME("ellipsoidsmesh", "radiance fields are not rendered"),
    NAME("blender", "Blender's memory is not read: export the mesh to a file"),
    NAME("heightfield", "a mesh of the same surface can be rendered"),
    NAME("hair", "'bsplinecurve' and 'linearcurve' render fibres"),
};
static const aur_key emitter_names[] = {
    NAME("timed_sunsky", "an image shows one moment: 'sunsky' has a date and a time"),
};
static const aur_key sensor_names[] = {
    NAME("distant", "'orthographic' measures parallel light"),
    NAME("distantflux", "'irradiancemeter' measures flux per area"),
    NAME("flat_sensor", "'irradiancemeter' measures flux per area"),
    NAME("spherical", "a 'batch' of six 'perspective' cameras sees all directions"),
};
static const aur_key film_names[] = {
    NAME("specfilm", "colours are red, green and blue"),
};
static const aur_key phase_names[] = {
    NAME("sggx", "it needs a grid of six channels, and 'gridvolume' has 1 or 3"),
};

static const aur_row *const rows[] = {KIND(integrator), KIND(bsdf), KIND(shape), KIND(emitter),
                                      KIND(sensor),     KIND(film), KIND(phase)};

const aur_table aur_refused_table = {
    .kind = "refused", .summary = "Mitsuba's plugins that are not supported", AUR_TABLE_ROWS(rows)};

aur_result aur_parameters_refuse(const aur_parameters *parameters, aur_error *error) {
    const size_t kind = aur_names_find(aur_names_of_table(&aur_refused_table), parameters->kind);
    const aur_key *const key =
        kind < aur_refused_table.count ? aur_row_find_key(rows[kind], parameters->plugin) : NULL;
    return key == NULL
               ? AUR_OK
               : aur_fail_at(error, parameters->location, AUR_ERROR_UNSUPPORTED,
                             "%s '%s' is not supported: %s", parameters->kind, parameters->plugin, key->help);
}
