/* Models by assimp: a module that is loaded when a scene is a model, so that others do not pay for assimp. */
#include <assimp/cfileio.h>
#include <assimp/cimport.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "assimp/writer.h"
#include "core/array.h"
#include "core/text.h"

/* --- output */

void writer_put(writer *self, const char *format, ...) {
    char text[1024];
    va_list arguments;
    va_start(arguments, format);
    const int length = aur_format_list(text, sizeof text, format, arguments);
    va_end(arguments);
    fwrite(text, 1, length < (int)sizeof text ? (size_t)length : sizeof text - 1, self->xml);
}

void writer_put_escaped(writer *self, const char *text) {
    for (const unsigned char *c = (const unsigned char *)text; *c != '\0'; ++c) {
        if (*c == '$')
            fputs("\\$", self->xml);
        else if (*c < 32 || strchr("&<>\"'", *c) != NULL)
            fprintf(self->xml, "&#%u;", (unsigned)*c);
        else
            fputc(*c, self->xml);
    }
}

void writer_note(const writer *self, const char *format, ...) {
    char text[1024];
    va_list arguments;
    va_start(arguments, format);
    aur_format_list(text, sizeof text, format, arguments);
    va_end(arguments);
    aur_warn_at(self->source->warnings, self->source->location, "%s", text);
}

unsigned writer_add_file(writer *self, const char *kind, unsigned index, size_t size, char *data) {
    aur_model_files *const files = self->files;
    char text[512];
    snprintf(text, sizeof text, "%s, %s %u", self->source->name, kind, index + 1);
    char *const name = strdup(text);
    if (name != NULL && data != NULL &&
        aur_array_reserve(&files->items, &files->capacity, files->count + 1, sizeof *files->items)) {
        files->items[files->count] = (aur_model_file){name, size, data};
        return (unsigned)files->count++;
    }
    free(name);
    free(data);
    self->out_of_memory = true;
    return NO_FILE;
}

/* --- files that assimp opens */

typedef struct open_file {
    size_t size, at;
    char *data;
} open_file;

static size_t read_bytes(struct aiFile *file, char *to, size_t size, size_t count) {
    open_file *const self = (open_file *)(void *)file->UserData;
    const size_t left = size > 0 ? (self->size - self->at) / size : 0;
    const size_t taken = count < left ? count : left;
    memcpy(to, self->data + self->at, taken * size);
    self->at += taken * size;
    return taken;
}

static size_t write_nothing(struct aiFile *file, const char *from, size_t size, size_t count) {
    (void)file, (void)from, (void)size, (void)count;
    return 0;
}

static size_t tell(struct aiFile *file) {
    return ((open_file *)(void *)file->UserData)->at;
}

static size_t size_of(struct aiFile *file) {
    return ((open_file *)(void *)file->UserData)->size;
}

static enum aiReturn seek(struct aiFile *file, size_t offset, enum aiOrigin origin) {
    open_file *const self = (open_file *)(void *)file->UserData;
    const size_t base = origin == aiOrigin_SET ? 0 : origin == aiOrigin_CUR ? self->at : self->size;
    if (base + offset > self->size) /* wraps as a negative offset is meant to */
        return aiReturn_FAILURE;
    self->at = base + offset;
    return aiReturn_SUCCESS;
}

static void flush(struct aiFile *file) {
    (void)file;
}

/* Names begin with what assimp takes for the model's folder. */
static struct aiFile *open_part(struct aiFileIO *io, const char *name, const char *mode) {
    const aur_model_source *const source = (const aur_model_source *)(void *)io->UserData;
    struct aiFile *const file = calloc(1, sizeof *file);
    open_file *const self = calloc(1, sizeof *self);
    while (strncmp(name, "./", 2) == 0 || strncmp(name, ".\\", 2) == 0)
        name += 2;
    if (file == NULL || self == NULL || mode[0] != 'r' ||
        !source->read(source->state, name, &self->size, &self->data)) {
        free(file);
        free(self);
        return NULL;
    }
    *file = (struct aiFile){read_bytes, write_nothing, tell, size_of, seek, flush, (char *)self};
    return file;
}

static void close_part(struct aiFileIO *io, struct aiFile *file) {
    (void)io;
    open_file *const self = (open_file *)(void *)file->UserData;
    free(self->data);
    free(self);
    free(file);
}

/* --- the whole */

static bool ends_with(const char *name, const char *ending) {
    const size_t length = strlen(name), own = strlen(ending);
    return length >= own && strcasecmp(name + length - own, ending) == 0;
}

static const struct aiScene *read_scene(const aur_model_source *source, bool is_gltf, aur_error *error) {
    struct aiFileIO io = {open_part, close_part, (char *)source};
    struct aiPropertyStore *const properties = aiCreatePropertyStore();
    aiSetImportPropertyInteger(properties, AI_CONFIG_PP_SBP_REMOVE,
                               aiPrimitiveType_POINT | aiPrimitiveType_LINE);
    /* glTF has its corners joined as they are meant. */
    const unsigned steps = aiProcess_Triangulate | aiProcess_SortByPType | aiProcess_ValidateDataStructure |
                           (is_gltf ? 0u : (unsigned)aiProcess_JoinIdenticalVertices);
    const struct aiScene *const scene = aiImportFileExWithProperties(source->name, steps, &io, properties);
    aiReleasePropertyStore(properties);
    if (scene == NULL)
        aur_fail_at(error, source->location, AUR_ERROR_FORMAT, "this model cannot be read: %s",
                    aiGetErrorString());
    else if (scene->mRootNode == NULL || scene->mNumMeshes == 0)
        aur_fail_at(error, source->location, AUR_ERROR_FORMAT, "this model has no triangle");
    else
        return scene;
    aiReleaseImport(scene);
    return NULL;
}

static bool write_scene(writer *self, char **xml, size_t *xml_size) {
    self->xml = open_memstream(xml, xml_size);
    self->mesh_file = calloc(self->scene->mNumMeshes, sizeof *self->mesh_file);
    self->mesh_uses = calloc(self->scene->mNumMeshes, sizeof *self->mesh_uses);
    self->image_file = calloc(self->scene->mNumTextures + 1, sizeof *self->image_file);
    if (self->xml == NULL || self->mesh_file == NULL || self->mesh_uses == NULL || self->image_file == NULL)
        return false;
    writer_put(self, "<scene version=\"3.0.0\">\n");
    writer_add_meshes(self);
    writer_put_materials(self);
    writer_put_nodes(self);
    writer_put(self, "</scene>\n");
    return !self->out_of_memory;
}

/* The module's one name that others know. */
AUR_API aur_result aur_model_import(const aur_model_source *source, aur_model_files *files, char **xml,
                                    size_t *xml_size, aur_error *error);

aur_result aur_model_import(const aur_model_source *source, aur_model_files *files, char **xml,
                            size_t *xml_size, aur_error *error) {
    writer self = {.source = source,
                   .files = files,
                   .is_gltf = ends_with(source->name, ".gltf") || ends_with(source->name, ".glb"),
                   .first = (unsigned)files->count,
                   .lower = {HUGE_VAL, HUGE_VAL, HUGE_VAL},
                   .upper = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}};
    self.scene = read_scene(source, self.is_gltf, error);
    if (self.scene == NULL)
        return AUR_ERROR_FORMAT;
    const bool written = write_scene(&self, xml, xml_size);
    const bool closed = self.xml != NULL && fclose(self.xml) == 0;
    free(self.mesh_file);
    free(self.mesh_uses);
    free(self.image_file);
    aiReleaseImport(self.scene);
    if (written && closed)
        return AUR_OK;
    free(*xml);
    *xml = NULL;
    return aur_fail_memory(error);
}
