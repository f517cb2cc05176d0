#include "render/scene/scene_data.h"
#include "scene_text.h"

#include <zlib.h>

#include "points/base/random.h"
#include "render/scene/elements.h"
#include "render/scene/materials/sampling.h"

static float unit(uint64_t a, uint64_t b) {
    return aur_unit_float((uint32_t)(aur_hash2(a, b) >> 32));
}

/* The value of a shape's equation at a local point, and its gradient: 0 on the surface. */
static double equation(const char *name, const double p[3], double gradient[3]) {
    gradient[0] = p[0];
    gradient[1] = p[1];
    gradient[2] = strcmp(name, "sphere") == 0 ? p[2] : 0.0;
    if (strcmp(name, "disk") == 0) {
        gradient[0] = gradient[1] = 0.0;
        gradient[2] = 1.0;
        return p[2];
    }
    return 0.5 * (p[0] * p[0] + p[1] * p[1] + gradient[2] * p[2] - 1.0);
}

/* Hits lie on the surface, normals along its gradient, and rays that leave do not meet it again at once; a
 * ray meets a sphere twice or never. */
static void hits_curved_shapes(void **state) {
    (void)state;
    static const char *const names[] = {"sphere", "disk", "cylinder"};
    for (size_t n = 0; n < 3; ++n) {
        char body[512];
        snprintf(
            body, sizeof body,
            "<shape type='%s'><transform name='to_world'><scale value='20'/><rotate x='1' y='2' angle='33'/>"
            "<translate x='100' y='-50' z='7'/></transform></shape>",
            names[n]);
        aur_scene *const scene = must_load_body(body);
        size_t hits = 0;
        for (size_t i = 0; i < 20000; ++i) {
            const aur_vector far = aur_sample_sphere(unit(1, i), unit(2, i));
            const aur_vector near = aur_vector_scale(aur_sample_sphere(unit(3, i), unit(4, i)), 18.0f);
            const aur_vector center = {100.0f, -50.0f, 7.0f};
            const aur_vector origin = aur_vector_add_scaled(center, 300.0f, far);
            const aur_vector target = aur_vector_add(center, near);
            const aur_ray ray = {origin, 0.0f, aur_vector_normalize(aur_vector_subtract(target, origin)),
                                 INFINITY};
            aur_hit hit;
            if (!aur_scene_intersect(scene, &ray, &hit))
                continue;
            ++hits;
            assert_true(aur_scene_occluded(scene, &ray));
            aur_surface surface;
            aur_scene_surface(scene, &ray, &hit, &surface);
            /* Undo the transform by hand: translate, rotate, scale. */
            aur_vector p = aur_vector_scale(aur_vector_subtract(surface.position, center), 1.0f / 20.0f);
            aur_vector normal = surface.geometric_normal;
            const double s = sin(-33.0 * AUR_PI / 180.0), c = cos(-33.0 * AUR_PI / 180.0);
            const aur_vector k = aur_vector_normalize((aur_vector){1, 2, 0});
            for (size_t turn = 0; turn < 2; ++turn) { /* Rodrigues' formula */
                const aur_vector v = turn == 0 ? p : normal;
                aur_vector r = aur_vector_scale(v, (float)c);
                r = aur_vector_add_scaled(r, (float)s, aur_vector_cross(k, v));
                r = aur_vector_add_scaled(r, aur_vector_dot(k, v) * (float)(1.0 - c), k);
                *(turn == 0 ? &p : &normal) = r;
            }
            double gradient[3];
            assert_near(equation(names[n], (double[3]){p.x, p.y, p.z}, gradient), 0.0, 3e-6);
            assert_near(gradient[0], normal.x, 1e-5);
            assert_near(gradient[1], normal.y, 1e-5);
            assert_near(gradient[2], normal.z, 1e-5);
            assert_true(surface.texture.u >= 0.0f && surface.texture.u <= 1.0f + 1e-6f);
            assert_true(surface.texture.v >= 0.0f && surface.texture.v <= 1.0f + 1e-6f);
            /* further through the shape */
            const aur_ray continuation = aur_surface_ray(&surface, ray.direction);
            aur_hit second;
            const bool again = aur_scene_intersect(scene, &continuation, &second);
            if (n == 0 && fabsf(aur_vector_dot(normal, ray.direction)) > 0.01f)
                assert_true(again);
            if (again)
                assert_true(n != 1 && second.distance > 1e-3f);
        }
        assert_true(hits > 2000);
        aur_scene_destroy(scene);
    }
}

static aur_vector first_corner_normal(const aur_scene *scene, aur_bsdf_point *texture) {
    const aur_ray ray = {{0.25f, 0.25f, 5.0f}, 0.0f, {0.0f, 0.0f, -1.0f}, INFINITY};
    aur_hit hit;
    aur_surface surface;
    assert_true(aur_scene_intersect(scene, &ray, &hit));
    aur_scene_surface(scene, &ray, &hit, &surface);
    assert_near(hit.distance, 4.0, 1e-6);
    *texture = surface.texture;
    return surface.frame.z;
}

static void put(unsigned char **at, const void *value, size_t size, bool big) {
    for (size_t i = 0; i < size; ++i)
        (*at)[i] = ((const unsigned char *)value)[big ? size - 1 - i : i];
    *at += size;
}

/* One square in the plane z = 1, tilted normals, texture coordinates, a list that is to be left out. */
static size_t make_ply(char *file, int format) {
    static const float corners[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    static const char *const formats[] = {"ascii", "binary_little_endian", "binary_big_endian"};
    int used = sprintf(
        file,
        "ply\nformat %s 1.0\ncomment a square\nelement vertex 4\nproperty float x\nproperty double y\n"
        "property float z\nproperty uchar red\nproperty float nx\nproperty float ny\n"
        "property float nz\nproperty float s\nproperty float t\nelement other 1\n"
        "property list uchar short stuff\nelement face 1\nproperty int flag\n"
        "property list uchar int vertex_indices\nend_header\n",
        formats[format]);
    unsigned char *at = (unsigned char *)file + used;
    const float one = 1.0f, normal[3] = {0.6f, 0.0f, 0.8f};
    for (size_t i = 0; i < 4; ++i) {
        const double y = corners[i][1];
        if (format == 0) {
            at += sprintf((char *)at, "%g %g 1 255 0.6 0 0.8 %g %g\n", (double)corners[i][0], y,
                          (double)corners[i][0], y * 2.0);
            continue;
        }
        const float t = 2.0f * corners[i][1];
        put(&at, &corners[i][0], 4, format == 2);
        put(&at, &y, 8, format == 2);
        put(&at, &one, 4, format == 2);
        put(&at, "\xff", 1, false);
        for (size_t k = 0; k < 3; ++k)
            put(&at, &normal[k], 4, format == 2);
        put(&at, &corners[i][0], 4, format == 2);
        put(&at, &t, 4, format == 2);
    }
    if (format == 0)
        return (size_t)(at - (unsigned char *)file) + (size_t)sprintf((char *)at, "2 7 8\n-3 4 0 1 2 3\n");
    put(&at, "\2\0\7\0\7", 5, false); /* two short values that nobody wants */
    for (int32_t i = -1; i < 4; ++i) {
        const unsigned char four = 4;
        put(&at, &i, 4, format == 2);
        if (i < 0)
            put(&at, &four, 1, false);
    }
    return (size_t)(at - (unsigned char *)file);
}

static void reads_ply_in_three_forms(void **state) {
    (void)state;
    for (int format = 0; format < 3; ++format) {
        char file[2048];
        write_file("square.ply", file, make_ply(file, format));
        aur_scene *const scene =
            must_load_body("<shape type='ply'><string name='filename' value='square.ply'/></shape>");
        aur_bsdf_point texture;
        const aur_vector normal = first_corner_normal(scene, &texture);
        assert_near(normal.x, 0.6, 1e-6);
        assert_near(normal.z, 0.8, 1e-6);
        assert_near(texture.u, 0.25, 1e-6);
        assert_near(texture.v, 0.5, 1e-6);
        aur_scene_destroy(scene);
    }
}

/* Flag 0x2000 is double precision; 0x1000, single, may be missing. */
static size_t make_serialized(unsigned char *file, uint32_t precision) {
    const bool wide = precision == 0x2000u;
    unsigned char plain[1024], *at = plain;
    const uint32_t flags = precision | 2u;
    const uint64_t counts[2] = {4, 2};
    static const double positions[12] = {0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1},
                        uvs[8] = {0, 0, 1, 0, 1, 2, 0, 2};
    static const uint32_t indices[6] = {0, 1, 2, 0, 2, 3};
    put(&at, &flags, 4, false);
    put(&at, "name", 5, false);
    put(&at, counts, 16, false);
    for (size_t i = 0; i < 20; ++i) {
        const double value = i < 12 ? positions[i] : uvs[i - 12];
        const float narrow = (float)value;
        put(&at, wide ? (const void *)&value : &narrow, wide ? 8 : 4, false);
    }
    put(&at, indices, 24, false);
    memcpy(file, "\x1c\x04\x04\0", 4);
    uLongf size = 1024;
    assert_int_equal(compress(file + 4, &size, plain, (uLong)(at - plain)), Z_OK);
    unsigned char *end = file + 4 + size;
    const uint64_t offset = 0;
    const uint32_t count = 1;
    put(&end, &offset, 8, false);
    put(&end, &count, 4, false);
    return (size_t)(end - file);
}

static void reads_serialized_meshes(void **state) {
    (void)state;
    unsigned char file[2048];
    for (uint32_t precision = 0; precision <= 0x2000; precision += 0x1000) {
        write_file("square.serialized", file, make_serialized(file, precision));
        aur_scene *const scene = must_load_body(
            "<shape type='serialized'><string name='filename' value='square.serialized'/></shape>");
        aur_bsdf_point texture;
        const aur_vector normal = first_corner_normal(scene, &texture);
        assert_near(normal.z, 1.0, 1e-6);
        assert_near(texture.v, 0.5, 1e-6);
        aur_scene_destroy(scene);
    }
    /* cut anywhere, it is refused and nothing breaks */
    const size_t size = make_serialized(file, 0x1000);
    for (size_t cut = 0; cut < size; ++cut) {
        write_file("square.serialized", file, cut);
        aur_scene *scene;
        assert_int_equal(
            load_body("<shape type='serialized'><string name='filename' value='square.serialized'/></shape>",
                      NULL, &scene, NULL),
            AUR_ERROR_FORMAT);
    }
}

static void reads_obj(void **state) {
    (void)state;
    write_text("square.obj",
               "# a square\r\nmtllib none.mtl\nv 0 0 1\nv 1 0 1.0e0\nv +1. 1 1\nv 0 1 \\\n 1 1.0\n"
               "vt 0 0\nvt 1 0\nvt 1 0.5\nvt 0 0.5\nvn 0.6 0 0.8\ng side\nusemtl x\ns off\n"
               "f -4/1/1 2/2/1 3/3/-1 4/4/1 # end\n");
    aur_scene *const scene =
        must_load_body("<shape type='obj'><string name='filename' value='square.obj'/></shape>");
    aur_bsdf_point texture;
    const aur_vector normal = first_corner_normal(scene, &texture);
    assert_near(normal.x, 0.6, 1e-6);
    assert_near(texture.u, 0.25, 1e-6);
    assert_near(texture.v, 1.0 - 0.125, 1e-6); /* v is turned over */
    aur_scene_destroy(scene);
}

/* Without normals in the file, corners get the mean of their triangles'. */
static void smooths_without_normals(void **state) {
    (void)state;
    write_text("roof.obj", "v -1 0 0\nv 0 0 1\nv 1 0 0\nv -1 1 0\nv 0 1 1\nv 1 1 0\nf 1 2 5 4\nf 2 3 6 5\n");
    static const double expected[2] = {0.0, 0.70710678};
    for (size_t flat = 0; flat < 2; ++flat) {
        char body[256];
        snprintf(body, sizeof body,
                 "<shape type='obj'><string name='filename' value='roof.obj'/><boolean name='face_normals' "
                 "value='%s'/></shape>",
                 flat == 1 ? "true" : "false");
        aur_scene *const scene = must_load_body(body);
        const aur_ray ray = {{1e-5f, 0.5f, 5.0f}, 0.0f, {0.0f, 0.0f, -1.0f}, INFINITY};
        aur_hit hit;
        aur_surface surface;
        assert_true(aur_scene_intersect(scene, &ray, &hit));
        aur_scene_surface(scene, &ray, &hit, &surface);
        assert_near(fabs((double)surface.frame.z.x), expected[flat], 2e-4);
        aur_scene_destroy(scene);
    }
}

/* A wall that turns nowhere is flat, whether the file has its normals or not; a roof's ridge is not, and
 * neither are normals that lean. */
static void drops_flat_normals(void **state) {
    (void)state;
    static const struct {
        const char *text;
        bool flat;
    } rows[] = {
        {"v .1 0 0\nv 1 .3 0\nv 1 .3 7\nv .1 0 7\nf 1 2 3 4\n", true},
        {"v 0 0 0\nv 1 0 0\nv 1 1 0\nvn 0 0 1\nf 1//1 2//1 3//1\n", true},
        {"v 0 0 0\nv 1 0 0\nv 1 1 0\nvn 0 0 1\nvn 0 .001 1\nf 1//1 2//1 3//2\n", false},
        {"v 0 0 0\nv 1 0 0\nv 1 1 0\nvn 0 0 -1\nf 1//1 2//1 3//1\n", false},
        {"v -1 0 0\nv 0 0 1\nv 1 0 0\nv -1 1 0\nv 0 1 1\nv 1 1 0\nf 1 2 5 4\nf 2 3 6 5\n", false},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; ++i) {
        write_text("wall.obj", rows[i].text);
        aur_scene *const scene = must_load_body(
            "<shape type='obj'><string name='filename' value='wall.obj'/><transform name='to_world'>"
            "<rotate x='1' y='2' z='3' angle='77'/></transform></shape>");
        assert_int_equal(aur_shape_is_flat(scene, 0), rows[i].flat);
        aur_scene_destroy(scene);
    }
}

/* Coordinates whose products overflow give no normal rather than NaN. */
static void normals_are_finite(void **state) {
    (void)state;
    write_text("vast.obj", "v 0 0 0\nv 1e30 0 0\nv 0 1e30 1e30\nv 0 1 0\nv 1 0 0\nf 1 2 3\nf 1 4 5\n");
    aur_scene *const scene =
        must_load_body("<shape type='obj'><string name='filename' value='vast.obj'/></shape>");
    const aur_mesh *const mesh = &scene->shapes[0]->mesh;
    assert_non_null(mesh->normals);
    for (size_t i = 0; i < 3 * mesh->vertex_count; ++i)
        assert_true(isfinite(mesh->normals[i]));
    aur_scene_destroy(scene);
}

/* Elements of a PLY file may be in any order. */
static void reads_faces_before_vertices(void **state) {
    (void)state;
    write_text(
        "first.ply",
        "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\nelement vertex 4\n"
        "property float x\nproperty float y\nproperty float z\nend_header\n4 0 1 2 3\n0 0 0\n1 0 0\n1 1 0\n"
        "0 1 0\n");
    aur_scene *const scene =
        must_load_body("<shape type='ply'><string name='filename' value='first.ply'/></shape>");
    assert_int_equal(aur_scene_shape_triangles(scene, 0), 2);
    aur_vector lower, upper;
    aur_scene_bounds(scene, &lower, &upper);
    assert_near(upper.x - lower.x, 1.0, 1e-6);
    aur_scene_destroy(scene);
}

/* Errors in a mesh file, with the line and message that report them. */
static const struct bad_mesh {
    const char *file, *text;
    size_t line;
    const char *message;
} bad_meshes[] = {
    {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", 4, "index 4 is not a vertex: there are 3"},
    {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 1000000000\n", 4, "is not a vertex"},
    {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 -4\n", 4, "index -4 is not a vertex"},
    {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 0\n", 4, "index 0 is not a vertex"},
    {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/1 2 3\n", 4, "is not a texture coordinate"},
    {"a.obj", "v 0 0 nan\n", 1, "not finite"},
    {"a.obj", "v 0 0 1e40\n", 1, "not finite, or beyond"},
    {"a.obj", "v 0 0\n", 1, "expected 3 numbers"},
    {"a.obj", "v 0 0 0\nf 1 1 x\n", 2, "indices such as"},
    {"a.obj", "v 0 0 0\nfoo\n", 2, "begins with no keyword of an OBJ file"},
    {"a.obj", "v 0 0 0\n", 0, "no face"},
    {"a.obj", "", 0, "no face"},
    {"a.ply", "plx\n", 1, "must begin with 'ply'"},
    {"a.ply", "ply\nformat binary 1.0\n", 2, "the format must be"},
    {"a.ply", "ply\nformat ascii 1.0\nelement vertex 3\n", 4, "'end_header' is missing"},
    {"a.ply", "ply\nformat ascii 1.0\nelement vertex 3\nend_header\n", 4, "needs the properties x, y and z"},
    {"a.ply",
     "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement "
     "face 1\n"
     "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n",
     13, "face 0: index 3 is not a vertex: there are 3"},
    {"a.ply",
     "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement "
     "face 1\n"
     "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 inf\n0 1 0\n3 0 1 2\n",
     11, "vertex 1 is not finite"},
    {"a.ply",
     "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement "
     "face 1\n"
     "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1\n",
     13, "the file ends in vertex 2 of 3"},
    {"a.ply",
     "ply\nformat binary_little_endian 1.0\nelement vertex 3000000000\nproperty float x\nproperty float y\n"
     "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0000",
     0, "3000000000 rows of 'vertex' cannot be in 4 bytes"},
    {"a.ply",
     "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement "
     "face 999999999999\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n",
     13, "the file ends in vertex 2 of 3"},
    {"a.ply", "ply\nformat ascii 1.0\nelement vertex 3x\n", 3, "an element needs a name and a count"},
    {"a.serialized", "xxxxxxxxxxxxxxxxxxx", 0, "not a serialized mesh file"},
};

static void says_what_is_wrong_in_meshes(void **state) {
    (void)state;
    size_t wrong = 0;
    for (size_t i = 0; i < sizeof bad_meshes / sizeof bad_meshes[0]; ++i) {
        const struct bad_mesh *const row = &bad_meshes[i];
        write_text(row->file, row->text);
        char body[256];
        snprintf(body, sizeof body, "<shape type='%s'><string name='filename' value='%s'/></shape>",
                 strchr(row->file, '.') + 1, row->file);
        aur_scene *scene = NULL;
        aur_error error = {0};
        if (load_body(body, NULL, &scene, &error) == AUR_ERROR_FORMAT && error.line == row->line &&
            strstr(error.message, row->message) != NULL && strstr(error.file, row->file) != NULL)
            continue;
        ++wrong;
        print_error("row %zu: %s\n  gives %s:%zu: %s\n", i, row->text, error.file, error.line, error.message);
    }
    assert_int_equal(wrong, 0);
}

/* Instances of a group equal the same shapes transformed individually, hit by hit. */
static void copies_groups(void **state) {
    (void)state;
    static const char *const move =
        "<transform name='to_world'><scale x='2' y='-1' z='0.5'/><rotate x='1' y='3' "
        "angle='40'/><translate x='5' y='1'/></transform>";
    char body[2048];
    write_text("bump.obj",
               "v 0 0 0\nv 2 0 0\nv 2 2 1\nv 0 2 0\nv 1 1 2\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n");
    snprintf(
        body, sizeof body,
        "<shape type='shapegroup' id='g'><shape type='obj'><string name='filename' value='bump.obj'/></shape>"
        "<shape type='cube'/></shape><shape type='instance'><ref id='g'/>%s</shape>",
        move);
    aur_scene *const copied = must_load_body(body);
    snprintf(
        body, sizeof body,
        "<shape type='obj'><string name='filename' value='bump.obj'/>%s</shape><shape type='cube'>%s</shape>",
        move, move);
    aur_scene *const moved = must_load_body(body);
    size_t hits = 0, apart = 0;
    for (size_t i = 0; i < 5000; ++i) {
        const aur_vector center = {5.0f, 1.0f, 0.0f};
        const aur_vector origin =
            aur_vector_add_scaled(center, 12.0f, aur_sample_sphere(unit(1, i), unit(2, i)));
        const aur_vector target =
            aur_vector_add_scaled(center, 2.0f, aur_sample_sphere(unit(3, i), unit(4, i)));
        const aur_ray ray = {origin, 0.0f, aur_vector_normalize(aur_vector_subtract(target, origin)),
                             INFINITY};
        aur_hit hit[2];
        const bool found = aur_scene_intersect(copied, &ray, &hit[0]);
        const bool expected = aur_scene_intersect(moved, &ray, &hit[1]);
        /* rounding at silhouettes */
        if (found != expected || (found && fabsf(hit[0].distance - hit[1].distance) > 1e-4f)) {
            ++apart;
            continue;
        }
        if (!found)
            continue;
        ++hits;
        aur_surface surface[2];
        aur_scene_surface(copied, &ray, &hit[0], &surface[0]);
        aur_scene_surface(moved, &ray, &hit[1], &surface[1]);
        assert_int_equal(hit[0].instance, 0);
        assert_int_equal(hit[1].instance, AUR_NO_INSTANCE);
        assert_near(aur_vector_length(aur_vector_subtract(surface[0].position, surface[1].position)), 0.0,
                    1e-4);
        assert_near(aur_vector_dot(surface[0].geometric_normal, surface[1].geometric_normal), 1.0, 1e-4);
        assert_true(aur_scene_occluded(copied, &ray));
    }
    assert_in_range(hits, 1000, 5000);
    assert_in_range(apart, 0, 10);
    aur_vector lower[2], upper[2];
    aur_scene_bounds(copied, &lower[0], &upper[0]);
    aur_scene_bounds(moved, &lower[1], &upper[1]);
    assert_true(lower[0].x <= lower[1].x + 1e-4f && upper[0].z >= upper[1].z - 1e-4f);
    aur_scene_destroy(copied);
    aur_scene_destroy(moved);
}

/* Degenerate triangles are no error and give no NaN. */
static void bears_degenerate_triangles(void **state) {
    (void)state;
    write_text("thin.obj",
               "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 1e-30 0 0\nf 1 2 3\nf 1 1 1\nf 1 2 4\nf 1 5 4\n");
    aur_scene *const scene = must_load_body("<shape type='obj'><string name='filename' value='thin.obj'/>"
                                            "<emitter type='area'/></shape>");
    for (size_t i = 0; i < 2000; ++i) {
        const float u[5] = {unit(1, i), unit(2, i), unit(3, i), unit(4, i), unit(5, i)};
        aur_light_sample sample;
        if (aur_light_sample_direct(scene, &(aur_light_reference){.position = {0.1f, 0.1f, 1.0f}}, u,
                                    &sample))
            assert_true(isfinite(sample.pdf) && sample.pdf > 0.0f && aur_vector_is_finite(sample.direction));
        aur_ray ray;
        aur_vector power;
        assert_true(aur_light_emit(scene, u, &ray, &power, &(bool){false}));
        assert_true(aur_vector_is_finite(ray.direction) && aur_vector_is_finite(power));
    }
    aur_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(hits_curved_shapes),
        cmocka_unit_test(reads_ply_in_three_forms),
        cmocka_unit_test(reads_serialized_meshes),
        cmocka_unit_test(reads_obj),
        cmocka_unit_test(smooths_without_normals),
        cmocka_unit_test(drops_flat_normals),
        cmocka_unit_test(normals_are_finite),
        cmocka_unit_test(reads_faces_before_vertices),
        cmocka_unit_test(says_what_is_wrong_in_meshes),
        cmocka_unit_test(bears_degenerate_triangles),
        cmocka_unit_test(copies_groups),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
