/* Exact weights and cell areas for GGX lobes. Reference: the lobe from its formula, by another quadrature. */
#include <aureole/exact.h>
#include <aureole/quality.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "points/base/gauss.h"
#include "points/base/vector.h"
#include "points/quadrature/exact/system.h"
#include "points/quadrature/potential/potential.h"

/* The mean of x^a y^b z^c over a GGX lobe, by Gauss-Legendre in z and equal steps of the azimuth: slow, but
 * another way than the slopes of half-vectors. */
static double ggx_moment(const aur_density *density, int a, int b, int c) {
    enum { HEIGHTS = 300, STEPS = 300 };
    double z[HEIGHTS], share[HEIGHTS], sum = 0.0, mass = 0.0;
    aur_gauss_legendre(HEIGHTS, z, share);
    for (int i = 0; i < HEIGHTS; ++i)
        for (int k = 0; k < STEPS; ++k) {
            const double height = 0.5 + 0.5 * z[i], sine = sqrt(1.0 - height * height);
            const double phi = 2.0 * AUR_PI * k / STEPS;
            const double u[3] = {sine * cos(phi), sine * sin(phi), height};
            const double part = share[i] * aur_ggx_value(density, u);
            mass += part;
            sum += part * pow(u[0], a) * pow(u[1], b) * pow(u[2], c);
        }
    return sum / mass;
}

static double sum_of(const aur_exact_nodes *nodes, const int powers[3]) {
    double sum = 0.0;
    for (size_t i = 0; i < nodes->count; ++i)
        sum += nodes->mass[i] * pow(nodes->xyz[3 * i], powers[0]) * pow(nodes->xyz[3 * i + 1], powers[1]) *
               pow(nodes->xyz[3 * i + 2], powers[2]);
    return sum;
}

/* Against the other way where 300 steps of it reach rounding, which for its Gauss rule is some 1e-13, and
 * elsewhere (grazing or narrow) against nodes for three times the degree. */
static void ggx_nodes(void **state) {
    (void)state;
    const aur_lobe lobes[] = {{AUR_LOBE_GGX, 0.0, 1.0, 0.0},   {AUR_LOBE_GGX, 0.0, 0.5, 40.0},
                              {AUR_LOBE_GGX, 0.0, 0.5, 60.0},  {AUR_LOBE_GGX, 0.0, 0.4, 88.0},
                              {AUR_LOBE_GGX, 0.0, 0.01, 70.0}, {AUR_LOBE_GGX, 0.0, 1e-4, 89.0}};
    enum { COMPARED = 3 };
    const int powers[][3] = {{0, 0, 1}, {1, 0, 0}, {0, 2, 0}, {3, 2, 1}, {7, 0, 0}, {0, 4, 4}, {0, 3, 0}};
    for (size_t k = 0; k < sizeof lobes / sizeof lobes[0]; ++k) {
        aur_exact_nodes nodes, more;
        aur_error error;
        assert_int_equal(aur_exact_ggx_nodes(&lobes[k], 8, &nodes, &error), AUR_OK);
        assert_int_equal(aur_exact_ggx_nodes(&lobes[k], 24, &more, &error), AUR_OK);
        aur_density density = {.size = sizeof density};
        aur_density_init(&density, NULL);
        density.alpha = lobes[k].alpha;
        density.view_degrees = lobes[k].view_degrees;
        for (size_t j = 0; j < sizeof powers / sizeof powers[0]; ++j) {
            const int *const p = powers[j];
            if (k < COMPARED)
                assert_near(sum_of(&nodes, p), ggx_moment(&density, p[0], p[1], p[2]), 2e-13);
            assert_near(sum_of(&nodes, p), sum_of(&more, p), 1e-13);
        }
        free(nodes.xyz);
        free(more.xyz);
    }
}

static void check_hidden(size_t count, const double *xyz, const double *weights, size_t weighed) {
    size_t visible = 0;
    for (size_t i = 0; i < count; ++i) {
        visible += xyz[3 * i + 2] >= 0.0;
        assert_true(xyz[3 * i + 2] >= 0.0 || weights[i] == 0.0);
    }
    assert_int_equal(weighed, visible);
}

/* Cell areas above the surface, times the lobe there. */
static void check_cells(size_t count, const double *xyz, const aur_lobe *lobe) {
    aur_density density = {.size = sizeof density};
    aur_density_init(&density, NULL);
    density.alpha = lobe->alpha;
    density.view_degrees = lobe->view_degrees;
    double above[900], areas[300], whole[300], sum = 0.0;
    assert_true(count <= 300);
    aur_error error;
    size_t visible = 0;
    assert_int_equal(aur_weights_voronoi(count, xyz, AUR_DOMAIN_HEMISPHERE, lobe, NULL, count, areas, &error),
                     AUR_OK);
    for (size_t i = 0; i < count; ++i)
        if (xyz[3 * i + 2] >= 0.0)
            memcpy(above + 3 * visible++, xyz + 3 * i, 3 * sizeof *xyz);
    assert_int_equal(
        aur_weights_voronoi(visible, above, AUR_DOMAIN_HEMISPHERE, NULL, NULL, count, whole, &error), AUR_OK);
    for (size_t i = 0; i < visible; ++i)
        sum += whole[i] *= aur_ggx_value(&density, above + 3 * i);
    for (size_t i = 0, at = 0; i < count; ++i)
        assert_near(areas[i], xyz[3 * i + 2] >= 0.0 ? whole[at++] / sum : 0.0, 1e-15);
    check_hidden(count, xyz, areas, visible);
}

/* Weights for GGX lobes, against nodes of another degree; narrow ones lose no digits. */
static void ggx(void **state) {
    (void)state;
    enum { N = 300 };
    const struct {
        aur_lobe lobe;
        size_t degree;
    } cases[] = {{{AUR_LOBE_GGX, 0.0, 0.5, 30.0}, 6},
                 {{AUR_LOBE_GGX, 0.0, 0.1, 60.0}, 2},
                 {{AUR_LOBE_GGX, 0.0, 0.01, 80.0}, 1},
                 {{AUR_LOBE_GGX, 0.0, 1e-4, 10.0}, 1}};
    double weights[N];
    aur_error error;
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; ++k) {
        aur_directions_options points = {.size = sizeof points};
        aur_directions_options_init(N, AUR_DOMAIN_HEMISPHERE, &points, NULL);
        points.lobe = cases[k].lobe;
        aur_directions *directions;
        double xyz[3 * N];
        assert_int_equal(aur_directions_create("spherical-fibonacci", &points, &directions, &error), AUR_OK);
        assert_int_equal(aur_directions_points(directions, 0, N, 3 * N, xyz, NULL, &error), AUR_OK);
        aur_directions_destroy(directions);
        aur_exact_options options = {.size = sizeof options};
        aur_exact_options_init(AUR_DOMAIN_HEMISPHERE, &options, NULL);
        options.lobe = cases[k].lobe;
        aur_exact_report report;
        assert_int_equal(aur_weights_exact(N, xyz, &options, N, weights, &report, &error), AUR_OK);
        assert_true(report.degree >= cases[k].degree && report.least > 0.0 && report.residual < 1e-14);
        options.degree = cases[k].degree;
        assert_int_equal(aur_weights_exact(N, xyz, &options, N, weights, &report, &error), AUR_OK);
        check_hidden(N, xyz, weights, report.points);
        if (k == 0)
            check_cells(N, xyz, &options.lobe);
        aur_exact_nodes nodes;
        assert_int_equal(aur_exact_ggx_nodes(&options.lobe, 23, &nodes, &error), AUR_OK);
        for (int a = 0; a <= (int)options.degree; ++a)
            for (int b = 0; a + b <= (int)options.degree; ++b)
                for (int c = 0; a + b + c <= (int)options.degree; ++c) {
                    double sum = 0.0;
                    for (size_t i = 0; i < nodes.count; ++i)
                        sum -= nodes.mass[i] * pow(nodes.xyz[3 * i], a) * pow(nodes.xyz[3 * i + 1], b) *
                               pow(nodes.xyz[3 * i + 2], c);
                    for (size_t i = 0; i < N; ++i) {
                        sum +=
                            weights[i] * pow(xyz[3 * i], a) * pow(xyz[3 * i + 1], b) * pow(xyz[3 * i + 2], c);
                    }
                    assert_near(sum, 0.0, 2e-14);
                }
        free(nodes.xyz);
    }
    aur_exact_options options = {.size = sizeof options};
    aur_exact_options_init(AUR_DOMAIN_HEMISPHERE, &options, NULL);
    options.lobe = cases[0].lobe;
    const double below[6] = {0.0, 0.6, -0.8, 0.0, 1.0, 0.0};
    assert_int_equal(aur_weights_exact(1, below, &options, N, weights, NULL, &error), AUR_ERROR_ARGUMENT);
    assert_non_null(strstr(error.message, "above the surface"));
    assert_int_equal(
        aur_weights_voronoi(1, below, AUR_DOMAIN_HEMISPHERE, &options.lobe, NULL, N, weights, &error),
        AUR_ERROR_ARGUMENT);
    assert_int_equal(aur_weights_exact(2, below, &options, N, weights, NULL, &error), AUR_OK);
    assert_true(weights[0] == 0.0 && weights[1] == 1.0);
    options.degree = AUR_EXACT_GGX_DEGREE_MAX + 1;
    assert_int_equal(aur_weights_exact(2, below, &options, N, weights, NULL, &error), AUR_ERROR_ARGUMENT);
    options.size = sizeof(aur_exact_options);
    aur_exact_options_init(AUR_DOMAIN_SPHERE, &options, NULL);
    options.lobe = cases[0].lobe;
    assert_int_equal(aur_weights_exact(2, below, &options, N, weights, NULL, &error), AUR_ERROR_UNSUPPORTED);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(ggx_nodes), cmocka_unit_test(ggx)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
