#include "materials.h"

#include <stdio.h>
#include <string.h>

#include "mitsuba_values.h"
#include "render/scene/materials/fresnel.h"
#include "render/scene/materials/microfacet.h"
#include "render/scene/materials/sampling.h"

static const aur_bsdf_point point = {.u = 0.3f, .v = 0.6f, .tangents = {1.0f, 0.2f, 1.5f}};

static bool is_plugin(const char *text, const char *name) {
    const size_t length = strlen(name);
    return strncmp(text, name, length) == 0 && (text[length] == '\0' || text[length] == ':');
}

/* A new material needs a row here; all of these tests run over the rows. */
static void every_material_is_tested(void **state) {
    (void)state;
    for (size_t i = 0; i < aur_bsdf_table.count; ++i) {
        const char *const name = aur_bsdf_table.rows[i]->name;
        size_t m = 0;
        while (m < MATERIAL_COUNT && !is_plugin(material_rows[m].text, name))
            ++m;
        if (m == MATERIAL_COUNT)
            fail_msg("materials.h has no row of '%s'", name);
    }
}

static aur_vector value_of(const aur_bsdf *bsdf, aur_bsdf_part part, aur_vector view, aur_vector light) {
    float pdf;
    return aur_bsdf_evaluate(bsdf, part, point, view, light, &pdf);
}

static float pdf_of(const aur_bsdf *bsdf, aur_bsdf_part part, aur_vector view, aur_vector light) {
    float pdf;
    aur_bsdf_evaluate(bsdf, part, point, view, light, &pdf);
    return pdf;
}

/* Integral of pdf over the whole sphere, cell by cell. */
enum { CELLS_Z = 20, CELLS_PHI = 24, PARTS = 10, CELL_COUNT = CELLS_Z * CELLS_PHI };

static size_t cell_of(aur_vector d) {
    double phi = atan2((double)d.y, (double)d.x) / (2.0 * AUR_PI);
    phi -= floor(phi);
    const size_t i = (size_t)(0.5 * ((double)d.z + 1.0) * CELLS_Z), j = (size_t)(phi * CELLS_PHI);
    return (i < CELLS_Z ? i : CELLS_Z - 1) * CELLS_PHI + (j < CELLS_PHI ? j : CELLS_PHI - 1);
}

/* Two Gauss points in z and one in phi for each of parts^2 pieces of a cell. */
static void integrate_pdf(const aur_bsdf *bsdf, aur_vector view, size_t parts, double *mass) {
    for (size_t cell = 0; cell < CELL_COUNT; ++cell) {
        const double cell_z = (double)(cell / CELLS_PHI), cell_phi = (double)(cell % CELLS_PHI);
        mass[cell] = 0.0;
        for (size_t k = 0; k < 2 * parts * parts; ++k) {
            const double offset_z =
                (double)(k / 2 / parts) + (k % 2 == 0 ? 0.21132486540518713 : 0.78867513459481287);
            const double offset_phi = (double)(k / 2 % parts) + 0.5;
            const double z = -1.0 + 2.0 * (cell_z + offset_z / (double)parts) / CELLS_Z;
            const double phi = (cell_phi + offset_phi / (double)parts) / CELLS_PHI;
            mass[cell] += (double)pdf_of(bsdf, AUR_BSDF_WHOLE, view, aur_direction_at((float)z, (float)phi));
        }
        mass[cell] *= 4.0 * AUR_PI / (CELL_COUNT * (double)(2 * parts * parts));
    }
}

/* The normal deviate of a chi-square sum (Wilson and Hilferty 1931). */
static double chi_square_deviate(double sum, double freedom) {
    const double variance = 2.0 / (9.0 * freedom);
    return (cbrt(sum / freedom) - (1.0 - variance)) / sqrt(variance);
}

/* Counts of sampled directions against the pdf, for every material and view. A deviate beyond 5 has a
 * probability of 3e-7 each, below 1e-4 over all of them; the samples are fixed. */
static void draws_by_the_density(void **state) {
    (void)state;
    enum { DRAWS = 40000 };
    for (size_t m = 0; m < MATERIAL_COUNT; ++m) {
        material built = make_material(&material_rows[m]);
        aur_vector view;
        for (size_t v = first_view(m); v < VIEW_COUNT && view_at(built.bsdf, v, &view); v += view_step()) {
            double mass[CELL_COUNT], total = 0.0;
            size_t counts[CELL_COUNT] = {0}, drawn = 0;
            integrate_pdf(built.bsdf, view, material_rows[m].flags & NARROW ? 3 * PARTS : PARTS, mass);
            for (size_t i = 0; i < DRAWS; ++i) {
                const float u[3] = {unit(v, 1, i), unit(v, 2, i), unit(v, 3, i)};
                aur_bsdf_sample sample;
                if (!aur_bsdf_draw(built.bsdf, AUR_BSDF_WHOLE, point, view, u, &sample) || sample.specular)
                    continue;
                ++counts[cell_of(sample.light)];
                ++drawn;
            }
            double sum = 0.0, rest_mass = 0.0, rest_count = 0.0, cells = 0.0;
            for (size_t cell = 0; cell < CELL_COUNT; ++cell) {
                total += mass[cell];
                const double expected = mass[cell] * DRAWS;
                if (expected < 10.0) {
                    rest_mass += expected;
                    rest_count += (double)counts[cell];
                    continue;
                }
                sum += ((double)counts[cell] - expected) * ((double)counts[cell] - expected) / expected;
                ++cells;
            }
            const double lost = DRAWS - total * DRAWS; /* absorbed or specular */
            if (lost > 10.0) {
                const double seen = (double)(DRAWS - drawn);
                sum += (seen - lost) * (seen - lost) / lost;
                ++cells;
            }
            if (rest_mass > 10.0) {
                sum += (rest_count - rest_mass) * (rest_count - rest_mass) / rest_mass;
                ++cells;
            }
            assert_true(total < 1.0 + 2e-3);
            const double deviate = cells > 1.0 ? chi_square_deviate(sum, cells - 1.0) : 0.0;
            if (!(deviate < 5.0))
                fail_msg("%s, view %zu: chi-square %g in %g cells", material_rows[m].text, v, sum, cells);
        }
        drop_material(&built);
    }
}

/* A sample has the pdf and the weight that evaluation returns. */
static void samples_agree_with_evaluation(void **state) {
    (void)state;
    for (size_t m = 0; m < MATERIAL_COUNT; ++m) {
        material built = make_material(&material_rows[m]);
        aur_vector view;
        for (size_t v = first_view(m); v < VIEW_COUNT && view_at(built.bsdf, v, &view); v += view_step()) {
            for (size_t i = 0; i < 500; ++i) {
                const float u[3] = {unit(v, 1, i), unit(v, 2, i), unit(v, 3, i)};
                aur_bsdf_sample sample;
                if (!aur_bsdf_draw(built.bsdf, AUR_BSDF_WHOLE, point, view, u, &sample))
                    continue;
                assert_near(aur_vector_length(sample.light), 1.0, 1e-5);
                if (sample.specular)
                    continue;
                const aur_vector value = value_of(built.bsdf, AUR_BSDF_WHOLE, view, sample.light);
                assert_relative(sample.pdf, pdf_of(built.bsdf, AUR_BSDF_WHOLE, view, sample.light), 1e-3);
                assert_relative(sample.weight.y * sample.pdf, value.y, 1e-3);
                assert_true(sample.weight.y >= 0.0f && isfinite(sample.weight.y));
            }
        }
        drop_material(&built);
    }
}

static void is_reciprocal(void **state) {
    (void)state;
    for (size_t m = 0; m < MATERIAL_COUNT; ++m) {
        if (material_rows[m].flags & NOT_RECIPROCAL)
            continue;
        material built = make_material(&material_rows[m]);
        for (size_t i = 0; i < 2000; ++i) {
            const aur_vector a = aur_sample_sphere(unit(m, 1, i), unit(m, 2, i));
            aur_vector b = aur_sample_sphere(unit(m, 3, i), unit(m, 4, i));
            if (i % 2 == 0) { /* near the mirror direction, where lobes are */
                const aur_frame frame = aur_frame_about(aur_mirror(a));
                b = aur_frame_to_world(&frame, aur_sample_cosine_power(unit(m, 3, i), unit(m, 4, i), 100.0f));
            }
            if (fabsf(a.z) < 1e-3f || fabsf(b.z) < 1e-3f)
                continue;
            /* Radiance over the squared index is preserved by refraction: 1.5 below the surface. */
            const bool glass = (material_rows[m].flags & GLASS) != 0;
            const float above = glass && a.z < 0.0f ? 2.25f : 1.0f,
                        below = glass && b.z < 0.0f ? 2.25f : 1.0f;
            const float there = value_of(built.bsdf, AUR_BSDF_WHOLE, a, b).x / fabsf(b.z) / above;
            const float back = value_of(built.bsdf, AUR_BSDF_WHOLE, b, a).x / fabsf(a.z) / below;
            assert_near(there, back, 2e-3 * fabs((double)there) + 1e-6);
        }
        drop_material(&built);
    }
}

/* No material reflects more than it receives, from any side, and weights estimate its albedo. */
static void conserves_energy(void **state) {
    (void)state;
    for (size_t m = 0; m < MATERIAL_COUNT; ++m) {
        material built = make_material(&material_rows[m]);
        aur_vector view;
        for (size_t v = first_view(m); v < VIEW_COUNT && view_at(built.bsdf, v, &view); v += view_step()) {
            double sum = 0.0, squares = 0.0;
            enum { DRAWS = 20000 };
            for (size_t i = 0; i < DRAWS; ++i) {
                const float u[3] = {unit(v, 4, i), unit(v, 5, i), unit(v, 6, i)};
                aur_bsdf_sample sample;
                double weight = 0.0;
                if (aur_bsdf_draw(built.bsdf, AUR_BSDF_WHOLE, point, view, u, &sample))
                    weight =
                        (double)(sample.weight.x * (sample.ior_squared > 0.0f ? sample.ior_squared : 1.0f));
                sum += weight;
                squares += weight * weight;
            }
            const double mean = sum / DRAWS;
            const double sigma = sqrt(fmax(squares / DRAWS - mean * mean, 0.0) / DRAWS);
            if (material_rows[m].flags & WHITE && view.z > 0.0f)
                assert_near(mean, 1.0, 5.0 * sigma + 2e-4);
            if (!(mean <= 1.0 + 5.0 * sigma + 1e-5))
                fail_msg("%s, view %zu: albedo %g +- %g", material_rows[m].text, v, mean, sigma);
        }
        drop_material(&built);
    }
}

static aur_vector lobe_value(const aur_bsdf *bsdf, aur_vector view, const aur_bsdf_lobe *lobe,
                             aur_vector light) {
    if (lobe->shape == AUR_LOBE_SHAPE_SPECULAR)
        return (aur_vector){0};
    if (lobe->shape == AUR_LOBE_SHAPE_SAMPLED)
        return value_of(bsdf, AUR_BSDF_SAMPLED_LOBES, view, light);
    const float cosine = aur_vector_dot(lobe->axis, light);
    const float power = cosine > 0.0f ? powf(cosine, lobe->exponent) : 0.0f;
    const float factor = aur_lobe_factor(lobe, fabsf(light.z));
    return aur_vector_scale(lobe->coefficient, factor * power * (lobe->times_cosine ? fabsf(light.z) : 1.0f));
}

/* The integral of a diffuse lobe's value over its coefficient: 2 pi times that of factor * cos by midpoints.
 */
static double diffuse_mass(const aur_bsdf_lobe *lobe) {
    enum { STEPS = 20000 };
    double sum = 0.0;
    for (size_t i = 0; i < STEPS; ++i) {
        const double cosine = ((double)i + 0.5) / STEPS;
        sum += 2.0 * AUR_PI * cosine * (double)aur_lobe_factor(lobe, (float)cosine) / STEPS;
    }
    return sum;
}

/* The lobes for final gathering sum to the material; and the diffuse ones have the albedo for photons (to
 * 1e-3 under coats, whose mean transmittance is a quadrature of coarse steps). */
static void lobes_are_the_material(void **state) {
    (void)state;
    for (size_t m = 0; m < MATERIAL_COUNT; ++m) {
        material built = make_material(&material_rows[m]);
        aur_vector view;
        for (size_t v = first_view(m); v < VIEW_COUNT && view_at(built.bsdf, v, &view); v += view_step()) {
            aur_bsdf_lobe lobes[AUR_BSDF_LOBE_CAPACITY];
            const size_t count = aur_bsdf_lobes(built.bsdf, point, view, lobes);
            double diffuse = 0.0;
            bool coated = false;
            for (size_t k = 0; k < count; ++k) {
                diffuse += lobes[k].diffuse ? diffuse_mass(&lobes[k]) * (double)lobes[k].coefficient.x : 0.0;
                coated = coated || lobes[k].factor != NULL;
            }
            assert_near(diffuse, aur_bsdf_diffuse_albedo(built.bsdf, point, view.z).x, coated ? 1e-3 : 1e-6);
            for (size_t i = 0; i < 300; ++i) {
                const aur_vector light = aur_sample_sphere(unit(m, 1, i), unit(m, 2, i));
                if (light.z * view.z <= 0.0f)
                    continue;
                double sum = 0.0;
                for (size_t k = 0; k < count; ++k)
                    sum += (double)lobe_value(built.bsdf, view, &lobes[k], light).x;
                const double value = value_of(built.bsdf, AUR_BSDF_WHOLE, view, light).x;
                assert_near(sum, value, 1e-4 * value + 1e-7);
            }
        }
        drop_material(&built);
    }
}

/* Final gathering builds a rule for each lobe without a position: lobes and their numbers do not depend on
 * the point, though a texture makes them black there. */
static void lobes_are_the_same_at_every_point(void **state) {
    (void)state;
    aur_parameters parameters;
    aur_error error = {0};
    aur_texture *texture;
    assert_int_equal(aur_parameters_parse(&parameters, "texture", "checkerboard:color0=0,color1=0.5", &error),
                     AUR_OK);
    assert_int_equal(aur_texture_create(&parameters, NULL, &texture, &error), AUR_OK);
    aur_parameters_release(&parameters);
    static const char *const names[] = {"diffuse_reflectance", "specular_reflectance"};
    for (size_t k = 0; k < 2; ++k) {
        aur_bsdf *bsdf;
        assert_int_equal(aur_parameters_parse(&parameters, "bsdf", "phong:exponent=9", &error), AUR_OK);
        assert_int_equal(
            aur_parameters_add_object(&parameters, names[k], "texture", texture, (aur_location){0}, &error),
            AUR_OK);
        assert_int_equal(aur_bsdf_create(&parameters, &bsdf, &error), AUR_OK);
        aur_parameters_release(&parameters);
        const aur_vector view = {0.0f, 0.6f, 0.8f};
        aur_bsdf_lobe black[AUR_BSDF_LOBE_CAPACITY], lit[AUR_BSDF_LOBE_CAPACITY];
        assert_int_equal(aur_bsdf_lobes(bsdf, (aur_bsdf_point){.u = 0.0f, .v = 0.0f}, view, black), 2);
        assert_int_equal(aur_bsdf_lobes(bsdf, (aur_bsdf_point){.u = 0.7f, .v = 0.2f}, view, lit), 2);
        for (size_t i = 0; i < 2; ++i) {
            assert_int_equal(black[i].shape, lit[i].shape);
            assert_int_equal(black[i].diffuse, lit[i].diffuse);
            assert_true(black[i].exponent == lit[i].exponent && lit[i].coefficient.x > 0.0f);
            assert_int_equal(black[i].coefficient.x > 0.0f, i != k);
        }
        aur_bsdf_destroy(bsdf);
    }
    aur_texture_destroy(texture);
}

/* n nested masks of opacity a transmit 1 - a^n of the light, all of it in a lobe. */
static void masks_in_masks_let_all_light_through(void **state) {
    (void)state;
    const aur_vector view = {0.0f, 0.6f, 0.8f};
    aur_bsdf *built[6] = {make_bsdf("phong", NULL)};
    for (size_t n = 1; n < 6; ++n) {
        built[n] = make_bsdf("mask:opacity=0.5", built[n - 1]);
        aur_bsdf_lobe lobes[AUR_BSDF_LOBE_CAPACITY];
        const size_t count = aur_bsdf_lobes(built[n], point, view, lobes);
        float through = 0.0f;
        for (size_t i = 0; i < count; ++i)
            through += lobes[i].shape == AUR_LOBE_SHAPE_SPECULAR ? lobes[i].coefficient.x : 0.0f;
        assert_true(through == 1.0f - ldexpf(1.0f, -(int)n));
    }
    for (size_t n = 6; n-- > 0;)
        aur_bsdf_destroy(built[n]);
}

/* The light through a mask, and the reflection and refraction of a smooth material in it, are separate lobes.
 */
static void specular_lobes_of_a_mask_stay_apart(void **state) {
    (void)state;
    const aur_vector view = {0.0f, 0.6f, 0.8f};
    material built =
        make_material(&(material_row){"mask:opacity=0.5", "dielectric:int_ior=1.5,ext_ior=1", 0});
    aur_bsdf_lobe nested[AUR_BSDF_LOBE_CAPACITY], lobes[AUR_BSDF_LOBE_CAPACITY];
    assert_int_equal(aur_bsdf_lobes(built.nested[0], point, view, nested), 2);
    assert_int_equal(aur_bsdf_lobes(built.bsdf, point, view, lobes), 3);
    for (size_t i = 0; i < 2; ++i) {
        assert_true(lobes[i].coefficient.x == 0.5f * nested[i].coefficient.x);
        assert_true(lobes[i].axis.x == nested[i].axis.x && lobes[i].axis.y == nested[i].axis.y &&
                    lobes[i].axis.z == nested[i].axis.z && lobes[i].ior_squared == nested[i].ior_squared);
    }
    assert_true(lobes[2].coefficient.x == 0.5f && lobes[2].axis.z == -0.8f);
    drop_material(&built);
}

/* Draws of a sampled lobe alone have weight value / pdf, and their mean is the integral of the value: against
 * a midpoint rule over the sphere in cosine and azimuth, at most 1 % off where facets are this rough. */
static void sampled_lobes_are_drawn_alone(void **state) {
    (void)state;
    size_t found = 0;
    for (size_t m = 0; m < MATERIAL_COUNT; ++m) {
        material built = make_material(&material_rows[m]);
        aur_vector view;
        for (size_t v = first_view(m); v < VIEW_COUNT && view_at(built.bsdf, v, &view); v += view_step()) {
            aur_bsdf_lobe lobes[AUR_BSDF_LOBE_CAPACITY];
            const size_t count = aur_bsdf_lobes(built.bsdf, point, view, lobes);
            bool sampled = false;
            for (size_t k = 0; k < count; ++k)
                sampled = sampled || lobes[k].shape == AUR_LOBE_SHAPE_SAMPLED;
            if (!sampled)
                continue;
            ++found;
            enum { DRAWS = 20000 };
            double sum = 0.0, squares = 0.0;
            for (size_t i = 0; i < DRAWS; ++i) {
                const float u[3] = {unit(v, 7, i), unit(v, 8, i), unit(v, 9, i)};
                aur_bsdf_sample sample;
                if (!aur_bsdf_draw(built.bsdf, AUR_BSDF_SAMPLED_LOBES, point, view, u, &sample))
                    continue;
                const double value = value_of(built.bsdf, AUR_BSDF_SAMPLED_LOBES, view, sample.light).x /
                                     (double)pdf_of(built.bsdf, AUR_BSDF_SAMPLED_LOBES, view, sample.light);
                assert_near(value, sample.weight.x, 2e-3 * value + 1e-6);
                sum += (double)sample.weight.x;
                squares += (double)(sample.weight.x * sample.weight.x);
            }
            const double mean = sum / DRAWS;
            const double sigma = sqrt(fmax(squares / DRAWS - mean * mean, 0.0) / DRAWS);
            enum { SIDE = 1000 };
            double integral = 0.0;
            for (size_t i = 0; i < (size_t)SIDE * SIDE; ++i) {
                const float z = 2.0f * ((float)(i / SIDE) + 0.5f) / SIDE - 1.0f;
                const aur_vector light = aur_direction_at(z, ((float)(i % SIDE) + 0.5f) / SIDE);
                integral += (double)value_of(built.bsdf, AUR_BSDF_SAMPLED_LOBES, view, light).x;
            }
            integral *= 4.0 * AUR_PI / ((double)SIDE * SIDE);
            if (!(fabs(mean - integral) <= 5.0 * sigma + 0.01 * integral + 1e-6))
                fail_msg("%s, view %zu: drawn %g +- %g, but %g", material_rows[m].text, v, mean, sigma,
                         integral);
        }
        drop_material(&built);
    }
    assert_true(found > 0);
}

/* The glossy part of phong_lobe is k_s times the part of its lobe above the surface: all of it seen from
 * above, and half of it (by symmetry) seen at grazing angles. */
static void lobe_reflectance_is_its_parameter(void **state) {
    (void)state;
    static const material_row row = {"phong_lobe:exponent=50,diffuse_reflectance=0,specular_reflectance=0.8",
                                     NULL, 0};
    material built = make_material(&row);
    static const struct {
        double cosine, expected, tolerance;
    } views[] = {{1.0, 0.8, 1e-5}, {1e-4, 0.4, 2e-3}};
    for (size_t v = 0; v < 2; ++v) {
        const float z = (float)views[v].cosine;
        const aur_vector view = {sqrtf(1.0f - z * z), 0.0f, z};
        double sum = 0.0;
        enum { SIDE = 512 };
        for (size_t i = 0; i < (size_t)SIDE * SIDE; ++i) {
            const float u[3] = {0.5f, ((float)(i / SIDE) + 0.5f) / SIDE, ((float)(i % SIDE) + 0.5f) / SIDE};
            aur_bsdf_sample sample;
            if (aur_bsdf_draw(built.bsdf, AUR_BSDF_WHOLE, point, view, u, &sample))
                sum += (double)sample.weight.x;
        }
        assert_near(sum / ((double)SIDE * SIDE), views[v].expected, views[v].tolerance);
    }
    drop_material(&built);
}

/* Materials defined by Mitsuba 3's formulas have its values, up to single-precision rounding: the narrowest
 * lobes magnify that of a direction by the inverse of their roughness. */
static void values_are_those_of_mitsuba(void **state) {
    (void)state;
    material built;
    const size_t count = sizeof mitsuba_values / sizeof mitsuba_values[0];
    for (size_t i = 0; i < count; ++i) {
        const mitsuba_value *const row = &mitsuba_values[i];
        char text[256];
        snprintf(text, sizeof text, "%s", row->material);
        char *const nested = strchr(text, '>');
        if (nested != NULL)
            *nested = '\0';
        /* The tables of rough coats take a while. */
        if (i == 0 || strcmp(row->material, row[-1].material) != 0)
            built = make_material(&(material_row){text, nested != NULL ? nested + 1 : NULL, 0});
        const aur_vector value = value_of(built.bsdf, AUR_BSDF_WHOLE, row->view, row->light);
        const float difference = aur_vector_length(aur_vector_subtract(value, row->value));
        if (!(difference <= 2e-5f * aur_vector_length(row->value) + 1e-7f))
            fail_msg("%s: %g %g %g instead of %g %g %g (row %zu)", row->material, (double)value.x,
                     (double)value.y, (double)value.z, (double)row->value.x, (double)row->value.y,
                     (double)row->value.z, i);
        if (i + 1 == count || strcmp(row->material, row[1].material) != 0)
            drop_material(&built);
    }
}

/* Smith's formula in double precision; from where the shadowing rounds to none on, and before. Single
 * precision leaves some units of 2^-24 of each of the two terms that are subtracted, which are below .6
 * together. */
static void facets_are_masked_by_the_formula(void **state) {
    (void)state;
    const aur_microfacet facets = {.distribution = AUR_MICROFACET_BECKMANN, .alpha_u = 0.3f, .alpha_v = 0.3f};
    const aur_vector up = {0.0f, 0.0f, 1.0f};
    for (size_t i = 1; i < 2000; ++i) {
        const float z = (float)i / 2000.0f;
        const aur_vector way = {sqrtf(1.0f - z * z), 0.0f, z};
        const double a = (double)z / (0.3 * (double)way.x);
        const double lambda = 0.5 * (exp(-a * a) / (sqrt(AUR_PI) * a) - erfc(a));
        const double share = (double)aur_microfacet_masking(&facets, way, up);
        if (!(fabs(share * (1.0 + lambda) - 1.0) <= 2e-6))
            fail_msg("%.9g where it is %.9g (a = %g)", share, 1.0 / (1.0 + lambda), a);
    }
}

/* The slope x along the view's azimuth has C(x) = u C(cot), with C(x) = sqrt(pi) cos (1 + erf x) + sin
 * exp(-x^2) (Heitz and d'Eon 2014), in double precision. C' is 2 (cos - x sin) exp(-x^2), so that the
 * quotient changes by less than 1.2 for 1, and x is told to some units of 2^-24 by a unit normal, for slopes
 * of a few. */
static void facets_stand_where_the_formula_says(void **state) {
    (void)state;
    const aur_microfacet facets = {.distribution = AUR_MICROFACET_BECKMANN, .alpha_u = 1.0f, .alpha_v = 1.0f};
    for (size_t i = 1; i < 200; ++i) {
        const float z = (float)i / 200.0f;
        const aur_vector view = {sqrtf(1.0f - z * z), 0.0f, z};
        const double c = (double)z, s = (double)view.x, cot = fmin(c / s, 6.0), root = sqrt(AUR_PI);
        const double whole = root * c * erfc(-cot) + s * exp(-cot * cot);
        for (size_t k = 0; k < 200; ++k) {
            const float u = ((float)k + 0.5f) / 200.0f;
            const aur_vector normal = aur_microfacet_sample(&facets, view, u, 0.5f);
            const double x = -(double)normal.x / (double)normal.z;
            const double part = root * c * erfc(-x) + s * exp(-x * x);
            if (!(fabs(part / whole - (double)u) < 2e-6))
                fail_msg("%.9g where it is %.9g (cosine %g)", part / whole, (double)u, c);
        }
    }
}

/* Facets cover the surface once, in every direction that a distribution is stretched in (Walter 2007, (4)):
 * midpoints over azimuth and squared cosine. */
static void facets_cover_the_surface(void **state) {
    (void)state;
    enum { COUNT = 512 };
    for (int d = AUR_MICROFACET_BECKMANN; d <= AUR_MICROFACET_AS; ++d) {
        aur_microfacet facets = {.alpha_u = 0.2f, .alpha_v = 0.5f};
        facets.distribution = (unsigned)d;
        double sum = 0.0;
        for (size_t i = 0; i < COUNT; ++i)
            for (size_t k = 0; k < COUNT; ++k) {
                const float u = ((float)i + 0.5f) / COUNT, v = ((float)k + 0.5f) / COUNT;
                sum += (double)aur_microfacet_density(&facets, aur_sample_cosine(u, v));
            }
        assert_near(sum * AUR_PI / (COUNT * COUNT), 1.0, 1e-4);
    }
}

/* A row of facets equals the same facets evaluated one by one. */
static void rows_of_facets_are_single_facets(void **state) {
    (void)state;
    const float v[3] = {0.01f, 0.4f, 0.99f};
    for (int i = 0; i < 2; ++i) {
        const aur_microfacet facets = {.distribution = i == 0 ? AUR_MICROFACET_BECKMANN : AUR_MICROFACET_GGX,
                                       .alpha_u = 0.1f,
                                       .alpha_v = 0.4f};
        const aur_vector view = aur_vector_normalize((aur_vector){0.6f, -0.3f, 0.4f});
        aur_vector row[3];
        aur_microfacet_sample_row(&facets, view, 0.7f, 3, v, row);
        for (size_t k = 0; k < 3; ++k) {
            const aur_vector one = aur_microfacet_sample(&facets, view, 0.7f, v[k]);
            assert_memory_equal(&one, &row[k], sizeof one);
        }
    }
}

/* A coat over a diffuse base is a plastic except for the internal reflection between coat and base, whose
 * series is the factor 1 / (1 - inner reflectance). */
static void coat_over_diffuse_is_plastic(void **state) {
    (void)state;
    static const char *const pairs[][2] = {
        {"coating:int_ior=1.5,ext_ior=1", "plastic:int_ior=1.5,ext_ior=1,diffuse_reflectance=0.7"},
        {"roughcoating:int_ior=1.5,ext_ior=1,alpha=0.25",
         "roughplastic:int_ior=1.5,ext_ior=1,alpha=0.25,diffuse_reflectance=0.7"}};
    for (size_t k = 0; k < 2; ++k) {
        aur_bsdf *const base = make_bsdf("diffuse:reflectance=0.7", NULL);
        aur_bsdf *const coated = make_bsdf(pairs[k][0], base), *const plastic = make_bsdf(pairs[k][1], NULL);
        double inner = 1.0 - (double)aur_fresnel_diffuse(1.0f / 1.5f);
        if (k == 1) {
            const aur_microfacet facets = {AUR_MICROFACET_BECKMANN, 0.25f, 0.25f, false};
            inner = 1.0 - (double)aur_rough_coat_of(&facets, 1.5f).inner_reflectance;
        }
        for (size_t i = 0; i < 200; ++i) {
            const aur_vector a = aur_sample_cosine(unit(k, 1, i), unit(k, 2, i));
            const aur_vector b = aur_sample_cosine(unit(k, 3, i), unit(k, 4, i));
            /* The coat's reflection is the same in both. */
            const double mirrored = (double)value_of(plastic, AUR_BSDF_SAMPLED_LOBES, a, b).x * (double)k;
            const double under = (double)value_of(coated, AUR_BSDF_WHOLE, a, b).x - mirrored;
            const double whole = (double)value_of(plastic, AUR_BSDF_WHOLE, a, b).x - mirrored;
            assert_near(under, whole * inner, 1e-5 * (under + mirrored));
        }
        aur_bsdf_destroy(coated);
        aur_bsdf_destroy(plastic);
        aur_bsdf_destroy(base);
    }
}

/* Beer and Lambert's law over the way in and out of a mirror under a coat. */
static void coat_absorbs_along_the_way(void **state) {
    (void)state;
    aur_bsdf *const mirror = make_bsdf("conductor", NULL);
    aur_bsdf *const clear = make_bsdf("coating:int_ior=1.5,ext_ior=1", mirror);
    aur_bsdf *const tinted = make_bsdf("coating:int_ior=1.5,ext_ior=1,sigma_a=0.8,thickness=0.5", mirror);
    const aur_vector view = {0.6f, 0.0f, 0.8f};
    aur_bsdf_lobe lobes[2][AUR_BSDF_LOBE_CAPACITY];
    assert_int_equal(aur_bsdf_lobes(clear, point, view, lobes[0]), 2);
    assert_int_equal(aur_bsdf_lobes(tinted, point, view, lobes[1]), 2);
    const double within = sqrt(1.0 - 0.36 / 2.25), mirrored = (double)lobes[0][0].coefficient.x;
    assert_near(lobes[0][1].coefficient.x, (1.0 - mirrored) * (1.0 - mirrored), 1e-6);
    assert_near(lobes[1][1].coefficient.x, (double)lobes[0][1].coefficient.x * exp(-0.8 / within), 1e-6);
    aur_bsdf_destroy(tinted);
    aur_bsdf_destroy(clear);
    aur_bsdf_destroy(mirror);
}

/* Oren and Nayar's equations 27 to 30 for directions 30 and 60 degrees from the normal, whose planes are 0,
 * 90 and 180 degrees apart. */
static void rough_diffuse_is_oren_nayar(void **state) {
    (void)state;
    aur_bsdf *const full = make_bsdf("roughdiffuse:reflectance=0.8,alpha=0.6", NULL);
    aur_bsdf *const fast = make_bsdf("roughdiffuse:reflectance=0.8,alpha=0.6,use_fast_approx=true", NULL);
    const double pi = acos(-1.0), beta = pi / 6.0, alpha = pi / 3.0, v = 0.18, flat = 2.0 * beta / pi;
    const double c1 = 1.0 - 0.5 * v / (v + 0.33), c2 = 0.45 * v / (v + 0.09), c4 = 0.17 * v / (v + 0.13);
    const double c3 = 0.125 * v / (v + 0.09) * pow(4.0 * alpha * beta / (pi * pi), 2.0);
    const double rises[3] = {sin(alpha), 0.0, -(sin(alpha) - flat * flat * flat)};
    for (int i = 0; i < 3; ++i) {
        const double turn = cos(i * pi / 2.0), phi = i * pi / 2.0;
        const aur_vector view = {(float)sin(beta), 0.0f, (float)cos(beta)};
        const aur_vector light = {(float)(sin(alpha) * cos(phi)), (float)(sin(alpha) * sin(phi)),
                                  (float)cos(alpha)};
        const double once =
            c1 + c2 * rises[i] * tan(beta) + c3 * (1.0 - fabs(turn)) * tan(0.5 * (alpha + beta));
        const double twice = c4 * (1.0 - turn * flat * flat), cosine = cos(alpha) / pi;
        float pdf;
        const aur_vector got = aur_bsdf_evaluate(full, AUR_BSDF_WHOLE, point, view, light, &pdf);
        assert_near(got.x, cosine * (0.8 * once + 0.64 * twice), 1e-6);
        const aur_vector quick = aur_bsdf_evaluate(fast, AUR_BSDF_WHOLE, point, view, light, &pdf);
        assert_near(quick.x, 0.8 * cosine * (c1 + c2 * fmax(turn, 0.0) * sin(alpha) * tan(beta)), 1e-6);
    }
    aur_bsdf_destroy(fast);
    aur_bsdf_destroy(full);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_material_is_tested),
        cmocka_unit_test(draws_by_the_density),
        cmocka_unit_test(samples_agree_with_evaluation),
        cmocka_unit_test(is_reciprocal),
        cmocka_unit_test(conserves_energy),
        cmocka_unit_test(lobes_are_the_material),
        cmocka_unit_test(lobes_are_the_same_at_every_point),
        cmocka_unit_test(masks_in_masks_let_all_light_through),
        cmocka_unit_test(specular_lobes_of_a_mask_stay_apart),
        cmocka_unit_test(sampled_lobes_are_drawn_alone),
        cmocka_unit_test(coat_over_diffuse_is_plastic),
        cmocka_unit_test(coat_absorbs_along_the_way),
        cmocka_unit_test(lobe_reflectance_is_its_parameter),
        cmocka_unit_test(values_are_those_of_mitsuba),
        cmocka_unit_test(facets_are_masked_by_the_formula),
        cmocka_unit_test(facets_stand_where_the_formula_says),
        cmocka_unit_test(facets_cover_the_surface),
        cmocka_unit_test(rows_of_facets_are_single_facets),
        cmocka_unit_test(rough_diffuse_is_oren_nayar),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
