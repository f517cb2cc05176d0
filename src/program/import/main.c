/* aureole-import PARENT: reads a model by assimp, and gives it as elements and files to the process that
 * started it. Standard input is a socket; see render/scene/importers/model/message.h. The library starts it
 * (render/scene/importers/model/import.c), so that a file which assimp cannot bear ends this process alone.
 */
#include <assimp/cimport.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <aureole/text.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

#include "program/import/gltf.h"
#include "program/import/writer.h"

static bool ends_with(const char *name, const char *ending) {
    const size_t length = strlen(name), own = strlen(ending);
    return length >= own && strcasecmp(name + length - own, ending) == 0;
}

static const struct aiScene *read_scene(model_file *file) {
    struct aiFileIO io = {files_open, files_close, (char *)(void *)file};
    struct aiPropertyStore *const properties = aiCreatePropertyStore();
    aiSetImportPropertyInteger(properties, AI_CONFIG_PP_SBP_REMOVE,
                               aiPrimitiveType_POINT | aiPrimitiveType_LINE);
    /* glTF has its corners joined as they are meant. */
    const unsigned steps = aiProcess_Triangulate | aiProcess_SortByPType | aiProcess_ValidateDataStructure |
                           (file->is_gltf ? 0u : (unsigned)aiProcess_JoinIdenticalVertices);
    const struct aiScene *const scene = aiImportFileExWithProperties(file->name, steps, &io, properties);
    if (scene == NULL && strstr(aiGetErrorString(), "bad_alloc") != NULL)
        stream_fail_memory();
    if (scene == NULL)
        stream_fail(AUR_ERROR_FORMAT, "%s", aiGetErrorString());
    if (scene->mRootNode == NULL || scene->mNumMeshes == 0)
        stream_fail(AUR_ERROR_FORMAT, "it has no triangle");
    return scene;
}

static void write_scene(writer *self) {
    char *records = NULL;
    size_t size = 0;
    self->records = open_memstream(&records, &size);
    self->mesh_file = calloc(self->scene->mNumMeshes, sizeof *self->mesh_file);
    self->mesh_uses = calloc(self->scene->mNumMeshes, sizeof *self->mesh_uses);
    self->image_file = calloc(self->scene->mNumTextures + 1, sizeof *self->image_file);
    if (self->records == NULL || self->mesh_file == NULL || self->mesh_uses == NULL ||
        self->image_file == NULL)
        stream_fail_memory();
    writer_add_meshes(self);
    writer_put_materials(self);
    writer_put_nodes(self);
    const bool written = ferror(self->records) == 0;
    if (fclose(self->records) != 0 || !written)
        stream_fail_memory();
    stream_send_two(AUR_IMPORT_SCENE, sizeof self->camera, &self->camera, size, records);
}

int main(int argc, char **argv) {
    if (argc != 2) /* started by hand */
        return 2;
    confine_self(strtol(argv[1], NULL, 10));
    char *start;
    size_t size;
    const uint32_t first = stream_receive(AUR_IMPORT_START, &size, &start);
    const char *const name = start + strlen(start) + 1;
    if (strcmp(start, aur_version()) != 0)
        stream_fail(AUR_ERROR_UNSUPPORTED,
                    "the library is of version %s, but the program aureole-import of %s", start,
                    aur_version());
    model_file file = {.name = name, .is_gltf = ends_with(name, ".gltf") || ends_with(name, ".glb")};
    writer self = {.is_gltf = file.is_gltf, .first = first};
    const char *const time = name + strlen(name) + 1;
    const char *const variant = time + strlen(time) + 1;
    if (self.is_gltf) {
        gltf_read(&self, &file);
        gltf_check_extensions(&self);
        if (variant[0] != '\0')
            gltf_choose_variant(&self, variant, &file);
    }
    self.scene = read_scene(&file);
    if (self.is_gltf) {
        const gltf_node *const root = gltf_root(&self, self.scene->mRootNode);
        gltf_map_materials(&self, self.scene->mRootNode, root);
        gltf_refine_meshes(&self, self.scene->mRootNode, root);
    }
    double seconds = 0.0;
    const bool moving = aur_parse_double(time, &seconds);
    writer_pose(&self, moving, seconds);
    write_scene(&self);
    _exit(0); /* nothing is to be cleaned up, and damaged structures may not bear it */
}
