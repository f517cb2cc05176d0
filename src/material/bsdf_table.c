/* The table of BSDFs, and making them by name. */
#include <stdlib.h>
#include <string.h>

#include "material/bsdf.h"

extern const aur_bsdf_descriptor aur_bsdf_diffuse;
extern const aur_bsdf_descriptor aur_bsdf_phong;
extern const aur_bsdf_descriptor aur_bsdf_phong_lobe;
extern const aur_bsdf_descriptor aur_bsdf_twosided;
extern const aur_bsdf_descriptor aur_bsdf_conductor;
extern const aur_bsdf_descriptor aur_bsdf_roughconductor;
extern const aur_bsdf_descriptor aur_bsdf_dielectric;
extern const aur_bsdf_descriptor aur_bsdf_thindielectric;
extern const aur_bsdf_descriptor aur_bsdf_roughdielectric;
extern const aur_bsdf_descriptor aur_bsdf_plastic;
extern const aur_bsdf_descriptor aur_bsdf_roughplastic;
extern const aur_bsdf_descriptor aur_bsdf_mask;

static const aur_bsdf_descriptor *const table[] = {
    &aur_bsdf_diffuse,         &aur_bsdf_twosided,       &aur_bsdf_phong,        &aur_bsdf_phong_lobe,
    &aur_bsdf_conductor,       &aur_bsdf_roughconductor, &aur_bsdf_dielectric,   &aur_bsdf_thindielectric,
    &aur_bsdf_roughdielectric, &aur_bsdf_plastic,        &aur_bsdf_roughplastic, &aur_bsdf_mask,
};

enum { TABLE_SIZE = sizeof table / sizeof table[0] };

static aur_result find_descriptor(const aur_parameters *parameters, const aur_bsdf_descriptor **descriptor,
                                  aur_error *error) {
    const char *names[TABLE_SIZE];
    for (size_t i = 0; i < TABLE_SIZE; ++i) {
        names[i] = table[i]->name;
        if (strcmp(names[i], parameters->plugin) == 0) {
            *descriptor = table[i];
            return AUR_OK;
        }
    }
    return aur_fail_unknown_plugin(error, parameters, TABLE_SIZE, names);
}

/* What a material has from the textures and materials among its parameters. */
static void inherit(const aur_parameters *parameters, aur_bsdf *bsdf) {
    for (size_t i = 0; i < parameters->count; ++i) {
        const aur_parameter *const item = &parameters->items[i];
        if (item->kind != AUR_PARAMETER_OBJECT)
            continue;
        const aur_bsdf *const nested = strcmp(item->object_kind, "bsdf") == 0 ? item->object : NULL;
        bsdf->textured = bsdf->textured || nested == NULL || nested->textured;
        bsdf->anisotropic = bsdf->anisotropic || (nested != NULL && nested->anisotropic);
    }
}

static unsigned kind_of(const aur_bsdf_lobe *lobe) {
    switch (lobe->shape) {
    case AUR_LOBE_SHAPE_SPECULAR:
        return AUR_SCATTERS_SPECULAR;
    case AUR_LOBE_SHAPE_SAMPLED:
        return AUR_SCATTERS_SAMPLED;
    case AUR_LOBE_SHAPE_COSINE_POWER:
        break;
    }
    return lobe->diffuse ? AUR_SCATTERS_DIFFUSE : AUR_SCATTERS_GLOSSY;
}

/* What follows from the lobes. */
static void summarise(aur_bsdf *bsdf) {
    bsdf->plain_diffuse = !bsdf->textured;
    for (size_t i = 0; i < bsdf->lobe_count; ++i) {
        const aur_bsdf_lobe *const lobe = &bsdf->lobes[i];
        for (size_t side = 0; side < 2; ++side)
            bsdf->scatters[side] |= (lobe->sides >> side & 1u) != 0 ? kind_of(lobe) : 0;
        bsdf->transmits = bsdf->transmits || lobe->transmits;
        bsdf->plain_diffuse = bsdf->plain_diffuse && lobe->diffuse && lobe->factor == NULL;
    }
    bsdf->scatters_from_behind = bsdf->scatters[1] != 0;
}

static aur_result fill(aur_parameters *parameters, aur_bsdf *bsdf, aur_error *error) {
    bsdf->data = calloc(1, bsdf->descriptor->size);
    if (bsdf->data == NULL)
        return aur_fail_at(error, parameters->location, AUR_ERROR_MEMORY, "out of memory");
    aur_result result = bsdf->descriptor->create(parameters, bsdf, error);
    if (result == AUR_OK)
        result = aur_parameters_finish(parameters, error);
    if (result == AUR_OK && bsdf->lobe_count > AUR_BSDF_LOBE_CAPACITY)
        result = aur_fail_at(error, parameters->location, AUR_ERROR_UNSUPPORTED,
                             "bsdf '%s' has %zu lobes that differ, and at most %d can be rendered",
                             parameters->plugin, bsdf->lobe_count, (int)AUR_BSDF_LOBE_CAPACITY);
    return result;
}

aur_result aur_bsdf_create(aur_parameters *parameters, aur_bsdf **bsdf, aur_error *error) {
    *bsdf = NULL;
    const aur_bsdf_descriptor *descriptor = NULL;
    aur_result result = find_descriptor(parameters, &descriptor, error);
    if (result != AUR_OK)
        return result;
    aur_bsdf *const made = calloc(1, sizeof *made);
    if (made == NULL)
        return aur_fail_at(error, parameters->location, AUR_ERROR_MEMORY, "out of memory");
    made->descriptor = descriptor;
    result = fill(parameters, made, error);
    if (result != AUR_OK) {
        aur_bsdf_destroy(made);
        return result;
    }
    inherit(parameters, made);
    summarise(made);
    *bsdf = made;
    return AUR_OK;
}
