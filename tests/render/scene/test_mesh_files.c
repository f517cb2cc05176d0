/* One surface in every spelling that mesh files have: the readers must give the same points and areas. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "points/base/vector3d.h"
#include "render/scene/importers/meshes/mesh_data.h"

static aur_result read_bytes(aur_mesh_format format, size_t size, const char *bytes, aur_mesh_data *data,
                             aur_error *error) {
    char *const copy = malloc(size + 1); /* so that reading beyond the end is seen */
    memcpy(copy, bytes, size);
    copy[size] = '\0';
    const aur_mesh_source source = {.path = "a.mesh", .format = format, .size = size, .data = copy};
    const aur_result result = aur_mesh_read(&source, data, error);
    free(copy);
    return result;
}

static double area_of(const aur_mesh_data *data) {
    double area = 0.0;
    for (size_t i = 0; i < data->triangle_count; ++i) {
        double a[3], b[3], c[3];
        for (int d = 0; d < 3; ++d) {
            const double first = data->points[3 * (size_t)data->indices[3 * i] + d];
            a[d] = data->points[3 * (size_t)data->indices[3 * i + 1] + d] - first;
            b[d] = data->points[3 * (size_t)data->indices[3 * i + 2] + d] - first;
        }
        aur_cross3(a, b, c);
        area += 0.5 * aur_length3(c);
    }
    return area;
}

typedef struct spelling {
    aur_mesh_format format;
    const char *text;
    size_t size; /* 0: the length of the text */
} spelling;

/* The square (.1, 0), (1.1, 0), (1.1, 1), (.1, 1) and a triangle (.1, 0), (1.1, 0), (.1, -2), both at z =
 * 1e7. */
#define POINTS "0.1 0 1e7\n1.1 0 1e7\n1.1 1 1e7\n.1 1 1e7\n1e-1 -2 10000000\n"
#define PLY_HEAD "element vertex 5\nproperty double x\nproperty double y\nproperty double z\n"
#define BOM "\xef\xbb\xbf"

static const spelling spellings[] = {
    {AUR_MESH_OBJ,
     "v 0.1 0 1e7\nv 1.1 0 1e7\nv 1.1 1 1e7\nv .1 1 1e7\nv 1e-1 -2 10000000\nf 1 2 3 4\nf 2 1 5\n", 0},
    {AUR_MESH_OBJ,
     BOM "# a comment\r\nmtllib a b.mtl\r\nv 0.1 0 1e7 1 # a weight\r\nv 1.1 0 1e7\r\nv 1.1 1 1e7\r\nv .1 1 "
         "1e7\r\nv 1e-1 -2 "
         "1e7\r\nf 1 2 3 4 # note\r\nf 2 1 5#note\r\n",
     0},
    {AUR_MESH_OBJ,
     "v 0.1 0 1e7\rv 1.1 0 1e7\rv 1.1 1 1e7\rv .1 1 1e7\rv 1e-1 -2 1e7\rvt 0\rvt 1\rf 1/1/ 2/2/ 3/2/ 4/1/\rf "
     "2/ 1/ 5//",
     0},
    {AUR_MESH_OBJ,
     "f 1 2 3 4\nf 2 1 5\nv 0.1 \\\n0 1e7\nv 1.1 0 1e7\nv 1.1 1 1e7\nv .1 1 1e7\nv 1e-1 -2 1e7\nvp 1\ns "
     "off\n",
     0},
    {AUR_MESH_OBJ,
     "v 0.1 0 1e7\nv 1.1 0 1e7\nv 1.1 1 1e7\nv .1 1 1e7\nvn 0 0 1\nf -4//-1 -3//1 \\\r\n-2//1 -1//1\nv .1 -2 "
     "1e7\nf 2//1 "
     "1//1 -1//1\nf 1 1\n",
     0},
    {AUR_MESH_OBJ,
     "v 0.1 0 1e7\nv 1.1 0 1e7\nv 1.1 1 1e7\nv .1 1 1e7\nv 1e-1 -2 1e7\nvt 0\nf 1 2 3/1 4\nf 002 \\\n1 5", 0},
    {AUR_MESH_OBJ,
     "v 0.1 0 1e7\nv 1.1 0 1e7\nv 1.1 1 1e7\nv .1 1 1e7\nv 1e-1 -2 1e7\nvt 0\nf\t1 2 3 4\nf 2  1 +5 \n", 0},
    {AUR_MESH_OBJ,
     "v 0.1 0 1e7\nv 1.1 0 1e7\nv 1.1 1 1e7\nv .1 1 1e7\nv 1e-1 -2 1e7\nf 1 2 2 3 3 3 3 4 4 4\nf 2 1 5\n", 0},
    {AUR_MESH_OBJ,
     "ply\nformat ascii 1.0\n" PLY_HEAD
     "element face 2\nproperty list uchar int vertex_indices\nend_header\n" POINTS "4 0 1 2 3\n3 1 0 4\n",
     0},
    {AUR_MESH_PLY,
     BOM
     "ply\r\nformat ascii 1.0\r\ncomment c\r\nelement face 2\r\nproperty list uint8 uint32 vertex_index\r\n"
     "property uchar red\r\nelement edge 1\r\nproperty int a\r\n" PLY_HEAD
     "end_header\r\n4 0 1 2 3 9\r\n3 1 0 4 9\r\n8\r\n" POINTS,
     0},
    {AUR_MESH_PLY,
     "ply\rformat ascii 1.0\relement vertex 5\rproperty float64 x\rproperty list char short l\rproperty "
     "float64 y\rproperty "
     "float64 z\relement face 2\rproperty list int int vertex_indices\rend_header\r0.1 0 0 1e7\r1.1 2 7 7 0 "
     "1e7\r1.1 0 1 "
     "1e7\r.1 0 1 1e7\r.1 0 -2 1e7\r4 0 1 2 3\r3 1 0 4",
     0},
    {AUR_MESH_STL,
     "solid a facet\n facet normal 0 0 0\n  outer loop\n vertex 0.1 0 1e7\n vertex 1.1 0 1e7\n vertex 1.1 1 "
     "1e7\nendloop\nendfacet\n"
     "facet normal 0 0 1\nouter loop\nvertex .1 0 1e7\nvertex 1.1 1 1e7\nvertex .1 1 "
     "1e7\nendloop\nendfacet\nendsolid\nsolid b\n"
     "FACET NORMAL 0 0 1\nOUTER LOOP\nVERTEX 1.1 0 1e7\nVERTEX .1 0 1e7\nVERTEX .1 -2 "
     "1e7\nENDLOOP\nENDFACET\nENDSOLID b\n",
     0},
    {AUR_MESH_STL,
     "\nsolid\rfacet normal 0 0 0\router loop\rvertex 0.1 0 1e7\rvertex 1.1 0 1e7\rvertex 1.1 1 1e7\rvertex "
     ".1 1 1e7\rendloop\r"
     "endfacet\rfacet normal 0 0 1\router loop\rvertex 1.1 0 1e7\rvertex .1 0 1e7\rvertex .1 -2 "
     "1e7\rendloop\rendfacet",
     0},
    {AUR_MESH_OFF, "OFF\n5 2 0\n" POINTS "4 0 1 2 3\n3 1 0 4\n", 0},
    {AUR_MESH_OFF, "OFF5 2 0\n" POINTS "4 0 1 2 3\n3 1 0 4\n", 0},
    {AUR_MESH_OFF,
     BOM "# c\r\nOFF 5 2 0 # counts\r\n\r\n" POINTS "# c\r\n4 0 1 2 3 255 0 0\r\n3 1 0 4 .5 .5 .5 1\r\n", 0},
    {AUR_MESH_OFF, "5 2\n" POINTS "4 0 1 2 3\n3 1 0 4", 0},
    {AUR_MESH_OFF,
     "STCNOFF\n5 2 0\n.1 0 1e7 0 0 1 255 0 0 255 0 1\n1.1 0 1e7 0 0 1 0 255 0 255 0 1\n1.1 1 1e7 0 0 1 0 0 "
     "255 0 "
     "1\n.1 1 1e7 0 0 1 1 2 3 0 1\n.1 -2 1e7 0 0 1 0 0 0 255 1 1\n4 0 1 2 3\n3 1 0 4\n",
     0},
    {AUR_MESH_OFF,
     "4OFF\n5 2 0\n.2 0 2e7 2\n1.1 0 1e7 1\n1.1 1 1e7 1\n.1 1 1e7 1\n.05 -1 5e6 .5\n4 0 1 2 3\n3 1 0 4\n", 0},
};

static void check_surface(size_t row, const aur_mesh_data *data) {
    static const double points[5][3] = {
        {.1, 0, 1e7}, {1.1, 0, 1e7}, {1.1, 1, 1e7}, {.1, 1, 1e7}, {.1, -2, 1e7}};
    assert_int_equal(data->triangle_count, 3);
    assert_near(area_of(data), 2.0, 1e-8);
    for (size_t k = 0; k < 5; ++k) {
        double nearest = HUGE_VAL;
        for (size_t i = 0; i < data->vertex_count; ++i)
            nearest = fmin(nearest, fabs(data->points[3 * i] - points[k][0]) +
                                        fabs(data->points[3 * i + 1] - points[k][1]) +
                                        fabs(data->points[3 * i + 2] - points[k][2]));
        if (nearest > 0.0 && nearest > 4e-16)
            fail_msg("row %zu: point %zu is missing by %g", row, k, nearest);
    }
}

static void spellings_are_one_surface(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof spellings / sizeof spellings[0]; ++i) {
        const size_t size = spellings[i].size > 0 ? spellings[i].size : strlen(spellings[i].text);
        aur_mesh_data data;
        aur_error error = {0};
        if (read_bytes(spellings[i].format, size, spellings[i].text, &data, &error) != AUR_OK)
            fail_msg("row %zu: %zu: %s", i, error.line, error.message);
        check_surface(i, &data);
        aur_mesh_data_release(&data);
        /* no cut of the file is read beyond its end, or crashes */
        for (size_t cut = 0; cut < size; ++cut)
            if (read_bytes(spellings[i].format, cut, spellings[i].text, &data, &error) == AUR_OK)
                aur_mesh_data_release(&data);
    }
}

/* --- binary */

static size_t put(char *to, double value, char type, bool big) {
    char bytes[8];
    const float single = (float)value;
    const uint32_t whole = (uint32_t)value;
    const size_t size = type == 'd' ? 8 : type == 'B' ? 1 : type == 'H' ? 2 : 4;
    if (type == 'd')
        memcpy(bytes, &value, 8);
    else if (type == 'f')
        memcpy(bytes, &single, 4);
    else
        memcpy(bytes, &whole, 4);
    for (size_t i = 0; i < size; ++i)
        to[i] = bytes[big ? size - 1 - i : i];
    return size;
}

static const double corners[5][3] = {{.1, 0, 1e7}, {1.1, 0, 1e7}, {1.1, 1, 1e7}, {.1, 1, 1e7}, {.1, -2, 1e7}};
static const uint32_t faces[2][5] = {{4, 0, 1, 2, 3}, {3, 1, 0, 4}};

static void binary_ply_is_the_same_surface(void **state) {
    (void)state;
    static const char *const line_ends[] = {"\n", "\r\n", "\r"};
    for (size_t variant = 0; variant < 12; ++variant) {
        const bool big = variant % 2 != 0, first = variant / 2 % 2 != 0;
        const char *const end = line_ends[variant / 4];
        const char *const face =
            "element face 2%1$sproperty uchar flags%1$sproperty list uchar ushort vertex_indices%1$s";
        const char *const vertex =
            "element vertex 5%1$sproperty double x%1$sproperty double y%1$sproperty double z%1$s";
        char form[512], bytes[1024];
        snprintf(form, sizeof form,
                 "ply%%1$sformat binary_%s_endian 1.0%%1$s%s%selement x 1%%1$sproperty list uchar float "
                 "l%%1$send_header%%1$s",
                 big ? "big" : "little", first ? face : vertex, first ? vertex : face);
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wformat-nonliteral"
#pragma GCC diagnostic ignored "-Wpedantic"
        size_t size = (size_t)snprintf(bytes, sizeof bytes, form, end);
#pragma GCC diagnostic pop
        for (size_t part = 0; part < 2; ++part) {
            for (size_t i = 0; i < 2 && (part == 0) == first; ++i) {
                size += put(bytes + size, 10, 'B', big); /* a line feed right after the header */
                size += put(bytes + size, faces[i][0], 'B', big);
                for (size_t k = 0; k < faces[i][0]; ++k)
                    size += put(bytes + size, faces[i][k + 1], 'H', big);
            }
            for (size_t i = 0; i < 15 && (part == 0) != first; ++i)
                size += put(bytes + size, corners[i / 3][i % 3], 'd', big);
        }
        size += put(bytes + size, 0, 'B', big);
        aur_mesh_data data;
        aur_error error = {0};
        if (read_bytes(AUR_MESH_PLY, size, bytes, &data, &error) != AUR_OK)
            fail_msg("variant %zu: %s", variant, error.message);
        check_surface(variant, &data);
        aur_mesh_data_release(&data);
        assert_int_equal(read_bytes(AUR_MESH_PLY, size - 1, bytes, &data, &error), AUR_ERROR_FORMAT);
        assert_non_null(strstr(error.message, "the file ends in x 0 of 1 (at byte "));
    }
}

/* Facets of three corners, as ears of the same surface. */
static size_t binary_stl(const char *head, uint32_t count, char *bytes) {
    static const uint32_t triangles[3][3] = {{0, 1, 2}, {0, 2, 3}, {1, 0, 4}};
    memset(bytes, 0, 84 + 150);
    strcpy(bytes, head);
    size_t size = 80 + put(bytes + 80, count, 'I', false);
    for (size_t i = 0; i < 3; ++i, size += 2)
        for (size_t k = 0, at = size += 12; k < 9; ++k, at = size)
            size = at + put(bytes + at, corners[triangles[i][k / 3]][k % 3], 'f', false);
    return size;
}

static void binary_stl_is_detected_by_its_bytes(void **state) {
    (void)state;
    static const struct {
        const char *head;
        uint32_t count;
        size_t more;
        const char *message; /* NULL: it is read */
    } rows[] = {
        {"exported", 3, 0, NULL},
        {"solid of an exporter\nfacet", 3, 0, NULL},
        {"exported", 0, 0, NULL},
        {"exported", UINT32_MAX, 0, NULL},
        {"exported", 3, 7, NULL},
        {"exported", 4, 0, "the header counts 4 facets, and there are bytes for 3 (at byte 80)"},
        {"exported", 1000000000, 0, "the header counts 1000000000 facets, and there are bytes for 3"}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; ++i) {
        char bytes[512];
        const size_t size = binary_stl(rows[i].head, rows[i].count, bytes);
        aur_mesh_data data;
        aur_error error = {0};
        const aur_result result = read_bytes(AUR_MESH_STL, size + rows[i].more, bytes, &data, &error);
        if (rows[i].message != NULL) {
            assert_int_equal(result, AUR_ERROR_FORMAT);
            assert_non_null(strstr(error.message, rows[i].message));
            continue;
        }
        if (result != AUR_OK)
            fail_msg("row %zu: %s", i, error.message);
        assert_int_equal(data.triangle_count, 3);
        assert_int_equal(data.vertex_count, 5); /* coincident corners are one vertex */
        assert_near(area_of(&data), 2.0, 1e-6);
        aur_mesh_data_release(&data);
    }
}

/* --- other file contents */

static void obj_groups_and_materials_are_preserved(void **state) {
    (void)state;
    static const char text[] =
        "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\ng left wall # c\nusemtl red\nf 1 2 3\nf 3 2 1\n"
        "o box\nf 1 2 3\nusemtl blue paint\ng left wall\nf 1 2 3\n";
    aur_mesh_data data;
    assert_int_equal(read_bytes(AUR_MESH_OBJ, strlen(text), text, &data, NULL), AUR_OK);
    assert_int_equal(data.groups.count, 3);
    assert_string_equal(data.groups.items[0], "default");
    assert_string_equal(data.groups.items[1], "left wall");
    assert_string_equal(data.groups.items[2], "box");
    assert_int_equal(data.materials.count, 2);
    assert_string_equal(data.materials.items[1], "blue paint");
    assert_string_equal(data.libraries.items[0], "a.mtl");
    static const struct {
        size_t face;
        uint32_t group, material;
    } spans[] = {{0, 0, AUR_MESH_NO_MATERIAL}, {1, 1, 0}, {3, 2, 0}, {4, 1, 1}};
    assert_int_equal(data.span_count, 4);
    for (size_t i = 0; i < 4; ++i) {
        assert_int_equal(data.spans[i].first_face, spans[i].face);
        assert_int_equal(data.spans[i].group, spans[i].group);
        assert_int_equal(data.spans[i].material, spans[i].material);
    }
    assert_int_equal(aur_mesh_line(&data, 4), 14);
    aur_mesh_data_release(&data);
}

static void ply_attributes_have_mitsubas_names(void **state) {
    (void)state;
    static const char text[] =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        "property float color_0\nproperty float color_1\nproperty float color_2\nproperty float "
        "heat_x\nproperty uchar b\n"
        "property uchar g\nproperty uchar r\nproperty float tint_r\nproperty float tint_g\nproperty float "
        "tint_b\n"
        "property float rough_1\nproperty float odd_2\nelement face 1\nproperty list uchar int "
        "vertex_indices\nproperty float weight_0\nend_header\n"
        "0 0 0  1 2 3  4  51 102 255  7 8 9  .5 1\n1 0 0  1 2 3  4  51 102 255  7 8 9  .5 1\n0 1 0  1 2 3  4 "
        " 51 102 255  7 8 9  .5 1\n"
        "3 0 1 2 .25\n";
    static const struct {
        const char *name;
        bool of_faces;
        size_t width;
        double values[3];
    } expected[] = {{"vertex_color", false, 3, {1, .4, .2}}, {"vertex_color", false, 3, {1, 2, 3}},
                    {"vertex_heat", false, 1, {4}},          {"vertex_tint_color", false, 3, {7, 8, 9}},
                    {"vertex_rough", false, 1, {.5}},        {"face_weight", true, 1, {.25}}};
    aur_mesh_data data;
    aur_error error = {0};
    if (read_bytes(AUR_MESH_PLY, strlen(text), text, &data, &error) != AUR_OK)
        fail_msg("%zu: %s", error.line, error.message);
    assert_int_equal(data.attribute_count, sizeof expected / sizeof expected[0]);
    for (size_t i = 0; i < data.attribute_count; ++i) {
        const aur_mesh_attribute *const a = &data.attributes[i];
        assert_string_equal(a->name, expected[i].name);
        assert_int_equal(a->of_faces, expected[i].of_faces);
        assert_int_equal(a->width, expected[i].width);
        for (size_t k = 0; k < (a->of_faces ? 1 : 3) * a->width; ++k)
            assert_near((double)a->values[k], expected[i].values[k % a->width], 1e-7);
    }
    aur_mesh_data_release(&data);
}

static void flawed_faces_are_counted(void **state) {
    (void)state;
    static const char text[] = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv .5 0 0\nv 1 1 .1\nf 1 2 3 4\nf 1 2 5 "
                               "1\nf 1 3 2 4\nf 1 5 2 6 4\nf 1 2\n"
                               "f 1 2 4\nf 1 5 3 2\n";
    aur_mesh_data data;
    assert_int_equal(read_bytes(AUR_MESH_OBJ, strlen(text), text, &data, NULL), AUR_OK);
    assert_int_equal(data.face_count, 7);
    assert_int_equal(data.triangle_count, 2 + 3 + 1 + 1);
    static const size_t counts[] = {3, 1, 3, 0}, first[] = {0, 3, 1, 0}, lines[] = {7, 10, 8, 0};
    for (size_t flaw = 0; flaw < AUR_FACE_FLAW_COUNT; ++flaw) {
        assert_int_equal(data.flaws.counts[flaw], counts[flaw]);
        assert_int_equal(data.flaws.first[flaw], first[flaw]);
        assert_int_equal(data.flaws.lines[flaw], lines[flaw]);
    }
    static const uint32_t of_triangles[] = {0, 0, 3, 3, 3, 5, 6};
    for (size_t i = 0; i < data.triangle_count; ++i)
        assert_int_equal(aur_mesh_face(&data, i), of_triangles[i]);
    aur_mesh_data_release(&data);
}

static void bad_files_are_refused_by_line(void **state) {
    (void)state;
    static const struct {
        aur_mesh_format format;
        const char *text;
        size_t line;
        const char *message;
    } rows[] = {
        {AUR_MESH_OBJ, "v 0 0 0\nv 1 0\n", 2, "expected 3 numbers"},
        {AUR_MESH_OBJ, "v 0 0 0\nf 1 2 3\nv 1 0 0\n", 2, "index 3 is not a vertex: there are 2"},
        {AUR_MESH_OBJ, "v 0 0 0\nf 1 -2 1\n", 2, "index -2 is not a vertex: there are 1 so far"},
        {AUR_MESH_OBJ, "v 0 0 0\nf 1 1 0\n", 2, "index 0 is not a vertex"},
        {AUR_MESH_OBJ, "v 0 0 0\nf 1 1 4294967297\n", 2, "index 4294967297 is not a vertex: there are 1"},
        {AUR_MESH_OBJ, "v 0 0 0\nf 1/1 1 1\n", 2, "index 1 is not a texture coordinate: there are 0"},
        {AUR_MESH_OBJ, "v 0 0 0\nf 1x 1 1\n", 2, "a face needs indices"},
        {AUR_MESH_OBJ, "v 0 0 nan\n", 1, "not finite"},
        {AUR_MESH_OBJ, "GIF89a\n", 1, "no keyword of an OBJ file"},
        {AUR_MESH_PLY, "v 0 0 0\n", 1, "must begin with 'ply'"},
        {AUR_MESH_PLY,
         "ply\nformat ascii 1.0\nelement vertex 1000000000\nproperty float x\nproperty float y\nproperty "
         "float z\n"
         "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n",
         10, "1000000000 rows of 'vertex' cannot be in 6 bytes"},
        {AUR_MESH_PLY,
         "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
         "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n3 0 1 0\n",
         11, "face 0: index 1 is not a vertex: there are 1"},
        {AUR_MESH_STL, "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0\nendloop\n", 5,
         "expected three numbers"},
        {AUR_MESH_STL, "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nendloop\n", 6,
         "a facet of 2 corners: expected 3"},
        {AUR_MESH_STL, "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n", 5,
         "the file ends within a facet"},
        {AUR_MESH_OFF, "OFF\n3 1 0\n0 0 0\n1 0 0\n", 5, "vertex 2: a number is expected"},
        {AUR_MESH_OFF, "OFF\n1 1 0\n0 0 0\n3 0 0 1\n", 4, "face 0: index 1 is not a vertex: there are 1"},
        {AUR_MESH_OFF, "OFF BINARY\n", 1, "binary OFF is not read"},
        {AUR_MESH_OFF, "nOFF 4\n", 1, "more than three dimensions"},
        {AUR_MESH_OFF, "hello\n", 1, "must begin with OFF"},
        {AUR_MESH_OFF, "OFF\n4000000000 4000000000 0\n0 0 0\n", 4, "vertex 1: a number is expected"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; ++i) {
        aur_mesh_data data;
        aur_error error = {0};
        assert_int_equal(read_bytes(rows[i].format, strlen(rows[i].text), rows[i].text, &data, &error),
                         AUR_ERROR_FORMAT);
        if (strstr(error.message, rows[i].message) == NULL || error.line != rows[i].line)
            fail_msg("row %zu: %zu: %s", i, error.line, error.message);
        assert_string_equal(error.file, "a.mesh");
        assert_null(data.points);
    }
}

int main(void) {
    static const struct CMUnitTest tests[] = {
        cmocka_unit_test(spellings_are_one_surface),
        cmocka_unit_test(binary_ply_is_the_same_surface),
        cmocka_unit_test(binary_stl_is_detected_by_its_bytes),
        cmocka_unit_test(obj_groups_and_materials_are_preserved),
        cmocka_unit_test(ply_attributes_have_mitsubas_names),
        cmocka_unit_test(flawed_faces_are_counted),
        cmocka_unit_test(bad_files_are_refused_by_line),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
