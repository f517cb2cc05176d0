/* A pane of tinted glass, as in Radiance. */
#include "render/scene/materials/fresnel.h"
#include "render/scene/materials/sampling.h"
#include "render/scene/materials/texture.h"

typedef struct glass {
    aur_color transmissivity;
    float ior;
} glass;

static const aur_key keys[] = {
    AUR_IOR_KEYS("bk7"),
    {AUR_KEY_OF_COLOR(glass, "transmissivity", transmissivity, 1.0, "1",
                      "of the way straight through the inside, without the surfaces")},
};

static aur_result create(aur_parameters *parameters, aur_bsdf *bsdf, aur_error *error) {
    glass *const self = bsdf->data;
    aur_bsdf_lobe lobe = {.shape = AUR_LOBE_SHAPE_SPECULAR,
                          .way = AUR_LOBE_WAY_UNSCATTERED,
                          .sides = AUR_SIDES_BOTH,
                          .transmits = true};
    aur_bsdf_add_lobe(bsdf, &lobe);
    lobe.transmits = false;
    lobe.way = AUR_LOBE_WAY_MIRROR;
    aur_bsdf_add_lobe(bsdf, &lobe);
    return aur_parameters_ior(parameters, "bk7", &self->ior, error);
}

/* Transmittance and reflectance of a pane for one polarisation, with surface reflectance r and internal
 * transmittance d: (1 - r)^2 d / (1 - r^2 d^2), and r + r d times that. */
static void add_polarisation(float r, float d, float *through, float *mirrored) {
    const float passed = (1.0f - r) * (1.0f - r) * d / (1.0f - r * r * d * d);
    *through += 0.5f * passed;
    *mirrored += 0.5f * (r + r * d * passed);
}

/* Light keeps its polarisation in internal reflections, and each polarisation has its own reflectance
 * (Fresnel 1823). With their mean, transmittance at 60 degrees would be 1.5 % too low. */
static void weigh(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view, aur_bsdf_lobe *lobes) {
    const glass *const self = bsdf->data;
    const float cosine = fabsf(view.z), n = self->ior;
    const float squared = 1.0f - (1.0f - cosine * cosine) / (n * n);
    lobes[0].axis = aur_vector_scale(view, -1.0f);
    lobes[1].axis = aur_mirror(view);
    lobes[1].coefficient = (aur_vector){1.0f, 1.0f, 1.0f};
    if (!(squared > 0.0f)) /* only if the inside has the smaller index */
        return;
    const float inside = sqrtf(squared);
    const float across = (cosine - n * inside) / (cosine + n * inside);
    const float along = (n * cosine - inside) / (n * cosine + inside);
    const aur_vector unscattered = aur_color_at(&self->transmissivity, point);
    const float channels[3] = {unscattered.x, unscattered.y, unscattered.z};
    float through[3] = {0}, mirrored[3] = {0};
    for (size_t c = 0; c < 3; ++c) {
        const float left = powf(channels[c], 1.0f / inside);
        add_polarisation(across * across, left, &through[c], &mirrored[c]);
        add_polarisation(along * along, left, &through[c], &mirrored[c]);
    }
    lobes[0].coefficient = (aur_vector){through[0], through[1], through[2]};
    lobes[1].coefficient = (aur_vector){mirrored[0], mirrored[1], mirrored[2]};
}

const aur_bsdf_descriptor aur_bsdf_glass = {
    .row = {.name = "glass",
            .summary = "a thin pane, coloured through, that bends no light",
            .source = "Ward, Radiance",
            AUR_ROW_KEYS(keys)},
    .size = sizeof(glass),
    .create = create,
    .weigh = weigh,
};
