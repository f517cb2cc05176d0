#include "scene_text.h"

#include "points/base/random.h"

static aur_scene *load_camera(const char *sensor) {
    char text[1024];
    snprintf(text, sizeof text, "<scene version='3.0.0'><sensor type='perspective'>%s</sensor></scene>",
             sensor);
    aur_scene *scene;
    aur_error error;
    if (aur_scene_load(write_text("camera.xml", text), NULL, &scene, &error) != AUR_OK)
        fail_msg("%s", error.message);
    return scene;
}

static aur_vector direction_at(const char *sensor, size_t width, size_t height, float x, float y) {
    aur_scene *const scene = load_camera(sensor);
    const float lens[2] = {0.5f, 0.5f};
    aur_ray ray;
    aur_camera_ray(scene, width, height, x, y, lens, &ray);
    aur_scene_destroy(scene);
    assert_near(aur_vector_length(ray.direction), 1.0, 1e-6);
    return ray.direction;
}

/* The image's left edge is +x of the camera, its top +y; `fov` spans the named axis. */
static void frames_the_image(void **state) {
    (void)state;
    static const struct {
        const char *axis;
        size_t width, height;
        double x, y; /* tangents of the left edge and the top edge, in units of tan(fov / 2) */
    } rows[] = {
        {"x", 200, 100, 1.0, 0.5},        {"y", 200, 100, 2.0, 1.0},      {"smaller", 200, 100, 2.0, 1.0},
        {"smaller", 100, 200, 1.0, 2.0},  {"larger", 200, 100, 1.0, 0.5}, {"larger", 100, 200, 0.5, 1.0},
        {"diagonal", 400, 300, 0.8, 0.6},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; ++i) {
        char sensor[256];
        snprintf(sensor, sizeof sensor, "<float name='fov' value='40'/><string name='fov_axis' value='%s'/>",
                 rows[i].axis);
        const float w = (float)rows[i].width, h = (float)rows[i].height;
        const double tangent = tan(20.0 * AUR_PI / 180.0);
        const aur_vector left = direction_at(sensor, rows[i].width, rows[i].height, 0.0f, 0.5f * h);
        assert_near(left.x / left.z, rows[i].x * tangent, 1e-6);
        assert_near(left.y, 0.0, 1e-7);
        const aur_vector top = direction_at(sensor, rows[i].width, rows[i].height, 0.5f * w, 0.0f);
        assert_near(top.y / top.z, rows[i].y * tangent, 1e-6);
        assert_near(top.x, 0.0, 1e-7);
    }
    /* 50 mm on 36 x 24: the image of that shape spans 36 mm. */
    const aur_vector edge =
        direction_at("<string name='focal_length' value='50mm'/>", 360, 240, 0.0f, 120.0f);
    assert_near(edge.x / edge.z, 18.0 / 50.0, 1e-6);
    /* With a principal point shifted by half a film, the centre ray is the former edge ray. */
    const aur_vector shifted =
        direction_at("<float name='fov' value='40'/><float name='principal_point_offset_x' value='-0.5'/>",
                     10, 10, 5.0f, 5.0f);
    assert_near(shifted.x / shifted.z, tan(20.0 * AUR_PI / 180.0), 1e-6);
}

static void moves_and_clips(void **state) {
    (void)state;
    aur_scene *const scene = load_camera(
        "<float name='fov' value='90'/><float name='near_clip' value='2'/><float name='far_clip' value='8'/>"
        "<transform name='to_world'><lookat origin='1,2,3' target='4,2,3' up='0,0,1'/></transform>");
    aur_ray ray;
    const float lens[2] = {0, 0};
    aur_camera_ray(scene, 100, 100, 50, 50, lens, &ray);
    assert_near(ray.origin.x, 1.0, 0.0);
    assert_near(ray.origin.y, 2.0, 0.0);
    assert_near(ray.origin.z, 3.0, 0.0);
    assert_near(ray.direction.x, 1.0, 1e-6);
    assert_near(ray.nearest, 2.0, 1e-6);
    assert_near(ray.farthest, 8.0, 1e-5);
    /* At the left edge, 45 degrees aside, the same depths are sqrt 2 farther. Left of +x with z up is +y. */
    aur_camera_ray(scene, 100, 100, 0, 50, lens, &ray);
    assert_near(ray.direction.y, sqrt(0.5), 1e-6);
    assert_near(ray.nearest, 2.0 * sqrt(2.0), 1e-5);
    assert_near(ray.farthest, 8.0 * sqrt(2.0), 1e-5);
    aur_scene_destroy(scene);
}

static aur_scene *load_sensor(const char *sensor) {
    char text[1024];
    snprintf(text, sizeof text, "<scene version='3.0.0'><sensor type='%s</sensor></scene>", sensor);
    aur_scene *scene;
    aur_error error;
    if (aur_scene_load(write_text("camera.xml", text), NULL, &scene, &error) != AUR_OK)
        fail_msg("%s", error.message);
    return scene;
}

/* Properties that define the filters: values at the centre and a pixel away, and the radius. The cubic ones
 * are interpolation weights: at pixel spacing they sum to 1 for any offset. */
static void values_of_filters(void **state) {
    (void)state;
    static const struct {
        const char *name;
        double radius, middle, neighbour;
        bool shares, whole;
    } rows[] = {{"box", 0.5, 1.0, 0.0, false, true},
                {"tent", 1.0, 1.0, 0.0, true, true},
                {"gaussian", 2.0, 0.99966453737, 0.13499982060, true, false},
                {"mitchell", 2.0, 8.0 / 9.0, 1.0 / 18.0, true, true},
                {"catmullrom", 2.0, 1.0, 0.0, true, true},
                {"lanczos", 3.0, 1.0, 0.0, true, false}};
    for (size_t f = 0; f < sizeof rows / sizeof rows[0]; ++f) {
        const aur_filter *const filter = aur_filter_find(rows[f].name);
        assert_near(aur_filter_radius(filter), rows[f].radius, 0.0);
        assert_near(aur_filter_value(filter, 0.0), rows[f].middle, 1e-8);
        assert_near(aur_filter_value(filter, -1.0), rows[f].neighbour, 1e-8);
        assert_near(aur_filter_value(filter, rows[f].radius + 1e-9), 0.0, 0.0);
        assert_int_equal(aur_filter_shares_samples(filter), rows[f].shares);
        for (double at = -0.45; at < 0.5 && rows[f].whole; at += 0.1) {
            double sum = 0.0;
            for (int i = -3; i <= 3; ++i)
                sum += aur_filter_value(filter, at + i);
            assert_near(sum, 1.0, 1e-6);
        }
    }
    /* sinc(1/2) sinc(1/6) */
    assert_near(aur_filter_value(aur_filter_find("lanczos"), 0.5), 2.0 / AUR_PI * 3.0 / AUR_PI, 1e-12);
}

/* Rays of one film point leave the disk of the aperture and meet in the plane of focus. */
static void focuses(void **state) {
    (void)state;
    aur_scene *const scene = load_sensor("thinlens'><float name='fov' value='60'/>"
                                         "<float name='aperture_radius' value='0.5'/>"
                                         "<float name='focus_distance' value='4'/>");
    double widest = 0.0;
    for (size_t i = 0; i < 200; ++i) {
        const float lens[2] = {aur_unit_float((uint32_t)(aur_hash2(1, i) >> 32)),
                               aur_unit_float((uint32_t)(aur_hash2(2, i) >> 32))};
        aur_ray ray;
        aur_camera_ray(scene, 200, 100, 50.0f, 25.0f, lens, &ray);
        const float t = (4.0f - ray.origin.z) / ray.direction.z;
        assert_near(ray.origin.x + t * ray.direction.x, 4.0 * 0.28867513, 1e-5);
        assert_near(ray.origin.y + t * ray.direction.y, 4.0 * 0.14433757, 1e-5);
        assert_near(ray.origin.z, 0.0, 0.0);
        widest = fmax(widest, hypot(ray.origin.x, ray.origin.y));
    }
    assert_true(widest <= 0.5 + 1e-6 && widest > 0.45);
    aur_scene_destroy(scene);
}

static void sees_in_parallel(void **state) {
    (void)state;
    aur_scene *const scene = load_sensor("orthographic'><float name='near_clip' value='1'/>"
                                         "<transform name='to_world'><scale value='3'/></transform>");
    aur_ray ray;
    aur_camera_ray(scene, 200, 100, 0.0f, 0.0f, (const float[2]){0, 0}, &ray);
    assert_near(ray.origin.x, 3.0, 1e-6); /* +x is the left of the image */
    assert_near(ray.origin.y, 1.5, 1e-6);
    assert_near(ray.direction.z, 1.0, 0.0);
    assert_near(ray.nearest, 3.0, 1e-6);
    aur_scene_destroy(scene);
}

/* Sixteen rays at once have the bits of single ones, for every camera. */
static void sixteen_rays_are_the_single_ones(void **state) {
    (void)state;
    static const char *const sensors[] = {
        ("perspective'><float name='fov' value='50'/><float name='near_clip' value='0.3'/><transform "
         "name='to_world'><lookat origin='1,2,3' target='-0.3,0.4,0.1' up='0,1,0'/></transform>"),
        "thinlens'><float name='aperture_radius' value='0.5'/><float name='focus_distance' value='4'/>",
        "orthographic'><transform name='to_world'><scale value='3'/></transform>"};
    for (size_t i = 0; i < sizeof sensors / sizeof sensors[0]; ++i) {
        aur_scene *const scene = load_sensor(sensors[i]);
        float x[AUR_CAMERA_LANES], y[AUR_CAMERA_LANES], u[AUR_CAMERA_LANES], v[AUR_CAMERA_LANES];
        for (size_t k = 0; k < AUR_CAMERA_LANES; ++k) {
            x[k] = 200.0f * aur_unit_float((uint32_t)(aur_hash2(1, k) >> 32));
            y[k] = 90.0f * aur_unit_float((uint32_t)(aur_hash2(2, k) >> 32));
            u[k] = aur_unit_float((uint32_t)(aur_hash2(3, k) >> 32));
            v[k] = aur_unit_float((uint32_t)(aur_hash2(4, k) >> 32));
        }
        aur_camera_lanes rays;
        aur_camera_rays(scene, 200, 90, x, y, u, v, &rays);
        for (size_t k = 0; k < AUR_CAMERA_LANES; ++k) {
            aur_ray ray;
            aur_camera_ray(scene, 200, 90, x[k], y[k], (const float[2]){u[k], v[k]}, &ray);
            assert_true(ray.origin.x == rays.origin[0][k] && ray.origin.y == rays.origin[1][k] &&
                        ray.origin.z == rays.origin[2][k]);
            assert_true(ray.direction.x == rays.direction[0][k] && ray.direction.y == rays.direction[1][k] &&
                        ray.direction.z == rays.direction[2][k]);
            assert_true(ray.nearest == rays.nearest[k] && ray.farthest == rays.farthest[k]);
        }
        aur_scene_destroy(scene);
    }
}

/* Distribution functions of the filters, in their units. */
static double filter_mass(const char *name, double x) {
    if (strcmp(name, "box") == 0)
        return x + 0.5;
    if (strcmp(name, "tent") == 0)
        return x < 0.0 ? 0.5 * (1.0 + x) * (1.0 + x) : 1.0 - 0.5 * (1.0 - x) * (1.0 - x);
    const double level = exp(-8.0);
    const double t = x / 0.5;
    const double total = 2.0 * (sqrt(AUR_PI / 2.0) * erf(4.0 / sqrt(2.0)) - level * 4.0);
    return 0.5 + (sqrt(AUR_PI / 2.0) * erf(t / sqrt(2.0)) - level * t) / total;
}

static void samples_filters(void **state) {
    (void)state;
    static const char *const names[] = {"box", "tent", "gaussian"};
    for (size_t f = 0; f < 3; ++f) {
        const aur_filter *const filter = aur_filter_find(names[f]);
        assert_string_equal(aur_filter_name(filter), names[f]);
        float previous = -INFINITY;
        for (size_t i = 0; i < 10000; ++i) {
            const float u = ((float)i + 0.25f) / 10000.0f;
            const float x = aur_filter_sample(filter, u);
            assert_near(filter_mass(names[f], x), u, 2e-6);
            assert_true(x >= previous);
            previous = x;
        }
        assert_true(isfinite(aur_filter_sample(filter, 0.0f)));
        assert_true(isfinite(aur_filter_sample(filter, 0x1.fffffep-1f)));
    }
    assert_null(aur_filter_find("sinc"));
}

/* aur_camera_see undoes aur_camera_ray, also of a mirrored and scaled camera; the pixel's solid angle is the
 * area that its corners' unit vectors span. */
static void finds_where_a_direction_is_seen(void **state) {
    (void)state;
    static const char *const transforms[] = {
        "<lookat origin='1,2,3' target='4,1,2' up='0,0,1'/>",
        "<scale value='3'/><lookat origin='1,2,3' target='-4,1,2' up='0,1,0'/>",
        "<scale x='-1'/><lookat origin='1,2,3' target='-4,1,2' up='0,1,0'/>",
    };
    for (size_t k = 0; k < sizeof transforms / sizeof transforms[0]; ++k) {
        char sensor[400];
        snprintf(
            sensor, sizeof sensor,
            "<float name='fov' value='70'/><string name='fov_axis' value='y'/>"
            "<float name='principal_point_offset_x' value='0.1'/><transform name='to_world'>%s</transform>",
            transforms[k]);
        aur_scene *const scene = load_camera(sensor);
        assert_true(aur_camera_is_pinhole(scene));
        const float lens[2] = {0.5f, 0.5f};
        for (uint64_t i = 0; i < 50; ++i) {
            const float x = (float)(aur_hash2(i, 0) % 320), y = (float)(aur_hash2(i, 1) % 200);
            aur_ray ray, right, below;
            aur_film_point point;
            aur_camera_ray(scene, 320, 200, x, y, lens, &ray);
            aur_camera_ray(scene, 320, 200, x + 1.0f, y, lens, &right);
            aur_camera_ray(scene, 320, 200, x, y + 1.0f, lens, &below);
            assert_true(aur_camera_see(scene, 320, 200, ray.direction, &point));
            assert_near(point.x, x, 1e-3);
            assert_near(point.y, y, 1e-3);
            const double area = (double)aur_vector_length(
                aur_vector_cross(aur_vector_subtract(right.direction, ray.direction),
                                 aur_vector_subtract(below.direction, ray.direction)));
            assert_near(point.solid_angle, area, 0.03 * area); /* a pixel is up to .01 wide */
            assert_false(aur_camera_see(scene, 320, 200, aur_vector_scale(ray.direction, -1.0f), &point));
        }
        assert_near(aur_vector_length(
                        aur_vector_subtract(aur_camera_position(scene), (aur_vector){1.0f, 2.0f, 3.0f})),
                    0.0, 1e-5);
        aur_scene_destroy(scene);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(frames_the_image),
        cmocka_unit_test(moves_and_clips),
        cmocka_unit_test(samples_filters),
        cmocka_unit_test(values_of_filters),
        cmocka_unit_test(focuses),
        cmocka_unit_test(sees_in_parallel),
        cmocka_unit_test(finds_where_a_direction_is_seen),
        cmocka_unit_test(sixteen_rays_are_the_single_ones),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
