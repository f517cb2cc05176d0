#include "render/scene/scene_text.h"

#include "render/photons/irradiance.h"
#include "render/photons/particles.h"

/* The closed furnace of tests/render/driver/furnace.xml: walls of [-1,1]^3 that emit 0.5 and reflect half, so
 * that the radiance is 1 and the irradiance pi everywhere. */
static aur_scene *load_furnace(void) {
    aur_scene *scene = NULL;
    aur_error error = {0};
    assert_int_equal(aur_scene_load(AUR_SOURCE_DIR "/tests/render/driver/furnace.xml", NULL, &scene, &error),
                     AUR_OK);
    return scene;
}

static aur_irradiance_map *make_map(const aur_scene *scene, size_t photons, size_t threads) {
    const aur_irradiance_map_options options = {
        .photons = {.count = photons, .max_edges = SIZE_MAX, .seed = 7, .threads = threads},
        .photons_a_texel = 32.0};
    aur_irradiance_map *map = NULL;
    aur_error error = {0};
    assert_int_equal(aur_irradiance_map_create(scene, &options, &map, &error), AUR_OK);
    return map;
}

/* Where a photon is, and the normal on the side that it came from. */
static aur_vector place(const aur_scene *scene, const aur_elements *elements, const aur_photon *photon,
                        aur_vector *normal) {
    const aur_placement *at = elements->placements;
    while (photon->element >= at->first + at->count)
        ++at;
    aur_vector corner[3];
    aur_shape_corners(scene, at->shape, photon->element - at->first, corner);
    *normal = aur_vector_scale(aur_triangle_normal(corner), photon->behind ? -1.0f : 1.0f);
    aur_vector position = corner[0];
    for (size_t i = 0; i < 2; ++i)
        position = aur_vector_add_scaled(position, photon->coordinates[i],
                                         aur_vector_subtract(corner[i + 1], corner[0]));
    return position;
}

/* Particles bring pi * 0.5 * 24 watts from the walls' 24 square units, and every bounce half of what came:
 * in all 12 pi / (1 - 0.5) arrive. Roulette makes each path's length geometric with variance 2, so over n
 * paths the sum scatters by sqrt(2 / n) / 2 of itself; 5 such are allowed. */
static void photons_bring_all_the_power(void **state) {
    (void)state;
    aur_scene *const scene = load_furnace();
    const aur_photon_options options = {.count = 40000, .max_edges = SIZE_MAX, .seed = 7};
    aur_elements elements;
    assert_int_equal(aur_elements_create(scene, &elements), AUR_OK);
    aur_photon_map map;
    aur_error error = {0};
    assert_int_equal(aur_photon_map_create(scene, &elements, &options, &map, &error), AUR_OK);
    double power[3] = {0};
    for (size_t i = 0; i < map.count; ++i) {
        const aur_photon *const photon = &map.photons[i];
        power[0] += (double)photon->power.x;
        power[1] += (double)photon->power.y;
        power[2] += (double)photon->power.z;
        /* A photon comes from the side that its normal shows. */
        aur_vector normal;
        place(scene, &elements, photon, &normal);
        assert_true(aur_vector_dot(normal, photon->direction) > 0.0f);
        assert_near(aur_vector_length(photon->direction), 1.0, 1e-5);
    }
    const double spread = sqrt(2.0 / (double)map.paths) / 2.0;
    for (size_t c = 0; c < 3; ++c)
        assert_relative(power[c], 24.0 * AUR_PI, 5.0 * spread);
    assert_true(map.count >= 40000);
    aur_photon_map_release(&map);
    aur_elements_release(&elements);
    aur_scene_destroy(scene);
}

/* Many particles at once, of several sets of points, have the photons that each has, in their order. */
static void particles_are_the_single_ones(void **state) {
    (void)state;
    enum { PATHS = 200, FIRST = 7 };
    aur_scene *const scene = load_furnace();
    aur_elements elements;
    assert_int_equal(aur_elements_create(scene, &elements), AUR_OK);
    aur_sampler *sampler = NULL;
    assert_int_equal(aur_sampler_create("sobol", 1, NULL, &sampler, NULL), AUR_OK);
    const aur_photon_options options = {.max_edges = SIZE_MAX, .seed = 7};
    const aur_particle_source source = {scene, &elements, &options, sampler, 90};
    aur_photon_list together = {0}, each = {0};
    assert_int_equal(aur_particles_trace(&source, FIRST, PATHS, &together), AUR_OK);
    for (uint64_t i = 0; i < PATHS; ++i)
        assert_int_equal(aur_particles_trace(&source, FIRST + i, 1, &each), AUR_OK);
    assert_true(together.count > PATHS);
    assert_int_equal(together.count, each.count);
    assert_memory_equal(together.photons, each.photons, each.count * sizeof *each.photons);
    free(together.photons);
    free(each.photons);
    aur_sampler_destroy(sampler);
    aur_elements_release(&elements);
    aur_scene_destroy(scene);
}

static void store_last(void *user, const char *message) {
    snprintf(user, 256, "%s", message);
}

/* Without absorption no path ends except by rounding: they are truncated, counted and reported. None is if a
 * furnace absorbs half of the light. */
static void endless_paths_are_reported(void **state) {
    (void)state;
    aur_scene *const white = must_load_body(
                         "<shape type='cube'><boolean name='flip_normals' value='true'/><bsdf type='diffuse'>"
                         "<rgb name='reflectance' value='1'/></bsdf><emitter type='area'/></shape>"),
                     *const grey = load_furnace();
    for (size_t i = 0; i < 2; ++i) {
        char message[256] = "";
        const aur_photon_options options = {
            .count = 4000, .max_edges = SIZE_MAX, .seed = 7, .warnings = {store_last, message}};
        const aur_scene *const scene = i == 0 ? white : grey;
        aur_elements elements;
        assert_int_equal(aur_elements_create(scene, &elements), AUR_OK);
        aur_photon_map map;
        assert_int_equal(aur_photon_map_create(scene, &elements, &options, &map, NULL), AUR_OK);
        assert_in_range(map.cut, i == 0 ? map.paths * 9 / 10 : 0, i == 0 ? map.paths : 0);
        assert_int_equal(strstr(message, "particles were cut after 512 edges") != NULL, i == 0);
        aur_photon_map_release(&map);
        aur_elements_release(&elements);
    }
    aur_scene_destroy(white);
    aur_scene_destroy(grey);
}

/* A diffuse furnace has no caustics: an empty map needs as many particles as photons, whole batches of 16384
 * on top, and is an error where photons are required. */
static void empty_maps_end_early(void **state) {
    (void)state;
    enum { PHOTONS = 40000, BATCH = 16384 };
    aur_scene *const scene = load_furnace(), *const unlit = must_load_body(
                                                 "<shape type='rectangle'><emitter type='area'/></shape>");
    aur_photon_options options = {
        .count = PHOTONS, .max_edges = SIZE_MAX, .seed = 7, .kind = AUR_PHOTONS_CAUSTIC};
    aur_elements elements;
    aur_photon_map map;
    aur_error error = {0};
    assert_int_equal(aur_elements_create(scene, &elements), AUR_OK);
    assert_int_equal(aur_photon_map_create(scene, &elements, &options, &map, &error), AUR_OK);
    assert_int_equal(map.count, 0);
    assert_in_range(map.paths, PHOTONS + BATCH, PHOTONS + 2 * BATCH);
    aur_photon_map_release(&map);
    aur_elements_release(&elements);
    options.kind = AUR_PHOTONS_ALL;
    assert_int_equal(aur_elements_create(unlit, &elements), AUR_OK);
    assert_int_equal(aur_photon_map_create(unlit, &elements, &options, &map, &error), AUR_ERROR_UNSUPPORTED);
    unsigned paths = 0;
    assert_int_equal(sscanf(error.message, "photon map: 0 photons stored after %u", &paths), 1);
    assert_in_range(paths, PHOTONS + BATCH, PHOTONS + 2 * BATCH);
    aur_elements_release(&elements);
    aur_scene_destroy(scene);
    aur_scene_destroy(unlit);
}

/* A ball of so many small triangles that each texel has many, under an even sky. */
static aur_scene *load_ball(void) {
    enum { ROWS = 96, COLUMNS = 192 };
    char *text;
    size_t size;
    FILE *const file = open_memstream(&text, &size);
    assert_non_null(file);
    for (size_t i = 0; i <= ROWS; ++i)
        for (size_t j = 0; j < COLUMNS; ++j) {
            const double theta = AUR_PI * (double)i / ROWS, phi = 2.0 * AUR_PI * (double)j / COLUMNS;
            fprintf(file, "v %.9g %.9g %.9g\n", sin(theta) * cos(phi), sin(theta) * sin(phi), cos(theta));
        }
    for (size_t i = 0; i < ROWS; ++i)
        for (size_t j = 1; j <= COLUMNS; ++j) {
            const size_t upper = i * COLUMNS, lower = upper + COLUMNS, next = j % COLUMNS + 1;
            if (i > 0)
                fprintf(file, "f %zu %zu %zu\n", upper + j, lower + j, upper + next);
            if (i < ROWS - 1)
                fprintf(file, "f %zu %zu %zu\n", upper + next, lower + j, lower + next);
        }
    fclose(file);
    write_file("ball.obj", text, size);
    free(text);
    return must_load_body("<shape type='obj'><string name='filename' value='ball.obj'/></shape>"
                          "<emitter type='constant'/>");
}

/* A texel much smaller than a photon's share of the area would hold one seldom, and then shine more than any
 * light: cubes of the grid cut such corners from a ball, and its faces change direction there. All that
 * photons bring is still in the texels, whose area is the triangles'. */
static void texels_are_not_slivers(void **state) {
    (void)state;
    aur_scene *const scene = load_ball();
    for (size_t photons = 500; photons <= 8000; photons *= 4) {
        aur_irradiance_map *const map = make_map(scene, photons, 0);
        double area = 0.0, least = INFINITY, power = 0.0;
        for (size_t i = 0; i < map->texels.count; ++i) {
            const double here = (double)map->texels.areas[i];
            area += here;
            least = here > 0.0 ? fmin(least, here) : least;
            power += here * (double)map->lights[2 * i].irradiance.y;
        }
        assert_relative(area, 4.0 * AUR_PI, 1e-3); /* of the triangles, 1/3,000 less than the ball's */
        assert_relative(power, 4.0 * AUR_PI * AUR_PI, 5.0 / sqrt((double)photons));
        /* The lit area is known from the photons to a few hundredths. */
        assert_true(least >= 0.8 * 4.0 * AUR_PI / (double)map->photons);
        aur_irradiance_map_destroy(map);
    }
    aur_scene_destroy(scene);
}

/* Texels lose no photon and count none twice: their total area is that of the walls, their power that of the
 * photons, to rounding. */
static void texels_hold_all_the_power(void **state) {
    (void)state;
    aur_scene *const scene = load_furnace();
    aur_irradiance_map *const map = make_map(scene, 40000, 0);
    const aur_photon_options options = {.count = 40000, .max_edges = SIZE_MAX, .seed = 7};
    aur_photon_map photons;
    assert_int_equal(aur_photon_map_create(scene, &map->texels.elements, &options, &photons, NULL), AUR_OK);
    double area = 0.0, power = 0.0, brought = 0.0;
    for (size_t i = 0; i < map->texels.count; ++i)
        area += (double)map->texels.areas[i];
    for (size_t i = 0; i < 2 * map->texels.count; ++i)
        power += (double)map->lights[i].irradiance.y * (double)map->lights[i].area;
    for (size_t i = 0; i < photons.count; ++i)
        brought += (double)photons.photons[i].power.y;
    assert_relative(area, 24.0, 1e-5);
    assert_relative(power, brought, 1e-5);
    aur_photon_map_release(&photons);
    aur_irradiance_map_destroy(map);
    aur_scene_destroy(scene);
}

/* A direct density estimate: the photons within a radius, over the part of the disc that the wall has. */
static double estimate_directly(const aur_scene *scene, const aur_elements *elements,
                                const aur_photon_map *photons, aur_vector position, aur_vector normal,
                                float radius) {
    double power = 0.0;
    for (size_t i = 0; i < photons->count; ++i) {
        const aur_photon *const photon = &photons->photons[i];
        aur_vector side;
        const aur_vector offset = aur_vector_subtract(place(scene, elements, photon, &side), position);
        if (aur_vector_dot(side, normal) > 0.99f && aur_vector_length(offset) < radius)
            power += (double)photon->power.y;
    }
    return power / (AUR_PI * (double)radius * (double)radius);
}

/* The radiance of a look-up at a grid of points on the wall z = -1, seen from inside, against the direct
 * estimate there and against the exact 1/2. A texel has about 32 photons and a disc of radius 0.1 about 130
 * of 100000, so the two scatter by 18 and 9 % at most; the means over 64 points by an eighth of that, of
 * which 5 are allowed. */
static void lookups_agree_with_density_estimates(void **state) {
    (void)state;
    aur_scene *const scene = load_furnace();
    aur_irradiance_map *const map = make_map(scene, 100000, 0);
    const aur_photon_options options = {.count = 100000, .max_edges = SIZE_MAX, .seed = 7};
    aur_photon_map photons;
    assert_int_equal(aur_photon_map_create(scene, &map->texels.elements, &options, &photons, NULL), AUR_OK);
    double looked_up = 0.0, estimated = 0.0;
    for (size_t i = 0; i < 64; ++i) {
        const aur_vector target = {-0.875f + 0.25f * (float)(i % 8), -0.875f + 0.25f * (float)(i / 8), -1.0f};
        const aur_ray ray = {
            .origin = {target.x, target.y, 0.0f}, .direction = {0.0f, 0.0f, -1.0f}, .farthest = INFINITY};
        aur_hit hit;
        assert_true(aur_scene_intersect(scene, &ray, &hit));
        aur_surface surface;
        aur_scene_surface(scene, &ray, &hit, &surface);
        const aur_vector view = {0.0f, 0.0f, 1.0f};
        looked_up += (double)aur_irradiance_view(map, scene, &hit, &surface, view).radiance.y / 64.0;
        estimated += 0.5 / AUR_PI *
                     estimate_directly(scene, &map->texels.elements, &photons, target, view, 0.1f) / 64.0;
    }
    assert_relative(looked_up, 0.5, 5.0 * 0.18 / 8.0);
    assert_relative(looked_up, estimated, 5.0 * 0.20 / 8.0);
    aur_photon_map_release(&photons);
    aur_irradiance_map_destroy(map);
    aur_scene_destroy(scene);
}

/* No light leaks through a wall: behind the furnace's, where no photon came, all is black. */
static void unlit_sides_stay_dark(void **state) {
    (void)state;
    aur_scene *const scene = load_furnace();
    aur_irradiance_map *const map = make_map(scene, 20000, 0);
    size_t lit = 0, dark = 0;
    for (size_t i = 0; i < map->texels.count; ++i) {
        const float front = map->lights[2 * i].irradiance.y, behind = map->lights[2 * i + 1].irradiance.y;
        lit += front > 0.0f || behind > 0.0f ? 1 : 0;
        dark += front == 0.0f || behind == 0.0f ? 1 : 0;
    }
    assert_int_equal(dark, map->texels.count);
    assert_true(lit > map->texels.count * 9 / 10);
    aur_irradiance_map_destroy(map);
    aur_scene_destroy(scene);
}

/* Every point of a triangle, and no other, has a texel; the parts have equal areas. */
static void triangle_texels_cover_it_evenly(void **state) {
    (void)state;
    for (uint32_t side = 1; side <= 9; side += 4) {
        const aur_texel_range range = {100, side};
        size_t counts[81] = {0}, points = 0;
        for (size_t i = 0; i < 400; ++i)
            for (size_t k = 0; i + k < 400; ++k) {
                const float u = ((float)i + 1.0f / 3.0f) / 400.0f, v = ((float)k + 1.0f / 3.0f) / 400.0f;
                const uint32_t texel = aur_texel_of_triangle(range, u, v) - 100;
                assert_true(texel < side * side);
                ++counts[texel];
                ++points;
            }
        for (size_t t = 0; t < (size_t)side * side; ++t)
            assert_relative((double)counts[t] * side * side, (double)points, 0.12);
    }
    const aur_texel_range range = {7, 5};
    assert_int_equal(aur_texel_of_triangle(range, 1.0f, 0.0f), 7 + 24);
    assert_int_equal(aur_texel_of_triangle(range, 0.0f, 1.0f), 7 + 8);
    assert_int_equal(aur_texel_of_square(range, 1.0f, 1.0f), 7 + 24);
}

static void does_not_depend_on_threads(void **state) {
    (void)state;
    aur_scene *const scene = load_furnace();
    aur_irradiance_map *const one = make_map(scene, 20000, 1);
    aur_irradiance_map *const three = make_map(scene, 20000, 3);
    assert_int_equal(one->texels.count, three->texels.count);
    assert_int_equal(one->photons, three->photons);
    assert_memory_equal(one->lights, three->lights, 2 * one->texels.count * sizeof *one->lights);
    aur_irradiance_map_destroy(one);
    aur_irradiance_map_destroy(three);
    aur_scene_destroy(scene);
}

/* Any set of the square serves the particles, and short tables begin again. */
static void photons_come_from_any_set(void **state) {
    (void)state;
    static const char *const sets[] = {"random", "halton", "r2", "niederreiter"};
    aur_scene *const scene = load_furnace();
    for (size_t i = 0; i < sizeof sets / sizeof sets[0]; ++i) {
        aur_sampler *sampler;
        assert_int_equal(aur_sampler_create(sets[i], 20000, NULL, &sampler, NULL), AUR_OK);
        aur_irradiance_map_options options = {
            .photons = {.count = 20000, .max_edges = SIZE_MAX, .sampler = sampler, .seed = 7},
            .photons_a_texel = 1e5};
        aur_irradiance_map *map = NULL;
        assert_int_equal(aur_irradiance_map_create(scene, &options, &map, NULL), AUR_OK);
        double power = 0.0;
        for (size_t k = 0; k < 2 * map->texels.count; ++k)
            power += (double)map->lights[k].irradiance.y * (double)map->lights[k].area;
        assert_relative(power, 24.0 * AUR_PI, 5.0 * sqrt(2.0 / (double)map->paths) / 2.0);
        aur_irradiance_map_destroy(map);
        aur_sampler_destroy(sampler);
    }
    aur_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(photons_bring_all_the_power),
        cmocka_unit_test(particles_are_the_single_ones),
        cmocka_unit_test(endless_paths_are_reported),
        cmocka_unit_test(empty_maps_end_early),
        cmocka_unit_test(texels_are_not_slivers),
        cmocka_unit_test(texels_hold_all_the_power),
        cmocka_unit_test(lookups_agree_with_density_estimates),
        cmocka_unit_test(unlit_sides_stay_dark),
        cmocka_unit_test(triangle_texels_cover_it_evenly),
        cmocka_unit_test(photons_come_from_any_set),
        cmocka_unit_test(does_not_depend_on_threads),
    };
    return cmocka_run_group_tests_name("irradiance", tests, enter_folder, leave_folder);
}
