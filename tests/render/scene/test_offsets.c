/* Rays that leave a surface or end at a light on it never hit it, whatever its position and orientation; an
 * object just in front of a light hides it. */
#include "scene_text.h"

#include "points/base/random.h"
#include "render/scene/materials/sampling.h"

static float unit(uint64_t a, uint64_t b) {
    return aur_unit_float((uint32_t)(aur_hash2(a, b) >> 32));
}

/* A square of 2 x 2 of many triangles. */
static void write_grid(void) {
    enum { SIDE = 40 };
    static char text[1 << 18];
    size_t used = 0;
    for (size_t i = 0; i <= SIDE; ++i)
        for (size_t k = 0; k <= SIDE; ++k)
            used += (size_t)snprintf(text + used, sizeof text - used, "v %.17g %.17g 0\n",
                                     2.0 * (double)k / SIDE - 1.0, 2.0 * (double)i / SIDE - 1.0);
    for (size_t i = 0; i < SIDE; ++i)
        for (size_t k = 1; k <= SIDE; ++k) {
            const size_t a = i * (SIDE + 1) + k, b = a + SIDE + 1;
            used += (size_t)snprintf(text + used, sizeof text - used, "f %zu %zu %zu\nf %zu %zu %zu\n", a,
                                     a + 1, b + 1, a, b + 1, b);
        }
    assert_true(used < sizeof text - 1);
    write_text("grid.obj", text);
}

/* $: the transform. Half of each is about 1 wide; `middle` is a point of the surface. */
static const struct {
    const char *body;
    aur_vector middle;
    bool flat;
} shapes[] = {
    {"<shape type='rectangle'>$</shape>", {0.1f, 0.05f, 0.0f}, true},
    {"<shape type='polygon'><string name='vertices' value='-1 -1 0 1 -1 0 .9 .5 0 .3 1.2 0 -1 .7 "
     "0'/>$</shape>",
     {0.1f, 0.05f, 0.0f},
     true},
    {"<shape type='obj'><string name='filename' value='grid.obj'/>$</shape>", {0.1f, 0.05f, 0.0f}, true},
    {"<shape type='polygon'><string name='vertices' value='-1 0 0 1 0 0 1 .1 0 -1 .1 0'/>$</shape>",
     {0.1f, 0.05f, 0.0f},
     true},
    {"<shape type='polygon'><string name='vertices' value='-1 .049 0 1 .049 0 1 .051 0 -1 .051 0'/>$</shape>",
     {0.1f, 0.05f, 0.0f},
     true},
    {"<shape type='disk'>$</shape>", {0.1f, 0.05f, 0.0f}, true},
    {"<shape type='sphere'>$</shape>", {0.36f, 0.48f, 0.8f}, false},
    {"<shape type='cylinder'>$</shape>", {0.6f, 0.8f, 0.4f}, false},
    {"<shape type='cone'>$</shape>", {0.3f, 0.4f, 0.5f}, false},
    {"<shape type='shapegroup' id='g'><shape type='rectangle'><transform name='to_world'><scale "
     "value='1e-3'/>"
     "<rotate x='1' y='1' angle='20'/></transform></shape></shape>"
     "<shape type='instance'><ref id='g'/><transform name='to_world'><rotate x='1' y='1' angle='-20'/>"
     "<scale value='1e3'/><matrix value='1 .3 .2 0  0 .7 0 0  0 .4 1.5 0  0 0 0 1'/></transform>$</shape>",
     {0.1f, 0.05f, 0.0f},
     true},
    {"<shape type='shapegroup' id='g'><shape type='sphere'><float name='radius' value='.01'/></shape></shape>"
     "<shape type='instance'><ref id='g'/><transform name='to_world'><scale "
     "value='100'/></transform>$</shape>",
     {0.36f, 0.48f, 0.8f},
     false},
};

static const struct {
    double axis[3], angle;
} turns[] = {{{1, 0, 0}, 0}, {{1, 2, -1}, 40}, {{1, 0.3, 0}, 0.01}, {{-3, 1, 1}, 200}, {{0, 1, 0}, 45}};

/* A ray back into a round shape hits its other side. */
static size_t leave(const aur_scene *scene, const aur_surface *surface, double size, bool flat,
                    uint64_t seed) {
    enum { DIRECTIONS = 8 };
    size_t met = 0;
    for (uint64_t k = 0; k < DIRECTIONS; ++k) {
        const aur_vector local = aur_sample_cosine(unit(seed, 10 + 2 * k), unit(seed, 11 + 2 * k));
        if (local.z < 0.01f)
            continue;
        const aur_frame frame = aur_frame_about(surface->geometric_normal);
        for (int side = 0; side < 2; ++side) {
            const aur_vector way = {local.x, local.y, side == 0 ? local.z : -local.z};
            const aur_ray ray = aur_surface_ray(surface, aur_frame_to_world(&frame, way));
            aur_hit hit;
            if (aur_scene_intersect(scene, &ray, &hit))
                met += flat || side == 0 || (double)hit.distance < 0.01 * size * (double)local.z;
        }
    }
    return met;
}

/* `more` is added to the shape, for example a light. Its centre is away * size * (1, .4, -.7). */
static aur_scene *load_shape(size_t shape, double size, size_t turn, double away, const char *more) {
    char transform[512], body[2048];
    const aur_vector middle = shapes[shape].middle;
    const double at[3] = {away * size, 0.4 * away * size, -0.7 * away * size};
    snprintf(
        transform, sizeof transform,
        "<transform name='to_world'>%s<translate x='%.9g' y='%.9g' z='%.9g'/><scale value='%.17g'/>"
        "<rotate x='%g' y='%g' z='%g' angle='%g'/><translate x='%.17g' y='%.17g' z='%.17g'/></transform>",
        "", (double)-middle.x, (double)-middle.y, (double)-middle.z, size, turns[turn].axis[0],
        turns[turn].axis[1], turns[turn].axis[2], turns[turn].angle, at[0], at[1], at[2]);
    const char *text = shapes[shape].body;
    const char *const gap = strchr(text, '$');
    const char *const inner = strstr(text, "<shape type='instance'>");
    if (inner != NULL) { /* one transform: its own steps first */
        const char *const end = strstr(inner, "</transform>");
        snprintf(body, sizeof body, "%.*s%s</shape>", (int)(end - text), text,
                 transform + strlen("<transform name='to_world'>"));
    } else {
        snprintf(body, sizeof body, "%.*s%s%s%s", (int)(gap - text), text, transform, more, gap + 1);
    }
    return must_load_body(body);
}

/* The number of rays that hit the surface they left. */
static size_t test_place(size_t shape, double size, size_t turn, double away, size_t *tried) {
    const double at[3] = {away * size, 0.4 * away * size, -0.7 * away * size};
    aur_scene *const scene = load_shape(shape, size, turn, away, "");
    const aur_vector point = aur_internal_point(aur_scene_origin(scene), at);
    size_t met = 0;
    for (uint64_t i = 0; i < 60; ++i) {
        /* Towards positions around the origin, some of them very near to it. */
        const float near = (float)size * powf(10.0f, -4.0f * unit(i, 1));
        const aur_vector target =
            aur_vector_add_scaled(point, 0.5f * near, aur_sample_sphere(unit(i, 2), unit(i, 3)));
        const aur_vector way = aur_sample_sphere(unit(i, 4), unit(i, 5));
        const aur_ray ray = {aur_vector_add_scaled(target, -5.0f * (float)size, way), 0.0f, way, INFINITY};
        aur_hit hit;
        aur_surface surface;
        if (!aur_scene_intersect(scene, &ray, &hit))
            continue;
        aur_scene_surface(scene, &ray, &hit, &surface);
        met += leave(scene, &surface, size, shapes[shape].flat, i);
        ++*tried;
    }
    aur_scene_destroy(scene);
    return met;
}

static void never_meets_itself(void **state) {
    (void)state;
    static const double sizes[] = {0.1, 15.0, 1e3, 1e5}, ways[] = {0.0, 0.3, 30.0};
    size_t bad = 0;
    write_grid();
    for (size_t shape = 0; shape < sizeof shapes / sizeof shapes[0]; ++shape) {
        size_t tried = 0, met = 0;
        for (size_t s = 0; s < sizeof sizes / sizeof sizes[0]; ++s)
            for (size_t turn = 0; turn < sizeof turns / sizeof turns[0]; ++turn)
                for (size_t w = 0; w < sizeof ways / sizeof ways[0]; ++w)
                    met += test_place(shape, sizes[s], turn, ways[w], &tried);
        if (met > 0)
            print_message("shape %zu: %zu rays of %zu hits met it\n", shape, met, tried);
        assert_true(tried > 500);
        bad += met;
    }
    assert_int_equal(bad, 0);
}

/* Rays to points on a light, from near to far and at all angles, meet nothing: there is nothing else. */
static size_t test_light(size_t shape, double size, size_t turn, double away, size_t *tried) {
    enum { RAYS = 400 };
    const double at[3] = {away * size, 0.4 * away * size, -0.7 * away * size};
    aur_scene *const scene = load_shape(shape, size, turn, away, "<emitter type='area'/>");
    const aur_vector point = aur_internal_point(aur_scene_origin(scene), at);
    size_t met = 0;
    for (uint64_t i = 0; i < RAYS; ++i) {
        const float distance = (float)size * powf(10.0f, 5.0f * unit(i, 6) - 2.0f);
        const aur_light_reference reference = {
            .position = aur_vector_add_scaled(point, distance, aur_sample_sphere(unit(i, 7), unit(i, 8)))};
        aur_light_sample light;
        if (!aur_light_sample_direct(scene, &reference,
                                     (const float[3]){unit(i, 9), unit(i, 10), unit(i, 11)}, &light))
            continue;
        const aur_ray ray = aur_ray_between(reference.position, light.position);
        met += aur_scene_occluded(scene, &ray);
        ++*tried;
    }
    aur_scene_destroy(scene);
    return met;
}

static void lights_never_hide_themselves(void **state) {
    (void)state;
    static const double sizes[] = {1e-5, 1.0, 1e5}, ways[] = {0.0, 0.3, 30.0, 1e6};
    size_t bad = 0;
    write_grid();
    for (size_t shape = 0; shape < sizeof shapes / sizeof shapes[0]; ++shape) {
        size_t tried = 0, met = 0;
        if (strstr(shapes[shape].body, "instance") != NULL)
            continue;
        for (size_t s = 0; s < sizeof sizes / sizeof sizes[0]; ++s)
            for (size_t turn = 0; turn < sizeof turns / sizeof turns[0]; ++turn)
                for (size_t w = 0; w < sizeof ways / sizeof ways[0]; ++w)
                    met += test_light(shape, sizes[s], turn, ways[w], &tried);
        if (met > 0)
            print_message("light %zu: %zu of %zu rays met it\n", shape, met, tried);
        assert_true(tried > 5000);
        bad += met;
    }
    assert_int_equal(bad, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(never_meets_itself),
                                       cmocka_unit_test(lights_never_hide_themselves)};
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
