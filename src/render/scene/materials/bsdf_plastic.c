/* A diffuse base under a clear coat, smooth or rough. The coat reflects by a Dirac lobe or by microfacets,
 * and transmits by the Fresnel equations or by a table. Light that the coat reflects inwards meets the base
 * again: a geometric series over these bounces gives the factor below. `pplastic` is in between: microfacets
 * reflect, but transmission is that of a smooth coat, and light meets the base once. */
#include "render/scene/materials/fresnel.h"
#include "render/scene/materials/microfacet.h"
#include "render/scene/materials/sampling.h"
#include "render/scene/materials/texture.h"

typedef struct plastic {
    aur_color diffuse, specular;
    float ior;
    bool nonlinear;            /* colour saturation grows with each inner bounce */
    float inner_reflectance;   /* diffuse reflectance of the coat from inside */
    float outer_transmittance; /* diffuse reflectance of the coat from outside */
    float specular_weight;
    bool rough;     /* microfacets reflect */
    bool tabulated; /* transmission is tabulated */
    bool once;      /* no inner bounces */
    /* Of a rough coat: */
    aur_roughness microfacet;
    aur_rough_coat coat;
} plastic;

#define COAT_KEYS                                                                                            \
    AUR_IOR_KEYS("polypropylene"),                                                                           \
        {AUR_KEY_OF_COLOR(plastic, "diffuse_reflectance", diffuse, 1.0, "0.5", "of the base")}, {            \
        AUR_KEY_OF_COLOR(plastic, "specular_reflectance", specular, 1.0, "1",                                \
                         "factor of the light reflected by the coat")                                        \
    }
#define PLASTIC_KEYS                                                                                         \
    COAT_KEYS, {                                                                                             \
        AUR_KEY_OF_BOOLEAN(plastic, "nonlinear", nonlinear, "false",                                         \
                           "the colour deepens with each inner bounce")                                      \
    }

static const aur_key smooth_keys[] = {PLASTIC_KEYS};
static const aur_key rough_keys[] = {
    PLASTIC_KEYS,
    AUR_MICROFACET_KEYS(plastic),
    {AUR_KEY_OF_BOOLEAN(plastic, "as_mitsuba", microfacet.constant.fitted, "false",
                        "by the sums and the fit of Mitsuba 3, to compare with it: a darker base")}};
static const aur_key once_keys[] = {COAT_KEYS, AUR_MICROFACET_KEYS(plastic)};

static aur_result make_coat(aur_parameters *parameters, aur_bsdf *bsdf, aur_error *error) {
    plastic *const self = bsdf->data;
    const aur_result result = aur_parameters_ior(parameters, "polypropylene", &self->ior, error);
    if (result != AUR_OK)
        return result;
    self->inner_reflectance = aur_fresnel_diffuse(1.0f / self->ior);
    self->outer_transmittance = 1.0f - aur_fresnel_diffuse(self->ior);
    const float diffuse = aur_luminance(aur_color_mean(&self->diffuse));
    const float specular = aur_luminance(aur_color_mean(&self->specular));
    self->specular_weight = diffuse + specular > 0.0f ? specular / (diffuse + specular) : 0.5f;
    return AUR_OK;
}

/* Transmittance of the coat at `cosine` from outside. */
static float transmittance(const plastic *self, float cosine) {
    if (!self->tabulated) {
        float refracted;
        return 1.0f - aur_fresnel_dielectric(cosine, self->ior, &refracted);
    }
    return aur_rough_coat_transmittance(&self->coat, cosine);
}

static float factor(const void *data, float cosine) {
    return transmittance(data, cosine);
}

/* The base is a cosine lobe times the transmittance of the coat, which is lower at grazing angles. */
static void add_base(aur_bsdf *bsdf) {
    aur_bsdf_lobe lobe = aur_diffuse_lobe();
    lobe.factor = factor;
    lobe.factor_data = bsdf->data;
    aur_bsdf_add_lobe(bsdf, &lobe);
}

static aur_result create_smooth(aur_parameters *parameters, aur_bsdf *bsdf, aur_error *error) {
    const aur_bsdf_lobe coat = {
        .shape = AUR_LOBE_SHAPE_SPECULAR, .way = AUR_LOBE_WAY_MIRROR, .sides = AUR_SIDE_FRONT};
    aur_bsdf_add_lobe(bsdf, &coat);
    add_base(bsdf);
    return make_coat(parameters, bsdf, error);
}

static aur_result create_facets(aur_parameters *parameters, aur_bsdf *bsdf, aur_error *error) {
    plastic *const self = bsdf->data;
    self->rough = true;
    add_base(bsdf);
    aur_roughness_complete(&self->microfacet);
    const aur_bsdf_lobe coat = {.shape = AUR_LOBE_SHAPE_SAMPLED,
                                .sides = AUR_SIDE_FRONT,
                                .ggx_alpha = aur_roughness_ggx_alpha(&self->microfacet)};
    aur_bsdf_add_lobe(bsdf, &coat);
    return make_coat(parameters, bsdf, error);
}

static aur_result create_once(aur_parameters *parameters, aur_bsdf *bsdf, aur_error *error) {
    plastic *const self = bsdf->data;
    self->once = true;
    bsdf->anisotropic = aur_roughness_complete(&self->microfacet);
    return create_facets(parameters, bsdf, error);
}

static aur_result create_rough(aur_parameters *parameters, aur_bsdf *bsdf, aur_error *error) {
    const aur_result result = create_facets(parameters, bsdf, error);
    if (result != AUR_OK)
        return result;
    plastic *const self = bsdf->data;
    self->tabulated = true;
    if (self->microfacet.alpha.texture != NULL || self->microfacet.alpha_u.texture != NULL ||
        self->microfacet.alpha_v.texture != NULL)
        return aur_fail_at(
            error, parameters->location, AUR_ERROR_UNSUPPORTED,
            "bsdf 'roughplastic': 'alpha' cannot be a texture: 'principled' has one for its roughness");
    if (aur_roughness_complete(&self->microfacet))
        return aur_fail_at(error, parameters->location, AUR_ERROR_UNSUPPORTED,
                           "bsdf 'roughplastic': 'alpha_u' and 'alpha_v' must be equal: give 'alpha'");
    const aur_microfacet *const facets = &self->microfacet.constant;
    self->coat =
        facets->fitted ? aur_rough_coat_of_mitsuba(facets, self->ior) : aur_rough_coat_of(facets, self->ior);
    self->inner_reflectance = self->coat.inner_reflectance;
    self->outer_transmittance = self->coat.outer_transmittance;
    return AUR_OK;
}

/* The base's colour with inner bounces, over ior^2: to be multiplied by both transmittances. */
static aur_vector base_color(const plastic *self, aur_bsdf_point point) {
    const aur_vector color = aur_color_at(&self->diffuse, point);
    if (self->once)
        return color;
    const float inner = self->inner_reflectance, scale = 1.0f / (self->ior * self->ior);
    if (!self->nonlinear)
        return aur_vector_scale(color, scale / (1.0f - inner));
    return (aur_vector){color.x * scale / (1.0f - color.x * inner),
                        color.y * scale / (1.0f - color.y * inner),
                        color.z * scale / (1.0f - color.z * inner)};
}

/* The probability of sampling the coat, given its transmittance. */
static float specular_probability(const plastic *self, float transmittance) {
    const float coat = (1.0f - transmittance) * self->specular_weight;
    const float base = transmittance * (1.0f - self->specular_weight);
    return coat + base > 0.0f ? coat / (coat + base) : 1.0f;
}

static void weigh(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view, aur_bsdf_lobe *lobes) {
    const plastic *const self = bsdf->data;
    if (view.z <= 0.0f)
        return;
    const float through = transmittance(self, view.z);
    aur_bsdf_lobe *const base = &lobes[self->rough ? 0 : 1], *const coat = &lobes[self->rough ? 1 : 0];
    base->coefficient = aur_vector_scale(base_color(self, point), through / AUR_PI_F);
    coat->axis = aur_mirror(view);
    coat->coefficient = self->rough ? (aur_vector){1.0f, 1.0f, 1.0f}
                                    : aur_vector_scale(aur_color_at(&self->specular, point), 1.0f - through);
}

static aur_vector evaluate(const aur_bsdf *bsdf, aur_bsdf_part part, aur_bsdf_point point, aur_vector view,
                           aur_vector light, float *pdf) {
    const plastic *const self = bsdf->data;
    aur_vector sum = {0};
    *pdf = 0.0f;
    if (view.z <= 0.0f || light.z <= 0.0f)
        return sum;
    float cosine, refracted;
    const aur_microfacet microfacet = aur_roughness_at(&self->microfacet, point);
    const float facets = self->rough ? aur_microfacet_mirror(&microfacet, view, light, &cosine, pdf) : 0.0f;
    if (facets > 0.0f)
        sum = aur_vector_scale(aur_color_at(&self->specular, point),
                               facets * aur_fresnel_dielectric(cosine, self->ior, &refracted));
    if (part == AUR_BSDF_SAMPLED_LOBES)
        return sum;
    const float through = transmittance(self, view.z), probability = specular_probability(self, through);
    *pdf = probability * *pdf + (1.0f - probability) * light.z / AUR_PI_F;
    const float base = through * transmittance(self, light.z) * light.z / AUR_PI_F;
    return aur_vector_add_scaled(sum, base, base_color(self, point));
}

static bool sample(const aur_bsdf *bsdf, aur_bsdf_part part, aur_bsdf_point point, aur_vector view,
                   const float u[3], aur_bsdf_sample *drawn) {
    const plastic *const self = bsdf->data;
    if (view.z <= 0.0f)
        return false;
    const float through = transmittance(self, view.z);
    const float probability = part == AUR_BSDF_SAMPLED_LOBES ? 1.0f : specular_probability(self, through);
    if (!self->rough && u[0] < probability) {
        *drawn = (aur_bsdf_sample){
            .light = aur_mirror(view),
            .weight = aur_vector_scale(aur_color_at(&self->specular, point), (1.0f - through) / probability),
            .specular = true};
        return true;
    }
    const aur_microfacet facets = aur_roughness_at(&self->microfacet, point);
    aur_vector normal;
    const aur_vector light = u[0] < probability
                                 ? aur_microfacet_draw_mirrored(&facets, view, u[1], u[2], &normal)
                                 : aur_sample_cosine(u[1], u[2]);
    float density;
    const aur_vector value = evaluate(bsdf, part, point, view, light, &density);
    *drawn =
        (aur_bsdf_sample){.light = light, .weight = aur_vector_scale(value, 1.0f / density), .pdf = density};
    return density > 0.0f;
}

static aur_vector diffuse_albedo(const aur_bsdf *bsdf, aur_bsdf_point point, float side) {
    const plastic *const self = bsdf->data;
    if (side <= 0.0f)
        return (aur_vector){0};
    return aur_vector_scale(base_color(self, point), transmittance(self, side) * self->outer_transmittance);
}

const aur_bsdf_descriptor aur_bsdf_plastic = {
    .row = {.name = "plastic",
            .summary = "a diffuse base under a smooth clear coat",
            .source = "Jakob 2010 (Mitsuba)",
            AUR_ROW_KEYS(smooth_keys)},
    .size = sizeof(plastic),
    .create = create_smooth,
    .weigh = weigh,
    .evaluate = evaluate,
    .sample = sample,
    .diffuse_albedo = diffuse_albedo,
};

const aur_bsdf_descriptor aur_bsdf_roughplastic = {
    .row = {.name = "roughplastic",
            .summary = "a diffuse base under a rough clear coat",
            .source = "Jakob 2010 (Mitsuba)",
            AUR_ROW_KEYS(rough_keys)},
    .size = sizeof(plastic),
    .create = create_rough,
    .weigh = weigh,
    .evaluate = evaluate,
    .sample = sample,
    .diffuse_albedo = diffuse_albedo,
};

const aur_bsdf_descriptor aur_bsdf_pplastic = {
    .row = {.name = "pplastic",
            .summary = "a rough coat over a base, with one interaction, unpolarised",
            .source = "Baek et al. 2018 (Mitsuba 3)",
            AUR_ROW_KEYS(once_keys)},
    .size = sizeof(plastic),
    .polarizes = true,
    .create = create_once,
    .weigh = weigh,
    .evaluate = evaluate,
    .sample = sample,
    .diffuse_albedo = diffuse_albedo,
};
