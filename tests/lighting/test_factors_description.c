/* Statistics of view factors: recomputed from the matrix, or from its parts. */
#include "lighting/viewfactors/closed_pairs.h"
#include "lighting/viewfactors/exchange.h"
#include "lighting/viewfactors/facet_rays.h"
#include "mesh_text.h"
#include "points/base/random.h"

/* Two plates above a floor: some pairs have closed forms, others are behind a plate. */
static aur_facets *load_plates(void) {
    mesh_file file;
    mesh_begin(&file, "plates");
    for (int x = 0; x < 3; ++x)
        mesh_polygon(&file, 4, (const double[4][3]){{x, 0, 0}, {x + 1, 0, 0}, {x + 1, 3, 0}, {x, 3, 0}});
    mesh_polygon(&file, 4, (const double[4][3]){{0, 0, 2}, {0, 3, 2}, {3, 3, 2}, {3, 0, 2}});
    mesh_box(&file, "block", (double[3]){1.2, 0.5, 0.5}, (double[3]){1.9, 2.2, 1.1}, false, false);
    return mesh_load(&file, NULL);
}

static aur_view_factors_description description_of(const aur_view_factors *factors) {
    aur_view_factors_description d = {.size = sizeof d};
    assert_int_equal(aur_view_factors_get_description(factors, &d, NULL), AUR_OK);
    return d;
}

/* Rows are triangles, so an entry is a closed form without interval, or counted along rays. All rays of a row
 * miss a factor of `unseen` with half the remaining probability. */
static void test_shares(void **state) {
    (void)state;
    aur_facets *const facets = load_plates();
    aur_view_factors_options options = {.size = sizeof options};
    aur_view_factors_options_init(&options, NULL);
    options.rays = 512;
    options.confidence = 0.9;
    aur_view_factors_matrix m;
    aur_view_factors *const factors = factors_of(facets, &options, &m);
    const aur_view_factors_description d = description_of(factors);
    double closed = 0.0, all = 0.0, largest = 0.0;
    size_t closed_pairs = 0, sampled_pairs = 0;
    for (size_t i = 0; i < m.rows; ++i) {
        double sum = m.sky[i] + m.back[i];
        for (uint64_t e = m.starts[i]; e < m.starts[i + 1]; ++e) {
            const bool is_closed = m.half_widths[e] == 0.0;
            sum += m.values[e];
            all += m.areas[i] * m.values[e];
            closed += is_closed ? m.areas[i] * m.values[e] : 0.0;
            closed_pairs += m.columns[e] > i && is_closed;
            sampled_pairs += m.columns[e] > i && !is_closed;
        }
        largest = fmax(largest, fabs(sum - 1.0));
    }
    assert_true(closed > 0.1 * all && closed < 0.9 * all);
    assert_relative(d.closed_share, closed / all, 1e-12);
    assert_true(d.closed_pairs == closed_pairs && d.sampled_pairs == sampled_pairs);
    assert_near(d.largest_row_error, largest, 1e-14);
    assert_relative(pow(1.0 - d.unseen, 512.0), 0.05, 0.02);
    aur_view_factors_destroy(factors);
    aur_facets_destroy(facets);
}

/* Rays alone, put together and balanced here. */
static void test_balance(void **state) {
    (void)state;
    aur_facets *const facets = load_plates();
    aur_view_factors_options options = {.size = sizeof options};
    aur_view_factors_options_init(&options, NULL);
    options.rays = 64;
    options.randomizations = 4;
    options.rays_only = true;
    options.seed = 9;
    aur_view_factors_matrix m;
    aur_view_factors *const factors = factors_of(facets, &options, &m);
    const aur_view_factors_description d = description_of(factors);
    const aur_parallel_options parallel = {.threads = 1};
    aur_facet_pattern pattern = {0};
    aur_ray_hits ray_hits = {0};
    aur_closed_pairs closed = {.patch_count = facets->patch_count,
                               .rows = calloc(facets->patch_count, sizeof *closed.rows)};
    aur_exchange exchange = {0};
    aur_balance balance = {0};
    assert_int_equal(aur_facet_pattern_create("sobol", 16, 9, &pattern, NULL), AUR_OK);
    assert_int_equal(aur_ray_hits_trace(facets, &pattern, 4, &parallel, &ray_hits, NULL), AUR_OK);
    assert_int_equal(aur_exchange_assemble(facets, &ray_hits, &closed, 0.95, &parallel, &exchange, NULL),
                     AUR_OK);
    assert_int_equal(aur_exchange_balance(&exchange, &parallel, &balance, NULL), AUR_OK);
    assert_true(balance.before > 0.01 && balance.moved > 0.01);
    assert_true(d.raw_row_error == balance.before && d.moved == balance.moved);
    aur_exchange_release(&exchange);
    aur_closed_pairs_release(&closed);
    aur_ray_hits_release(&ray_hits);
    aur_facet_pattern_release(&pattern);
    aur_view_factors_destroy(factors);
    aur_facets_destroy(facets);
}

/* Rows of a tetrahedron that few rays leave unbalanced (tests/lighting/viewfactors.sh): the largest error is
 * theirs. */
static void test_unbalanced(void **state) {
    (void)state;
    static const double corners[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    static const int faces[4][3] = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
    mesh_file file;
    mesh_begin(&file, "tetrahedron");
    for (size_t f = 0; f < 4; ++f) {
        double face[3][3];
        for (size_t k = 0; k < 9; ++k)
            face[k / 3][k % 3] = corners[faces[f][k / 3]][k % 3];
        mesh_polygon(&file, 3, (const double(*)[3])face);
    }
    aur_facets *const facets = mesh_load(&file, NULL);
    size_t unbalanced = 0;
    for (uint64_t seed = 0; seed < 8; ++seed) {
        aur_view_factors_options options = {.size = sizeof options};
        aur_view_factors_options_init(&options, NULL);
        options.rays = options.randomizations = 2;
        options.rays_only = true;
        options.seed = seed;
        aur_view_factors_matrix m;
        aur_view_factors *const factors = factors_of(facets, &options, &m);
        double largest = 0.0;
        for (size_t i = 0; i < m.rows; ++i) {
            double sum = m.sky[i] + m.back[i];
            for (uint64_t e = m.starts[i]; e < m.starts[i + 1]; ++e)
                sum += m.values[e];
            largest = fmax(largest, fabs(sum - 1.0));
        }
        assert_near(description_of(factors).largest_row_error, largest, 1e-14);
        unbalanced += largest > 1e-3;
        aur_view_factors_destroy(factors);
    }
    assert_in_range(unbalanced, 1, 7);
    aur_facets_destroy(facets);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_shares),
        cmocka_unit_test(test_balance),
        cmocka_unit_test(test_unbalanced),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
