/* Materials: metallic-roughness materials become `principled`. Others, as in most OBJ files, get these
 * parameters from their colors and specular exponent. */
#include <assimp/GltfMaterial.h>
#include <math.h>
#include <string.h>

#include "program/import/gltf.h"

static const slot base_slot = {aiTextureType_BASE_COLOR, 0}, diffuse_slot = {aiTextureType_DIFFUSE, 0},
                  metal_slot = {aiTextureType_METALNESS, 0},
                  roughness_slot = {aiTextureType_DIFFUSE_ROUGHNESS, 0},
                  both_slot = {AI_MATKEY_GLTF_PBRMETALLICROUGHNESS_METALLICROUGHNESS_TEXTURE},
                  normal_slot = {aiTextureType_NORMALS, 0}, emissive_slot = {aiTextureType_EMISSIVE, 0},
                  opacity_slot = {aiTextureType_OPACITY, 0}, through_slot = {aiTextureType_TRANSMISSION, 0},
                  coat_slot = {aiTextureType_CLEARCOAT, 0}, sheen_slot = {aiTextureType_SHEEN, 0};

float writer_number(const struct aiMaterial *material, const char *key, float otherwise) {
    float value = otherwise;
    unsigned count = 1;
    if (aiGetMaterialFloatArray(material, key, 0, 0, &value, &count) != aiReturn_SUCCESS || !isfinite(value))
        return otherwise;
    return value;
}

bool writer_color(const struct aiMaterial *material, const char *key, float color[4]) {
    struct aiColor4D found;
    if (aiGetMaterialColor(material, key, 0, 0, &found) != aiReturn_SUCCESS)
        return false;
    const float values[4] = {found.r, found.g, found.b, found.a};
    for (size_t i = 0; i < 4; ++i)
        color[i] = isfinite(values[i]) && values[i] > 0.0f ? values[i] : 0.0f;
    return true;
}

static slot color_slot(writer *self, const struct aiMaterial *material) {
    return texture_exists(self, material, base_slot) ? base_slot : diffuse_slot;
}

static float at_most_one(float value) {
    return value > 0.0f ? fminf(value, 1.0f) : 0.0f;
}

/* --- parameters of a material */

static void base_color(writer *self, const struct aiMaterial *material, float color[4]) {
    color[0] = color[1] = color[2] = texture_exists(self, material, color_slot(self, material)) ? 1.0f : 0.6f;
    color[3] = writer_number(material, "$mat.opacity", 1.0f);
    /* Exporters disagree on the meaning of Collada's transparency: full transparency is never intended. */
    if (!self->is_gltf && color[3] == 0.0f)
        color[3] = 1.0f;
    if (!writer_color(material, "$clr.base", color)) {
        const float opacity = color[3];
        writer_color(material, "$clr.diffuse", color);
        /* Many OBJ files have a texture with a black color, or no color. */
        if (texture_exists(self, material, color_slot(self, material)) &&
            !(color[0] + color[1] + color[2] > 0.0f))
            color[0] = color[1] = color[2] = 1.0f;
        color[3] = opacity;
    }
    for (size_t i = 0; i < 4; ++i)
        color[i] = at_most_one(color[i]);
}

/* A parameter of a glTF extension, from 0 to `most`. */
static float extension_number(const writer *self, unsigned index, const char *extension, const char *name,
                              float otherwise, float most) {
    const double value = json_number(json_member(gltf_extension(self, index, extension), name), -1.0);
    return value >= 0.0 ? fminf((float)value, most) : otherwise;
}

/* A color of a glTF extension, each component from 0 to 1. */
static void extension_color(const writer *self, unsigned index, const char *extension, const char *name,
                            float color[3]) {
    const json_value *const list = json_member(gltf_extension(self, index, extension), name);
    for (size_t i = 0; i < 3; ++i)
        color[i] = at_most_one((float)json_number(json_item(list, i), (double)color[i]));
}

/* The transmittance by KHR_materials_volume over the model's thickness, used as the surface color. */
static void volume_color(const writer *self, unsigned index, float color[4]) {
    static const char volume[] = "KHR_materials_volume";
    const float thickness = extension_number(self, index, volume, "thicknessFactor", 0.0f, 1e30f);
    const float distance = extension_number(self, index, volume, "attenuationDistance", 0.0f, 1e30f);
    float passed[3] = {1.0f, 1.0f, 1.0f};
    extension_color(self, index, volume, "attenuationColor", passed);
    for (size_t i = 0; i < 3 && distance > 0.0f; ++i)
        color[i] *= powf(passed[i], thickness / distance);
}

static bool is_unlit(const struct aiMaterial *material) {
    int model = 0;
    return aiGetMaterialIntegerArray(material, AI_MATKEY_SHADING_MODEL, &model, NULL) == aiReturn_SUCCESS &&
           model == aiShadingMode_Unlit;
}

static bool uses_vertex_colors(const writer *self, unsigned index) {
    bool some = false;
    for (unsigned i = 0; i < self->scene->mNumMeshes; ++i) {
        const struct aiMesh *const mesh = self->scene->mMeshes[i];
        if (mesh->mMaterialIndex != index)
            continue;
        some = mesh->mColors[0] != NULL;
        if (!some)
            return false;
    }
    return some;
}

static void put_color(writer *self, unsigned index, const char *name) {
    const struct aiMaterial *const material = self->scene->mMaterials[index];
    const slot from = color_slot(self, material);
    float color[4];
    base_color(self, material, color);
    volume_color(self, index, color);
    const texture_use use = {from, name, "rgb", false, {color[0], color[1], color[2]}, 0.0f};
    if (texture_exists(self, material, from)) {
        texture_put(self, material, &use);
    } else if (uses_vertex_colors(self, index)) {
        writer_open(self, "texture", "mesh_attribute");
        writer_set(self, "name", "%s", name);
        writer_property(self, "string", "name", "vertex_color");
        writer_close(self);
    } else {
        writer_property(self, "rgb", name, "%.9g %.9g %.9g", (double)color[0], (double)color[1],
                        (double)color[2]);
    }
}

/* Blinn's exponent, for materials without roughness: alpha^2 = 2 / (n + 2), and alpha = roughness^2. */
static float roughness_of(const struct aiMaterial *material) {
    const float shininess = writer_number(material, "$mat.shininess", 0.0f);
    const float otherwise = shininess > 0.0f ? powf(2.0f / (shininess + 2.0f), 0.25f) : 1.0f;
    return at_most_one(writer_number(material, "$mat.roughnessFactor", otherwise));
}

/* The transmission by KHR_materials_transmission. */
static float transmission_of(const struct aiMaterial *material) {
    return at_most_one(writer_number(material, "$mat.transmission.factor", 0.0f));
}

/* Without a volume, transmission is through a thin sheet without refraction. */
static bool is_thin(const writer *self, unsigned index) {
    const struct aiMaterial *const material = self->scene->mMaterials[index];
    return transmission_of(material) > 0.0f &&
           !(writer_number(material, "$mat.metallicFactor", 0.0f) > 0.0f) &&
           !(extension_number(self, index, "KHR_materials_volume", "thicknessFactor", 0.0f, 1.0f) > 0.0f) &&
           self->is_gltf;
}

/* Specular reflection by KHR_materials_ior and _specular: the reflectance at normal incidence. */
static void put_specular(writer *self, unsigned index) {
    static const char extension[] = "KHR_materials_specular";
    const struct aiMaterial *const material = self->scene->mMaterials[index];
    float ior = extension_number(self, index, "KHR_materials_ior", "ior", 1.5f, 100.0f);
    float color[3] = {1.0f, 1.0f, 1.0f};
    extension_color(self, index, extension, "specularColorFactor", color);
    const float share = extension_number(self, index, extension, "specularFactor", 1.0f, 1.0f) *
                        (color[0] + color[1] + color[2]) / 3.0f;
    ior = ior >= 1.0f ? ior : 1.5f;
    const float reflectance = powf((ior - 1.0f) / (ior + 1.0f), 2.0f) * share;
    if (transmission_of(material) > 0.0f || (reflectance > 0.08f && ior > 1.0f))
        writer_property(self, "float", "eta", "%.9g", (double)fmaxf(ior, 1.001f));
    else if (gltf_extension(self, index, extension) != NULL)
        writer_property(self, "float", "specular", "%.9g", (double)(12.5f * reflectance));
    else if (gltf_extension(self, index, "KHR_materials_ior") != NULL && ior > 1.0f)
        writer_property(self, "float", "eta", "%.9g", (double)ior);
}

/* Sheen: principled's sheen has the base color in proportion to the tint. */
static void put_sheen(writer *self, unsigned index) {
    const struct aiMaterial *const material = self->scene->mMaterials[index];
    float color[3] = {0.0f, 0.0f, 0.0f};
    extension_color(self, index, "KHR_materials_sheen", "sheenColorFactor", color);
    const float most = fmaxf(color[0], fmaxf(color[1], color[2]));
    const float least = fminf(color[0], fminf(color[1], color[2]));
    if (!(most > 0.0f))
        return;
    if (texture_exists(self, material, sheen_slot)) { /* its color has no equivalent */
        texture_put(self, material,
                    &(texture_use){sheen_slot, "sheen", "rgb", false, {color[0], color[1], color[2]}, 0.0f});
        return;
    }
    writer_property(self, "float", "sheen", "%.9g", (double)most);
    writer_property(self, "float", "sheen_tint", "%.9g", (double)(1.0f - least / most));
}

/* KHR_materials_anisotropy: alpha along the tangent is interpolated from the alpha across to 1 by strength^2.
 * principled (Burley 2012) multiplies and divides alpha by (1 - .9 a)^(1/2). Returns the roughness between
 * both. */
static float put_anisotropy(writer *self, unsigned index, float rough) {
    static const char name[] = "KHR_materials_anisotropy";
    const json_value *const extension = gltf_extension(self, index, name);
    const float strength = extension_number(self, index, name, "anisotropyStrength", 0.0f, 1.0f);
    const double turn = json_number(json_member(extension, "anisotropyRotation"), 0.0);
    if (!(strength > 0.0f))
        return rough;
    if (fabs(sin(turn)) > 0.02 || json_member(extension, "anisotropyTexture") != NULL ||
        texture_exists(self, self->scene->mMaterials[index], both_slot)) {
        writer_note("anisotropy with a rotation or textures (%s) is ignored", name);
        return rough;
    }
    const float across = fmaxf(rough * rough, 1e-4f), along = across + (1.0f - across) * strength * strength;
    writer_property(self, "float", "anisotropic", "%.9g",
                    (double)at_most_one((1.0f - across / along) / 0.9f));
    return powf(along * across, 0.25f);
}

static void put_coat(writer *self, unsigned index) {
    const struct aiMaterial *const material = self->scene->mMaterials[index];
    const float coat = at_most_one(writer_number(material, "$mat.clearcoat.factor", 0.0f));
    if (!(coat > 0.0f) || is_thin(self, index))
        return;
    /* The coat's roughness is .1 for gloss 0, .001 for gloss 1. */
    const float width = writer_number(material, "$mat.clearcoat.roughnessFactor", 0.0f);
    texture_put_share(self, material,
                      &(texture_use){coat_slot, "clearcoat", "red", true, {coat, coat, coat}, 0.0f});
    writer_property(self, "float", "clearcoat_gloss", "%.9g",
                    (double)at_most_one((0.1f - width * width) / 0.099f));
}

static void put_principled(writer *self, unsigned index) {
    const struct aiMaterial *const material = self->scene->mMaterials[index];
    const bool both = texture_exists(self, material, both_slot);
    const float metal = at_most_one(writer_number(material, "$mat.metallicFactor", 0.0f));
    const float through = transmission_of(material);
    const float rough = put_anisotropy(self, index, roughness_of(material));
    put_color(self, index, "base_color");
    texture_put_share(
        self, material,
        &(texture_use){
            both ? both_slot : roughness_slot, "roughness", "green", true, {rough, rough, rough}, 0.0f});
    if (!is_thin(self, index))
        texture_put_share(
            self, material,
            &(texture_use){
                both ? both_slot : metal_slot, "metallic", "blue", true, {metal, metal, metal}, 0.0f});
    if (through > 0.0f)
        texture_put_share(
            self, material,
            &(texture_use){through_slot, "spec_trans", "red", true, {through, through, through}, 0.0f});
    float highlight[4] = {1.0f, 1.0f, 1.0f, 1.0f};
    if (self->is_gltf)
        put_specular(self, index);
    else if (writer_color(material, "$clr.specular", highlight) &&
             !(highlight[0] + highlight[1] + highlight[2] > 0.0f) && !(metal > 0.0f))
        writer_property(self, "float", "specular", "0");
    put_sheen(self, index);
    put_coat(self, index);
}

/* The interpretation of alpha, by glTF or other formats; false: the surface is opaque. */
static bool find_opacity(writer *self, const struct aiMaterial *material, texture_use *use) {
    struct aiString mode;
    float color[4];
    base_color(self, material, color);
    *use = (texture_use){color_slot(self, material),     "opacity", "alpha", false,
                         {color[3], color[3], color[3]}, 0.0f};
    if (aiGetMaterialString(material, AI_MATKEY_GLTF_ALPHAMODE, &mode) == aiReturn_SUCCESS) {
        if (strcmp(mode.data, "MASK") == 0)
            use->cutoff = writer_number(material, "$mat.gltf.alphaCutoff", 0.5f);
        return strcmp(mode.data, "OPAQUE") != 0 &&
               (texture_exists(self, material, use->from) || color[3] < 1.0f);
    }
    if (texture_exists(self, material, opacity_slot)) {
        use->from = opacity_slot;
        use->channel = "rgb";
        use->raw = true;
        return true;
    }
    use->from = opacity_slot;
    return color[3] < 1.0f;
}

/* Opens a <bsdf> inside the open ones; the outermost one has the id. */
static void open_bsdf(writer *self, unsigned index, const char *type, unsigned *open) {
    writer_open(self, "bsdf", type);
    if ((*open)++ == 0)
        writer_set(self, "id", "material-%u-%u", self->first, index);
}

static void put_opacity(writer *self, const struct aiMaterial *material, texture_use *use) {
    if (use->cutoff > 0.0f && !texture_exists(self, material, use->from))
        use->factor[0] = use->factor[0] < use->cutoff ? 0.0f : 1.0f;
    texture_put_share(self, material, use);
}

static void put_normals(writer *self, const struct aiMaterial *material) {
    float scale = 1.0f;
    aiGetMaterialFloatArray(material, AI_MATKEY_GLTF_TEXTURE_SCALE(aiTextureType_NORMALS, 0), &scale, NULL);
    if (isfinite(scale) && scale != 1.0f)
        writer_property(self, "float", "scale", "%.9g", (double)scale);
    texture_put(self, material,
                &(texture_use){normal_slot, "normalmap", "rgb", true, {1.0f, 1.0f, 1.0f}, 0.0f});
}

/* The nesting from the outside: mask, two-sided, normal map, the material. */
static void put_material(writer *self, unsigned index) {
    const struct aiMaterial *const material = self->scene->mMaterials[index];
    const bool unlit = is_unlit(material);
    texture_use opacity;
    unsigned open = 0;
    if (find_opacity(self, material, &opacity)) {
        open_bsdf(self, index, "mask", &open);
        put_opacity(self, material, &opacity);
    }
    if (!(transmission_of(material) > 0.0f))
        open_bsdf(self, index, "twosided", &open);
    if (texture_exists(self, material, normal_slot) && !unlit) {
        open_bsdf(self, index, "normalmap", &open);
        put_normals(self, material);
    }
    open_bsdf(self, index, unlit ? "diffuse" : is_thin(self, index) ? "principledthin" : "principled", &open);
    if (unlit)
        writer_property(self, "rgb", "reflectance", "0");
    else
        put_principled(self, index);
    while (open-- > 0)
        writer_close(self);
}

void writer_put_materials(writer *self) {
    for (unsigned i = 0; i < self->scene->mNumMaterials; ++i)
        put_material(self, i);
}

/* --- emission */

static bool emission_of(writer *self, unsigned index, float color[4]) {
    const struct aiMaterial *const material = self->scene->mMaterials[index];
    color[0] = color[1] = color[2] = texture_exists(self, material, emissive_slot) ? 1.0f : 0.0f;
    writer_color(material, "$clr.emissive", color);
    /* assimp 5.2 does not read it. */
    const float strength = writer_number(
        material, "$mat.emissiveIntensity",
        extension_number(self, index, "KHR_materials_emissive_strength", "emissiveStrength", 1.0f, 1e30f));
    for (size_t i = 0; i < 3; ++i)
        color[i] *= strength;
    return color[0] + color[1] + color[2] > 0.0f;
}

bool writer_shines(writer *self, unsigned material) {
    float color[4];
    return is_unlit(self->scene->mMaterials[material]) || emission_of(self, material, color);
}

void writer_put_emitter(writer *self, unsigned index) {
    const struct aiMaterial *const material = self->scene->mMaterials[index];
    float color[4];
    writer_open(self, "emitter", "area");
    if (is_unlit(material)) {
        put_color(self, index, "radiance");
    } else if (emission_of(self, index, color) && texture_exists(self, material, emissive_slot)) {
        texture_put(
            self, material,
            &(texture_use){emissive_slot, "radiance", "rgb", false, {color[0], color[1], color[2]}, 0.0f});
    } else {
        writer_property(self, "rgb", "radiance", "%.9g %.9g %.9g", (double)color[0], (double)color[1],
                        (double)color[2]);
    }
    writer_close(self);
}
