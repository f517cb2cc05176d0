#include "render/scene/scene_data.h"
#include "scene_text.h"

#include "points/base/random.h"
#include "render/scene/elements.h"
#include "render/scene/materials/sampling.h"

static float unit(uint64_t a, uint64_t b) {
    return aur_unit_float((uint32_t)(aur_hash2(a, b) >> 32));
}

/* Two curves of 4 and 5 points, with windows line ends and a comment. */
static const char *const hair =
    "-1 0 0 .2\r\n-.2 .6 .1 .15\r\n.5 .2 -.1 .25\r\n1.1 .7 .2 .2\r\n\r\n\r\n"
    "# another\r\n0 -1 .5 .1\n.1 -.5 -.2 .2\n.3 .1 .3 .1\n-.2 .5 .6 .15\n-.4 1 0 .2\n";

static aur_scene *load_curves(const char *plugin, const char *text, const char *more) {
    write_text("hair.txt", text);
    char body[512];
    snprintf(body, sizeof body, "<shape type='%s'><string name='filename' value='hair.txt'/>%s</shape>",
             plugin, more);
    return must_load_body(body);
}

/* |p - C(u)| - r(u) of a segment, with C' at *slope. */
static double beyond(const aur_curves *curves, size_t segment, double u, const double p[3], double slope[3]) {
    const float *const point = &curves->points[4 * (size_t)curves->firsts[segment]];
    const double v = 1.0 - u;
    const double cubic[4] = {v * v * v / 6.0, (3.0 * u * u * u - 6.0 * u * u + 4.0) / 6.0,
                             (3.0 * v * v * v - 6.0 * v * v + 4.0) / 6.0, u * u * u / 6.0};
    const double cubic_slope[4] = {-0.5 * v * v, 1.5 * u * u - 2.0 * u, 2.0 * v - 1.5 * v * v, 0.5 * u * u};
    const double unscattered[4] = {v, u, 0.0, 0.0}, straight_slope[4] = {-1.0, 1.0, 0.0, 0.0};
    const double *const weight = curves->smooth ? cubic : unscattered;
    const double *const change = curves->smooth ? cubic_slope : straight_slope;
    double squared = 0.0, radius = 0.0;
    for (size_t k = 0; k < 4; ++k) {
        double center = 0.0, along = 0.0;
        for (size_t i = 0; i < (curves->smooth ? 4u : 2u); ++i) {
            center += weight[i] * (double)point[4 * i + k];
            along += change[i] * (double)point[4 * i + k];
        }
        if (k == 3) {
            radius = center;
        } else {
            squared += (p[k] - center) * (p[k] - center);
            slope[k] = along;
        }
    }
    return sqrt(squared) - radius;
}

/* How far outside of all rounded cones a point is: each is the union of balls along its segment. */
static double outside_cones(const aur_curves *curves, const double p[3]) {
    double least = HUGE_VAL, unused[3];
    for (size_t s = 0; s < curves->segment_count; ++s) {
        double low = 0.0, high = 1.0; /* a convex function of u */
        for (size_t step = 0; step < 60; ++step) {
            const double a = low + (high - low) / 3.0, b = high - (high - low) / 3.0;
            if (beyond(curves, s, a, p, unused) < beyond(curves, s, b, p, unused))
                high = b;
            else
                low = a;
        }
        least = fmin(least, beyond(curves, s, low, p, unused));
    }
    return least;
}

/* Hits lie on the surface of the definition, and normals are orthogonal to differences of neighbouring hits;
 * nothing is hit from inside, or again by rays that leave. */
static void hits_curves(void **state) {
    (void)state;
    static const char *const plugins[] = {"linearcurve", "bsplinecurve"};
    for (size_t n = 0; n < 2; ++n) {
        aur_scene *const scene = load_curves(plugins[n], hair, "");
        const aur_curves *const curves = &scene->shapes[0]->curves;
        assert_int_equal(curves->segment_count, n == 0 ? 7 : 3);
        size_t hits = 0, normals = 0;
        for (size_t i = 0; i < 20000; ++i) {
            const aur_vector origin = aur_vector_scale(aur_sample_sphere(unit(1, i), unit(2, i)), 4.0f);
            const aur_vector target = {2.0f * unit(3, i) - 1.0f, 2.0f * unit(4, i) - 1.0f, unit(5, i) - 0.5f};
            aur_ray ray = {origin, 0.0f, aur_vector_normalize(aur_vector_subtract(target, origin)), INFINITY};
            aur_hit hit;
            aur_surface surface;
            if (!aur_scene_intersect(scene, &ray, &hit))
                continue;
            ++hits;
            assert_true(aur_scene_occluded(scene, &ray));
            aur_scene_surface(scene, &ray, &hit, &surface);
            const double p[3] = {surface.position.x, surface.position.y, surface.position.z};
            double slope[3];
            assert_true(hit.primitive < curves->segment_count);
            assert_near(beyond(curves, hit.primitive, hit.u, p, slope), 0.0, 2e-5);
            if (n == 0)
                assert_near(outside_cones(curves, p), 0.0, 2e-5);
            assert_near(((float)hit.primitive + hit.u) / (float)curves->segment_count, surface.texture.v,
                        1e-6);
            assert_true(surface.texture.u >= 0.0f && surface.texture.u <= 1.0f);
            const aur_vector normal = surface.geometric_normal;
            assert_near(aur_vector_length(normal), 1.0, 1e-5);
            assert_true(aur_vector_dot(normal, ray.direction) < 1e-3f);
            /* Two neighbouring rays hit the tangent plane, within the square of their distance over a radius.
             */
            for (size_t side = 0; side < 2 && aur_vector_dot(normal, ray.direction) < -0.3f; ++side) {
                const aur_frame frame = aur_frame_about(ray.direction);
                const float step = 1e-3f;
                aur_ray shifted = ray;
                shifted.origin = aur_vector_add_scaled(ray.origin, step, side == 0 ? frame.x : frame.y);
                aur_hit other;
                aur_surface there;
                if (!aur_scene_intersect(scene, &shifted, &other) || other.primitive != hit.primitive)
                    continue;
                aur_scene_surface(scene, &shifted, &other, &there);
                const aur_vector way = aur_vector_subtract(there.position, surface.position);
                ++normals;
                assert_near(aur_vector_dot(way, normal) / aur_vector_length(way), 0.0, 0.03);
            }
            const aur_ray away = aur_surface_ray(&surface, aur_vector_normalize(normal));
            aur_hit next;
            if (aur_scene_intersect(scene, &away, &next))
                assert_true(next.distance > 0.01f || next.primitive != hit.primitive);
            aur_ray inwards = {.origin = aur_vector_add_scaled(surface.position, -0.05f, normal),
                               .direction = ray.direction,
                               .farthest = 0.05f};
            assert_false(n == 0 && aur_scene_intersect(scene, &inwards, &hit));
        }
        assert_true(hits > 2000 && normals > 2000);
        aur_scene_destroy(scene);
    }
}

/* A straight spline with equidistant points is a tube of its radius; its area and texture are known.
 * `to_world` moves points and preserves radii. */
static void knows_a_tube(void **state) {
    (void)state;
    aur_scene *const scene =
        load_curves("bsplinecurve", "0 0 -2 .25\n0 0 -1 .25\n0 0 0 .25\n0 0 1 .25\n0 0 2 .25\n0 0 3 .25\n",
                    "<transform name='to_world'><scale value='2'/><translate x='5'/></transform>");
    aur_elements elements;
    assert_int_equal(aur_elements_create(scene, &elements), AUR_OK);
    assert_int_equal(elements.count, 3);
    assert_relative(aur_element_area(scene, &elements.placements[0], 1), 2.0 * AUR_PI * 0.25 * 2.0, 1e-6);
    aur_elements_release(&elements);
    const aur_ray ray = {{5.1f, 9.0f, 1.0f}, 0.0f, {0.0f, -1.0f, 0.0f}, INFINITY};
    aur_hit hit;
    aur_surface surface;
    assert_true(aur_scene_intersect(scene, &ray, &hit));
    aur_scene_surface(scene, &ray, &hit, &surface);
    assert_near(surface.position.y, sqrt(0.25 * 0.25 - 0.1 * 0.1), 1e-5);
    assert_near(surface.geometric_normal.x, 0.4, 1e-4);
    assert_near(surface.texture.u, acos(0.4) / (2.0 * AUR_PI), 1e-4);
    assert_near(surface.texture.v, (1.0 + 0.5) / 3.0, 1e-4);
    aur_scene_destroy(scene);
}

static void says_what_is_wrong(void **state) {
    (void)state;
    static const struct {
        const char *plugin, *text, *more, *words;
    } rows[] = {
        {"linearcurve", "0 0 0 .1\n\n0 1 0 .1\n1 1 0 .1\n", "",
         "a curve must have at least 2 points (found 1)"},
        {"bsplinecurve", "0 0 0 .1\n1 0 0 .1\n2 0 0 .1\n", "",
         "a curve must have at least 4 points (found 3)"},
        {"linearcurve", "0 0 0 .1\n0 1 x .1\n", "", "hair.txt:2: expected a point 'x y z radius'"},
        {"linearcurve", "0 0 0\n0 1 0\n", "", "expected a point 'x y z radius'"},
        {"linearcurve", "0 0 0 -1\n0 1 0 1\n", "", "a radius is below 0"},
        {"linearcurve", "0 nan 0 1\n0 1 0 1\n", "", "not finite"},
        {"linearcurve", "# none\n\n", "", "no curve in this file"},
        {"linearcurve", "0 0 0 1\n0 1 0 1\n", "<emitter type='area'/>", "cannot be a light"},
        {"linearcurve", "0 0 0 1\n0 1 0 1\n", "<boolean name='face_normals' value='true'/>", "face_normals"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; ++i) {
        write_text("hair.txt", rows[i].text);
        char body[512], text[1024];
        snprintf(body, sizeof body, "<shape type='%s'><string name='filename' value='hair.txt'/>%s</shape>",
                 rows[i].plugin, rows[i].more);
        aur_scene *scene = NULL;
        aur_error error = {0};
        assert_int_not_equal(load_body(body, NULL, &scene, &error), AUR_OK);
        aur_error_format(&error, sizeof text, text);
        if (strstr(text, rows[i].words) == NULL)
            fail_msg("'%s' does not say '%s'", text, rows[i].words);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(hits_curves),
        cmocka_unit_test(knows_a_tube),
        cmocka_unit_test(says_what_is_wrong),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
