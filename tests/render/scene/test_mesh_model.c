/* Models of one mesh: OBJ by its materials, in double precision, and material libraries as strangers write
 * them. */
#include "check.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "render/scene/importers/meshes/mesh_data.h"
#include "render/scene/importers/model/model.h"
#include "render/scene/importers/model/mtl.h"

/* --- material libraries */

static aur_mtl_library read_library(const char *text) {
    aur_mtl_library library = {0};
    assert_int_equal(aur_mtl_read(&library, strlen(text), text, NULL), AUR_OK);
    return library;
}

static void test_library(void **state) {
    (void)state;
    aur_mtl_library library =
        read_library("\xef\xbb\xbf# by hand\r\nKd 1 1 1\r\nnewmtl Material #25 \r\n\tKd .1 .2 .3 # dark\r\n"
                     "  Ks 0.5\r\nTr 0.25\r\nNs 30\r\nillum 2\r\nmap_kd -s 2 2 2 -o 0.5 -clamp on "
                     "My Textures\\wood #1.png\r\nPr\r\nPm nan\r\nKe -1 2 1e99\r\n"
                     "newmtl b\rd .5\rmap_Ke -blendu off e.png\rnorm n.png\rKd\rnewmtl Material #26");
    assert_int_equal(library.count, 3);
    const aur_mtl_material *const a = aur_mtl_find(&library, "Material #25");
    const aur_mtl_material *const b = aur_mtl_find(&library, "b");
    assert_non_null(a);
    assert_non_null(b);
    assert_non_null(aur_mtl_find(&library, "Material #26"));
    assert_null(aur_mtl_find(&library, "Material"));
    assert_true(a->diffuse[0] == 0.1 && a->diffuse[1] == 0.2 && a->diffuse[2] == 0.3);
    assert_true(a->specular[0] == 0.5 && a->specular[1] == 0.5 && a->specular[2] == 0.5);
    assert_true(a->opacity == 0.75 && a->shininess == 30.0);
    assert_true(isnan(a->roughness) && isnan(a->metal));
    assert_string_equal(a->images[AUR_MTL_DIFFUSE].name, "My Textures/wood #1.png");
    assert_true(a->images[AUR_MTL_DIFFUSE].clamped);
    assert_true(b->opacity == 0.5 && isnan(b->diffuse[0]) && !b->images[AUR_MTL_EMISSION].clamped);
    assert_string_equal(b->images[AUR_MTL_EMISSION].name, "e.png");
    assert_string_equal(b->images[AUR_MTL_NORMAL].name, "n.png");
    aur_mtl_release(&library);
}

/* --- meshes */

typedef struct heard {
    size_t count;
    char last[AUR_ERROR_MESSAGE_CAPACITY];
} heard;

static void hear(void *user, const char *message) {
    heard *const self = user;
    ++self->count;
    snprintf(self->last, sizeof self->last, "%s", message);
}

static aur_result find_nothing(void *state, const char *name, char **used, char **path, aur_error *error) {
    (void)state, (void)name, (void)error;
    *used = *path = NULL;
    return AUR_OK;
}

/* The conversion of a model. */
typedef struct translation {
    aur_xml_tree tree;
    aur_model_files files;
    heard warnings;
} translation;

static void translate(const char *name, const char *text, translation *imported) {
    *imported = (translation){0};
    aur_error error = {0};
    const aur_warnings to = {hear, &imported->warnings};
    const aur_model_source source = {.name = name,
                                     .size = strlen(text),
                                     .data = text,
                                     .warnings = &to,
                                     .location = {.file = name},
                                     .find = find_nothing};
    aur_xml_variables variables = {.arena = &imported->tree.arena};
    aur_nodes nodes = {.tree = &imported->tree, .variables = &variables, .error = &error};
    if (aur_model_read(&source, &imported->files, &nodes, aur_node_add(&nodes, NULL, "scene")) != AUR_OK)
        fail_msg("%s", error.message);
    free(variables.items);
}

static void release(translation *imported) {
    aur_xml_tree_release(&imported->tree);
    aur_model_release_files(&imported->files);
}

/* How many elements below `node` have the tag and, where it is given, the value of an attribute. */
static size_t count_of(const aur_xml_node *node, const char *tag, const char *attribute, const char *value) {
    size_t count = 0;
    for (const aur_xml_node *child = node->first_child; child != NULL; child = child->next) {
        const char *const found = attribute != NULL ? aur_xml_attribute_value(child, attribute) : NULL;
        count += strcmp(child->tag, tag) == 0 &&
                 (attribute == NULL || (found != NULL && strcmp(found, value) == 0));
        count += count_of(child, tag, attribute, value);
    }
    return count;
}

static aur_mesh_data read_part(const aur_model_file *part) {
    aur_mesh_data data;
    const aur_mesh_source source = {part->name, AUR_MESH_PLY, part->size, part->data, false};
    assert_int_equal(aur_mesh_read(&source, &data, NULL), AUR_OK);
    return data;
}

/* Faces of two materials by turns, and without one: each corner is where the file has it, to the last digit.
 */
static void test_parts(void **state) {
    (void)state;
    static const double points[4][3] = {{500000.3, 5400000.7, 412.15},
                                        {500001.1, 5400000.7, 412.15},
                                        {500001.1, 5400001.9, 412.15},
                                        {500000.3, 5400001.9, 413.05}};
    static const char text[] =
        "mtllib none.mtl\nv 500000.3 5400000.7 412.15\nv 500001.1 5400000.7 412.15\n"
        "v 500001.1 5400001.9 412.15\nv 500000.3 5400001.9 413.05\nvt 0 .25\nvt 1 0\n"
        "f 1/1 2/2 3/1\nusemtl a\nf 1/1 3/2 4/1\nusemtl b\nf 1/1 2/2 4/1\nusemtl a\nf 2/2 3/1 4/1\n";
    static const uint8_t corners[3][2][3] = {{{0, 2, 3}, {1, 2, 3}}, {{0, 1, 3}}, {{0, 1, 2}}};
    static const size_t counts[3] = {2, 1, 1};
    translation imported;
    translate("a.obj", text, &imported);
    assert_int_equal(imported.files.count, 3);
    assert_int_equal(count_of(imported.tree.root, "shape", "type", "ply"), 3);
    assert_int_equal(count_of(imported.tree.root, "emitter", NULL, NULL), 0);
    assert_int_equal(imported.warnings.count, 1);
    assert_non_null(strstr(imported.warnings.last, "1 file cannot be found: 'none.mtl'"));
    for (size_t i = 0; i < 3; ++i) {
        aur_mesh_data data = read_part(&imported.files.items[i]);
        assert_int_equal(data.triangle_count, counts[i]);
        for (size_t k = 0; k < 3 * counts[i]; ++k) {
            const double *const expected = points[corners[i][k / 3][k % 3]];
            const double *const point = &data.points[3 * (size_t)data.indices[k]];
            assert_true(point[0] == expected[0] && point[1] == expected[1] && point[2] == expected[2]);
        }
        assert_true(data.uvs[1] == 0.75f || data.uvs[1] == 1.0f);
        aur_mesh_data_release(&data);
    }
    release(&imported);
}

/* Files of one material are taken as they are. */
static void test_whole(void **state) {
    (void)state;
    static const char *const rows[][3] = {
        {"a.ply", "ply",
         "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\nproperty double z\n"
         "property uchar red\nproperty uchar green\nproperty uchar blue\nelement face 1\n"
         "property list uchar int vertex_indices\nend_header\n0 0 0 1 2 3\n1 0 0 1 2 3\n0 1 0 1 2 3\n3 0 1 "
         "2\n"},
        {"a.off", "off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"},
        {"a.STL", "stl",
         "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
         "0\nendloop\nendfacet\n"
         "endsolid s\n"},
        /* by its bytes, whatever its name is */
        {"b.obj", "off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; ++i) {
        translation imported;
        translate(rows[i][0], rows[i][2], &imported);
        assert_int_equal(count_of(imported.tree.root, "shape", "type", rows[i][1]), 1);
        assert_int_equal(count_of(imported.tree.root, "string", "value", "vertex_color"), i == 0);
        assert_int_equal(imported.files.count, 1);
        assert_string_equal(imported.files.items[0].data, rows[i][2]);
        assert_int_equal(imported.files.items[0].size, strlen(rows[i][2]));
        release(&imported);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_library), cmocka_unit_test(test_parts),
                                       cmocka_unit_test(test_whole)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
