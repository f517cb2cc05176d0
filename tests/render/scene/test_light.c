#include "scene_text.h"

#include "points/base/random.h"
#include "render/scene/materials/sampling.h"
#include "render/scene/scene_data.h"

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

/* The contribution of light from a direction at a reference. */
static double weight_at(const aur_light_reference *at, aur_vector direction) {
    return aur_vector_is_zero(at->normal) ? 1.0 : fmax((double)aur_vector_dot(at->normal, direction), 0.0);
}

/* Light that arrives at a point from all directions (fluence) or on one of two surfaces there, in two ways:
 * by uniform directions that hit lights, and by sampled points on lights. Evaluation returns the pdf of
 * sampling. */
static void compare_with_brute_force(const aur_scene *scene, aur_vector reference) {
    enum { COUNT = 200000 };
    static const aur_vector normals[] = {{0.0f, 0.0f, 0.0f}, {0.36f, 0.48f, 0.8f}, {0.6f, -0.8f, 0.0f}};
    double direct[2] = {0, 0}, brute[2] = {0, 0};
    for (size_t i = 0; i < COUNT; ++i) {
        const float u[3] = {unit(1, i), unit(2, i), unit(3, i)};
        aur_light_sample sample;
        const aur_light_reference at = {reference, normals[i % 3]};
        if (aur_light_sample_direct(scene, &at, u, &sample)) {
            const aur_surface eye = {.position = reference, .geometric_normal = sample.direction};
            const aur_ray ray = aur_surface_ray_to(&eye, sample.position);
            const double value =
                aur_scene_occluded(scene, &ray)
                    ? 0.0
                    : weight_at(&at, sample.direction) * (double)(sample.radiance.x / sample.pdf);
            direct[0] += value;
            direct[1] += value * value;
            aur_ray continuation = ray;
            continuation.farthest = INFINITY;
            aur_hit hit;
            /* Not at grazing angles, where the offset of points from the light matters, nor next to a
             * silhouette or outside the scene. */
            if (value > 0.0 && i % 16 == 0 && sample.pdf < 15.0f &&
                aur_scene_intersect(scene, &continuation, &hit)) {
                aur_surface surface;
                aur_scene_surface(scene, &continuation, &hit, &surface);
                assert_relative(aur_light_pdf_direct(scene, &at, &surface), sample.pdf, 4e-3);
                assert_near(hit.distance, ray.farthest, 2e-3 * ray.farthest);
            }
        }
        const aur_ray ray = {reference, 0.0f, aur_sample_sphere(unit(4, i), unit(5, i)), INFINITY};
        aur_hit hit;
        double value = 4.0 * AUR_PI * weight_at(&at, ray.direction);
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
    assert_near(mean, other, 4.5 * sigma); /* exceeded with probability 7e-6; the numbers are fixed */
}

static void draws_what_it_says(void **state) {
    (void)state;
    aur_scene *const scene = load_lights();
    assert_int_equal(aur_scene_emitter_count(scene), 2);
    compare_with_brute_force(scene, (aur_vector){0.5f, -0.25f, 1.0f});
    aur_scene_destroy(scene);
}

/* Irradiance by an emitter, sampled with a normal and without: means differ only by noise, and evaluation
 * returns the pdf of sampling. */
static void draws_for_normals(void **state) {
    (void)state;
    enum { COUNT = 20000 };
    static const char *const plain = "<float name='radiance' value='2'/>";
    static const struct {
        const char *to_world; /* of a square of 2 x 2 that shines upwards */
        aur_vector normal;    /* of the surface at (0, 0, 1) */
        const char *lights;   /* NULL: evenly */
    } rows[] = {
        {"<translate z='-1'/>", {0.6f, 0.0f, -0.8f}, NULL},
        {"<translate x='.4' z='0'/>", {0.96f, 0.0f, -0.28f}, NULL}, /* crosses the horizon */
        {"<rotate x='1' angle='90'/><translate y='1' z='1'/>",
         {0.0f, 0.0f, -1.0f},
         NULL}, /* touches, edge on */
        {"<rotate x='1' angle='90'/><translate y='.01' z='1'/>", {0.0f, -0.6f, -0.8f}, NULL}, /* very near */
        {"<scale value='.02'/><translate x='.5' z='.3'/>", {0.0f, 0.6f, -0.8f}, NULL},        /* tiny */
        {"<scale value='300'/>", {0.8f, 0.0f, -0.6f}, NULL},                                  /* huge */
        {"<translate x='1'/>",
         {0.6f, 0.0f, -0.8f},
         "<texture type='checkerboard' name='radiance'><rgb name='color0' value='0'/><rgb name='color1' "
         "value='3'/></texture>"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; ++i) {
        char body[1024];
        snprintf(body, sizeof body,
                 "<shape type='rectangle'><transform name='to_world'>%s</transform><emitter "
                 "type='area'>%s</emitter></shape>",
                 rows[i].to_world, rows[i].lights != NULL ? rows[i].lights : plain);
        aur_scene *const scene = must_load_body(body);
        double sums[2] = {0.0}, squares[2] = {0.0};
        for (size_t k = 0; k < 2 * COUNT; ++k) {
            const float u[3] = {0.5f, unit(6, k), unit(7, k)};
            aur_light_reference at = {.position = {0.0f, 0.0f, 1.0f}};
            if (k % 2 == 0)
                at.normal = rows[i].normal;
            aur_light_sample sample;
            if (!aur_light_sample_direct(scene, &at, u, &sample))
                continue;
            const double cosine = (double)aur_vector_dot(sample.direction, rows[i].normal);
            const double value = fmax(cosine, 0.0) * (double)sample.radiance.x / (double)sample.pdf;
            sums[k % 2] += value;
            squares[k % 2] += value * value;
            const aur_surface surface = {
                .position = sample.position, .geometric_normal = sample.normal, .shape = 0, .emitter = 0};
            if (k % 7 == 0)
                assert_relative(aur_light_pdf_direct(scene, &at, &surface), sample.pdf, 4e-3);
        }
        const double mean = sums[0] / COUNT, other = sums[1] / COUNT;
        const double variance = squares[0] / COUNT - mean * mean, others = squares[1] / COUNT - other * other;
        assert_near(mean, other, 4.5 * sqrt((variance + others) / COUNT)); /* exceeded with probability 7e-6
                                                                            */
        /* A light with its own sampling pattern may be placed where the cosine is large. */
        assert_true(mean > 0.0 && variance < (rows[i].lights != NULL ? 1.1 : 1.0) * others);
        aur_scene_destroy(scene);
    }
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

/* From points of a sphere that faces inwards, which rounding puts to either side, all of it is drawn by area.
 */
static void draws_from_points_on_a_sphere(void **state) {
    (void)state;
    aur_scene *const scene =
        must_load_body("<shape type='sphere'><boolean name='flip_normals' value='true'/><float name='radius' "
                       "value='3'/><emitter type='area'/></shape>");
    size_t near = 0;
    for (size_t i = 0; i < 2000; ++i) {
        const float u[3] = {unit(1, i), unit(2, i), unit(3, i)};
        const aur_vector reference = aur_vector_scale(aur_sample_sphere(unit(4, i), unit(5, i)), 3.0f);
        aur_light_sample sample;
        if (!aur_light_sample_direct(scene, &(aur_light_reference){.position = reference}, u, &sample) ||
            sample.distance < 0.1f) {
            ++near;
            continue;
        }
        /* the chord makes the same angle with both ends' normals: its cosine is half the chord over the
         * radius */
        const double cosine = (double)sample.distance / 6.0;
        const double expected = (double)(sample.distance * sample.distance) / (cosine * 36.0 * AUR_PI);
        assert_relative(sample.pdf, expected, 1e-4);
    }
    /* (.1/6)^2 of the sphere is that near: 0.6 points are expected, and 10 come once in 10^9 */
    assert_true(near < 10);
    aur_scene_destroy(scene);
}

/* An image of a sky: a dim gradient with one bright texel, as PFM (the bottom row first). */
static void write_sky(void) {
    enum { WIDTH = 16, HEIGHT = 9 };
    char file[64 + WIDTH * HEIGHT * 12];
    int used = sprintf(file, "PF\n%d %d\n-1.0\n", WIDTH, HEIGHT);
    for (size_t j = HEIGHT; j-- > 0;) {
        for (size_t i = 0; i < WIDTH; ++i) {
            const float value = i == 5 && j == 3 ? 40.0f : 0.1f + 0.05f * (float)j + 0.01f * (float)i;
            const float rgb[3] = {value, value, 0.5f * value};
            memcpy(file + used, rgb, sizeof rgb);
            used += (int)sizeof rgb;
        }
    }
    write_file("sky.pfm", file, (size_t)used);
}

static const char *const sky = "<emitter type='envmap'><string name='filename' value='sky.pfm'/>"
                               "<float name='scale' value='2'/><transform name='to_world'>"
                               "<rotate x='1' y='1' angle='50'/></transform></emitter>";

/* Light on the side of a normal is the same light; only what is behind may be omitted. */
static void one_side_is_requested(const aur_scene *scene, const float u[3], const aur_light_sample *whole) {
    const aur_vector normal = {0.6f, 0.0f, 0.8f};
    aur_light_sample sample;
    if (aur_light_sample_direct(scene, &(aur_light_reference){.normal = normal}, u, &sample)) {
        assert_true(sample.direction.x == whole->direction.x && sample.direction.y == whole->direction.y);
        assert_true(sample.pdf == whole->pdf && sample.radiance.y == whole->radiance.y);
    } else {
        assert_true(aur_vector_dot(normal, whole->direction) < 0.0f);
    }
}

static void draws_environments(void **state) {
    (void)state;
    write_sky();
    static const char *const rest =
        "<shape type='cube'><transform name='to_world'><translate x='2.5'/></transform></shape>"
        "<shape type='sphere'><point name='center' x='0' y='4' z='0'/><emitter type='area'/></shape>";
    for (size_t i = 0; i < 2; ++i) {
        char body[2048];
        snprintf(body, sizeof body, "%s%s",
                 i == 0 ? "<emitter type='constant'><rgb name='radiance' value='0.5 1 1'/></emitter>" : sky,
                 rest);
        aur_scene *const scene = must_load_body(body);
        assert_true(aur_scene_has_environment(scene));
        compare_with_brute_force(scene, (aur_vector){0.0f, 0.5f, 0.25f});
        /* evaluation returns the values of sampling */
        for (size_t k = 0; k < 3000; ++k) {
            const float u[3] = {unit(1, k), unit(2, k), unit(3, k)};
            aur_light_sample sample;
            if (!aur_light_sample_direct(scene, &(aur_light_reference){0}, u, &sample) ||
                sample.distance < 5.5f)
                continue; /* the sphere */
            /* but for where rounding takes the direction: 1e-7 of a turn is 2e-6 of 16 columns, 1e-7 of pi
             * 1e-6 of 8 rows, and radiance changes by 80 over one */
            const double least = i == 0 ? 1e-6 : 80.0 * 3e-6;
            const double slack = 1.1 * least / (double)aur_luminance(sample.radiance);
            assert_near(sample.pdf, aur_environment_pdf_direct(scene, sample.direction),
                        fmax(slack, 1e-6) * (double)sample.pdf);
            assert_near(sample.radiance.y, aur_scene_environment(scene, sample.direction).y, least);
            float pdf;
            const aur_vector both = aur_environment_light(scene, sample.direction, &pdf);
            assert_true(both.x == aur_scene_environment(scene, sample.direction).x);
            assert_true(pdf == aur_environment_pdf_direct(scene, sample.direction));
            one_side_is_requested(scene, u, &sample);
        }
        aur_scene_destroy(scene);
    }
}

/* The image's middle row seen along -z is its left edge, and along +x a quarter further. */
static void turns_environments(void **state) {
    (void)state;
    write_sky();
    aur_scene *const scene = must_load_body(
        "<emitter type='envmap'><string name='filename' value='sky.pfm'/></emitter><shape type='cube'/>");
    /* row 4 of 9: 0.1 + 0.2; between texels 15 and 0 of 16, and between 3 and 4 */
    assert_near(aur_scene_environment(scene, (aur_vector){0, 0, -1}).x, 0.3 + 0.075, 1e-5);
    assert_near(aur_scene_environment(scene, (aur_vector){1, 0, 0}).x, 0.3 + 0.035, 1e-5);
    assert_near(aur_scene_environment(scene, (aur_vector){-1, 0, 0}).x, 0.3 + 0.115, 1e-5);
    assert_near(aur_scene_environment(scene, (aur_vector){0, 1, 0}).x, 0.1 + 0.075, 0.01);
    assert_near(aur_scene_environment(scene, (aur_vector){0, -1, 0}).x, 0.5 + 0.075, 0.01);
    aur_scene_destroy(scene);
}

/* Particles of an image leave by luminance, unlike samples of light, which follow what is above the mean:
 * each carries as much. Radiance is interpolated by angle and the density by height, so that particles of the
 * rows of 22.5 degrees from pole to pole differ by the bend of the cosine. Together they carry the integral
 * of the radiance over directions, times the area of the disc that they leave. */
static void particles_follow_luminance(void **state) {
    (void)state;
    enum { SIDE = 256 };
    write_sky();
    aur_scene *const scene = must_load_body(
        "<emitter type='envmap'><string name='filename' value='sky.pfm'/></emitter><shape type='cube'/>");
    double sum = 0.0, integral = 0.0, least = INFINITY, most = 0.0;
    for (size_t k = 0; k < SIDE * SIDE; ++k) {
        const float u = ((float)(k % SIDE) + 0.5f) / SIDE, v = ((float)(k / SIDE) + 0.5f) / SIDE;
        aur_ray ray;
        aur_vector power;
        assert_true(
            aur_light_emit(scene, (const float[5]){0.5f, u, v, 0.5f, 0.5f}, &ray, &power, &(bool){false}));
        const double carried = (double)aur_luminance(power);
        sum += carried / (SIDE * SIDE);
        integral += 4.0 * AUR_PI / (SIDE * SIDE) *
                    (double)aur_luminance(aur_scene_environment(scene, aur_sample_sphere(u, v)));
        least = fmin(least, carried);
        most = fmax(most, carried);
    }
    assert_true(most < 1.5 * least);
    const double radius = (double)scene->radius;
    assert_near(sum, AUR_PI * radius * radius * integral, 0.01 * sum);
    aur_scene_destroy(scene);
}

/* The density follows radiance within patches, so that nothing of what is even among the numbers is lost.
 * Both are interpolated between corners, by height and by angle: on the rows of 22.5 degrees beside the
 * equator the two differ by .01 of a row at most, (pi / 8)^2 / 8 * sin 22.5 / 2 over the row's height.
 * Luminance changes by less than 1.5 times over a row on the side where no texel is bright: the ratio is the
 * same within .01 * .5. A density that is the same all over a patch is off by .05 and more. */
static void draws_environments_evenly(void **state) {
    (void)state;
    write_sky();
    aur_scene *const scene = must_load_body(
        "<emitter type='envmap'><string name='filename' value='sky.pfm'/></emitter><shape type='cube'/>");
    double least = INFINITY, most = 0.0;
    for (size_t k = 0; k < 3000; ++k) {
        const float height = 0.76f * (unit(1, k) - 0.5f), azimuth = AUR_PI_F * unit(2, k);
        const float radius = sqrtf(1.0f - height * height);
        float pdf;
        const aur_vector light = aur_environment_light(
            scene, (aur_vector){-radius * sinf(azimuth), height, radius * cosf(azimuth)}, &pdf);
        const double ratio = (double)(aur_luminance(light) / pdf);
        least = fmin(least, ratio);
        most = fmax(most, ratio);
    }
    assert_true(most < 1.01 * least);
    aur_scene_destroy(scene);
}

static void shines_from_points(void **state) {
    (void)state;
    static const struct {
        const char *emitter;
        aur_vector reference, direction;
        double irradiance; /* radiance / pdf of the one light */
    } rows[] = {
        {"point'><point name='position' x='1' y='2' z='3'/><float name='intensity' value='8'/>",
         {1, 2, 1},
         {0, 0, 1},
         2.0},
        {"spot'><float name='intensity' value='8'/><float name='cutoff_angle' value='30'/>"
         "<float name='beam_width' value='10'/><transform name='to_world'><translate y='3'/></transform>",
         {0, 3, 2},
         {0, 0, -1},
         2.0},
        /* 20 degrees aside: half-way between full and nothing */
        {"spot'><float name='intensity' value='8'/><float name='cutoff_angle' value='30'/>"
         "<float name='beam_width' value='10'/>",
         {0.68404029f, 0, 1.8793852f},
         {-0.34202014f, 0, -0.93969262f},
         1.0},
        {"directional'><vector name='direction' x='0' y='-2' z='0'/><float name='irradiance' value='3'/>",
         {5, 3, 2},
         {0, 1, 0},
         3.0},
        {"directional'><transform name='to_world'><lookat origin='1 0 0' target='0 0 0' up='0 1 "
         "0'/></transform>",
         {0, 0, 0},
         {1, 0, 0},
         1.0},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; ++i) {
        char body[512];
        snprintf(body, sizeof body, "<emitter type='%s</emitter><shape type='cube'/>", rows[i].emitter);
        aur_scene *const scene = must_load_body(body);
        aur_light_sample sample;
        assert_true(aur_light_sample_direct(scene, &(aur_light_reference){.position = rows[i].reference},
                                            (const float[3]){0.3f, 0.4f, 0.5f}, &sample));
        assert_true(sample.delta);
        assert_near(aur_vector_dot(sample.direction, rows[i].direction), 1.0, 1e-6);
        assert_near(sample.radiance.x / sample.pdf, rows[i].irradiance, 1e-5);
        aur_scene_destroy(scene);
    }
    aur_scene *const dark = must_load_body("<emitter type='spot'/><shape type='cube'/>");
    aur_light_sample sample;
    assert_false(aur_light_sample_direct(dark, &(aur_light_reference){.position = {0, 1, 1}},
                                         (const float[3]){0, 0, 0}, &sample));
    aur_scene_destroy(dark);
}

/* The mean power of particles is what a light gives: in closed form for each kind. The scene is a unit cube,
 * around which the sphere has radius sqrt 3 (and a thousandth). */
static void particles_of_every_light(void **state) {
    (void)state;
    write_sky();
    const double disk = AUR_PI * 3.0 * 1.001 * 1.001;
    const double beam = cos(10.0 * AUR_PI / 180.0);
    /* falloff times solid angle: 2 pi (integral of (cut - a) sin a da over 10..30 degrees) / 20 degrees + the
     * beam */
    const double width = 20.0 * AUR_PI / 180.0;
    const double edge = width * beam - (sin(30.0 * AUR_PI / 180.0) - sin(10.0 * AUR_PI / 180.0));
    double sky_mean = 0.0; /* integral of the sky over directions, by fine midpoints */
    aur_scene *const under = must_load_body("<emitter type='envmap'><string name='filename' value='sky.pfm'/>"
                                            "</emitter><shape type='cube'/>");
    for (size_t i = 0; i < 1000; ++i)
        for (size_t j = 0; j < 1000; ++j)
            sky_mean += (double)aur_scene_environment(under, aur_sample_sphere(((float)i + 0.5f) / 1000.0f,
                                                                               ((float)j + 0.5f) / 1000.0f))
                            .x *
                        4e-6 * AUR_PI;
    aur_scene_destroy(under);
    const struct {
        const char *emitter;
        double power;
    } rows[] = {
        {"<emitter type='point'><float name='intensity' value='2'/></emitter>", 8.0 * AUR_PI},
        {"<emitter type='spot'><float name='cutoff_angle' value='30'/><float name='beam_width' "
         "value='10'/></emitter>",
         2.0 * AUR_PI * (1.0 - beam + edge / width)},
        {"<emitter type='directional'><float name='irradiance' value='2'/></emitter>", 2.0 * disk},
        {"<emitter type='constant'><float name='radiance' value='2'/></emitter>", 2.0 * 4.0 * AUR_PI * disk},
        {"<emitter type='envmap'><string name='filename' value='sky.pfm'/></emitter>", sky_mean * disk},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; ++i) {
        char body[512];
        snprintf(body, sizeof body, "%s<shape type='cube'/>", rows[i].emitter);
        aur_scene *const scene = must_load_body(body);
        double sum = 0.0, squares = 0.0;
        enum { COUNT = 50000 };
        for (size_t k = 0; k < COUNT; ++k) {
            const float u[5] = {unit(1, k), unit(2, k), unit(3, k), unit(4, k), unit(5, k)};
            aur_ray ray;
            aur_vector power;
            if (!aur_light_emit(scene, u, &ray, &power, &(bool){false}))
                continue;
            assert_near(aur_vector_length(ray.direction), 1.0, 1e-5);
            sum += (double)power.x;
            squares += (double)power.x * (double)power.x;
        }
        const double mean = sum / COUNT;
        const double sigma = sqrt(fmax(squares / COUNT - mean * mean, 0.0) / COUNT);
        assert_near(mean, rows[i].power, 5.0 * sigma + 1e-4 * mean);
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
        assert_true(aur_light_emit(scene, u, &ray, &power, &(bool){false}));
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

static void lights_without_area_give_no_light(void **state) {
    (void)state;
    write_text("line.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
    aur_scene *scene = must_load_body("<shape type='obj'><string name='filename' value='line.obj'/>"
                                      "<emitter type='area'/></shape>");
    assert_int_equal(aur_scene_emitter_count(scene), 0);
    aur_scene_destroy(scene);
    /* no light at all is no error */
    scene = must_load_body("<shape type='cube'/>");
    aur_light_sample sample;
    assert_false(
        aur_light_sample_direct(scene, &(aur_light_reference){0}, (const float[3]){0, 0, 0}, &sample));
    assert_false(aur_scene_has_environment(scene));
    aur_scene_destroy(scene);
}

/* Shares of a sun, a sky and two area lights in the tree, whose power is 3e-6 of all: a quarter by power, the
 * rest as 2 to 1 to 2, times the sampling weights. */
static void small_lights_are_chosen_under_a_sky(void **state) {
    (void)state;
    static const char *const weights[] = {"", "<float name='sampling_weight' value='3'/>"};
    for (size_t i = 0; i < 2; ++i) {
        char body[1000];
        snprintf(
            body, sizeof body,
            "<shape type='rectangle'><emitter type='area'><rgb name='radiance' "
            "value='1e-6'/></emitter></shape>"
            "<shape type='sphere'><emitter type='area'><rgb name='radiance' value='1e-6'/></emitter></shape>"
            "<emitter type='constant'/><emitter type='directional'><vector name='direction' z='-1'/>"
            "<rgb name='irradiance' value='%.17g'/>%s</emitter>",
            4.0 * AUR_PI, weights[i]); /* the power of the sky */
        aur_scene *const scene = must_load_body(body);
        const double weight = i == 0 ? 1.0 : 3.0, shares = 1.0 + 0.5 + weight;
        assert_near(scene->choice.tree_probability, 0.75 / shares, 1e-5);
        assert_near(scene->emitters[2]->probability, 0.25 / (1.0 + weight) + 0.375 / shares, 1e-5);
        assert_near(scene->emitters[3]->probability, 0.25 * weight / (1.0 + weight) + 0.75 * weight / shares,
                    1e-5);
        aur_scene_destroy(scene);
    }
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
        cmocka_unit_test(draws_what_it_says),
        cmocka_unit_test(draws_environments),
        cmocka_unit_test(turns_environments),
        cmocka_unit_test(particles_follow_luminance),
        cmocka_unit_test(draws_environments_evenly),
        cmocka_unit_test(shines_from_points),
        cmocka_unit_test(particles_of_every_light),
        cmocka_unit_test(draws_for_normals),
        cmocka_unit_test(draws_on_curved_lights),
        cmocka_unit_test(draws_from_points_on_a_sphere),
        cmocka_unit_test(particles_carry_the_power),
        cmocka_unit_test(emits_on_one_side),
        cmocka_unit_test(lights_without_area_give_no_light),
        cmocka_unit_test(small_lights_are_chosen_under_a_sky),
        cmocka_unit_test(closed_rooms_stay_closed),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
