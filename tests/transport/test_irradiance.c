#include "check.h"

#include <stdlib.h>
#include <string.h>

#include "transport/irradiance.h"

/* The closed furnace of tests/render/furnace.xml: walls of [-1,1]^3 that emit 0.5 and reflect half, so that
 * the radiance is 1 and the irradiance pi everywhere. */
static aur_scene *load_furnace(void) {
    aur_scene *scene = NULL;
    aur_error error = {0};
    assert_int_equal(aur_scene_load(AUR_SOURCE_DIR "/tests/render/furnace.xml", NULL, &scene, &error),
                     AUR_OK);
    return scene;
}

static aur_irradiance_map *make_map(const aur_scene *scene, size_t photons, size_t threads) {
    const aur_irradiance_options options = {
        .photons = {.count = photons, .max_edges = SIZE_MAX, .seed = 7, .threads = threads},
        .neighbours = 64};
    aur_irradiance_map *map = NULL;
    aur_error error = {0};
    assert_int_equal(aur_irradiance_map_create(scene, &options, &map, &error), AUR_OK);
    return map;
}

/* Particles bring pi * 0.5 * 24 watts from the walls' 24 square units, and every bounce half of what came:
 * in all 12 pi / (1 - 0.5) arrive. Roulette makes each path's length geometric with variance 2, so over n
 * paths the sum scatters by sqrt(2 / n) / 2 of itself; 5 such are allowed. */
static void photons_bring_all_the_power(void **state) {
    (void)state;
    aur_scene *const scene = load_furnace();
    const aur_photon_options options = {.count = 40000, .max_edges = SIZE_MAX, .seed = 7};
    aur_photon_map map;
    aur_error error = {0};
    assert_int_equal(aur_photon_map_create(scene, &options, &map, &error), AUR_OK);
    double power[3] = {0};
    for (size_t i = 0; i < map.count; ++i) {
        const aur_photon *const photon = &map.photons[i];
        power[0] += (double)photon->power.x;
        power[1] += (double)photon->power.y;
        power[2] += (double)photon->power.z;
        /* A photon comes from the side that its normal shows. */
        assert_true(aur_vector_dot(photon->normal, photon->direction) > 0.0f);
        assert_near(aur_vector_length(photon->direction), 1.0, 1e-5);
    }
    const double spread = sqrt(2.0 / (double)map.paths) / 2.0;
    for (size_t c = 0; c < 3; ++c)
        assert_relative(power[c], 24.0 * AUR_PI, 5.0 * spread);
    assert_true(map.count >= 40000);
    aur_photon_map_release(&map);
    aur_scene_destroy(scene);
}

/* Every estimate has 63 photons, so a spread of 13 % about pi; their mean must be good to 1 % in the middle
 * of the walls and to 5 % within a disc's radius of an edge, where without the correction for the disc's lost
 * part up to half is missing. */
static void irradiance_is_right_to_the_edges(void **state) {
    (void)state;
    aur_scene *const scene = load_furnace();
    aur_irradiance_map *const map = make_map(scene, 100000, 0);
    double middle = 0.0, edge = 0.0;
    size_t middles = 0, edges = 0;
    for (size_t i = 0; i < map->count; ++i) {
        const aur_irradiance_point *const point = &map->points[i];
        const aur_vector p = point->position;
        const float radius = sqrtf(point->radius_squared);
        /* The distance to the nearest edge is one less the second largest of |x|, |y|, |z|. */
        const float x = fabsf(p.x), y = fabsf(p.y), z = fabsf(p.z);
        const float second = fmaxf(fminf(x, y), fminf(fmaxf(x, y), z));
        if (1.0f - second > radius) {
            middle += (double)point->irradiance.y;
            ++middles;
        } else {
            edge += (double)point->irradiance.y;
            ++edges;
        }
    }
    assert_true(edges > 500 && middles > 500);
    assert_relative(middle / (double)middles, AUR_PI, 0.01);
    assert_relative(edge / (double)edges, AUR_PI, 0.05);
    aur_irradiance_map_destroy(map);
    aur_scene_destroy(scene);
}

/* A place that no photon reached is dark, however near lit surfaces are that face the same way. */
static void unlit_places_stay_dark(void **state) {
    (void)state;
    aur_scene *const scene = load_furnace();
    aur_irradiance_map *const map = make_map(scene, 20000, 0);
    const aur_vector normal = {0.0f, 0.0f, 1.0f};
    aur_surface surface = {.position = {0.3f, 0.2f, 0.5f},
                           .geometric_normal = normal,
                           .frame = aur_frame_about(normal),
                           .bsdf = aur_scene_bsdf(scene, 0)};
    const aur_vector dark = aur_irradiance_radiance(map, &surface, normal);
    assert_near(dark.x, 0.0, 0.0);
    surface.position.z = -1.0f; /* on the wall behind: radiance E * albedo / pi = 1/2 */
    const aur_vector lit = aur_irradiance_radiance(map, &surface, normal);
    assert_relative(lit.x, 0.5, 0.5);
    aur_irradiance_map_destroy(map);
    aur_scene_destroy(scene);
}

static void does_not_depend_on_threads(void **state) {
    (void)state;
    aur_scene *const scene = load_furnace();
    aur_irradiance_map *const one = make_map(scene, 20000, 1);
    aur_irradiance_map *const three = make_map(scene, 20000, 3);
    assert_int_equal(one->count, three->count);
    assert_int_equal(one->photons, three->photons);
    assert_memory_equal(one->points, three->points, one->count * sizeof *one->points);
    aur_irradiance_map_destroy(one);
    aur_irradiance_map_destroy(three);
    aur_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(photons_bring_all_the_power),
        cmocka_unit_test(irradiance_is_right_to_the_edges),
        cmocka_unit_test(unlit_places_stay_dark),
        cmocka_unit_test(does_not_depend_on_threads),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
