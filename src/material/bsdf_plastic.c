/* A diffuse base under a clear coat, smooth or rough. Light that the coat mirrors inwards meets the base
 * again; the geometric series over these bounces gives the factor below. */
#include "material/fresnel.h"
#include "material/microfacet.h"
#include "material/sampling.h"
#include "material/texture.h"

enum { TABLE_SIZE = 64 };

typedef struct plastic {
    aur_color diffuse, specular;
    float ior;
    bool nonlinear;            /* the colour deepens with each inner bounce */
    float inner_reflectance;   /* of the coat from inside, over diffuse light */
    float outer_transmittance; /* of the coat from outside, over diffuse light */
    float specular_weight;
    aur_microfacet microfacet;
    float transmittance[TABLE_SIZE]; /* of the rough coat from outside, at cosines i / (TABLE_SIZE - 1) */
} plastic;

static aur_result read_coat(aur_parameters *parameters, aur_bsdf *bsdf, aur_error *error) {
    plastic *const self = bsdf->data;
    self->diffuse.constant = (aur_vector){0.5f, 0.5f, 0.5f};
    self->specular.constant = (aur_vector){1.0f, 1.0f, 1.0f};
    aur_result result = aur_parameters_ior(parameters, "polypropylene", &self->ior, error);
    if (result == AUR_OK)
        result = aur_parameters_color(parameters, "diffuse_reflectance", 1.0, &self->diffuse, error);
    if (result == AUR_OK)
        result = aur_parameters_color(parameters, "specular_reflectance", 1.0, &self->specular, error);
    if (result == AUR_OK)
        result = aur_parameters_boolean(parameters, "nonlinear", &self->nonlinear, error);
    if (result != AUR_OK)
        return result;
    self->inner_reflectance = aur_fresnel_diffuse(1.0f / self->ior);
    self->outer_transmittance = 1.0f - aur_fresnel_diffuse(self->ior);
    const float diffuse = aur_luminance(aur_color_mean(&self->diffuse));
    const float specular = aur_luminance(aur_color_mean(&self->specular));
    self->specular_weight = diffuse + specular > 0.0f ? specular / (diffuse + specular) : 0.5f;
    return AUR_OK;
}

/* What a rough boundary does with light that meets it at `cosine`. Facets that others shadow scatter once
 * only, so the two shares are below 1 in sum, the more so the rougher; Mitsuba 3 does the same. */
typedef struct rough_shares {
    double mirrored, through;
} rough_shares;

static rough_shares shares_at(const aur_microfacet *microfacet, float ior, float cosine) {
    /* From the denser side, total reflection cuts an edge into the integrand. */
    const size_t side = ior > 1.0f ? 32 : 64;
    const float z = fmaxf(cosine, 1e-4f);
    const aur_vector view = {sqrtf(1.0f - z * z), 0.0f, z};
    rough_shares sum = {0};
    for (size_t i = 0; i < side * side; ++i) {
        const aur_vector normal =
            aur_microfacet_sample(microfacet, view, ((float)(i / side) + 0.5f) / (float)side,
                                  ((float)(i % side) + 0.5f) / (float)side);
        const float along = aur_vector_dot(view, normal);
        if (!(along > 0.0f))
            continue;
        float refracted;
        const float fresnel = aur_fresnel_dielectric(along, ior, &refracted);
        const aur_vector up = aur_vector_add_scaled(aur_vector_scale(view, -1.0f), 2.0f * along, normal);
        const aur_vector down =
            aur_vector_add_scaled(aur_vector_scale(view, -1.0f / ior), along / ior + refracted, normal);
        if (up.z > 0.0f)
            sum.mirrored += (double)(fresnel * aur_microfacet_masking(microfacet, up, normal));
        if (down.z < 0.0f)
            sum.through += (double)((1.0f - fresnel) * aur_microfacet_masking(microfacet, down, normal));
    }
    const double count = (double)(side * side);
    return (rough_shares){sum.mirrored / count, sum.through / count};
}

/* Of the coat, at a cosine above it. */
static float smooth_transmittance(const plastic *self, float cosine) {
    float refracted;
    return 1.0f - aur_fresnel_dielectric(cosine, self->ior, &refracted);
}

static float rough_transmittance(const plastic *self, float cosine) {
    const float place = fminf(fmaxf(cosine, 0.0f), 1.0f) * (TABLE_SIZE - 1);
    const size_t index = place < TABLE_SIZE - 1 ? (size_t)place : TABLE_SIZE - 2;
    const float share = place - (float)index;
    return (1.0f - share) * self->transmittance[index] + share * self->transmittance[index + 1];
}

/* The base's colour with its inner bounces, over ior^2: what is to be multiplied by both transmittances. */
static aur_vector base_color(const plastic *self, aur_bsdf_point point) {
    const aur_vector color = aur_color_at(&self->diffuse, point);
    const float inner = self->inner_reflectance, scale = 1.0f / (self->ior * self->ior);
    if (!self->nonlinear)
        return aur_vector_scale(color, scale / (1.0f - inner));
    return (aur_vector){color.x * scale / (1.0f - color.x * inner),
                        color.y * scale / (1.0f - color.y * inner),
                        color.z * scale / (1.0f - color.z * inner)};
}

/* How often the coat is drawn, where it lets `transmittance` through. */
static float specular_probability(const plastic *self, float transmittance) {
    const float coat = (1.0f - transmittance) * self->specular_weight;
    const float base = transmittance * (1.0f - self->specular_weight);
    return coat + base > 0.0f ? coat / (coat + base) : 1.0f;
}

/* The base is a cosine lobe but for the coat, which lets less through the flatter light comes. */
static void add_base(aur_bsdf *bsdf, float (*factor)(const void *, float)) {
    aur_bsdf_lobe lobe = aur_diffuse_lobe();
    lobe.factor = factor;
    lobe.factor_data = bsdf->data;
    aur_bsdf_add_lobe(bsdf, &lobe);
}

/* --- smooth */

static float smooth_factor(const void *data, float cosine) {
    return smooth_transmittance(data, cosine);
}

static aur_result create_smooth(aur_parameters *parameters, aur_bsdf *bsdf, aur_error *error) {
    const aur_bsdf_lobe coat = {.shape = AUR_LOBE_SHAPE_SPECULAR, .sides = AUR_SIDE_FRONT};
    aur_bsdf_add_lobe(bsdf, &coat);
    add_base(bsdf, smooth_factor);
    return read_coat(parameters, bsdf, error);
}

static aur_vector evaluate_smooth(const aur_bsdf *bsdf, aur_bsdf_part part, aur_bsdf_point point,
                                  aur_vector view, aur_vector light) {
    (void)part;
    const plastic *const self = bsdf->data;
    if (view.z <= 0.0f || light.z <= 0.0f)
        return (aur_vector){0};
    return aur_vector_scale(base_color(self, point), smooth_transmittance(self, view.z) *
                                                         smooth_transmittance(self, light.z) * light.z /
                                                         AUR_PI_F);
}

static float pdf_smooth(const aur_bsdf *bsdf, aur_bsdf_part part, aur_bsdf_point point, aur_vector view,
                        aur_vector light) {
    (void)part;
    (void)point;
    const plastic *const self = bsdf->data;
    if (view.z <= 0.0f || light.z <= 0.0f)
        return 0.0f;
    return (1.0f - specular_probability(self, smooth_transmittance(self, view.z))) * light.z / AUR_PI_F;
}

static bool sample_smooth(const aur_bsdf *bsdf, aur_bsdf_part part, aur_bsdf_point point, aur_vector view,
                          const float u[3], aur_bsdf_sample *drawn) {
    (void)part;
    const plastic *const self = bsdf->data;
    if (view.z <= 0.0f)
        return false;
    const float through = smooth_transmittance(self, view.z);
    const float probability = specular_probability(self, through);
    if (u[0] < probability) {
        *drawn = (aur_bsdf_sample){
            .light = aur_mirror(view),
            .weight = aur_vector_scale(aur_color_at(&self->specular, point), (1.0f - through) / probability),
            .specular = true};
        return true;
    }
    const aur_vector light = aur_sample_cosine(u[1], u[2]);
    const float weight = through * smooth_transmittance(self, light.z) / (1.0f - probability);
    *drawn = (aur_bsdf_sample){.light = light,
                               .weight = aur_vector_scale(base_color(self, point), weight),
                               .pdf = (1.0f - probability) * light.z / AUR_PI_F};
    return drawn->pdf > 0.0f;
}

static void weigh_smooth(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view, aur_bsdf_lobe *lobes) {
    const plastic *const self = bsdf->data;
    if (view.z <= 0.0f)
        return;
    const float mirrored = 1.0f - smooth_transmittance(self, view.z);
    lobes[0].axis = aur_mirror(view);
    lobes[0].coefficient = aur_vector_scale(aur_color_at(&self->specular, point), mirrored);
    lobes[1].coefficient = aur_vector_scale(base_color(self, point), (1.0f - mirrored) / AUR_PI_F);
}

static aur_vector albedo_smooth(const aur_bsdf *bsdf, aur_bsdf_point point, float side) {
    const plastic *const self = bsdf->data;
    if (side <= 0.0f)
        return (aur_vector){0};
    return aur_vector_scale(base_color(self, point),
                            smooth_transmittance(self, side) * self->outer_transmittance);
}

const aur_bsdf_descriptor aur_bsdf_plastic = {
    .name = "plastic",
    .summary = "a diffuse base under a smooth clear coat",
    .source = "Jakob 2010 (Mitsuba)",
    .size = sizeof(plastic),
    .create = create_smooth,
    .weigh = weigh_smooth,
    .evaluate = evaluate_smooth,
    .pdf = pdf_smooth,
    .sample = sample_smooth,
    .diffuse_albedo = albedo_smooth,
};

/* --- rough */

static float rough_factor(const void *data, float cosine) {
    return rough_transmittance(data, cosine);
}

static aur_result create_rough(aur_parameters *parameters, aur_bsdf *bsdf, aur_error *error) {
    aur_result result = read_coat(parameters, bsdf, error);
    if (result != AUR_OK)
        return result;
    plastic *const self = bsdf->data;
    add_base(bsdf, rough_factor);
    const aur_bsdf_lobe coat = {.shape = AUR_LOBE_SHAPE_SAMPLED, .sides = AUR_SIDE_FRONT};
    aur_bsdf_add_lobe(bsdf, &coat);
    result = aur_parameters_microfacet(parameters, &self->microfacet, error);
    if (result != AUR_OK)
        return result;
    if (self->microfacet.alpha_u != self->microfacet.alpha_v)
        return aur_fail_at(error, parameters->location, AUR_ERROR_UNSUPPORTED,
                           "bsdf 'roughplastic': 'alpha_u' and 'alpha_v' must be equal: give 'alpha'");
    double inner = 0.0, outer = 0.0;
    for (size_t i = 0; i < TABLE_SIZE; ++i) {
        const float cosine = (float)i / (TABLE_SIZE - 1);
        self->transmittance[i] = (float)shares_at(&self->microfacet, self->ior, cosine).through;
        const double weight = (i == 0 || i == TABLE_SIZE - 1 ? 1.0 : 2.0) * (double)cosine / (TABLE_SIZE - 1);
        inner += weight * shares_at(&self->microfacet, 1.0f / self->ior, cosine).mirrored;
        outer += weight * (double)self->transmittance[i];
    }
    self->inner_reflectance = (float)inner;
    self->outer_transmittance = (float)outer;
    return AUR_OK;
}

static aur_vector evaluate_coat(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view,
                                aur_vector light) {
    const plastic *const self = bsdf->data;
    if (view.z <= 0.0f || light.z <= 0.0f)
        return (aur_vector){0};
    const aur_vector normal = aur_vector_normalize(aur_vector_add(view, light));
    const float coat = aur_microfacet_density(&self->microfacet, normal) *
                       aur_microfacet_masking(&self->microfacet, view, normal) *
                       aur_microfacet_masking(&self->microfacet, light, normal) *
                       (1.0f - smooth_transmittance(self, aur_vector_dot(view, normal))) / (4.0f * view.z);
    return aur_vector_scale(aur_color_at(&self->specular, point), coat);
}

static float pdf_coat(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view, aur_vector light) {
    (void)point;
    const plastic *const self = bsdf->data;
    if (view.z <= 0.0f || light.z <= 0.0f)
        return 0.0f;
    const aur_vector normal = aur_vector_normalize(aur_vector_add(view, light));
    return aur_microfacet_pdf(&self->microfacet, view, normal) / (4.0f * aur_vector_dot(view, normal));
}

static aur_vector draw_coat(const plastic *self, aur_vector view, const float u[3]) {
    const aur_vector normal = aur_microfacet_sample(&self->microfacet, view, u[1], u[2]);
    return aur_vector_add_scaled(aur_vector_scale(view, -1.0f), 2.0f * aur_vector_dot(view, normal), normal);
}

static aur_vector evaluate_rough(const aur_bsdf *bsdf, aur_bsdf_part part, aur_bsdf_point point,
                                 aur_vector view, aur_vector light) {
    const plastic *const self = bsdf->data;
    if (view.z <= 0.0f || light.z <= 0.0f)
        return (aur_vector){0};
    const aur_vector coat = evaluate_coat(bsdf, point, view, light);
    if (part == AUR_BSDF_SAMPLED_LOBES)
        return coat;
    const float base =
        rough_transmittance(self, view.z) * rough_transmittance(self, light.z) * light.z / AUR_PI_F;
    return aur_vector_add_scaled(coat, base, base_color(self, point));
}

static float pdf_rough(const aur_bsdf *bsdf, aur_bsdf_part part, aur_bsdf_point point, aur_vector view,
                       aur_vector light) {
    const plastic *const self = bsdf->data;
    if (view.z <= 0.0f || light.z <= 0.0f)
        return 0.0f;
    if (part == AUR_BSDF_SAMPLED_LOBES)
        return pdf_coat(bsdf, point, view, light);
    const float probability = specular_probability(self, rough_transmittance(self, view.z));
    return probability * pdf_coat(bsdf, point, view, light) + (1.0f - probability) * light.z / AUR_PI_F;
}

static bool sample_rough(const aur_bsdf *bsdf, aur_bsdf_part part, aur_bsdf_point point, aur_vector view,
                         const float u[3], aur_bsdf_sample *drawn) {
    const plastic *const self = bsdf->data;
    if (view.z <= 0.0f)
        return false;
    const float probability =
        part == AUR_BSDF_SAMPLED_LOBES ? 1.0f : specular_probability(self, rough_transmittance(self, view.z));
    const aur_vector light = u[0] < probability ? draw_coat(self, view, u) : aur_sample_cosine(u[1], u[2]);
    const float density = pdf_rough(bsdf, part, point, view, light);
    if (!(density > 0.0f))
        return false;
    const aur_vector value = evaluate_rough(bsdf, part, point, view, light);
    *drawn =
        (aur_bsdf_sample){.light = light, .weight = aur_vector_scale(value, 1.0f / density), .pdf = density};
    return true;
}

static void weigh_rough(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view, aur_bsdf_lobe *lobes) {
    const plastic *const self = bsdf->data;
    if (view.z <= 0.0f)
        return;
    lobes[0].coefficient =
        aur_vector_scale(base_color(self, point), rough_transmittance(self, view.z) / AUR_PI_F);
    lobes[1].axis = aur_mirror(view);
    lobes[1].coefficient = (aur_vector){1.0f, 1.0f, 1.0f};
}

static aur_vector albedo_rough(const aur_bsdf *bsdf, aur_bsdf_point point, float side) {
    const plastic *const self = bsdf->data;
    if (side <= 0.0f)
        return (aur_vector){0};
    return aur_vector_scale(base_color(self, point),
                            rough_transmittance(self, side) * self->outer_transmittance);
}

const aur_bsdf_descriptor aur_bsdf_roughplastic = {
    .name = "roughplastic",
    .summary = "a diffuse base under a rough clear coat",
    .source = "Jakob 2010 (Mitsuba)",
    .size = sizeof(plastic),
    .create = create_rough,
    .weigh = weigh_rough,
    .evaluate = evaluate_rough,
    .pdf = pdf_rough,
    .sample = sample_rough,
    .diffuse_albedo = albedo_rough,
};
