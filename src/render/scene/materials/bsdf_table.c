/* Materials by name, and their creation. To add one: one file, which defines aur_bsdf_<name>, and one line
 * here. */
#include <stddef.h>
#include <string.h>

#include "render/scene/materials/texture.h"
#include "render/scene/plugin/plugin.h"

#define MATERIALS(ROW)                                                                                       \
    ROW(diffuse)                                                                                             \
    ROW(roughdiffuse)                                                                                        \
    ROW(difftrans)                                                                                           \
    ROW(twosided)                                                                                            \
    ROW(phong)                                                                                               \
    ROW(phong_lobe)                                                                                          \
    ROW(ward)                                                                                                \
    ROW(conductor)                                                                                           \
    ROW(roughconductor)                                                                                      \
    ROW(dielectric)                                                                                          \
    ROW(glass)                                                                                               \
    ROW(thindielectric)                                                                                      \
    ROW(roughdielectric)                                                                                     \
    ROW(plastic)                                                                                             \
    ROW(roughplastic)                                                                                        \
    ROW(pplastic)                                                                                            \
    ROW(coating)                                                                                             \
    ROW(roughcoating)                                                                                        \
    ROW(principled)                                                                                          \
    ROW(principledthin)                                                                                      \
    ROW(mask)                                                                                                \
    ROW(blendbsdf)                                                                                           \
    ROW(bumpmap)                                                                                             \
    ROW(normalmap)                                                                                           \
    ROW(null)                                                                                                \
    ROW(polarizer)                                                                                           \
    ROW(retarder)                                                                                            \
    ROW(circular)

#define DECLARE(name) extern const aur_bsdf_descriptor aur_bsdf_##name;
MATERIALS(DECLARE)

#define ADDRESS(name) &aur_bsdf_##name.row,
static const aur_row *const rows[] = {MATERIALS(ADDRESS)};

const aur_table aur_bsdf_table = {
    .kind = "bsdf", .summary = "materials: how surfaces scatter light", AUR_TABLE_ROWS(rows)};

/* A chain of materials that each reference another one twice would be evaluated 2^n times. */
enum { MOST_EVALUATIONS = 1 << 12 };

static aur_result count_evaluations(const aur_parameters *parameters, aur_bsdf *bsdf, aur_error *error) {
    bsdf->evaluations = 1;
    for (size_t i = 0; i < parameters->count; ++i) {
        const aur_parameter *const item = &parameters->items[i];
        if (item->kind == AUR_PARAMETER_OBJECT && strcmp(item->object_kind, "bsdf") == 0)
            bsdf->evaluations += ((const aur_bsdf *)item->object)->evaluations;
    }
    return bsdf->evaluations <= MOST_EVALUATIONS
               ? AUR_OK
               : aur_fail_at(error, parameters->location, AUR_ERROR_UNSUPPORTED,
                             "bsdf '%s' has %zu bsdfs inside, counted as often as they "
                             "are named, and at most %d can be "
                             "rendered",
                             parameters->plugin, bsdf->evaluations - 1, (int)MOST_EVALUATIONS - 1);
}

static void add_texture(aur_bsdf *bsdf, const aur_texture *texture) {
    if (texture->descriptor->prefetch != NULL && bsdf->texture_count < AUR_BSDF_TEXTURES)
        bsdf->textures[bsdf->texture_count++] = texture;
}

/* Properties derived from the textures and materials among the parameters. */
static void inherit(const aur_parameters *parameters, aur_bsdf *bsdf) {
    for (size_t i = 0; i < parameters->count; ++i) {
        const aur_parameter *const item = &parameters->items[i];
        if (item->kind != AUR_PARAMETER_OBJECT)
            continue;
        const aur_bsdf *const nested = strcmp(item->object_kind, "bsdf") == 0 ? item->object : NULL;
        bsdf->textured = bsdf->textured || nested == NULL || nested->textured;
        if (nested == NULL && strcmp(item->object_kind, "texture") == 0) {
            aur_attributes_add(&bsdf->attributes, &((const aur_texture *)item->object)->attributes);
            add_texture(bsdf, item->object);
        }
        if (nested != NULL)
            aur_attributes_add(&bsdf->attributes, &nested->attributes);
        for (size_t k = 0; nested != NULL && k < nested->texture_count; ++k)
            add_texture(bsdf, nested->textures[k]);
        bsdf->bumpy = bsdf->bumpy || (nested != NULL && nested->bumpy);
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

/* Properties derived from the lobes. */
static void summarise(aur_bsdf *bsdf) {
    bsdf->plain_diffuse = !bsdf->textured;
    for (size_t i = 0; i < bsdf->lobe_count; ++i) {
        const aur_bsdf_lobe *const lobe = &bsdf->lobes[i];
        for (size_t side = 0; side < 2; ++side)
            bsdf->scatters[side] |= (lobe->sides >> side & 1u) != 0 ? kind_of(lobe) : 0;
        bsdf->transmits = bsdf->transmits || lobe->transmits;
        bsdf->passes =
            bsdf->passes || (lobe->shape == AUR_LOBE_SHAPE_SPECULAR && lobe->way == AUR_LOBE_WAY_UNSCATTERED);
        bsdf->plain_diffuse = bsdf->plain_diffuse && lobe->diffuse && lobe->factor == NULL;
    }
    bsdf->scatters_from_behind = bsdf->scatters[1] != 0;
}

static aur_result fill(aur_parameters *parameters, void *object, const void *context, aur_error *error) {
    (void)context;
    aur_bsdf *const bsdf = object;
    aur_result result = aur_colors_read(&bsdf->descriptor->row, parameters, bsdf->data, error);
    if (result == AUR_OK)
        result = count_evaluations(parameters, bsdf, error);
    if (result == AUR_OK)
        result = bsdf->descriptor->create(parameters, bsdf, error);
    if (result == AUR_OK && bsdf->lobe_count > AUR_BSDF_LOBE_CAPACITY)
        result = aur_fail_at(error, parameters->location, AUR_ERROR_UNSUPPORTED,
                             "bsdf '%s' has %zu lobes that differ, and at most %d can be rendered",
                             parameters->plugin, bsdf->lobe_count, (int)AUR_BSDF_LOBE_CAPACITY);
    if (result != AUR_OK)
        return result;
    inherit(parameters, bsdf);
    summarise(bsdf);
    return AUR_OK;
}

static const aur_plugin_kind kind = {.table = &aur_bsdf_table,
                                     .size = sizeof(aur_bsdf),
                                     .data = offsetof(aur_bsdf, data),
                                     .data_size = offsetof(aur_bsdf_descriptor, size),
                                     .fill = fill};

aur_result aur_bsdf_create(aur_parameters *parameters, aur_bsdf **bsdf, aur_error *error) {
    return aur_plugin_create(&kind, parameters, NULL, bsdf, error);
}

void aur_bsdf_destroy(aur_bsdf *bsdf) {
    aur_plugin_destroy(&kind, bsdf);
}
