/* Glass and other dielectrics: a smooth boundary, and a thin pane. */
#include "render/scene/materials/fresnel.h"
#include "render/scene/materials/sampling.h"
#include "render/scene/materials/texture.h"

typedef struct dielectric {
    aur_color reflectance, transmittance;
    float ior; /* inside over outside; inside is where z < 0 */
} dielectric;

static const aur_key keys[] = {
    AUR_IOR_KEYS("bk7"),
    {AUR_KEY_OF_COLOR(dielectric, "specular_reflectance", reflectance, 1.0, "1",
                      "factor of the reflected light")},
    {AUR_KEY_OF_COLOR(dielectric, "specular_transmittance", transmittance, 1.0, "1",
                      "factor of the transmitted light")},
};

static aur_result add_lobes(aur_parameters *parameters, aur_lobe_way through, aur_bsdf *bsdf,
                            aur_error *error) {
    dielectric *const self = bsdf->data;
    aur_bsdf_lobe lobe = {
        .shape = AUR_LOBE_SHAPE_SPECULAR, .way = through, .sides = AUR_SIDES_BOTH, .transmits = true};
    aur_bsdf_add_lobe(bsdf, &lobe);
    lobe.transmits = false;
    lobe.way = AUR_LOBE_WAY_MIRROR;
    aur_bsdf_add_lobe(bsdf, &lobe);
    return aur_parameters_ior(parameters, "bk7", &self->ior, error);
}

static aur_result create_boundary(aur_parameters *parameters, aur_bsdf *bsdf, aur_error *error) {
    return add_lobes(parameters, AUR_LOBE_WAY_SEPARATE, bsdf, error);
}

static aur_result create_pane(aur_parameters *parameters, aur_bsdf *bsdf, aur_error *error) {
    return add_lobes(parameters, AUR_LOBE_WAY_UNSCATTERED, bsdf, error);
}

/* `through` is the incident direction of refracted light. `ratio` is the index on the view's side over that
 * on the light's, whose square scales radiance. */
static void split(const dielectric *self, aur_bsdf_point point, aur_vector view, float mirrored,
                  aur_vector through, float ratio, aur_bsdf_lobe *lobes) {
    lobes[1].axis = aur_mirror(view);
    lobes[1].coefficient = aur_vector_scale(aur_color_at(&self->reflectance, point), mirrored);
    if (mirrored >= 1.0f)
        return;
    lobes[0].axis = through;
    lobes[0].coefficient =
        aur_vector_scale(aur_color_at(&self->transmittance, point), (1.0f - mirrored) * ratio * ratio);
    lobes[0].ior_squared = ratio != 1.0f ? 1.0f / (ratio * ratio) : 0.0f;
}

static void weigh_boundary(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view,
                           aur_bsdf_lobe *lobes) {
    const dielectric *const self = bsdf->data;
    float refracted;
    const float mirrored = aur_fresnel_dielectric(view.z, self->ior, &refracted);
    const float ratio = view.z >= 0.0f ? 1.0f / self->ior : self->ior;
    const aur_vector through =
        aur_vector_normalize((aur_vector){-ratio * view.x, -ratio * view.y, refracted});
    split(self, point, view, mirrored, through, ratio, lobes);
}

/* Two boundaries with all interreflections (Stam 2001): R + T^2 R / (1 - R^2) = 2 R / (1 + R). */
static void weigh_pane(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view, aur_bsdf_lobe *lobes) {
    const dielectric *const self = bsdf->data;
    float refracted;
    const float once = aur_fresnel_dielectric(fabsf(view.z), self->ior, &refracted);
    split(self, point, view, 2.0f * once / (1.0f + once), aur_vector_scale(view, -1.0f), 1.0f, lobes);
}

const aur_bsdf_descriptor aur_bsdf_dielectric = {
    .row = {.name = "dielectric",
            .summary = "a smooth boundary such as glass",
            .source = "Fresnel 1823",
            AUR_ROW_KEYS(keys)},
    .size = sizeof(dielectric),
    .create = create_boundary,
    .weigh = weigh_boundary,
};

const aur_bsdf_descriptor aur_bsdf_thindielectric = {
    .row = {.name = "thindielectric",
            .summary = "a thin pane that bends no light",
            .source = "Stam 2001",
            AUR_ROW_KEYS(keys)},
    .size = sizeof(dielectric),
    .create = create_pane,
    .weigh = weigh_pane,
};
