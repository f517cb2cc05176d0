/* A rough boundary such as ground glass (Walter, Marschner, Li, Torrance 2007). */
#include "material/fresnel.h"
#include "material/microfacet.h"
#include "material/sampling.h"
#include "material/texture.h"

typedef struct rough {
    aur_color reflectance, transmittance;
    float ior;
    aur_microfacet microfacet;
} rough;

static const aur_key keys[] = {
    AUR_IOR_KEYS("bk7"),
    {AUR_KEY_OF_COLOR(rough, "specular_reflectance", reflectance, 1.0, "1", "factor of what is reflected")},
    {AUR_KEY_OF_COLOR(rough, "specular_transmittance", transmittance, 1.0, "1",
                      "factor of what goes through")},
    AUR_MICROFACET_KEYS(rough),
};

static aur_result create(aur_parameters *parameters, aur_bsdf *bsdf, aur_error *error) {
    rough *const self = bsdf->data;
    const aur_bsdf_lobe lobe = {.shape = AUR_LOBE_SHAPE_SAMPLED, .transmits = true, .sides = AUR_SIDES_BOTH};
    aur_bsdf_add_lobe(bsdf, &lobe);
    bsdf->anisotropic = aur_microfacet_complete(&self->microfacet);
    const aur_result result = aur_parameters_ior(parameters, "bk7", &self->ior, error);
    if (result == AUR_OK && fabsf(self->ior - 1.0f) < 1e-4f)
        return aur_fail_at(error, parameters->location, AUR_ERROR_FORMAT,
                           "bsdf 'roughdielectric': 'int_ior' and 'ext_ior' must differ");
    return result;
}

/* A pair of directions as one facet sees it. */
typedef struct facet {
    aur_vector normal; /* z > 0 */
    float view, light; /* cosines to the normal */
    float mirrored;    /* the share of light that is */
    float ratio;       /* index of the light's side over the view's; 1 when mirrored */
    float jacobian;    /* from normals to light directions */
} facet;

static bool find_facet(const rough *self, aur_vector view, aur_vector light, facet *found) {
    if (view.z == 0.0f || light.z == 0.0f)
        return false;
    const bool mirror = view.z * light.z > 0.0f;
    found->ratio = mirror ? 1.0f : view.z > 0.0f ? self->ior : 1.0f / self->ior;
    aur_vector normal = aur_vector_normalize(aur_vector_add_scaled(view, found->ratio, light));
    if (normal.z < 0.0f)
        normal = aur_vector_scale(normal, -1.0f);
    found->normal = normal;
    found->view = aur_vector_dot(view, normal);
    found->light = aur_vector_dot(light, normal);
    /* Facets that show their back, or both directions one side though light goes through. */
    if (found->view * view.z <= 0.0f || found->light * light.z <= 0.0f)
        return false;
    float refracted;
    found->mirrored = aur_fresnel_dielectric(found->view, self->ior, &refracted);
    const float sum = found->view + found->ratio * found->light;
    found->jacobian = mirror ? 1.0f / (4.0f * fabsf(found->light))
                             : found->ratio * found->ratio * fabsf(found->light) / (sum * sum);
    return true;
}

static aur_vector upright(aur_vector view) {
    return view.z > 0.0f ? view : aur_vector_scale(view, -1.0f);
}

static float pdf_of(const rough *self, aur_vector view, const facet *at) {
    const float share = at->ratio == 1.0f ? at->mirrored : 1.0f - at->mirrored;
    const aur_vector normal = at->normal;
    return aur_microfacet_pdf(&self->microfacet, upright(view), normal) * at->jacobian * share;
}

static aur_vector value_of(const rough *self, aur_bsdf_point point, aur_vector view, aur_vector light,
                           const facet *at) {
    const float common = aur_microfacet_density(&self->microfacet, at->normal) *
                         aur_microfacet_masking(&self->microfacet, view, at->normal) *
                         aur_microfacet_masking(&self->microfacet, light, at->normal) *
                         fabsf(at->view / view.z) * at->jacobian;
    if (at->ratio == 1.0f)
        return aur_vector_scale(aur_color_at(&self->reflectance, point), common * at->mirrored);
    /* radiance is smaller on the side of the smaller index */
    return aur_vector_scale(aur_color_at(&self->transmittance, point),
                            common * (1.0f - at->mirrored) / (at->ratio * at->ratio));
}

static aur_vector evaluate(const aur_bsdf *bsdf, aur_bsdf_part part, aur_bsdf_point point, aur_vector view,
                           aur_vector light, float *pdf) {
    (void)part;
    facet at;
    *pdf = 0.0f;
    if (!find_facet(bsdf->data, view, light, &at))
        return (aur_vector){0};
    *pdf = pdf_of(bsdf->data, view, &at);
    return value_of(bsdf->data, point, view, light, &at);
}

static bool sample(const aur_bsdf *bsdf, aur_bsdf_part part, aur_bsdf_point point, aur_vector view,
                   const float u[3], aur_bsdf_sample *drawn) {
    (void)part;
    const rough *const self = bsdf->data;
    if (view.z == 0.0f)
        return false;
    const aur_vector normal = aur_microfacet_sample(&self->microfacet, upright(view), u[1], u[2]);
    const float cosine = aur_vector_dot(view, normal);
    float refracted;
    const float mirrored = aur_fresnel_dielectric(cosine, self->ior, &refracted);
    aur_vector light;
    if (u[0] < mirrored) {
        light = aur_vector_add_scaled(aur_vector_scale(view, -1.0f), 2.0f * cosine, normal);
    } else {
        const float ratio = cosine > 0.0f ? 1.0f / self->ior : self->ior;
        light = aur_vector_add_scaled(aur_vector_scale(view, -ratio), ratio * cosine + refracted, normal);
    }
    facet at;
    light = aur_vector_normalize(light);
    if ((light.z * view.z > 0.0f) != (u[0] < mirrored) || !find_facet(self, view, light, &at))
        return false;
    const float density = pdf_of(self, view, &at);
    if (!(density > 0.0f))
        return false;
    *drawn =
        (aur_bsdf_sample){.light = light,
                          .weight = aur_vector_scale(value_of(self, point, view, light, &at), 1.0f / density),
                          .pdf = density,
                          .ior_squared = at.ratio == 1.0f ? 0.0f : at.ratio * at.ratio};
    return true;
}

static void weigh(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view, aur_bsdf_lobe *lobes) {
    (void)bsdf;
    (void)point;
    lobes[0].axis = aur_mirror(view);
    lobes[0].coefficient = (aur_vector){1.0f, 1.0f, 1.0f};
}

const aur_bsdf_descriptor aur_bsdf_roughdielectric = {
    .row = {.name = "roughdielectric",
            .summary = "a rough boundary such as ground glass",
            .source = "Walter et al. 2007",
            AUR_ROW_KEYS(keys)},
    .size = sizeof(rough),
    .create = create,
    .weigh = weigh,
    .evaluate = evaluate,
    .sample = sample,
};
