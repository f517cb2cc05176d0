/* A general material, from a coated or metallic base to rough glass (Burley 2012 and 2015), by the formulas
 * of Mitsuba 3. It may reflect more light than it receives, for a bright base with high roughness or sheen.
 */
#include "render/scene/materials/burley.h"
#include "render/scene/materials/fresnel.h"

typedef struct principled {
    aur_burley burley;
    aur_color metallic, clearcoat, clearcoat_gloss;
    float eta;
    size_t lobe;    /* index of the sampled lobe, after the diffuse one if present */
    float specular; /* read, not used afterwards */
} principled;

static const aur_key keys[] = {
    AUR_BURLEY_KEYS(principled),
    AUR_KEY_OF_SHARE(principled, "metallic", metallic, "0", "share of metal"),
    AUR_KEY_OF_SHARE(principled, "clearcoat", clearcoat, "0", "a second highlight over all"),
    AUR_KEY_OF_SHARE(principled, "clearcoat_gloss", clearcoat_gloss, "0", "how sharp that is"),
    {AUR_KEY_OF_REAL(principled, "eta", eta, 0.1, 100.0, "specular",
                     "index of refraction inside over outside"),
     .computed = true},
    {AUR_KEY_OF_REAL(principled, "specular", specular, 0.0, 1.0, "0.5",
                     "instead of eta: 12.5 times the reflectance at normal incidence")},
};

static aur_result create(aur_parameters *parameters, aur_bsdf *bsdf, aur_error *error) {
    principled *const self = bsdf->data;
    const aur_parameter *const given = aur_parameters_find(parameters, "specular");
    if (self->eta != 0.0f && given != NULL)
        return aur_fail_at(error, given->location, AUR_ERROR_FORMAT,
                           "bsdf 'principled': give 'eta' or 'specular', not both");
    const bool glass =
        !aur_burley_is_always(&self->burley.spec_trans, 0.0f) && !aur_burley_is_always(&self->metallic, 1.0f);
    /* A refracting boundary needs an index different from 1: the same minima as in Mitsuba 3. */
    if (self->eta == 0.0f)
        self->eta = 2.0f / (1.0f - sqrtf(0.08f * fmaxf(self->specular, glass ? 1e-3f : 0.0f))) - 1.0f;
    else if (glass && fabsf(self->eta - 1.0f) < 1e-4f)
        self->eta = 1.001f;
    bsdf->anisotropic = aur_burley_is_anisotropic(&self->burley);
    const aur_bsdf_lobe diffuse = aur_burley_lobe(AUR_SIDE_FRONT);
    const aur_bsdf_lobe rest = {.shape = AUR_LOBE_SHAPE_SAMPLED,
                                .transmits = glass,
                                .sides = glass ? AUR_SIDES_BOTH : AUR_SIDE_FRONT};
    if (!aur_burley_is_always(&self->metallic, 1.0f) && !aur_burley_is_always(&self->burley.spec_trans, 1.0f))
        aur_bsdf_add_lobe(bsdf, &diffuse);
    self->lobe = aur_bsdf_add_lobe(bsdf, &rest);
    return AUR_OK;
}

/* --- parameters at a point, seen from a side */

typedef struct principled_terms {
    aur_burley_point burley;
    aur_microfacet facets;
    float metallic, eta;
    float base, glass; /* weights of the dielectric: its opaque part, and the rest */
    float coat, coat_alpha;
    bool front;
    float diffuse_probability, coat_probability; /* sampling probabilities; facets have the rest */
} principled_terms;

static float probability_of_facets(const principled_terms *at, float cosine);

static principled_terms terms_at(const principled *self, aur_bsdf_part part, aur_bsdf_point point,
                                 aur_vector view) {
    principled_terms at = {.burley = aur_burley_at(&self->burley, point),
                           .metallic = aur_color_number_at(&self->metallic, point),
                           .eta = self->eta,
                           .coat = 0.25f * aur_color_number_at(&self->clearcoat, point),
                           .coat_alpha = 0.1f - 0.099f * aur_color_number_at(&self->clearcoat_gloss, point),
                           .front = view.z > 0.0f};
    at.facets = aur_burley_facets(&at.burley, at.burley.roughness);
    at.glass = (1.0f - at.metallic) * at.burley.spec_trans;
    at.base = 1.0f - at.metallic - at.glass;
    if (!at.front)
        return at;
    const float diffuse = part == AUR_BSDF_WHOLE ? at.base * aur_luminance(at.burley.base) : 0.0f;
    const float rest = aur_burley_rest_probability(&at.burley, at.base, 1.0f - at.metallic, view.z);
    const float facets = probability_of_facets(&at, view.z), total = diffuse + rest + facets + at.coat;
    at.diffuse_probability = (diffuse + rest) / total;
    at.coat_probability = at.coat / total;
    return at;
}

/* Facet reflectance at a cosine: dielectric, metal and mixtures; only glass when seen from behind. */
static aur_vector reflectance(const principled_terms *at, float cosine, float dielectric) {
    if (!at->front)
        return (aur_vector){at->glass * dielectric, at->glass * dielectric, at->glass * dielectric};
    const aur_burley_point *const burley = &at->burley;
    const float normal = (at->eta - 1.0f) / (at->eta + 1.0f);
    const float plain = (1.0f - at->metallic) * (1.0f - burley->spec_tint) * dielectric;
    const aur_vector metal = aur_schlick(burley->base, cosine, at->eta);
    const aur_vector tinted = aur_schlick(aur_vector_scale(burley->tint, normal * normal), cosine, at->eta);
    return aur_vector_add_scaled(
        aur_vector_add_scaled((aur_vector){plain, plain, plain}, at->metallic, metal),
        (1.0f - at->metallic) * burley->spec_tint, tinted);
}

/* Proportional to approximate albedos; never 0 for facets, even if black at normal incidence. */
static float probability_of_facets(const principled_terms *at, float cosine) {
    float refracted;
    const float dielectric = aur_fresnel_dielectric(cosine, at->eta, &refracted);
    return 0.05f + aur_luminance(reflectance(at, cosine, dielectric)) + at->glass * (1.0f - dielectric);
}

/* The probability that a sampled facet reflects rather than transmits. */
static float probability_of_mirror(const principled_terms *at, float dielectric) {
    return at->front ? 1.0f - at->glass * (1.0f - dielectric) : dielectric;
}

/* --- clearcoat: GTR distribution with exponent 1, which has longer tails than GGX (Burley 2012); fixed
 * masking */

static float coat_density(float alpha, float cosine) {
    const float rest = alpha * alpha - 1.0f;
    return rest / (AUR_PI_F * logf(alpha * alpha) * (1.0f + rest * cosine * cosine));
}

static aur_vector draw_coat_normal(float alpha, float u, float v) {
    const float squared = alpha * alpha;
    return aur_direction_at(sqrtf(fmaxf((1.0f - powf(squared, 1.0f - v)) / (1.0f - squared), 0.0f)), u);
}

/* Adds the clearcoat; returns the pdf with which it samples `light`. */
static float add_coat(const principled_terms *at, const aur_facet *facet, aur_vector view, aur_vector light,
                      aur_vector *sum) {
    static const aur_microfacet masking = {
        .distribution = AUR_MICROFACET_GGX, .alpha_u = 0.25f, .alpha_v = 0.25f};
    const float density = coat_density(at->coat_alpha, facet->normal.z);
    const float fresnel = aur_schlick((aur_vector){0.04f, 0.04f, 0.04f}, facet->view, at->eta).x;
    const float value = at->coat * fresnel * density * light.z *
                        aur_microfacet_masking(&masking, view, facet->normal) *
                        aur_microfacet_masking(&masking, light, facet->normal);
    *sum = aur_vector_add(*sum, (aur_vector){value, value, value});
    return density * facet->normal.z * facet->jacobian;
}

/* --- queries */

static aur_vector value_of(const principled_terms *at, aur_bsdf_part part, aur_vector view, aur_vector light,
                           float *pdf) {
    aur_facet facet;
    *pdf = 0.0f;
    const bool mirrored = view.z * light.z > 0.0f;
    if (((!at->front || !mirrored) && !(at->glass > 0.0f)) || !aur_facet_find(at->eta, view, light, &facet))
        return (aur_vector){0};
    const float mirror = probability_of_mirror(at, facet.mirrored);
    const float through = at->glass * (1.0f - facet.mirrored) / (facet.ratio * facet.ratio);
    const aur_vector base = at->burley.base;
    aur_vector sum = aur_vector_scale(
        mirrored ? reflectance(at, facet.view, facet.mirrored)
                 : aur_vector_scale((aur_vector){sqrtf(base.x), sqrtf(base.y), sqrtf(base.z)}, through),
        aur_facet_value(&at->facets, view, light, &facet));
    *pdf = (1.0f - at->diffuse_probability - at->coat_probability) * (mirrored ? mirror : 1.0f - mirror) *
           aur_facet_pdf(&at->facets, view, &facet);
    if (!at->front || !mirrored)
        return sum;
    if (at->coat > 0.0f)
        *pdf += at->coat_probability * add_coat(at, &facet, view, light, &sum);
    *pdf += at->diffuse_probability * light.z / AUR_PI_F;
    sum = aur_vector_add(sum, aur_burley_rest(&at->burley, at->base, 1.0f - at->metallic, view, light));
    if (part == AUR_BSDF_SAMPLED_LOBES)
        return sum;
    const float lambert = at->base * (1.0f - at->burley.flatness) * aur_burley_edge(NULL, view.z) *
                          aur_burley_edge(NULL, light.z) * light.z / AUR_PI_F;
    return aur_vector_add_scaled(sum, lambert, base);
}

static aur_vector evaluate(const aur_bsdf *bsdf, aur_bsdf_part part, aur_bsdf_point point, aur_vector view,
                           aur_vector light, float *pdf) {
    const principled_terms at = terms_at(bsdf->data, part, point, view);
    return value_of(&at, part, view, light, pdf);
}

/* False: no direction. */
static bool draw_direction(const principled_terms *at, aur_vector view, const float u[3], aur_vector *light) {
    if (u[0] < at->diffuse_probability) {
        *light = aur_sample_cosine(u[1], u[2]);
        return true;
    }
    float rest = u[0] - at->diffuse_probability;
    if (rest < at->coat_probability) {
        const aur_vector normal = draw_coat_normal(at->coat_alpha, u[1], u[2]);
        *light = aur_facet_ways_of(at->eta, view, normal).mirrored;
        return light->z > 0.0f && aur_vector_dot(view, normal) > 0.0f;
    }
    rest = (rest - at->coat_probability) / (1.0f - at->diffuse_probability - at->coat_probability);
    const aur_vector normal = aur_microfacet_sample(&at->facets, aur_upright(view), u[1], u[2]);
    const aur_facet_ways ways = aur_facet_ways_of(at->eta, view, normal);
    const bool mirrored = rest < probability_of_mirror(at, ways.reflectance);
    *light = aur_vector_normalize(mirrored ? ways.mirrored : ways.refracted);
    return (light->z * view.z > 0.0f) == mirrored;
}

static bool sample(const aur_bsdf *bsdf, aur_bsdf_part part, aur_bsdf_point point, aur_vector view,
                   const float u[3], aur_bsdf_sample *drawn) {
    const principled_terms at = terms_at(bsdf->data, part, point, view);
    aur_vector light;
    if (view.z == 0.0f || (!at.front && !(at.glass > 0.0f)) || !draw_direction(&at, view, u, &light))
        return false;
    float pdf;
    const aur_vector value = value_of(&at, part, view, light, &pdf);
    const float ior = at.front ? at.eta : 1.0f / at.eta;
    *drawn = (aur_bsdf_sample){.light = light,
                               .weight = aur_vector_scale(value, 1.0f / pdf),
                               .pdf = pdf,
                               .ior_squared = view.z * light.z > 0.0f ? 0.0f : ior * ior};
    return pdf > 0.0f;
}

/* The coefficient of the Lambertian lobe. */
static aur_vector lambert(const principled *self, aur_bsdf_point point, float cosine) {
    const aur_burley_point at = aur_burley_at(&self->burley, point);
    const float base = (1.0f - aur_color_number_at(&self->metallic, point)) * (1.0f - at.spec_trans);
    return aur_vector_scale(at.base, base * (1.0f - at.flatness) * aur_burley_edge(NULL, cosine) / AUR_PI_F);
}

static void weigh(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view, aur_bsdf_lobe *lobes) {
    const principled *const self = bsdf->data;
    if (view.z > 0.0f && self->lobe > 0)
        lobes[0].coefficient = lambert(self, point, view.z);
    if (view.z <= 0.0f && !bsdf->lobes[self->lobe].transmits)
        return;
    lobes[self->lobe].axis = aur_mirror(view);
    lobes[self->lobe].coefficient = (aur_vector){1.0f, 1.0f, 1.0f};
}

static aur_vector diffuse_albedo(const aur_bsdf *bsdf, aur_bsdf_point point, float side) {
    const principled *const self = bsdf->data;
    if (!(side > 0.0f) || self->lobe == 0)
        return (aur_vector){0};
    return aur_vector_scale(lambert(self, point, side), AUR_PI_F * AUR_BURLEY_EDGE_MEAN);
}

const aur_bsdf_descriptor aur_bsdf_principled = {
    .row = {.name = "principled",
            .summary = "base, metal, glass, sheen and coat in one",
            .source = "Burley 2012, Burley 2015",
            AUR_ROW_KEYS(keys)},
    .size = sizeof(principled),
    .create = create,
    .weigh = weigh,
    .evaluate = evaluate,
    .sample = sample,
    .diffuse_albedo = diffuse_albedo,
};
