#include "program/import/gltf.h"

#include <assimp/GltfMaterial.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "program/import/writer.h"

/* An embedded image as a file: the compressed bytes, or texels with a TGA header. */
static unsigned file_of_image(writer *self, unsigned index) {
    const struct aiTexture *const texture = self->scene->mTextures[index];
    if (self->image_file[index] != 0)
        return self->image_file[index] == NO_FILE ? NO_FILE : self->image_file[index] - 1;
    const size_t texels = 4 * (size_t)texture->mWidth * texture->mHeight;
    const size_t head = texture->mHeight > 0 ? 18 : 0;
    const size_t size = texture->mHeight > 0 ? head + texels : texture->mWidth;
    char *const data = malloc(size + 1);
    if (data == NULL)
        stream_fail_memory();
    const unsigned char header[18] = {[2] = 2,
                                      [12] = texture->mWidth & 255,
                                      [13] = texture->mWidth >> 8 & 255,
                                      [14] = texture->mHeight & 255,
                                      [15] = texture->mHeight >> 8 & 255,
                                      [16] = 32,
                                      [17] = 0x28};
    memcpy(data, header, head);
    memcpy(data + head, texture->pcData, size - head);
    const unsigned file = writer_add_image_file(self, size, data);
    free(data);
    self->image_file[index] = file == NO_FILE ? NO_FILE : file + 1;
    return file;
}

/* The index of the embedded image for a path "*i" or a name; the number of images if there is none. */
static unsigned find_image(const writer *self, const char *path) {
    const struct aiScene *const scene = self->scene;
    if (path[0] == '*') {
        const unsigned long index = strtoul(path + 1, NULL, 10);
        return index < scene->mNumTextures ? (unsigned)index : scene->mNumTextures;
    }
    unsigned index = 0;
    while (index < scene->mNumTextures && strcmp(scene->mTextures[index]->mFilename.data, path) != 0)
        ++index;
    return index;
}

/* The name of an image file, as stored in the model, as a path. */
static void path_of(const writer *self, const char *text, char path[MAXLEN]) {
    snprintf(path, MAXLEN, "%s", text);
    if (self->is_gltf)
        files_decode_address(path);
    for (char *c = path; *c != '\0'; ++c) /* Windows separators */
        if (*c == '\\')
            *c = '/';
    while (strncmp(path, "./", 2) == 0)
        memmove(path, path + 2, strlen(path + 2) + 1);
}

typedef struct writer_image {
    char *name, *found; /* the file that was found; "" if it cannot be read */
    struct writer_image *next;
} writer_image;

/* The path of a readable image file, or NULL. */
static const char *find_readable(writer *self, const char *text) {
    char path[MAXLEN];
    path_of(self, text, path);
    if (path[0] == '\0')
        return NULL;
    writer_image *requested = self->image_files;
    while (requested != NULL && strcmp(requested->name, path) != 0)
        requested = requested->next;
    if (requested == NULL) {
        requested = calloc(1, sizeof *requested);
        if (requested == NULL || (requested->name = strdup(path)) == NULL)
            stream_fail_memory();
        size_t size;
        stream_send(AUR_IMPORT_FIND, 0, strlen(path), path);
        if (stream_receive(AUR_IMPORT_ANSWER, &size, &requested->found) == 0)
            requested->found[0] = '\0';
        requested->next = self->image_files;
        self->image_files = requested;
    }
    return requested->found[0] != '\0' ? requested->found : NULL;
}

bool texture_exists(writer *self, const struct aiMaterial *material, slot from) {
    struct aiString path;
    if (aiGetMaterialTextureCount(material, from.type) <= from.index ||
        aiGetMaterialTexture(material, from.type, from.index, &path, NULL, NULL, NULL, NULL, NULL, NULL) !=
            aiReturn_SUCCESS)
        return false;
    const unsigned embedded = find_image(self, path.data);
    return embedded < self->scene->mNumTextures ? file_of_image(self, embedded) != NO_FILE
                                                : find_readable(self, path.data) != NULL;
}

static void put_filename(writer *self, const char *path) {
    const unsigned embedded = find_image(self, path);
    if (embedded < self->scene->mNumTextures)
        writer_property(self, "string", "filename", "*%u.png", file_of_image(self, embedded));
    else
        writer_property(self, "string", "filename", "%s", find_readable(self, path));
}

static unsigned uv_set_of(const struct aiMaterial *material, slot from) {
    unsigned set = 0;
    struct aiString path;
    return aiGetMaterialTexture(material, from.type, from.index, &path, NULL, &set, NULL, NULL, NULL, NULL) ==
                   aiReturn_SUCCESS
               ? set
               : 0;
}

/* Uses the coordinates of the first texture: a mesh has one set. */
unsigned writer_uv_set(writer *self, const struct aiMaterial *material) {
    const slot slots[] = {{aiTextureType_BASE_COLOR, 0},
                          {aiTextureType_DIFFUSE, 0},
                          {AI_MATKEY_GLTF_PBRMETALLICROUGHNESS_METALLICROUGHNESS_TEXTURE},
                          {aiTextureType_METALNESS, 0},
                          {aiTextureType_DIFFUSE_ROUGHNESS, 0},
                          {aiTextureType_EMISSIVE, 0},
                          {aiTextureType_NORMALS, 0},
                          {aiTextureType_OPACITY, 0},
                          {aiTextureType_TRANSMISSION, 0},
                          {aiTextureType_CLEARCOAT, 0},
                          {aiTextureType_SHEEN, 0}};
    for (size_t i = 0; i < sizeof slots / sizeof slots[0]; ++i)
        if (texture_exists(self, material, slots[i]))
            return uv_set_of(material, slots[i]);
    return 0;
}

/* The texture's coordinate transform. glTF: translation times rotation times scale, with rotation from v to
 * u. assimp rotates the other way about the center, measures v from the bottom, and has another translation.
 */
static void put_transform(writer *self, const struct aiMaterial *material, slot from) {
    struct aiUVTransform t;
    if (aiGetMaterialUVTransform(material, AI_MATKEY_UVTRANSFORM(from.type, from.index), &t) !=
        aiReturn_SUCCESS)
        return;
    const double c = cos(-(double)t.mRotation), s = sin(-(double)t.mRotation);
    const double sx = (double)t.mScaling.x, sy = (double)t.mScaling.y;
    const double x = (double)t.mTranslation.x - 0.5 * sx * (1.0 + s - c);
    const double y = 0.5 * sy * (s + c - 1.0) + 1.0 - sy - (double)t.mTranslation.y;
    writer_open(self, "transform", NULL);
    writer_set(self, "name", "to_uv");
    writer_open(self, "matrix", NULL);
    writer_set(self, "value", "%.9g %.9g 0 %.9g %.9g %.9g 0 %.9g 0 0 1 0 0 0 0 1", c * sx, s * sy, x, -s * sx,
               c * sy, y);
    writer_close(self);
    writer_close(self);
}

static const char *wrap_of(enum aiTextureMapMode mode) {
    return mode == aiTextureMapMode_Mirror ? "mirror" : mode == aiTextureMapMode_Wrap ? "repeat" : "clamp";
}

void texture_put(writer *self, const struct aiMaterial *material, const texture_use *use) {
    struct aiString path;
    unsigned set = 0;
    enum aiTextureMapMode modes[2] = {aiTextureMapMode_Wrap, aiTextureMapMode_Wrap};
    if (aiGetMaterialTexture(material, use->from.type, use->from.index, &path, NULL, &set, NULL, NULL, modes,
                             NULL) != aiReturn_SUCCESS)
        return;
    if (set != writer_uv_set(self, material))
        writer_note("a material uses several sets of texture coordinates: '%s' is put where the first is",
                    use->name);
    int filter = 0;
    aiGetMaterialIntegerArray(material, AI_MATKEY_GLTF_MAPPINGFILTER_MAG(use->from.type, use->from.index),
                              &filter, NULL);
    writer_open(self, "texture", "bitmap");
    writer_set(self, "name", "%s", use->name);
    put_filename(self, path.data);
    writer_property(self, "boolean", "raw", "%s", use->raw ? "true" : "false");
    writer_property(self, "string", "channel", "%s", use->channel);
    writer_property(self, "string", "wrap_mode", "%s", wrap_of(modes[0]));
    if (modes[1] != modes[0])
        writer_property(self, "string", "wrap_mode_v", "%s", wrap_of(modes[1]));
    writer_property(self, "string", "filter_type", "%s", filter == 9728 ? "nearest" : "bilinear");
    writer_property(self, "vector", "factor", "%.9g %.9g %.9g", (double)use->factor[0],
                    (double)use->factor[1], (double)use->factor[2]);
    writer_property(self, "float", "cutoff", "%.9g", (double)use->cutoff);
    put_transform(self, material, use->from);
    writer_close(self);
}

void texture_put_share(writer *self, const struct aiMaterial *material, const texture_use *use) {
    if (texture_exists(self, material, use->from))
        texture_put(self, material, use);
    else
        writer_property(self, "float", use->name, "%.9g", (double)use->factor[0]);
}
