#include "render/scene/materials/microfacet.h"

#include <math.h>
#include <stddef.h>

#include "render/scene/materials/fresnel.h"
#include "render/scene/materials/sampling.h"

static bool is_given(const aur_color *color) {
    return color->texture != NULL || color->constant.x != 0.0f;
}

bool aur_roughness_complete(aur_roughness *roughness) {
    aur_color *const u = &roughness->alpha_u, *const v = &roughness->alpha_v;
    *u = is_given(u) ? *u : roughness->alpha;
    *v = is_given(v) ? *v : roughness->alpha;
    roughness->varies = u->texture != NULL || v->texture != NULL;
    roughness->constant.alpha_u =
        aur_color_number_at(&(aur_color){.constant = u->constant}, (aur_bsdf_point){.u = 0.0f});
    roughness->constant.alpha_v =
        aur_color_number_at(&(aur_color){.constant = v->constant}, (aur_bsdf_point){.u = 0.0f});
    return u->texture != v->texture || roughness->constant.alpha_u != roughness->constant.alpha_v;
}

static bool is_phong(const aur_microfacet *microfacet) {
    return microfacet->distribution >= AUR_MICROFACET_PHONG;
}

static float phong_exponent(float alpha) {
    return aur_larger(2.0f / (alpha * alpha) - 2.0f, 0.0f);
}

/* Ashikhmin and Shirley 2000, normalised for facets. */
static float phong_density(const aur_microfacet *microfacet, aur_vector normal) {
    const float a = phong_exponent(microfacet->alpha_u), b = phong_exponent(microfacet->alpha_v);
    const float x2 = normal.x * normal.x, y2 = normal.y * normal.y;
    const float power = x2 + y2 > 0.0f ? (a * x2 + b * y2) / (x2 + y2) : 0.0f;
    return sqrtf((a + 2.0f) * (b + 2.0f)) * powf(normal.z, power) / (2.0f * AUR_PI_F);
}

float aur_microfacet_density(const aur_microfacet *microfacet, aur_vector normal) {
    if (normal.z <= 0.0f)
        return 0.0f;
    if (is_phong(microfacet))
        return phong_density(microfacet, normal);
    const float x = normal.x / microfacet->alpha_u, y = normal.y / microfacet->alpha_v;
    const float area = AUR_PI_F * microfacet->alpha_u * microfacet->alpha_v;
    const float z2 = normal.z * normal.z;
    if (microfacet->distribution == AUR_MICROFACET_BECKMANN)
        return expf(-(x * x + y * y) / z2) / (area * z2 * z2);
    const float sum = x * x + y * y + z2;
    return 1.0f / (area * sum * sum);
}

/* Smith's Lambda, exact for GGX and Beckmann facets, except 0 where 1 + Lambda rounds to 1. */
static float lambda(const aur_microfacet *microfacet, aur_vector direction) {
    const float x = direction.x * microfacet->alpha_u, y = direction.y * microfacet->alpha_v;
    const float tangent2 = (x * x + y * y) / (direction.z * direction.z); /* (alpha tan)^2 */
    if (!(tangent2 > 0.0f))
        return 0.0f;
    if (microfacet->distribution == AUR_MICROFACET_GGX)
        return 0.5f * (sqrtf(1.0f + tangent2) - 1.0f);
    /* Lambda < exp(-a^2) / (4 sqrt(pi) a^3) for a = 1 / tangent: below 1.6e-8 from a = 3.5 on, and 2^-25 is
     * 3.0e-8. Most directions on smooth surfaces are in this range. */
    if (tangent2 < 1.0f / (3.5f * 3.5f))
        return 0.0f;
    const float a = 1.0f / sqrtf(tangent2);
    /* Half of exp(-a^2) / (sqrt(pi) a) - erfc(a). erfc is by Abramowitz and Stegun 7.1.26, to 1.5e-7, with
     * the same power as factor: the error is two units in the last place of 1 + Lambda. */
    const float t = 1.0f / (1.0f + 0.3275911f * a);
    float p = 1.061405429f;
    p = p * t - 1.453152027f;
    p = p * t + 1.421413741f;
    p = p * t - 0.284496736f;
    p = p * t + 0.254829592f;
    return aur_larger(0.5f * expf(-a * a) * (0.56418958f / a - t * p), 0.0f);
}

float aur_microfacet_masking(const aur_microfacet *microfacet, aur_vector direction, aur_vector normal) {
    if (aur_vector_dot(direction, normal) * direction.z <= 0.0f)
        return 0.0f;
    return 1.0f / (1.0f + lambda(microfacet, direction));
}

float aur_microfacet_fitted_masking(const aur_microfacet *microfacet, aur_vector direction,
                                    aur_vector normal) {
    if (!microfacet->fitted || microfacet->distribution != AUR_MICROFACET_BECKMANN)
        return aur_microfacet_masking(microfacet, direction, normal);
    if (aur_vector_dot(direction, normal) * direction.z <= 0.0f)
        return 0.0f;
    const float x = direction.x * microfacet->alpha_u, y = direction.y * microfacet->alpha_v;
    const float tangent2 = (x * x + y * y) / (direction.z * direction.z);
    if (!(tangent2 > 1.0f / (1.6f * 1.6f)))
        return 1.0f;
    const float a = 1.0f / sqrtf(tangent2);
    return (3.535f * a + 2.181f * a * a) / (1.0f + 2.276f * a + 2.577f * a * a);
}

static float visible_density(const aur_microfacet *microfacet, aur_vector view, aur_vector normal) {
    return aur_microfacet_density(microfacet, normal) * aur_microfacet_masking(microfacet, view, normal) *
           aur_larger(aur_vector_dot(view, normal), 0.0f) / view.z;
}

/* The facets whose visible normals are sampled. GGX has the longest tail, so weights of Phong facets are
 * bounded. */
static aur_microfacet sampled_facets(const aur_microfacet *microfacet) {
    aur_microfacet facets = *microfacet;
    if (is_phong(microfacet))
        facets.distribution = AUR_MICROFACET_GGX;
    return facets;
}

float aur_microfacet_pdf(const aur_microfacet *microfacet, aur_vector view, aur_vector normal) {
    const aur_microfacet facets = sampled_facets(microfacet);
    return visible_density(&facets, view, normal);
}

float aur_microfacet_weight(const aur_microfacet *microfacet, aur_vector view, aur_vector normal) {
    if (!is_phong(microfacet))
        return 1.0f;
    const float pdf = aur_microfacet_pdf(microfacet, view, normal);
    return pdf > 0.0f ? visible_density(microfacet, view, normal) / pdf : 0.0f;
}

/* Visible normals of the hemisphere: half vectors of a spherical cap (Dupuy and Benyoub 2023). */
static aur_vector sample_ggx(aur_vector view, float u, float v) {
    const float z = (1.0f - v) * (1.0f + view.z) - view.z;
    return aur_vector_add(aur_direction_at(z, u), view);
}

/* The slope along the view's azimuth for roughness 1 (Heitz and d'Eon 2014): the root x of C(x) = u C(cot)
 * with C(x) = sqrt(pi) cos (1 + erf x) + sin exp(-x^2), by Halley's method in a shrinking bracket.
 * Convergence is cubic, so after a step of 2e-3 the error is below float precision. */
static float sample_visible_slope(float cosine, float sine, float u) {
    const double root_pi = 1.7724538509055160;
    const double c = cosine, s = sine;
    double high = 6.0;
    if (s > 1e-7 && c < 6.0 * s)
        high = c / s;
    double low = -6.0;
    /* Beyond 6 erf is 1, and exp(-36) nothing. */
    const double whole =
        high < 6.0 ? root_pi * c * (1.0 + erf(high)) + s * exp(-high * high) : 2.0 * root_pi * c;
    const double target = (double)u * whole;
    double x = (double)aur_inverse_erf(aur_smaller(aur_larger(2.0f * u - 1.0f, -0.99999f), 0.99999f));
    x = x < high ? x : high;
    for (size_t i = 0; i < 40; ++i) {
        const double gauss = exp(-x * x);
        const double value = root_pi * c * (1.0 + erf(x)) + s * gauss - target;
        if (value > 0.0)
            high = x;
        else
            low = x;
        const double rise = c - x * s;
        const double newton = value / (2.0 * rise * gauss);
        /* C'' / C' = -2 x - sin / rise */
        const double bend = newton * (x + 0.5 * s / rise);
        double next = x - newton / (1.0 + bend);
        const bool inside = next > low && next < high;
        if (!inside)
            next = 0.5 * (low + high);
        if (inside && fabs(newton) < 2e-3 && fabs(bend) < 2e-3)
            return (float)next;
        x = next;
    }
    return (float)x;
}

static float azimuthal_sine(aur_vector view) {
    return sqrtf(view.x * view.x + view.y * view.y);
}

static aur_vector sample_beckmann(aur_vector view, float along, float v) {
    const float sine = azimuthal_sine(view);
    const float across = aur_inverse_erf(aur_smaller(aur_larger(2.0f * v - 1.0f, -0.999999f), 0.999999f));
    const float x = sine > 0.0f ? view.x / sine : 1.0f;
    const float y = sine > 0.0f ? view.y / sine : 0.0f;
    return (aur_vector){-(x * along - y * across), -(y * along + x * across), 1.0f};
}

void aur_microfacet_sample_row(const aur_microfacet *microfacet, aur_vector view, float u, size_t count,
                               const float *v, aur_vector *normals) {
    const float a = microfacet->alpha_u, b = microfacet->alpha_v;
    const bool beckmann = microfacet->distribution == AUR_MICROFACET_BECKMANN;
    /* Stretched, every ellipsoid is a hemisphere. */
    const aur_vector stretched = aur_vector_normalize((aur_vector){view.x * a, view.y * b, view.z});
    const float along = beckmann ? sample_visible_slope(stretched.z, azimuthal_sine(stretched), u) : 0.0f;
    for (size_t i = 0; i < count; ++i) {
        const aur_vector normal =
            beckmann ? sample_beckmann(stretched, along, v[i]) : sample_ggx(stretched, u, v[i]);
        normals[i] =
            aur_vector_normalize((aur_vector){normal.x * a, normal.y * b, aur_larger(normal.z, 1e-7f)});
    }
}

aur_vector aur_microfacet_sample(const aur_microfacet *microfacet, aur_vector view, float u, float v) {
    aur_vector normal;
    aur_microfacet_sample_row(microfacet, view, u, 1, &v, &normal);
    return normal;
}

float aur_microfacet_mirror(const aur_microfacet *microfacet, aur_vector view, aur_vector light,
                            float *cosine, float *pdf) {
    *pdf = 0.0f;
    if (view.z <= 0.0f || light.z <= 0.0f)
        return 0.0f;
    const aur_vector normal = aur_vector_normalize(aur_vector_add(view, light));
    *cosine = aur_vector_dot(view, normal);
    const float density = aur_microfacet_density(microfacet, normal);
    const float seen = density * aur_microfacet_masking(microfacet, view, normal);
    *pdf = is_phong(microfacet) ? aur_microfacet_pdf(microfacet, view, normal) / (4.0f * *cosine)
                                : seen * aur_larger(*cosine, 0.0f) / view.z / (4.0f * *cosine);
    if (microfacet->fitted)
        return density * aur_microfacet_fitted_masking(microfacet, view, normal) *
               aur_microfacet_fitted_masking(microfacet, light, normal) / (4.0f * view.z);
    return seen * aur_microfacet_masking(microfacet, light, normal) / (4.0f * view.z);
}

aur_vector aur_microfacet_draw_mirrored(const aur_microfacet *microfacet, aur_vector view, float u, float v,
                                        aur_vector *normal) {
    *normal = aur_microfacet_sample(microfacet, view, u, v);
    return aur_vector_add_scaled(aur_vector_scale(view, -1.0f), 2.0f * aur_vector_dot(view, *normal),
                                 *normal);
}

bool aur_facet_find(float ior, aur_vector view, aur_vector light, aur_facet *facet) {
    if (view.z == 0.0f || light.z == 0.0f)
        return false;
    const bool mirror = view.z * light.z > 0.0f;
    facet->ratio = mirror ? 1.0f : view.z > 0.0f ? ior : 1.0f / ior;
    facet->normal = aur_upright(aur_vector_normalize(aur_vector_add_scaled(view, facet->ratio, light)));
    facet->view = aur_vector_dot(view, facet->normal);
    facet->light = aur_vector_dot(light, facet->normal);
    /* Invalid: back-facing facets, or refraction with both directions on one side. */
    if (facet->view * view.z <= 0.0f || facet->light * light.z <= 0.0f)
        return false;
    float refracted;
    facet->mirrored = aur_fresnel_dielectric(facet->view, ior, &refracted);
    const float sum = facet->view + facet->ratio * facet->light;
    facet->jacobian = mirror ? 1.0f / (4.0f * fabsf(facet->light))
                             : facet->ratio * facet->ratio * fabsf(facet->light) / (sum * sum);
    return true;
}

float aur_facet_value(const aur_microfacet *microfacet, aur_vector view, aur_vector light,
                      const aur_facet *facet) {
    return aur_microfacet_density(microfacet, facet->normal) *
           aur_microfacet_masking(microfacet, view, facet->normal) *
           aur_microfacet_masking(microfacet, light, facet->normal) * fabsf(facet->view / view.z) *
           facet->jacobian;
}

float aur_facet_pdf(const aur_microfacet *microfacet, aur_vector view, const aur_facet *facet) {
    return aur_microfacet_pdf(microfacet, aur_upright(view), facet->normal) * facet->jacobian;
}

aur_facet_ways aur_facet_ways_of(float ior, aur_vector view, aur_vector normal) {
    const float cosine = aur_vector_dot(view, normal);
    float refracted;
    const float reflectance = aur_fresnel_dielectric(cosine, ior, &refracted);
    const float ratio = cosine > 0.0f ? 1.0f / ior : ior;
    return (aur_facet_ways){
        .mirrored = aur_vector_add_scaled(aur_vector_scale(view, -1.0f), 2.0f * cosine, normal),
        .refracted =
            aur_vector_add_scaled(aur_vector_scale(view, -ratio), ratio * cosine + refracted, normal),
        .reflectance = reflectance};
}

enum { TERMS = 9 };

static float polynomial(const float *coefficients, float x) {
    float sum = coefficients[0];
    for (size_t i = 1; i < TERMS; ++i)
        sum = coefficients[i] + sum * x;
    return sum;
}

float aur_inverse_erf(float y) {
    static const float centre[TERMS] = {2.81022636e-08f,  3.43273939e-07f, -3.5233877e-06f,
                                        -4.39150654e-06f, 0.00021858087f,  -0.00125372503f,
                                        -0.00417768164f,  0.246640727f,    1.50140941f};
    static const float tail[TERMS] = {-0.000200214257f, 0.000100950558f, 0.00134934322f,
                                      -0.00367342844f,  0.00573950773f,  -0.0076224613f,
                                      0.00943887047f,   1.00167406f,     2.83297682f};
    const float w = -logf((1.0f - y) * (1.0f + y));
    return y * (w < 5.0f ? polynomial(centre, w - 2.5f) : polynomial(tail, sqrtf(w) - 3.0f));
}
