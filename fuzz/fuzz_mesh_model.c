/* Models that consist of one mesh: a model and, after the first zero byte of a text, its material library. */
#include "fuzz.h"
#include "render/scene/importers/meshes/mesh_data.h"
#include "render/scene/importers/model/import.h"

typedef struct library {
    const uint8_t *data;
    size_t size;
} library;

/* File names that end in mtl refer to the library; images are missing. */
static aur_result find(void *state, const char *name, char **used, char **path, aur_error *error) {
    const library *const self = state;
    const size_t length = strlen(name);
    char model_path[64];
    (void)error;
    *used = *path = NULL;
    if (length < 3 || strcmp(name + length - 3, "mtl") != 0)
        return AUR_OK;
    snprintf(model_path, sizeof model_path, "fuzz-mesh-model-%ld", (long)getpid());
    fuzz_write_file(model_path, self->data, self->size);
    *used = strdup(name);
    *path = strdup(model_path);
    fuzz_require(*used != NULL && *path != NULL, "no memory");
    return AUR_OK;
}

/* Each part must be a mesh with at least one triangle. */
static void check_parts(const aur_model_files *files) {
    fuzz_require(files->count > 0, "a model of no part");
    for (size_t i = 0; i < files->count; ++i) {
        const aur_model_file *const file = &files->items[i];
        const aur_mesh_source source = {
            .path = "part", .format = AUR_MESH_PLY, .size = file->size, .data = file->data};
        aur_mesh_data mesh;
        aur_error error = {0};
        fuzz_require(file->data[file->size] == '\0', "a part without an end");
        fuzz_require(aur_mesh_format_of_bytes(file->size, file->data) != AUR_MESH_PLY ||
                         aur_mesh_read(&source, &mesh, &error) != AUR_OK || mesh.face_count > 0,
                     "a part without a face");
        if (error.message[0] == '\0' && aur_mesh_format_of_bytes(file->size, file->data) == AUR_MESH_PLY)
            aur_mesh_data_release(&mesh);
        fuzz_require(error.message[0] == '\0', "a part that cannot be read");
    }
}

static void check_format(aur_mesh_format format, char *text, size_t size, library *materials) {
    aur_model_stage stage = {0};
    const aur_model_source source = {.name = "a",
                                     .size = size,
                                     .data = text,
                                     .stage = size % 2 == 0 ? &stage : NULL,
                                     .location = {.file = "a"},
                                     .find = find,
                                     .state = materials};
    aur_model_files files = {0};
    aur_error error = {0};
    aur_xml_tree tree = {0};
    aur_xml_variables variables = {.arena = &tree.arena};
    aur_nodes nodes = {.tree = &tree, .variables = &variables, .error = &error};
    aur_xml_node *const root = aur_node_add(&nodes, NULL, "scene");
    const aur_result result = aur_model_from_mesh(&source, format, &files, &nodes, root);
    if (result == AUR_OK) {
        fuzz_require(root->first_child != NULL && nodes.result == AUR_OK, "a scene without elements");
        check_parts(&files);
    } else {
        fuzz_require((result == AUR_ERROR_FORMAT || result == AUR_ERROR_MEMORY) && error.message[0] != '\0',
                     "a failure of the wrong kind");
    }
    free(variables.items);
    aur_xml_tree_release(&tree);
    aur_model_release_files(&files);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    char *const copy = malloc(size + 1);
    fuzz_require(copy != NULL, "no memory");
    if (size > 0)
        memcpy(copy, data, size);
    copy[size] = '\0';
    const bool recognized = aur_mesh_format_of_bytes(size, copy) < AUR_MESH_FORMAT_COUNT;
    const size_t length = recognized ? size : strlen(copy);
    library materials = {data, 0};
    if (length < size)
        materials = (library){data + length + 1, size - length - 1};
    check_format(recognized ? AUR_MESH_PLY : AUR_MESH_OBJ, copy, length, &materials);
    free(copy);
    return 0;
}

/* --- seeds */

static const char model[] =
    "mtllib a.mtl\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1 0.5 0.5 1\nvt 0 0\nvn 0 0 1\nusemtl a\nf 1/1/1 2/1/1 "
    "3/1/1\nusemtl b 2\nf 1 3 4\nusemtl none\nf 4 3 2 1\n";
static const char materials[] = "\xef\xbb\xbfnewmtl a # x\nKd .1 .2 .3\r\nKs 0.5\nKe 1 0 0\nTr 0.25\nNs "
                                "30\nillum 2\nmap_Kd -s 2 2 2 -clamp on "
                                "a\\b.png\nd 1\nnewmtl b 2\nmap_Ke -blendu off e.png\nnorm n.png\nmap_d "
                                "x\nPr .5\nPm 1\nmap_Pr r\nmap_Pm m\n";
static const char *const more_seeds[] = {
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty "
    "uchar "
    "red\nproperty uchar green\nproperty uchar blue\nelement face 1\nproperty list uchar int "
    "vertex_indices\nend_header\n0 0 0 255 0 0\n1 0 0 0 255 0\n1 1 0 0 0 255\n3 0 1 2\n",
    "OFF\n3 1 0\n0 0 0\n1 0 0\n1 1 0\n3 0 1 2\n",
};

size_t aur_fuzz_seed(size_t index, size_t capacity, uint8_t *data) {
    if (index > 0)
        return fuzz_text_seed(sizeof more_seeds / sizeof more_seeds[0], more_seeds, index - 1, capacity,
                              data);
    fuzz_require(capacity >= sizeof model + sizeof materials, "a seed is too large");
    memcpy(data, model, sizeof model); /* including its zero byte */
    memcpy(data + sizeof model, materials, sizeof materials - 1);
    return sizeof model + sizeof materials - 1;
}
