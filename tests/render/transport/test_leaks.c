/* Light leaks of the irradiance map: none through a wall, and along a surface on which a wall stands at most
 * one texel far. */
#include "render/scene/scene_text.h"

#include "points/base/random.h"
#include "render/photons/irradiance.h"

/* A closed room divided by a wall without thickness at x = WALL_AT, which texel borders do not match; its
 * floor, ceiling and sides are single faces that continue under the wall. The light is on the far side of it.
 */
#define WALL_AT 0.13
#define GREY "<bsdf type='twosided'><bsdf type='diffuse'><rgb name='reflectance' value='0.5'/></bsdf></bsdf>"
#define ROOM                                                                                                 \
    "<shape type='cube'>" GREY "</shape>"                                                                    \
    "<shape type='rectangle'><transform name='to_world'><rotate y='1' angle='90'/><translate "               \
    "x='0.13'/></transform>" GREY "</shape>"                                                                 \
    "<shape type='rectangle'><transform name='to_world'><scale value='0.2'/><rotate x='1' angle='90'/>"      \
    "<translate x='-0.5' y='0.99'/></transform>"                                                             \
    "<emitter type='area'><rgb name='radiance' value='5'/></emitter></shape>"

enum { CUBE, WALL };

/* Mean irradiance visible from the middle of a half. */
typedef struct survey {
    double dark, lit;
    size_t leaks; /* directions in which the dark half shows light */
} survey;

static aur_vector direction(size_t index) {
    const double z = 2.0 * aur_unit_double(aur_hash2(index, 0)) - 1.0;
    const double phi = 2.0 * AUR_PI * aur_unit_double(aur_hash2(index, 1)), r = sqrt(1.0 - z * z);
    return (aur_vector){(float)(r * cos(phi)), (float)(r * sin(phi)), (float)z};
}

static survey probe_around(const aur_scene *scene, const aur_irradiance_map *map) {
    enum { RAYS = 40000 };
    survey found = {0};
    for (size_t i = 0; i < 2 * RAYS; ++i) {
        const bool dark = i % 2 == 0;
        const aur_ray ray = {
            .origin = {dark ? 0.5f : -0.5f, 0.0f, 0.0f}, .direction = direction(i / 2), .farthest = INFINITY};
        aur_hit hit;
        assert_true(aur_scene_intersect(scene, &ray, &hit));
        if (hit.shape > WALL)
            continue;
        aur_surface surface;
        aur_scene_surface(scene, &ray, &hit, &surface);
        const bool behind = aur_vector_dot(surface.geometric_normal, ray.direction) > 0.0f;
        const uint32_t element = map->texels.elements.shape_first[hit.shape] + hit.primitive;
        const double light =
            (double)aur_irradiance_on_triangle(map, element, hit.u, hit.v, behind)->irradiance.y;
        *(dark ? &found.dark : &found.lit) += light / RAYS;
        if (!dark || !(light > 0.0))
            continue;
        ++found.leaks;
        /* A face has edges of 2; the wall itself and the face across have no part in the lit half. */
        const double width = 2.0 / (double)map->texels.ranges[element].side;
        assert_int_equal(hit.shape, CUBE);
        assert_true((double)surface.position.x - WALL_AT <= width * (1.0 + 1e-5));
    }
    return found;
}

static survey survey_of(const aur_scene *scene, size_t photons) {
    const aur_irradiance_map_options options = {
        .photons = {.count = photons, .max_edges = SIZE_MAX, .seed = 3, .threads = 2},
        .photons_a_texel = 16.0};
    aur_irradiance_map *map = NULL;
    aur_error error = {0};
    if (aur_irradiance_map_create(scene, &options, &map, &error) != AUR_OK)
        fail_msg("%s", error.message);
    const survey found = probe_around(scene, map);
    print_message("%zu photons: the dark half has %.3f %% of the lit one's light\n", photons,
                  100.0 * found.dark / found.lit);
    aur_irradiance_map_destroy(map);
    return found;
}

/* Leaks are proportional to the texels' width, one over the root of the number of photons: in theory a fourth
 * for 16 times the photons. The bounds are 1.5 times the measurements. */
static void leaks_end_after_a_texel_and_shrink(void **state) {
    (void)state;
    aur_scene *const scene = must_load_body(ROOM);
    const survey few = survey_of(scene, 12000), many = survey_of(scene, 192000);
    assert_true(few.leaks > 0 && many.leaks > 0); /* else nothing is tested */
    assert_true(few.dark < 0.02 * few.lit);
    assert_true(many.dark < 0.005 * many.lit);
    assert_true(many.dark / many.lit < 0.4 * few.dark / few.lit);
    aur_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(leaks_end_after_a_texel_and_shrink)};
    return cmocka_run_group_tests_name("leaks", tests, enter_folder, leave_folder);
}
