/* Unsupported features of a glTF file: prints a note or an error with their name and a workaround. */
#include <string.h>

#include "program/import/gltf.h"

typedef struct extension {
    const char *name;
    const char *lost; /* the effect on the model; NULL: none */
} extension;

static const extension extensions[] = {
    {"EXT_mesh_gpu_instancing", NULL},
    {"EXT_texture_webp", NULL}, /* textures: see note_textures */
    {"KHR_draco_mesh_compression", NULL},
    {"KHR_lights_punctual", NULL},
    {"KHR_materials_anisotropy", NULL},
    {"KHR_materials_clearcoat", NULL},
    {"KHR_materials_diffuse_transmission", "diffuse transmission"},
    {"KHR_materials_dispersion", "dispersion"},
    {"KHR_materials_emissive_strength", NULL},
    {"KHR_materials_ior", NULL},
    {"KHR_materials_iridescence", "iridescence"},
    {"KHR_materials_pbrSpecularGlossiness", NULL},
    {"KHR_materials_sheen", NULL},
    {"KHR_materials_specular", NULL},
    {"KHR_materials_transmission", NULL},
    {"KHR_materials_unlit", NULL},
    {"KHR_materials_variants", NULL},
    {"KHR_materials_volume", NULL},
    {"KHR_mesh_quantization", NULL},
    {"KHR_texture_basisu", NULL},
    {"KHR_texture_transform", NULL},
    {"KHR_xmp_json_ld", NULL},
    {"MSFT_texture_dds", NULL},
};

static const extension *find(const char *name) {
    for (size_t i = 0; i < sizeof extensions / sizeof extensions[0]; ++i)
        if (strcmp(extensions[i].name, name) == 0)
            return &extensions[i];
    return NULL;
}

static const json_value *first_of(const json_value *parent, const char *list) {
    const json_value *const found = json_member(parent, list);
    return found != NULL ? found->first : NULL;
}

static bool requires(const json_value *gltf, const char *name) {
    for (const json_value *item = first_of(gltf, "extensionsRequired"); item != NULL; item = item->next)
        if (json_text(item) != NULL && strcmp(json_text(item), name) == 0)
            return true;
    return false;
}

/* Points and lines have no surface. */
static void check_primitives(const json_value *gltf) {
    enum { TRIANGLES = 4 };
    size_t all = 0, bare = 0;
    for (const json_value *mesh = first_of(gltf, "meshes"); mesh != NULL; mesh = mesh->next)
        for (const json_value *item = first_of(mesh, "primitives"); item != NULL; item = item->next) {
            ++all;
            bare += json_number(json_member(item, "mode"), TRIANGLES) < TRIANGLES;
        }
    if (bare > 0 && bare == all)
        stream_fail(AUR_ERROR_FORMAT, "it has only points and lines, which have no surface to render");
    if (bare > 0)
        writer_note("%zu of %zu primitives are points or lines: they are ignored", bare, all);
}

/* Textures whose only image has an unsupported format. */
static void note_textures(const json_value *gltf) {
    static const char *const forms[][2] = {
        {"EXT_texture_webp", "WebP"}, {"KHR_texture_basisu", "KTX2"}, {"MSFT_texture_dds", "DDS"}};
    for (size_t i = 0; i < sizeof forms / sizeof forms[0]; ++i) {
        size_t lost = 0;
        for (const json_value *item = first_of(gltf, "textures"); item != NULL; item = item->next)
            lost += json_member(item, "source") == NULL &&
                    json_member(json_member(item, "extensions"), forms[i][0]) != NULL;
        if (lost > 0)
            writer_note("%zu textures are %s images (%s), which are not supported: they are ignored; export "
                        "the model with PNG or JPEG images",
                        lost, forms[i][1], forms[i][0]);
    }
}

static void note_materials(const json_value *gltf) {
    for (size_t i = 0; i < sizeof extensions / sizeof extensions[0]; ++i) {
        size_t users = 0;
        for (const json_value *item = first_of(gltf, "materials"); item != NULL; item = item->next)
            users += json_member(json_member(item, "extensions"), extensions[i].name) != NULL;
        if (users > 0 && extensions[i].lost != NULL)
            writer_note("%s (%s) is not supported: it is ignored in %zu materials", extensions[i].lost,
                        extensions[i].name, users);
    }
}

static bool is_read(const char *name) {
    static const char *const read[] = {
        "clearcoatTexture",          "sheenColorTexture", "transmissionTexture", "diffuseTexture",
        "specularGlossinessTexture", "anisotropyTexture" /* noted together with the anisotropy */};
    for (size_t i = 0; i < sizeof read / sizeof read[0]; ++i)
        if (strcmp(read[i], name) == 0)
            return true;
    return false;
}

static bool is_texture(const char *name) {
    static const char end[] = "Texture";
    const size_t length = strlen(name);
    return length >= sizeof end - 1 && strcmp(name + length - (sizeof end - 1), end) == 0;
}

/* Prints one note for all textures of extensions that have no equivalent in a material here. */
static void note_extra_textures(const json_value *gltf) {
    char names[400] = "";
    for (const json_value *item = first_of(gltf, "materials"); item != NULL; item = item->next)
        for (const json_value *extension_node = first_of(item, "extensions"); extension_node != NULL;
             extension_node = extension_node->next)
            for (const json_value *value = extension_node->first; value != NULL; value = value->next) {
                const size_t length = strlen(names);
                if (value->name == NULL || !is_texture(value->name) || is_read(value->name) ||
                    strstr(names, value->name) != NULL)
                    continue;
                snprintf(names + length, sizeof names - length, "%s%s", length > 0 ? ", " : "", value->name);
            }
    if (names[0] != '\0')
        writer_note("textures of extensions are ignored: %s", names);
}

void gltf_check_extensions(const writer *self) {
    static const char *const packed[] = {"EXT_meshopt_compression", "KHR_meshopt_compression"};
    for (size_t i = 0; i < sizeof packed / sizeof packed[0]; ++i)
        if (requires(self->gltf, packed[i]))
            stream_fail(AUR_ERROR_FORMAT,
                        "its meshes are compressed by meshopt (%s), which is not supported: export the model "
                        "without compression",
                        packed[i]);
    check_primitives(self->gltf);
    note_textures(self->gltf);
    note_materials(self->gltf);
    note_extra_textures(self->gltf);
    for (const json_value *item = first_of(self->gltf, "extensionsRequired"); item != NULL; item = item->next)
        if (json_text(item) != NULL && find(json_text(item)) == NULL)
            writer_note("the model requires the extension '%s', which is not supported", json_text(item));
}
