/* Scenes far away equal those near 0: rays hit the same surfaces, lights give the same. */
#include "scene_text.h"

#include <zlib.h>

#include "points/base/random.h"
#include "render/scene/materials/sampling.h"
#include "render/scene/medium.h"
#include "render/scene/origin.h"
#include "render/scene/scene_data.h"
#include "vol_file.h"

static float unit(uint64_t a, uint64_t b) {
    return aur_unit_float((uint32_t)(aur_hash2(a, b) >> 32));
}

/* Translations of the scenes. Coordinates of files have at most seven binary places, so that all are exact.
 */
static const double offsets[][3] = {
    {1e5, 1e5, 0.0},     {2600000.0, 1200000.0, 408.5},    {500000.25, 5400000.75, 113.125},
    {-1e7, 1e7, -1e7},   {691607.25, -5334760.125, 515.5}, {1e8, 0.0, 0.0},
    {0.0, 0.0, 65536.5},
};

enum { OFFSETS = sizeof offsets / sizeof offsets[0] };

/* Texts contain $x, $y and $z for x, y and z plus the coordinates of the position. */
static void expand(const char *text, const double at[3], char *expanded, size_t capacity) {
    size_t used = 0;
    for (; *text != '\0' && used + 40 < capacity; ++text) {
        if (*text != '$') {
            expanded[used++] = *text;
            continue;
        }
        const size_t axis = (size_t)(*++text - 'x');
        char *end;
        const double offset = strtod(text + 1, &end);
        used += (size_t)snprintf(expanded + used, capacity - used, "%.17g", at[axis] + offset);
        text = end - 1;
    }
    expanded[used] = '\0';
}

static const char *const mesh_obj =
    "v $x-1 $y-1 $z0\nv $x1 $y-1 $z.25\nv $x1 $y1 $z0\nv $x-1 $y1 $z.25\nf 1 2 3\nf 1 3 4\n"
    "vn 0 0 1\nvn 0.6 0 0.8\nf 1//1 2//2 3//1\n";
static const char *const mesh_ply =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\nproperty double z\n"
    "element face 2\nproperty list uchar int vertex_indices\nend_header\n$x-1 $y-1 $z0\n$x1 $y-1 $z.25\n"
    "$x1 $y1 $z0\n$x-1 $y1 $z.25\n3 0 1 2\n3 0 2 3\n";
static const char *const curve = "$x-1 $y0 $z0 .25\n$x0 $y.5 $z0 .5\n$x1 $y0 $z.25 .25\n$x2 $y1 $z0 .25\n";

static size_t serialized(const double at[3], unsigned char *file) {
    unsigned char raw[1024];
    size_t size = 0;
    const uint32_t flags = 0x2000;
    const uint64_t counts[2] = {4, 2};
    static const double corners[4][3] = {{-1, -1, 0}, {1, -1, 0.25}, {1, 1, 0}, {-1, 1, 0.25}};
    static const uint32_t indices[6] = {0, 1, 2, 0, 2, 3};
    memcpy(raw, &flags, 4);
    raw[4] = 0; /* no name */
    memcpy(raw + 5, counts, sizeof counts);
    size = 5 + sizeof counts;
    for (size_t i = 0; i < 12; ++i) {
        const double value = corners[i / 3][i % 3] + at[i % 3];
        memcpy(raw + size, &value, sizeof value);
        size += sizeof value;
    }
    memcpy(raw + size, indices, sizeof indices);
    size += sizeof indices;
    static const unsigned char head[4] = {0x1c, 0x04, 0x04, 0x00};
    memcpy(file, head, 4);
    uLongf packed = 1024;
    assert_int_equal(compress(file + 4, &packed, raw, size), Z_OK);
    const uint64_t first = 0;
    const uint32_t count = 1;
    memcpy(file + 4 + packed, &first, 8);
    memcpy(file + 12 + packed, &count, 4);
    return 16 + packed;
}

static void write_meshes(const double at[3]) {
    char text[2048];
    unsigned char bytes[2048];
    expand(mesh_obj, at, text, sizeof text);
    write_text("mesh.obj", text);
    expand(mesh_ply, at, text, sizeof text);
    write_text("mesh.ply", text);
    expand(curve, at, text, sizeof text);
    write_text("curve.txt", text);
    const size_t size = serialized(at, bytes);
    write_file("mesh.serialized", bytes, size);
}

#define FILE_SHAPE(type, name) "<shape type='" type "'><string name='filename' value='" name "'/></shape>"
#define MOVED                                                                                                \
    "<transform name='to_world'><rotate x='1' y='.5' angle='40'/><translate x='$x0' y='$y0' "                \
    "z='$z0'/></transform>"
#define BACK                                                                                                 \
    "<transform name='to_world'><translate x='$x0' y='$y0' z='$z0'/><rotate z='1' angle='90'/>"              \
    "<scale x='.5' y='-.5' z='.5'/><rotate z='1' angle='-90'/>"

/* Every shape; all lie within 3 of the position. */
static const char *const shapes[] = {
    FILE_SHAPE("obj", "mesh.obj"),
    FILE_SHAPE("ply", "mesh.ply"),
    FILE_SHAPE("serialized", "mesh.serialized"),
    FILE_SHAPE("linearcurve", "curve.txt"),
    FILE_SHAPE("bsplinecurve", "curve.txt"),
    "<shape type='rectangle'>" MOVED "</shape>",
    "<shape type='cube'>" MOVED "</shape>",
    "<shape type='disk'>" MOVED "</shape>",
    "<shape type='sphere'>" MOVED "</shape>",
    "<shape type='cylinder'>" MOVED "</shape>",
    "<shape type='sphere'><point name='center' x='$x.5' y='$y0' z='$z0'/><float name='radius' "
    "value='.75'/></shape>",
    "<shape type='cylinder'><point name='p0' x='$x-1' y='$y0' z='$z0'/><point name='p1' x='$x1' y='$y1' "
    "z='$z0'/>"
    "</shape>",
    "<shape type='polygon'><string name='vertices' value='$x-1 $y-1 $z0 $x1 $y-1 $z0 $x0 $y0 $z0 $x1 $y1 $z0 "
    "$x-1 "
    "$y1 $z0'/></shape>",
    /* copies: the group near 0 or far away, the copy far away or near */
    "<shape type='shapegroup' id='g'><shape type='cube'/><shape type='sphere'><point name='center' x='1' "
    "y='0' "
    "z='0'/></shape></shape><shape type='instance'><ref id='g'/>" MOVED "</shape>",
    "<shape type='shapegroup' id='g'>" FILE_SHAPE(
        "obj", "mesh.obj") "<shape type='sphere'>" MOVED
                           "</shape></shape><shape type='instance'><ref id='g'/></shape>",
};

/* Rays from the same positions hit the same at the same distances. Few pass so close to an edge that rounding
 * decides. */
static void compare_rays(const aur_scene *near, const aur_scene *far, const double offset[3]) {
    const aur_scene *const scenes[2] = {near, far};
    size_t hits = 0, edges = 0;
    for (size_t i = 0; i < 400; ++i) {
        aur_vector way = aur_sample_sphere(unit(1, i), unit(2, i));
        aur_vector aim = aur_vector_scale(aur_sample_sphere(unit(3, i), unit(4, i)), unit(5, i));
        aur_hit hit[2];
        aur_surface surface[2];
        bool met[2];
        for (size_t k = 0; k < 2; ++k) {
            double start[3];
            for (size_t d = 0; d < 3; ++d)
                start[d] = (k == 0 ? 0.0 : offset[d]) - 4.0 * (double)*aur_channel(&way, d) +
                           (double)*aur_channel(&aim, d);
            const aur_ray ray = {aur_internal_point(aur_scene_origin(scenes[k]), start), 0.0f, way, INFINITY};
            met[k] = aur_scene_intersect(scenes[k], &ray, &hit[k]);
            if (met[k])
                aur_scene_surface(scenes[k], &ray, &hit[k], &surface[k]);
        }
        hits += met[0];
        if (met[0] != met[1] || (met[0] && fabsf(hit[0].distance - hit[1].distance) > 1e-3f)) {
            ++edges;
            continue;
        }
        if (!met[0])
            continue;
        const double cosine = fmax(fabs((double)aur_vector_dot(surface[0].geometric_normal, way)), 1e-3);
        assert_near(hit[1].distance, hit[0].distance, 8e-6 / cosine);
        assert_near(aur_vector_length(aur_vector_subtract(surface[0].frame.z, surface[1].frame.z)), 0.0,
                    4e-5 / cosine);
    }
    assert_true(hits > 20 && edges <= 2);
}

static void rays_meet_the_same(void **state) {
    (void)state;
    static const double zero[3] = {0.0};
    for (size_t i = 0; i < sizeof shapes / sizeof shapes[0]; ++i) {
        char body[2048];
        write_meshes(zero);
        expand(shapes[i], zero, body, sizeof body);
        aur_scene *const near = must_load_body(body);
        for (size_t k = 0; k < 3; ++k)
            assert_true(aur_scene_origin(near)[k] == 0.0);
        for (size_t p = 0; p < OFFSETS; ++p) {
            write_meshes(offsets[p]);
            expand(shapes[i], offsets[p], body, sizeof body);
            aur_scene *const far = must_load_body(body);
            compare_rays(near, far, offsets[p]);
            assert_relative(far->shapes[0]->area, near->shapes[0]->area, 1e-6);
            aur_scene_description a = {.size = sizeof a}, b = a;
            assert_int_equal(aur_scene_get_description(near, &a, NULL), AUR_OK);
            assert_int_equal(aur_scene_get_description(far, &b, NULL), AUR_OK);
            for (size_t k = 0; k < 3; ++k) {
                assert_near(b.lower[k] - offsets[p][k], a.lower[k], 1e-5);
                assert_near(b.upper[k] - offsets[p][k], a.upper[k], 1e-5);
            }
            aur_scene_destroy(far);
        }
        aur_scene_destroy(near);
    }
}

/* Point lights, the camera and a volume, with a square that determines the origin. */
static void lights_and_cameras_move(void **state) {
    (void)state;
    static const char *const text =
        "<shape type='rectangle'>" MOVED "</shape>"
        "<emitter type='point'><point name='position' x='$x1' y='$y2' z='$z3'/></emitter>"
        "<emitter type='spot'><transform name='to_world'><lookat origin='$x0,$y1,$z4' target='$x0,$y0,$z0'/>"
        "</transform></emitter>"
        "<emitter type='projector'><float name='fov' value='80'/><transform name='to_world'>"
        "<lookat origin='$x0,$y1,$z4' target='$x0,$y0,$z0'/></transform></emitter>"
        "<shape type='cube'><boolean name='flip_normals' value='true'/><transform name='to_world'><scale "
        "value='5'/>"
        "<translate x='$x0' y='$y0' z='$z0'/></transform><medium name='interior' type='heterogeneous'>"
        "<volume name='sigma_t' type='gridvolume'><string name='filename' value='grid.vol'/>"
        "<transform name='to_world'><translate x='$x0' y='$y0' "
        "z='$z0'/></transform></volume></medium></shape>";
    float values[24];
    for (size_t i = 0; i < 24; ++i)
        values[i] = unit(8, i);
    size_t size;
    char *const bytes = vol_bytes(4, 3, 2, 1, values, &size);
    write_file("grid.vol", bytes, size);
    free(bytes);
    static const double zero[3] = {0.0};
    char body[4096];
    expand(text, zero, body, sizeof body);
    aur_scene *const near = must_load_body(body);
    for (size_t p = 0; p < OFFSETS; ++p) {
        expand(text, offsets[p], body, sizeof body);
        aur_scene *const far = must_load_body(body);
        for (size_t i = 0; i < 200; ++i) {
            const double at[3] = {(double)unit(1, i), (double)unit(2, i), (double)unit(3, i)};
            const double there[3] = {offsets[p][0] + at[0], offsets[p][1] + at[1], offsets[p][2] + at[2]};
            const aur_vector a = aur_internal_point(aur_scene_origin(near), at);
            const aur_vector b = aur_internal_point(aur_scene_origin(far), there);
            const float u[3] = {unit(4, i), unit(5, i), unit(6, i)};
            aur_light_sample one, other;
            assert_true(aur_light_sample_direct(near, &(aur_light_reference){.position = a}, u, &one) ==
                        aur_light_sample_direct(far, &(aur_light_reference){.position = b}, u, &other));
            assert_near(other.distance, one.distance, 1e-5);
            assert_relative(other.radiance.x, (double)one.radiance.x + 1e-9, 2e-5);
            const aur_volume *const grids[2] = {near->volumes[0], far->volumes[0]};
            assert_near(grids[1]->descriptor->evaluate(grids[1], b).x,
                        (double)grids[0]->descriptor->evaluate(grids[0], a).x, 1e-5);
        }
        aur_scene_destroy(far);
    }
    aur_scene_destroy(near);
}

static void choose(const char *body, double origin[3]) {
    aur_scene *const scene = must_load_body(body);
    memcpy(origin, aur_scene_origin(scene), 3 * sizeof *origin);
    aur_scene_destroy(scene);
}

#define CUBE_AT(size, at)                                                                                    \
    "<shape type='cube'><transform name='to_world'><scale value='" size "'/><translate x='" at "' y='" at    \
    "'/></transform></shape>"

/* Specks do not move it, wherever and however many they are; nor does a ground far larger than a house. */
static void specks_do_not_matter(void **state) {
    (void)state;
    static const char *const rows[] = {
        CUBE_AT("5", "1e6"),
        CUBE_AT("5", "1e6") CUBE_AT(".001", "0"),
        CUBE_AT("5", "1e6") CUBE_AT(".01", "-1e9"),
        CUBE_AT(".001", "0") CUBE_AT(".001", "1") CUBE_AT(".001", "2") CUBE_AT(".001", "3")
            CUBE_AT("5", "1e6"),
        CUBE_AT("5", "1e6") "<shape type='obj'><string name='filename' value='dust.obj'/></shape>",
        "<shape type='rectangle'><transform name='to_world'><scale value='3e6'/></transform></shape>" CUBE_AT(
            "5", "1e6"),
        "<shape type='rectangle'><transform name='to_world'><scale value='1e4'/><translate x='1.1e6' "
        "y='1e6'/>"
        "</transform></shape>" CUBE_AT("5", "1e6"),
        "<shape type='shapegroup' id='g'>" CUBE_AT(
            "5", "-1e7") "</shape><shape type='instance'><ref id='g'/>"
                         "<transform name='to_world'><translate x='11e6' y='11e6'/></transform></shape>",
    };
    char *const dust = malloc(200000);
    size_t used = 0;
    for (size_t i = 0; i < 1000; ++i)
        used +=
            (size_t)snprintf(dust + used, 200000 - used, "v 0 %g 0\nv .001 %g 0\nv 0 %g .001\nf -1 -2 -3\n",
                             (double)i * 0.01, (double)i * 0.01, (double)i * 0.01);
    write_text("dust.obj", dust);
    free(dust);
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; ++i) {
        double origin[3];
        choose(rows[i], origin);
        assert_near(origin[0], 1e6, 100.0);
        assert_near(origin[1], 1e6, 100.0);
        assert_near(origin[2], 0.0, 100.0);
    }
}

/* Shapes near 0 relative to their size keep their coordinates. */
static void near_scenes_stay(void **state) {
    (void)state;
    static const char *const rows[] = {"",
                                       CUBE_AT("5", "5"),
                                       CUBE_AT("5", "-100"),
                                       CUBE_AT("278", "278"),
                                       CUBE_AT("5", "5") CUBE_AT(".001", "1e7"),
                                       "<shape type='sphere'><float name='radius' value='1e-3'/></shape>"};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; ++i) {
        double origin[3];
        choose(rows[i], origin);
        assert_true(origin[0] == 0.0 && origin[1] == 0.0 && origin[2] == 0.0);
    }
}

static void record(void *said, const char *message) {
    snprintf(said, 1024, "%s", message);
}

/* Warnings for scenes that no origin makes exact: small shapes far from the others. Small shapes close to
 * others, or alone, are exact. */
static void warns_of_what_is_not_exact(void **state) {
    (void)state;
    static const struct {
        const char *body;
        const char *said;
    } rows[] = {
        {CUBE_AT("5", "1e6"), ""},
        {CUBE_AT("1e-4", "1e7"), ""},
        {CUBE_AT("1e-3", "1") CUBE_AT("5", "0"), ""},
        {"<shape type='rectangle'><transform name='to_world'><scale "
         "value='1e5'/></transform></shape>" CUBE_AT("1", "100"),
         ""},
        {CUBE_AT("5", "0") CUBE_AT("1e-3", "1e4"), "1 of 2 shapes are too small to be exact in so large a "
                                                   "scene: surfaces of the first, 0.002 wide, are "
                                                   "rounded by 0.0006"},
        {"<shape type='sphere'><point name='center' x='1e4' y='0' z='0'/><float name='radius' "
         "value='.1'/></shape>"
         "<shape type='obj'><string name='filename' value='town.obj'/></shape>",
         "1 of 2 shapes"},
    };
    char *const town = malloc(2000000);
    size_t used = 0;
    for (int i = 0; i < 10000; ++i)
        used += (size_t)snprintf(town + used, 2000000 - used, "v %d %d 0\nv %d %d 0\nv %d %d 1\nf -1 -2 -3\n",
                                 i % 100, i / 100, i % 100 + 1, i / 100, i % 100, i / 100);
    write_text("town.obj", town);
    free(town);
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; ++i) {
        char said[1024] = "";
        const aur_scene_options options = {.size = sizeof options, .warnings = {record, said}};
        aur_scene *scene;
        assert_int_equal(load_body(rows[i].body, &options, &scene, NULL), AUR_OK);
        if (rows[i].said[0] == '\0')
            assert_string_equal(said, "");
        else
            assert_non_null(strstr(said, rows[i].said));
        aur_scene_destroy(scene);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rays_meet_the_same),         cmocka_unit_test(lights_and_cameras_move),
        cmocka_unit_test(specks_do_not_matter),       cmocka_unit_test(near_scenes_stay),
        cmocka_unit_test(warns_of_what_is_not_exact),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
