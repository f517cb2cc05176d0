/* A vertex of a light path: the two MIS weights of a light sum to 1, roulette preserves the mean, the lobes
 * in the photon map together with the others give the light of all lobes, and particles of light have the
 * weights of the adjoint BSDF. */
#include "render/material/materials.h"

#include "render/vertex/vertex.h"

/* A light sample and the direction that finds the same point by the BSDF. */
static void weights_of_both_strategies_add_up_to_one(void **state) {
    (void)state;
    static const float pdfs[] = {1e-6f, 0.1f, 0.7f, 3.0f, 1e5f}, counts[] = {1.0f, 2.0f, 16.0f};
    for (size_t i = 0; i < 5 * 5 * 3 * 3; ++i) {
        const float light_pdf = pdfs[i % 5], bsdf_pdf = pdfs[i / 5 % 5];
        const aur_vertex_samples samples = {counts[i / 25 % 3], counts[i / 75]};
        const aur_light_sample light = {.pdf = light_pdf};
        const aur_bounce bounce = {.pdf = samples.directions * bsdf_pdf, .light_samples = samples.lights};
        const float sum = aur_light_weight(&light, samples, bsdf_pdf) + aur_bounce_weight(&bounce, light_pdf);
        assert_true(fabsf(sum - 1.0f) < 1e-6f);
    }
    const aur_light_sample point = {.pdf = 1.0f, .delta = true};
    const aur_bounce mirror = {.specular_bounce = true};
    assert_true(aur_light_weight(&point, AUR_VERTEX_ONE_EACH, 2.0f) == 1.0f);
    assert_true(aur_bounce_weight(&mirror, 2.0f) == 1.0f);
}

/* Over evenly spaced numbers the mean of beta changes by the last of them at most. */
static void roulette_preserves_the_mean(void **state) {
    (void)state;
    enum { NUMBERS = 1 << 16 };
    for (float size = 0.05f; size < 3.0f; size *= 1.7f) {
        const aur_vector before = {0.5f * size, size, 0.1f * size};
        double sum = 0.0;
        size_t alive = 0;
        for (size_t i = 0; i < NUMBERS; ++i) {
            aur_vector beta = before;
            if (!aur_vertex_survives(aur_survival(beta), ((float)i + 0.5f) / NUMBERS, &beta))
                continue;
            sum += (double)beta.x / NUMBERS;
            ++alive;
        }
        assert_true(alive < NUMBERS); /* any path ends */
        assert_true(fabs(sum / (double)before.x - 1.0) < 2.0 / NUMBERS / (double)aur_survival(before));
    }
}

typedef struct moments {
    double sum[2], squares[2];
} moments;

/* Of weight, and weight times a function of direction, over directions of the lobes. */
static moments draw(const aur_shading *shading, aur_vertex_lobes lobes, size_t count, uint64_t hash) {
    moments found = {{0.0}, {0.0}};
    for (size_t i = 0; i < count; ++i) {
        float u[3];
        aur_bsdf_sample sample;
        aur_draw_units(&hash, u);
        if (!aur_vertex_direction(shading, lobes, u, &sample))
            continue;
        const double value = (double)(sample.weight.x + sample.weight.y + sample.weight.z);
        const double values[2] = {value, value * (double)(1.0f + sample.light.x) * (double)sample.light.z};
        for (size_t k = 0; k < 2; ++k) {
            found.sum[k] += values[k] / (double)count;
            found.squares[k] += values[k] * values[k] / (double)count;
        }
    }
    return found;
}

static aur_surface surface_of(const aur_bsdf *bsdf) {
    const aur_vector z = {0.0f, 0.0f, 1.0f};
    return (aur_surface){.geometric_normal = z,
                         .frame = {{1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}, z},
                         .texture = {.u = 0.3f, .v = 0.6f, .tangents = {1.0f, 0.2f, 1.5f}},
                         .bsdf = bsdf,
                         .emitter = AUR_NO_EMITTER};
}

/* For every material. A deviate beyond 6 has a probability of 2e-9 each; the samples are fixed. */
static void lobes_with_and_without_a_map_are_all(void **state) {
    (void)state;
    enum { DRAWS = 20000 };
    for (size_t m = 0; m < MATERIAL_COUNT; ++m) {
        material built = make_material(&material_rows[m]);
        const aur_surface surface = surface_of(built.bsdf);
        for (size_t v = 0; v < 2; ++v) {
            const aur_vector wo = aur_vector_normalize((aur_vector){0.3f, -0.5f, v == 0 ? 0.6f : -0.9f});
            const aur_shading shading = aur_shading_at(&surface, wo);
            const moments all = draw(&shading, AUR_VERTEX_ALL, DRAWS, 2 * m + v);
            const moments mapped = draw(&shading, AUR_VERTEX_MAPPED, DRAWS, ~(2 * m + v));
            const moments others = draw(&shading, AUR_VERTEX_UNMAPPED, DRAWS, (2 * m + v) << 20);
            for (size_t k = 0; k < 2; ++k) {
                const double off = mapped.sum[k] + others.sum[k] - all.sum[k];
                const double variance =
                    (mapped.squares[k] - mapped.sum[k] * mapped.sum[k] + others.squares[k] -
                     others.sum[k] * others.sum[k] + all.squares[k] - all.sum[k] * all.sum[k]) /
                    DRAWS;
                if (fabs(off) > 6.0 * sqrt(variance) + 1e-5)
                    fail_msg("%s, view %zu: %g + %g is not %g", material_rows[m].text, v, mapped.sum[k],
                             others.sum[k], all.sum[k]);
            }
        }
        drop_material(&built);
    }
}

/* The density that weighs a light sample is the one with which the direction is drawn. */
static void directions_have_the_density_of_evaluation(void **state) {
    (void)state;
    static const aur_vertex_lobes lobes[] = {AUR_VERTEX_ALL, AUR_VERTEX_MAPPED, AUR_VERTEX_UNMAPPED};
    for (size_t m = 0; m < MATERIAL_COUNT; ++m) {
        if ((material_rows[m].flags & NARROW) != 0)
            continue;
        material built = make_material(&material_rows[m]);
        const aur_surface surface = surface_of(built.bsdf);
        const aur_shading shading =
            aur_shading_at(&surface, aur_vector_normalize((aur_vector){0.3f, -0.5f, 0.6f}));
        uint64_t hash = m;
        for (size_t i = 0; i < 300; ++i) {
            float u[3], pdf;
            aur_bsdf_sample sample;
            aur_draw_units(&hash, u);
            if (!aur_vertex_direction(&shading, lobes[i % 3], u, &sample) || sample.specular)
                continue;
            const aur_vector value = aur_vertex_evaluate(&shading, lobes[i % 3], sample.light, &pdf);
            if (fabsf(pdf - sample.pdf) > 1e-3f * sample.pdf && !aur_vector_is_zero(value))
                fail_msg("%s, lobes %zu: %g is not %g", material_rows[m].text, i % 3, (double)pdf,
                         (double)sample.pdf);
        }
        drop_material(&built);
    }
}

/* Closed forms. Diffuse with albedo a, drawn by the cosine to the shading normal: a times that cosine of
 * incidence over the other normal's, times the same of the other normal after scattering; a mirror has equal
 * cosines to the shading normal on both sides. */
static void particles_have_adjoint_weights(void **state) {
    (void)state;
    static const char *const texts[] = {"diffuse:reflectance=0.5", "conductor"};
    for (size_t m = 0; m < 2; ++m) {
        aur_bsdf *const bsdf = make_bsdf(texts[m], NULL);
        aur_surface surface = surface_of(bsdf);
        surface.geometric_normal = aur_vector_normalize((aur_vector){0.3f, -0.2f, 1.0f});
        const aur_vector shading_normal = surface.frame.z, geometric_normal = surface.geometric_normal;
        uint64_t hash = m;
        for (size_t i = 0; i < 200; ++i) {
            const float slope = i < 100 ? 0.5f : 0.002f; /* of incidence: the second below `least` */
            const aur_vector in = aur_vector_normalize((aur_vector){0.4f, -0.8f, slope});
            const aur_shading shading = aur_shading_at(&surface, in);
            float u[3];
            aur_bsdf_sample sample;
            aur_draw_units(&hash, u);
            if (!aur_shading_sample(&shading, u, &sample))
                continue;
            const double before = (double)aur_vector_dot(geometric_normal, in),
                         after = (double)aur_vector_dot(geometric_normal, sample.light);
            const double ratio = m == 0 ? (double)in.z / (double)sample.light.z : 1.0;
            const aur_vector geometric = aur_vertex_adjoint(&shading, &sample, in, geometric_normal, 0.0f);
            assert_relative((double)geometric.x, (double)sample.weight.x * ratio * after / before, 1e-4);
            const aur_vector shaded = aur_vertex_adjoint(&shading, &sample, in, shading_normal, 0.01f);
            const double bounded = m == 0 ? fmin(1.0, (double)in.z / 0.01) : 1.0;
            assert_relative((double)shaded.x, (double)sample.weight.x * bounded, 1e-4);
        }
        aur_bsdf_destroy(bsdf);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(weights_of_both_strategies_add_up_to_one),
        cmocka_unit_test(roulette_preserves_the_mean),
        cmocka_unit_test(lobes_with_and_without_a_map_are_all),
        cmocka_unit_test(directions_have_the_density_of_evaluation),
        cmocka_unit_test(particles_have_adjoint_weights),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
