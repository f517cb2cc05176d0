/* aureole-import PARENT: reads a model with assimp and sends it as elements and files to the process that
 * started it. Standard input is a socket; see render/scene/importers/model/message.h. The library starts it
 * as a separate process (render/scene/importers/model/import.c), so that a file which crashes assimp ends
 * only this process. */
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
    const size_t length = strlen(name), ending_length = strlen(ending);
    return length >= ending_length && strcasecmp(name + length - ending_length, ending) == 0;
}

static const struct aiScene *read_scene(model_file *file) {
    struct aiFileIO io = {files_open, files_close, (char *)(void *)file};
    struct aiPropertyStore *const properties = aiCreatePropertyStore();
    aiSetImportPropertyInteger(properties, AI_CONFIG_PP_SBP_REMOVE,
                               aiPrimitiveType_POINT | aiPrimitiveType_LINE);
    /* glTF vertices are already joined as intended. */
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

/* The text after `text` in a message that ends at `end`, where it is empty. */
static const char *text_after(const char *text, const char *end) {
    const char *const next = text + strlen(text) + 1;
    return next < end ? next : end;
}

int main(int argc, char **argv) {
    if (argc != 2) /* not started by the library */
        return 2;
    confine_self(strtol(argv[1], NULL, 10));
    char *start;
    size_t size;
    const uint32_t first = stream_receive(AUR_IMPORT_START, &size, &start);
    const char *const end = start + size, *const name = text_after(start, end);
    if (strcmp(start, aur_version()) != 0)
        stream_fail(AUR_ERROR_UNSUPPORTED,
                    "the library is of version %s, but the program aureole-import of %s", start,
                    aur_version());
    model_file file = {.name = name, .is_gltf = ends_with(name, ".gltf") || ends_with(name, ".glb")};
    writer self = {.is_gltf = file.is_gltf, .first = first};
    const char *const time = text_after(name, end);
    const char *const variant = text_after(time, end);
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
    _exit(0); /* exits without cleanup, which damaged data structures might crash */
}
