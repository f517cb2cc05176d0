/* Shapes under `to_world`: the same point has the same texture coordinates wherever the shape is moved, and
 * normals and tangents are transformed. */
#include "render/scene/scene_data.h"
#include "scene_text.h"

#include "points/base/random.h"
#include "render/scene/materials/sampling.h"

static float unit(uint64_t a, uint64_t b) {
    return aur_unit_float((uint32_t)(aur_hash2(a, b) >> 32));
}

typedef struct test_shape {
    const char *plugin, *keys;
    enum { ANY_MAP, ROUND, ALONG_AXIS, RIGID } allowed; /* transforms that are allowed in `to_world` */
} test_shape;

static const test_shape shapes[] = {
    {"rectangle", "", ANY_MAP},
    {"cube", "", ANY_MAP},
    {"disk", "", ANY_MAP},
    {"disk", "<float name='inner_radius' value='.3'/>", ANY_MAP},
    {"sphere", "", ROUND},
    {"sphere", "<point name='center' x='.1' y='-.2' z='.2'/><float name='radius' value='.7'/>", ROUND},
    {"cylinder", "", ALONG_AXIS},
    {"cylinder", "<point name='p0' z='-1'/><point name='p1' z='-.2'/><float name='radius' value='.8'/>",
     ALONG_AXIS},
    {"cylinder", "<point name='p0' z='1'/><point name='p1' z='-1'/>", ALONG_AXIS},
    {"cylinder",
     "<point name='p0' x='.5' y='-.6'/><point name='p1' x='-.3' y='.5' z='-.4'/><float name='radius' "
     "value='.6'/>",
     ROUND},
    {"linearcurve", "<string name='filename' value='tube.txt'/>", RIGID},
    {"bsplinecurve", "<string name='filename' value='tube.txt'/>", RIGID},
    {"obj", "<string name='filename' value='fan.obj'/>", ANY_MAP},
    {"ply", "<string name='filename' value='fan.ply'/>", ANY_MAP},
    {"ply", "<string name='filename' value='fan.ply'/><boolean name='face_normals' value='true'/>", ANY_MAP},
};

static const struct {
    const char *xml;
    int kind; /* the least `allowed` that takes it */
    double m[9];
} maps[] = {
    {"<rotate x='0' y='0' z='0' angle='0'/><rotate z='1' angle='90'/>", RIGID, {0, -1, 0, 1, 0, 0, 0, 0, 1}},
    {"<rotate x='1' angle='30'/><rotate z='1' angle='90'/>",
     RIGID,
     {0, -0.86602540378443865, 0.5, 1, 0, 0, 0, 0.5, 0.86602540378443865}},
    {"<rotate y='1' angle='180'/>", RIGID, {-1, 0, 0, 0, 1, 0, 0, 0, -1}},
    {"<scale x='1.7' y='1.7' z='1.7'/><rotate y='1' angle='180'/>",
     ROUND,
     {-1.7, 0, 0, 0, 1.7, 0, 0, 0, -1.7}},
    {"<scale x='-1'/>", ROUND, {-1, 0, 0, 0, 1, 0, 0, 0, 1}},
    {"<scale y='-1.3' x='1.3' z='1.3'/><rotate z='1' angle='90'/>", ROUND, {0, 1.3, 0, 1.3, 0, 0, 0, 0, 1.3}},
    {"<scale value='-1'/>", ROUND, {-1, 0, 0, 0, -1, 0, 0, 0, -1}},
    {"<scale z='1.6'/><rotate z='1' angle='90'/>", ALONG_AXIS, {0, -1, 0, 1, 0, 0, 0, 0, 1.6}},
    {"<scale z='-.6'/>", ALONG_AXIS, {1, 0, 0, 0, 1, 0, 0, 0, -0.6}},
    {"<scale x='1.3' y='.7' z='1.1'/>", ANY_MAP, {1.3, 0, 0, 0, 0.7, 0, 0, 0, 1.1}},
    {"<matrix value='1 .4 0  0 1 .2  .3 0 1'/>", ANY_MAP, {1, 0.4, 0, 0, 1, 0.2, 0.3, 0, 1}},
    {"<matrix value='-1 .4 0  0 1 .2  .3 0 1'/>", ANY_MAP, {-1, 0.4, 0, 0, 1, 0.2, 0.3, 0, 1}},
};

enum { ROUND_SHAPE = 4 };
enum { SHAPES = sizeof shapes / sizeof shapes[0], MAPS = sizeof maps / sizeof maps[0] };

static bool fits(size_t shape, size_t map) {
    const int order[] = {[RIGID] = 0, [ROUND] = 1, [ALONG_AXIS] = 2, [ANY_MAP] = 3};
    return order[maps[map].kind] <= order[shapes[shape].allowed];
}

static void write_models(void) {
    write_text("tube.txt", "-.9 -.8 .3 .3\n-.3 -.3 -.2 .25\n.2 .1 .1 .2\n.5 .5 .4 .25\n.7 .9 -.3 .3\n");
    write_text(
        "fan.obj",
        "v -1 -1 0\nv 1 -1 0\nv 1 1 .2\nv -1 1 0\nv 0 0 .5\nvt 0 .1\nvt 1 .3\nvt .8 1\nvt .1 .8\nvt .4 .5\n"
        "f 1/1 2/2 5/5\nf 2/2 3/3 5/5\nf 3/3 4/4 5/5\nf 4/4 1/1 5/5\n");
    write_text(
        "fan.ply",
        "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n"
        "property float nx\nproperty float ny\nproperty float nz\nproperty float u\nproperty float v\n"
        "element face 4\nproperty list uchar int vertex_index\nend_header\n-1 -1 0 -.3 -.3 .9 0 .1\n"
        "1 -1 0 .3 -.3 .9 1 .3\n1 1 .2 .3 .3 .9 .8 1\n-1 1 0 -.3 .3 .9 .1 .8\n0 0 .5 0 0 1 .4 .5\n"
        "3 0 1 4\n3 1 2 4\n3 2 3 4\n3 3 0 4\n");
}

/* A bumpmap has the tangents computed. */
static aur_scene *load(size_t shape, const char *map, bool flipped, bool as_instance) {
    char body[2048], turn[256];
    snprintf(turn, sizeof turn, "<transform name='to_world'>%s</transform>", map);
    snprintf(
        body, sizeof body,
        "<bsdf type='bumpmap' id='m'><texture type='checkerboard' name='any'/><bsdf type='diffuse'/></bsdf>%s"
        "<shape type='%s' id='it'>%s%s<boolean name='flip_normals' value='%s'/><ref id='m'/></shape>%s%s%s",
        as_instance ? "<shape type='shapegroup' id='g'>" : "", shapes[shape].plugin, shapes[shape].keys,
        as_instance ? "" : turn, flipped ? "true" : "false",
        as_instance ? "</shape><shape type='instance'><ref id='g'/>" : "", as_instance ? turn : "",
        as_instance ? "</shape>" : "");
    return must_load_body(body);
}

static aur_vector apply(const double m[9], aur_vector v) {
    const double x = v.x, y = v.y, z = v.z;
    return (aur_vector){(float)(m[0] * x + m[1] * y + m[2] * z), (float)(m[3] * x + m[4] * y + m[5] * z),
                        (float)(m[6] * x + m[7] * y + m[8] * z)};
}

/* By the cofactors, which are the inverse transposed times the determinant: *sign is that one's. */
static aur_vector apply_to_normal(const double m[9], aur_vector v, double *sign) {
    double c[9];
    for (size_t i = 0; i < 3; ++i)
        for (size_t j = 0; j < 3; ++j) {
            const size_t a = (i + 1) % 3, b = (i + 2) % 3, p = (j + 1) % 3, q = (j + 2) % 3;
            c[3 * i + j] = m[3 * a + p] * m[3 * b + q] - m[3 * a + q] * m[3 * b + p];
        }
    *sign = m[0] * c[0] + m[1] * c[1] + m[2] * c[2] < 0.0 ? -1.0 : 1.0;
    return aur_vector_scale(aur_vector_normalize(apply(c, v)), (float)*sign);
}

static bool meet(const aur_scene *scene, aur_vector origin, aur_vector target, aur_hit *hit,
                 aur_surface *surface) {
    const aur_ray ray = {origin, 0.0f, aur_vector_normalize(aur_vector_subtract(target, origin)), INFINITY};
    if (!aur_scene_intersect(scene, &ray, hit))
        return false;
    aur_scene_surface(scene, &ray, hit, surface);
    return true;
}

static float round_the_seam(float difference) {
    return difference - floorf(difference + 0.5f);
}

static void ray_of(uint64_t i, aur_vector *origin, aur_vector *target) {
    *origin = aur_vector_scale(aur_sample_sphere(unit(1, i), unit(2, i)), 4.0f);
    *target = (aur_vector){1.6f * unit(3, i) - 0.8f, 1.6f * unit(4, i) - 0.8f, unit(5, i) - 0.5f};
}

/* The same ray, moved, meets the same point with the same texture coordinates; normals stay normal. */
static void moves_with_to_world(void **state) {
    (void)state;
    write_models();
    for (size_t k = 0; k < SHAPES * MAPS * 4; ++k) {
        const size_t s = k % SHAPES, m = k / SHAPES % MAPS;
        const bool flipped = k / SHAPES / MAPS % 2 == 1, as_instance = k / SHAPES / MAPS / 2 == 1;
        if (!as_instance && !fits(s, m))
            continue;
        aur_scene *const plain = load(s, "", flipped, false), *const moved =
                                                                  load(s, maps[m].xml, flipped, as_instance);
        size_t hits = 0, apart = 0;
        for (uint64_t i = 0; i < 300; ++i) {
            aur_vector origin, target;
            aur_hit hit[2];
            aur_surface at[2];
            ray_of(i, &origin, &target);
            const bool met = meet(plain, origin, target, &hit[0], &at[0]);
            if (met != meet(moved, apply(maps[m].m, origin), apply(maps[m].m, target), &hit[1], &at[1]) ||
                (met && hit[0].primitive != hit[1].primitive)) {
                ++apart; /* at an edge */
                continue;
            }
            if (!met)
                continue;
            ++hits;
            double sign;
            const aur_vector position = apply(maps[m].m, at[0].position);
            const aur_vector normal = apply_to_normal(maps[m].m, at[0].geometric_normal, &sign);
            const aur_vector smooth = apply_to_normal(maps[m].m, at[0].frame.z, &sign);
            assert_near(aur_vector_length(aur_vector_subtract(at[1].position, position)), 0.0, 1e-5);
            assert_near(aur_vector_length(aur_vector_subtract(at[1].geometric_normal, normal)), 0.0, 2e-4);
            /* Vertex normals are normalised in world space, and interpolated there: a stretch changes that.
             */
            const bool smooth_mesh =
                strcmp(shapes[s].plugin, "obj") == 0 || strcmp(shapes[s].plugin, "ply") == 0;
            if (!smooth_mesh || as_instance || fits(ROUND_SHAPE, m))
                assert_near(aur_vector_length(aur_vector_subtract(at[1].frame.z, smooth)), 0.0, 2e-4);
            if (shapes[s].allowed == RIGID)
                continue; /* counted from z in the world, as in Mitsuba 3 */
            assert_near(round_the_seam(at[1].texture.u - at[0].texture.u), 0.0, 2e-5);
            assert_near(round_the_seam(at[1].texture.v - at[0].texture.v), 0.0, 2e-5);
        }
        assert_true(hits > 25 && apart <= 2);
        aur_scene_destroy(plain);
        aur_scene_destroy(moved);
    }
}

/* The difference of neighbouring points is the tangents times the differences of texture coordinates, to
 * second order. */
static void has_the_tangents_of_its_coordinates(void **state) {
    (void)state;
    write_models();
    for (size_t k = 0; k < SHAPES * MAPS * 2; ++k) {
        const size_t s = k % SHAPES, m = k / SHAPES % MAPS;
        const bool as_instance = k / SHAPES / MAPS == 1;
        if (!as_instance && !fits(s, m))
            continue;
        aur_scene *const scene = load(s, maps[m].xml, k % 3 == 0, as_instance);
        size_t steps = 0;
        for (uint64_t i = 0; i < 300; ++i) {
            aur_vector origin, target;
            aur_hit hit[2];
            aur_surface at[2];
            ray_of(i, &origin, &target);
            origin = apply(maps[m].m, origin);
            target = apply(maps[m].m, target);
            const aur_vector shifted =
                aur_vector_add_scaled(target, 2e-3f, aur_sample_sphere(unit(6, i), unit(7, i)));
            if (!meet(scene, origin, target, &hit[0], &at[0]) ||
                !meet(scene, origin, shifted, &hit[1], &at[1]) || hit[0].primitive != hit[1].primitive)
                continue;
            const aur_vector way = aur_vector_subtract(at[1].position, at[0].position);
            const float du = round_the_seam(at[1].texture.u - at[0].texture.u),
                        dv = at[1].texture.v - at[0].texture.v;
            const float *const t = at[0].texture.tangents, length = aur_vector_length(way);
            const float facing = fabsf(aur_vector_dot(
                at[0].geometric_normal, aur_vector_normalize(aur_vector_subtract(target, origin))));
            const bool pole =
                strcmp(shapes[s].plugin, "sphere") == 0 && fabsf(at[0].texture.v - 0.5f) > 0.45f;
            const bool cap = strcmp(shapes[s].plugin, "linearcurve") == 0 && fabsf(hit[0].u - 0.5f) > 0.48f;
            const bool middle = strcmp(shapes[s].plugin, "disk") == 0 && at[0].texture.u < 0.1f;
            if (facing < 0.3f || pole || cap || middle || fabsf(dv) > 0.5f || length > 0.02f)
                continue;
            ++steps;
            assert_near((aur_vector_dot(way, at[0].frame.x) - t[0] * du - t[1] * dv) / length, 0.0, 0.04);
            assert_near((aur_vector_dot(way, at[0].frame.y) - t[2] * dv) / length, 0.0, 0.04);
        }
        assert_true(steps > 20);
        aur_scene_destroy(scene);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(moves_with_to_world),
        cmocka_unit_test(has_the_tangents_of_its_coordinates),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
