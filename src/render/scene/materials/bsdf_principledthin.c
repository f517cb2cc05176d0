/* A thin sheet such as a leaf, paper or a window pane (Burley 2015), by the formulas of Mitsuba 3. Both sides
 * are equal, and light is not refracted: transmission is facet reflection mirrored to the other side. */
#include "render/scene/materials/burley.h"
#include "render/scene/materials/fresnel.h"

typedef struct thin {
    aur_burley burley;
    aur_color eta, diffuse_through;
    size_t lobe; /* index of the sampled lobe, after the diffuse one if present */
} thin;

static const aur_key keys[] = {
    AUR_BURLEY_KEYS(thin),
    {AUR_KEY_OF_COLOR(thin, "eta", eta, 100.0, "1.5", "index of refraction inside over outside"),
     .minimum = 0.1},
    {AUR_KEY_OF_COLOR(thin, "diff_trans", diffuse_through, 2.0, "0",
                      "twice the share of transmitted diffuse light")},
};

static aur_result create(aur_parameters *parameters, aur_bsdf *bsdf, aur_error *error) {
    (void)parameters;
    (void)error;
    thin *const self = bsdf->data;
    bsdf->anisotropic = aur_burley_is_anisotropic(&self->burley);
    const bool dull = aur_burley_is_always(&self->burley.spec_trans, 0.0f);
    const aur_bsdf_lobe diffuse = aur_burley_lobe(AUR_SIDES_BOTH);
    const aur_bsdf_lobe rest = {.shape = AUR_LOBE_SHAPE_SAMPLED,
                                .transmits = !dull || !aur_burley_is_always(&self->diffuse_through, 0.0f),
                                .sides = AUR_SIDES_BOTH};
    if (!aur_burley_is_always(&self->burley.spec_trans, 1.0f) &&
        !aur_burley_is_always(&self->diffuse_through, 2.0f))
        aur_bsdf_add_lobe(bsdf, &diffuse);
    self->lobe = aur_bsdf_add_lobe(bsdf, &rest);
    return AUR_OK;
}

/* --- parameters at a point, and sampling probabilities */

typedef struct thin_terms {
    aur_burley_point burley;
    aur_microfacet mirror,
        through; /* transmission is blurred less, depending on the index (Burley 2015, fig. 15) */
    float eta, glossy, diffuse, diffuse_through; /* energy fractions */
    float mirror_probability, through_probability, diffuse_probability, diffuse_through_probability;
} thin_terms;

static thin_terms terms_at(const thin *self, aur_bsdf_part part, aur_bsdf_point point, aur_vector view) {
    thin_terms at = {.burley = aur_burley_at(&self->burley, point),
                     .eta = aur_color_number_at(&self->eta, point),
                     .glossy = 0.0f};
    const float half = 0.5f * aur_color_number_at(&self->diffuse_through, point);
    at.glossy = at.burley.spec_trans;
    at.diffuse = (1.0f - at.glossy) * (1.0f - half);
    at.diffuse_through = (1.0f - at.glossy) * half;
    at.mirror = aur_burley_facets(&at.burley, at.burley.roughness);
    at.through = aur_burley_facets(&at.burley, (0.65f * at.eta - 0.35f) * at.burley.roughness);
    const float color = aur_luminance(at.burley.base);
    at.mirror_probability = at.through_probability = 0.5f * at.glossy;
    at.diffuse_probability = aur_burley_rest_probability(&at.burley, at.diffuse, at.diffuse, fabsf(view.z)) +
                             (part == AUR_BSDF_WHOLE ? at.diffuse * color : 0.0f);
    at.diffuse_through_probability = at.diffuse_through * color;
    const float total = at.mirror_probability + at.through_probability + at.diffuse_probability +
                        at.diffuse_through_probability;
    const float scale = total > 0.0f ? 1.0f / total : 0.0f;
    at.mirror_probability *= scale;
    at.through_probability *= scale;
    at.diffuse_probability *= scale;
    at.diffuse_through_probability *= scale;
    return at;
}

/* Half vector of the view, above, and of the light direction, mirrored above. */
static aur_vector half_of(aur_vector view, aur_vector light) {
    light.z = fabsf(light.z);
    return aur_vector_normalize(aur_vector_add(view, light));
}

static aur_vector reflectance(const thin_terms *at, float cosine, float dielectric) {
    const float normal = (at->eta - 1.0f) / (at->eta + 1.0f),
                plain = (1.0f - at->burley.spec_tint) * dielectric;
    return aur_vector_add_scaled(
        (aur_vector){plain, plain, plain}, at->burley.spec_tint,
        aur_schlick(aur_vector_scale(at->burley.tint, normal * normal), cosine, at->eta));
}

/* Light from facets to the view, which is above; *pdf as sampled. */
static aur_vector facets(const thin_terms *at, aur_vector view, aur_vector light, float *pdf) {
    const bool mirrored = light.z > 0.0f;
    const aur_microfacet *const microfacet = mirrored ? &at->mirror : &at->through;
    const aur_vector normal = half_of(view, light);
    const float cosine = aur_vector_dot(view, normal);
    const float masking = aur_microfacet_masking(microfacet, light, normal);
    *pdf = 0.0f;
    if (!(at->glossy > 0.0f) || !(masking > 0.0f) || !(cosine > 0.0f))
        return (aur_vector){0};
    const float jacobian = 1.0f / (4.0f * cosine);
    *pdf = (mirrored ? at->mirror_probability : at->through_probability) *
           aur_microfacet_pdf(microfacet, view, normal) * jacobian;
    float refracted;
    const float dielectric = aur_fresnel_dielectric(cosine, at->eta, &refracted);
    const float value = at->glossy * aur_microfacet_density(microfacet, normal) *
                        aur_microfacet_masking(microfacet, view, normal) * masking / (4.0f * view.z);
    return aur_vector_scale(mirrored ? reflectance(at, cosine, dielectric)
                                     : aur_vector_scale(at->burley.base, 1.0f - dielectric),
                            value);
}

/* --- queries */

/* For a view from above. */
static aur_vector value_of(const thin_terms *at, aur_bsdf_part part, aur_vector view, aur_vector light,
                           float *pdf) {
    const aur_vector base = at->burley.base;
    aur_vector sum = facets(at, view, light, pdf);
    if (light.z < 0.0f) {
        *pdf -= at->diffuse_through_probability * light.z / AUR_PI_F;
        return aur_vector_add_scaled(sum, -at->diffuse_through * light.z / AUR_PI_F, base);
    }
    *pdf += at->diffuse_probability * light.z / AUR_PI_F;
    sum = aur_vector_add(sum, aur_burley_rest(&at->burley, at->diffuse, at->diffuse, view, light));
    if (part == AUR_BSDF_SAMPLED_LOBES)
        return sum;
    const float lambert = at->diffuse * (1.0f - at->burley.flatness) * aur_burley_edge(NULL, view.z) *
                          aur_burley_edge(NULL, light.z) * light.z / AUR_PI_F;
    return aur_vector_add_scaled(sum, lambert, base);
}

static aur_vector evaluate(const aur_bsdf *bsdf, aur_bsdf_part part, aur_bsdf_point point, aur_vector view,
                           aur_vector light, float *pdf) {
    *pdf = 0.0f;
    if (view.z == 0.0f || light.z == 0.0f)
        return (aur_vector){0};
    const float side = view.z < 0.0f ? -1.0f : 1.0f;
    view = aur_vector_scale(view, side);
    const thin_terms at = terms_at(bsdf->data, part, point, view);
    return value_of(&at, part, view, aur_vector_scale(light, side), pdf);
}

static bool sample(const aur_bsdf *bsdf, aur_bsdf_part part, aur_bsdf_point point, aur_vector view,
                   const float u[3], aur_bsdf_sample *drawn) {
    if (view.z == 0.0f)
        return false;
    const float side = view.z < 0.0f ? -1.0f : 1.0f;
    view = aur_vector_scale(view, side);
    const thin_terms at = terms_at(bsdf->data, part, point, view);
    const float diffuse = at.diffuse_probability + at.diffuse_through_probability;
    const bool through =
        u[0] >= at.diffuse_probability && !(u[0] >= diffuse && u[0] < diffuse + at.mirror_probability);
    aur_vector light, normal;
    if (u[0] < diffuse)
        light = aur_sample_cosine(u[1], u[2]);
    else
        light = aur_microfacet_draw_mirrored(through ? &at.through : &at.mirror, view, u[1], u[2], &normal);
    if (!(light.z > 0.0f))
        return false;
    if (through)
        light.z = -light.z;
    /* The other side of a facet cannot be seen from above. */
    if (through && u[0] >= diffuse && aur_vector_dot(light, normal) >= 0.0f)
        return false;
    float pdf;
    const aur_vector value = value_of(&at, part, view, light, &pdf);
    *drawn = (aur_bsdf_sample){
        .light = aur_vector_scale(light, side), .weight = aur_vector_scale(value, 1.0f / pdf), .pdf = pdf};
    return pdf > 0.0f;
}

/* The coefficient of the Lambertian lobe. */
static aur_vector lambert(const thin *self, aur_bsdf_point point, float cosine) {
    const aur_burley_point at = aur_burley_at(&self->burley, point);
    const float share =
        (1.0f - at.spec_trans) * (1.0f - 0.5f * aur_color_number_at(&self->diffuse_through, point));
    return aur_vector_scale(at.base, share * (1.0f - at.flatness) * aur_burley_edge(NULL, cosine) / AUR_PI_F);
}

static void weigh(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view, aur_bsdf_lobe *lobes) {
    const thin *const self = bsdf->data;
    if (self->lobe > 0) {
        lobes[0].coefficient = lambert(self, point, fabsf(view.z));
        lobes[0].axis.z = view.z < 0.0f ? -1.0f : 1.0f;
    }
    lobes[self->lobe].axis = aur_mirror(view);
    lobes[self->lobe].coefficient = (aur_vector){1.0f, 1.0f, 1.0f};
}

static aur_vector diffuse_albedo(const aur_bsdf *bsdf, aur_bsdf_point point, float side) {
    const thin *const self = bsdf->data;
    return self->lobe > 0
               ? aur_vector_scale(lambert(self, point, fabsf(side)), AUR_PI_F * AUR_BURLEY_EDGE_MEAN)
               : (aur_vector){0};
}

const aur_bsdf_descriptor aur_bsdf_principledthin = {
    .row = {.name = "principledthin",
            .summary = "a thin sheet such as a leaf, paper or a pane",
            .source = "Burley 2015",
            AUR_ROW_KEYS(keys)},
    .size = sizeof(thin),
    .create = create,
    .weigh = weigh,
    .evaluate = evaluate,
    .sample = sample,
    .diffuse_albedo = diffuse_albedo,
};
