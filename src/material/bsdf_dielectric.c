/* Glass and its like: a smooth boundary, and a thin pane of two. */
#include "material/fresnel.h"
#include "material/sampling.h"
#include "material/texture.h"

typedef struct dielectric {
    aur_color reflectance, transmittance;
    float ior; /* inside over outside; inside is where z < 0 */
} dielectric;

static aur_result create(aur_parameters *parameters, aur_bsdf *bsdf, aur_error *error) {
    dielectric *const self = bsdf->data;
    self->reflectance.constant = self->transmittance.constant = (aur_vector){1.0f, 1.0f, 1.0f};
    aur_bsdf_lobe lobe = {.shape = AUR_LOBE_SHAPE_SPECULAR, .sides = AUR_SIDES_BOTH};
    aur_bsdf_add_lobe(bsdf, &lobe);
    lobe.transmits = true;
    aur_bsdf_add_lobe(bsdf, &lobe);
    aur_result result = aur_parameters_ior(parameters, "bk7", &self->ior, error);
    if (result == AUR_OK)
        result = aur_parameters_color(parameters, "specular_reflectance", 1.0, &self->reflectance, error);
    if (result == AUR_OK)
        result = aur_parameters_color(parameters, "specular_transmittance", 1.0, &self->transmittance, error);
    return result;
}

/* What comes of light: the share that is mirrored, where the rest comes from, and how its radiance is scaled.
 */
typedef struct split {
    float mirrored;
    aur_vector through;
    float scale;
} split;

static split split_at_boundary(const dielectric *self, aur_vector view) {
    float refracted;
    const float mirrored = aur_fresnel_dielectric(view.z, self->ior, &refracted);
    const float ratio = view.z >= 0.0f ? 1.0f / self->ior : self->ior; /* the view's side over the light's */
    return (split){mirrored, {-ratio * view.x, -ratio * view.y, refracted}, ratio * ratio};
}

/* Two boundaries and all that is mirrored between them (Stam 2001): R + T^2 R / (1 - R^2) = 2 R / (1 + R). */
static split split_at_pane(const dielectric *self, aur_vector view) {
    float refracted;
    const float once = aur_fresnel_dielectric(fabsf(view.z), self->ior, &refracted);
    return (split){2.0f * once / (1.0f + once), aur_vector_scale(view, -1.0f), 1.0f};
}

static bool draw(const dielectric *self, aur_bsdf_point point, aur_vector view, float u, split parts,
                 aur_bsdf_sample *drawn) {
    *drawn = (aur_bsdf_sample){.specular = true};
    if (u < parts.mirrored) {
        drawn->light = aur_mirror(view);
        drawn->weight = aur_color_at(&self->reflectance, point);
        return true;
    }
    drawn->light = aur_vector_normalize(parts.through);
    drawn->weight = aur_vector_scale(aur_color_at(&self->transmittance, point), parts.scale);
    drawn->ior_squared = parts.scale != 1.0f ? 1.0f / parts.scale : 0.0f;
    return view.z != 0.0f;
}

static bool sample_boundary(const aur_bsdf *bsdf, aur_bsdf_part part, aur_bsdf_point point, aur_vector view,
                            const float u[3], aur_bsdf_sample *drawn) {
    (void)part;
    return draw(bsdf->data, point, view, u[0], split_at_boundary(bsdf->data, view), drawn);
}

static bool sample_pane(const aur_bsdf *bsdf, aur_bsdf_part part, aur_bsdf_point point, aur_vector view,
                        const float u[3], aur_bsdf_sample *drawn) {
    (void)part;
    return draw(bsdf->data, point, view, u[0], split_at_pane(bsdf->data, view), drawn);
}

static void weigh_split(const dielectric *self, aur_bsdf_point point, aur_vector view, split parts,
                        aur_bsdf_lobe *lobes) {
    lobes[0].axis = aur_mirror(view);
    lobes[0].coefficient = aur_vector_scale(aur_color_at(&self->reflectance, point), parts.mirrored);
    if (parts.mirrored >= 1.0f)
        return;
    lobes[1].axis = aur_vector_normalize(parts.through);
    lobes[1].coefficient =
        aur_vector_scale(aur_color_at(&self->transmittance, point), (1.0f - parts.mirrored) * parts.scale);
}

static void weigh_boundary(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view,
                           aur_bsdf_lobe *lobes) {
    weigh_split(bsdf->data, point, view, split_at_boundary(bsdf->data, view), lobes);
}

static void weigh_pane(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view, aur_bsdf_lobe *lobes) {
    weigh_split(bsdf->data, point, view, split_at_pane(bsdf->data, view), lobes);
}

const aur_bsdf_descriptor aur_bsdf_dielectric = {
    .name = "dielectric",
    .summary = "a smooth boundary such as glass",
    .source = "Fresnel 1823",
    .size = sizeof(dielectric),
    .create = create,
    .sample = sample_boundary,
    .weigh = weigh_boundary,
};

const aur_bsdf_descriptor aur_bsdf_thindielectric = {
    .name = "thindielectric",
    .summary = "a thin pane that bends no light",
    .source = "Stam 2001",
    .size = sizeof(dielectric),
    .create = create,
    .sample = sample_pane,
    .weigh = weigh_pane,
};
