/* Any opaque material under a clear coat, smooth or rough. Light is refracted on entry and exit, and absorbed
 * within the coat. Light that the coat reflects back to the material is ignored, as in Mitsuba 0.6
 * (coating.cpp, roughcoating.cpp; Weidlich and Wilkie 2007). A rough coat refracts in the directions of a
 * smooth one; its transmittance over all facets is tabulated. */
#include "render/scene/materials/fresnel.h"
#include "render/scene/materials/microfacet.h"
#include "render/scene/materials/sampling.h"
#include "render/scene/materials/texture.h"

typedef struct coating {
    aur_color absorption, specular;
    double thickness;
    const aur_bsdf *nested;
    float ior;
    bool rough;
    size_t first, specular_count; /* lobe indices: the first of the nested specular ones, and their number */
    size_t number[AUR_BSDF_LOBE_CAPACITY]; /* their indices in the nested material */
    aur_roughness microfacet;
    aur_rough_coat coat;
} coating;

#define COATING_KEYS                                                                                         \
    AUR_IOR_KEYS("bk7"), {AUR_KEY_OF_REAL(coating, "thickness", thickness, 0.0, 1e30, "1", "of the coat")},  \
        {AUR_KEY_OF_COLOR(coating, "sigma_a", absorption, 1e30, "0",                                         \
                          "absorption in the coat, an inverse of the thickness' unit")},                     \
        {AUR_KEY_OF_COLOR(coating, "specular_reflectance", specular, 1.0, "1",                               \
                          "factor of the light reflected by the coat")},                                     \
        AUR_NESTED_BSDF_KEY("bsdf", NULL, "the material under the coat; must be given")

static const aur_key smooth_keys[] = {COATING_KEYS};
static const aur_key rough_keys[] = {COATING_KEYS, AUR_MICROFACET_KEYS(coating)};

/* One lobe of the coat, one for all non-specular scattering of the material, and one for each of its specular
 * lobes. */
static void add_lobes(aur_bsdf *bsdf) {
    coating *const self = bsdf->data;
    const aur_bsdf *const nested = self->nested;
    unsigned sides = self->rough ? AUR_SIDES_BOTH : 0;
    for (size_t i = 0; i < nested->lobe_count; ++i)
        if (nested->lobes[i].shape != AUR_LOBE_SHAPE_SPECULAR)
            sides |= nested->lobes[i].sides;
    const aur_bsdf_lobe mirror = {
        .shape = AUR_LOBE_SHAPE_SPECULAR, .way = AUR_LOBE_WAY_MIRROR, .sides = AUR_SIDES_BOTH};
    if (!self->rough)
        aur_bsdf_add_lobe(bsdf, &mirror);
    if (sides != 0)
        aur_bsdf_add_lobe(bsdf, &(aur_bsdf_lobe){.shape = AUR_LOBE_SHAPE_SAMPLED, .sides = sides});
    self->first = bsdf->lobe_count;
    for (size_t i = 0; i < nested->lobe_count; ++i)
        if (nested->lobes[i].shape == AUR_LOBE_SHAPE_SPECULAR) {
            self->number[self->specular_count++] = i;
            aur_bsdf_add_lobe(bsdf, &nested->lobes[i]);
        }
}

static aur_result create(aur_parameters *parameters, aur_bsdf *bsdf, aur_error *error) {
    coating *const self = bsdf->data;
    aur_result result = aur_parameters_nested_bsdf(parameters, "bsdf", &self->nested, error);
    if (result == AUR_OK)
        result = aur_parameters_ior(parameters, "bk7", &self->ior, error);
    if (result != AUR_OK)
        return result;
    if (self->nested == NULL || self->nested->transmits)
        return aur_parameters_fail(parameters, error, AUR_ERROR_FORMAT,
                                   "it needs a nested bsdf that lets no light through");
    if (!(self->ior > 1.0001f))
        return aur_parameters_fail(parameters, error, AUR_ERROR_FORMAT, "'int_ior' must be above 'ext_ior'");
    add_lobes(bsdf);
    return AUR_OK;
}

static aur_result create_rough(aur_parameters *parameters, aur_bsdf *bsdf, aur_error *error) {
    coating *const self = bsdf->data;
    self->rough = true;
    const bool anisotropic = aur_roughness_complete(&self->microfacet);
    if (anisotropic || self->microfacet.varies)
        return aur_parameters_fail(parameters, error, AUR_ERROR_UNSUPPORTED,
                                   "'alpha' must be one number, and no texture");
    const aur_result result = create(parameters, bsdf, error);
    if (result == AUR_OK)
        self->coat = aur_rough_coat_of(&self->microfacet.constant, self->ior);
    return result;
}

/* --- through the coat */

/* A direction outside the coat, refracted into it on the same side; false: total reflection. */
static bool refract_in(const coating *self, aur_vector direction, aur_vector *within, float *transmitted) {
    float refracted;
    *transmitted = 1.0f - aur_fresnel_dielectric(fabsf(direction.z), self->ior, &refracted);
    const float side = direction.z < 0.0f ? -1.0f : 1.0f;
    *within = (aur_vector){direction.x / self->ior, direction.y / self->ior, side * fabsf(refracted)};
    if (self->rough)
        *transmitted = aur_rough_coat_transmittance(&self->coat, fabsf(direction.z));
    return refracted != 0.0f && *transmitted > 0.0f;
}

/* The inverse. */
static bool refract_out(const coating *self, aur_vector within, aur_vector *direction) {
    float refracted;
    aur_fresnel_dielectric(fabsf(within.z), 1.0f / self->ior, &refracted);
    const float side = within.z < 0.0f ? -1.0f : 1.0f;
    *direction = aur_vector_normalize(
        (aur_vector){within.x * self->ior, within.y * self->ior, side * fabsf(refracted)});
    return refracted != 0.0f;
}

/* Absorption within the coat along a pair of inner directions. */
static aur_vector left_by_absorption(const coating *self, aur_bsdf_point point, aur_vector view,
                                     aur_vector light) {
    const aur_vector depth = aur_vector_scale(aur_color_at(&self->absorption, point), (float)self->thickness);
    if (aur_vector_is_zero(depth))
        return (aur_vector){1.0f, 1.0f, 1.0f};
    const float way = 1.0f / fabsf(view.z) + 1.0f / fabsf(light.z);
    return (aur_vector){expf(-depth.x * way), expf(-depth.y * way), expf(-depth.z * way)};
}

/* The probability of sampling the coat rather than the material. */
static float coat_probability(float transmitted) {
    return fminf(fmaxf(1.0f - transmitted, 0.1f), 0.9f);
}

/* --- queries */

static aur_vector evaluate(const aur_bsdf *bsdf, aur_bsdf_part part, aur_bsdf_point point, aur_vector view,
                           aur_vector light, float *pdf) {
    const coating *const self = bsdf->data;
    aur_vector sum = {0}, inner_view, inner_light;
    float in, out, cosine, refracted, coat_pdf = 0.0f;
    *pdf = 0.0f;
    if (!(view.z * light.z > 0.0f) || !refract_in(self, view, &inner_view, &in))
        return sum;
    const bool draws_coat = self->rough || part == AUR_BSDF_WHOLE;
    const float coat = draws_coat ? coat_probability(in) : 0.0f;
    if (self->rough) {
        const float facets = aur_microfacet_mirror(&self->microfacet.constant, aur_upright(view),
                                                   aur_upright(light), &cosine, &coat_pdf);
        if (facets > 0.0f)
            sum = aur_vector_scale(aur_color_at(&self->specular, point),
                                   facets * aur_fresnel_dielectric(cosine, self->ior, &refracted));
    }
    *pdf = coat * coat_pdf;
    if (!refract_in(self, light, &inner_light, &out))
        return sum;
    float inner_pdf;
    const aur_vector inner =
        aur_bsdf_evaluate(self->nested, AUR_BSDF_WHOLE, point, inner_view, inner_light, &inner_pdf);
    const float squeezed = light.z / (inner_light.z * self->ior * self->ior);
    *pdf += (1.0f - coat) * inner_pdf * squeezed;
    return aur_vector_add_scaled(
        sum, in * out * squeezed,
        aur_vector_multiply(inner, left_by_absorption(self, point, inner_view, inner_light)));
}

static bool sample_coat(const aur_bsdf *bsdf, aur_bsdf_part part, aur_bsdf_point point, aur_vector view,
                        const float u[3], float probability, float transmitted, aur_bsdf_sample *drawn) {
    const coating *const self = bsdf->data;
    if (!self->rough) {
        *drawn = (aur_bsdf_sample){.light = aur_mirror(view),
                                   .weight = aur_vector_scale(aur_color_at(&self->specular, point),
                                                              (1.0f - transmitted) / probability),
                                   .specular = true};
        return true;
    }
    aur_vector normal;
    aur_vector light =
        aur_microfacet_draw_mirrored(&self->microfacet.constant, aur_upright(view), u[1], u[2], &normal);
    light = view.z > 0.0f ? light : aur_vector_scale(light, -1.0f);
    float pdf;
    const aur_vector value = evaluate(bsdf, part, point, view, light, &pdf);
    *drawn = (aur_bsdf_sample){.light = light, .weight = aur_vector_scale(value, 1.0f / pdf), .pdf = pdf};
    return pdf > 0.0f;
}

static bool sample(const aur_bsdf *bsdf, aur_bsdf_part part, aur_bsdf_point point, aur_vector view,
                   const float u[3], aur_bsdf_sample *drawn) {
    const coating *const self = bsdf->data;
    aur_vector inner_view, light;
    float in, out;
    if (view.z == 0.0f || !refract_in(self, view, &inner_view, &in))
        return false;
    const float coat = self->rough || part == AUR_BSDF_WHOLE ? coat_probability(in) : 0.0f;
    if (u[0] < coat)
        return sample_coat(bsdf, part, point, view, u, coat, in, drawn);
    const float rest = fminf((u[0] - coat) / (1.0f - coat), 0x1.fffffep-1f);
    if (!aur_bsdf_draw(self->nested, AUR_BSDF_WHOLE, point, inner_view, (const float[3]){rest, u[1], u[2]},
                       drawn) ||
        !refract_out(self, drawn->light, &light))
        return false;
    const aur_vector inner_light = drawn->light;
    drawn->light = light;
    if (drawn->specular) {
        refract_in(self, light, &(aur_vector){0}, &out);
        drawn->weight = aur_vector_scale(
            aur_vector_multiply(drawn->weight, left_by_absorption(self, point, inner_view, inner_light)),
            in * out / (1.0f - coat));
        return part == AUR_BSDF_WHOLE;
    }
    const aur_vector value = evaluate(bsdf, part, point, view, light, &drawn->pdf);
    drawn->weight = aur_vector_scale(value, 1.0f / drawn->pdf);
    return drawn->pdf > 0.0f;
}

static void weigh(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view, aur_bsdf_lobe *lobes) {
    const coating *const self = bsdf->data;
    aur_vector inner_view, outer;
    float in, out;
    if (view.z == 0.0f || !refract_in(self, view, &inner_view, &in))
        return;
    for (size_t i = 0; i < self->first; ++i) {
        const bool mirror = lobes[i].shape == AUR_LOBE_SHAPE_SPECULAR;
        lobes[i].axis = aur_mirror(view);
        lobes[i].coefficient = mirror ? aur_vector_scale(aur_color_at(&self->specular, point), 1.0f - in)
                                      : (aur_vector){1.0f, 1.0f, 1.0f};
    }
    if (self->specular_count == 0)
        return;
    aur_bsdf_lobe inner[AUR_BSDF_LOBE_CAPACITY];
    aur_bsdf_lobes(self->nested, point, inner_view, inner);
    for (size_t i = 0; i < self->specular_count; ++i) {
        const aur_bsdf_lobe *const from = &inner[self->number[i]];
        if (aur_vector_is_zero(from->coefficient) || !refract_out(self, from->axis, &outer))
            continue;
        refract_in(self, outer, &(aur_vector){0}, &out);
        lobes[self->first + i].axis = from->way == AUR_LOBE_WAY_MIRROR ? aur_mirror(view) : outer;
        lobes[self->first + i].coefficient = aur_vector_scale(
            aur_vector_multiply(from->coefficient, left_by_absorption(self, point, inner_view, from->axis)),
            in * out);
    }
}

#define COATING .size = sizeof(coating), .weigh = weigh, .evaluate = evaluate, .sample = sample

const aur_bsdf_descriptor aur_bsdf_coating = {
    .row = {.name = "coating",
            .summary = "the nested bsdf under a smooth clear coat",
            .source = "Weidlich and Wilkie 2007 (Mitsuba 0.6)",
            AUR_ROW_KEYS(smooth_keys)},
    .create = create,
    COATING,
};

const aur_bsdf_descriptor aur_bsdf_roughcoating = {
    .row = {.name = "roughcoating",
            .summary = "the nested bsdf under a rough clear coat",
            .source = "Weidlich and Wilkie 2007 (Mitsuba 0.6)",
            AUR_ROW_KEYS(rough_keys)},
    .create = create_rough,
    COATING,
};
