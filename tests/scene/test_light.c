#include "scene_text.h"

#include "core/random.h"
#include "material/sampling.h"

/* Two lights of unequal power: a sheared rectangle and a turned tetrahedron with a corner cut from an OBJ
 * file. */
static aur_scene *load_lights(void) {
    write_text("tetra.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
    return must_load_body(
        "<shape type='rectangle'><transform name='to_world'><matrix value='1 .5 0 0  0 2 0 0  0 0 1 4  0 0 0 "
        "1'/>"
        "<rotate x='1' angle='180'/><translate z='8'/></transform>"
        "<emitter type='area'><rgb name='radiance' value='3 2 1'/></emitter></shape>"
        "<shape type='obj'><string name='filename' value='tetra.obj'/><boolean name='face_normals' "
        "value='true'/>"
        "<transform name='to_world'><scale value='1.5'/><rotate x='1' y='2' z='-1' angle='40'/>"
        "<translate x='3' y='1'/></transform><emitter type='area'><rgb name='radiance' "
        "value='1'/></emitter></shape>");
}

static float unit(uint64_t a, uint64_t b) {
    return aur_unit_float((uint32_t)(aur_hash2(a, b) >> 32));
}

/* Light that falls on a point from all sides (fluence), in two ways: by uniform directions that meet lights,
 * and by drawn points on lights. And asking says the pdf that sampling says. */
static void compare_with_brute_force(const aur_scene *scene, aur_vector reference) {
    enum { COUNT = 200000 };
    double direct[2] = {0, 0}, brute[2] = {0, 0};
    for (size_t i = 0; i < COUNT; ++i) {
        const float u[3] = {unit(1, i), unit(2, i), unit(3, i)};
        aur_light_sample sample;
        if (aur_light_sample_direct(scene, reference, u, &sample)) {
            const aur_surface eye = {.position = reference, .geometric_normal = sample.direction};
            float distance;
            const aur_ray ray = aur_surface_ray_to(&eye, sample.position, &distance);
            const double value =
                aur_scene_occluded(scene, &ray) ? 0.0 : (double)(sample.radiance.x / sample.pdf);
            direct[0] += value;
            direct[1] += value * value;
            if (value > 0.0 && i % 16 == 0 && sample.distance < 1e5f &&
                sample.pdf < 20.0f) { /* not grazing */
                aur_ray onward = ray;
                onward.farthest = INFINITY;
                aur_hit hit;
                aur_surface surface;
                if (!aur_scene_intersect(scene, &onward, &hit))
                    continue; /* beside a silhouette, by rounding */
                aur_scene_surface(scene, &onward, &hit, &surface);
                assert_relative(aur_light_pdf_direct(scene, reference, &surface), sample.pdf, 4e-3);
                assert_near(hit.distance, distance, 2e-3 * distance);
            }
        }
        const aur_ray ray = {reference, 0.0f, aur_sample_sphere(unit(4, i), unit(5, i)), INFINITY};
        aur_hit hit;
        double value = 4.0 * AUR_PI;
        if (aur_scene_intersect(scene, &ray, &hit)) {
            aur_surface surface;
            aur_scene_surface(scene, &ray, &hit, &surface);
            value *= (double)aur_surface_emission(scene, &surface, aur_vector_scale(ray.direction, -1.0f)).x;
        } else {
            value *= (double)aur_scene_environment(scene, ray.direction).x;
        }
        brute[0] += value;
        brute[1] += value * value;
    }
    const double mean = direct[0] / COUNT, other = brute[0] / COUNT;
    const double sigma = sqrt((direct[1] / COUNT - mean * mean + brute[1] / COUNT - other * other) / COUNT);
    assert_true(mean > 0.01);
    assert_near(mean, other, 4.5 * sigma); /* by chance in 7 of a million; the numbers are fixed */
}

static void draws_what_it_says(void **state) {
    (void)state;
    aur_scene *const scene = load_lights();
    assert_int_equal(aur_scene_emitter_count(scene), 2);
    compare_with_brute_force(scene, (aur_vector){0.5f, -0.25f, 1.0f});
    aur_scene_destroy(scene);
}

/* Each curved shape as a light, seen from outside and, where it shines inwards, from inside. */
static void draws_on_curved_lights(void **state) {
    (void)state;
    static const struct {
        const char *shape;
        aur_vector reference;
    } rows[] = {
        {"sphere'><point name='center' x='1' y='2' z='3'/><float name='radius' value='0.5'/>", {0, 0, 0}},
        {"sphere'><point name='center' x='1' y='0' z='0'/><float name='radius' value='0.99'/>", {0, 0, 0}},
        {"sphere'><float name='radius' value='3'/><boolean name='flip_normals' value='true'/>", {1, 2, 1}},
        {"disk'><transform name='to_world'><scale x='2' y='0.7'/><rotate x='1' angle='160'/><translate z='2' "
         "y='.3'/>"
         "</transform>",
         {0, 0, 0}},
        {"cylinder'><point name='p0' x='2' y='1' z='-1'/><point name='p1' x='2' y='2' z='2'/>"
         "<float name='radius' value='0.4'/>",
         {0, 0, 0}},
        {"cylinder'><float name='radius' value='2'/><boolean name='flip_normals' value='true'/>"
         "<transform name='to_world'><scale value='1.5'/></transform>",
         {0.5f, 0.2f, 0.7f}},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; ++i) {
        char body[1024];
        snprintf(body, sizeof body,
                 "<shape type='%s<emitter type='area'><float name='radiance' value='2'/></emitter></shape>",
                 rows[i].shape);
        aur_scene *const scene = must_load_body(body);
        compare_with_brute_force(scene, rows[i].reference);
        aur_scene_destroy(scene);
    }
}

/* Particles carry the lights' power: pi * area * radiance in all, whatever light they leave. */
static void particles_carry_the_power(void **state) {
    (void)state;
    aur_scene *const scene = load_lights();
    /* rectangle: |2 (1, 0) x 2 (.5, 2)| = 8; tetrahedron: 1.5^2 (3/2 + sqrt(3)/2) */
    const double expected = AUR_PI * (8.0 * 3.0 + 2.25 * (1.5 + 0.5 * sqrt(3.0)) * 1.0);
    double sum = 0.0, along = 0.0;
    enum { COUNT = 100000 };
    for (size_t i = 0; i < COUNT; ++i) {
        const float u[5] = {((float)i + 0.5f) / COUNT, unit(1, i), unit(2, i), unit(3, i), unit(4, i)};
        aur_ray ray;
        aur_vector power;
        assert_true(aur_light_emit(scene, u, &ray, &power));
        sum += (double)power.x;
        if (ray.origin.z > 3.5f)
            along += (double)-ray.direction.z; /* the rectangle faces down: mean cosine 2/3 */
        else
            along += 2.0 / 3.0;
    }
    assert_relative(sum / COUNT, expected, 1e-4);
    assert_near(along / COUNT, 2.0 / 3.0, 5.0 * sqrt(1.0 / 18.0 / COUNT));
    aur_scene_destroy(scene);
}

static void emits_on_one_side(void **state) {
    (void)state;
    aur_scene *const scene =
        must_load_body("<shape type='rectangle'><emitter type='area'/></shape>"
                       "<shape type='rectangle'><transform name='to_world'><translate x='5'/></transform>"
                       "<boolean name='flip_normals' value='true'/><emitter type='area'/></shape>"
                       /* a mirrored shape keeps its outside */
                       "<shape type='rectangle'><transform name='to_world'><scale x='-1'/><translate x='10'/>"
                       "</transform><emitter type='area'/></shape>");
    static const float side[3] = {1.0f, -1.0f, 1.0f};
    for (size_t i = 0; i < 3; ++i) {
        for (float z = -1.0f; z < 2.0f; z += 2.0f) {
            const aur_ray ray = {{5.0f * (float)i + 0.1f, 0.2f, z}, 0.0f, {0.0f, 0.0f, -z}, INFINITY};
            aur_hit hit;
            aur_surface surface;
            assert_true(aur_scene_intersect(scene, &ray, &hit));
            aur_scene_surface(scene, &ray, &hit, &surface);
            const aur_vector emitted = aur_surface_emission(scene, &surface, (aur_vector){0.0f, 0.0f, z});
            assert_near(emitted.y, z == side[i] ? 1.0 : 0.0, 0.0);
            assert_near(surface.geometric_normal.z, side[i], 0.0);
        }
    }
    aur_scene_destroy(scene);
}

static void refuses_lights_without_area(void **state) {
    (void)state;
    write_text("line.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
    aur_scene *scene;
    aur_error error;
    assert_int_equal(load_body("<shape type='obj'><string name='filename' value='line.obj'/>"
                               "<emitter type='area'/></shape>",
                               NULL, &scene, &error),
                     AUR_ERROR_FORMAT);
    assert_non_null(strstr(error.message, "no area"));
    /* no light at all is no error */
    scene = must_load_body("<shape type='cube'/>");
    aur_light_sample sample;
    assert_false(aur_light_sample_direct(scene, (aur_vector){0}, (const float[3]){0, 0, 0}, &sample));
    assert_false(aur_scene_has_environment(scene));
    aur_scene_destroy(scene);
}

/* Rays inside a closed box of slivers never leave it, and never meet the wall that they start from. */
static void closed_rooms_stay_closed(void **state) {
    (void)state;
    aur_scene *const scene = must_load_body(
        "<shape type='cube'><transform name='to_world'><scale x='300' y='270' z='1e-1'/>"
        "<rotate x='1' y='2' z='3' angle='77'/><translate x='278' y='273' z='-100'/></transform></shape>");
    size_t lost = 0, near_hits = 0;
    aur_surface surface = {.position = {278.0f, 273.0f, -100.0f}, .geometric_normal = {0.0f, 0.0f, 1.0f}};
    aur_ray ray = aur_surface_ray(&surface, (aur_vector){0.6f, 0.0f, 0.8f});
    for (size_t i = 0; i < 200000; ++i) {
        aur_hit hit;
        if (!aur_scene_intersect(scene, &ray, &hit)) {
            ++lost;
            ray = aur_surface_ray(
                &(aur_surface){.position = {278.0f, 273.0f, -100.0f}, .geometric_normal = {0.0f, 0.0f, 1.0f}},
                aur_sample_sphere(unit(7, i), unit(8, i)));
            continue;
        }
        aur_scene_surface(scene, &ray, &hit, &surface);
        near_hits += aur_vector_dot(ray.direction, surface.geometric_normal) < 0.0f; /* from outside */
        const aur_frame frame = aur_frame_about(aur_vector_scale(surface.geometric_normal, -1.0f));
        ray =
            aur_surface_ray(&surface, aur_frame_to_world(&frame, aur_sample_cosine(unit(9, i), unit(10, i))));
    }
    assert_int_equal(near_hits, 0);
    assert_int_equal(lost, 0);
    aur_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(draws_what_it_says),          cmocka_unit_test(draws_on_curved_lights),
        cmocka_unit_test(particles_carry_the_power),   cmocka_unit_test(emits_on_one_side),
        cmocka_unit_test(refuses_lights_without_area), cmocka_unit_test(closed_rooms_stay_closed),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
