#include "render/scene/load/loader.h"

#include <string.h>

#define NAME(name_, why_)                                                                                    \
    { AUR_KEY_READ_APART(AUR_KEY_TEXT, name_, NULL, why_) }
#define KIND(name_)                                                                                          \
    &(const aur_row) {                                                                                       \
        .name = #name_, .summary = "parameters of every " #name_ " that does not read them",                 \
        AUR_ROW_KEYS(name_##_names)                                                                          \
    }

static const aur_key integrator_names[] = {
    NAME("strict_normals", "of no effect: it is always so"),
    NAME("max_depth", "not needed"),
};
static const aur_key bsdf_names[] = {
    NAME("sample_visible", "not needed: it is always so"),
    NAME("diffuse_reflectance_sampling_rate", "not needed: it changes no mean"),
    NAME("diffuse_transmittance_sampling_rate", "not needed: it changes no mean"),
    NAME("main_specular_sampling_rate", "not needed: it changes no mean"),
    NAME("specular_reflectance_sampling_rate", "not needed: it changes no mean"),
    NAME("specular_transmittance_sampling_rate", "not needed: it changes no mean"),
    NAME("clearcoat_sampling_rate", "not needed: it changes no mean"),
    NAME("theta", "not needed: light is unpolarised"),
    NAME("delta", "not needed: light is unpolarised"),
    NAME("polarizing", "not needed: light is unpolarised"),
    NAME("left_handed", "not needed: light is unpolarised"),
};
static const aur_key texture_names[] = {
    NAME("format", "not needed: texels are stored in single precision"),
    NAME("accel", "not needed: textures are read by no special hardware"),
};
static const aur_key shape_names[] = {
    NAME("silhouette_sampling_weight", "not needed: nothing is differentiated"),
};
static const aur_key emitter_names[] = {
    NAME("mis_compensation", "always done"),
};
static const aur_key sensor_names[] = {
    NAME("shutter_open", "of no effect: nothing moves"),
    NAME("shutter_close", "of no effect: nothing moves"),
    NAME("focus_distance", "of no effect: only 'thinlens' has a focus"),
};
static const aur_key medium_names[] = {
    NAME("has_spectral_extinction", "not needed: that is seen from sigma_t"),
};
static const aur_key volume_names[] = {
    NAME("raw", "not needed: values are taken unchanged"),
    NAME("accel", "not needed: volumes are read by no special hardware"),
};
static const aur_key film_names[] = {
    NAME("file_format", "not needed: the extension of the output file selects it"),
    NAME("pixel_format", "not needed: images are RGB"),
    NAME("component_format", "not needed: images are 32-bit floats where the format has them"),
    NAME("banner", "of no effect: images carry none"),
    NAME("high_quality_edges", "of no effect: all edges are"),
    NAME("sample_border", "of no effect: samples lie within the image"),
    NAME("compensate", "of no effect: sums are exact enough"),
    NAME("gamma", "of no effect: images are linear, PNG is sRGB"),
};
static const aur_key sampler_names[] = {NAME("seed", "of no effect: give it on the command line")};

static const aur_row *const rows[] = {KIND(integrator), KIND(bsdf),   KIND(texture), KIND(shape),
                                      KIND(emitter),    KIND(sensor), KIND(medium),  KIND(volume),
                                      KIND(film),       KIND(sampler)};

const aur_table aur_ignored_table = {
    .kind = "ignored", .summary = "Mitsuba's parameters that do nothing here", AUR_TABLE_ROWS(rows)};

void aur_parameters_ignore(aur_parameters *parameters, const aur_row *reader, const aur_warnings *warnings) {
    static const char start[] = "of no effect: ";
    const size_t kind = aur_names_find(aur_names_of_table(&aur_ignored_table), parameters->kind);
    for (size_t i = 0; kind < aur_ignored_table.count && i < parameters->count; ++i) {
        aur_parameter *const item = &parameters->items[i];
        const aur_key *const key = aur_row_find_key(rows[kind], item->name);
        if (key == NULL || (reader != NULL && aur_row_find_key(reader, item->name) != NULL))
            continue;
        item->used = true;
        if (strncmp(key->help, start, sizeof start - 1) == 0)
            aur_warn_at(warnings, item->location, "%s '%s': '%s' has no effect: %s", parameters->kind,
                        parameters->plugin, key->name, key->help + sizeof start - 1);
    }
}
