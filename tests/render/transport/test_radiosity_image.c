#include "render/scene/scene_text.h"

#include <aureole-render/render.h>

#include "points/base/random.h"
#include "render/image/format.h"
#include "render/radiosity/image.h"

#define WALL                                                                                                 \
    "<bsdf type='diffuse'><rgb name='reflectance' value='0.5'/></bsdf>"                                      \
    "<emitter type='area'><rgb name='radiance' value='0.25'/></emitter>"
/* Keller's analytic setting with something to hide behind: radiance 1/2 everywhere. */
#define FURNISHED                                                                                            \
    "<shape type='cube'><boolean name='flip_normals' value='true'/>" WALL "</shape>"                         \
    "<shape type='cube'><transform name='to_world'><scale value='0.3'/><rotate y='1' angle='30'/>"           \
    "<translate x='0.3' y='-0.4' z='0.2'/></transform>" WALL "</shape>"

/* --- solid angles */

typedef struct vector3 {
    double v[3];
} vector3;

static vector3 minus(const double *a, const double *b) {
    return (vector3){{a[0] - b[0], a[1] - b[1], a[2] - b[2]}};
}

static double dot3(vector3 a, vector3 b) {
    return a.v[0] * b.v[0] + a.v[1] * b.v[1] + a.v[2] * b.v[2];
}

static vector3 cross3(vector3 a, vector3 b) {
    return (vector3){{a.v[1] * b.v[2] - a.v[2] * b.v[1], a.v[2] * b.v[0] - a.v[0] * b.v[2],
                      a.v[0] * b.v[1] - a.v[1] * b.v[0]}};
}

static double length3(vector3 a) {
    return sqrt(dot3(a, a));
}

/* The integral of the direction over a polygon's solid angle is half the sum of its edges' angles times the
 * normals of the planes through them (Lambert 1760), which tells whether drawn directions are uniform; and
 * each lies within the triangle. Means over 65536 points of a lattice: an error of some 1e-4. */
static void directions_are_uniform_in_the_solid_angle(void **state) {
    (void)state;
    static const double corners[][9] = {
        {1, 0, 0, 0, 1, 0, 0, 0, 1},                  /* an octant */
        {1, 0, 0.1, -0.5, 0.8, 0.1, -0.5, -0.8, 0.1}, /* nearly half the sphere */
        {5, 5, 1, 5.3, 5, 1, 5, 5.2, 1.1},            /* small */
        {30, 1, 1, 30.01, 1, 1.2, 30, 1.01, 1},       /* thin */
        {300, 1, 1, 300, 1.05, 1, 300, 1, 1.05},      /* so small that it is flat */
        {0, 0, 1, 1e-3, 0, 1, 0.5, 40, 1},            /* a needle */
    };
    static const double from[3] = {0.0, 0.0, 0.0};
    for (size_t i = 0; i < sizeof corners / sizeof corners[0]; ++i) {
        enum { COUNT = 65536 };
        const double *const c = corners[i];
        double direction[3], solid_angle = 0.0, sum[3] = {0};
        const vector3 normal = cross3(minus(&c[3], &c[0]), minus(&c[6], &c[0]));
        for (size_t k = 0; k < COUNT; ++k) {
            const double u = ((double)k + 0.5) / COUNT,
                         v = aur_unit_double((uint64_t)k * UINT64_C(0x9e3779b97f4a7c15));
            solid_angle = aur_spherical_triangle(c, from, u, v, direction);
            const vector3 d = {{direction[0], direction[1], direction[2]}};
            assert_near(length3(d), 1.0, 1e-12);
            const double distance =
                (c[0] * normal.v[0] + c[1] * normal.v[1] + c[2] * normal.v[2]) / dot3(d, normal);
            const double p[3] = {distance * direction[0], distance * direction[1], distance * direction[2]};
            /* Barycentric coordinates, by areas. */
            for (size_t e = 0; e < 3; ++e) {
                const vector3 part = cross3(minus(&c[3 * ((e + 1) % 3)], &c[3 * e]), minus(p, &c[3 * e]));
                assert_true(dot3(part, normal) >= -1e-9 * dot3(normal, normal));
            }
            for (size_t a = 0; a < 3; ++a)
                sum[a] += direction[a] / COUNT;
        }
        double lambert[3] = {0};
        for (size_t e = 0; e < 3; ++e) {
            const vector3 a = {{c[3 * e], c[3 * e + 1], c[3 * e + 2]}},
                          b = minus(&c[3 * ((e + 1) % 3)], from);
            const vector3 n = cross3(a, b);
            const double angle = atan2(length3(n), dot3(a, b));
            for (size_t k = 0; k < 3; ++k)
                lambert[k] += 0.5 * angle * n.v[k] / length3(n);
        }
        const double side =
            lambert[0] * sum[0] + lambert[1] * sum[1] + lambert[2] * sum[2] < 0.0 ? -1.0 : 1.0;
        for (size_t k = 0; k < 3; ++k)
            assert_near(solid_angle * sum[k], side * lambert[k], 2e-4 * solid_angle);
    }
    static const double octant[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1}, edge_on[9] = {1, 0, 0, 2, 0, 0, 0, 1, 0};
    double direction[3];
    assert_near(aur_spherical_triangle(octant, from, 0.5, 0.5, direction), AUR_PI / 2.0, 1e-14);
    assert_true(aur_spherical_triangle(edge_on, from, 0.5, 0.5, direction) == 0.0);
}

/* --- images */

enum { WIDTH = 24, HEIGHT = 18, PIXELS = WIDTH * HEIGHT };

/* The filter of the render; NULL: the scene's. */
static const char *drawn_by;

static aur_image *render(const aur_scene *scene, const char *integrator, size_t samples, size_t threads,
                         aur_render_statistics *statistics) {
    aur_renderer *renderer = NULL;
    aur_image *image = NULL;
    aur_error error = {0};
    const aur_render_options options = {.size = sizeof options,
                                        .integrator = integrator,
                                        .filter = drawn_by,
                                        .samples_per_pixel = samples,
                                        .width = WIDTH,
                                        .height = HEIGHT,
                                        .threads = threads};
    assert_int_equal(aur_renderer_create(scene, &renderer, &error), AUR_OK);
    if (aur_renderer_render(renderer, &options, &image, statistics, &error) != AUR_OK)
        fail_msg("%s", error.message);
    aur_renderer_destroy(renderer);
    return image;
}

/* Of the green channel: its mean and the standard error of that, pixels being independent. */
static void mean_of(const aur_image *image, double *mean, double *error) {
    double sum = 0.0, squares = 0.0;
    for (size_t i = 0; i < PIXELS; ++i) {
        const double value = image->data[3 * i + 1];
        sum += value;
        squares += value * value;
    }
    *mean = sum / PIXELS;
    *error = sqrt((squares / PIXELS - *mean * *mean) / PIXELS);
}

/* Three standard errors: one false alarm in 370 for a seed drawn again, none for this one. What the solution
 * itself is off, the same in all pixels, is below 5e-4. */
static void expect_mean(const aur_scene *scene, const char *integrator, size_t samples, double expected) {
    aur_image *const image = render(scene, integrator, samples, 2, NULL);
    double mean, error;
    mean_of(image, &mean, &error);
    if (!(fabs(mean - expected) <= 3.0 * error + 5e-4) || !(error < 0.02))
        fail_msg("%s: %g +- %g, not %g", integrator, mean, error, expected);
    aur_image_destroy(image);
}

/* Emission 1/4 + direct 1/8 + indirect 1/8 = 1/2. */
static void components_are_what_they_should_be(void **state) {
    (void)state;
    aur_scene *const scene = must_load_body(FURNISHED);
    expect_mean(scene, "radiosity:bounces=29,component=emission", 1, 0.25);
    expect_mean(scene, "radiosity:bounces=29,component=direct", 4, 0.125);
    expect_mean(scene, "radiosity:bounces=29,component=direct,light_sampling=all", 1, 0.125);
    expect_mean(scene, "radiosity:bounces=29,component=indirect", 4, 0.125);
    expect_mean(scene, "radiosity:bounces=29,component=indirect,pattern=sobol,walk=paper", 4, 0.125);
    expect_mean(scene, "radiosity:bounces=29", 4, 0.5);
    expect_mean(scene, "radiosity:bounces=29,oversampling=sampler,share_neighbours=true", 4, 0.5);
    /* Adaptive pixels stop when their mean seems stable, without bias here: all are 1/2. */
    expect_mean(scene, "radiosity:bounces=29,oversampling=adaptive", 32, 0.5);
    aur_scene_destroy(scene);
}

/* The lid is a mirror: its reflection is 1/2 too. */
static void mirrors_show_the_same(void **state) {
    (void)state;
    aur_scene *const scene =
        must_load_body("<shape type='cube'><boolean name='flip_normals' value='true'/>" WALL "</shape>"
                       "<shape type='rectangle'><transform name='to_world'><rotate y='1' "
                       "angle='180'/><translate z='0.9'/></transform>"
                       "<bsdf type='twosided'><bsdf type='conductor'/></bsdf></shape>");
    expect_mean(scene, "radiosity:bounces=29", 16, 0.5);
    aur_scene_destroy(scene);
}

#define ROOM                                                                                                 \
    "<shape type='cube'><boolean name='flip_normals' value='true'/><bsdf type='diffuse'/></shape>"           \
    "<shape type='cube'><transform name='to_world'><scale value='0.2'/><translate y='0.5'/></transform>"     \
    "<emitter type='area'><rgb name='radiance' value='3, 2, 1'/></emitter></shape>"                          \
    "<shape type='cube'><transform name='to_world'><scale value='0.3'/><translate y='-0.5' "                 \
    "x='0.4'/></transform>"                                                                                  \
    "<bsdf type='diffuse'/></shape>"

/* In a closed box whose walls all shine, direct light is 1/2 everywhere. 16 times the samples leave a
 * sixteenth of the square deviation; an eighth is asked, for it is known from one image each. */
static void more_samples_see_more_of_the_lights(void **state) {
    (void)state;
    aur_scene *const scene =
        must_load_body("<shape type='cube'><boolean name='flip_normals' value='true'/>"
                       "<bsdf type='diffuse'><rgb name='reflectance' value='0.5, 0.5, 0.5'/></bsdf>"
                       "<emitter type='area'><rgb name='radiance' value='1, 1, 1'/></emitter></shape>");
    static const size_t samples[2] = {4, 64};
    double squares[2];
    for (size_t i = 0; i < 2; ++i) {
        aur_image *const image = render(scene, "radiosity:component=direct", samples[i], 2, NULL);
        double mean, error;
        mean_of(image, &mean, &error);
        assert_near(mean, 0.5, 4.0 * error);
        squares[i] = PIXELS * error * error;
        aur_image_destroy(image);
    }
    assert_true(squares[1] <= squares[0] / 8.0);
    aur_scene_destroy(scene);
}

/* The permuted scheme against all lights at every hit point: the same expectation in every pixel. */
static void compare_with_all_lights(const aur_scene *scene, const aur_image *all, size_t samples,
                                    double most_error) {
    aur_image *const permuted = render(scene, "radiosity:component=direct", samples, 2, NULL);
    double sum = 0.0, squares = 0.0, brightness = 0.0;
    for (size_t i = 0; i < PIXELS; ++i) {
        const double difference = (double)permuted->data[3 * i] - (double)all->data[3 * i];
        sum += difference;
        squares += difference * difference;
        brightness += all->data[3 * i];
    }
    const double error = sqrt(squares / PIXELS / PIXELS);
    assert_near(sum / PIXELS, 0.0, 3.0 * error);
    assert_true(error < most_error * brightness / PIXELS);
    aur_image_destroy(permuted);
}

/* Five samples are a round that uses both triangles of the emitter once, and the first sample of another
 * round, which uses its random choice. */
static void permuting_lights_is_unbiased(void **state) {
    (void)state;
    aur_scene *const scene = must_load_body(
        "<shape type='cube'><boolean name='flip_normals' value='true'/><bsdf type='diffuse'/></shape>"
        "<shape type='rectangle'><transform name='to_world'><scale value='0.6'/><rotate x='1' "
        "angle='90'/><translate y='0.95'/></transform><emitter type='area'><rgb "
        "name='radiance' value='6, 5, 4'/></emitter></shape>");
    aur_image *const all = render(scene, "radiosity:component=direct,light_sampling=all", 32, 2, NULL);
    compare_with_all_lights(scene, all, 32, 0.01);
    compare_with_all_lights(scene, all, 5, 0.05);
    aur_image_destroy(all);
    aur_scene_destroy(scene);
}

/* Sharing pools up to nine times the gather rays of a wall. */
static void sharing_smooths_the_indirect_light(void **state) {
    (void)state;
    aur_scene *const scene = must_load_body(FURNISHED);
    const char *const both[2] = {"radiosity:component=indirect,gather_samples=2",
                                 "radiosity:component=indirect,gather_samples=2,share_neighbours=true"};
    double errors[2];
    drawn_by = "box"; /* pixels share no samples otherwise */
    for (size_t i = 0; i < 2; ++i) {
        aur_image *const image = render(scene, both[i], 1, 2, NULL);
        double mean;
        mean_of(image, &mean, &errors[i]);
        aur_image_destroy(image);
    }
    drawn_by = NULL;
    assert_true(errors[1] < 0.5 * errors[0]);
    aur_scene_destroy(scene);
}

static void adaptive_pixels_spare_samples(void **state) {
    (void)state;
    aur_scene *const scene = must_load_body(ROOM);
    aur_render_statistics fixed = {.size = sizeof fixed}, adaptive = fixed, walk = fixed;
    aur_image_destroy(render(scene, "radiosity", 1, 2, &walk)); /* nearly all of its rays make the solution */
    aur_image *const a = render(scene, "radiosity", 64, 2, &fixed);
    aur_image *const b = render(scene, "radiosity:oversampling=adaptive,threshold=0.05", 64, 2, &adaptive);
    assert_true(adaptive.rays - walk.rays < (fixed.rays - walk.rays) / 2);
    double mean_a, mean_b, error_a, error_b;
    mean_of(a, &mean_a, &error_a);
    mean_of(b, &mean_b, &error_b);
    assert_relative(mean_b, mean_a, 0.03);
    aur_image_destroy(a);
    aur_image_destroy(b);
    aur_scene_destroy(scene);
}

/* Threads and crops change no pixel, with neighbours and without. */
static void images_depend_on_nothing_else(void **state) {
    (void)state;
    aur_scene *const scene = must_load_body(ROOM);
    static const char *const integrators[] = {"radiosity:paths=2000,gather_samples=5",
                                              "radiosity:paths=2000,gather_samples=5,share_neighbours=true"};
    for (size_t i = 0; i < 2; ++i) {
        aur_image *const one = render(scene, integrators[i], 4, 1, NULL);
        aur_image *const three = render(scene, integrators[i], 4, 3, NULL);
        assert_memory_equal(one->data, three->data, 3 * PIXELS * sizeof(float));
        aur_renderer *renderer = NULL;
        aur_image *part = NULL;
        const aur_render_options options = {.size = sizeof options,
                                            .integrator = integrators[i],
                                            .samples_per_pixel = 4,
                                            .width = WIDTH,
                                            .height = HEIGHT,
                                            .crop_x0 = 5,
                                            .crop_x1 = 19,
                                            .crop_y0 = 7,
                                            .crop_y1 = 17};
        assert_int_equal(aur_renderer_create(scene, &renderer, NULL), AUR_OK);
        assert_int_equal(aur_renderer_render(renderer, &options, &part, NULL, NULL), AUR_OK);
        for (size_t y = 0; y < 10; ++y)
            assert_memory_equal(&part->data[3 * 14 * y], &one->data[3 * (WIDTH * (y + 7) + 5)],
                                3 * 14 * sizeof(float));
        aur_renderer_destroy(renderer);
        aur_image_destroy(part);
        aur_image_destroy(one);
        aur_image_destroy(three);
    }
    aur_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(directions_are_uniform_in_the_solid_angle),
        cmocka_unit_test(components_are_what_they_should_be),
        cmocka_unit_test(mirrors_show_the_same),
        cmocka_unit_test(permuting_lights_is_unbiased),
        cmocka_unit_test(more_samples_see_more_of_the_lights),
        cmocka_unit_test(sharing_smooths_the_indirect_light),
        cmocka_unit_test(adaptive_pixels_spare_samples),
        cmocka_unit_test(images_depend_on_nothing_else),
    };
    return cmocka_run_group_tests_name("radiosity pictures", tests, enter_folder, leave_folder);
}
