#include "check.h"

#include <stdlib.h>
#include <string.h>

#include "render/photons/bright_texels.h"

/* Every triangle of the Cornell box except the light's reflects a third of the incident light, on both sides.
 */
static const float THIRD_ON_PI = 1.0f / 3.0f / AUR_PI_F;

static aur_shape_class *make_classes(const aur_scene *scene) {
    aur_shape_class *classes;
    assert_int_equal(aur_shape_classes_create(scene, &classes, NULL), AUR_OK);
    for (uint32_t i = 0; i < aur_scene_shape_count(scene); ++i)
        classes[i].albedo_on_pi[0] = classes[i].albedo_on_pi[1] =
            (aur_vector){THIRD_ON_PI, THIRD_ON_PI, THIRD_ON_PI};
    return classes;
}

typedef struct box {
    aur_scene *scene;
    aur_irradiance_map *map;
    aur_bright_texels bright;
} box;

static box open_box(size_t photons) {
    box b = {0};
    aur_error error = {0};
    assert_int_equal(
        aur_scene_load(AUR_SOURCE_DIR "/scenes/cornell-box/cornell-box.xml", NULL, &b.scene, &error), AUR_OK);
    const aur_irradiance_map_options options = {
        .photons = {.count = photons, .max_edges = SIZE_MAX, .seed = 3, .threads = 1},
        .photons_a_texel = 16.0};
    assert_int_equal(aur_irradiance_map_create(b.scene, &options, &b.map, &error), AUR_OK);
    aur_shape_class *const classes = make_classes(b.scene);
    assert_int_equal(aur_bright_texels_create(b.scene, b.map, classes, &b.bright, &error), AUR_OK);
    free(classes);
    assert_true(b.bright.distribution.total > 0.0);
    return b;
}

static void close_box(box *b) {
    aur_bright_texels_release(&b->bright);
    aur_irradiance_map_destroy(b->map);
    aur_scene_destroy(b->scene);
}

static double density_of_light(const box *b, size_t light) {
    const aur_vector radiance = aur_vector_scale(b->map->lights[light].irradiance, THIRD_ON_PI);
    return (double)aur_bright_texels_density(&b->bright, radiance);
}

/* The pdf integrates to 1 over the texels, the light's excluded, to rounding of floats. */
static void density_is_one(void **state) {
    (void)state;
    box b = open_box(20000);
    double sum = 0.0;
    const aur_elements *const elements = &b.map->texels.elements;
    for (size_t i = 0; i < elements->placement_count; ++i) {
        const aur_placement *const placement = &elements->placements[i];
        if (aur_shape_emitter(b.scene, placement->shape) != AUR_NO_EMITTER)
            continue;
        for (uint32_t k = 0; k < placement->count; ++k) {
            const aur_texel_range range = b.map->texels.ranges[placement->first + k];
            const uint32_t cells = range.side * range.side;
            const double area = aur_element_area(b.scene, placement, k) / cells;
            for (uint32_t c = 0; c < cells; ++c)
                for (size_t side = 0; side < 2; ++side)
                    sum += area * density_of_light(&b, 2 * (size_t)(range.first + c) + side);
        }
    }
    assert_near(sum, 1.0, 1e-5);
    close_box(&b);
}

/* Samples are points of bright texels: a ray from just above one back to it hits the triangle, at these
 * coordinates, from the emitting side. So gather rays see the sampled points. No sample is in the middle of a
 * texel, where its halves meet. */
static void draws_are_seen(void **state) {
    (void)state;
    box b = open_box(20000);
    for (size_t i = 0; i < 2000; ++i) {
        const float position[2] = {(float)fmod(0.5 + 0.7548776662 * ((double)i + 1.0), 1.0),
                                   (float)fmod(0.5 + 0.5698402910 * ((double)i + 1.0), 1.0)};
        const aur_bright_point point =
            aur_bright_texels_sample(&b.bright, b.scene, b.map, ((double)i + 0.5) / 2000.0, position);
        assert_true(point.u >= 0.0f && point.v >= 0.0f && point.u + point.v <= 1.0f + 1e-6f);
        const aur_texel_light *const light =
            aur_irradiance_on_triangle(b.map, point.element, point.u, point.v, point.behind);
        assert_true(density_of_light(&b, (size_t)(light - b.map->lights)) > 0.0);
        const aur_ray ray = {.origin = aur_vector_add_scaled(point.position, 0.5f, point.normal),
                             .direction = aur_vector_scale(point.normal, -1.0f),
                             .farthest = INFINITY};
        aur_hit hit;
        assert_true(aur_scene_intersect(b.scene, &ray, &hit));
        assert_int_equal(aur_element_of(&b.map->texels.elements, &hit), point.element);
        assert_near(hit.u, point.u, 1e-3);
        assert_near(hit.v, point.v, 1e-3);
        aur_surface surface;
        aur_scene_surface(b.scene, &ray, &hit, &surface);
        assert_true((aur_vector_dot(surface.geometric_normal, point.normal) < 0.0f) == point.behind);
    }
    close_box(&b);
}

/* Stratified draws fall on texels in proportion to density * area: with n strata each count is within 2 of
 * its expectation, as a texel's patches are at most four runs of the distribution. */
static void draws_follow_the_density(void **state) {
    (void)state;
    box b = open_box(2000);
    enum { DRAWS = 100000 };
    double *const counts = calloc(2 * b.map->texels.count, sizeof *counts);
    assert_non_null(counts);
    for (size_t i = 0; i < DRAWS; ++i) {
        const float position[2] = {(float)fmod(0.5 + 0.7548776662 * ((double)i + 1.0), 1.0),
                                   (float)fmod(0.5 + 0.5698402910 * ((double)i + 1.0), 1.0)};
        const aur_bright_point point =
            aur_bright_texels_sample(&b.bright, b.scene, b.map, ((double)i + 0.5) / DRAWS, position);
        counts[aur_irradiance_on_triangle(b.map, point.element, point.u, point.v, point.behind) -
               b.map->lights] += 1.0;
    }
    size_t lit = 0;
    for (size_t i = 0; i < 2 * b.map->texels.count; ++i) {
        const double expected = DRAWS * density_of_light(&b, i) * (double)b.map->lights[i].area;
        if (counts[i] == 0.0)
            continue; /* the light's texels are bright, but excluded from the distribution */
        ++lit;
        assert_near(counts[i], expected, 2.0 + 1e-3 * expected);
    }
    assert_true(lit > 10);
    free(counts);
    close_box(&b);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(density_is_one),
        cmocka_unit_test(draws_are_seen),
        cmocka_unit_test(draws_follow_the_density),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
