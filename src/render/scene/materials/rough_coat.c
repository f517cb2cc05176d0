#include "render/scene/materials/microfacet.h"

#include "points/base/gauss.h"
#include "render/scene/materials/fresnel.h"

enum { SIZE = AUR_ROUGH_COAT_SIZE, MOST_SIDE = 64, MOST_NODES = 128 };

/* Reflectance and transmittance of a rough boundary. Single scattering only: their sum is below 1, the more
 * so the rougher the surface, as in Mitsuba 3. */
typedef struct rough_shares {
    double mirrored, through;
} rough_shares;

/* Adds the contribution of a visible facet, with a weight. */
static void add_facet(const aur_microfacet *microfacet, float ior, aur_vector view, aur_vector normal,
                      double weight, rough_shares *sum) {
    const float along = aur_vector_dot(view, normal);
    if (!(along > 0.0f))
        return;
    float refracted;
    weight *= (double)aur_microfacet_weight(microfacet, view, normal);
    const float fresnel = aur_fresnel_dielectric(along, ior, &refracted);
    const aur_vector up = aur_vector_add_scaled(aur_vector_scale(view, -1.0f), 2.0f * along, normal);
    const aur_vector down =
        aur_vector_add_scaled(aur_vector_scale(view, -1.0f / ior), along / ior + refracted, normal);
    if (up.z > 0.0f)
        sum->mirrored += weight * (double)(fresnel * aur_microfacet_fitted_masking(microfacet, up, normal));
    if (down.z < 0.0f)
        sum->through +=
            weight * (double)((1.0f - fresnel) * aur_microfacet_fitted_masking(microfacet, down, normal));
}

static aur_vector view_at(float cosine, float least) {
    const float z = fmaxf(cosine, least);
    return (aur_vector){sqrtf(1.0f - z * z), 0.0f, z};
}

static rough_shares shares_at(const aur_microfacet *microfacet, float ior, float cosine) {
    /* From the denser side, total reflection makes the integrand discontinuous. */
    const size_t side = ior > 1.0f ? 32 : MOST_SIDE;
    const aur_vector view = view_at(cosine, 1e-4f);
    float middles[MOST_SIDE];
    for (size_t i = 0; i < side; ++i)
        middles[i] = ((float)i + 0.5f) / (float)side;
    rough_shares sum = {0};
    aur_vector normals[MOST_SIDE];
    for (size_t i = 0; i < side; ++i) {
        aur_microfacet_sample_row(microfacet, view, middles[i], side, middles, normals);
        for (size_t j = 0; j < side; ++j)
            add_facet(microfacet, ior, view, normals[j], 1.0, &sum);
    }
    const double count = (double)(side * side);
    return (rough_shares){sum.mirrored / count, sum.through / count};
}

aur_rough_coat aur_rough_coat_of(const aur_microfacet *microfacet, float ior) {
    aur_rough_coat coat;
    double inner = 0.0, outer = 0.0;
    for (size_t i = 0; i < SIZE; ++i) {
        const float cosine = (float)i / (SIZE - 1);
        coat.transmittance[i] = (float)shares_at(microfacet, ior, cosine).through;
        const double weight = (i == 0 || i == SIZE - 1 ? 1.0 : 2.0) * (double)cosine / (SIZE - 1);
        inner += weight * shares_at(microfacet, 1.0f / ior, cosine).mirrored;
        outer += weight * (double)coat.transmittance[i];
    }
    coat.inner_reflectance = (float)inner;
    coat.outer_transmittance = (float)outer;
    return coat;
}

/* --- Mitsuba 3's quadrature */

/* A point of the unit disk (Shirley and Chiu 1997), squeezed towards the visible half, is a GGX facet of
 * roughness 1 (Heitz 2018). Returns its slopes along the view's azimuth and across. */
static void ggx_slopes(float cosine, float u, float v, float slopes[2]) {
    const float x = 2.0f * u - 1.0f, y = 2.0f * v - 1.0f;
    const bool upright = fabsf(x) < fabsf(y);
    const float radius = upright ? y : x;
    const float eighth = radius != 0.0f ? 0.25f * AUR_PI_F * (upright ? x : y) / radius : 0.0f;
    const float angle = upright ? 0.5f * AUR_PI_F - eighth : eighth;
    const float across = radius * cosf(angle);
    const float half = 0.5f * (1.0f + cosine);
    const float up = (1.0f - half) * sqrtf(fmaxf(0.0f, 1.0f - across * across)) + half * radius * sinf(angle);
    const float high = sqrtf(fmaxf(0.0f, 1.0f - across * across - up * up));
    const float sine = sqrtf(fmaxf(0.0f, 1.0f - cosine * cosine));
    const float scale = 1.0f / (sine * up + cosine * high);
    slopes[0] = (cosine * up - sine * high) * scale;
    slopes[1] = across * scale;
}

/* Beckmann facets are sampled by inverting their distribution, as in microfacet.c. */
static void draw_row(const aur_microfacet *microfacet, aur_vector view, float u, size_t count, const float *v,
                     aur_vector *normals) {
    if (microfacet->distribution == AUR_MICROFACET_BECKMANN) {
        aur_microfacet_sample_row(microfacet, view, u, count, v, normals);
        return;
    }
    const float alpha = microfacet->alpha_u;
    const aur_vector stretched = aur_vector_normalize((aur_vector){alpha * view.x, alpha * view.y, view.z});
    for (size_t i = 0; i < count; ++i) {
        float slopes[2];
        ggx_slopes(stretched.z, u, v[i], slopes);
        normals[i] = aur_vector_normalize((aur_vector){-alpha * slopes[0], -alpha * slopes[1], 1.0f});
    }
}

static rough_shares sum_at(const aur_microfacet *microfacet, float ior, float cosine, size_t count,
                           const double *nodes, const double *weights) {
    const aur_vector view = view_at(cosine, 1e-6f);
    float cosines[MOST_NODES];
    for (size_t i = 0; i < count; ++i)
        cosines[i] = (float)(0.5 * nodes[i] + 0.5);
    rough_shares sum = {0};
    aur_vector normals[MOST_NODES];
    for (size_t i = 0; i < count; ++i) {
        draw_row(microfacet, view, cosines[i], count, cosines, normals);
        for (size_t j = 0; j < count; ++j)
            add_facet(microfacet, ior, view, normals[j], 0.25 * weights[i] * weights[j], &sum);
    }
    return sum;
}

aur_rough_coat aur_rough_coat_of_mitsuba(const aur_microfacet *microfacet, float ior) {
    const size_t outside = ior > 1.0f ? 32 : MOST_NODES, inside = ior > 1.0f ? MOST_NODES : 32;
    double nodes[2][MOST_NODES], weights[2][MOST_NODES];
    aur_gauss_legendre(outside, nodes[0], weights[0]);
    aur_gauss_legendre(inside, nodes[1], weights[1]);
    aur_rough_coat coat;
    double inner = 0.0, outer = 0.0;
    for (size_t i = 0; i < SIZE; ++i) {
        const float cosine = (float)i / (SIZE - 1);
        coat.transmittance[i] = (float)sum_at(microfacet, ior, cosine, outside, nodes[0], weights[0]).through;
        outer += (i == 0 || i == SIZE - 1 ? 1.0 : 2.0) * (double)cosine / (SIZE - 1) *
                 (double)coat.transmittance[i];
        if (i > 0)
            inner += 2.0 / SIZE * (double)cosine *
                     sum_at(microfacet, 1.0f / ior, cosine, inside, nodes[1], weights[1]).mirrored;
    }
    coat.inner_reflectance = (float)inner;
    coat.outer_transmittance = (float)outer;
    return coat;
}

float aur_rough_coat_transmittance(const aur_rough_coat *coat, float cosine) {
    const float position = fminf(fmaxf(cosine, 0.0f), 1.0f) * (SIZE - 1);
    const size_t index = position < SIZE - 1 ? (size_t)position : SIZE - 2;
    const float share = position - (float)index;
    return (1.0f - share) * coat->transmittance[index] + share * coat->transmittance[index + 1];
}
